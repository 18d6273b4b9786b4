"""The paper's study: mean wind speeds times turbulence classes, both rows, every roller, in one table of numbers."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from macroslip.case.case import Case, Window
from macroslip.errors import InputError
from macroslip.loads import HubLoads, bundled_cases
from macroslip.mechanisms import Laws
from macroslip.result.row_loads import row_loads
from macroslip.result.simulate import simulate

if TYPE_CHECKING:
    import xarray as xr

#: Quantities of every orbit of which the study keeps the extreme of the window, and which.
_EXTREMES = {"flash_temperature": "max", "power_density": "max", "slide_roll_ratio": "max", "min_film_ratio": "min"}


def run_study(
    names: Sequence[str] | None = None,
    *,
    rollers: str | Sequence[int] = "all",
    window: Window | None = None,
    laws: Laws = Laws.paper(),
    threads: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> xr.Dataset:
    """Simulate bundled load cases with the default bearing, lubricant and integrator.

    Parameters
    ----------
    names : sequence of str, optional
        Names of bundled cases, such as "14B"; all 21 by default.
    rollers : "all" or sequence of int
        Rollers of each row.
    window : Window, optional
        By default from the completion of the first orbit to the end of the loads.
    laws : Laws
        Mechanisms in the contacts; the paper's by default.
    threads : int, optional
        Threads over rollers; the number of usable processors by default.
    progress : callable, optional
        Called as progress(done, total) after each case.

    Returns
    -------
    xarray.Dataset
        Dimensions case, row, roller, interface; see `_case_values` for the variables. Values of a failed roller, and
        every mean it enters, are NaN.

    Raises
    ------
    InputError
        For an unknown case or roller, or a window without a complete orbit.
    """
    import xarray as xr

    names = bundled_cases() if names is None else list(names)
    parts, attributes, loads = [], {}, []
    for done, name in enumerate(names, start=1):
        case = Case(loads=HubLoads.bundled(name), rollers=rollers, window=window or Window(), laws=laws)
        result = simulate(case, threads=threads)
        if result.sizes["orbit"] == 0:
            raise InputError("the window holds no complete orbit", where=f"case {name}", allowed="one orbit or more")
        loaded = row_loads(case, result.attrs["window_start"], result.attrs["window_end"])
        parts.append(_case_values(result).merge(loaded))
        attributes = dict(result.attrs)
        loads.append(json.loads(attributes["input"])["loads"])
        if progress:
            progress(done, len(names))
    study = xr.concat(parts, xr.DataArray(names, dims="case", name="case"), combine_attrs="override")
    study = study.assign_coords(
        wind_speed=("case", [float(name[:-1]) for name in names], {"units": "m/s", "long_name": "mean wind speed"}),
        turbulence=("case", [name[-1] for name in names], {"units": "1", "long_name": "IEC turbulence class"}),
    )
    study.attrs = {
        "title": "Frictional energy and peak power of the rollers over wind speed and turbulence",
        "source": attributes["source"],
        "model": attributes["model"],
        "input": json.dumps({**json.loads(attributes["input"]), "loads": loads}, ensure_ascii=False),
        "film_range_notes": attributes["film_range_notes"],
        "citations": attributes["citations"],
    }
    return study


def _case_values(result: xr.Dataset) -> xr.Dataset:
    """What the study keeps of one case: energies per roller, and statistics of P_max over (roller, orbit) samples.

    Contacts with microslip or asperities add energies by mechanism and station, and extremes over the window.
    """
    import xarray as xr

    detail = ("mechanism_energy", "asperity_energy", "station_energy", "quadrature_error")
    known = [name for name in detail if name in result]
    kept = result[["energy", "min_spin_ratio", "outside_film_range", "status", *known]]
    for name, extreme in _EXTREMES.items():
        if name in result:
            # A contact without load in an orbit (NaN) has no extreme to compare.
            kept[name] = getattr(result[name], extreme)("orbit", keep_attrs=True)
            kept[name].attrs["long_name"] = result[name].attrs["long_name"].replace("per orbit", "in the window")
    peak = result.peak_power.max("interface", skipna=False)
    samples = ("roller", "orbit")
    duration = result.attrs["window_end"] - result.attrs["window_start"]

    def put(name: str, values: xr.DataArray | float, units: str, long_name: str) -> None:
        kept[name] = values
        kept[name].attrs = {"units": units, "long_name": long_name}

    of = "largest power at any interface per orbit, over all rollers and orbits"
    put("peak_power_mean", peak.mean(samples, skipna=False), "W", f"mean of the {of}")
    put("peak_power_std", peak.std(samples, skipna=False), "W", f"standard deviation of the {of}")
    put("peak_power_max", peak.max(samples, skipna=False), "W", f"largest of the {of}")
    orbit_energy = result.orbit_energy.sum("interface", skipna=False).mean(samples, skipna=False)
    put("orbit_energy", orbit_energy, "J", "energy per orbit of a roller, mean over all rollers and orbits")
    put("orbits", np.float64(result.sizes["orbit"]), "1", "complete orbits in the window")
    put("window_length", duration, "s", "length of the window")
    return kept
