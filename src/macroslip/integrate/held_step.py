"""A step of a firmly held roller with microslip: its slip is nearly that at which the forces of the instant balance.

Collocation at the middle and the end of the step, with the energy by Simpson's rule: two force evaluations where the
Radau method takes three, and no worse, since slip forgets what it was within a small part of the step. The polynomial
through the slips at 0, 1/2 and 1 fulfils the spin equation at both places; the method is L-stable, and of order 2 where
slip has a memory (its stability function is (1 + z/4)/(1 − 3z/4 + z²/4)).
"""

from __future__ import annotations

import math

from macroslip.compiled import jit, jit_part
from macroslip.integrate.held_contact import held_exponent, held_slip
from macroslip.integrate.load_zone import FIRM
from macroslip.integrate.path import Step
from macroslip.integrate.sealed import forces_of, has_microslip, station_of
from macroslip.integrate.stages import Stages, force_tolerance
from macroslip.integrate.tuning import BEND_SAFETY, FORGET, HELD_ITERATIONS, QUASI_STATIC, SETTLED_FORCE
from macroslip.ring.orbit import instant, interval_of
from macroslip.roller.forces import magnitude, net_force, shifted

#: Weights of Simpson's rule.
SIMPSON = (1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0)


@jit_part
def follows_loads(path, state, zone, length):
    """Whether a roller is at its balance and forgets its slip within a small part of a step of `length` [s]."""
    if zone != FIRM or not has_microslip(path.model):
        return False
    forces = state.forces
    held = path.model.mobility * forces.slope * length > QUASI_STATIC
    # Not at rest, where all forces are zero, and so is the energy that the error is compared to.
    return held and abs(net_force(forces)) < SETTLED_FORCE * magnitude(forces)


@jit_part
def held_step_from(path, state, length):
    """A step of `length` [s] from a state on, whose stages are its start, its middle and its end."""
    middle, end = state.time + 0.5 * length, state.time + length
    k2 = interval_of(path.motion, middle, state.interval)
    k3 = interval_of(path.motion, end, k2)
    return Step(
        length,
        1.0 / (length * path.model.mobility),
        k3,
        (state.time, middle, end),
        state.at,
        station_of(path.model, path.start_angle, instant(path.motion, k2, middle)),
        station_of(path.model, path.start_angle, instant(path.motion, k3, end)),
        SIMPSON,
        True,
    )


@jit
def held_update(scale, d2, d3, rest_2, rest_3):
    """Solve the two linearised stage equations: changes of slip at the middle and at the end [m/s].

    R_2 = scale (v_3 − …) + F_2 and R_3 = scale (3 v_3 − 4 v_2 + …) + F_3, with F' = d [N s/m] and `scale` = 1/(h r²/I_z').

    Examples
    --------
    >>> held_update(1.0, 2.0, 3.0, 16.0, 8.0)
    (-5.5, -5.0)
    """
    last = 3.0 * scale + d3
    change_3 = (-rest_3 * d2 - 4.0 * scale * rest_2) / (last * d2 + 4.0 * scale * scale)
    return (-rest_2 - scale * change_3) / d2, change_3


@jit_part
def solve_held(path, state, step, exponent, bend):
    """Solve the stage equations of a held step.

    Parameters
    ----------
    path : Path
    state : State
    step : Step
        From `held_step_from`.
    exponent : float
        Power of the load that slip follows.
    bend : float
        As in `macroslip.integrate.stages`.

    Returns
    -------
    Stages
        Not converged where Newton's iteration would need a better guess than is available.
    """
    model, scale, slip, at = path.model, step.scale, state.slip, state.at
    d2, d3 = step.at2.ring_speed - at.ring_speed, step.at3.ring_speed - at.ring_speed
    force_part = force_tolerance(path.limits.tolerance, True)
    v2 = held_slip(True, slip, at, step.at2, exponent)
    f2 = forces_of(model, step.at2, v2)
    # The middle first, with the end as far ahead as the middle: its solution makes a good guess of the end.
    s2 = v2 - slip - d2
    first = scale * 2.0 * s2 + net_force(f2)
    ahead = v2 - first / (2.0 * scale + f2.slope)
    later = held_exponent(at, slip, step.at2, ahead, exponent)
    v3 = held_slip(True, ahead, step.at2, step.at3, later)
    f3 = forces_of(model, step.at3, v3)
    evaluations, unbalanced, converged, change, foreseen = 2, math.inf, False, 0.0, math.inf
    s3 = v3 - slip - d3
    for iteration in range(HELD_ITERATIONS):
        rest_2 = scale * s3 + net_force(f2)
        rest_3 = scale * (3.0 * s3 - 4.0 * s2) + net_force(f3)
        size = max(abs(rest_2), abs(rest_3))
        allowed = force_part * min(magnitude(f2), magnitude(f3))
        if not math.isfinite(size) or f2.slope <= 0.0 or f3.slope <= 0.0:
            break
        if iteration > 0:
            if iteration == 1:
                bend = max(size / (change * change), FORGET * bend if bend < math.inf else 0.0)
            if size > 0.9 * unbalanced and size > allowed:
                break
            foreseen = min(size, size * size / unbalanced)
        u2, u3 = held_update(scale, f2.slope, f3.slope, rest_2, rest_3)
        change = max(abs(u2), abs(u3))
        if iteration == 0:
            foreseen = BEND_SAFETY * bend * change * change
        unbalanced = size
        v2 += u2
        v3 += u3
        s2, s3 = v2 - slip - d2, v3 - slip - d3
        if foreseen <= allowed:
            f2, f3 = shifted(f2, u2), shifted(f3, u3)
            unbalanced, converged = foreseen, True
            break
        f2, f3 = forces_of(model, step.at2, v2), forces_of(model, step.at3, v3)
        evaluations += 2
    return Stages(converged, slip, v2, v3, 0.0, s2, s3, state.forces, f2, f3, unbalanced, evaluations, bend)


@jit
def held_energy_error(energy, length, before, after):
    """Estimated error of the energy of a held step [J], from powers at its ends [W].

    Simpson's rule is off in proportion to the fourth power of the step, the trapezoidal rule to the second; the square of
    twice what they differ by relatively has the order of the one, and for a power that grows as an exponential eighty
    times its error. Errors of a rising and of a falling power are of one sign and add up, hence the margin.
    """
    difference = 2.0 * energy - length * (before + after)
    return difference * difference / abs(energy) if energy != 0.0 else math.inf
