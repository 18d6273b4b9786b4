"""The production integrator: Radau IIA in the slip, with error control, stepping on every edge of the load zone."""

from __future__ import annotations

import math

import numpy as np

from macroslip.compiled import jit, jit_part
from macroslip.integrate.booking import book_details, book_energy, book_peaks, step_powers
from macroslip.integrate.peak import start_peak
from macroslip.integrate.radau_step import NODES, energy_error, slip_error
from macroslip.integrate.record import orbit_at, powers, write_trace
from macroslip.integrate.root import is_continuous
from macroslip.integrate.stages import force_tolerance, solve_stages
from macroslip.integrate.status import COMPLETED, NOT_FINITE, STEP_TOO_SMALL, TOO_MANY_STEPS
from macroslip.integrate.step_control import defect_error, error_ratio, first_cusp, sample_after, step_factor
from macroslip.ring.load_zone import EDGE, FIRM, FREE, classify, edge_time
from macroslip.ring.orbit import instant, interval_of
from macroslip.roller.forces import net_force, slip_forces, station
from macroslip.roller.held_contact import LIMIT_EXPONENT, held_exponent, held_slip, slips_everywhere

#: First step of the history and first step after entering an edge of the load zone [s].
_FIRST_STEP, _EDGE_STEP = 1e-2, 1e-3
#: Most growth of a step, its least part after an error, and its part after stages that were not solved.
_GROWTH, _LEAST_PART, _UNSOLVED_PART = 5.0, 0.2, 0.25
#: Change of slip, as part of the raceway speed, up to which a firmly held roller counts as settled.
_SETTLED = 1e-6
#: Part of the longest step above which steps end on the cusps of light contacts.
_CUSP_PART = 0.03
#: Weight of the step over the relaxation time at its end by which an error of slip with microslip counts less.
_FORGOTTEN = 1.0
#: Step over relaxation time from which on a roller with microslip is taken to follow its loads, for a first guess.
_GRIPPED = 10.0


