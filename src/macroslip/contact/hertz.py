"""Hertz point contact of two elastic bodies with an elliptical contact area.

It is solved by the exact elliptic integrals.

The two equations for the semi-axes are written with Carlson's R_D, in which neither cancels for a
circular contact nor overflows for a very slender one; the axis ratio is then one well-scaled scalar
equation.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from macroslip.errors import InputError


class HertzContact(NamedTuple):
    """Coefficients of a Hertz contact; every result follows from the load Q [N] by a power."""

    semi_axis_across: float  #: Semi-axis of the ellipse across rolling per Q^(1/3) [m/N^(1/3)]
    semi_axis_along: float  #: Semi-axis along rolling per Q^(1/3) [m/N^(1/3)]
    pressure: float  #: Maximum pressure p0 per Q^(1/3) [Pa/N^(1/3)]
    approach: float  #: Elastic approach per Q^(2/3) [m/N^(2/3)]

    @property
    def stiffness(self) -> float:
        """K in Q = K δ^1.5 [N/m^1.5]."""
        return self.approach**-1.5

    def load_at_semi_axis_across(self, semi_axis: float) -> float:
        """Load [N] at which the semi-axis across rolling reaches `semi_axis` [m].

        It serves for truncation at the roller's ends.
        """
        return (semi_axis / self.semi_axis_across) ** 3


def effective_modulus(
    modulus_1: float, poisson_1: float, modulus_2: float, poisson_2: float
) -> float:
    """Effective elastic modulus E' = 2/[(1−ν1²)/E1 + (1−ν2²)/E2] [Pa].

    Parameters
    ----------
    modulus_1, modulus_2 : float
        Young's moduli E1 and E2 [Pa], > 0.
    poisson_1, poisson_2 : float
        Poisson's ratios ν1 and ν2 [-], 0 to 0.5.

    Returns
    -------
    float
        E' [Pa].

    References
    ----------
    Johnson, Contact Mechanics (1985), section 4.2, where E* = E'/2.

    Examples
    --------
    >>> round(effective_modulus(210e9, 0.3, 210e9, 0.3) / 1e9, 3)
    230.769
    """
    compliance_1 = (1.0 - poisson_1**2) / modulus_1
    compliance_2 = (1.0 - poisson_2**2) / modulus_2
    return 2.0 / (compliance_1 + compliance_2)


def axis_ratio(curvature_ratio: float) -> float:
    """Ratio b/a of the contact ellipse, short over long semi-axis, 0 < b/a ≤ 1 [-].

    It is the root of A/B = R_D(0, (b/a)², 1)/R_D(0, 1, (b/a)²). A/B is the smaller over the larger
    relative curvature of the two principal planes, 0 < A/B ≤ 1.

    Johnson, Contact Mechanics (1985), eq. (4.26a, b), in Carlson's form (DLMF 19.25.1).

    Examples
    --------
    >>> round(axis_ratio(1.0), 12)
    1.0
    >>> round(axis_ratio(1e-3), 6)
    0.014734
    """
    from scipy.optimize import brentq
    from scipy.special import elliprd

    if curvature_ratio >= 1.0:
        return 1.0

    def mismatch(log_ratio: float) -> float:
        squared = math.exp(2.0 * log_ratio)
        return math.log(elliprd(0.0, squared, 1.0) / elliprd(0.0, 1.0, squared) / curvature_ratio)

    # A/B ≥ (b/a)², and b/a exceeds A/B itself, which brackets the root for every slenderness.
    return math.exp(brentq(mismatch, math.log(curvature_ratio) - 1.0, 0.0, xtol=1e-15, rtol=1e-14))


def elliptical_contact(
    rolling_curvature: float, lateral_curvature: float, modulus: float
) -> HertzContact:
    """Hertz contact from the two relative curvatures.

    Raises InputError if a relative curvature is not positive: the bodies would conform and Hertz's
    theory does not hold.

    Parameters
    ----------
    rolling_curvature, lateral_curvature : float
        Sum of the bodies' curvatures in the plane of rolling and in the plane across it [1/m], > 0
        (a concave surface counts negative within the sum).
    modulus : float
        Effective modulus E' [Pa], see `effective_modulus`.

    Notes
    -----
    a³ = 2 Q R_D(0, 1, (b/a)²)/(π E' ρ), with ρ the larger curvature; p0 = 3Q/(2πab); δ = 3 Q K/(π a
    E'). Valid for small contact areas on smooth, linearly elastic, frictionless bodies.

    References
    ----------
    Johnson, Contact Mechanics (1985), eq. (4.24)-(4.26).

    Examples
    --------
    >>> sphere = elliptical_contact(100.0, 100.0, 230.77e9)     # steel ball, 10 mm radius, on a flat
    >>> round(sphere.semi_axis_along * 100.0 ** (1 / 3) * 1e6, 2), round(sphere.pressure * 100.0 ** (1 / 3) / 1e6, 1)
    (186.63, 1370.9)
    """
    from scipy.special import elliprd, elliprf

    for name, value in (("rolling", rolling_curvature), ("lateral", lateral_curvature)):
        if not (math.isfinite(value) and value > 0.0):
            fault = f"the relative curvature in the {name} direction is {value:g} 1/m"
            allowed = "positive numbers (the concave radius must exceed the convex one)"
            remedy = "Check radii and osculation; osculation is roller contour radius over raceway radius, below 1"
            raise InputError(fault, where="Hertz contact", allowed=allowed, remedy=remedy)
    larger = max(rolling_curvature, lateral_curvature)
    ratio = axis_ratio(min(rolling_curvature, lateral_curvature) / larger)
    long_axis = float(
        (2.0 * elliprd(0.0, 1.0, ratio**2) / (math.pi * modulus * larger)) ** (1.0 / 3.0)
    )
    short_axis = ratio * long_axis
    lateral_is_long = lateral_curvature <= rolling_curvature
    return HertzContact(
        semi_axis_across=long_axis if lateral_is_long else short_axis,
        semi_axis_along=short_axis if lateral_is_long else long_axis,
        pressure=1.5 / (math.pi * long_axis * short_axis),
        approach=float(3.0 * elliprf(0.0, ratio**2, 1.0) / (math.pi * long_axis * modulus)),
    )


def series_stiffness(inner: HertzContact, outer: HertzContact) -> float:
    """Stiffness of inner and outer contact in series [N/m^1.5].

    K = (K_i^(−2/3) + K_o^(−2/3))^(−3/2).

    Examples
    --------
    >>> sphere = elliptical_contact(100.0, 100.0, 230.77e9)
    >>> round(series_stiffness(sphere, sphere) / sphere.stiffness, 6)
    0.353553
    """
    return (inner.approach + outer.approach) ** -1.5
