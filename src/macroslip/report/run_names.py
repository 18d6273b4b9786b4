"""Names of the runs, cases and situations of a study, and what it consists of, in words."""

from __future__ import annotations

import numpy as np
import xarray as xr

from macroslip.constants import ZERO_CELSIUS
from macroslip.study.labels import is_parameter, labels_over
from macroslip.study.year import design_names, file_names

#: Labels of a run, and words for several of each.
SEVERAL = {
    "loads": "load histories",
    "bearing": "bearings",
    "lubricant": "lubricants",
    "model": "models",
}
#: Labels of a run that a reader does not need.
INTERNAL = ("case", "run", "outcome", "reason", "key")


def study_about(study: xr.Dataset) -> str:
    """Numbers of runs, loads, bearings, lubricants and models of a study, in a sentence."""
    parts = [f"{study.sizes['case']} runs"]
    several_models = any(str(name).startswith("laws.") for name in study.coords)
    for name, plural in SEVERAL.items():
        if name not in study.coords:
            continue
        values = np.unique(study[name].values)
        if values.size > 1:
            parts.append(f"{values.size} {plural}")
        elif name == "model" and not several_models:
            parts.append(f"model {study.attrs.get('model', values[0])}")
        else:
            (file_name,) = file_names([str(values[0])])
            parts.append(f"{name} {file_name}")
    if temperatures := _inlet_temperatures(study):
        parts.append(f"oil at {' to '.join(temperatures)} °C")
    return ", ".join(parts)


def _inlet_temperatures(study: xr.Dataset) -> list[str]:
    """Lowest and highest temperature of the oil [°C]; one if alike, none if unknown."""
    if "inlet_temperature" not in study:
        return []
    # Of one run of each lubricant and temperature; every run would open every result.
    labels = [
        study[name].values.astype(str)
        for name in ("lubricant", "temperature")
        if name in study.coords
    ]
    _, runs = np.unique(labels, axis=1, return_index=True)
    warm = study.inlet_temperature[np.sort(runs)] - ZERO_CELSIUS
    if not bool(warm.notnull().any()):
        return []
    ends = [f"{float(end):.3g}" for end in (warm.min(), warm.max())]
    return list(dict.fromkeys(ends))


def situation(annual: xr.Dataset, number: int) -> str:
    """Name of a bin: its wind speed, or its event."""
    event = str(annual.event.values[number]) if "event" in annual.coords else ""
    if event:
        return event
    units = annual.bin.attrs["units"]
    return f"{float(annual.bin[number]):g} {units}"


def case_names(study: xr.Dataset) -> list[str]:
    """Name of the case of every run: fields that tell it apart, `14 m/s, seed 2`, or its loads."""
    not_of_loads = (*INTERNAL, *SEVERAL, "temperature")
    fields = [
        name
        for name in labels_over(study)
        if name not in not_of_loads and not is_parameter(study, name)
    ]
    loads = study.loads.values.astype(str)
    are_files = any("." in name for name in loads)
    if fields and are_files:
        # A wind speed is known by its unit: it needs no name before it.
        others = as_groups(study, [name for name in fields if name != "wind_speed"])
        parts_of_runs = zip(_speeds(study, fields), design_names(others), strict=True)
        names = [", ".join(filter(None, parts)) for parts in parts_of_runs]
        if len(set(names)) == len(set(loads)):
            return names
    return [name.rpartition("/")[2] for name in loads]


def _speeds(study: xr.Dataset, fields: list[str]) -> list[str]:
    """Wind speed of every run with its unit; empty if it is no field or the same for all."""
    if "wind_speed" not in fields or np.unique(study.wind_speed).size < 2:
        return [""] * study.sizes["case"]
    unit = study.wind_speed.attrs["units"]
    return [f"{speed:.12g} {unit}" for speed in study.wind_speed.values]


def run_names(study: xr.Dataset) -> list[str]:
    """Name of every run: its case, and its design where there are several."""
    labels = []
    for name in map(str, study.coords):
        is_choice = name in (*SEVERAL, "temperature")
        if name != "loads" and (is_choice or is_parameter(study, name)):
            labels.append(name)
    designs = design_names(as_groups(study, labels), 3)
    names_of_runs = zip(case_names(study), designs, strict=True)
    return [", ".join(filter(None, names)) for names in names_of_runs]


def as_groups(study: xr.Dataset, labels: list[str]) -> xr.Dataset:
    """Labels of the runs of a study as those of groups, one a run."""
    coordinates = {name: ("group", study[name].values, study[name].attrs) for name in labels}
    numbers = np.arange(study.sizes["case"])
    return xr.Dataset({"number": ("group", numbers)}, coordinates)