@jit
def integrate_radau(model, motion, start_angle, slip, stops, limits, classes, record):
    """Integrate the slip of one roller over the whole history.

    Parameters
    ----------
    model : RollerModel
    motion : Motion
    start_angle : float
        Position φ at the first sample [rad].
    slip : float
        Slip at the first sample [m/s].
    stops : ndarray
        Times at which a step must end [s], rising, the last being the end of the integration.
    limits : Limits
    classes : ndarray of int8, shape (n − 1,)
        Work space for the classes of sample intervals.
    record : Record
        Filled.

    Returns
    -------
    int
        A `Status`.
    """
    classify(model, motion, start_angle, limits.firm, classes)
    time = motion.time[0]
    interval = 0
    at = station(model, start_angle, instant(motion, 0, time))
    forces = slip_forces(model, at, slip)
    before = powers(model, at, forces, slip)
    step = min(limits.longest_step, _FIRST_STEP)
    spent, next_stop, next_trace = 0.0, 0, 0
    evaluations, steps, rejections = 1, 0, 0
    peaks = np.empty((2, 4))
    start_peak(peaks, time, before[0], before[1], before[2])
    top_power, last_orbit = 0.0, -1
    status = COMPLETED
    barrier = time
    zone = -1
    failed_before = False
    sample_step = 0.0
    # With microslip the slip of a held roller hardly changes with the shaft's acceleration, and power does not jump.
    jumps = not slips_everywhere(model.inner)
    force_part = force_tolerance(limits.tolerance, not jumps)
    exponent, bend = LIMIT_EXPONENT, math.inf
    while True:
        while next_trace < record.trace_time.size and record.trace_time[next_trace] <= time:
            write_trace(record, model, next_trace, at, forces, slip)
            next_trace += 1
        if time >= barrier:
            while next_stop < stops.size and stops[next_stop] <= time:
                next_stop += 1
            if next_stop == stops.size:
                break
            interval = interval_of(motion, time, interval)
            was = zone
            zone = classes[interval]
            last = interval
            sample_step = motion.time[interval + 1] - motion.time[interval]
            if zone != EDGE and step > 2.0 * sample_step and (jumps or zone != FIRM):
                while (
                    last < classes.size - 1 and classes[last + 1] == zone and motion.time[last + 1] < stops[next_stop]
                ):
                    last += 1
            barrier = min(motion.time[last + 1], stops[next_stop])
            if jumps and at.interference > limits.firm and time == motion.time[interval]:
                balanced = _rebalanced(model, motion, interval, at, slip)
                evaluations += 3
                # A roller that still skids, or has not settled yet, goes its own way.
                if abs(balanced - slip) < _SETTLED * limits.speed_scale:
                    slip = balanced
                    forces = slip_forces(model, at, slip)
                    before = powers(model, at, forces, slip)
                    evaluations += 1
            # Loads have a kink at every sample; no parabola for a peak should reach across it.
            start_peak(peaks, time, before[0], before[1], before[2])
            if zone == EDGE:
                barrier = edge_time(model, motion, start_angle, interval, time, barrier)
                if was != EDGE:
                    step = min(step, _EDGE_STEP)
        if steps + rejections >= limits.max_steps:
            status = TOO_MANY_STEPS
            break
        step = min(step, limits.longest_step)
        left = barrier - time
        if left <= 1e-15 * abs(time):
            # Rounding has put the state on the barrier.
            time = barrier
            continue
        h = left if step >= 0.95 * left else (0.5 * left if step > 0.6 * left else step)
        if h <= 4e-16 * abs(time) + 1e-300:
            status = STEP_TOO_SMALL
            break
        t1, t2, t3 = time + NODES[0] * h, time + NODES[1] * h, time + h
        k1 = interval_of(motion, t1, interval)
        k2 = interval_of(motion, t2, k1)
        # A step ends in the interval it comes from, not in the next one that begins there.
        k3 = interval_of(motion, t3, k2)
        at1 = station(model, start_angle, instant(motion, k1, t1))
        at2 = station(model, start_angle, instant(motion, k2, t2))
        at3 = station(model, start_angle, instant(motion, k3, t3))
        if h > _CUSP_PART * limits.longest_step:
            part = first_cusp(forces, zone == FREE, at, at1, at2, at3)
            if part < 1.0:
                step = part * h
                barrier = min(barrier, time + step)
                continue
        scale = 1.0 / (h * model.mobility)
        gripped = model.mobility * forces.slope * h
        follows = zone == FIRM or (not jumps and gripped > _GRIPPED and at3.elastic_load > 0.0)
        drifts = gripped < 1.0 and zone != EDGE
        v1, v2, v3 = _first_guess(model, h, slip, forces, at, at1, at2, at3, drifts, follows, exponent)
        held = zone == FIRM and not jumps
        stages = solve_stages(
            model, limits.speed_scale, force_part, scale, slip, forces, at, at1, at2, at3, v1, v2, v3, held, bend
        )
        evaluations += stages.evaluations
        bend = stages.bend
        if not stages.converged or not is_continuous(model, limits, scale, slip, at, at1, at2, at3, stages):
            rejections += 1
            failed_before = True
            step = _UNSOLVED_PART * h
            barrier = min(barrier, sample_after(motion, interval, time, step))
            continue
        slip_off = 0.0
        if not held:
            # A held roller's slip is the balance of the instant, solved for at the end of the step.
            least = max(min(forces.slope, stages.f1.slope, stages.f2.slope, stages.f3.slope), 0.0)
            slip_off = abs(slip_error(scale, least, net_force(forces), stages.s1, stages.s2, stages.s3))
        if zone != FIRM:
            looks = 2 if zone == EDGE else 1
            defect = defect_error(model, motion, start_angle, interval, time, h, slip, at, stages, looks)
            slip_off = max(slip_off, defect)
            evaluations += looks
        if not jumps:
            # Slip that the next step forgets need not be known so well.
            slip_off /= 1.0 + _FORGOTTEN * h * model.mobility * max(stages.f3.slope, 0.0)
        found = step_powers(model, h, at1, at2, at3, stages)
        energy = found.inner_energy + found.outer_energy + found.cage_energy
        if not math.isfinite(energy):
            status = NOT_FINITE
            break
        energy_off = energy_error(
            h,
            before[0] + before[1] + before[2],
            found.inner[0] + found.outer[0] + found.cage[0],
            found.inner[1] + found.outer[1] + found.cage[1],
            found.inner[2] + found.outer[2] + found.cage[2],
        )
        mean_power = (spent + energy) / (t3 - motion.time[0])
        error = error_ratio(limits, slip_off, energy_off, energy, mean_power, h, sample_step)
        factor = step_factor(error)
        if error > 1.0:
            rejections += 1
            failed_before = True
            step = h * max(_LEAST_PART, factor)
            barrier = min(barrier, sample_after(motion, interval, time, step))
            continue
        steps += 1
        spent += energy
        if time >= record.edges[0]:
            orbit = orbit_at(record, 0.5 * (time + t3), last_orbit)
            book_energy(record, orbit, orbit != last_orbit, before, found)
            if orbit != last_orbit:
                top_power, last_orbit = 0.0, orbit
            evaluations += book_peaks(
                record, model, motion, start_angle, interval, limits, time, h, slip, at, forces, stages, (t1, t2, t3),
                before, found, orbit, peaks, top_power, zone == EDGE, jumps,
            )  # fmt: skip
            top_power = max(top_power, max(found.inner), max(found.outer))
            book_details(record, model, h, orbit, steps, at1, at2, at3, stages, found)
        record.worst[0] = max(record.worst[0], stages.unbalanced)
        time = barrier if h == left else t3
        interval = k3
        if zone == FIRM:
            exponent = held_exponent(at, slip, at3, stages.v3, exponent)
        slip, at, forces = stages.v3, at3, stages.f3
        before = found.inner[2], found.outer[2], found.cage[2]
        step = h * min(1.0 if failed_before else _GROWTH, factor)
        failed_before = False
    record.count[0], record.count[1], record.count[2] = steps, rejections, evaluations
    record.end[0], record.end[1] = time, slip
    return status


