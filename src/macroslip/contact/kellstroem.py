"""Kellström's friction: in proportion to the slide-roll ratio up to a limit, then constant.

With the pressure p, the slip v and the mean surface speed u_e of a contact the stress is

    τ = µ p min(|v|/(s0 u_e), 1),

with a limit µ of its own at either raceway and the slide-roll ratio s0 at which friction saturates
at both. It is a description of friction and not of a film: what oil, pressure and temperature do is
in µ and s0, which are given. A small s0 stands for dry, mixed or limited friction, a large one for
a film that stays viscous.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from macroslip.contact.asperities import asperity_patch
from macroslip.contact.patch import Patch

REFERENCE = (
    "Kellström, Rolling contact guidance of rollers in spherical roller bearings, ASME 79-Lub-23 "
    "(1979), by its abstract"
)


class SaturatingFriction(NamedTuple):
    """Limit and saturation of Kellström's friction at one raceway."""

    limit: float  #: µ [-], > 0
    slide_roll_ratio: float  #: s0, slip over mean surface speed at which it is reached [-], > 0


def saturating_stress(friction: SaturatingFriction, pressure, slip, mean_speed):
    """Shear stress at points of a contact.

    Parameters
    ----------
    friction : SaturatingFriction
        Limit and slide-roll ratio.
    pressure : array_like
        p [Pa], ≥ 0.
    slip : array_like
        |v| at the points [m/s], ≥ 0.
    mean_speed : array_like
        u_e of the contact [m/s], > 0.

    Returns
    -------
    ndarray or float
        τ [Pa], ≥ 0.

    Notes
    -----
    It holds where µ and s0 do: neither changes with pressure, film or temperature.

    References
    ----------
    Kellström, ASME paper 79-Lub-23 (1979).

    Examples
    --------
    >>> float(saturating_stress(SaturatingFriction(0.05, 0.01), 1e9, 1e-3, 0.4))
    12500000.0
    """
    full = friction.slide_roll_ratio * np.asarray(mean_speed)
    saturation = np.minimum(np.asarray(slip) / full, 1.0)
    return friction.limit * np.asarray(pressure) * saturation


class PatchFriction(NamedTuple):
    """Friction of a contact over its ellipse."""

    pull: np.ndarray  #: Force [N]
    lag: np.ndarray  #: Force [N], by which the spin moment over the roller's radius is less
    skew: np.ndarray  #: Moment [N m]
    power: np.ndarray  #: ∫ τ v dA [W]


def saturating_patch(patch: Patch, coefficient, full_slip, load, ring_speed, slip) -> PatchFriction:
    """Friction µ p min(|v|/v_full, 1) over the ellipse of a raceway contact, exactly.

    Between the stations at which slip passes ± v_full every integrand is a polynomial. Kellström's
    friction has v_full = s0 u_e; that of asperities has a slip of its own.

    Parameters
    ----------
    patch : Patch
        Geometry of the contact.
    coefficient : array_like
        µ [-], ≥ 0.
    full_slip : array_like
        v_full [m/s], > 0.
    load : array_like
        Q [N], > 0.
    ring_speed, slip : array_like
        u2 and Δu in the middle of the contact [m/s].

    Returns
    -------
    PatchFriction
        Arrays of the shape to which the arguments broadcast.

    References
    ----------
    Kellström, ASME paper 79-Lub-23 (1979).

    Examples
    --------
    >>> import math
    >>> still = Patch(False, math.inf, math.inf, 0.05, 0.0, 0.0, 3e-4, 3e-5, 3e7, 0.0, 1.0)
    >>> round(float(saturating_patch(still, 0.05, 4e-3, 1e4, 0.4, 2e-3).pull), 6)
    250.0
    """
    coefficient, full_slip, load, ring_speed, slip = np.broadcast_arrays(
        *(
            np.asarray(values, dtype=float)
            for values in (coefficient, full_slip, load, ring_speed, slip)
        )
    )
    across = patch.across * np.cbrt(load)
    bend = np.zeros(load.shape)
    spin = np.zeros(load.shape)
    if patch.microslip:
        fall = ring_speed * patch.curvature_ratio - slip / patch.roller_radius
        bend = fall / (2.0 * patch.contour_radius)
        spin = ring_speed * patch.spin_ratio
    pull, second, skew, power = asperity_patch(
        0.75 * coefficient * load / across,
        full_slip,
        across,
        np.minimum(across, patch.half_length),
        slip,
        bend,
        spin,
    )
    lag = second * 0.5 / (patch.contour_radius * patch.roller_radius)
    return PatchFriction(pull, lag, skew, power)
