"""The production integrator: steps of a roller's slip with error control.

Steps end on every edge of the load zone. It computes steps and nothing else. They go into a buffer;
when that is full the function returns, and goes on where it was when it is called again with the
same record of work.
"""

from __future__ import annotations

import math

import numpy as np

from macroslip.compiled import jit, jit_inline, uncounted
from macroslip.contact.look_up import REST_SPEED, contact_speed
from macroslip.imposed import tuning
from macroslip.imposed.control import (
    allowed_slip,
    cubic,
    energy_error,
    first_cusp,
    held_energy_error,
    slip_error,
    step_factor,
)
from macroslip.imposed.guess import guess
from macroslip.imposed.held import follows_loads, solve_held
from macroslip.imposed.held_slip import held_exponent
from macroslip.imposed.radau import sample_between, set_step, shift, solve_stages
from macroslip.imposed.root import is_continuous
from macroslip.imposed.state import Path, evaluate, frame, start_at, write_point
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
from macroslip.ring.orbit import interval_of, last_before, uncounted_motion
from macroslip.roller.step import write_stage

#: Rows that a step may take: its own, and those of samples between its stages, three in a row.
_ROWS = 1 + (tuning.CUSP_PARTS + 1) // 3


@jit_inline
def _follows_acceleration(now):
    """True if tractions make up the cage's load, so that it jumps with acceleration."""
    load = now.forces.cage_load
    return abs(load - now.at.tangential) > tuning.INERTIA_PART * abs(load)


@jit_inline
def _rebalance(path, now, sums, sample):
    """Set the slip of a firmly held roller to its balance just after a sample.

    The transition takes the relaxation time, for which `firm_approach` gives a bound; here it
    takes none. A roller that still skids, or has not settled yet, stays as it is. `sample` is
    overwritten.
    """
    body = path.body
    motion = path.motion
    k = now.interval
    rise = motion.shaft_speed[k + 1] - motion.shaft_speed[k]
    acceleration = rise / (motion.time[k + 1] - motion.time[k])
    needed = -body.orbit_ratio * body.outer_radius * acceleration / body.mobility
    slip = now.slip
    sample.forces = now.forces
    forces = sample.forces
    for _ in range(tuning.BALANCE_ITERATIONS):
        change = (needed - net_force(forces)) / forces.slope
        slip += change
        if abs(change) <= tuning.BALANCED * abs(slip):
            shift(forces, change)
            break
        evaluate(path, now.at, slip, forces)
        sums.evaluations += 1
    if abs(slip - now.slip) < tuning.SETTLED * path.limits.speed_scale:
        now.slip = slip
        now.forces = forces
        powers(body, now.at, now.forces, slip, now.powers[:])


@jit_inline
def _next_stretch(path, stops, classes, now, stretch, sums, sample):
    """Find the class of the sample interval that begins at a barrier, and the next barrier.

    There is none after the last stop. `sample` is overwritten.
    """
    time = now.time
    motion = path.motion
    while stretch.next_stop < stops.size and stops[stretch.next_stop] <= time:
        stretch.next_stop += 1
    if stretch.next_stop == stops.size:
        return
    stop = stops[stretch.next_stop]
    before = stretch.zone
    interval = interval_of(motion, time, now.interval)
    zone = np.int64(classes[interval])
    sample_step = motion.time[interval + 1] - motion.time[interval]
    now.interval = interval
    stretch.zone = zone
    stretch.sample_step = sample_step
    jumps = not path.body.microslip
    last = interval
    # From where an earlier search ended: a run may have as many intervals as the history, and is
    # searched at every barrier.
    stretch.run_end = max(stretch.run_end, interval)
    while stretch.run_end < classes.size - 1 and classes[stretch.run_end + 1] == zone:
        stretch.run_end += 1
    # With microslip the power of a held roller has a kink at every sample; without, that of a cage
    # that carries little.
    kinks = zone == FIRM and (not jumps or _follows_acceleration(now))
    if zone != EDGE and stretch.step > 2.0 * sample_step and not kinks:
        last = max(interval, min(stretch.run_end, last_before(motion.time, stop)))
        if zone == FIRM and last > interval and motion.time[last + 1] > stop:
            # The last step before a stop crosses no sample, so that tractions at the stop are those
            # of the instant.
            last -= 1
    stretch.barrier = min(motion.time[last + 1], stop)
    if jumps and now.at.approach > path.limits.firm and time == motion.time[interval]:
        _rebalance(path, now, sums, sample)
    if zone == EDGE:
        stretch.barrier = edge_time(
            path.body, motion, path.start_angle, interval, time, stretch.barrier
        )
        # With microslip forces are as smooth there as before, unless rings press on the roller
        # anew.
        if before != EDGE and (jumps or before != FIRM):
            stretch.step = min(stretch.step, tuning.EDGE_STEP)


