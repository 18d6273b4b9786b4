"""Error of the energy of a step: the method's embedded estimate, and the errors that this one number can miss.

Energy is a sum over three instants of a step. Where power is smooth, the embedded estimate is far above the error of the
sum. Where power has a kink inside the step, or falls to zero at its end with an infinite slope, estimate and error are of
the same size, and the estimate may be small by accident.
"""

from __future__ import annotations

import math

from macroslip.compiled import jit_part
from macroslip.integrate.crossing import cubic
from macroslip.integrate.load_zone import EDGE, FIRM
from macroslip.integrate.radau_step import WEIGHTS, energy_error
from macroslip.integrate.sealed import forces_of, has_microslip, powers_of
from macroslip.integrate.stages import between_stages
from macroslip.integrate.tuning import CUSP_LOOK, CUSP_WEIGHT, FALLEN, KINK_WEIGHT
from macroslip.ring.orbit import instant, interval_of


@jit_part
def missed_way(path, state, step):
    """Error of the method's quadrature for the way of the rings past the roller in a step [m]; it is known exactly.

    Speed is linear between the samples of the loads, and friction follows it: kinks of both lie at the same instants.
    """
    motion, model, h = path.motion, path.model, step.length
    before = instant(motion, state.interval, state.time)
    after = instant(motion, step.interval, step.times[2])
    way = -model.orbit_ratio * model.outer_radius * (after.shaft_angle - before.shaft_angle)
    found = WEIGHTS[0] * step.at1.ring_speed + WEIGHTS[1] * step.at2.ring_speed + WEIGHTS[2] * step.at3.ring_speed
    return h * found - way


@jit_part
def _kink_error(path, state, step, powers):
    """Error of the energy [J] by kinks of the speed inside a step that spans samples; `powers` are those at four nodes."""
    if step.interval == state.interval:
        return 0.0
    fastest = max(
        abs(state.at.ring_speed), abs(step.at1.ring_speed), abs(step.at2.ring_speed), abs(step.at3.ring_speed)
    )
    missed = abs(missed_way(path, state, step))
    if fastest == 0.0:
        # At rest where it is looked at; the shaft may have turned in between.
        return math.inf if missed > 0.0 else 0.0
    return KINK_WEIGHT * missed / fastest * max(powers)


@jit_part
def _cusp_error(path, state, step, stages, powers, zone, record):
    """Error of the energy [J] where the cage's load is all but gone at one end of a step, by a look between the stages."""
    first, last = abs(state.forces.cage_load), abs(stages.f3.cage_load)
    if zone == EDGE or min(first, last) >= FALLEN * max(first, last):
        return 0.0
    here = interval_of(path.motion, state.time + CUSP_LOOK * step.length, state.interval)
    there, slip, _ = between_stages(path, state, step, stages, here, CUSP_LOOK)
    if zone == FIRM:
        if has_microslip(path.model):
            return 0.0  # the raceways' power, beside which the cage's is little, has no cusp there
        # Between stages the polynomial of slip is far from balance, which for the cage is that of pure rolling.
        slip = 0.0
    inner, outer, cage = powers_of(path.model, there, forces_of(path.model, there, slip), slip)
    record.count[2] += 1
    return CUSP_WEIGHT * step.length * abs(inner + outer + cage - cubic(CUSP_LOOK, *powers))


@jit_part
def energy_error_of(path, state, step, stages, found, zone, record):
    """Estimated error of the energy of a step [J]; evaluations are counted in `record`."""
    powers = (
        state.powers[0] + state.powers[1] + state.powers[2],
        found.inner[0] + found.outer[0] + found.cage[0],
        found.inner[1] + found.outer[1] + found.cage[1],
        found.inner[2] + found.outer[2] + found.cage[2],
    )
    embedded = abs(energy_error(step.length, *powers))
    kink = _kink_error(path, state, step, powers)
    return max(embedded, kink, _cusp_error(path, state, step, stages, powers, zone, record))
