"""The next step of the integration: its length, and the barrier that it must not cross."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit_part
from macroslip.integrate.load_zone import EDGE, FIRM, edge_time
from macroslip.integrate.path import State
from macroslip.integrate.sealed import forces_of, has_microslip, powers_of
from macroslip.integrate.tuning import EDGE_STEP, FIRST_STEP, INERTIA_PART, SETTLED
from macroslip.ring.orbit import interval_of
from macroslip.roller.forces import net_force


class Pace(NamedTuple):
    """The next step.

    Attributes
    ----------
    step : float
        Length to try [s].
    barrier : float
        Time at which a step must end [s].
    zone : int
        Class of the sample interval; −1 before the first.
    run_end : int
        Last of the sample intervals of this class that follow one another.
    next_stop : int
        Index of the first stop that is still ahead.
    sample_step : float
        Length of the sample interval [s].
    failed : bool
        Whether the last attempt was rejected.
    """

    step: float
    barrier: float
    zone: int
    run_end: int
    next_stop: int
    sample_step: float
    failed: bool


@jit_part
def first_pace(path, state):
    """The pace at the first sample, whose barrier is the sample itself."""
    return Pace(min(path.limits.longest_step, FIRST_STEP), state.time, -1, -1, 0, 0.0, False)


@jit_part
def paced(pace, step, barrier, failed):
    """The same stretch with another step [s], barrier [s] and outcome of the last attempt."""
    return Pace(step, barrier, pace.zone, pace.run_end, pace.next_stop, pace.sample_step, failed)


@jit_part
def shortened(path, state, pace, step):
    """The pace after a rejected attempt, with a shorter `step` [s], which should not cross samples if it is short."""
    sample_step = path.motion.time[state.interval + 1] - path.motion.time[state.interval]
    sample = math.inf if step > 2.0 * sample_step else path.motion.time[state.interval + 1]
    return paced(pace, step, min(pace.barrier, sample), True)


@jit_part
def next_stretch(path, state, pace, stops, classes, record):
    """State and pace at a barrier: the class of the interval that begins there, and the next barrier.

    No barrier is left where all stops have been reached.
    """
    time, limits = state.time, path.limits
    next_stop = pace.next_stop
    while next_stop < stops.size and stops[next_stop] <= time:
        next_stop += 1
    if next_stop == stops.size:
        return state, Pace(pace.step, pace.barrier, pace.zone, pace.run_end, next_stop, pace.sample_step, pace.failed)
    interval = interval_of(path.motion, time, state.interval)
    state = State(time, interval, state.slip, state.at, state.forces, state.powers)
    zone = np.int64(classes[interval])
    sample_step = path.motion.time[interval + 1] - path.motion.time[interval]
    jumps = not has_microslip(path.model)
    last, step, run_end = interval, pace.step, max(pace.run_end, interval)
    # From where an earlier search ended: a run may have as many intervals as the history, and is searched at every barrier.
    while run_end < classes.size - 1 and classes[run_end + 1] == zone:
        run_end += 1
    # With microslip the power of a held roller has a kink at every sample; without, that of a cage that carries little.
    kinks = zone == FIRM and (not jumps or _follows_acceleration(state))
    if zone != EDGE and step > 2.0 * sample_step and not kinks:
        last = max(interval, min(run_end, np.searchsorted(path.motion.time, stops[next_stop]) - 1))
        if zone == FIRM and last > interval and path.motion.time[last + 1] > stops[next_stop]:
            # The last step before a stop crosses no sample, so that tractions at the stop are those of the instant.
            last -= 1
    barrier = min(path.motion.time[last + 1], stops[next_stop])
    if jumps and state.at.interference > limits.firm and time == path.motion.time[interval]:
        state = _rebalanced(path, state, record)
    if zone == EDGE:
        barrier = edge_time(path.model, path.motion, path.start_angle, interval, time, barrier)
        # With microslip forces are as smooth there as before, unless rings press on the roller anew.
        if pace.zone != EDGE and (jumps or pace.zone != FIRM):
            step = min(step, EDGE_STEP)
    return state, Pace(step, barrier, zone, run_end, next_stop, sample_step, pace.failed)


@jit_part
def _follows_acceleration(state):
    """Whether the cage's load is tractions rather than weight and drag: those jump with the shaft's acceleration."""
    load = state.forces.cage_load
    return abs(load - state.at.tangential) > INERTIA_PART * abs(load)


@jit_part
def _rebalanced(path, state, record):
    """A firmly held roller just after a sample, where the shaft's acceleration changes at once.

    The transition takes the relaxation time, for which `firm_interference` gives a bound; here it takes none. A roller
    that still skids, or has not settled yet, is left as it is.
    """
    model, motion, interval = path.model, path.motion, state.interval
    speed_change = motion.shaft_speed[interval + 1] - motion.shaft_speed[interval]
    acceleration = speed_change / (motion.time[interval + 1] - motion.time[interval])
    needed = -model.orbit_ratio * model.outer_radius * acceleration / model.mobility
    slip = state.slip
    for _ in range(3):
        forces = forces_of(model, state.at, slip)
        slip += (needed - net_force(forces)) / forces.slope
    record.count[2] += 3
    if not abs(slip - state.slip) < SETTLED * path.limits.speed_scale:
        return state
    forces = forces_of(model, state.at, slip)
    record.count[2] += 1
    return State(state.time, interval, slip, state.at, forces, powers_of(model, state.at, forces, slip))
