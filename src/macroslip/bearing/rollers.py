"""Checks of the rollers: their proportions, and whether they fit round the circumference."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from macroslip.errors import InputError
from macroslip.input.files import Source

if TYPE_CHECKING:
    from macroslip.bearing.bearing import Bearing
    from macroslip.bearing.tapered import TaperedBearing


def no_roller(bearing: Bearing | TaperedBearing, source: Source) -> Iterator[InputError]:
    """Yield a length that no roller of this diameter has."""
    slenderness = bearing.roller_length / bearing.roller_diameter
    if not 0.5 <= slenderness <= 4:
        yield InputError(
            f"roller_length is {bearing.written('roller_length')}, which is {slenderness:.3g} "
            "times roller_diameter",
            where=source.where("roller_length", "value"),
            allowed="0.5 to 4 times roller_diameter",
            remedy="Check roller_length and roller_diameter.",
        )


def overlapping(bearing: Bearing | TaperedBearing, source: Source) -> Iterator[InputError]:
    """Yield more rollers than fit round the circumference."""
    # Centres of neighbouring rollers are a chord of the pitch circle apart.
    half_pitch = math.pi / bearing.rollers_per_row
    spacing = 2 * bearing.pitch_radius * math.sin(half_pitch)
    if spacing <= bearing.roller_diameter:
        sine = bearing.roller_diameter / (2 * bearing.pitch_radius)
        narrowest = math.asin(min(1.0, sine))
        most = math.floor(math.pi / narrowest)
        yield InputError(
            f"{bearing.rollers_per_row} rollers do not fit round the circumference: "
            f"roller_diameter is {bearing.written('roller_diameter')}, centres are "
            f"{bearing.written('roller_diameter', spacing)} apart",
            where=source.where("rollers_per_row", "value"),
            allowed="2 pitch_radius sin(180 deg/rollers_per_row) > roller_diameter, here at most "
            f"{most} rollers",
            remedy="Check rollers_per_row, roller_diameter and pitch_radius; rollers_per_row "
            "counts one row only.",
        )
