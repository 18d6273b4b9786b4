"""The bearing file of an estimate: published values, medians with their ranges, and what follows by the standards."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from macroslip.bearing.bearing import Bearing
from macroslip.bearing.load_ratings import dynamic_load_rating, fatigue_load_limit

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from macroslip.bearing.makers_page import MakersPage

ROWS = 2
PERCENTILES = (10.0, 90.0)
"""Ends of the ranges that are given: four out of five samples lie between them."""

_NOTE = "estimate: median of what fits the maker's page, not the maker's drawing"
_ON_SPHERE = "from sphere, roller diameter and contact angle"
_OSCULATION = ("1", 3, "E", "usual for spherical roller bearings")
#: Unit, decimals, tag and note of what is sampled.
_WRITTEN = {
    "rollers_per_row": ("1", 0, "E", _NOTE),
    "roller_diameter": ("mm", 1, "E", _NOTE),
    "roller_length": ("mm", 1, "E", f"from the static load rating, ISO 76; {_NOTE}"),
    "contact_angle": ("deg", 2, "D", "from e = 1.5 tan(contact angle), ISO 281"),
    "outer_raceway_radius": ("mm", 1, "E", _NOTE),
    "diametral_clearance": ("mm", 3, "E", "operating; in proportion to the bore"),
}
_SCALES = {"mm": 1e3, "deg": 180.0 / math.pi, "1": 1.0}
#: Steel, cage and surfaces are taken from this bearing.
_STEEL_OF = "skf-240-600-bc"
_STEEL = (
    "youngs_modulus", "poisson_ratio", "density", "cage_youngs_modulus", "cage_poisson_ratio", "composite_roughness",
    "hardness", "thermal_conductivity", "specific_heat",
)  # fmt: skip


def estimated_record(page: MakersPage, drawn: Mapping[str, NDArray], name: str, title: str) -> Bearing:
    """The bearing of the medians; centres of the rollers lie on the sphere of the medians, as in every sample."""
    entries = {key: _entry(np.median(drawn[key]), drawn[key], *how) for key, how in _WRITTEN.items() if key in drawn}
    for side in ("inner", "outer"):
        entries[f"osculation_{side}"] = _entry(np.median(drawn["osculation"]), drawn["osculation"], *_OSCULATION)
    alpha = math.radians(entries["contact_angle"]["value"])
    centre = 1e-3 * (entries["outer_raceway_radius"]["value"] - 0.5 * entries["roller_diameter"]["value"])
    entries["pitch_radius"] = _entry(centre * math.cos(alpha), drawn["pitch_radius"], "mm", 1, "E", _ON_SPHERE)
    entries["row_offset"] = _entry(centre * math.sin(alpha), drawn["row_offset"], "mm", 1, "E", _ON_SPHERE)
    entries |= _published(page) | _ratings(page, entries)
    known = Bearing.read(_STEEL_OF).as_dict()
    same = {key: known[key] for key in _STEEL}
    return Bearing.from_dict({"name": name, "title": title} | entries | same)


def _entry(value: float, samples: NDArray, unit: str, digits: int, tag: str, note: str) -> dict:
    """An entry of a bearing file: the value as it would be written, with the range of the samples."""

    def written(number: float) -> float:
        rounded = round(float(number) * _SCALES[unit], digits)
        return int(rounded) if digits == 0 else rounded

    low, high = (written(limit) for limit in np.percentile(samples, PERCENTILES))
    middle = written(value)
    return {"value": middle, "unit": unit, "tag": tag, "note": note,
            "range": [min(low, middle), max(high, middle)]}  # fmt: skip


def _short(number: float) -> float:
    """The number without the rounding errors of its conversion, whole where it is whole."""
    rounded = float(f"{number:.9g}")
    return int(rounded) if rounded.is_integer() else rounded


def _published(page: MakersPage) -> dict[str, dict]:
    """Entries of the values on the page itself."""
    found = {
        "bore_diameter": (page.bore, "mm", "d"),
        "outside_diameter": (page.outside, "mm", "D"),
        "width": (page.width, "mm", "B"),
        "dynamic_load_rating": (page.dynamic_load_rating, "kN", "C"),
        "static_load_rating": (page.static_load_rating, "kN", "C0"),
        "fatigue_load_limit": (page.fatigue_load_limit, "kN", "C_u or P_u"),
        "axial_factor_e": (page.axial_factor_e, "1", "e"),
        "axial_factor_y1": (page.axial_factor_y1, "1", "Y1"),
        "axial_factor_y2": (page.axial_factor_y2, "1", "Y2"),
        "axial_factor_y0": (page.axial_factor_y0, "1", "Y0"),
        "mass": (page.mass, "kg", "mass"),
    }
    scales = {"mm": 1e3, "kN": 1e-3}
    return {
        key: {"value": _short(value * scales.get(unit, 1.0)), "unit": unit, "tag": "V",
              "note": f"maker's page, {symbol}"}
        for key, (value, unit, symbol) in found.items()
        if value is not None
    }  # fmt: skip


def _ratings(page: MakersPage, entries: Mapping[str, dict]) -> dict[str, dict]:
    """Entries of ratings and factors that the page leaves out, by the standards from the median geometry."""
    alpha = math.radians(entries["contact_angle"]["value"])
    diameter, length = 1e-3 * entries["roller_diameter"]["value"], 1e-3 * entries["roller_length"]["value"]
    pitch, count = 2e-3 * entries["pitch_radius"]["value"], entries["rollers_per_row"]["value"]
    found = {}
    if page.dynamic_load_rating is None:
        rating = dynamic_load_rating(ROWS, count, diameter, length, alpha, pitch)
        note = "ISO 281 from the estimated inside; makers publish up to a third more"
        found["dynamic_load_rating"] = {"value": round(rating / 1e3), "unit": "kN", "tag": "D", "note": note}
    if page.fatigue_load_limit is None:
        limit = fatigue_load_limit(page.static_load_rating, pitch)
        found["fatigue_load_limit"] = {"value": round(limit / 1e3), "unit": "kN", "tag": "D", "note": "ISO 281"}
    for name, factor in (("y1", 0.45), ("y2", 0.67), ("y0", 0.44)):
        if getattr(page, f"axial_factor_{name}") is None:
            value = round(factor / math.tan(alpha), 2)
            note = f"{factor} cot(contact angle)"
            found[f"axial_factor_{name}"] = {"value": value, "unit": "1", "tag": "D", "note": note}
    return found
