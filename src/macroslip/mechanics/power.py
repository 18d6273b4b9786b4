"""Frictional power of a contact (33)."""

from __future__ import annotations

from typing import NamedTuple

from macroslip.compiled import jit_evaluation


class RacewayPower(NamedTuple):
    """Frictional power of a raceway contact, by what makes its surfaces slide [W]."""

    slip: float  #: Slip of the middle
    curvature: float  #: Slip that varies with the roller's radius along the contact
    #: Slip by the turn about the contact normal, which the contact angle makes
    contact_spin: float


@jit_evaluation
def raceway_power(law, slip, ring_speed, friction, lag, skew):
    """Frictional power P = ∫τ v dA of a raceway contact (33) [W].

    Where slip is the same all over, it is F Δu.

    Parameters
    ----------
    law : record of `macroslip.roller.model.CONTACT`
    slip, ring_speed : float
        Δu in the middle of the contact and u2 [m/s].
    friction : float
        F in (16) without rolling resistance [N].
    lag : float
        ∫τ h/r dA [N].
    skew : float
        ∫τ ζ dA [N m].

    Returns
    -------
    RacewayPower
    """
    return RacewayPower(
        slip * friction,
        ring_speed * law.curvature * lag,
        -ring_speed * law.spin_ratio * skew,
    )
