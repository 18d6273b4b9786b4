"""The production integrator: steps of a roller's slip with error control, ending on every edge of the load zone.

It computes steps and nothing else. They go into a buffer; when that is full the function returns, and goes on where it was
when it is called again with the same memory.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit, jit_inline
from macroslip.contact.look_up import REST_SPEED
from macroslip.imposed.control import (
    energy_error,
    error_ratio,
    first_cusp,
    held_energy_error,
    slip_error,
    step_factor,
)
from macroslip.imposed.radau import (
    Memory,
    State,
    between_stages,
    first_guess,
    first_memory,
    follows_loads,
    forces_of,
    held_exponent,
    held_step_from,
    is_continuous,
    solve_held,
    solve_stages,
    state_at,
    step_from,
)
from macroslip.imposed.status import (
    COMPLETED,
    NOT_FINITE,
    OUTSIDE_TABLES,
    STEP_TOO_SMALL,
    TOO_MANY_STEPS,
    UNDER_WAY,
)
from macroslip.imposed.tuning import (
    CUSP_PART,
    EDGE_STEP,
    FIRST_STEP,
    GROWTH,
    INERTIA_PART,
    LEAST_PART,
    PEAK_PARTS,
    RESOLVED,
    SAFETY,
    SETTLED,
    SLIP_SHARE,
    SNAP,
    UNSOLVED_PART,
)
from macroslip.imposed.zones import EDGE, FIRM, FREE, edge_time
from macroslip.ring.orbit import interval_of
from macroslip.roller.forces import SlipForces, Station, net_force, powers
from macroslip.roller.step import write_stage

#: Tolerance and bounds, the same for all rollers of a case.
#:
#: tolerance : relative, of slip against the raceway speed and of energy per step [-]
#: max_steps : steps after which the integration gives up
#: speed_scale : largest raceway speed |u2| of the history [m/s]
#: energy_scale : twice the kinetic energy of a roller's spin at that speed, I_z' u2²/r² [J]
#: longest_step : [s]
#: cold_slip : slip below which traction rises with slip at every load of the history [m/s]
#: firm : interference from which on the roller is firmly held [m]
#: window : start of the window [s]
LIMITS = np.dtype(
    [
        ("tolerance", "f8"), ("max_steps", "i8"), ("speed_scale", "f8"), ("energy_scale", "f8"), ("longest_step", "f8"),
        ("cold_slip", "f8"), ("firm", "f8"), ("window", "f8"),
    ]
)  # fmt: skip
#: What the integrator remembers between two calls: its counts (steps, rejections, force evaluations), the largest force that an
#: accepted step left unbalanced [N], time [s] and slip [m/s]; and whether it has begun. `spin` is that of the Euler methods [rad/s].
MEMORY = np.dtype(
    [
        ("begun", "i8"), ("count", "i8", (3,)), ("unbalanced", "f8"), ("time", "f8"), ("slip", "f8"), ("spent", "f8"), ("spin", "f8"),
        ("stretch", "i8"), ("top_power", "f8"), ("interval", "i8"),
        ("step", "f8"), ("barrier", "f8"), ("zone", "i8"), ("run_end", "i8"), ("next_stop", "i8"), ("sample_step", "f8"),
        ("failed", "i8"),
        ("exponent", "f8"), ("bend", "f8"), ("length", "f8"), ("s1", "f8"), ("s2", "f8"), ("s3", "f8"),
        ("at", "f8", (6,)), ("forces", "f8", (19,)), ("powers", "f8", (3,)),
    ]
)  # fmt: skip


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


class StepPowers(NamedTuple):
    """Frictional power at the three stages by interface [W], that of the whole roller at the four nodes, and the energy [J]."""

    one: tuple
    two: tuple
    three: tuple
    totals: tuple
    energy: float


class Attempt(NamedTuple):
    """A step that was tried: whether its stages were solved, on the continuous root; and its error over what is allowed."""

    solved: bool
    stages: tuple
    found: StepPowers
    error: float


@jit_inline
def _paced(pace, step, barrier, failed):
    """The same stretch with another step [s], barrier [s] and outcome of the last attempt."""
    return Pace(step, barrier, pace.zone, pace.run_end, pace.next_stop, pace.sample_step, failed)


@jit_inline
def _follows_acceleration(state):
    """Whether the cage's load is tractions rather than weight and drag: those jump with the shaft's acceleration."""
    load = state.forces.cage_load
    return abs(load - state.at.tangential) > INERTIA_PART * abs(load)


@jit
def _rebalanced(path, state, memory):
    """A firmly held roller just after a sample, where the shaft's acceleration changes at once.

    The transition takes the relaxation time, for which `firm_interference` gives a bound; here it takes none. A roller
    that still skids, or has not settled yet, is left as it is.
    """
    body, motion, interval = path.body, path.motion, state.interval
    speed_change = motion.shaft_speed[interval + 1] - motion.shaft_speed[interval]
    acceleration = speed_change / (motion.time[interval + 1] - motion.time[interval])
    needed = -body.orbit_ratio * body.outer_radius * acceleration / body.mobility
    slip = state.slip
    for _ in range(3):
        forces = forces_of(path, state.at, slip)
        slip += (needed - net_force(forces)) / forces.slope
    memory.count[2] += 3
    if not abs(slip - state.slip) < SETTLED * path.limits.speed_scale:
        return state
    forces = forces_of(path, state.at, slip)
    memory.count[2] += 1
    return State(state.time, interval, slip, state.at, forces, powers(body, state.at, forces, slip))


@jit_inline
def _next_stretch(path, state, pace, stops, classes, memory):
    """State and pace at a barrier: the class of the interval that begins there, and the next barrier.

    No barrier is left where all stops have been reached.
    """
    time, motion = state.time, path.motion
    next_stop = pace.next_stop
    while next_stop < stops.size and stops[next_stop] <= time:
        next_stop += 1
    if next_stop == stops.size:
        return state, Pace(pace.step, pace.barrier, pace.zone, pace.run_end, next_stop, pace.sample_step, pace.failed)
    interval = interval_of(motion, time, state.interval)
    state = State(time, interval, state.slip, state.at, state.forces, state.powers)
    zone = np.int64(classes[interval])
    sample_step = motion.time[interval + 1] - motion.time[interval]
    jumps = not path.body.microslip
    last, step, run_end = interval, pace.step, max(pace.run_end, interval)
    # From where an earlier search ended: a run may have as many intervals as the history, and is searched at every barrier.
    while run_end < classes.size - 1 and classes[run_end + 1] == zone:
        run_end += 1
    # With microslip the power of a held roller has a kink at every sample; without, that of a cage that carries little.
    kinks = zone == FIRM and (not jumps or _follows_acceleration(state))
    if zone != EDGE and step > 2.0 * sample_step and not kinks:
        last = max(interval, min(run_end, np.searchsorted(motion.time, stops[next_stop]) - 1))
        if zone == FIRM and last > interval and motion.time[last + 1] > stops[next_stop]:
            # The last step before a stop crosses no sample, so that tractions at the stop are those of the instant.
            last -= 1
    barrier = min(motion.time[last + 1], stops[next_stop])
    if jumps and state.at.interference > path.limits.firm and time == motion.time[interval]:
        state = _rebalanced(path, state, memory)
    if zone == EDGE:
        barrier = edge_time(path.body, motion, path.start_angle, interval, time, barrier)
        # With microslip forces are as smooth there as before, unless rings press on the roller anew.
        if pace.zone != EDGE and (jumps or pace.zone != FIRM):
            step = min(step, EDGE_STEP)
    return state, Pace(step, barrier, zone, run_end, next_stop, sample_step, pace.failed)


@jit_inline
def _step_powers(body, state, step, stages):
    """Power at the solved stages of a step, and the energy they add up to."""
    one = powers(body, step.at1, stages.f1, stages.v1)
    two = powers(body, step.at2, stages.f2, stages.v2)
    three = powers(body, step.at3, stages.f3, stages.v3)
    first, second, last = one[0] + one[1] + one[2], two[0] + two[1] + two[2], three[0] + three[1] + three[2]
    energy = step.length * (step.weights[0] * first + step.weights[1] * second + step.weights[2] * last)
    before = state.powers[0] + state.powers[1] + state.powers[2]
    return StepPowers(one, two, three, (before, first, second, last), energy)


@jit_inline
def _attempt(path, state, step, pace, known, memory):
    """Solve a step and find its error."""
    if step.held:
        stages = solve_held(path, state, step, known.exponent, known.bend)
    else:
        # Without microslip a roller that grips slips too little for its forces to bend in the same way twice.
        smooth = path.body.microslip or pace.zone == FREE
        stages = solve_stages(path, state, step, first_guess(path, state, step, pace.zone, known), smooth, known.bend)
    memory.count[2] += stages.evaluations
    found = _step_powers(path.body, state, step, stages)
    if not stages.converged or not is_continuous(path, state, step, stages):
        return Attempt(False, stages, found, math.inf)
    slip_off = 0.0
    if step.held:
        energy_off = held_energy_error(found.energy, step.length, found.totals[0], found.totals[3])
    else:
        slip_off, looks = slip_error(path, state, step, stages, pace.zone)
        energy_off, more = energy_error(path, state, step, stages, found.totals, pace.zone)
        memory.count[2] += looks + more
    since = path.limits.window if state.time >= path.limits.window else path.motion.time[0]
    mean_power = (memory.spent + found.energy) / (step.times[2] - since)
    error = error_ratio(path.limits, slip_off, energy_off, found.energy, mean_power, step.length, pace.sample_step)
    return Attempt(True, stages, found, error)


@jit_inline
def _rejected(path, state, pace, step, tried):
    """The pace after a step that was not taken."""
    if step.held:
        # The same step with three stages.
        return _paced(pace, pace.step, pace.barrier, True)
    part = UNSOLVED_PART
    if tried.solved:
        # With microslip a step that is too long crosses the kink of the loads at a sample: its error is of second order.
        factor = SAFETY / math.sqrt(tried.error) if path.body.microslip else step_factor(tried.error)
        part = max(LEAST_PART, factor)
    # A shorter step should not cross samples if it is short.
    sample_step = path.motion.time[state.interval + 1] - path.motion.time[state.interval]
    sample = math.inf if part * step.length > 2.0 * sample_step else path.motion.time[state.interval + 1]
    return _paced(pace, part * step.length, min(pace.barrier, sample), True)


@jit_inline
def _leaves(body, step, stages):
    """Whether a step ends in a state that the tables do not hold."""
    at, slip = step.at3, stages.v3
    speed = math.sqrt(at.ring_speed * at.ring_speed + 0.25 * slip * slip)
    load = max(at.inner_load, at.outer_load, abs(stages.f3.cage_load))
    return load > body.highest_load or speed > body.highest_speed + 2.0 * REST_SPEED


@jit_inline
def _top_power(found, before):
    """Largest power of a raceway since the roller had no load [W]."""
    one, two, three = found.one, found.two, found.three
    return max(before, one[0], one[1], two[0], two[1], three[0], three[1])


@jit_inline
def _may_peak_inside(path, state, stages, top_power):
    """Whether the roller snaps back in the step, or slides with a power near the largest so far."""
    sliding = max(
        max(abs(stages.f1.inner), abs(stages.f1.outer)) * abs(stages.v1),
        max(abs(stages.f2.inner), abs(stages.f2.outer)) * abs(stages.v2),
        max(abs(stages.f3.inner), abs(stages.f3.outer)) * abs(stages.v3),
    )
    if sliding > 0.5 * top_power:
        return True
    resolved = RESOLVED * SLIP_SHARE * path.limits.tolerance * path.limits.speed_scale
    return abs(state.slip) > resolved and abs(stages.v3) < SNAP * abs(state.slip)


@jit
def _write_samples(path, state, step, stages, rows, memory):
    """Write rows without weight at places between the stages, where power may have a peak; returns how many.

    A slip that is small against what a step may be off says nothing of the power there.
    """
    resolved = RESOLVED * SLIP_SHARE * path.limits.tolerance * path.limits.speed_scale
    row, stage = 0, 0
    for k in range(1, PEAK_PARTS + 1):
        there, slip, _ = between_stages(path, state, step, stages, state.interval, k / PEAK_PARTS)
        if abs(slip) <= resolved:
            continue
        forces = forces_of(path, there, slip)
        time = state.time + k / PEAK_PARTS * step.length
        write_stage(rows[row], stage, time, 0.0, path.body, there, forces, slip, powers(path.body, there, forces, slip))
        stage += 1
        _write_frame(rows[row], state, stage, memory.stretch, False)
        rows[row].end = time
        if stage == 3:
            row, stage = row + 1, 0
    memory.count[2] += PEAK_PARTS
    return row + (1 if stage > 0 else 0)


@jit_inline
def _write_frame(row, state, stages, stretch, sampled):
    """Write what a row says of the whole step."""
    row.start, row.stages, row.stretch, row.sampled = state.time, stages, stretch, 1 if sampled else 0
    row.power_before[0], row.power_before[1], row.power_before[2] = state.powers


@jit
def _write_step(path, state, step, stages, found, row, stretch, sampled):
    """Write an accepted step, whose peaks stand in rows before it where it is `sampled`."""
    body, h, weights = path.body, step.length, step.weights
    write_stage(row, 0, step.times[0], h * weights[0], body, step.at1, stages.f1, stages.v1, found.one)
    write_stage(row, 1, step.times[1], h * weights[1], body, step.at2, stages.f2, stages.v2, found.two)
    write_stage(row, 2, step.times[2], h * weights[2], body, step.at3, stages.f3, stages.v3, found.three)
    _write_frame(row, state, 3, stretch, sampled)


@jit_inline
def _reached(step, tried, time):
    """State at the end of an accepted step, whose `time` [s] is that of the barrier where it ends on one."""
    # A step ends in the interval it comes from, not in the next one that begins there.
    return State(time, step.interval, tried.stages.v3, step.at3, tried.stages.f3, tried.found.three)


@jit_inline
def _learnt(known, state, after, step, stages, zone):
    """Results of an accepted step for the next one."""
    exponent = known.exponent
    if zone == FIRM:
        exponent = held_exponent(state.at, state.slip, after.at, after.slip, exponent)
    return Memory(exponent, stages.bend, 0.0 if step.held else step.length, stages.s1, stages.s2, stages.s3)


@jit_inline
def _recalled(path, memory):
    """State, pace and knowledge as the last call left them, or at the first sample."""
    known = first_memory()
    if memory.begun == 0:
        memory.time, memory.interval = path.motion.time[0], 0
        memory.step, memory.barrier, memory.zone, memory.run_end = min(path.limits.longest_step, FIRST_STEP), memory.time, -1, -1
        memory.exponent, memory.bend, memory.begun = known.exponent, known.bend, 1
        state = state_at(path, memory.time, 0, memory.slip)
        memory.count[2] += 1
    else:
        a, f, p = memory.at, memory.forces, memory.powers
        at = Station(a[0], a[1], a[2], a[3], a[4], a[5])
        forces = SlipForces(
            f[0], f[1], f[2], f[3], f[4], f[5], f[6], f[7], f[8], f[9],
            f[10], f[11], f[12], f[13], f[14], f[15], f[16], f[17], f[18],
        )  # fmt: skip
        state = State(memory.time, memory.interval, memory.slip, at, forces, (p[0], p[1], p[2]))
    pace = Pace(
        memory.step, memory.barrier, memory.zone, memory.run_end, memory.next_stop, memory.sample_step, memory.failed != 0
    )
    return state, pace, Memory(memory.exponent, memory.bend, memory.length, memory.s1, memory.s2, memory.s3)


@jit_inline
def _remember(state, pace, known, memory):
    memory.time, memory.slip, memory.interval = state.time, state.slip, state.interval
    memory.step, memory.barrier, memory.zone, memory.run_end = pace.step, pace.barrier, pace.zone, pace.run_end
    memory.next_stop, memory.sample_step, memory.failed = pace.next_stop, pace.sample_step, 1 if pace.failed else 0
    memory.exponent, memory.bend, memory.length = known.exponent, known.bend, known.length
    memory.s1, memory.s2, memory.s3 = known.s1, known.s2, known.s3
    for k in range(memory.at.size):
        memory.at[k] = state.at[k]
    for k in range(memory.forces.size):
        memory.forces[k] = state.forces[k]
    for k in range(memory.powers.size):
        memory.powers[k] = state.powers[k]


@jit_inline
def _step_of(path, state, pace, length):
    """The step of `length` [s] to try: of two stages where the roller follows its loads."""
    if not pace.failed and follows_loads(path, state, pace.zone, length):
        return held_step_from(path, state, length)
    return step_from(path, state, length)


@jit
def integrate(path, stops, classes, memory, steps):
    """Integrate the slip of one roller, until its history ends or the buffer is full.

    Parameters
    ----------
    path : Path
        With `LIMITS`.
    stops : ndarray
        Times at which a step must end [s], rising, the last being the end of the integration.
    classes : ndarray of int8, shape (n − 1,)
        Classes of sample intervals, from `classify`.
    memory : record of `MEMORY`
        Zeros but for the slip at the first sample; then as the last call left it.
    steps : ndarray of `STEP`, shape (m,)
        Filled from the start.

    Returns
    -------
    status : int
        A `Status`; UNDER_WAY where the buffer is full.
    count : int
        Rows that were written.
    """
    state, pace, known = _recalled(path, memory)
    limits, row, status = path.limits, 0, UNDER_WAY
    while row + 5 <= steps.size:
        if state.time >= pace.barrier:
            if state.time == limits.window:
                # Errors in the window are bounded as if the history began with it.
                memory.spent = 0.0
            state, pace = _next_stretch(path, state, pace, stops, classes, memory)
            # Loads have a kink at every sample; no parabola for a peak should reach across it.
            memory.stretch += 1
            if pace.next_stop == stops.size:
                status = COMPLETED
                break
        if memory.count[0] + memory.count[1] >= limits.max_steps:
            status = TOO_MANY_STEPS
            break
        pace = _paced(pace, min(pace.step, limits.longest_step), pace.barrier, pace.failed)
        left = pace.barrier - state.time
        if left <= 1e-15 * abs(state.time):
            # Rounding has put the state on the barrier.
            state = State(pace.barrier, state.interval, state.slip, state.at, state.forces, state.powers)
            continue
        length = left if pace.step >= 0.95 * left else (0.5 * left if pace.step > 0.6 * left else pace.step)
        if length <= 4e-16 * abs(state.time) + 1e-300:
            status = STEP_TOO_SMALL
            break
        step = _step_of(path, state, pace, length)
        if length > CUSP_PART * limits.longest_step and not step.held:
            part = first_cusp(state, pace.zone == FREE, step)
            if part < 1.0:
                pace = _paced(pace, part * length, min(pace.barrier, state.time + part * length), pace.failed)
                continue
        tried = _attempt(path, state, step, pace, known, memory)
        known = Memory(known.exponent, tried.stages.bend, known.length, known.s1, known.s2, known.s3)
        if tried.solved and not math.isfinite(tried.found.energy):
            status = NOT_FINITE
            break
        if not tried.solved or tried.error > 1.0:
            memory.count[1] += 1
            pace = _rejected(path, state, pace, step, tried)
            continue
        if _leaves(path.body, step, tried.stages):
            status = OUTSIDE_TABLES
            break
        memory.count[0] += 1
        memory.spent += tried.found.energy
        memory.unbalanced = max(memory.unbalanced, tried.stages.unbalanced)
        sampled = not path.body.microslip and pace.zone == EDGE
        sampled = sampled and _may_peak_inside(path, state, tried.stages, memory.top_power)
        if sampled:
            row += _write_samples(path, state, step, tried.stages, steps[row:], memory)
        memory.top_power = _top_power(tried.found, 0.0 if pace.zone == FREE else memory.top_power)
        after = _reached(step, tried, pace.barrier if length == left else step.times[2])
        _write_step(path, state, step, tried.stages, tried.found, steps[row], memory.stretch, sampled)
        steps[row].end = after.time
        row += 1
        known = _learnt(known, state, after, step, tried.stages, pace.zone)
        grown = min(1.0 if pace.failed else GROWTH, step_factor(tried.error))
        pace = _paced(pace, length * grown, pace.barrier, False)
        state = after
    _remember(state, pace, known, memory)
    return status, row
