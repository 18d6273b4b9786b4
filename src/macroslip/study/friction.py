"""Table of friction torque from a study over temperature and supply of oil."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from os import PathLike
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from macroslip.case.oil_supply import SKF
from macroslip.constants import ZERO_CELSIUS
from macroslip.errors import InputError
from macroslip.result.run_input import stored_settings
from macroslip.scada.friction_table import FrictionTable
from macroslip.scada.speed_exponents import speed_exponents
from macroslip.study.labels import CHOICES, events_of_runs, is_parameter, labels_over
from macroslip.study.reader import open_study, stored_results
from macroslip.study.settings import read_loads
from macroslip.study.study_file import Study, study_of

#: Labels by which the runs of a study are sorted into a table.
WIND = "wind_speed"
OIL = "lubricant.at"
SUPPLY = "oil_supply"
#: Least length of a case [s]: over less the load zone does not open and close as it does in wind.
SHORTEST = 60.0
#: Range of the damage-equivalent load over the equivalent load below which loads are steady.
_STEADY = 1e-3
_REMEDY = (
    "Vary the oil in a study of turbulent cases: variations: {grid: {lubricant.at: {values: [5, "
    "20, 35, 50], unit: degC}, oil_supply: {values: [skf, flooded]}}}."
)


def friction_table(directory: str | PathLike[str]) -> FrictionTable:
    """Table of the friction torque of a study's bearing over wind, temperature and supply of oil.

    The torque of a run is its mean friction power over its mean speed; runs with the same wind,
    temperature and supply are averaged. Events are left out.

    Parameters
    ----------
    directory : path
        Folder of a study of turbulent cases at several temperatures, `lubricant.at`, and, as far as
        several supplies are compared, `oil_supply`.

    Returns
    -------
    FrictionTable
        With the mean loads of each wind where they can be read again.

    Raises
    ------
    InputError
        If the folder has no such study: without winds or temperatures, of several designs, with
        steady or too short loads, or with laws that have no rolling resistance.
    """
    directory = Path(directory)
    study = open_study(directory)
    where = str(directory)
    _check_labels(study, where)
    is_production = events_of_runs(study) == ""
    production = study.isel(case=np.flatnonzero(is_production))
    _check_loads(production, where)
    settings = _first_settings(directory)
    if settings["laws"]["rolling"] == "none":
        raise InputError(
            "the laws of the study have no rolling resistance, which is most of the heat of a "
            "bearing that turns slowly",
            where=where,
            allowed="laws with rolling, such as laws: {model: physical}",
        )
    entries = _entries(production, settings)
    exponents, exponent_notes = speed_exponents(entries["supply"].unique())
    loads, load_notes = _mean_loads(study, directory)
    bearing = None
    lubricant = None
    if loads is not None:
        records = _study(study, directory)
        bearing = next(iter(records.bearings.values()))
        lubricant = next(iter(records.lubricants.values()))
    return FrictionTable(
        entries,
        exponents,
        loads,
        bearing=bearing,
        lubricant=lubricant,
        source=where,
        notes=(*exponent_notes, *load_notes),
    )


def _first_settings(directory: Path) -> dict:
    for _, result in stored_results(directory):
        return stored_settings(result)
    raise InputError("no run of the study has a result", where=str(directory))


def _check_labels(study: xr.Dataset, where: str) -> None:
    for label, meaning in ((WIND, "mean wind speed of its loads"), (OIL, "temperature of its oil")):
        if label not in study.coords:
            raise InputError(
                f"the runs of the study have no label {label}, the {meaning}",
                where=where,
                remedy=_REMEDY,
            )
    varied = [
        name
        for name in labels_over(study)
        if name not in (OIL, SUPPLY)
        and (name in CHOICES or is_parameter(study, name))
        and np.unique(study[name].values.astype(str)).size > 1
    ]
    if varied:
        raise InputError(
            f"the study varies {', '.join(varied)}",
            where=where,
            allowed=f"{OIL} and {SUPPLY}: one bearing is put beside the measured one",
            remedy="Run a study of one design.",
        )


def _check_loads(study: xr.Dataset, where: str) -> None:
    """Refuse loads that are steady or short: they have too little torque in weak wind."""
    range_of_loads = study.damage_equivalent_load_10.values
    steady = range_of_loads < _STEADY * study.equivalent_load.values
    if steady.any():
        steady_loads = study.loads.values[steady].astype(str)
        names = ", ".join(np.unique(steady_loads)[:5])
        raise InputError(
            f"the loads of {names} do not vary: at 6 m/s steady mean loads have 0.82 of the torque "
            "that they have in turbulence, because the downwind load zone closes there",
            where=where,
            allowed="histories of turbulent wind, or the bundled cases",
            remedy=_REMEDY,
        )
    shortest = float(study.loads_length.min())
    if round(shortest) < SHORTEST:
        raise InputError(
            f"the shortest loads of the study last {shortest:.3g} s",
            where=where,
            allowed=f"{SHORTEST:g} s and more; the whole history is better",
        )


def _entries(study: xr.Dataset, settings: dict) -> pd.DataFrame:
    """Torque by supply, wind and temperature."""
    count = study.sizes["case"]
    if SUPPLY in study.coords:
        supply = study[SUPPLY].values.astype(str)
    else:
        supply = np.full(count, str(settings.get("oil_supply") or SKF))
    oil = study[OIL].values.astype(float)
    if study[OIL].attrs.get("units") == "degC":
        oil = oil + ZERO_CELSIUS
    speed = np.abs(study.shaft_speed_mean.values)
    with np.errstate(divide="ignore", invalid="ignore"):
        torque = study.friction_power.values / speed
    runs = pd.DataFrame(
        {
            "supply": supply,
            "wind_speed": study[WIND].values.astype(float),
            "temperature": oil,
            "shaft_speed": speed,
            "torque": torque,
        }
    )
    by = ["supply", "wind_speed", "temperature"]
    # A mean with a failed run is not known.
    by_cell = runs.groupby(by, sort=False)[["shaft_speed", "torque"]]
    means = by_cell.agg(lambda column: column.mean(skipna=False))
    return means.reset_index()


def _study(study: xr.Dataset, directory: Path) -> Study:
    """The study as its file has it; relative paths start beside its folder."""
    content = json.loads(study.attrs["study"])
    return study_of(content, directory.absolute().parent)


def _mean_loads(study: xr.Dataset, directory: Path) -> tuple[pd.DataFrame | None, tuple[str, ...]]:
    """Mean radial and axial load [N] by wind speed, or a sentence on why they are missing."""
    try:
        histories = _loads_of_histories(_study(study, directory))
        table = pd.DataFrame(histories)
    except InputError as problem:
        return None, (
            "The loads of the study cannot be read again, so that the formulas of handbooks are "
            f"left out ({problem.fault}).",
        )
    means = table.groupby("wind_speed").mean().reset_index()
    return pd.DataFrame(means), ()


def _loads_of_histories(study: Study) -> Iterator[dict[str, float]]:
    """Mean load of each history of production."""
    read = set()
    for run in study.runs():
        if run.is_event or run.load.name in read:
            continue
        read.add(run.load.name)
        case, cut = study.case_of(run)
        path = study.path_of(run.load)
        history = read_loads(study.loads.source, path, cut)
        loads = replace(case, loads=history).bearing_loads
        yield {
            "wind_speed": float(run.load.fields[WIND]),
            "radial_load": float(loads.radial_load.mean()),
            "axial_load": float(np.abs(loads.axial_load).mean()),
        }
