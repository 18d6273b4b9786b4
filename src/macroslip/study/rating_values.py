"""The numbers of a rating that the summary of a study keeps of a case."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from macroslip.errors import InputError
from macroslip.result.rating import rate_case

if TYPE_CHECKING:
    from macroslip.case.case import Case

_HERTZ = "load along the roller as in a Hertz contact"
#: Units and meaning of the numbers of the case.
VARIABLES = {
    "static_safety": ("1", "static safety factor C0/P0, the least"),
    "equivalent_load": ("N", "mean dynamic equivalent load P"),
    "basic_life": ("h", "basic rating life L10h, ISO 281"),
    "modified_life": ("h", "modified rating life, ISO 281"),
    "reference_life": ("h", f"basic reference rating life, ISO/TS 16281, {_HERTZ}"),
    "modified_reference_life": ("h", f"modified reference rating life, {_HERTZ}"),
    "viscosity_ratio": ("1", "viscosity ratio kappa at the mean speed"),
    "least_film_ratio": ("1", "film ratio Lambda, 5 % of loaded rollers below: least of all raceways"),
    "largest_pressure": ("Pa", "largest Hertz pressure of all raceways"),
    "share_below_minimum_load": ("1", "share of time in which P is below the maker's minimum load"),
    "share_below_fatigue_load_limit": ("1", "share of time in which P is below C_u"),
    "damage_equivalent_load_4": ("N", "range of the damage-equivalent radial load at 1 Hz, exponent 4"),
    "damage_equivalent_load_10": ("N", "range of the damage-equivalent radial load at 1 Hz, exponent 10"),
}


def rating_values(case: Case) -> dict[str, float]:
    """The numbers of a case; NaN for a case without a rating, or a bearing that lacks what a rating needs."""
    nothing = dict.fromkeys(VARIABLES, math.nan)
    if not case.rating:
        return nothing
    try:
        rating = rate_case(case)
    except InputError:
        return nothing
    range_of = rating.damage_equivalent_load.sel(load="radial")
    hertz = rating.sel(load_along_roller="hertz")
    derived = {
        "reference_life": hertz.reference_life,
        "modified_reference_life": hertz.modified_reference_life,
        "least_film_ratio": rating.film_ratio_low.min(),
        "largest_pressure": rating.largest_pressure.max(),
        "damage_equivalent_load_4": range_of.sel(wohler_exponent=4.0),
        "damage_equivalent_load_10": range_of.sel(wohler_exponent=10.0),
    }
    return {name: float(derived[name] if name in derived else rating[name]) for name in VARIABLES}
