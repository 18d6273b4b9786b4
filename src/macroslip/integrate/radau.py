"""The production integrator: Radau IIA in the slip, with error control, stepping on every edge of the load zone."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit
from macroslip.integrate.crossing import crossing
from macroslip.integrate.detail import book_stage, book_step
from macroslip.integrate.peak import follow_peak, follow_step, start_peak
from macroslip.integrate.radau_step import (
    NODES,
    WEIGHTS,
    collocation,
    energy_error,
    newton_update,
    residuals,
    slip_error,
)
from macroslip.integrate.record import add_energy, note_state, orbit_at, powers, raise_peak, write_trace
from macroslip.integrate.status import COMPLETED, NOT_FINITE, STEP_TOO_SMALL, TOO_MANY_STEPS
from macroslip.roller.contact_force import (
    LIMIT_EXPONENT,
    held_exponent,
    held_slip,
    slip_variation,
    slips_everywhere,
    steady_slip,
)
from macroslip.roller.forces import shifted, slip_forces, station
from macroslip.roller.load_zone import EDGE, FIRM, FREE, classify, edge_time
from macroslip.roller.orbit import instant, interval_of

#: Largest part of an orbit turned in one step [rad], so that no step sees gravity's direction only where it is alike.
_LONGEST_TURN = 0.6
#: First step after entering an edge of the load zone [s].
_EDGE_STEP = 1e-3
_NEWTON_ITERATIONS = 12
#: Part of the sum of force magnitudes that may stay unbalanced at a stage.
_FORCE_TOLERANCE = 1e-9
#: The same with microslip, whose power does not hang on the balance of two large forces: half of the tolerance asked for,
#: and at most this.
_MICROSLIP_FORCE_SHARE, _MICROSLIP_FORCE_TOLERANCE = 0.5, 1e-4
#: Parts of the tolerance that a step may spend on slip and on energy. Slip is remembered along a coast and adds up;
#: errors of energy are of either sign and its estimate is of low order, hence far too large.
_SLIP_SHARE, _ENERGY_SHARE = 0.1, 10.0
#: Safety factor on the step that the error asks for, and most growth of a step.
_SAFETY, _GROWTH = 0.8, 5.0
#: Change of slip, as part of the raceway speed, up to which a firmly held roller counts as settled.
_SETTLED = 1e-6
#: Part of a sample interval below which energy is not controlled more finely.
_SHORT_PART = 0.05
#: Parts of a step between the stages at which the equation's defect is looked at, and its weight as an error.
_DEFECT_NODES = (0.83, 0.4)
_DEFECT_WEIGHT = 0.25
#: Parts into which a step is divided to find a peak of power in it, and how many slip tolerances a slip between stages
#: must be for the power there to be meaningful.
_PEAK_PARTS, _RESOLVED = 10, 3.0
#: Part of the longest step above which steps end on the cusps of light contacts.
_CUSP_PART = 0.03
#: Largest relative change of slip in a step taken where traction may fall with slip.
_HOT_CHANGE = 0.2
#: Weight of the step over the relaxation time at its end by which an error of slip with microslip counts less.
_FORGOTTEN = 1.0
#: Part of the sum of force magnitudes that is unbalanced where a roller with microslip is not at its balance.
_ASTRAY = 0.1
#: Step over relaxation time from which on a roller with microslip is taken to follow its loads, for a first guess.
_GRIPPED = 10.0
#: Safety factor on the residual foreseen from the curvature of the forces in earlier steps, and what is left of that
#: curvature when a newer one is smaller.
_BEND_SAFETY, _FORGET = 10.0, 0.7


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
    longest_step: float
    cold_slip: float
    firm: float


@jit
def _surely_rising(model, at, at1, at2, at3, slip):
    """Slip up to which traction rises at both raceways for every load met in a step [m/s]; `slip` is the largest there."""
    inner = max(at.inner_load, at1.inner_load, at2.inner_load, at3.inner_load)
    outer = max(at.outer_load, at1.outer_load, at2.outer_load, at3.outer_load)
    ring = max(abs(at.ring_speed), abs(at3.ring_speed))
    return rising_at(model, inner, outer, ring, ring + 0.5 * abs(slip))


@jit
def rising_at(model, inner_load, outer_load, ring_speed, entrainment_speed):
    """Slip up to which traction rises at both raceways at the given loads [N] and speeds [m/s]."""
    inner = steady_slip(
        model.inner, inner_load, entrainment_speed, slip_variation(model.inner, inner_load, ring_speed)
    )
    outer = steady_slip(
        model.outer, outer_load, entrainment_speed, slip_variation(model.outer, outer_load, ring_speed)
    )
    return min(inner, outer)


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
    p_inner, p_outer, p_cage = powers(model, at, forces, slip)
    step = min(limits.longest_step, 1e-2)
    spent, next_stop, next_trace = 0.0, 0, 0
    evaluations, steps, rejections = 1, 0, 0
    peaks = np.empty((2, 4))
    start_peak(peaks, time, p_inner, p_outer, p_cage)
    top_power, last_orbit = 0.0, -1
    status = COMPLETED
    barrier = time
    zone = -1
    failed_before = False
    sample_step = 0.0
    # With microslip the slip of a held roller hardly changes with the shaft's acceleration, and power does not jump.
    jumps = not slips_everywhere(model.inner)
    force_tolerance = _FORCE_TOLERANCE
    if not jumps:
        force_tolerance = max(force_tolerance, min(_MICROSLIP_FORCE_SHARE * limits.tolerance, _MICROSLIP_FORCE_TOLERANCE))
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
                while last < classes.size - 1 and classes[last + 1] == zone and motion.time[last + 1] < stops[next_stop]:
                    last += 1
            barrier = min(motion.time[last + 1], stops[next_stop])
            if jumps and at.interference > limits.firm and time == motion.time[interval]:
                balanced = _rebalanced(model, motion, interval, at, slip)
                evaluations += 3
                # A roller that still skids, or has not settled yet, goes its own way.
                if abs(balanced - slip) < _SETTLED * limits.speed_scale:
                    slip = balanced
                    forces = slip_forces(model, at, slip)
                    p_inner, p_outer, p_cage = powers(model, at, forces, slip)
                    evaluations += 1
            # Loads have a kink at every sample; no parabola for a peak should reach across it.
            start_peak(peaks, time, p_inner, p_outer, p_cage)
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
        # Traction of a contact whose load passes through zero has a cusp there; a long step ends on it. At the cage it
        # is foreseen with the traction at the start, whose change is small against the roller's weight.
        if h > _CUSP_PART * limits.longest_step:
            held = forces.cage_load - at.tangential
            part = crossing(
                at.tangential + held, at1.tangential + held, at2.tangential + held, at3.tangential + held
            )
            if zone == FREE:
                part = min(part, crossing(_lean(at), _lean(at1), _lean(at2), _lean(at3)))
            if part < 1.0:
                step = part * h
                barrier = min(barrier, time + step)
                continue
        d1 = at1.ring_speed - at.ring_speed
        d2 = at2.ring_speed - at.ring_speed
        d3 = at3.ring_speed - at.ring_speed
        total = forces.inner + forces.outer + forces.cage
        drift = -model.mobility * total if model.mobility * forces.slope * h < 1.0 and zone != EDGE else 0.0
        v1 = slip + d1 + drift * NODES[0] * h if drift != 0.0 else slip
        v2 = slip + d2 + drift * NODES[1] * h if drift != 0.0 else slip
        v3 = slip + d3 + drift * h if drift != 0.0 else slip
        if zone == FIRM or (not jumps and model.mobility * forces.slope * h > _GRIPPED and at3.elastic_load > 0.0):
            v1 = held_slip(model.inner, v1, at, at1, exponent)
            v2 = held_slip(model.inner, v2, at, at2, exponent)
            v3 = held_slip(model.inner, v3, at, at3, exponent)
        scale = 1.0 / (h * model.mobility)
        converged = False
        unbalanced = math.inf
        f1, f2, f3 = forces, forces, forces
        for iteration in range(_NEWTON_ITERATIONS):
            f1 = slip_forces(model, at1, v1)
            f2 = slip_forces(model, at2, v2)
            f3 = slip_forces(model, at3, v3)
            evaluations += 3
            s1, s2, s3 = v1 - slip - d1, v2 - slip - d2, v3 - slip - d3
            rest = residuals(
                scale, s1, s2, s3, f1.inner + f1.outer + f1.cage, f2.inner + f2.outer + f2.cage, f3.inner + f3.outer + f3.cage
            )
            round_off = 4e-15 * scale * (limits.speed_scale + abs(slip))
            size = max(abs(rest.first), abs(rest.second), abs(rest.third))
            if (
                abs(rest.first) <= force_tolerance * _magnitude(f1) + round_off
                and abs(rest.second) <= force_tolerance * _magnitude(f2) + round_off
                and abs(rest.third) <= force_tolerance * _magnitude(f3) + round_off
            ):
                converged = True
                unbalanced = size
                break
            if not math.isfinite(size) or (iteration > 2 and size > 0.9 * unbalanced):
                break
            # Newton's residuals shrink quadratically: the next one is foreseen from the last two, and where it is
            # small enough the forces follow to first order, without another evaluation.
            # A held roller's forces bend from step to step in the same way, so the first residual is enough.
            held = zone == FIRM and not jumps
            if iteration > 0:
                foreseen = size * size / unbalanced
                if held and iteration == 1:
                    bend = max(size / (unbalanced * unbalanced), _FORGET * bend if bend < math.inf else 0.0)
            else:
                foreseen = _BEND_SAFETY * bend * size * size if held else math.inf
            unbalanced = size
            u1, u2, u3 = newton_update(scale, f1.slope, f2.slope, f3.slope, rest)
            v1 += u1
            v2 += u2
            v3 += u3
            if foreseen <= force_tolerance * min(_magnitude(f1), _magnitude(f2), _magnitude(f3)) + round_off:
                f1, f2, f3 = shifted(f1, u1), shifted(f2, u2), shifted(f3, u3)
                s1, s2, s3 = v1 - slip - d1, v2 - slip - d2, v3 - slip - d3
                converged = True
                unbalanced = foreseen
                break
        if converged:
            # More than one root is possible only where traction falls with slip faster than the step allows.
            least = min(f1.slope, f2.slope, f3.slope)
            largest = max(abs(slip), abs(v1), abs(v2), abs(v3))
            if least < -0.5 * scale:
                converged = False
            elif largest > limits.cold_slip and largest > _surely_rising(model, at, at1, at2, at3, largest):
                change = max(abs(v1 - slip), abs(v2 - slip), abs(v3 - slip))
                converged = change <= _HOT_CHANGE * abs(slip) + 1e-6 * limits.speed_scale
        if not converged:
            rejections += 1
            failed_before = True
            step = 0.25 * h
            barrier = min(barrier, _sample_after(motion, interval, time, step))
            continue
        least = max(min(forces.slope, f1.slope, f2.slope, f3.slope), 0.0)
        # A held roller's slip is the balance of the instant, solved for at the end of the step; nothing is remembered.
        slip_off = slip_error(scale, least, total, s1, s2, s3) if jumps or zone != FIRM else 0.0
        if zone != FIRM:
            # The embedded estimate may vanish by accident, most of all where grip does so between two stages.
            for check in range(2 if zone == EDGE else 1):
                part = _DEFECT_NODES[check]
                increment, rate = collocation(part, s1, s2, s3)
                when = time + part * h
                there = station(model, start_angle, instant(motion, interval_of(motion, when, interval), when))
                between = slip + there.ring_speed - at.ring_speed + increment
                push = slip_forces(model, there, between)
                defect = rate + h * model.mobility * (push.inner + push.outer + push.cage)
                grip = h * model.mobility * abs(push.slope)
                slip_off = max(abs(slip_off), _DEFECT_WEIGHT * abs(defect) / (1.0 + grip))
                evaluations += 1
        if not jumps:
            # Slip that the next step forgets need not be known so well.
            slip_off /= 1.0 + _FORGOTTEN * h * model.mobility * max(f3.slope, 0.0)
        i1, o1, c1 = powers(model, at1, f1, v1)
        i2, o2, c2 = powers(model, at2, f2, v2)
        i3, o3, c3 = powers(model, at3, f3, v3)
        energy_off = energy_error(h, p_inner + p_outer + p_cage, i1 + o1 + c1, i2 + o2 + c2, i3 + o3 + c3)
        e_inner = h * (WEIGHTS[0] * i1 + WEIGHTS[1] * i2 + WEIGHTS[2] * i3)
        e_outer = h * (WEIGHTS[0] * o1 + WEIGHTS[1] * o2 + WEIGHTS[2] * o3)
        e_cage = h * (WEIGHTS[0] * c1 + WEIGHTS[1] * c2 + WEIGHTS[2] * c3)
        e_step = e_inner + e_outer + e_cage
        if not math.isfinite(e_step):
            status = NOT_FINITE
            break
        mean_power = (spent + e_step) / (t3 - motion.time[0])
        error = abs(slip_off) / (_SLIP_SHARE * limits.tolerance * limits.speed_scale + 1e-300)
        # Power jumps with the shaft's acceleration at every sample; what it does in a short part of a sample interval
        # may be off by what is allowed in that part.
        share = max(h, _SHORT_PART * sample_step)
        error = max(error, abs(energy_off) / (_ENERGY_SHARE * limits.tolerance * max(mean_power * share, e_step) + 1e-300))
        factor = _SAFETY / math.sqrt(math.sqrt(max(error, 1e-8)))
        if error > 1.0:
            rejections += 1
            failed_before = True
            step = h * max(0.2, factor)
            barrier = min(barrier, _sample_after(motion, interval, time, step))
            continue
        steps += 1
        spent += e_step
        if time >= record.edges[0]:
            orbit = orbit_at(record, 0.5 * (time + t3), last_orbit)
            add_energy(record, orbit, e_inner, e_outer, e_cage)
            raceways = max(i1, i2, i3, o1, o2, o3)
            sliding = max(_sliding(f1, v1), _sliding(f2, v2), _sliding(f3, v3))
            if orbit != last_orbit:
                top_power, last_orbit = 0.0, orbit
                raise_peak(record, orbit, 0, p_inner)
                raise_peak(record, orbit, 1, p_outer)
                raise_peak(record, orbit, 2, p_cage)
            resolved = _RESOLVED * _SLIP_SHARE * limits.tolerance * limits.speed_scale
            # A gripped roller with microslip slips less where load decreases, without a snap.
            astray = jumps or at.elastic_load <= 0.0 or abs(total) > _ASTRAY * _magnitude(forces)
            snapping = astray and abs(slip) > resolved and abs(v3) < 0.7 * abs(slip)
            if zone == EDGE and (snapping or sliding > 0.5 * top_power):
                # A roller may just be snapping back; the peak lies between stages.
                for part_of_peak in range(1, _PEAK_PARTS + 1):
                    when = time + h * part_of_peak / _PEAK_PARTS
                    increment, _ = collocation(part_of_peak / _PEAK_PARTS, s1, s2, s3)
                    there = station(model, start_angle, instant(motion, interval, when))
                    between = slip + there.ring_speed - at.ring_speed + increment
                    if abs(between) > resolved:
                        i, o, c = powers(model, there, slip_forces(model, there, between), between)
                        follow_peak(record, orbit, peaks, when, i, o, c)
                    evaluations += 1
            else:
                follow_step(
                    record,
                    orbit,
                    peaks,
                    (p_inner, p_outer, p_cage),
                    (t1, t2, t3),
                    (i1, i2, i3),
                    (o1, o2, o3),
                    (c1, c2, c3),
                )
            top_power = max(top_power, raceways)
            note_state(record, model, at3, f3, v3, h)
            book_stage(record, model, at1, f1, v1, h * WEIGHTS[0])
            book_stage(record, model, at2, f2, v2, h * WEIGHTS[1])
            book_stage(record, model, at3, f3, v3, h * WEIGHTS[2])
            book_step(record, model, at3, f3, v3, h, orbit, e_inner, e_outer, steps)
        record.worst[0] = max(record.worst[0], unbalanced)
        time = barrier if h == left else t3
        interval = k3
        if zone == FIRM:
            exponent = held_exponent(at, slip, at3, v3, exponent)
        slip, at, forces = v3, at3, f3
        p_inner, p_outer, p_cage = i3, o3, c3
        step = h * min(1.0 if failed_before else _GROWTH, factor)
        failed_before = False
    record.count[0], record.count[1], record.count[2] = steps, rejections, evaluations
    record.end[0], record.end[1] = time, slip
    return status


@jit
def _sample_after(motion, interval, time, step):
    """The end of the sample interval if steps have become so short that they should not cross it; else infinity."""
    if step > 2.0 * (motion.time[interval + 1] - motion.time[interval]):
        return math.inf
    return motion.time[interval + 1]


@jit
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


@jit
def _lean(at):
    """Body force along the contact normal, positive outward [N]."""
    return at.outer_load - at.inner_load


@jit
def _sliding(forces, slip):
    """Larger power of sliding of the middle at the raceways [W]: all of it without microslip."""
    return max(abs(forces.inner), abs(forces.outer)) * abs(slip)


@jit
def _magnitude(forces):
    return abs(forces.inner) + abs(forces.outer) + abs(forces.cage)


def longest_step(motion, orbit_ratio: float) -> float:
    """Longest step [s]: a fraction of an orbit at the highest speed, or a tenth of the history if the shaft hardly turns."""
    span = float(motion.time[-1] - motion.time[0])
    fastest = abs(orbit_ratio) * float(np.max(np.abs(motion.shaft_speed)))
    return min(0.1 * span, _LONGEST_TURN / fastest) if fastest > 0.0 else 0.1 * span
