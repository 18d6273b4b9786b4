"""Numbers of makers' pages from which the inside of bearings is estimated, as options of a command."""

from __future__ import annotations

from dataclasses import dataclass

from macroslip.input.units import FORCE, LENGTH, MASS, Dimension


@dataclass(frozen=True)
class PageOption:
    """A number of a maker's page."""

    name: str  #: Of the option of `macroslip bearing estimate`, without its dashes
    field: str  #: Of the class of the page
    help: str
    dimension: Dimension | None = None  #: Of a value with its unit; None for a number or a word
    type: type = float  #: Of a value without unit
    range: tuple[int, int] | None = None  #: Of a whole number


BORE = PageOption("bore", "bore", "Bore diameter d, with its unit: '630 mm'.", LENGTH)
OUTSIDE = PageOption("outside", "outside", "Outside diameter D: '920 mm'.", LENGTH)
WIDTH = PageOption("width", "width", "Width B, of a tapered bearing T or B: '290 mm'.", LENGTH)
STATIC_RATING = PageOption("c0", "static_load_rating", "Static load rating C0: '17600 kN'.", FORCE)
AXIAL_FACTOR_E = PageOption("e", "axial_factor_e", "Axial factor e: 0.30.")
DYNAMIC_RATING = PageOption("c", "dynamic_load_rating", "Dynamic load rating C: '9307 kN'.", FORCE)
FATIGUE_LIMIT = PageOption(
    "cu", "fatigue_load_limit", "Fatigue load limit C_u or P_u: '1180 kN'.", FORCE
)
BEARING_MASS = PageOption("mass", "mass", "Mass: '623 kg'.", MASS)
