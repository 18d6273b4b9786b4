"""Section of a cylindrical roller bearing, to scale, with every dimension."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.bearing import geometry
from macroslip.kinds.captions import LINE, ROLLER, STEEL, caption, write_column

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from macroslip.arrays import FloatArray
    from macroslip.bearing import Bearing

_MILLI = 1e3
#: Thickness of a ring behind its raceway over the roller's diameter, and width of the rings over the
#: roller's length, where they are not given.
_THICKNESS = 0.5
_WIDTH = 1.4
#: Dimensions that are named left and right of the section.
_LEFT = ("bore_diameter", "outside_diameter", "width", "rollers_per_row", "diametral_clearance")
_RIGHT = (
    "roller_diameter",
    "roller_length",
    "roller_crown_radius",
    "pitch_radius",
    "outer_raceway_radius",
)


def draw_straight_section(axes: Axes, bearing: Bearing) -> None:
    """Draw the section of a cylindrical roller bearing above its axis to scale, without flanges.

    Rings end behind the raceways where bore, outside diameter or width are not given.

    Parameters
    ----------
    axes : Axes
        Empty and of equal aspect.
    bearing : Bearing
        A cylindrical one.
    """
    radius = _MILLI * geometry.roller_radius(bearing)
    pitch = _MILLI * bearing.pitch_radius
    outer_raceway = _MILLI * bearing.outer_raceway_radius
    inner_raceway = pitch - radius
    half = 0.5 * _MILLI * (bearing.width or _WIDTH * bearing.roller_length)
    outside = outer_raceway + 2.0 * _THICKNESS * radius
    if bearing.outside_diameter is not None:
        outside = 0.5 * _MILLI * bearing.outside_diameter
    bore = inner_raceway - 2.0 * _THICKNESS * radius
    if bearing.bore_diameter is not None:
        bore = 0.5 * _MILLI * bearing.bore_diameter
    for low, high in ((outer_raceway, outside), (bore, inner_raceway)):
        corners = [-half, half, half, -half], [low, low, high, high]
        axes.fill(*corners, fc=STEEL, ec="black", lw=1.0)
    axes.fill(*_roller(bearing), fc=ROLLER, ec="black", lw=1.0, zorder=3)
    reach = 1.1 * outside
    axes.plot([-0.9 * reach, 0.9 * reach], [0, 0], color="black", lw=0.8, ls="-.")
    axes.plot([0, 0], [0, 1.04 * outside], color="black", lw=0.6, ls="-.")
    axes.plot([-1.2 * half, 1.2 * half], [pitch, pitch], color=LINE, lw=0.6, ls="-.")
    axes.text(0.0, 1.14 * outside, bearing.name, ha="center", va="center", fontsize=12)
    axes.text(-0.9 * reach, 0.03 * outside, "bearing axis", va="bottom", fontsize=9)
    axes.set(xlim=(-reach, reach), ylim=(-0.08 * outside, 1.2 * outside))
    _words(axes, bearing, reach, outside)


def _roller(bearing: Bearing) -> tuple[FloatArray, FloatArray]:
    """Outline of the roller [mm], along the bearing's axis and from it.

    A profile drops by some micrometres, which no line shows; a crown may be seen.
    """
    half = 0.5 * bearing.roller_length
    along = np.linspace(-half, half, 101)
    drop = np.zeros(along.size)
    crown = bearing.roller_crown_radius
    if crown is not None:
        drop = crown - np.sqrt(crown**2 - along**2)
    height = geometry.roller_radius(bearing) - drop
    axial = np.concatenate([along, along[::-1]])
    radial = bearing.pitch_radius + np.concatenate([height, -height[::-1]])
    return _MILLI * axial, _MILLI * radial


def _words(axes: Axes, bearing: Bearing, reach: float, outside: float) -> None:
    """Names and values of the dimensions, with their tags, and the profile of the rollers."""
    for side, keys in ((-1, _LEFT), (1, _RIGHT)):
        lines = [caption(bearing, key) for key in keys if key in bearing.provenance]
        if side > 0 and bearing.roller_profile is not None:
            lines.append(f"roller_profile: {bearing.roller_profile}")
        write_column(axes, lines, side, reach, 0.95, outside)
