"""Input of a roller's integration, its present state, and the step that it tries, one bundle each."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from macroslip.compiled import jit_part
from macroslip.integrate.radau_step import NODES, WEIGHTS
from macroslip.integrate.sealed import forces_of, powers_of, station_of
from macroslip.integrate.tuning import LONGEST_TURN
from macroslip.ring.orbit import instant, interval_of


class Limits(NamedTuple):
    """Tolerance and bounds of the Radau integrator, the same for all rollers of a case.

    Attributes
    ----------
    tolerance : float
        Relative tolerance of slip (against the raceway speed) and of energy per step [-].
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
    interrupt : ndarray of int8, shape (1,)
        Read in every step; any value but zero ends the integration. The caller sets it from another thread.
    """

    tolerance: float
    max_steps: int
    speed_scale: float
    energy_scale: float
    longest_step: float
    cold_slip: float
    firm: float
    interrupt: np.ndarray


class FixedStep(NamedTuple):
    """Rule and bounds of the paper's Euler methods.

    Attributes
    ----------
    step : float
        [s].
    implicit : bool
        Backward Euler if true, explicit Euler if not.
    tolerance : float
        Of the nonlinear iteration of backward Euler, relative change of spin.
    largest_slip : float
        Slip [m/s] beyond which the integration stops as unstable. Friction pulls a roller's surface towards the speed
        of the rings and of the cage only, so its true slip never leaves the range these speeds span.
    interrupt : ndarray of int8, shape (1,)
        As in `Limits`.
    """

    step: float
    implicit: bool
    tolerance: float
    largest_slip: float
    interrupt: np.ndarray


class Path(NamedTuple):
    """The way of one roller and how it is to be integrated.

    Attributes
    ----------
    model : SealedModel
        In plain Python also a RollerModel.
    motion : Motion
    start_angle : float
        Position φ at the first sample [rad].
    limits : Limits or FixedStep
    """

    model: Any
    motion: Any
    start_angle: float
    limits: Any


class State(NamedTuple):
    """A roller at one time.

    Attributes
    ----------
    time : float
        [s].
    interval : int
        Sample interval that holds it.
    slip : float
        [m/s].
    at : Station
    forces : SlipForces
    powers : tuple of float
        Frictional power at inner raceway, outer raceway and cage [W].
    """

    time: float
    interval: int
    slip: float
    at: Any
    forces: Any
    powers: tuple


class Step(NamedTuple):
    """A step from a state on: its length [s], 1/(h r²/I_z') [N s/m], and times [s] and stations of its three stages.

    `interval` is the sample interval it ends in, `weights` are those of its stages in the energy, and `held` whether its
    stages are those of `macroslip.integrate.held_step`: the start, the middle and the end.
    """

    length: float
    scale: float
    interval: int
    times: tuple
    at1: Any
    at2: Any
    at3: Any
    weights: tuple
    held: bool


@jit_part
def state_at(path, time, interval, slip):
    """The roller at a time [s] in a sample interval, slipping at `slip` [m/s]; one force evaluation."""
    at = station_of(path.model, path.start_angle, instant(path.motion, interval, time))
    forces = forces_of(path.model, at, slip)
    return State(time, interval, slip, at, forces, powers_of(path.model, at, forces, slip))


@jit_part
def step_from(path, state, length):
    """A step of `length` [s] from a state on."""
    t1, t2, t3 = state.time + NODES[0] * length, state.time + NODES[1] * length, state.time + length
    k1 = interval_of(path.motion, t1, state.interval)
    k2 = interval_of(path.motion, t2, k1)
    k3 = interval_of(path.motion, t3, k2)
    return Step(
        length,
        1.0 / (length * path.model.mobility),
        k3,
        (t1, t2, t3),
        station_of(path.model, path.start_angle, instant(path.motion, k1, t1)),
        station_of(path.model, path.start_angle, instant(path.motion, k2, t2)),
        station_of(path.model, path.start_angle, instant(path.motion, k3, t3)),
        WEIGHTS,
        False,
    )


def longest_step(motion, orbit_ratio: float) -> float:
    """Longest step [s]: a fraction of an orbit at the highest speed, or a tenth of the history if the shaft hardly turns."""
    span = float(motion.time[-1] - motion.time[0])
    fastest = abs(orbit_ratio) * float(np.max(np.abs(motion.shaft_speed)))
    return min(0.1 * span, LONGEST_TURN / fastest) if fastest > 0.0 else 0.1 * span
