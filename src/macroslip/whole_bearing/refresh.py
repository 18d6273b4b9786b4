"""When the tractions of a roller are due for evaluation.

At every evaluation the force predicted by the slopes of the evaluation before is compared with the one found. The time to
the next evaluation follows from the difference.
"""

from __future__ import annotations

import math

from macroslip.compiled import jit_inline, jit_merged
from macroslip.whole_bearing.record import raceway_powers
from macroslip.whole_bearing.traction import (
    INNER,
    LOAD,
    OUTER,
    PULL,
    PULL_V,
    SHEAR,
    SLIP,
    SPIN,
    SPIN_V,
    WHEN,
    evaluate_marked,
    raceway_from,
    shear_from,
)
from macroslip.whole_bearing.tuning import FAR_OFF, LOAD_CHANGE, REST_GROWTH, REST_PART, REST_SAFETY


@jit_inline
def _contact_off(bearing, limits, sheets, at, place, span, power_scale):
    """Error of the predicted spin force, pull [N] and powers [W] of a raceway contact over what is allowed.

    `sheets` are the kept one and the new one; `place` is load [N], ring speed and slip [m/s].
    """
    known, sheet = sheets
    load, speed, slip = place
    ratio = bearing.pitch_radius / (bearing.inner_radius if at == INNER else bearing.outer_radius)
    spin, pull = raceway_from(known, at, load, speed, slip)
    off = max(abs(spin - sheet[at + SPIN]), abs(pull - sheet[at + PULL]))
    drift = off / (bearing.roller_mass / max(span, 1e-9) + max(sheet[at + SPIN_V], sheet[at + PULL_V], 0.0))
    predicted = raceway_powers(known, at, ratio, (spin, pull, shear_from(known, at, load, speed, slip)), place)
    found = raceway_powers(sheet, at, ratio, (sheet[at + SPIN], sheet[at + PULL], sheet[at + SHEAR]), place)
    wrong, power = 0.0, 0.0
    for k in range(4):
        wrong += predicted[k] - found[k]
        power += abs(found[k])
    return max(drift / limits.allowed_speed, abs(wrong) / (limits.power * (power + power_scale) + 1e-12))


@jit_merged
def _prediction_error(bearing, limits, tractions, stations, j, span, power_scale):
    """Error of what the kept sheet of roller `j`, `span` [s] older, predicted for the new one, over what is allowed."""
    sheet, known = tractions.sheets[j], tractions.known[j]
    worst = 0.0
    for k in range(2):
        at = INNER if k == 0 else OUTER
        load = stations.inner_load[j] if k == 0 else stations.outer_load[j]
        speed = stations.inner_speed[j] if k == 0 else stations.outer_speed[j]
        place = (load, speed, sheet[at + SLIP])
        worst = max(worst, _contact_off(bearing, limits, (known, sheet), at, place, span, power_scale))
        change = abs(load - known[at + LOAD])
        worst = max(worst, (change / (LOAD_CHANGE * max(load, known[at + LOAD]) + 1e-9)) ** 2)
    return worst


@jit_merged
def refresh(bearing, limits, time, space, power_scale):
    """Evaluate the rollers that are due at the step's end, and set the time to their next evaluation.

    Parameters
    ----------
    bearing : WholeBearing
    limits : BearingLimits
    time : float
        [s].
    space : Space
        With the solved step in `last`.
    power_scale : float
        Mean frictional power of a raceway contact so far [W].

    Returns
    -------
    bool
        Whether the forces of all resting rollers were near those predicted; otherwise the step has to be repeated.
    """
    tractions, moment = space.tractions, space.last
    sheets, rest = tractions.sheets, tractions.rest
    for j in range(rest.size):
        resting = not tractions.fresh[j]
        tractions.due[j] = not (resting and time - tractions.known[j, WHEN] < rest[j])
        tractions.marked[j] = tractions.due[j] and (resting or sheets[j, WHEN] != time)
    done = evaluate_marked(bearing, moment.stations, time, moment.values.rollers, tractions.marked, sheets)
    space.work[0] += done
    space.work[2] += done // 2
    good = True
    for j in range(rest.size):
        span = time - tractions.known[j, WHEN]
        if tractions.due[j]:
            ratio = _prediction_error(bearing, limits, tractions, moment.stations, j, span, power_scale)
            tractions.ratio[j] = ratio
            if not tractions.fresh[j] and ratio > FAR_OFF and span > 0.0:
                rest[j] = 0.0
                good = False
    # Times change only after a good step: a roller that has to be evaluated in its repetition would rest again.
    for j in range(rest.size):
        if good and tractions.due[j]:
            factor = REST_SAFETY / math.sqrt(max(tractions.ratio[j], 1e-4))
            span = time - tractions.known[j, WHEN]
            rest[j] = min(limits.longest_rest, span * max(REST_PART, min(factor, REST_GROWTH)))
    return good
