"""Whether the parts of a bearing fit into each other."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from macroslip.bearing import geometry
from macroslip.errors import InputError

if TYPE_CHECKING:
    from macroslip.bearing.bearing import Bearing
    from macroslip.catalogue.source import Source

SPHERE_TOLERANCE = 0.01
"""Relative difference allowed between given and computed positions of the roller centre: drawings round."""


def misfits(bearing: Bearing, source: Source) -> Iterator[InputError]:
    """What makes a bearing impossible, one error each.

    Parameters
    ----------
    bearing : Bearing
        With every value in its own range.
    source : Source
        Where the values were written.
    """
    # Positions or shapes that contradict each other make all that is computed from them meaningless.
    contradictions = [*_centres(bearing, source), *_shape(bearing, source)]
    yield from contradictions
    yield from _spacing(bearing, source)
    if not contradictions:
        yield from _rows(bearing, source)
        yield from _rings(bearing, source)


def _centres(bearing: Bearing, source: Source) -> Iterator[InputError]:
    centre = bearing.outer_raceway_radius - bearing.roller_diameter / 2
    for key, expected, formula in (
        ("pitch_radius", centre * math.cos(bearing.contact_angle), "cos(contact_angle)"),
        ("row_offset", centre * math.sin(bearing.contact_angle), "sin(contact_angle)"),
    ):
        if abs(getattr(bearing, key) - expected) > SPHERE_TOLERANCE * abs(expected):
            yield InputError(
                f"{key} is {bearing.written(key)}, but rollers that touch the outer raceway sphere have "
                f"(outer_raceway_radius - roller_diameter/2) {formula} = {bearing.written(key, expected)}",
                where=source.where(key, "value"),
                allowed=f"agreement within {SPHERE_TOLERANCE:.0%}",
                remedy="Check pitch_radius, row_offset, outer_raceway_radius, roller_diameter and contact_angle.",
            )


def _spacing(bearing: Bearing, source: Source) -> Iterator[InputError]:
    # Centres of neighbouring rollers are a chord of the pitch circle apart.
    spacing = 2 * bearing.pitch_radius * math.sin(math.pi / bearing.rollers_per_row)
    if spacing <= bearing.roller_diameter:
        most = math.floor(math.pi / math.asin(min(1.0, bearing.roller_diameter / (2 * bearing.pitch_radius))))
        yield InputError(
            f"{bearing.rollers_per_row} rollers do not fit round the circumference: roller_diameter is "
            f"{bearing.written('roller_diameter')}, centres are {bearing.written('roller_diameter', spacing)} apart",
            where=source.where("rollers_per_row", "value"),
            allowed=f"2 pitch_radius sin(180 deg/rollers_per_row) > roller_diameter, here at most {most} rollers",
            remedy="Check rollers_per_row, roller_diameter and pitch_radius; rollers_per_row counts one row only.",
        )


def _shape(bearing: Bearing, source: Source) -> Iterator[InputError]:
    slenderness = bearing.roller_length / bearing.roller_diameter
    if not 0.5 <= slenderness <= 4:
        yield InputError(
            f"roller_length is {bearing.written('roller_length')}, which is {slenderness:.3g} times roller_diameter",
            where=source.where("roller_length", "value"),
            allowed="0.5 to 4 times roller_diameter",
            remedy="Check roller_length and roller_diameter.",
        )


def _rows(bearing: Bearing, source: Source) -> Iterator[InputError]:
    space = geometry.envelope(bearing)
    if space.nearest < 0.0:
        overlap = bearing.written("row_offset", -2.0 * space.nearest)
        coincide = bearing.row_offset == 0.0
        what = "both rows lie in one plane" if coincide else f"the rollers of the two rows overlap by {overlap}"
        yield InputError(
            f"{what}: row_offset is {bearing.written('row_offset')}, roller_length {bearing.written('roller_length')}",
            where=source.where("row_offset", "value"),
            allowed="rollers that end before the mid-plane: row_offset > roller_length/2 cos(contact_angle) + end radius "
            f"sin(contact_angle) = {bearing.written('row_offset', bearing.row_offset - space.nearest)}",
            remedy="Check roller_length, contact_angle and outer_raceway_radius.",
        )
    if bearing.width is not None and space.farthest > bearing.width / 2:
        yield InputError(
            f"the rollers reach {bearing.written('width', space.farthest)} from the mid-plane, farther than the faces of "
            f"a bearing of width {bearing.written('width')}",
            where=source.where("width", "value"),
            allowed=f"a width of at least {bearing.written('width', 2.0 * space.farthest)} for these rollers",
            remedy="Check width, roller_length, contact_angle and outer_raceway_radius.",
        )


def _rings(bearing: Bearing, source: Source) -> Iterator[InputError]:
    bore, outside = bearing.bore_diameter, bearing.outside_diameter
    if bore is not None and outside is not None and bore >= outside:
        yield InputError(
            f"bore_diameter is {bearing.written('bore_diameter')}",
            where=source.where("bore_diameter", "value"),
            allowed=f"less than outside_diameter, {bearing.written('bore_diameter', outside)}",
            remedy="Check both diameters.",
        )
    inside = geometry.envelope(bearing).inside
    if bore is not None and inside <= bore / 2 and (outside is None or bore < outside):
        yield InputError(
            f"bore_diameter is {bearing.written('bore_diameter')}, so that nothing is left of the inner ring below the "
            "rollers",
            where=source.where("bore_diameter", "value"),
            allowed=f"below {bearing.written('bore_diameter', 2.0 * inside)}, the smallest diameter of the inner raceway",
            remedy="Check bore_diameter, outer_raceway_radius, roller_diameter and roller_length.",
        )
    if outside is not None and outside / 2 <= bearing.outer_raceway_radius:
        yield InputError(
            f"outside_diameter is {bearing.written('outside_diameter')}, smaller than the outer raceway sphere",
            where=source.where("outside_diameter", "value"),
            allowed=f"above {bearing.written('outside_diameter', 2.0 * bearing.outer_raceway_radius)}, twice "
            "outer_raceway_radius",
            remedy="Check outside_diameter and outer_raceway_radius, which is no diameter.",
        )
