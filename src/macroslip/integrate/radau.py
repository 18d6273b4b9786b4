"""The production integrator: Radau IIA in the slip, with error control, stepping on every edge of the load zone."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from macroslip.compiled import jit_lawless, jit_part
from macroslip.integrate.booking import Peaks, book, step_powers, write_traces
from macroslip.integrate.energy_control import energy_error_of
from macroslip.integrate.first_guess import first_guess
from macroslip.integrate.held_contact import held_exponent
from macroslip.integrate.held_step import follows_loads, held_energy_error, held_step_from, solve_held
from macroslip.integrate.load_zone import EDGE, FIRM, FREE, classify
from macroslip.integrate.looks import follow, looked, no_looks, started
from macroslip.integrate.pace import first_pace, next_stretch, paced, shortened
from macroslip.integrate.path import State, state_at, step_from
from macroslip.integrate.peak import start_peak
from macroslip.integrate.root import is_continuous
from macroslip.integrate.sealed import has_microslip
from macroslip.integrate.stages import solve_stages
from macroslip.integrate.status import COMPLETED, INTERRUPTED, NOT_FINITE, STEP_TOO_SMALL, TOO_MANY_STEPS
from macroslip.integrate.step_control import error_ratio, first_cusp, slip_error_of, step_factor
from macroslip.integrate.tuning import CUSP_PART, GROWTH, LEAST_PART, LIMIT_EXPONENT, SAFETY, UNSOLVED_PART
from macroslip.reference import by_reference


class Memory(NamedTuple):
    """Results of a step that the next one needs for its first guess.

    Attributes
    ----------
    exponent : float
        Power of the load that the slip of a held roller follows.
    bend : float
        As in `macroslip.integrate.stages`.
    length : float
        Of the last step of three stages [s]; 0 where another has come since.
    s1, s2, s3 : float
        The increments of slip by forces at its stages [m/s].
    """

    exponent: float
    bend: float
    length: float
    s1: float
    s2: float
    s3: float


class Attempt(NamedTuple):
    """A step that was tried.

    Attributes
    ----------
    solved : bool
        Whether its stages were solved, on the continuous root.
    stages : Stages
    found : StepPowers
    energy : float
        Dissipated in it [J].
    error : float
        Its error over what is allowed; of no meaning if it was not solved.
    """

    solved: bool
    stages: Any
    found: Any
    energy: float
    error: float


@jit_lawless
def integrate_radau(path, slip, stops, classes, record):
    """Integrate the slip of one roller over the whole history.

    Parameters
    ----------
    path : Path
        With `Limits`.
    slip : float
        Slip at the first sample [m/s].
    stops : ndarray
        Times at which a step must end [s], rising, the last being the end of the integration.
    classes : ndarray of int8, shape (n − 1,)
        Work space for the classes of sample intervals.
    record : RollerRecord
        Filled.

    Returns
    -------
    int
        A `Status`, or `INTERRUPTED`.
    """
    path, record = by_reference(path), by_reference(record)
    stops, classes = by_reference(stops), by_reference(classes)
    classify(path.model, path.motion, path.start_angle, path.limits.firm, classes)
    state = state_at(path, path.motion.time[0], 0, slip)
    record.count[2] += 1
    pace = first_pace(path, state)
    peaks = Peaks(np.empty((2, 4)), -1, 0.0)
    memory = Memory(LIMIT_EXPONENT, math.inf, 0.0, 0.0, 0.0, 0.0)
    spent, next_trace, status, looks = 0.0, 0, COMPLETED, no_looks()
    while True:
        next_trace = write_traces(record, path.model, next_trace, state.time, state.at, state.forces, state.slip)
        if state.time >= pace.barrier:
            if state.time == record.edges[0]:
                # Errors in the window are bounded as if the history began with it.
                spent = 0.0
            state, pace = next_stretch(path, state, pace, stops, classes, record)
            if pace.next_stop == stops.size:
                break
            # Loads have a kink at every sample; no parabola for a peak should reach across it.
            start_peak(peaks.samples, state.time, state.powers[0], state.powers[1], state.powers[2])
        status = _halted(path.limits, record)
        if status != COMPLETED:
            break
        pace = paced(pace, min(pace.step, path.limits.longest_step), pace.barrier, pace.failed)
        left = pace.barrier - state.time
        if left <= 1e-15 * abs(state.time):
            # Rounding has put the state on the barrier.
            state = State(pace.barrier, state.interval, state.slip, state.at, state.forces, state.powers)
            continue
        length = left if pace.step >= 0.95 * left else (0.5 * left if pace.step > 0.6 * left else pace.step)
        if length <= 4e-16 * abs(state.time) + 1e-300:
            status = STEP_TOO_SMALL
            break
        if not pace.failed and follows_loads(path, state, pace.zone, length):
            step = held_step_from(path, state, length)
        else:
            step = step_from(path, state, length)
        if length > CUSP_PART * path.limits.longest_step and not step.held:
            part = first_cusp(state, pace.zone == FREE, step)
            if part < 1.0:
                pace = paced(pace, part * length, min(pace.barrier, state.time + part * length), pace.failed)
                continue
        tried = _attempt(path, state, step, pace, memory, spent, record)
        memory = _with_bend(memory, tried.stages.bend)
        if tried.solved and not math.isfinite(tried.energy):
            status = NOT_FINITE
            break
        factor = step_factor(tried.error)
        if not tried.solved or tried.error > 1.0:
            record.count[1] += 1
            pace = _rejected(path, state, pace, step, tried, factor)
            continue
        record.count[0] += 1
        spent += tried.energy
        after = _reached(step, tried, pace.barrier if length == left else step.times[2])
        if state.time >= record.edges[0]:
            looks = started(looks, path, state)
            peaks = book(record, path, state, step, tried.stages, tried.found, peaks, pace.zone == EDGE)
            energies = (tried.found.inner_energy, tried.found.outer_energy)
            looks = follow(record, path, after, energies, step.length, peaks.orbit, looks)
        record.worst[0] = max(record.worst[0], tried.stages.unbalanced)
        memory = _learnt(memory, state, after, step, tried.stages, pace.zone)
        state = after
        pace = paced(pace, length * min(1.0 if pace.failed else GROWTH, factor), pace.barrier, False)
    if looks.time < state.time:
        looked(record, path, state, looks.orbit, looks)
    record.end[0], record.end[1] = state.time, state.slip
    return status


@jit_part
def _rejected(path, state, pace, step, tried, factor):
    """The pace after a step that was not taken."""
    if step.held:
        # The same step with three stages.
        return paced(pace, pace.step, pace.barrier, True)
    if tried.solved and has_microslip(path.model):
        # A step that is too long there crosses the kink of the loads at a sample, so that its error is of second order.
        factor = SAFETY / math.sqrt(tried.error)
    part = max(LEAST_PART, factor) if tried.solved else UNSOLVED_PART
    return shortened(path, state, pace, part * step.length)


@jit_part
def _learnt(memory, state, after, step, stages, zone):
    """Results of an accepted step for the next one."""
    exponent = memory.exponent
    if zone == FIRM:
        exponent = held_exponent(state.at, state.slip, after.at, after.slip, exponent)
    return Memory(exponent, memory.bend, 0.0 if step.held else step.length, stages.s1, stages.s2, stages.s3)


@jit_part
def _with_bend(memory, bend):
    return Memory(memory.exponent, bend, memory.length, memory.s1, memory.s2, memory.s3)


@jit_part
def _halted(limits, record):
    """COMPLETED as long as the integration may go on; otherwise the status that ends it."""
    if limits.interrupt[0] != 0:
        return INTERRUPTED
    if record.count[0] + record.count[1] >= limits.max_steps:
        return TOO_MANY_STEPS
    return COMPLETED


@jit_part
def _attempt(path, state, step, pace, memory, spent, record):
    """Solve a step and find its error; `spent` is the energy of the steps before it, of those in the window there [J]."""
    if step.held:
        stages = solve_held(path, state, step, memory.exponent, memory.bend)
    else:
        # Without microslip a roller that grips slips too little for its forces to bend in the same way twice.
        smooth = has_microslip(path.model) or pace.zone == FREE
        guess = first_guess(path, state, step, pace.zone, memory)
        stages = solve_stages(path, state, step, guess, smooth, memory.bend)
    record.count[2] += stages.evaluations
    found = step_powers(path.model, step, stages)
    energy = found.inner_energy + found.outer_energy + found.cage_energy
    if not stages.converged or not is_continuous(path, state, step, stages):
        return Attempt(False, stages, found, energy, math.inf)
    if step.held:
        before = state.powers[0] + state.powers[1] + state.powers[2]
        after = found.inner[2] + found.outer[2] + found.cage[2]
        slip_off, energy_off = 0.0, held_energy_error(energy, step.length, before, after)
    else:
        slip_off = slip_error_of(path, state, step, stages, pace.zone, record)
        energy_off = energy_error_of(path, state, step, stages, found, pace.zone, record)
    since = record.edges[0] if state.time >= record.edges[0] else path.motion.time[0]
    mean_power = (spent + energy) / (step.times[2] - since)
    error = error_ratio(path.limits, slip_off, energy_off, energy, mean_power, step.length, pace.sample_step)
    return Attempt(True, stages, found, energy, error)


@jit_part
def _reached(step, tried, time):
    """State at the end of an accepted step, whose `time` [s] is that of the barrier where it ends on one."""
    found = tried.found
    return State(
        time,
        # A step ends in the interval it comes from, not in the next one that begins there.
        step.interval,
        tried.stages.v3,
        step.at3,
        tried.stages.f3,
        (found.inner[2], found.outer[2], found.cage[2]),
    )
