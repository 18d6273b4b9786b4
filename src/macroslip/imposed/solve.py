"""The production integrator: steps of a roller's slip with error control.

Steps end on every edge of the load zone. It computes steps and nothing else. They go into a buffer;
when that is full the function returns, and goes on where it was when it is called again with the
same record of work.
"""

from __future__ import annotations

import math

import numpy as np

from macroslip.compiled import jit, jit_inline
from macroslip.contact.look_up import REST_SPEED
from macroslip.contact.spline import uncounted
from macroslip.imposed import tuning
from macroslip.imposed.control import (
    energy_error,
    first_cusp,
    held_energy_error,
    slip_error,
    step_factor,
)
from macroslip.imposed.radau import (
    Path,
    evaluate,
    follows_loads,
    frame,
    guess,
    held_exponent,
    is_continuous,
    look_between,
    set_step,
    solve_held,
    solve_stages,
    start_at,
    write_point,
)
from macroslip.imposed.status import (
    COMPLETED,
    NOT_FINITE,
    OUTSIDE_TABLES,
    STEP_TOO_SMALL,
    TOO_MANY_STEPS,
    UNDER_WAY,
)
from macroslip.imposed.zones import EDGE, FIRM, FREE, edge_time
from macroslip.mechanics.spin import net_force, powers
from macroslip.ring.orbit import Motion, interval_of, last_before
from macroslip.roller.step import write_stage

#: Rows that a step may take: its own, and rows of samples between its stages.
_ROWS = 2 + tuning.PEAK_PARTS // 3


@jit_inline
def _follows_acceleration(work):
    """True if tractions make up the cage's load: they jump with the shaft's acceleration."""
    load = work.forces.cage_load
    return abs(load - work.at.tangential) > tuning.INERTIA_PART * abs(load)


@jit_inline
def _rebalance(path, work):
    """Take a firmly held roller to just after a sample, where the shaft's acceleration jumps.

    The transition takes the relaxation time, for which `firm_interference` gives a bound; here it
    takes none. A roller that still skids, or has not settled yet, is left as it is.
    """
    body = path.body
    motion = path.motion
    k = work.interval
    acceleration = (motion.shaft_speed[k + 1] - motion.shaft_speed[k]) / (
        motion.time[k + 1] - motion.time[k]
    )
    needed = -body.orbit_ratio * body.outer_radius * acceleration / body.mobility
    slip = work.slip
    for _ in range(3):
        evaluate(path, work.at, slip, work.push)
        slip += (needed - net_force(work.push)) / work.push.slope
    work.count[2] += 3
    if abs(slip - work.slip) < tuning.SETTLED * path.limits.speed_scale:
        work.slip = slip
        start_at(path, work)


@jit_inline
def _next_stretch(path, stops, classes, work):
    """Find the class of the interval that begins at a barrier, and the next barrier.

    None is left after the last stop.
    """
    time = work.time
    motion = path.motion
    while work.next_stop < stops.size and stops[work.next_stop] <= time:
        work.next_stop += 1
    if work.next_stop == stops.size:
        return
    stop = stops[work.next_stop]
    before = work.zone
    work.interval = interval = interval_of(motion, time, work.interval)
    work.zone = zone = np.int64(classes[interval])
    work.sample_step = sample_step = motion.time[interval + 1] - motion.time[interval]
    jumps = not path.body.microslip
    last = interval
    # From where an earlier search ended: a run may have as many intervals as the history, and is
    # searched at every barrier.
    work.run_end = max(work.run_end, interval)
    while work.run_end < classes.size - 1 and classes[work.run_end + 1] == zone:
        work.run_end += 1
    # With microslip the power of a held roller has a kink at every sample; without, that of a cage
    # that carries little.
    kinks = zone == FIRM and (not jumps or _follows_acceleration(work))
    if zone != EDGE and work.step > 2.0 * sample_step and not kinks:
        last = max(interval, min(work.run_end, last_before(motion.time, stop)))
        if zone == FIRM and last > interval and motion.time[last + 1] > stop:
            # The last step before a stop crosses no sample, so that tractions at the stop are those
            # of the instant.
            last -= 1
    work.barrier = min(motion.time[last + 1], stop)
    if jumps and work.at.interference > path.limits.firm and time == motion.time[interval]:
        _rebalance(path, work)
    if zone == EDGE:
        work.barrier = edge_time(path.body, motion, path.start_angle, interval, time, work.barrier)
        # With microslip forces are as smooth there as before, unless rings press on the roller
        # anew.
        if before != EDGE and (jumps or before != FIRM):
            work.step = min(work.step, tuning.EDGE_STEP)


