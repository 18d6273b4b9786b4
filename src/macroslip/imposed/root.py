"""Bounds from the slip at which traction passes its peak.

One tells whether a step was solved on the root that is continuous with the slip before it, the
other how far Newton's method is from it where the paper's traction still rises almost in proportion
to slip.
"""

from __future__ import annotations

import math

from macroslip.compiled import jit, jit_inline
from macroslip.contact.look_up import log_load, rising_slip
from macroslip.elementary import exponential
from macroslip.imposed import tuning

#: √B at which Crook's shear stress peaks (B = 2.2767).
_ROOT_HEATING_AT_PEAK = 1.5088


@jit_inline
def _steady_slip(law, tables, closed_form, load, speed):
    """Slip [m/s] up to which the force of a contact rises with slip."""
    if load <= 0.0:
        return math.inf
    if not closed_form:
        return rising_slip(law.traction, tables, load, speed)
    if law.heating == 0.0:
        return 2.0 * speed  # where the film ends
    # The middle of the contact is its hottest point.
    root = exponential(log_load(load) * (1.0 / 3.0))
    return _ROOT_HEATING_AT_PEAK / law.heating * exponential(-0.5 * law.pressure_exponent * root)


@jit
def surely_rising(body, tables, inner_load, outer_load, speed):
    """Slip up to which the friction of both raceways surely rises with slip [m/s].

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
    tables : ndarray
        The flat array of tables.
    inner_load, outer_load : float
        Normal loads of the raceways [N].
    speed : float
        Largest ring speed, ≥ 0 [m/s].

    Returns
    -------
    float
        Slip, > 0 [m/s]; infinite without load.
    """
    return min(
        _steady_slip(body.inner, tables, body.closed_form, inner_load, speed),
        _steady_slip(body.outer, tables, body.closed_form, outer_load, speed),
    )


@jit
def is_continuous(path, now, attempt):
    """True if a step was surely solved on the root continuous with the slip before it.

    Below the slip at which some part of a contact passes its peak of traction, forces rise with
    slip and the stage equations have one root. Above it, a step is accepted only where slip changes
    so little, and traction falls so gently, that the root found is the continuous one.
    """
    slip = now.slip
    limits = path.limits
    at = now.at
    change = 0.0
    largest = abs(slip)
    inner = at.inner_load
    outer = at.outer_load
    for k in range(3):
        # More than one root is possible only where traction falls with slip faster than the step
        # allows.
        if attempt.forces[k].slope < -0.5 * attempt.scale:
            return False
        change = max(change, abs(attempt.slip[k] - slip))
        largest = max(largest, abs(attempt.slip[k]))
        inner = max(inner, attempt.at[k].inner_load)
        outer = max(outer, attempt.at[k].outer_load)
    if (
        change <= tuning.HOT_CHANGE * abs(slip) + tuning.SMALL_CHANGE * limits.speed_scale
        or largest <= limits.cold_slip
    ):
        return True
    ring = max(abs(at.ring_speed), abs(attempt.at[2].ring_speed))
    return largest <= surely_rising(path.body, path.flat, inner, outer, ring)


@jit
def left_by_curvature(body, tables, attempt, update):
    """Write bounds of the residuals that Newton's first correction of a step leaves, by the closed form.

    Far below the slip v_p at which the hottest point of a contact passes its peak of traction, and
    below the ring's speed u2, a force that has the slope F' before a correction Δ keeps within

        |F(v + Δ) − F(v) − F' Δ| ≤ F' Δ² (5 |v|/v_p² + 0.5/u2),

    |v| the larger of the slips before and after: heating takes from F/v in proportion to (v/v_p)²,
    and a film of the speed u2 − v/2 to the power of 0.7 adds to it in proportion to v/u2. Friction at
    the cage is off by at most the square of the relative change of its load and speed.

    Parameters
    ----------
    body : record of `macroslip.roller.model.BODY`
        With the closed form of traction.
    tables : ndarray
        The flat array of tables.
    attempt : record of `macroslip.imposed.state.ATTEMPT`
        With slips and forces before the correction. Its `left` is written, bounds ≥ 0 [N]: infinite
        beyond half of v_p and of u2, where the cage's load passes zero, and where asperities have
        friction, whose share of the load follows the film more steeply.
    update : tuple of float
        Changes of slip at the stages [m/s].

    References
    ----------
    Crook (1961), doi:10.1098/rsta.1961.0014, for the traction.
    """
    for k in range(3):
        attempt.left[k] = math.inf
    if body.inner.boundary_friction > 0.0 or body.outer.boundary_friction > 0.0:
        return
    inner_load = 0.0
    outer_load = 0.0
    slowest = math.inf
    for k in range(3):
        inner_load = max(inner_load, attempt.at[k].inner_load)
        outer_load = max(outer_load, attempt.at[k].outer_load)
        slowest = min(slowest, abs(attempt.at[k].ring_speed))
    peak = surely_rising(body, tables, inner_load, outer_load, slowest)
    farthest = min(peak, slowest)
    for k in range(3):
        forces = attempt.forces[k]
        change = abs(update[k])
        slip = max(abs(attempt.slip[k]), abs(attempt.slip[k] + update[k]))
        pushed = abs(forces.cage_load_slope) * change
        if not (slip < tuning.UNHEATED * farthest and pushed < abs(forces.cage_load)):
            continue
        curvature = tuning.HEATED_CURVATURE * slip / (peak * peak) + tuning.FILM_CURVATURE / slowest
        left = (abs(forces.inner_slope) + abs(forces.outer_slope)) * curvature * change * change
        cage_share = pushed / abs(forces.cage_load) + change / slowest
        attempt.left[k] = left + abs(forces.cage) * cage_share * cage_share
