"""Section of a tapered roller bearing, to scale, with apexes, rows and every dimension."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.bearing.tapered.geometry import TaperedGeometry
from macroslip.kinds.captions import ROLLER, STEEL, caption, write_column

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    Points = NDArray[np.float64]

#: Thickness of a ring behind a raceway over the roller's diameter where no diameter is given.
_THICKNESS = 0.5
#: Height of a rib over that of its contact.
_RIB = 2.0
#: Sign s of the thrust along Z0 that a row carries.
_SIGNS = {"downwind": 1, "upwind": -1}


@dataclass(frozen=True)
class _Row:
    """A row in the section; lengths in mm, Z to the right, downwind."""

    bearing: TaperedBearing
    geometry: TaperedGeometry
    sign: int  #: s, direction of the thrust that the row carries
    colour: str

    @property
    def middle(self) -> float:
        """Z of the rollers' middles; in O arrangement the row lies against its thrust."""
        side = -self.sign if self.bearing.arrangement == "O" else self.sign
        return 1e3 * side * self.bearing.row_offset

    @property
    def apex(self) -> float:
        """Z of the apex."""
        row = self.geometry
        along_axis = 1e3 * row.apex_distance * math.cos(row.axis_angle)
        return self.middle + self.sign * along_axis

    def points(self, places: Points, heights: Points) -> tuple[Points, Points]:
        """Z and R of points ζ along a roller's axis and heights over it [m], outwards positive."""
        row = self.geometry
        cosine = math.cos(row.axis_angle)
        sine = math.sin(row.axis_angle)
        from_apex = row.apex_distance + np.asarray(places)
        across = np.asarray(heights)
        along_bearing = 1e3 * (from_apex * cosine - across * sine)
        radial = 1e3 * (from_apex * sine + across * cosine)
        return self.apex - self.sign * along_bearing, radial

    def roller(self) -> tuple[Points, Points]:
        """Outline of the roller: a cone with a spherical large end."""
        row = self.geometry
        half = 0.5 * row.roller_length
        large = row.radius_at(half)
        last = math.asin(large / row.sphere_radius)
        turn = np.linspace(-1.0, 1.0, 41) * last
        middle = row.sphere_distance - row.apex_distance
        end = middle + row.sphere_radius * np.cos(turn)
        # The sphere of the large end stands out; the rim lies where the cone ends.
        end += half - end[0]
        small = row.radius_at(-half)
        sphere = row.sphere_radius * np.sin(turn)
        places = np.concatenate([[-half], end, [-half]])
        heights = np.concatenate([[-small], sphere, [small]])
        return self.points(places, heights)

    def outer_ring(self, outside: float) -> tuple[Points, Points]:
        """Outline of the outer ring up to its outside radius [mm]."""
        row = self.geometry
        half = 0.55 * row.roller_length
        places = np.array([-half, half])
        axial, radial = self.points(places, row.radius_at(places))
        outline_axial = np.concatenate([axial, axial[::-1]])
        outline_radial = np.concatenate([radial, [outside, outside]])
        return outline_axial, outline_radial

    def inner_ring(self, bore: float) -> tuple[Points, Points]:
        """Outline of the inner ring with its rib, down to its bore radius [mm]."""
        row = self.geometry
        half = 0.5 * row.roller_length
        top = row.radius_at(half) - _RIB * row.rib_contact_height
        back = half + 0.2 * row.roller_length
        places = np.array([-half, half, half, back])
        small = row.radius_at(-half)
        large = row.radius_at(half)
        heights = np.array([-small, -large, -top, -top])
        axial, radial = self.points(places, heights)
        outline_axial = np.concatenate([axial, [axial[-1], axial[0]]])
        outline_radial = np.concatenate([radial, [bore, bore]])
        return outline_axial, outline_radial


def draw_tapered_section(axes: Axes, bearing: TaperedBearing, colours: Mapping[str, str]) -> None:
    """Draw the section of a tapered roller bearing above its axis to scale.

    Rows are named by the thrust that they carry, and the drawing says where each of them lies.
    Outside and bore are drawn where they are given; rings end behind the raceways without them.
    Depths of ribs and widths of rings are not those of a drawing.

    Parameters
    ----------
    axes : Axes
        Empty and of equal aspect.
    bearing : TaperedBearing
    colours : mapping
        Colours of the rows by their names.
    """
    row = tapered_geometry(bearing)
    rows = {name: _Row(bearing, row, sign, colours[name]) for name, sign in _SIGNS.items()}
    outside = _outside(bearing, row)
    for drawn in rows.values():
        axes.fill(*drawn.outer_ring(outside), fc=STEEL, ec="black", lw=1.0)
        axes.fill(*drawn.inner_ring(_bore(bearing, row)), fc=STEEL, ec="black", lw=1.0)
        axes.fill(*drawn.roller(), fc=ROLLER, ec="black", lw=1.0, zorder=3)
    farthest_apex = max(abs(drawn.apex) for drawn in rows.values())
    reach = max(1.1 * farthest_apex, 1.8 * outside)
    axes.set(xlim=(-reach, reach), ylim=(-0.22 * outside, 1.45 * outside))
    _apexes(axes, rows)
    _words(axes, bearing, rows, reach, outside)


