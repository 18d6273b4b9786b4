"""The three contacts of a roller as laws see them: curvatures, material, oil and shape.

The slip along the roller and the highest load follow from these.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from macroslip.bearing import Bearing, geometry
from macroslip.contact.hertz import HertzContact, effective_modulus, elliptical_contact
from macroslip.contact.mechanisms import Laws
from macroslip.contact.traction import HIGHEST_PRESSURE
from macroslip.lubricant import Lubricant

#: Share of a roller's load that may lie beyond its ends.
HIGHEST_TRUNCATED_SHARE = 0.1


class Interface(NamedTuple):
    """One kind of contact of a roller: with the inner raceway, the outer raceway or the cage."""

    name: str  #: `inner`, `outer` or `cage`
    hertz: HertzContact  #: Coefficients of semi-axes, pressure and approach
    rolling_radius: float  #: Relative radius of curvature in the plane of rolling R [m]
    modulus: float  #: Effective modulus E' [Pa]
    roughness: float  #: Composite RMS roughness [m]
    hardness: float  #: Hardness of the softer surface [Pa]
    lubricant: Lubricant  #: The lubricant in it


class ContactShape(NamedTuple):
    """Shape of a contact along the roller, which makes slip differ from station to station."""

    microslip: bool  #: Whether slip varies over the contact; if not, only `half_length` is used
    #: Common contour radius R_d [m]: a pressed contact follows the middle between the two contours.
    contour_radius: float
    roller_radius: float  #: r [m]
    half_length: float  #: Half the roller's length [m]; the contact ends there
    #: κ/u2 in pure rolling [1/m]: 1/r + cos α/r~_in at the inner, 1/r − cos α/r~_out at the outer
    #: raceway.
    curvature_ratio: float
    spin_ratio: float  #: s/u2 [1/m]: sin α/r~_in or sin α/r~_out, with the row's axial sign


def common_contour_radius(roller: float, raceway: float) -> float:
    """R_d = 2 R_roller R_raceway/(R_roller + R_raceway) [m], 2 R_roller on a straight raceway.

    Examples
    --------
    >>> round(common_contour_radius(0.406602, 0.4149), 6)
    0.410709
    """
    return 2.0 / (1.0 / roller + 1.0 / raceway)


def interfaces(bearing: Bearing, lubricant: Lubricant) -> tuple[Interface, Interface, Interface]:
    """Interfaces of a roller with inner raceway, outer raceway and cage.

    They carry their Hertz coefficients (section "Forces" of the paper).
    """
    own = bearing.youngs_modulus, bearing.poisson_ratio
    steel = effective_modulus(*own, *own)
    cage = effective_modulus(*own, bearing.cage_youngs_modulus, bearing.cage_poisson_ratio)
    inner, outer, pocket = (
        Interface(
            name,
            elliptical_contact(curvatures.rolling, curvatures.lateral, modulus),
            1.0 / curvatures.rolling,
            modulus,
            bearing.composite_roughness,
            bearing.hardness,
            lubricant,
        )
        for name, curvatures, modulus in (
            ("inner", geometry.inner_curvatures(bearing), steel),
            ("outer", geometry.outer_curvatures(bearing), steel),
            ("cage", geometry.cage_curvatures(bearing), cage),
        )
    )
    return inner, outer, pocket


def contact_shape(
    bearing: Bearing, interface: Interface, axial_sign: int, *, microslip: bool
) -> ContactShape:
    """Shape of a contact along the roller; on the cage's contact slip is the same all over.

    Parameters
    ----------
    bearing : Bearing
        Its dimensions.
    interface : Interface
        The contact: inner raceway, outer raceway or cage.
    axial_sign : int
        +1 for the downwind row and −1 for the upwind row.
    microslip : bool
        Whether slip varies along the roller.

    Returns
    -------
    ContactShape
        Radii and lengths [m], slopes of the slip [1/m].

    Notes
    -----
    The sign of ζ is that of the roller's axis z'. With z' = z cos α − y sin α (s = +1) the ring's
    surface at the station ζ is ζ sin α nearer to the bearing axis, which gives v the term
    +s (Ω_in − Ω) sin α ζ; ζ counted the other way round turns its sign, and that of the skew
    moment, and nothing else.
    """
    half_length = 0.5 * bearing.roller_length
    if not microslip or interface.name == "cage":
        return ContactShape(False, math.inf, math.inf, half_length, 0.0, 0.0)
    inner = interface.name == "inner"
    raceway = (
        geometry.inner_raceway_contour_radius if inner else geometry.outer_raceway_contour_radius
    )(bearing)
    contact_radius = (
        geometry.inner_contact_radius(bearing) if inner else geometry.outer_contact_radius(bearing)
    )
    return ContactShape(
        microslip=True,
        contour_radius=common_contour_radius(geometry.roller_contour_radius(bearing), raceway),
        roller_radius=geometry.roller_radius(bearing),
        half_length=half_length,
        curvature_ratio=1.0 / interface.rolling_radius,
        spin_ratio=axial_sign * math.sin(bearing.contact_angle) / contact_radius,
    )


def truncation_load(bearing: Bearing, lubricant: Lubricant) -> float:
    """Roller load [N] at which a raceway contact ellipse reaches the ends of the roller.

    Above it the contact is truncated, and Hertz pressure, film and traction formulas no longer
    describe it. Infinite where rollers touch along a line, which ends with them at any load.
    """
    if bearing.touches_along_line:
        return math.inf
    half = 0.5 * bearing.roller_length
    return min(
        raceway.hertz.load_at_semi_axis_across(half)
        for raceway in interfaces(bearing, lubricant)[:2]
    )


def truncated_share(load: float, truncation: float) -> float:
    """Share of a roller's load whose part of the Hertz ellipse lies beyond the roller's ends [-].

    From its largest load, and the load of `truncation_load` [N].

    Examples
    --------
    >>> truncated_share(1e5, 2e5), round(truncated_share(4e5, 2e5), 4)
    (0.0, 0.0594)
    """
    if load <= truncation:
        return 0.0
    part = (truncation / load) ** (1.0 / 3.0)
    return 1.0 - 0.5 * part * (3.0 - part * part)


def highest_load(bearing: Bearing, lubricant: Lubricant, laws: Laws) -> float:
    """Roller load [N] that a case may not exceed.

    There the ellipse reaches the roller's ends; with microslip, which cuts it off there, a tenth of
    the load would lie beyond them. Where rollers touch along a line, the largest pressure is that
    up to which the shear of oil is known.
    """
    if bearing.touches_along_line:
        from macroslip.contact.strips import load_at_pressure, strips_of

        return load_at_pressure(strips_of(bearing)[0], HIGHEST_PRESSURE)
    truncation = truncation_load(bearing, lubricant)
    if not laws.microslip:
        return truncation
    # (3t − t³)/2 = 1 − share, with t the half length over the semi-axis.
    part = 2.0 * math.sin(math.asin(1.0 - HIGHEST_TRUNCATED_SHARE) / 3.0)
    return truncation / part**3
