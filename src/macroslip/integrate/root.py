"""Which root of an implicit step is right: the one that joins the present slip as the step shrinks to zero.

Below the slip at which some part of a contact passes its peak of traction, forces rise with slip and the stage equations
have one root. Above it, a step is accepted only where slip changes so little, and traction falls so gently, that the
root found is the continuous one.
"""

from __future__ import annotations

from macroslip.compiled import jit, jit_part
from macroslip.roller.held_contact import slip_variation, steady_slip

#: Largest relative change of slip in a step taken where traction may fall with slip, and the change, as part of the
#: raceway speed, that is always small.
_HOT_CHANGE, _SMALL_CHANGE = 0.2, 1e-6


@jit
def rising_at(model, inner_load, outer_load, ring_speed, entrainment_speed):
    """Slip up to which traction rises at both raceways at the given loads [N] and speeds [m/s]."""
    inner = steady_slip(model.inner, inner_load, entrainment_speed, slip_variation(model.inner, inner_load, ring_speed))
    outer = steady_slip(model.outer, outer_load, entrainment_speed, slip_variation(model.outer, outer_load, ring_speed))
    return min(inner, outer)


@jit_part
def _surely_rising(model, at, at1, at2, at3, slip):
    """Slip up to which traction rises at both raceways for every load met in a step [m/s]; `slip` is the largest there."""
    inner = max(at.inner_load, at1.inner_load, at2.inner_load, at3.inner_load)
    outer = max(at.outer_load, at1.outer_load, at2.outer_load, at3.outer_load)
    ring = max(abs(at.ring_speed), abs(at3.ring_speed))
    return rising_at(model, inner, outer, ring, ring + 0.5 * abs(slip))


@jit_part
def is_continuous(model, limits, scale, slip, at, at1, at2, at3, stages):
    """Whether the solved stages of a step are sure to be the root that is continuous with the slip before it.

    Parameters
    ----------
    scale : float
        1/(h r²/I_z') [N s/m].
    slip : float
        Slip before the step [m/s].
    at, at1, at2, at3 : Station
        At the start and at the stages.
    stages : Stages
    """
    # More than one root is possible only where traction falls with slip faster than the step allows.
    if min(stages.f1.slope, stages.f2.slope, stages.f3.slope) < -0.5 * scale:
        return False
    largest = max(abs(slip), abs(stages.v1), abs(stages.v2), abs(stages.v3))
    if largest > limits.cold_slip and largest > _surely_rising(model, at, at1, at2, at3, largest):
        change = max(abs(stages.v1 - slip), abs(stages.v2 - slip), abs(stages.v3 - slip))
        return change <= _HOT_CHANGE * abs(slip) + _SMALL_CHANGE * limits.speed_scale
    return True
