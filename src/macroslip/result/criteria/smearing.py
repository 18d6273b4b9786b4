"""Criteria of smearing, when a roller enters the load zone."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
import xarray as xr

from macroslip.damage import smearing
from macroslip.result.criteria.criterion import (
    WITH_ORBIT,
    Criterion,
    PageColumn,
    Values,
    Yearly,
    largest_of,
)
from macroslip.result.criteria.evaluation import Evaluation
from macroslip.variables import Variable

_NO_ENTRIES = (
    "No roller entered a load zone in a complete orbit of the window, so nothing is said of "
    "smearing at the raceways."
)
_OVER = ("row", "raceway")
#: Bounds of the number of entries of an orbit beyond a limit, by `smearing.entries_beyond`.
_BOUNDS = ("least", "most")


def _entries(evaluation: Evaluation) -> np.ndarray:
    return evaluation.result.entries.transpose("row", "roller", "orbit").values


def _declared(name: str, unit: str, meaning: str) -> tuple[Variable, ...]:
    """Variables of the largest value at entries, and of how many are beyond its reference."""
    counts = [
        Variable(
            f"{name}_beyond_{bound}",
            _OVER,
            "1/s",
            WITH_ORBIT,
            f"entries of all rollers beyond the reference of {name}, at {bound}",
        )
        for bound in _BOUNDS
    ]
    return (Variable(name, _OVER, unit, WITH_ORBIT, meaning), *counts)


def _largest(evaluation: Evaluation, criterion: Criterion) -> Values:
    """The largest value at entries, and how many are beyond its reference."""
    if not evaluation.result.sizes["orbit"]:
        return {}
    at_entries = evaluation.result[criterion.name].transpose(*_OVER, "roller", "orbit")
    # Unlike max, fmax does not warn where no roller entered.
    worst = at_entries.reduce(np.fmax.reduce, ("roller", "orbit")).values
    values: Values = {criterion.name: worst}
    limit = evaluation.reference(criterion)
    if math.isfinite(limit):
        count = _entries(evaluation)[:, None]
        scale = evaluation.all_rollers / evaluation.orbit_time()
        beyond = smearing.entries_beyond(at_entries.values, count, limit)
        for bound, number in zip(_BOUNDS, beyond, strict=True):
            values[f"{criterion.name}_beyond_{bound}"] = number * scale
    return values


def _slide_roll_ratio(evaluation: Evaluation) -> Values:
    """Entries a second, their least film ratio, and their largest slide-roll ratio."""
    if not evaluation.result.sizes["orbit"]:
        return {}
    scale = evaluation.all_rollers / evaluation.orbit_time()
    entries = np.nansum(_entries(evaluation), axis=(1, 2))
    film_ratios = evaluation.result.entry_film_ratio
    thinnest = film_ratios.reduce(np.fmin.reduce, ("roller", "orbit"))
    return {
        "entry_rate": entries * scale,
        "entry_film_ratio": thinnest.transpose(*_OVER).values,
        **_largest(evaluation, SLIDE_ROLL_RATIO),
    }


def _missing(evaluation: Evaluation, variables: Mapping[str, np.ndarray]) -> list[str]:
    entries = float(evaluation.result.entries.sum())
    return [] if entries > 0.0 else [_NO_ENTRIES]


def _of_raceways(name: str, criteria: xr.Dataset) -> xr.DataArray | None:
    """The larger of both raceways; None where no orbit is complete."""
    if name not in criteria:
        return None
    # A row into which no roller has entered has no slip; max would warn of it.
    return criteria[name].reduce(np.fmax.reduce, "raceway")


_IDLE = "oil at idle rollers"
SLIDE_ROLL_RATIO = Criterion(
    order=10,
    name="entry_slide_roll_ratio",
    mechanism="smearing",
    quantity="slide-roll ratio at entry",
    unit="1",
    declares=(
        Variable(
            "entry_rate",
            ("row",),
            "1/s",
            WITH_ORBIT,
            "entries into the load zone of all rollers of a row",
        ),
        Variable("entry_film_ratio", _OVER, "1", WITH_ORBIT, "least Lambda at entry"),
        *_declared("entry_slide_roll_ratio", "1", "largest slide-roll ratio while entering"),
    ),
    variables=_slide_roll_ratio,
    value=largest_of("entry_slide_roll_ratio"),
    missing=_missing,
    reference=smearing.RIG_SLIDE_ROLL_RATIO,
    compared_with="rig, light load, Evans 2013",
    factor=3.0,
    reason=_IDLE,
    references=smearing.REFERENCES,
    yearly=(
        Yearly(
            run_name="entry_rate",
            run_unit="1/s",
            run_meaning="entries beyond the slip of a smearing rig, of all rollers of the row, "
            "at least",
            of_run=lambda criteria, _: _of_raceways(
                "entry_slide_roll_ratio_beyond_least", criteria
            ),
            name="entries",
            drawn="sum",
            year_unit="1",
            year_meaning="entries beyond the slip of a smearing rig, all rollers of the row, "
            "at least",
            unit="1/year",
            meaning="entries beyond the slip of a smearing rig",
            needs_orbit=True,
            design_column=PageColumn("entries under slip [1/year]"),
            year_column=PageColumn("entries under slip"),
        ),
        Yearly(
            run_name="largest_entry_slip",
            run_unit="1",
            run_meaning="largest slide-roll ratio at an entry into the load zone",
            of_run=lambda criteria, _: _of_raceways("entry_slide_roll_ratio", criteria),
            name="entry_slip",
            drawn="largest",
            year_unit="1",
            year_meaning="largest slide-roll ratio at an entry of any run",
            unit="1",
            meaning="largest slide-roll ratio at an entry",
            design_column=PageColumn("smearing: largest slip at entry"),
            year_column=PageColumn("largest slip at entry"),
        ),
    ),
)


def _without_reference(order: int, name: str, unit: str, quantity: str) -> Criterion:
    """Criterion of the largest value at entries, for which no rig gives a reference."""
    criterion = Criterion(
        order=order,
        name=name,
        mechanism="smearing",
        quantity=f"{quantity} at entry",
        unit=unit,
        declares=_declared(name, unit, f"largest {quantity} while entering"),
        variables=lambda evaluation: _largest(evaluation, criterion),
        value=largest_of(name),
        reference=math.nan,
        compared_with="",
        factor=3.0,
        reason=_IDLE,
    )
    return criterion


POWER_DENSITY = _without_reference(11, "entry_power_density", "W/m2", "power density")
FLASH_TEMPERATURE = _without_reference(12, "entry_flash_temperature", "K", "flash temperature")
CRITERIA = (SLIDE_ROLL_RATIO, POWER_DENSITY, FLASH_TEMPERATURE)
