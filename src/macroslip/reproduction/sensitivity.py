"""Sensitivity of energy and peak power to values that are uncertain: one at a time, each from a run of its own."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from macroslip.case.case import Case
from macroslip.study.outcome import Outcome
from macroslip.study.reader import open_study

if TYPE_CHECKING:
    import xarray as xr

LEVELS = ("low", "base", "high")


@dataclass(frozen=True, slots=True, kw_only=True)
class Variation:
    """One value that is varied.

    Parameters
    ----------
    name : str
        What it is, as in the figure.
    key : str
        Key under which the study file varies it.
    unit : str
        Unit of its values in the study file and of what `base` gives.
    base : callable
        base(case) -> the case's own value [unit].
    note : str
        What goes with it.
    """

    name: str
    key: str
    unit: str
    base: Callable[[Case], float]
    note: str = ""


VARIATIONS = (
    Variation(
        name="diametral clearance",
        key="bearing.diametral_clearance",
        unit="mm",
        base=lambda case: 1e3 * case.bearing.diametral_clearance,
    ),
    Variation(
        name="osculation",
        key="bearing.osculation_outer",
        unit="1",
        base=lambda case: case.bearing.osculation_outer,
        note="at both raceways; the cage pocket conforms with it",
    ),
    Variation(
        name="inlet temperature",
        key="lubricant.at",
        unit="°C",
        base=lambda case: case.lubricant.inlet_temperature - 273.15,
        note="viscosity, its coefficients, density and Eyring stress follow",
    ),
    Variation(
        name="bearing to gearbox",
        key="drivetrain.bearing_to_gearbox",
        unit="m",
        base=lambda case: case.drivetrain.bearing_to_gearbox,
        note="distance between the supports of the shaft, which turns hub loads into the load on the bearing",
    ),
    Variation(
        name="film factor",
        key="lubricant.starvation",
        unit="1",
        base=lambda case: case.lubricant.starvation if case.laws.starvation else 1.0,
        note="film thickness over that of the law, at every interface; 0.7 is reported for a starved bearing",
    ),
    Variation(
        name="Eyring stress",
        key="lubricant.eyring_stress",
        unit="MPa",
        base=lambda case: 1e-6 * (case.lubricant.eyring_stress or math.nan),
        note="stress at which the film thins under shear; what is reported for PAO near 1 GPa",
    ),
)


def sensitivity(directory: Path, case: Case) -> xr.Dataset:
    """Energy and peak power with each value low and high, all others as in the base case.

    Parameters
    ----------
    directory : Path
        Folder of the results of a study whose first run is the base case, and whose others vary one value each.
    case : Case
        The base case.

    Returns
    -------
    xarray.Dataset
        Over (variation, level): value, in the unit of the coordinate `unit`; over (variation, level, row):
        energy [J] in the window, mean over the rollers; peak_power [W], mean over rollers and orbits of the largest
        power at any interface per orbit; failed, the number of failed rollers. A mean that a failed roller enters is
        NaN. Low and high are the lowest and the highest value that the model does not refuse, because a contact ellipse
        would reach past the roller's ends, for example; the coordinate `refused` over variation has those that it does refuse.
        Where the study has no value on a side, it is that of the base case.
    """
    import xarray as xr

    study = open_study(directory)
    used = [one for one in VARIATIONS if one.key in study.coords]
    runs, values, refused = [], [], []
    stored = np.array([Outcome(outcome).stored for outcome in study.outcome.values])
    for one in used:
        tried = study[one.key].values
        known = {float(tried[k]): k for k in np.flatnonzero(stored & np.isfinite(tried))} | {one.base(case): 0}
        levels = (min(known), one.base(case), max(known))
        values.append(levels)
        runs.append([known[value] for value in levels])
        wrong = np.flatnonzero(~stored & np.isfinite(tried))
        refused.append(" ".join(_refusal(one, tried[k], study.reason.values[k]) for k in wrong))
    chosen = np.array(runs)
    of_level = ("variation", "level")
    of_row = (*of_level, "row")
    table = xr.Dataset(
        {
            "energy": (
                of_row,
                study.energy_mean.values[chosen],
                {"units": "J", "long_name": "energy in the window, mean over the rollers of the row"},
            ),
            "peak_power": (
                of_row,
                study.peak_power_mean.values[chosen],
                {"units": "W", "long_name": "mean over rollers and orbits of P_max per orbit"},
            ),
            "failed": (
                of_row,
                study.failed_rollers.values[chosen].astype(int),
                {"units": "1", "long_name": "failed rollers"},
            ),
            "value": (
                of_level,
                np.array(values, dtype=float),
                {"long_name": "varied value, in the unit of its variation", "units": "1"},
            ),
        },
        {"row": study.row.values, "level": list(LEVELS), "variation": [one.name for one in used]},
        {"title": f"Sensitivity under {case.loads.source}", "source_load": case.loads.source},
    )
    return table.assign_coords(
        unit=("variation", [one.unit for one in used]),
        note=("variation", [one.note for one in used]),
        refused=("variation", refused),
    )


def _refusal(variation: Variation, value: float, reason: str) -> str:
    unit = "" if variation.unit == "1" else f" {variation.unit}"
    return f"{value:g}{unit} is refused: {reason}"
