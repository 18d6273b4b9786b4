"""Length of a step: bounds that are known beforehand, and the estimated error of a step that was tried."""

from __future__ import annotations

import math

from macroslip.compiled import jit_part
from macroslip.integrate.crossing import crossing
from macroslip.integrate.load_zone import EDGE, FIRM
from macroslip.integrate.radau_step import slip_error
from macroslip.integrate.sealed import forces_of, has_microslip
from macroslip.integrate.stages import between_stages
from macroslip.integrate.tuning import (
    DEFECT_NODES,
    DEFECT_WEIGHT,
    ENERGY_SHARE,
    FORGOTTEN,
    NO_ENERGY,
    SAFETY,
    SHORT_PART,
    SLIP_SHARE,
)
from macroslip.ring.orbit import interval_of
from macroslip.roller.forces import net_force


@jit_part
def first_cusp(state, free, step):
    """Part of a step at which traction first has a cusp because a light contact's load passes through zero; else 1.

    At the cage it is predicted with the traction at the start, whose change is small against the roller's weight. A
    `free` roller has another where it leans over from one raceway to the other. Where the shaft turns back all friction
    has one.
    """
    at, at1, at2, at3 = state.at, step.at1, step.at2, step.at3
    held = state.forces.cage_load - at.tangential
    part = crossing(at.tangential + held, at1.tangential + held, at2.tangential + held, at3.tangential + held)
    part = min(part, crossing(at.ring_speed, at1.ring_speed, at2.ring_speed, at3.ring_speed))
    if free:
        part = min(part, crossing(_lean(at), _lean(at1), _lean(at2), _lean(at3)))
    return part


@jit_part
def _lean(at):
    """Body force along the contact normal, positive outward [N]."""
    return at.outer_load - at.inner_load


@jit_part
def defect_error(path, state, step, stages, looks):
    """Error of slip [m/s] by the equation's defect between the stages, at `looks` places.

    The embedded estimate is one number and may vanish by accident, especially where grip does so between two stages.
    """
    worst = 0.0
    turn = step.length * path.model.mobility
    for check in range(looks):
        part = DEFECT_NODES[check]
        here = interval_of(path.motion, state.time + part * step.length, state.interval)
        there, between, rate = between_stages(path, state, step, stages, here, part)
        push = forces_of(path.model, there, between)
        defect = rate + turn * net_force(push)
        grip = turn * abs(push.slope)
        worst = max(worst, DEFECT_WEIGHT * abs(defect) / (1.0 + grip))
    return worst


@jit_part
def slip_error_of(path, state, step, stages, zone, record):
    """Estimated error of slip of a step [m/s]; evaluations are counted in `record`."""
    microslip = has_microslip(path.model)
    slip_off = 0.0
    if not (zone == FIRM and microslip):
        # A held roller's slip is the balance of the instant, solved for at the end of the step.
        least = max(min(state.forces.slope, stages.f1.slope, stages.f2.slope, stages.f3.slope), 0.0)
        slip_off = abs(slip_error(step.scale, least, net_force(state.forces), stages.s1, stages.s2, stages.s3))
    if zone != FIRM:
        # Grip may cease between two stages; with microslip it does so gradually.
        looks = 2 if zone == EDGE and not microslip else 1
        slip_off = max(slip_off, defect_error(path, state, step, stages, looks))
        record.count[2] += looks
    if microslip:
        # Slip that the next step forgets need not be known so well.
        slip_off /= 1.0 + FORGOTTEN * step.length * path.model.mobility * max(stages.f3.slope, 0.0)
    return slip_off


@jit_part
def error_ratio(limits, slip_off, energy_off, energy, mean_power, h, sample_step):
    """Error of a step over what is allowed: the larger of slip's and energy's.

    Parameters
    ----------
    slip_off, energy_off : float
        Estimated errors [m/s], [J].
    energy : float
        Dissipated in the step [J].
    mean_power : float
        Since the start of the history or, in the window, of that [W].
    h, sample_step : float
        Length of the step and of the loads' sample interval [s].
    """
    error = abs(slip_off) / (SLIP_SHARE * limits.tolerance * limits.speed_scale + 1e-300)
    # Power jumps with the shaft's acceleration at every sample; what it does in a short part of a sample interval may
    # be off by what is allowed in that part.
    share = max(h, SHORT_PART * sample_step)
    worth = max(mean_power * share, energy, NO_ENERGY * limits.energy_scale)
    return max(error, abs(energy_off) / (ENERGY_SHARE * limits.tolerance * worth + 1e-300))


@jit_part
def step_factor(error):
    """Factor on the step by its error over what is allowed; the estimates are of third order."""
    return SAFETY / math.sqrt(math.sqrt(max(error, 1e-8)))