@jit_part
def _first_guess(model, h, slip, forces, at, at1, at2, at3, drifts, follows, exponent):
    """Slip at the stages [m/s] to start Newton's iteration from.

    That of a roller which `drifts` under small forces, changed as the forces at the start say; that of one stuck to the
    cage, which keeps its spin; else the slip before the step; then, for one that `follows` its loads, what `held_slip` makes of it.
    """
    v1, v2, v3 = slip, slip, slip
    if drifts:
        drift = -model.mobility * net_force(forces)
        v1 = slip + (at1.ring_speed - at.ring_speed) + drift * NODES[0] * h
        v2 = slip + (at2.ring_speed - at.ring_speed) + drift * NODES[1] * h
        v3 = slip + (at3.ring_speed - at.ring_speed) + drift * h
    elif forces.slope > 2.0 * (forces.inner_slope + forces.outer_slope):
        # What holds the roller is the cage: its spin stays as it is, at zero.
        v1 = slip + (at1.ring_speed - at.ring_speed)
        v2 = slip + (at2.ring_speed - at.ring_speed)
        v3 = slip + (at3.ring_speed - at.ring_speed)
    if follows:
        v1 = held_slip(model.inner, v1, at, at1, exponent)
        v2 = held_slip(model.inner, v2, at, at2, exponent)
        v3 = held_slip(model.inner, v3, at, at3, exponent)
    return v1, v2, v3


@jit_part
def _rebalanced(model, motion, interval, at, slip):
    """Slip of a firmly held roller just after a sample, where the shaft's acceleration changes at once.

    The transition takes the relaxation time, for which `firm_interference` gives a bound; here it takes none.
    """
    speed_change = motion.shaft_speed[interval + 1] - motion.shaft_speed[interval]
    acceleration = speed_change / (motion.time[interval + 1] - motion.time[interval])
    needed = -model.orbit_ratio * model.outer_radius * acceleration / model.mobility
    for _ in range(3):
        forces = slip_forces(model, at, slip)
        slip += (needed - forces.inner - forces.outer - forces.cage) / forces.slope
    return slip
