"""How long a step may be: bounds given beforehand, and the error it is found to have."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit_part
from macroslip.integrate.crossing import crossing
from macroslip.integrate.stages import between_stages
from macroslip.ring.orbit import interval_of
from macroslip.roller.forces import net_force, slip_forces

#: Largest part of an orbit turned in one step [rad], so that no step sees gravity's direction only where it is alike.
_LONGEST_TURN = 0.6
#: Parts of the tolerance that a step may spend on slip and on energy. Slip is remembered along a coast and adds up;
#: errors of energy are of either sign and its estimate is of low order, hence far too large.
SLIP_SHARE, _ENERGY_SHARE = 0.1, 10.0
#: Part of a roller's kinetic energy at the largest raceway speed below which a step's energy need not be known better:
#: out of standstill there is no energy yet to compare with.
_NO_ENERGY = 1e-9
#: Safety factor on the step that the error asks for.
_SAFETY = 0.8
#: Part of a sample interval below which energy is not controlled more finely.
_SHORT_PART = 0.05
#: Parts of a step between the stages at which the equation's defect is looked at, and its weight as an error.
_DEFECT_NODES = (0.83, 0.4)
_DEFECT_WEIGHT = 0.25


class Limits(NamedTuple):
    """Tolerance and bounds of the integration of one roller.

    Attributes
    ----------
    tolerance : float
        Relative accuracy asked of slip (against the raceway speed) and of energy per step [-].
    max_steps : int
        Steps after which the integration gives up.
    speed_scale : float
        Largest raceway speed |u2| of the history [m/s].
    energy_scale : float
        Twice the kinetic energy of a roller's spin at that speed, I_z' u2²/r² [J].
    longest_step : float
        Longest step [s].
    cold_slip : float
        Slip [m/s] below which traction rises with slip at every load of the history.
    firm : float
        Interference from which on the roller is firmly held [m].
    """

    tolerance: float
    max_steps: int
    speed_scale: float
    energy_scale: float
    longest_step: float
    cold_slip: float
    firm: float


def longest_step(motion, orbit_ratio: float) -> float:
    """Longest step [s]: a fraction of an orbit at the highest speed, or a tenth of the history if the shaft hardly turns."""
    span = float(motion.time[-1] - motion.time[0])
    fastest = abs(orbit_ratio) * float(np.max(np.abs(motion.shaft_speed)))
    return min(0.1 * span, _LONGEST_TURN / fastest) if fastest > 0.0 else 0.1 * span


@jit_part
def first_cusp(forces, free, at, at1, at2, at3):
    """Part of a step at which traction first has a cusp because a light contact's load passes through zero; else 1.

    At the cage it is foreseen with the traction at the start, whose change is small against the roller's weight. A
    `free` roller has another where it leans over from one raceway to the other.
    """
    held = forces.cage_load - at.tangential
    part = crossing(at.tangential + held, at1.tangential + held, at2.tangential + held, at3.tangential + held)
    if free:
        part = min(part, crossing(_lean(at), _lean(at1), _lean(at2), _lean(at3)))
    return part


@jit_part
def _lean(at):
    """Body force along the contact normal, positive outward [N]."""
    return at.outer_load - at.inner_load


@jit_part
def defect_error(model, motion, start_angle, interval, time, h, slip, at, stages, looks):
    """Error of slip [m/s] that the equation's defect between the stages tells of, at `looks` places.

    The embedded estimate is one number and may vanish by accident, especially where grip does so between two stages.
    """
    worst = 0.0
    for check in range(looks):
        part = _DEFECT_NODES[check]
        here = interval_of(motion, time + part * h, interval)
        there, between, rate = between_stages(model, motion, start_angle, here, time, h, part, slip, at, stages)
        push = slip_forces(model, there, between)
        defect = rate + h * model.mobility * net_force(push)
        grip = h * model.mobility * abs(push.slope)
        worst = max(worst, _DEFECT_WEIGHT * abs(defect) / (1.0 + grip))
    return worst


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
        Since the start [W].
    h, sample_step : float
        Length of the step and of the loads' sample interval [s].
    """
    error = abs(slip_off) / (SLIP_SHARE * limits.tolerance * limits.speed_scale + 1e-300)
    # Power jumps with the shaft's acceleration at every sample; what it does in a short part of a sample interval may
    # be off by what is allowed in that part.
    share = max(h, _SHORT_PART * sample_step)
    worth = max(mean_power * share, energy, _NO_ENERGY * limits.energy_scale)
    return max(error, abs(energy_off) / (_ENERGY_SHARE * limits.tolerance * worth + 1e-300))


@jit_part
def step_factor(error):
    """Factor on the step by its error over what is allowed; the estimates are of third order."""
    return _SAFETY / math.sqrt(math.sqrt(max(error, 1e-8)))


@jit_part
def sample_after(motion, interval, time, step):
    """The end of the sample interval if steps have become so short that they should not cross it; else infinity."""
    if step > 2.0 * (motion.time[interval + 1] - motion.time[interval]):
        return math.inf
    return motion.time[interval + 1]