@jit_inline
def _attempt(path, work):
    """Solve the step; returns error / tolerance.

    It is infinite where the step was not solved on the continuous root.
    """
    if work.held:
        solve_held(path, work)
    else:
        guess(path, work)
        solve_stages(path, work)
    work.totals[0] = work.powers[0] + work.powers[1] + work.powers[2]
    work.energy = 0.0
    for k in range(3):
        total = powers(
            path.body, work.stage_at[k], work.stage_forces[k], work.v[k], work.stage_powers[k]
        )
        work.totals[k + 1] = total
        work.energy += work.length * work.weights[k] * total
    if work.converged == 0 or not is_continuous(path, work):
        return math.inf
    if work.held:
        slip_off = 0.0
        energy_off = held_energy_error(work.energy, work.length, work.totals[0], work.totals[3])
    else:
        slip_off = slip_error(path, work)
        energy_off = energy_error(path, work)
    since = path.limits.window if work.time >= path.limits.window else path.motion.time[0]
    mean_power = (work.spent + work.energy) / (work.times[2] - since)
    # Power jumps with the shaft's acceleration at every sample; what it does in a short part of a
    # sample interval may be off by what is allowed in that part.
    share = max(work.length, tuning.SHORT_PART * work.sample_step)
    limits = path.limits
    worth = max(mean_power * share, work.energy, tuning.NO_ENERGY * limits.energy_scale)
    slip_off /= tuning.SLIP_SHARE * limits.tolerance * limits.speed_scale + 1e-300
    return max(
        abs(slip_off), abs(energy_off) / (tuning.ENERGY_SHARE * limits.tolerance * worth + 1e-300)
    )


@jit_inline
def _reject(path, work, error):
    """Prepare another attempt: a held step with three stages, another one shorter."""
    work.count[1] += 1
    work.failed = 1
    if work.held:
        return
    part = tuning.UNSOLVED_PART
    if error < math.inf:
        # With microslip a step that is too long crosses the kink of the loads at a sample: its
        # error is of second order.
        part = max(
            tuning.LEAST_PART,
            tuning.SAFETY / math.sqrt(error) if path.body.microslip else step_factor(error),
        )
    work.step = part * work.length
    # A shorter step should not cross samples if it is short.
    sample = path.motion.time[work.interval + 1]
    if work.step <= 2.0 * (sample - path.motion.time[work.interval]):
        work.barrier = min(work.barrier, sample)


@jit_inline
def _leaves_tables(body, work):
    """True if the step ends in a state outside the tables."""
    at = work.stage_at[2]
    slip = work.v[2]
    speed = math.sqrt(at.ring_speed * at.ring_speed + 0.25 * slip * slip)
    load = max(at.inner_load, at.outer_load, abs(work.stage_forces[2].cage_load))
    return load > body.highest_load or speed > body.highest_speed + 2.0 * REST_SPEED


@jit_inline
def _may_peak_inside(path, work, resolved):
    """True if the roller snaps back in the step, or slides with a power near its largest.

    The largest is that since the roller had no load.
    """
    if path.body.microslip or work.zone != EDGE:
        return False
    sliding = 0.0
    for k in range(3):
        forces = work.stage_forces[k]
        sliding = max(sliding, max(abs(forces.inner), abs(forces.outer)) * abs(work.v[k]))
    return sliding > 0.5 * work.top_power or (
        abs(work.slip) > resolved and abs(work.v[2]) < tuning.SNAP * abs(work.slip)
    )


@jit_inline
def _film_ends_at(work, resolved):
    """Part of the step at which the entrainment of a sliding roller passes zero, else 1.

    The film ends there, and power has a cusp, but in tables, which smooth it. A gripped roller's
    passes zero with the ring's speed, and its slip between the stages is far from balance.
    """
    if min(abs(work.slip), abs(work.v[2])) <= resolved:
        return 1.0
    before = work.at.ring_speed - 0.5 * work.slip
    after = work.stage_at[2].ring_speed - 0.5 * work.v[2]
    return before / (before - after) if before * after < 0.0 else 1.0


@jit_inline
def _write_samples(path, work, resolved, cusp, rows):
    """Write rows without weight between the stages, where power may have a peak; returns how many.

    One of them is at the part `cusp` of the step. A slip that is small against what a step may be
    off says nothing of the power there.
    """
    row = 0
    stage = 0
    parts = tuning.PEAK_PARTS
    for k in range(1, parts + 1):
        near = abs(cusp * parts - k) <= 0.5 or (k == 1 and cusp * parts < 0.5)
        part = cusp if near else k / parts
        look_between(path, work, part)
        slip = work.there_slip
        if abs(slip) <= resolved:
            continue
        evaluate(path, work.there, slip, work.push)
        powers(path.body, work.there, work.push, slip, work.push_powers[:])
        one = rows[row]
        one.time[stage] = work.time + part * work.length
        one.weight[stage] = 0.0
        write_stage(one, stage, path.body, work.there, work.push, slip, work.push_powers[:])
        stage += 1
        frame(work, one, stage, one.time[stage - 1])
        if stage == 3:
            row = row + 1
            stage = 0
    work.count[2] += parts
    return row + (1 if stage > 0 else 0)


