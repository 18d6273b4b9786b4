"""The integration of the whole bearing: step after step, their errors, what is due, and what is booked."""

from __future__ import annotations

import math

import numpy as np

from macroslip.compiled import jit, jit_merged
from macroslip.integrate.status import COMPLETED, INTERRUPTED, NOT_FINITE, STEP_TOO_SMALL, TOO_MANY_STEPS
from macroslip.reference import by_reference
from macroslip.ring.orbit import instant
from macroslip.whole_bearing.detail import book_details, collect
from macroslip.whole_bearing.ledger import book_flows
from macroslip.whole_bearing.record import book_stage, book_state, stage_powers, write_output
from macroslip.whole_bearing.refresh import refresh
from macroslip.whole_bearing.station import locate
from macroslip.whole_bearing.step import GAMMA, Clock, clock_at, step_error, take_step
from macroslip.whole_bearing.traction import evaluate_marked
from macroslip.whole_bearing.tuning import BEGUN, FIRST_STEP, GROWTH, IMPACT_PART, LEAST_PART, SAFETY, UNSOLVED_PART

#: Positions in the record's counts.
_STEPS, _REJECTIONS, _EVALUATIONS, _ITERATIONS, _REFRESHED, _UNSOLVED, _INACCURATE, _UNPREDICTED = range(8)


@jit_merged
def _begin(bearing, motion, space):
    """Evaluate the start. Returns the clock."""
    moment, tractions = space.last, space.tractions
    moment.values.rollers[:] = space.state.rollers
    moment.values.cages[:] = space.state.cages
    time = motion.time[0]
    shaft_speed = locate(bearing, motion, 0, time, moment.values.rollers, moment.values.cages, moment.stations)
    tractions.marked[:] = True
    space.work[0] += evaluate_marked(
        bearing, moment.stations, time, moment.values.rollers, tractions.marked, tractions.known
    )
    stage_powers(bearing, moment, tractions.known)
    return Clock(time, 0, shaft_speed)


@jit_merged
def _touch_ahead(bearing, space, h):
    """Part of `h` [s] after which the first roller meets a spar, if it is free now; 1 if none does."""
    half = bearing.pocket.half_gap
    part = 1.0
    for j in range(space.state.rollers.shape[0]):
        offset, speed = space.state.rollers[j, 2], space.slope.rollers[j, 2]
        if abs(offset) < half and speed != 0.0:
            way = half - offset if speed > 0.0 else half + offset
            part = min(part, way / (abs(speed) * h))
    return part


@jit_merged
def _impact_step(bearing, space):
    """First step [s] of the fastest dry impact that has just begun; infinite if none has.

    A mass m that runs at v into K δ^1.5 goes in by (5 m v²/4K)^0.4; the step is the time in which it travels a part of
    that.
    """
    half, shortest = bearing.pocket.half_gap, math.inf
    for j in range(space.state.rollers.shape[0]):
        offset, speed = space.state.rollers[j, 2], space.slope.rollers[j, 2]
        depth = abs(offset) - half
        if depth > 0.0 and offset * speed > 0.0:
            deepest = (1.25 * bearing.roller_mass * speed * speed / bearing.pocket.stiffness) ** 0.4
            if depth < BEGUN * deepest:
                shortest = min(shortest, IMPACT_PART * deepest / abs(speed))
    return shortest


@jit_merged
def _cut(bearing, space, step, left):
    """Step [s] to the next stop or half-way to it.

    With dry impacts to just after a touch, so that the impact begins in the step after, which is as short as it needs.
    """
    if bearing.pocket.film == 0.0:
        step = min(step, _impact_step(bearing, space))
    h = left if step >= 0.95 * left else (0.5 * left if step > 0.6 * left else step)
    if bearing.pocket.film == 0.0:
        part = _touch_ahead(bearing, space, h)
        if part * h > 2e-5 and part < 0.98:
            h = 1.0005 * part * h
    return h


@jit_merged
def _raceway_energy(space, h):
    """Energy [J] that the raceway contacts of all rollers dissipate in a step."""
    energy = 0.0
    for j in range(space.state.rollers.shape[0]):
        for i in range(2):
            energy += h * ((1.0 - GAMMA) * space.first.powers[j, i, 0] + GAMMA * space.last.powers[j, i, 0])
    return energy


@jit
def _orbit_of(edges, time, likely):
    """Index of the orbit that holds `time`, or −1."""
    if time < edges[0] or time >= edges[-1]:
        return -1
    k = max(likely, 0)
    while k < edges.size - 2 and time >= edges[k + 1]:
        k += 1
    return k


