"""Section of a bearing with rows in a sphere, to scale, with every dimension."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from macroslip.bearing import geometry
from macroslip.kinds.captions import LINE, ROLLER, STEEL, caption

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from macroslip.arrays import FloatArray
    from macroslip.bearing import Bearing

_SPHERE = "#b3261e"
_MILLI = 1e3
#: Along and across the bearing's axis [mm].
_Point = tuple[float, float]


def draw_section(axes: Axes, bearing: Bearing) -> None:
    """Draw the section of a bearing above its axis to scale, without flanges of the inner ring.

    Rings are drawn where bore, outside diameter and width are given.
    """
    width = bearing.width
    if width is None:
        width = 2.1 * geometry.envelope(bearing).farthest
    half = 0.5 * _MILLI * width
    _rings(axes, bearing, half)
    for side in (-1, 1):
        axes.fill(*_roller(bearing, side), fc=ROLLER, ec="black", lw=1.0, zorder=3)
    _dimensions(axes, bearing, half)
    end = 1.15 * half
    axes.plot([-end, end], [0, 0], color="black", lw=0.8, ls="-.")
    axes.text(-1.17 * half, 0, "bearing axis", ha="right", va="center", fontsize=9)
    outside = _outside(bearing)
    axes.set(xlim=(-3.0 * half, 3.0 * half), ylim=(-0.08 * outside, 1.2 * outside))
    axes.text(0, 1.14 * outside, bearing.name, ha="center", va="center", fontsize=12)


def _outside(bearing: Bearing) -> float:
    diameter = bearing.outside_diameter
    if diameter is None:
        return 1.05 * _MILLI * bearing.outer_raceway_radius
    return 0.5 * _MILLI * diameter


def _rings(axes: Axes, bearing: Bearing, half: float) -> None:
    along = np.linspace(-half, half, 401)
    sphere = _MILLI * bearing.outer_raceway_radius
    raceway = np.sqrt(sphere**2 - along**2)
    if bearing.outside_diameter is not None:
        axes.fill_between(along, raceway, _outside(bearing), fc=STEEL, ec="black", lw=1.0)
    if bearing.bore_diameter is not None:
        bore = 0.5 * _MILLI * bearing.bore_diameter
        inner = _inner_raceway(bearing, np.abs(along))
        axes.fill_between(along, bore, inner, fc=STEEL, ec="black", lw=1.0)
    turn = np.radians(np.linspace(-40, 40, 200))
    axial = sphere * np.sin(turn)
    radial = sphere * np.cos(turn)
    axes.plot(axial, radial, color=_SPHERE, lw=0.8, ls=":")


def _inner_raceway(bearing: Bearing, distance: FloatArray) -> FloatArray:
    """Distance of the inner raceway from the axis [mm] at distances from the mid-plane [mm]."""
    contour = _MILLI * geometry.inner_raceway_contour_radius(bearing)
    reach = contour - 0.5 * _MILLI * bearing.roller_diameter
    offset = _MILLI * bearing.row_offset
    pitch = _MILLI * bearing.pitch_radius
    along = offset + reach * math.sin(bearing.contact_angle)
    across = pitch + reach * math.cos(bearing.contact_angle)
    height_square = contour**2 - (distance - along) ** 2
    return across - np.sqrt(np.maximum(height_square, 0.0))


def _roller(bearing: Bearing, side: int) -> tuple[FloatArray, FloatArray]:
    """Outline of a roller in the section [mm], along and across the bearing's axis."""
    contour = geometry.roller_contour_radius(bearing)
    half = 0.5 * bearing.roller_length
    along = np.linspace(-half, half, 101)
    drop = contour - np.sqrt(contour**2 - along**2)
    radius = geometry.roller_radius(bearing) - drop
    along = np.concatenate([along, along[::-1]])
    radius = np.concatenate([radius, -radius[::-1]])
    sine = math.sin(bearing.contact_angle)
    cosine = math.cos(bearing.contact_angle)
    axial = bearing.row_offset + along * cosine + radius * sine
    radial = bearing.pitch_radius - along * sine + radius * cosine
    return side * _MILLI * axial, _MILLI * radial


class _Section(NamedTuple):
    """Lengths of the section [mm], and the contact angle's sine and cosine [1]."""

    half: float  #: Of the bearing's width
    offset: float  #: Of the row from the mid-plane
    pitch: float
    sphere: float
    outside: float
    radius: float  #: Of the roller
    length: float  #: Half of the roller's
    sine: float
    cosine: float

    @classmethod
    def of(cls, bearing: Bearing, half: float) -> _Section:
        """The lengths that a drawing of a bearing takes."""
        return cls(
            half,
            _MILLI * bearing.row_offset,
            _MILLI * bearing.pitch_radius,
            _MILLI * bearing.outer_raceway_radius,
            _outside(bearing),
            0.5 * _MILLI * bearing.roller_diameter,
            0.5 * _MILLI * bearing.roller_length,
            math.sin(bearing.contact_angle),
            math.cos(bearing.contact_angle),
        )