@jit_inline
def _accept(path, work, end, rows):
    """Write a step, which ends at `end` [s], and go on to there; returns the number of rows."""
    resolved = tuning.RESOLVED * tuning.SLIP_SHARE * path.limits.tolerance * path.limits.speed_scale
    count = 0
    cusp = _film_ends_at(work, resolved) if path.body.closed_form else 1.0
    sampled = cusp < 1.0 or _may_peak_inside(path, work, resolved)
    if sampled:
        count = _write_samples(path, work, resolved, cusp, rows)
    row = rows[count]
    frame(work, row, 3, end)
    row.sampled = 1 if sampled else 0
    top = 0.0 if work.zone == FREE else work.top_power
    for k in range(3):
        row.time[k] = end if k == 2 else work.times[k]
        row.weight[k] = work.length * work.weights[k]
        write_stage(
            row,
            k,
            path.body,
            work.stage_at[k],
            work.stage_forces[k],
            work.v[k],
            work.stage_powers[k],
        )
        top = max(top, work.stage_powers[k, 0], work.stage_powers[k, 1])
    work.count[0] += 1
    work.spent = work.spent + work.energy
    work.top_power = top
    work.unbalanced = max(work.unbalanced, work.left)
    if work.zone == FIRM:
        work.exponent = held_exponent(
            work.at, work.slip, work.stage_at[2], work.v[2], work.exponent
        )
    work.last_length = 0.0 if work.held else work.length
    for k in range(3):
        work.last_s[k], work.powers[k] = work.s[k], work.stage_powers[2, k]
    # A step ends in the interval it comes from, not in the next one that begins there.
    work.time = end
    work.interval = work.end_interval
    work.slip = work.v[2]
    work.at = work.stage_at[2]
    work.forces = work.stage_forces[2]
    return count + 1


@jit_inline
def _begin(path, work, row):
    """Start at the first sample, at which no step ends: it has a row of its own."""
    work.begun = 1
    work.time = path.motion.time[0]
    work.interval = 0
    work.step = min(path.limits.longest_step, tuning.FIRST_STEP)
    work.barrier = work.time
    work.zone = -1
    work.run_end = -1
    work.exponent = tuning.LIMIT_EXPONENT
    work.bend = math.inf
    start_at(path, work)
    write_point(path, work, row)


@jit
def integrate(path, stops, classes, work, steps):
    """Integrate the slip of one roller with error control.

    It ends with the history, or where the buffer is full.

    Parameters
    ----------
    path : Path
        Its limits are a record of `LIMITS`.
    stops : ndarray, shape (m,)
        Times at which a step must end [s], rising, the last being the end of the integration.
    classes : ndarray of int8, shape (n − 1,)
        Classes of the n − 1 sample intervals, as `classify` writes them.
    work : record of `WORK`
        Zeros but for the slip at the first sample, and in later calls as the last call left it.
    steps : ndarray of `macroslip.roller.step.STEP`, shape (k,)
        Buffer, which is filled from the start.

    Returns
    -------
    status : int
        A `Status`; UNDER_WAY where the buffer is full.
    count : int
        Number of rows that were written.
    """
    time, speed, angle, displacement = path.motion
    motion = Motion(uncounted(time), uncounted(speed), uncounted(angle), uncounted(displacement))  # pyright: ignore[reportCallIssue]
    path = Path(path.body, path.tables, uncounted(path.flat), motion, path.start_angle, path.limits)
    limits = path.limits
    count = 0
    if work.begun == 0:
        _begin(path, work, steps[0])
        count = 1
    while count + _ROWS <= steps.size:
        if work.time >= work.barrier:
            if work.time == limits.window:
                # Errors in the window are bounded as if the history began with it.
                work.spent = 0.0
            _next_stretch(path, stops, classes, work)
            # Loads have a kink at every sample; no parabola for a peak should reach across it.
            work.stretch += 1
            if work.next_stop == stops.size:
                return COMPLETED, count
        if work.count[0] + work.count[1] >= limits.max_steps:
            return TOO_MANY_STEPS, count
        work.step = min(work.step, limits.longest_step)
        left = work.barrier - work.time
        if left <= 1e-15 * abs(work.time):
            # Rounding has put the roller on the barrier.
            work.time = work.barrier
            continue
        length = (
            left
            if work.step >= 0.95 * left
            else (0.5 * left if work.step > 0.6 * left else work.step)
        )
        if length <= 4e-16 * abs(work.time) + 1e-300:
            return STEP_TOO_SMALL, count
        set_step(path, work, length, work.failed == 0 and follows_loads(path, work, length))
        if length > tuning.CUSP_PART * limits.longest_step and work.held == 0:
            part = first_cusp(work)
            if part < 1.0:
                work.step = part * length
                work.barrier = min(work.barrier, work.time + part * length)
                continue
        error = _attempt(path, work)
        if error < math.inf and not math.isfinite(work.energy):
            return NOT_FINITE, count
        if not error <= 1.0:
            _reject(path, work, error)
            continue
        if _leaves_tables(path.body, work):
            return OUTSIDE_TABLES, count
        count += _accept(
            path, work, work.barrier if length == left else work.times[2], steps[count:]
        )
        work.step = length * min(1.0 if work.failed else tuning.GROWTH, step_factor(error))
        work.failed = 0
    return UNDER_WAY, count
