"""Geometry of a bearing and its rollers: radii, curvatures, space, rows, positions and inertia.

Hart et al., "Dynamic modelling of slip in a wind turbine spherical roller main bearing". The
bearing frame has Z0 along the shaft, pointing downwind, Y0 up and X0 = Y0 x Z0 horizontal. A
roller's position is its angle from +X0, counter-clockwise about Z0: 90 deg is the top, -90 deg the
bottom. A positive orbital speed is counter-clockwise about Z0, and the roller's spin about its own
axis, which also points downwind, is negative then. At a contact the rolling direction lies in the
plane across the roller's axis, the lateral direction along it. All curvature sums of a valid
bearing are positive.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from macroslip.bearing.profile import profile_crown
from macroslip.errors import InputError

if TYPE_CHECKING:
    from macroslip.arrays import FloatArray
    from macroslip.bearing.bearing import Bearing

#: Names of the rows of a double-row bearing, in the order in which results list them.
ROWS: tuple[str, ...] = ("downwind", "upwind")
#: Name of the row of a single-row bearing.
SINGLE = "single"
#: Axial sign s of each row: the downwind row (+1) carries downwind thrust; without contact angle it
#: means nothing.
AXIAL_SIGNS: Mapping[str, int] = MappingProxyType({"downwind": 1, "upwind": -1, SINGLE: 1})
# The rows are staggered by half a pitch.
_STAGGER = MappingProxyType({"downwind": 0.0, "upwind": 0.5, SINGLE: 0.0})


class Curvatures(NamedTuple):
    """Curvature sums of a contact."""

    rolling: float  #: Sum of the curvatures of both bodies in the rolling direction [1/m]
    lateral: float  #: Sum of the curvatures of both bodies along the roller's axis [1/m]


def row_names(bearing: Bearing) -> tuple[str, ...]:
    """Names of a bearing's rows: `ROWS`, or ("single",).

    Examples
    --------
    >>> from macroslip.bearing import Bearing
    >>> row_names(Bearing.read("skf-240-600-bc"))
    ('downwind', 'upwind')
    """
    return ROWS if bearing.rows == len(ROWS) else (SINGLE,)


def roller_radius(bearing: Bearing) -> float:
    """Largest roller radius r [m].

    Examples
    --------
    >>> from macroslip.bearing import Bearing
    >>> roller_radius(Bearing.read("skf-240-600-bc"))
    0.035
    """
    return bearing.roller_diameter / 2


def inner_contact_radius(bearing: Bearing) -> float:
    """Distance of the inner raceway contact from the bearing axis, r~_in = r~ - r cos(alpha) [m].

    Examples
    --------
    >>> from macroslip.bearing import Bearing
    >>> round(inner_contact_radius(Bearing.read("skf-240-600-bc")), 6)
    0.338367
    """
    across = roller_radius(bearing) * math.cos(bearing.contact_angle)
    return bearing.pitch_radius - across


def outer_contact_radius(bearing: Bearing) -> float:
    """Distance of the outer raceway contact from the bearing axis, r~_out = r~ + r cos(alpha) [m].

    Examples
    --------
    >>> from macroslip.bearing import Bearing
    >>> round(outer_contact_radius(Bearing.read("skf-240-600-bc")), 6)
    0.407033
    """
    across = roller_radius(bearing) * math.cos(bearing.contact_angle)
    return bearing.pitch_radius + across


def orbit_ratio(bearing: Bearing) -> float:
    """Orbital speed of the rollers over the speed of the inner ring in pure rolling [-].

    Equal to r~_in/(r~_in + r~_out).

    Examples
    --------
    >>> from macroslip.bearing import Bearing
    >>> round(orbit_ratio(Bearing.read("skf-240-600-bc")), 6)
    0.45394
    """
    inner = inner_contact_radius(bearing)
    return inner / (inner + outer_contact_radius(bearing))


def roller_contour_radius(bearing: Bearing) -> float:
    """Radius of the roller's barrel contour [m].

    One contour, set by the osculation at the outer raceway sphere.

    That of a cylindrical roller is its crown. Where it touches along a line it is the crown that a
    logarithmic profile has at its middle, of a straight roller too: so the roller meets the spars of
    its cage.

    Examples
    --------
    >>> from macroslip.bearing import Bearing
    >>> round(roller_contour_radius(Bearing.read("skf-240-600-bc")), 6)
    0.406602
    """
    if bearing.touches_along_line:
        return profile_crown(bearing.roller_length, bearing.roller_diameter)
    if bearing.osculation_outer is None:
        return float(bearing.roller_crown_radius or math.inf)
    return bearing.osculation_outer * bearing.outer_raceway_radius


def inner_raceway_contour_radius(bearing: Bearing) -> float:
    """Radius of the inner raceway's contour in the axial plane [m].

    Roller contour radius / inner osculation.

    Infinite where a cylindrical roller runs on it.

    Examples
    --------
    >>> from macroslip.bearing import Bearing
    >>> round(inner_raceway_contour_radius(Bearing.read("skf-240-600-bc")), 6)
    0.4149
    """
    return (
        math.inf
        if bearing.osculation_inner is None
        else roller_contour_radius(bearing) / bearing.osculation_inner
    )


def outer_raceway_contour_radius(bearing: Bearing) -> float:
    """Radius of the outer raceway's contour in the axial plane [m].

    Its sphere, or infinite under a cylindrical roller.

    Examples
    --------
    >>> from macroslip.bearing import Bearing
    >>> outer_raceway_contour_radius(Bearing.read("skf-240-600-bc"))
    0.4149
    """
    return math.inf if bearing.osculation_outer is None else bearing.outer_raceway_radius


def inner_curvatures(bearing: Bearing) -> Curvatures:
    """Curvature sums of the roller on the inner raceway [1/m].

    Rolling direction 1/r + cos(alpha)/r~_in; lateral 1/roller contour radius - 1/inner raceway
    contour radius.

    Examples
    --------
    >>> from macroslip.bearing import Bearing
    >>> curvatures = inner_curvatures(Bearing.read("skf-240-600-bc"))
    >>> round(curvatures.rolling, 4), round(curvatures.lateral, 6)
    (31.4705, 0.049188)
    """
    return Curvatures(
        1 / roller_radius(bearing)
        + math.cos(bearing.contact_angle) / inner_contact_radius(bearing),
        (1 - (bearing.osculation_inner or 0.0)) / roller_contour_radius(bearing),
    )


def outer_curvatures(bearing: Bearing) -> Curvatures:
    """Curvature sums of the roller on the outer raceway [1/m].

    Rolling direction 1/r - cos(alpha)/r~_out; lateral 1/roller contour radius - 1/sphere radius.

    Examples
    --------
    >>> from macroslip.bearing import Bearing
    >>> curvatures = outer_curvatures(Bearing.read("skf-240-600-bc"))
    >>> round(curvatures.rolling, 4), round(curvatures.lateral, 6)
    (26.1614, 0.049188)
    """
    return Curvatures(
        1 / roller_radius(bearing)
        - math.cos(bearing.contact_angle) / outer_contact_radius(bearing),
        (1 - (bearing.osculation_outer or 0.0)) / roller_contour_radius(bearing),
    )


def cage_curvatures(bearing: Bearing) -> Curvatures:
    """Curvature sums of the roller in its conforming cage pocket [1/m] (Hart et al., force 5).

    The pocket conforms as closely across the roller as along it: rolling direction 1/r -
    osculation/r, lateral as at the outer raceway. The spars of a cylindrical roller's cage are
    flat.

    Examples
    --------
    >>> from macroslip.bearing import Bearing
    >>> curvatures = cage_curvatures(Bearing.read("skf-240-600-bc"))
    >>> round(curvatures.rolling, 6), round(curvatures.lateral, 6)
    (0.571429, 0.049188)
    """
    across = (1 - (bearing.osculation_outer or 0.0)) / roller_radius(bearing)
    return Curvatures(across, outer_curvatures(bearing).lateral)


def roller_end_radius(bearing: Bearing) -> float:
    """Radius of the barrel roller at its ends [m], r less the sagitta of its contour.

    0 where the contour meets the axis.

    Examples
    --------
    >>> from macroslip.bearing import Bearing
    >>> round(roller_end_radius(Bearing.read("skf-240-600-bc")), 6)
    0.031531
    """
    contour = roller_contour_radius(bearing)
    half = bearing.roller_length / 2
    drop = contour
    if half < contour:
        drop = contour - math.sqrt(contour**2 - half**2)
    return max(0.0, roller_radius(bearing) - drop)


class Envelope(NamedTuple):
    """Space that a row's rollers need, from the corners of their ends."""

    #: Axial distance from the bearing's mid-plane [m]; a row that crosses the mid-plane has a
    #: negative `nearest`.
    nearest: float
    farthest: float
    #: Distance from the bearing axis, at the end that is farther from the mid-plane [m]
    inside: float


