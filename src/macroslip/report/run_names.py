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
            parts.append(f"{name} {file_names([str(values[0])])[0]}")
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
    return list(dict.fromkeys(f"{float(end):.3g}" for end in (warm.min(), warm.max())))


def situation(annual: xr.Dataset, number: int) -> str:
    """Name of a bin: its wind speed, or its event."""
    event = str(annual.event.values[number]) if "event" in annual.coords else ""
    return event or f"{float(annual.bin[number]):g} {annual.bin.attrs['units']}"


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
        names = [
            ", ".join(filter(None, parts))
            for parts in zip(_speeds(study, fields), design_names(others), strict=True)
        ]
        if len(set(names)) == len(set(loads)):
            return names
    return [name.rpartition("/")[2] for name in loads]


def _speeds(study: xr.Dataset, fields: list[str]) -> list[str]:
    """Wind speed of every run with its unit; empty if it is no field or the same for all."""
    if "wind_speed" not in fields or np.unique(study.wind_speed).size < 2:
        return [""] * study.sizes["case"]
    return [f"{speed:.12g} {study.wind_speed.attrs['units']}" for speed in study.wind_speed.values]


def run_names(study: xr.Dataset) -> list[str]:
    """Name of every run: its case, and its design where there are several."""
    labels = [
        str(name)
        for name in study.coords
        if name != "loads" and (name in (*SEVERAL, "temperature") or is_parameter(study, str(name)))
    ]
    designs = design_names(as_groups(study, labels), 3)
    return [
        ", ".join(filter(None, names)) for names in zip(case_names(study), designs, strict=True)
    ]


def as_groups(study: xr.Dataset, labels: list[str]) -> xr.Dataset:
    """Labels of the runs of a study as those of groups, one a run."""
    coordinates = {name: ("group", study[name].values, study[name].attrs) for name in labels}
    return xr.Dataset({"number": ("group", np.arange(study.sizes["case"]))}, coordinates)
