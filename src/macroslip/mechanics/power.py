"""Power that a contact dissipates: frictional power (33) and power of rolling resistance."""

from __future__ import annotations

from typing import NamedTuple

from macroslip.compiled import jit_evaluation, jit_inline


class RacewayPower(NamedTuple):
    """Frictional power of a raceway contact, by what makes its surfaces slide [W]."""

    slip: float  #: Slip of the middle
    curvature: float  #: Slip that varies with the roller's radius along the contact
    #: Slip by the turn about the contact normal, which the contact angle makes
    contact_spin: float


@jit_evaluation
def raceway_power(law, slip, ring_speed, friction, lag, skew):
    """Frictional power of a raceway contact (33), P = ∫τ v dA, by what makes its surfaces slide.

    Where slip is the same all over, it is F Δu.

    Parameters
    ----------
    law : record of `macroslip.roller.model.CONTACT`
    slip, ring_speed : float
        Δu in the middle of the contact and u2 [m/s].
    friction : float
        F in the spin equation (16), without rolling resistance [N].
    lag : float
        ∫τ h/r dA [N].
    skew : float
        ∫τ ζ dA [N m].

    Returns
    -------
    RacewayPower

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> raceway_power(SimpleNamespace(curvature=1.0, spin_ratio=0.5), 1e-3, -0.5, 2.0, 0.5, -0.1)
    RacewayPower(slip=0.002, curvature=-0.25, contact_spin=-0.025)
    """
    return RacewayPower(
        slip * friction,
        ring_speed * law.curvature * lag,
        -ring_speed * law.spin_ratio * skew,
    )


@jit_inline
def total_power(parts):
    """Frictional power of a raceway contact (33) from its parts [W].

    Parameters
    ----------
    parts : RacewayPower

    Returns
    -------
    float
        P [W].

    Examples
    --------
    >>> total_power(RacewayPower(slip=0.5, curvature=1.5, contact_spin=0.25))
    2.25
    """
    return parts.slip + parts.curvature + parts.contact_spin


@jit_inline
def cage_power(friction, sliding):
    """Frictional power of the cage's contact (33), P = F_c Δu_c [W].

    Parameters
    ----------
    friction : float
        F_c without rolling resistance [N].
    sliding : float
        Δu_c, slip against the cage [m/s]; −u1 where the cage keeps up with the roller.

    Returns
    -------
    float
        P [W]; friction has the sign of the slip, so that it is not negative but by rounding.

    Examples
    --------
    >>> cage_power(-2.0, -0.25)
    0.5
    """
    return friction * sliding


@jit_inline
def rolling_power(shear, mean_speed):
    """Power of the rolling resistance of a contact, P_r = −2 F_r (u1 + u2)/2 [W].

    Both surfaces feel the shear F_r against their motion; the inclined pressure does no work on the
    ring.

    Parameters
    ----------
    shear : float
        Rolling resistance F_r in the spin equation (16) [N].
    mean_speed : float
        (u1 + u2)/2, mean speed of both surfaces [m/s].

    Returns
    -------
    float
        P_r [W], ≥ 0.

    Examples
    --------
    >>> rolling_power(-1.5, 0.5)
    1.5
    """
    return -2.0 * shear * mean_speed
