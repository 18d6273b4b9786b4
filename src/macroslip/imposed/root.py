"""Check that a step was solved on the root that is continuous with the slip before it."""

from __future__ import annotations

import math

from macroslip.compiled import jit, jit_inline
from macroslip.contact.look_up import rising_slip
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
    return (
        _ROOT_HEATING_AT_PEAK
        / law.heating
        * math.exp(-0.5 * law.pressure_exponent * load ** (1.0 / 3.0))
    )


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