def _outside(bearing: TaperedBearing, row: TaperedGeometry) -> float:
    """Outside radius [mm]; behind the raceway where it is not given."""
    if bearing.outside_diameter is not None:
        return 0.5e3 * bearing.outside_diameter
    growth = 0.55 * row.roller_length / row.apex_distance
    largest = row.outer_radius * (1.0 + growth)
    return 1e3 * (largest + _THICKNESS * bearing.roller_diameter)


def _bore(bearing: TaperedBearing, row: TaperedGeometry) -> float:
    """Bore radius [mm]; behind the raceway where it is not given."""
    if bearing.bore_diameter is not None:
        return 0.5e3 * bearing.bore_diameter
    narrowing = 0.5 * row.roller_length / row.apex_distance
    least = row.inner_radius * (1.0 - narrowing)
    return 1e3 * (least - _THICKNESS * bearing.roller_diameter)


def _apexes(axes: Axes, rows: dict[str, _Row]) -> None:
    """Lines of contact and the roller's axis up to the apex of every row."""
    for row in rows.values():
        geometry = row.geometry
        for angle, style in (
            (geometry.outer_angle, "-"),
            (geometry.axis_angle, "-."),
            (geometry.inner_angle, "-"),
        ):
            distance = 1e3 * geometry.apex_distance
            if angle != geometry.axis_angle:
                distance /= math.cos(geometry.half_cone_angle)
            axial = row.apex - row.sign * distance * math.cos(angle)
            radial = distance * math.sin(angle)
            axes.plot([axial, row.apex], [radial, 0.0], style, color=row.colour, lw=0.7)
        axes.plot([row.apex], [0.0], "o", color=row.colour, ms=4)


def _words(
    axes: Axes, bearing: TaperedBearing, rows: dict[str, _Row], reach: float, outside: float
) -> None:
    """Axis, rows and dimensions in words."""
    axes.plot([-0.98 * reach, 0.98 * reach], [0, 0], color="black", lw=0.8, ls="-.")
    axes.plot([0, 0], [0, 1.05 * outside], color="black", lw=0.6, ls="-.")
    axes.annotate(
        "",
        (0.98 * reach, -0.12 * outside),
        (0.78 * reach, -0.12 * outside),
        arrowprops={"arrowstyle": "->", "color": "black"},
    )
    axes.text(0.77 * reach, -0.12 * outside, "+Z0, downwind", ha="right", va="center", fontsize=9)
    axes.text(-0.97 * reach, -0.12 * outside, "dots: apexes", va="center", fontsize=9)
    axes.text(
        0.0,
        1.36 * outside,
        f"{bearing.name}, {bearing.arrangement} arrangement",
        ha="center",
        va="center",
        fontsize=12,
    )
    for name, row in rows.items():
        side = "upwind" if row.middle < 0.0 else "downwind"
        thrust = "+Z0" if row.sign > 0 else "−Z0"
        text = f"row “{name}”:\ncarries thrust along {thrust},\nlies {side} of the mid-plane"
        at = math.copysign(0.55 * reach, row.middle)
        axes.annotate(
            text,
            (row.middle, 1e3 * row.geometry.pitch_radius),
            (at, 1.18 * outside),
            ha="center",
            va="center",
            fontsize=9,
            color=row.colour,
            arrowprops={"arrowstyle": "-", "color": row.colour, "lw": 0.6},
            zorder=6,
        )
    _dimensions(axes, bearing, reach, outside)


def _dimensions(axes: Axes, bearing: TaperedBearing, reach: float, outside: float) -> None:
    """Names and values of the dimensions, with their tags, on both sides of the drawing."""
    left = ["rollers_per_row", "roller_diameter", "roller_length", "pitch_radius", "row_offset"]
    for key in ("bore_diameter", "outside_diameter"):
        if getattr(bearing, key) is not None:
            left.append(key)
    right = ["outer_angle", "preload", "rib_sphere_ratio", "rib_contact_height", "rib_oil_supply"]
    for side, keys in ((-1, left), (1, right)):
        lines = [caption(bearing, key) for key in keys]
        write_column(axes, lines, side, reach, 0.98, outside)
