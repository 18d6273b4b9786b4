"""Criteria of smearing and wear at the ribs of a tapered roller bearing.

A rib slides in pure rolling at every loaded roller, so that entries into a load zone do not
matter. No published limit of smearing is known to hold beyond the rig that it is from.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np
import xarray as xr

from macroslip.constants import YEAR
from macroslip.damage import wear
from macroslip.result.criteria.criterion import (
    Criterion,
    PageColumn,
    Values,
    Yearly,
    largest_of,
)
from macroslip.result.criteria.evaluation import Evaluation
from macroslip.result.criteria.wear import COMPARED_DEPTH, DESIGN_LIFE, MIDDLE_COEFFICIENT
from macroslip.result.variables import VARIABLES
from macroslip.variables import Variable


def _of_result(name: str) -> Callable[[Evaluation], Values]:
    """The variable of the result, where it has one."""

    def variables(evaluation: Evaluation) -> Values:
        if name not in evaluation.result:
            return {}
        return {name: evaluation.result[name].values}

    return variables


def _wear_time(evaluation: Evaluation) -> Values:
    """Time until the surface of the rib contact that wears faster has worn by 10 µm."""
    if "rib_asperity_work" not in evaluation.result or not evaluation.tells_of_year:
        return {}
    work = evaluation.result.rib_asperity_work.max("rib_surface").values
    with np.errstate(divide="ignore"):
        rates = np.array(evaluation.wear_coefficients) * work[:, None]
        return {"rib_wear_time": COMPARED_DEPTH / rates}


def _years(variables: Mapping[str, np.ndarray]) -> float:
    """Time to 10 µm at the middle coefficient, of the row that wears faster [years]."""
    if "rib_wear_time" not in variables:
        return math.nan
    times = variables["rib_wear_time"]
    middle = times.shape[1] // 2
    return float(times[:, middle].min()) / YEAR


def _wear_rate(_: xr.Dataset, result: xr.Dataset) -> xr.DataArray | None:
    """Growth of wear at the middle coefficient [m/s]; None where there is no rib."""
    if "rib_asperity_work" not in result:
        return None
    return MIDDLE_COEFFICIENT * result.rib_asperity_work.max("rib_surface")


CRITERIA = (
    Criterion(
        order=15,
        name="rib_pressure_speed",
        mechanism="smearing",
        quantity="pressure times speed at the rib",
        unit="W/m2",
        declares=(VARIABLES["rib_pressure_speed"],),
        variables=_of_result("rib_pressure_speed"),
        value=largest_of("rib_pressure_speed"),
        reference=math.nan,
        compared_with="",
        factor=2.0,
        reason="height and sphere of the rib contact",
    ),
    Criterion(
        order=16,
        name="rib_flash_temperature",
        mechanism="smearing",
        quantity="flash temperature at the rib",
        unit="K",
        declares=(VARIABLES["rib_flash_temperature"],),
        variables=_of_result("rib_flash_temperature"),
        value=largest_of("rib_flash_temperature"),
        reference=math.nan,
        compared_with="",
        factor=10.0,
        reason="oil at the rib",
    ),
    Criterion(
        order=45,
        name="rib_wear_time",
        mechanism="wear",
        quantity="time to 10 µm at the rib, middle k",
        unit="year",
        declares=(
            Variable(
                "rib_wear_time",
                ("row", "wear_coefficient"),
                "s",
                VARIABLES["rib_asperity_work"].when,
                "time like this window until the rib or the rollers' ends have worn by 10 um",
            ),
        ),
        variables=_wear_time,
        value=_years,
        reference=DESIGN_LIFE,
        compared_with="design life, IEC 61400",
        factor=10.0,
        reason="k; oil at the rib on top",
        lowest=True,
        references=(wear.REFERENCE,),
        yearly=(
            Yearly(
                run_name="rib_wear_rate",
                run_unit="m/s",
                run_meaning="growth of wear of the rib or the rollers' ends at k = 1e-17 m2/N",
                of_run=_wear_rate,
                name="rib_wear",
                drawn="max",
                year_unit="m",
                year_meaning="depth of wear of the rib or the rollers' ends at k = 1e-17 m2/N",
                unit="m/year",
                meaning="wear of the ribs at k = 1e-17 m²/N",
                design_column=PageColumn("wear of the ribs at k = 1e-17 m²/N [µm/year]", 1e6),
                year_column=PageColumn("wear of the ribs [µm]", 1e6),
            ),
        ),
    ),
)
