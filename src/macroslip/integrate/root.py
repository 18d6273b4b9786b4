"""The right root of an implicit step: the one that approaches the present slip as the step shrinks to zero.

Below the slip at which some part of a contact passes its peak of traction, forces rise with slip and the stage equations
have one root. Above it, a step is accepted only where slip changes so little, and traction falls so gently, that the
root found is the continuous one.
"""

from __future__ import annotations

from macroslip.compiled import jit_lawless, jit_part
from macroslip.integrate.sealed import rising_of
from macroslip.integrate.tuning import HOT_CHANGE, SMALL_CHANGE


@jit_lawless
def cold_slip(model, load, speed):
    """Slip [m/s] up to which traction rises at loads up to `load` [N] and raceway speeds up to `speed` [m/s]."""
    # Twice the raceways' speed bounds the slip, and with it the thickest film.
    return rising_of(model, load, load, speed, 2.0 * speed)


@jit_part
def _surely_rising(model, at, step, slip):
    """Slip up to which traction rises at both raceways for every load met in a step [m/s]; `slip` is the largest there."""
    inner = max(at.inner_load, step.at1.inner_load, step.at2.inner_load, step.at3.inner_load)
    outer = max(at.outer_load, step.at1.outer_load, step.at2.outer_load, step.at3.outer_load)
    ring = max(abs(at.ring_speed), abs(step.at3.ring_speed))
    return rising_of(model, inner, outer, ring, ring + 0.5 * abs(slip))


@jit_part
def is_continuous(path, state, step, stages):
    """Whether the solved stages of a step are sure to be the root that is continuous with the slip before it."""
    # More than one root is possible only where traction falls with slip faster than the step allows.
    if min(stages.f1.slope, stages.f2.slope, stages.f3.slope) < -0.5 * step.scale:
        return False
    slip, limits = state.slip, path.limits
    change = max(abs(stages.v1 - slip), abs(stages.v2 - slip), abs(stages.v3 - slip))
    if change <= HOT_CHANGE * abs(slip) + SMALL_CHANGE * limits.speed_scale:
        return True
    largest = max(abs(slip), abs(stages.v1), abs(stages.v2), abs(stages.v3))
    return largest <= limits.cold_slip or largest <= _surely_rising(path.model, state.at, step, largest)
