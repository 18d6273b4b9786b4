"""Load classes of the sample intervals: without load, at the edge of the load zone, firmly held.

No step of an integrator can pass over a load zone or over its edge. Every interval between load
samples belongs to one of three classes. `FREE`: no elastic load throughout; only the smooth body
forces act. `FIRM`: so much load throughout that slip relaxes within a small part of a millisecond;
the slip then follows the instant's balance of forces. `EDGE`: anything else; here steps must end at
samples and at the instant the load begins or ends.
"""

from __future__ import annotations

import math

from macroslip.compiled import jit, jit_inline
from macroslip.contact.look_up import contact_load, contact_speeds
from macroslip.elementary import cosine_and_sine
from macroslip.imposed import tuning
from macroslip.mechanics.elastic import approach_under_load
from macroslip.mechanics.loads import elastic_approach
from macroslip.mechanics.raceway import raceway_state, raceway_traction, spin_traction
from macroslip.ring.orbit import instant

FREE = 0
EDGE = 1
FIRM = 2


@jit
def relaxation_rate(body, tables, load, ring_speed):
    """Relaxation rate of the slip, (r²/I_z') d(F_i + F_o)/dv at F_i + F_o = 0.

    Without microslip the slip of balance is zero; with it, a Newton iteration held within the slips
    that occur in the contact finds it.

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    tables : int
        Address of the flat array of tables.
    load : float
        Load of both raceways, > 0 [N].
    ring_speed : float
        Speed of the raceways, ≥ 0 [m/s].

    Returns
    -------
    float
        Rate [1/s].
    """
    slip = 0.0
    low = -math.inf
    high = math.inf
    rate = 0.0
    normal = contact_load(load)
    for _ in range(20):
        speeds = contact_speeds(ring_speed, slip, body.closed_form)
        residual = 0.0
        slope = 0.0
        for law in (body.inner, body.outer):
            state = raceway_state(law, tables, body.closed_form, normal, speeds)
            film = raceway_traction(law, tables, body.closed_form, state, speeds)
            traction = spin_traction(film)
            residual += traction.force
            slope += traction.by_slip
        rate = body.mobility * slope
        if residual > 0.0:
            high = slip
        else:
            low = slip
        following = slip - residual / slope if slope > 0.0 else slip
        if not low <= following <= high:
            following = 0.5 * (low + high)
        if abs(following - slip) <= 1e-6 * abs(slip) or not math.isfinite(following):
            break
        slip = following
    return rate


def firm_approach(body, tables, ring_speed):
    """Elastic approach [m] above which a roller is firmly held.

    It holds for raceway speeds up to `ring_speed` [m/s]. Infinite if no load of the tables holds it
    firmly (a law with bounded slope): then no interval is `FIRM`.
    """
    firm_rate = tuning.FIRM_RATE_MICROSLIP if body["microslip"] else tuning.FIRM_RATE
    low = 1e-3
    high = body["highest_load"]
    if not relaxation_rate(body, tables, high, ring_speed) >= firm_rate:
        return math.inf
    load = math.sqrt(low * high)
    while low < load < high:
        if relaxation_rate(body, tables, load, ring_speed) >= firm_rate:
            high = load
        else:
            low = load
        load = math.sqrt(low * high)
    return approach_under_load(body, high)


@jit_inline
def approach_at(body, motion, start_angle, interval, time):
    """Elastic approach δ of a roller at a time.

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    motion : Motion
        Of the inner ring.
    start_angle : float
        Position φ at the first sample [rad].
    interval : int
        Index of the sample interval that holds the time.
    time : float
        [s]

    Returns
    -------
    float
        δ [m]; negative where there is play.
    """
    now = instant(motion, interval, time)
    angle = start_angle + body.orbit_ratio * now.shaft_angle
    cosine, sine = cosine_and_sine(angle)
    return elastic_approach(body, cosine, sine, now)


@jit
def classify(body, motion, start_angle, firm, classes):
    """Write the load class of every sample interval of a roller.

    Between two samples δ differs from the chord by at most |δ''| Δt²/8. The roller's turning, its
    acceleration and the ring's motion bound |δ''| by (φ'² + |φ''|) (|d| + 4 |c2| + 9 |c3|) + 2 |φ'|
    |d'|, c2 and c3 the waves of a ring out of round, and the classes keep that margin.

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    motion : Motion
        Of the inner ring, with n samples.
    start_angle : float
        Position φ at the first sample [rad].
    firm : float
        Elastic approach from which on the roller is firmly held [m].
    classes : ndarray of int8, shape (n − 1,)
        Is written: `FREE`, `EDGE` or `FIRM` by interval.
    """
    before = approach_at(body, motion, start_angle, 0, motion.time[0])
    waves = 4.0 * math.hypot(body.second_x, body.second_y) + 9.0 * math.hypot(
        body.third_x, body.third_y
    )
    for k in range(motion.time.size - 1):
        after = approach_at(body, motion, start_angle, k, motion.time[k + 1])
        near = motion.displacement[k]
        far = motion.displacement[k + 1]
        start_speed = motion.shaft_speed[k]
        end_speed = motion.shaft_speed[k + 1]
        span = abs(body.orbit_ratio) * (motion.time[k + 1] - motion.time[k])
        turn = span * max(abs(start_speed), abs(end_speed))
        quickening = span * abs(end_speed - start_speed)
        near_square = near[0] * near[0] + near[1] * near[1]
        far_square = far[0] * far[0] + far[1] * far[1]
        reach = math.sqrt(max(near_square, far_square))
        shift_x = far[0] - near[0]
        shift_y = far[1] - near[1]
        shift = math.sqrt(shift_x**2 + shift_y**2)
        curvature = (turn * turn + quickening) * (reach + waves) + 2.0 * turn * shift
        margin = 0.125 * curvature + 1e-15
        classes[k] = EDGE
        if before < -margin and after < -margin:
            classes[k] = FREE
        elif before > firm + margin and after > firm + margin:
            classes[k] = FIRM
        before = after


@jit
def edge_time(body, motion, start_angle, interval, start, end):
    """Time within a sample interval just after the elastic approach has changed its sign.

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    motion : Motion
        Of the inner ring.
    start_angle : float
        Position φ at the first sample [rad].
    interval : int
        Index of the sample interval.
    start, end : float
        Times in it between which the sign is followed [s].

    Returns
    -------
    float
        Time [s]; `end` if the signs at both times are the same. A load that comes and goes in
        between is missed.
    """
    first = approach_at(body, motion, start_angle, interval, start)
    last = approach_at(body, motion, start_angle, interval, end)
    if first == 0.0 or first * last >= 0.0:
        return end
    low = start
    high = end
    while high - low > 4e-16 * (abs(high) + abs(low)):
        middle = 0.5 * (low + high)
        if middle <= low or middle >= high:
            break
        if approach_at(body, motion, start_angle, interval, middle) * first > 0.0:
            low = middle
        else:
            high = middle
    return high