@jit_inline
def _attempt(path, now, attempt, before, stretch, sample, sums):
    """Solve the step; returns error / tolerance.

    It is infinite where the step was not solved on the continuous root.
    """
    zone = stretch.zone
    if attempt.held:
        solved = solve_held(path, now, attempt, before, sums)
    else:
        guess(path, now, zone, before, attempt)
        solved = solve_stages(path, now, zone, attempt, before, sums)
    attempt.totals[0] = now.powers[0] + now.powers[1] + now.powers[2]
    attempt.energy = 0.0
    for k in range(3):
        total = powers(
            path.body, attempt.at[k], attempt.forces[k], attempt.slip[k], attempt.powers[k]
        )
        attempt.totals[k + 1] = total
        attempt.energy += attempt.length * attempt.weights[k] * total
    if not solved or not is_continuous(path, now, attempt):
        return math.inf
    if attempt.held:
        slip_off = 0.0
        energy_off = held_energy_error(
            attempt.energy, attempt.length, attempt.totals[0], attempt.totals[3]
        )
    else:
        slip_off = slip_error(path, now, zone, attempt, sample, sums)
        energy_off = energy_error(path, now, zone, attempt, sample, sums)
    since = path.limits.window if now.time >= path.limits.window else path.motion.time[0]
    mean_power = (sums.spent + attempt.energy) / (attempt.times[2] - since)
    # Power jumps with the shaft's acceleration at every sample; its error in a short part of a
    # sample interval may reach the tolerance of that part.
    share = max(attempt.length, tuning.SHORT_PART * stretch.sample_step)
    limits = path.limits
    worth = max(mean_power * share, attempt.energy, tuning.NO_ENERGY * limits.energy_scale)
    slip_part = abs(slip_off / (allowed_slip(limits) + 1e-300))
    allowed_energy = tuning.ENERGY_SHARE * limits.tolerance * worth + 1e-300
    return max(slip_part, abs(energy_off) / allowed_energy)


@jit_inline
def _reject(path, now, attempt, stretch, sums, error):
    """Prepare another attempt: three stages in place of a held step's two, or a shorter step."""
    sums.rejections += 1
    if attempt.held and error == math.inf:
        stretch.step = tuning.UNSOLVED_HELD_PART * attempt.length
        return
    stretch.failed = 1
    if attempt.held:
        return
    part = tuning.UNSOLVED_PART
    if error < math.inf:
        # With microslip a step that is too long crosses the kink of the loads at a sample: its
        # error is of second order.
        part = tuning.SAFETY / math.sqrt(error) if path.body.microslip else step_factor(error)
        part = max(tuning.LEAST_PART, part)
    stretch.step = part * attempt.length
    # A shorter step should not cross samples if it is short.
    sample = path.motion.time[now.interval + 1]
    sample_step = sample - path.motion.time[now.interval]
    if stretch.step <= 2.0 * sample_step:
        stretch.barrier = min(stretch.barrier, sample)


@jit_inline
def _leaves_tables(body, attempt):
    """True if the step ends in a state outside the tables."""
    at = attempt.at[2]
    slip = attempt.slip[2]
    speed = contact_speed(at.ring_speed, slip)
    load = max(at.inner_load, at.outer_load, abs(attempt.forces[2].cage_load))
    return load > body.highest_load or speed > body.highest_speed + 2.0 * REST_SPEED


@jit_inline
def _resolved_slip(limits):
    """Slip [m/s] below which the error that a step may have hides the power of sliding."""
    return tuning.RESOLVED * allowed_slip(limits)


