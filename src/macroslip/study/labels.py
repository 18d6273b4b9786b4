"""Labels of the runs of a study, and the study file that it keeps, in `open_study`'s dataset."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import xarray as xr

#: Labels of a design that every study has.
CHOICES = ("bearing", "lubricant", "model")


def stored_study(study: xr.Dataset) -> dict[str, Any]:
    """Content of the study file; empty where the dataset keeps none."""
    return json.loads(study.attrs.get("study", "{}"))


def labels_over(dataset: xr.Dataset | xr.DataArray, dim: str = "case") -> list[str]:
    """Names of the coordinates over one dimension alone, `case` or `group`."""
    names = []
    for name, coordinate in dataset.coords.items():
        if coordinate.dims == (dim,):
            names.append(str(name))
    return names


def of_runs_and_rows(study: xr.Dataset) -> xr.Dataset:
    """The study without variables over more than runs and rows of rollers."""
    others = []
    for name, variable in study.variables.items():
        if not set(variable.dims) <= {"case", "row"}:
            others.append(name)
    return study.drop_vars(others)


def events_of_runs(study: xr.Dataset) -> np.ndarray:
    """Name of the event of each run, empty for runs of production, shape (runs,)."""
    if "event" not in study.coords:
        return np.full(study.sizes["case"], "")
    return study["event"].values.astype(str)


def sampled_parameters(study: xr.Dataset) -> list[str]:
    """Keys that the study file samples, in `open_study`'s dataset."""
    sampled = _sampled(_variations(study))
    return [str(key) for key in sampled if key in study.coords]


def is_parameter(study: xr.Dataset, label: str) -> bool:
    """True if the study varies the key that a label names, such as `drivetrain.tilt` or `oil_supply`.

    Fields of loads have no dot.
    """
    variations = _variations(study)
    keys = (
        variations.get("grid") or {},
        _sampled(variations),
        *(variations.get("list") or []),
    )
    return "." in label or any(label in section for section in keys)


def _variations(study: xr.Dataset) -> dict[str, Any]:
    return stored_study(study).get("variations") or {}


def _sampled(variations: dict[str, Any]) -> dict[str, Any]:
    """Ranges of the sample by key."""
    sample = variations.get("sample") or {}
    return sample.get("ranges") or {}