def _dimensions(axes: Axes, bearing: Bearing, half: float) -> None:
    """Arrows for lengths, and name and value of every dimension beside the drawing."""
    section = _Section.of(bearing, half)
    arrows = _arrows(section)
    labels = _labels(section, bearing)
    if bearing.width is not None:
        height = 1.03 * section.outside
        arrows.append(((-half, height), (half, height), "black"))
        labels.append(("width", -1, height, (-half, height)))
    for key, share in (("bore_diameter", 0.75), ("outside_diameter", 0.95)):
        diameter = getattr(bearing, key)
        if diameter is not None:
            end = 0.5 * _MILLI * diameter
            axial = -share * half
            arrows.append(((axial, 0), (axial, end), "black"))
            height = (1.0 - share) * end + 0.02 * section.outside
            labels.append((key, -1, height, (axial, (1.1 - share) * end)))
    offset = section.offset
    pitch = section.pitch
    axes.plot([0, 0], [0, 1.04 * section.outside], color="black", lw=0.6, ls="-.")
    axes.plot([offset, offset], [0.70 * pitch, pitch], color=LINE, lw=0.6)
    axes.plot([-1.1 * half, -offset], [pitch, pitch], color=LINE, lw=0.6)
    turn = np.linspace(0, bearing.contact_angle, 30)
    arc = 0.3 * section.sphere
    axes.plot(arc * np.sin(turn), arc * np.cos(turn), color=_SPHERE, lw=1.2)
    for start, end, colour in arrows:
        style = {"arrowstyle": "<->", "color": colour, "lw": 1.0, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", end, start, arrowprops=style, zorder=5)
    for key, side, height, to in labels:
        alignment = "left" if side > 0 else "right"
        style = {"ha": alignment, "va": "center", "fontsize": 9}
        line = {"arrowstyle": "-", "color": "#777777", "lw": 0.6}
        at = (1.25 * side * half, height)
        axes.annotate(caption(bearing, key), to, at, arrowprops=line, zorder=6, **style)


def _arrows(section: _Section) -> list[tuple[_Point, _Point, str]]:
    """Start, end and colour of the arrows that every bearing has."""
    half, z, y, sphere, _, r, length, sine, cosine = section
    # Half of a roller's diameter and of its length, along and across the bearing's axis.
    radius_z = r * sine
    radius_y = r * cosine
    length_z = length * cosine
    length_y = length * sine
    return [
        ((0, 0), (sphere * sine, sphere * cosine), _SPHERE),
        ((0, 0.72 * y), (z, 0.72 * y), LINE),
        ((-1.08 * half, 0), (-1.08 * half, y), LINE),
        ((-z - radius_z, y + radius_y), (-z + radius_z, y - radius_y), LINE),
        ((-z + length_z, y + length_y), (-z - length_z, y - length_y), LINE),
    ]


def _labels(section: _Section, bearing: Bearing) -> list[tuple[str, int, float, _Point]]:
    """Key, side and height of the words that every bearing has, and the place they belong to."""
    half, z, y, sphere, outside, r, length, sine, cosine = section
    middle = 0.5 * bearing.contact_angle
    contact = math.sqrt(sphere**2 - z**2)
    inner = float(_inner_raceway(bearing, np.array([z]))[0])
    return [
        ("outer_raceway_radius", 1, 0.42 * y, (0.45 * sphere * sine, 0.45 * sphere * cosine)),
        ("row_offset", 1, 0.66 * y, (0.8 * z, 0.72 * y)),
        ("contact_angle", 1, 0.2 * y, (0.3 * sphere * math.sin(middle), 0.3 * sphere)),
        ("osculation_outer", 1, 1.08 * outside, (1.05 * z, contact)),
        ("osculation_inner", 1, 0.8 * y, (z, inner)),
        ("rollers_per_row", 1, y, (z + 0.5 * length, y)),
        ("pitch_radius", -1, 0.5 * y, (-1.08 * half, 0.5 * y)),
        ("roller_diameter", -1, y + 1.1 * r, (-z - 0.5 * r * sine, y + 0.5 * r)),
        ("roller_length", -1, y - 1.1 * r, (-z - 0.6 * length, y - 0.6 * length * sine)),
        ("diametral_clearance", -1, 1.1 * outside, (-0.7 * z, contact)),
    ]