@jit_inline
def _may_peak_inside(path, now, attempt, zone, top_power):
    """True if power may be higher between the stages of a step than at all of them.

    So it may where the roller snaps back, and where the cubic through the powers at the stages is
    higher between them; if the roller slides with a power near its largest, `top_power` [W], since
    it had no load.
    """
    if path.body.microslip or zone != EDGE:
        return False
    slip = now.slip
    sliding = 0.0
    for k in range(3):
        forces = attempt.forces[k]
        larger = max(abs(forces.inner), abs(forces.outer))
        sliding = max(sliding, larger * abs(attempt.slip[k]))
    if sliding <= 0.5 * top_power:
        return False
    before = abs(slip)
    after = abs(attempt.slip[2])
    if before > _resolved_slip(path.limits) and after < tuning.SNAP * before:
        return True
    totals = attempt.totals
    highest = max(totals[0], totals[1], totals[2], totals[3])
    between = 0.0
    for k in range(1, tuning.PEAK_PARTS):
        part = k / tuning.PEAK_PARTS
        between = max(between, cubic(part, totals[0], totals[1], totals[2], totals[3]))
    return between > tuning.HIGHER_BETWEEN * highest


@jit_inline
def _film_ends_at(now, attempt, resolved):
    """Part of a step at which the entrainment speed of a sliding roller passes zero, else 1.

    The film ends there, and power has a cusp, but in tables, which smooth it. A gripped roller's
    passes zero with the ring's speed, and its slip between the stages is far from balance.
    """
    if min(abs(now.slip), abs(attempt.slip[2])) <= resolved:
        return 1.0
    # Speed of entrainment [m/s].
    before = now.at.ring_speed - 0.5 * now.slip
    after = attempt.at[2].ring_speed - 0.5 * attempt.slip[2]
    if before * after < 0.0:
        return before / (before - after)
    return 1.0


@jit_inline
def _write_samples(path, now, attempt, sample, sums, cusp, rows):
    """Write rows without weight between the stages, where power may have a peak; returns how many.

    One of them is at the part `cusp` of the step. `sample` is overwritten.
    """
    resolved = _resolved_slip(path.limits)
    filled = 0
    stage = 0
    parts = tuning.CUSP_PARTS if cusp < 1.0 else tuning.PEAK_PARTS
    # The sample nearest to a cusp lies on it.
    nearest = min(max(round(cusp * parts), 1), parts - 1) if cusp < 1.0 else 0
    for k in range(1, parts):
        part = cusp if k == nearest else k / parts
        sample_between(path, now, attempt, part, sample)
        slip = sample.slip
        if abs(slip) <= resolved:
            continue
        evaluate(path, sample.at, slip, sample.forces)
        sums.evaluations += 1
        powers(path.body, sample.at, sample.forces, slip, sample.powers[:])
        row = rows[filled]
        row.time[stage] = now.time + part * attempt.length
        row.weight[stage] = 0.0
        write_stage(row, stage, path.body, sample.at, sample.forces, slip, sample.powers[:])
        stage += 1
        frame(now, row, stage, row.time[stage - 1])
        if stage == 3:
            filled += 1
            stage = 0
    return filled + (1 if stage > 0 else 0)


@jit_inline
def _sample_peak(path, now, attempt, stretch, sample, sums, rows):
    """Sample a step in which power may have a peak.

    Returns whether the step was sampled, and how many rows were written.
    """
    cusp = 1.0
    if path.body.closed_form:
        cusp = _film_ends_at(now, attempt, _resolved_slip(path.limits))
    if cusp == 1.0 and not _may_peak_inside(path, now, attempt, stretch.zone, sums.top_power):
        return False, 0
    return True, _write_samples(path, now, attempt, sample, sums, cusp, rows)


@jit_inline
def _write_step(path, now, attempt, end, sampled, row):
    """Write an accepted step, which ends at `end` [s]; `sampled` if it was sampled for a peak."""
    frame(now, row, 3, end)
    row.sampled = 1 if sampled else 0
    for k in range(3):
        row.time[k] = end if k == 2 else attempt.times[k]
        row.weight[k] = attempt.length * attempt.weights[k]
        write_stage(
            row, k, path.body, attempt.at[k], attempt.forces[k], attempt.slip[k], attempt.powers[k]
        )


@jit_inline
def _advance(now, attempt, before, zone, sums, end):
    """Make the end of an accepted step, at `end` [s], the state of the roller."""
    top = 0.0 if zone == FREE else sums.top_power
    for k in range(3):
        top = max(top, attempt.powers[k, 0], attempt.powers[k, 1])
    sums.steps += 1
    sums.spent += attempt.energy
    sums.top_power = top
    sums.unbalanced = max(sums.unbalanced, attempt.unbalanced)
    if zone == FIRM:
        before.exponent = held_exponent(
            now.at, now.slip, attempt.at[2], attempt.slip[2], before.exponent
        )
    before.length = 0.0 if attempt.held else attempt.length
    for k in range(3):
        before.increment[k] = attempt.increment[k]
        now.powers[k] = attempt.powers[2, k]
    # A step ends in the interval it comes from, not in the next one that begins there.
    now.time = end
    now.interval = attempt.end_interval
    now.slip = attempt.slip[2]
    now.at = attempt.at[2]
    now.forces = attempt.forces[2]