def envelope(bearing: Bearing) -> Envelope:
    """Space that a row's rollers need.

    The roller's axis leans by the contact angle, towards the bearing axis with growing distance
    from the mid-plane.

    Examples
    --------
    >>> from macroslip.bearing import Bearing
    >>> [round(place, 4) for place in envelope(Bearing.read("skf-240-600-bc"))]
    [0.0159, 0.1321, 0.3315]
    """
    sine = math.sin(bearing.contact_angle)
    cosine = math.cos(bearing.contact_angle)
    half = bearing.roller_length / 2
    end = roller_end_radius(bearing)
    return Envelope(
        nearest=bearing.row_offset - half * cosine - end * sine,
        farthest=bearing.row_offset + half * cosine + end * sine,
        inside=bearing.pitch_radius - half * sine - end * cosine,
    )


def initial_angles(row: str, rollers_per_row: int) -> FloatArray:
    """Positions of the Z rollers of a row at the start [rad], shape (Z,).

    They rise in even steps from the bottom.

    -pi/2 + 2 pi j/Z downwind and in a single row, -pi/2 + 2 pi (j + 1/2)/Z upwind: rows are
    staggered by half a pitch. Raises InputError for another row.

    Examples
    --------
    >>> np.degrees(initial_angles("downwind", 4)).round(9).tolist()
    [-90.0, 0.0, 90.0, 180.0]
    >>> np.degrees(initial_angles("upwind", 4)).round(9).tolist()
    [-45.0, 45.0, 135.0, 225.0]
    """
    if row not in _STAGGER:
        raise InputError(
            f"there is no row {row!r}",
            allowed=" or ".join(ROWS),
            remedy="Choose one of the two rows.",
        )
    pitches = np.arange(rollers_per_row) + _STAGGER[row]
    angles = 2 * np.pi * pitches / rollers_per_row
    return -np.pi / 2 + angles


def roller_mass(density: float, roller_radius: float, roller_length: float) -> float:
    """Mass of a roller [kg], m = rho pi r^2 l, from its density [kg/m3], radius [m] and length [m].

    Examples
    --------
    >>> round(roller_mass(7850, 0.035, 0.106), 6)
    3.202296
    """
    return density * math.pi * roller_radius**2 * roller_length


def spin_inertia(mass: float, roller_radius: float) -> float:
    """Moment of inertia of a roller about its own axis [kg m2], I_z' = m r^2/2, (13).

    From mass [kg] and radius [m].

    Examples
    --------
    >>> round(spin_inertia(3.2, 0.035), 9)
    0.00196
    """
    return mass * roller_radius**2 / 2