@jit_merged
def _book(bearing, motion, middle_speed, start, end, orbit, space, record):
    """Book a step. Returns its orbit."""
    h = end.time - start.time
    if start.time >= record.edges[0]:
        orbit = _orbit_of(record.edges, 0.5 * (start.time + end.time), orbit)
        book_stage(space.first, h * (1.0 - GAMMA), orbit, record)
        book_stage(space.last, h * GAMMA, orbit, record)
        book_state(bearing, end.shaft_speed, space.last, h, record)
        collect(bearing, space.first, space.last, start.time, h, GAMMA, record.details)
        angle = instant(motion, end.interval, end.time).shaft_angle
        book_details(bearing, space.last, space.tractions.due, angle, end.time, orbit, record.details)
    book_flows(bearing, middle_speed, space.first, h * (1.0 - GAMMA), record.book)
    book_flows(bearing, end.shaft_speed, space.last, h * GAMMA, record.book)
    return orbit


@jit_merged
def _advance(space):
    """Take over state, slopes and evaluations of an accepted step."""
    tractions = space.tractions
    for j in range(tractions.due.size):
        if tractions.due[j]:
            tractions.known[j] = tractions.sheets[j]
    space.state.rollers[:] = space.last.values.rollers
    space.state.cages[:] = space.last.values.cages
    space.slope.rollers[:] = space.last_rate.rollers
    space.slope.cages[:] = space.last_rate.cages


@jit
def integrate_whole(bearing, motion, stops, limits, space, record):
    """Integrate all rollers and cages over the whole history.

    Parameters
    ----------
    bearing : WholeBearing
    motion : Motion
    stops : ndarray
        Times at which a step must end [s], rising, the last being the end of the integration; they hold the record's edges
        and output times.
    limits : BearingLimits
    space : Space
        With the initial state in `state`.
    record : BearingRecord
        Filled.

    Returns
    -------
    int
        A `Status`.
    """
    bearing, motion, limits = by_reference(bearing), by_reference(motion), by_reference(limits)
    stops, space, record = by_reference(stops), by_reference(space), by_reference(record)
    count = record.count
    clock, step, failed = _begin(bearing, motion, space), FIRST_STEP, False
    next_stop, next_output, orbit = 0, 0, -1
    spent, status = 0.0, COMPLETED
    while True:
        while next_output < record.out_time.size and record.out_time[next_output] <= clock.time:
            write_output(bearing, next_output, clock.shaft_speed, space.last, record)
            next_output += 1
        while next_stop < stops.size and stops[next_stop] <= clock.time:
            next_stop += 1
        if next_stop == stops.size:
            break
        if limits.interrupt[0] != 0:
            status = INTERRUPTED
            break
        if count[_STEPS] + count[_REJECTIONS] >= limits.max_steps:
            status = TOO_MANY_STEPS
            break
        left = stops[next_stop] - clock.time
        h = _cut(bearing, space, min(step, limits.longest_step), left)
        if h <= 4e-16 * abs(clock.time) + 1e-300:
            status = STEP_TOO_SMALL
            break
        end = clock_at(motion, stops[next_stop] if h == left else clock.time + h, clock.interval)
        worst, solved = take_step(bearing, motion, limits, clock, end, space)
        error = step_error(bearing, limits, h, space) if solved else math.inf
        if np.isnan(error) or (not worst < math.inf and h < 1e-12):
            status = NOT_FINITE
            break
        factor = SAFETY / max(error, 1e-4) ** (1.0 / 3.0)
        if error > 1.0:
            count[_REJECTIONS] += 1
            count[_INACCURATE if solved else _UNSOLVED] += 1
            step = h * (max(LEAST_PART, factor) if solved else UNSOLVED_PART)
            failed = True
            continue
        power_scale = max(spent, 0.0) / (end.time - motion.time[0]) / (2 * space.state.rollers.shape[0])
        if not refresh(bearing, limits, end.time, space, power_scale):
            count[_REJECTIONS] += 1
            count[_UNPREDICTED] += 1
            step = h
            continue
        count[_STEPS] += 1
        record.worst[0] = max(record.worst[0], worst)
        spent += _raceway_energy(space, h)
        middle = clock_at(motion, clock.time + GAMMA * h, clock.interval)
        orbit = _book(bearing, motion, middle.shaft_speed, clock, end, orbit, space, record)
        _advance(space)
        clock, step, failed = end, h * min(1.0 if failed else GROWTH, factor), False
    # What has not been spread yet is, as power lies at the end.
    space.tractions.due[:] = True
    angle = instant(motion, clock.interval, clock.time).shaft_angle
    book_details(bearing, space.last, space.tractions.due, angle, clock.time, orbit, record.details)
    count[_EVALUATIONS], count[_ITERATIONS], count[_REFRESHED] = space.work[0], space.work[1], space.work[2]
    record.end[0] = clock.time
    record.end_slip[:] = 0.5 * (space.state.rollers[:, 0] + space.state.rollers[:, 1])
    return status