@jit_inline
def _begin(path, now, before, stretch, sums, row):
    """Start at the first sample, at which no step ends: it has a row of its own."""
    sums.begun = 1
    now.time = path.motion.time[0]
    now.interval = 0
    stretch.step = min(path.limits.longest_step, tuning.FIRST_STEP)
    stretch.barrier = now.time
    stretch.zone = -1
    stretch.run_end = -1
    before.exponent = tuning.LIMIT_EXPONENT
    before.bend = math.inf
    start_at(path, now, sums)
    write_point(path, now, row)


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
    work : record of `macroslip.imposed.state.WORK`
        Zeros but for the slip at the first sample, and in later calls as the last call wrote it.
    steps : ndarray of `macroslip.roller.step.STEP`, shape (k,)
        Buffer, which is filled from the start.

    Returns
    -------
    status : int
        A `Status`; UNDER_WAY where the buffer is full.
    count : int
        Number of rows that were written.
    """
    path = Path(
        path.body,
        path.conditions,
        path.forces,
        path.tables,
        uncounted(path.flat),  # pyright: ignore[reportCallIssue]
        uncounted_motion(path.motion),
        path.start_angle,
        path.limits,
    )
    stops = uncounted(stops)  # pyright: ignore[reportCallIssue]
    classes = uncounted(classes)  # pyright: ignore[reportCallIssue]
    steps = uncounted(steps)  # pyright: ignore[reportCallIssue]
    limits = path.limits
    now = work.now
    attempt = work.attempt
    before = work.before
    stretch = work.stretch
    sample = work.sample
    sums = work.sums
    count = 0
    if sums.begun == 0:
        _begin(path, now, before, stretch, sums, steps[0])
        count = 1
    while count + _ROWS <= steps.size:
        if now.time >= stretch.barrier:
            if now.time == limits.window:
                # Errors in the window are bounded as if the history began with it.
                sums.spent = 0.0
            _next_stretch(path, stops, classes, now, stretch, sums, sample)
            if stretch.next_stop == stops.size:
                return COMPLETED, count
        if sums.steps + sums.rejections >= limits.max_steps:
            return TOO_MANY_STEPS, count
        stretch.step = min(stretch.step, limits.longest_step)
        ahead = stretch.barrier - now.time
        if ahead <= 1e-15 * abs(now.time):
            # Rounding has put the roller on the barrier.
            now.time = stretch.barrier
            continue
        length = stretch.step
        if length >= 0.95 * ahead:
            length = ahead
        elif length > 0.6 * ahead:
            length = 0.5 * ahead
        if length <= 4e-16 * abs(now.time) + 1e-300:
            return STEP_TOO_SMALL, count
        held = stretch.failed == 0 and follows_loads(path, now, stretch.zone, length)
        set_step(path, now, attempt, length, held)
        if length > tuning.CUSP_PART * limits.longest_step and attempt.held == 0:
            part = first_cusp(now, stretch.zone, attempt)
            if part < 1.0:
                stretch.step = part * length
                stretch.barrier = min(stretch.barrier, now.time + part * length)
                continue
        error = _attempt(path, now, attempt, before, stretch, sample, sums)
        if error < math.inf and not math.isfinite(attempt.energy):
            return NOT_FINITE, count
        if not error <= 1.0:
            _reject(path, now, attempt, stretch, sums, error)
            continue
        if _leaves_tables(path.body, attempt):
            return OUTSIDE_TABLES, count
        end = stretch.barrier if length == ahead else attempt.times[2]
        rows = steps[count:]
        sampled, filled = _sample_peak(path, now, attempt, stretch, sample, sums, rows)
        _write_step(path, now, attempt, end, sampled, rows[filled])
        _advance(now, attempt, before, stretch.zone, sums, end)
        count += filled + 1
        growth = 1.0 if stretch.failed else tuning.GROWTH
        stretch.step = length * min(growth, step_factor(error))
        stretch.failed = 0
    return UNDER_WAY, count
