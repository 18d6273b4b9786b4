"""The paper's study: mean wind speeds times turbulence classes, both rows, every roller, in one table of numbers."""

from __future__ import annotations

import functools
import json
from pathlib import Path
from typing import TYPE_CHECKING

from macroslip.case.case import Case
from macroslip.errors import InputError
from macroslip.loads import HubLoads
from macroslip.result.row_loads import row_loads
from macroslip.study.reader import open_study, stored_results

if TYPE_CHECKING:
    import xarray as xr

#: Variables of each roller; those from `mechanism_energy` on only of contacts with microslip or asperities.
_OF_ROLLERS = (
    "energy", "min_spin_ratio", "outside_film_range", "status",
    "mechanism_energy", "asperity_energy", "station_energy", "quadrature_error",
)  # fmt: skip
_COORDINATES = ("row", "roller", "interface", "start_angle", "mechanism", "station", "raceway", "case")
#: Quantities of every orbit of which the study keeps the extreme of the window, and which.
_EXTREMES = {"flash_temperature": "max", "power_density": "max", "slide_roll_ratio": "max", "min_film_ratio": "min"}
_PEAK = "largest power at any interface per orbit, over all rollers and orbits"
#: Numbers of the summary by their names here, with their meaning.
_OF_SUMMARY = {
    "peak_power_mean": ("peak_power_mean", f"mean of the {_PEAK}"),
    "peak_power_std": ("peak_power_std", f"standard deviation of the {_PEAK}"),
    "peak_power_max": ("peak_power_max", f"largest of the {_PEAK}"),
    "orbit_energy": ("orbit_energy_mean", "energy per orbit of a roller, mean over all rollers and orbits"),
    "orbits": ("orbits", "complete orbits in the window"),
    "window_length": ("window_length", "length of the window"),
}


def paper_study(directory: Path) -> xr.Dataset:
    """The table of a study of bundled load cases with the default bearing.

    Parameters
    ----------
    directory : Path
        Folder of the results of a study.

    Returns
    -------
    xarray.Dataset
        Dimensions case, row, roller, interface. Energies per roller, statistics of P_max over (roller, orbit) samples,
        extremes over the window, mean loads. Values of a failed roller, and every mean it enters, are NaN.

    Raises
    ------
    InputError
        For a window without a complete orbit.
    """
    import xarray as xr

    opened = open_study(directory)
    parts, inputs, attributes = [], [], {}
    for number, result in stored_results(directory):
        one = opened.isel(case=number)
        if not result.sizes["orbit"]:
            raise InputError(
                "the window holds no complete orbit", where=f"case {one.loads.item()}", allowed="one orbit or more"
            )
        parts.append(_of_rollers(result).merge(_of_summary(one)).merge(_loads(one.loads.item(), *_window(result))))
        attributes = dict(result.attrs)
        inputs.append(json.loads(attributes["input"]))
    study = xr.concat(
        parts, xr.DataArray(opened.loads.values.tolist(), dims="case", name="case"), combine_attrs="override"
    )
    # In an order of their own, whatever that of the files.
    study = xr.Dataset(
        {name: one.variable for name, one in study.data_vars.items()},
        {name: study[name].variable for name in _COORDINATES if name in study.coords},
    )
    study = study.assign_coords(
        wind_speed=("case", opened.wind_speed.values, {"units": "m/s", "long_name": "mean wind speed"}),
        turbulence=("case", opened.turbulence.values.tolist(), {"units": "1", "long_name": "IEC turbulence class"}),
    )
    study.attrs = {
        "title": opened.attrs["title"],
        "source": attributes["source"],
        "model": attributes["model"],
        "input": json.dumps({**inputs[-1], "loads": [one["loads"] for one in inputs]}, ensure_ascii=False),
        "film_range_notes": attributes["film_range_notes"],
        "citations": attributes["citations"],
    }
    return study


def _window(result: xr.Dataset) -> tuple[float, float]:
    return float(result.attrs["window_start"]), float(result.attrs["window_end"])


def _of_rollers(result: xr.Dataset) -> xr.Dataset:
    """Energies and states of the rollers, and extremes over the window."""
    kept = result[[name for name in _OF_ROLLERS if name in result]]
    for name, extreme in _EXTREMES.items():
        if name in result:
            # A contact without load in an orbit (NaN) has no extreme to compare.
            kept[name] = getattr(result[name], extreme)("orbit", keep_attrs=True)
            kept[name].attrs["long_name"] = result[name].attrs["long_name"].replace("per orbit", "in the window")
    return kept


def _of_summary(run: xr.Dataset) -> xr.Dataset:
    """Numbers of one run's summary, under the names of the study."""
    import xarray as xr

    found = xr.Dataset(coords={"row": run.row.values})
    for name, (source, long_name) in _OF_SUMMARY.items():
        found[name] = (run[source].dims, run[source].values, {"units": run[source].units, "long_name": long_name})
    return found


@functools.cache
def _loads(name: str, start: float, end: float) -> xr.Dataset:
    """Mean loads of the rows, which are the same under all models."""
    return row_loads(Case(loads=HubLoads.bundled(name)), start, end)
