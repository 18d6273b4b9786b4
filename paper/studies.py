"""Which cases are computed, and the tables that their results become."""

from __future__ import annotations

import functools
import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from macroslip import Case, HubLoads, InputError, Laws, MacroslipError, open_study, run_study
from macroslip.bearing.geometry import ROWS
from macroslip.result.rating import roller_load_series
from macroslip.study.database import Outcome
from macroslip.study.reader import stored_results
from macroslip.study.study_file import Study
from paper.values import sample_points

#: Mechanisms by model.
MODELS: Mapping[str, Laws] = {"paper": Laws.paper(), "physical": Laws.physical()}
PAPER = "paper"  # the model of the paper, under which the numerical experiments are computed
DETAILED_CASE = (
    "14B"  # the case of the single rollers and the torque; its means are the static load
)
#: Cases to which the paper refers energy (figure 4) and peak power (figure 5).
ENERGY_REFERENCE, PEAK_REFERENCE = "12C", "14A"
#: Of the sample, whose results spread by factors: ten times the default one, with tables an eighth as large. Of 17 points
#: energies and torque change by 0.02 % at most, peak powers by 0.6 %, the energy of an orbit at one interface by 1.5 %.
SAMPLE_TOLERANCE = 2e-3


def content(stage: str, model: str) -> dict[str, Any]:
    """Content of a study file: `study`, `detail` or `uncertainty`, under a model."""
    case = {"rating": False, "laws": {"model": model}}
    if stage == "study":
        title = "Frictional energy and peak power of the rollers over wind speed and turbulence"
        return {"title": title, "case": case, "loads": {"bundled": "all"}}
    if stage == "detail":
        # As often as the loads are sampled.
        case["traces"] = {"step": "0.05 s"}
        return {"title": "One case in detail", "case": case, "loads": {"bundled": DETAILED_CASE}}
    return {
        "title": "Study under values drawn from their ranges",
        "case": case
        | {
            "drivetrain": {"shaft_mass_station": "1.73 m"},
            "rollers": [0],
            "loads": {"end": "100 s"},
            "integrator": {"tolerance": SAMPLE_TOLERANCE},
        },
        "loads": {"bundled": ["12B", "24B"]},
        "keep": ["energy"],
        "variations": {"list": sample_points()},
    }


def compute(
    study: Study,
    directory: Path,
    *,
    may_fail: bool = False,
    threads: int | None = None,
    progress: Callable[[int, int], None] = lambda done, total: None,
) -> bool:
    """Compute what is missing of a study in a folder; tell whether there was anything.

    A run that fails is an error, unless it may because its refusal is a result.
    """
    ended = run_study(
        study,
        directory,
        threads=threads,
        resume=True,
        progress=lambda now: progress(now.done, now.total),
    )
    lost = [
        (labels["loads"], reason)
        for labels, outcome, reason in ended.failures
        if outcome == Outcome.FAILED
    ]
    if lost and not may_fail:
        raise MacroslipError(
            f"{len(lost)} cases of '{study.title}' failed, case {lost[0][0]} first: {lost[0][1]}"
        )
    return ended.progress.computed > 0 or len(ended.failures) > len(lost)


#: Variables of each roller; those from `mechanism_energy` on only of contacts with microslip or asperities.
_OF_ROLLERS = (
    "energy", "min_spin_ratio", "outside_film_range", "status",
    "mechanism_energy", "asperity_energy", "station_energy", "quadrature_error",
)  # fmt: skip
_COORDINATES = (
    "row",
    "roller",
    "interface",
    "start_angle",
    "mechanism",
    "station",
    "raceway",
    "case",
)
#: Quantities of every orbit of which the study keeps the extreme of the window.
_EXTREMES = {
    "flash_temperature": "max",
    "power_density": "max",
    "slide_roll_ratio": "max",
    "min_film_ratio": "min",
}
_PEAK = "largest power at any interface per orbit, over all rollers and orbits"
#: Numbers of the study's summary by their names here, with their meaning.
_OF_SUMMARY = {
    "peak_power_mean": ("peak_power_mean", f"mean of the {_PEAK}"),
    "peak_power_std": ("peak_power_std", f"standard deviation of the {_PEAK}"),
    "peak_power_max": ("peak_power_max", f"largest of the {_PEAK}"),
    "orbit_energy": (
        "orbit_energy_mean",
        "energy per orbit of a roller, mean over all rollers and orbits",
    ),
    "orbits": ("orbits", "complete orbits in the window"),
    "window_length": ("window_length", "length of the window"),
}


def put(into: xr.Dataset, name: str, values: Any, units: str, long_name: str) -> None:
    """Add a variable with its unit and meaning."""
    into[name] = values
    into[name].attrs = {"units": units, "long_name": long_name}


def paper_study(directory: Path) -> xr.Dataset:
    """The table of a study of bundled load cases with the default bearing.

    Energies per roller [J], statistics of P_max [W] over (roller, orbit) samples, extremes over the window and mean loads
    [N], over case, row, roller and interface. Values of a failed roller, and every mean it enters, are NaN.
    """
    opened = open_study(directory)
    parts, inputs, attributes = [], [], {}
    for number, result in stored_results(directory):
        run = opened.isel(case=number)
        if not result.sizes["orbit"]:
            raise InputError(
                "the window holds no complete orbit",
                where=f"case {run.loads.item()}",
                allowed="one orbit or more",
            )
        kept = result[[name for name in _OF_ROLLERS if name in result]]
        for name, extreme in _EXTREMES.items():
            if name in result:
                # A contact without load in an orbit (NaN) has no extreme to compare.
                kept[name] = getattr(result[name], extreme)("orbit", keep_attrs=True)
                kept[name].attrs["long_name"] = (
                    result[name].attrs["long_name"].replace("per orbit", "in the window")
                )
        for name, (source, long_name) in _OF_SUMMARY.items():
            kept[name] = (
                run[source].dims,
                run[source].values,
                {"units": run[source].units, "long_name": long_name},
            )
        window = float(result.attrs["window_start"]), float(result.attrs["window_end"])
        parts.append(kept.merge(_loads(run.loads.item(), *window)))
        attributes = dict(result.attrs)
        inputs.append(json.loads(attributes["input"]))
    cases = xr.DataArray(opened.loads.values.tolist(), dims="case", name="case")
    study = xr.concat(parts, cases, combine_attrs="override")
    # In an order of their own, whatever the order in the files.
    study = xr.Dataset(
        {name: variable.variable for name, variable in study.data_vars.items()},
        {name: study[name].variable for name in _COORDINATES if name in study.coords},
    )
    study = study.assign_coords(
        wind_speed=(
            "case",
            opened.wind_speed.values,
            {"units": "m/s", "long_name": "mean wind speed"},
        ),
        turbulence=(
            "case",
            opened.turbulence.values.tolist(),
            {"units": "1", "long_name": "IEC turbulence class"},
        ),
    )
    study.attrs = {
        "title": opened.attrs["title"],
        "input": json.dumps(
            {**inputs[-1], "loads": [of_case["loads"] for of_case in inputs]}, ensure_ascii=False
        ),
        **{name: attributes[name] for name in ("source", "model", "film_range_notes", "citations")},
    }
    return study


def row_loads(case: Case, start: float, end: float) -> xr.Dataset:
    """Means between two times [s]: radial load and thrust of the bearing, load of a roller by row [N], share under load [1]."""
    loads, (_, by_row) = case.bearing_loads, roller_load_series(case, start, end)
    x, y, axial = loads.force[(loads.time >= start) & (loads.time <= end)].T
    variables = {
        "radial_load": ((), float(np.hypot(x, y).mean()), "N", "mean radial load of the bearing"),
        "thrust": ((), float(axial.mean()), "N", "mean thrust on the bearing, positive downwind"),
        "roller_load": (
            "row",
            by_row.mean(axis=(0, 2)),
            "N",
            "elastic load, mean over rollers and samples",
        ),
        "loaded_share": (
            "row",
            (by_row > 0.0).mean(axis=(0, 2)),
            "1",
            "share of rollers and time under load",
        ),
    }
    about = {
        name: (dims, values, {"units": units, "long_name": words})
        for name, (dims, values, units, words) in variables.items()
    }
    return xr.Dataset(about, {"row": list(ROWS)})


@functools.cache
def _loads(name: str, start: float, end: float) -> xr.Dataset:
    """Mean loads of the rows, which are the same under all models."""
    return row_loads(Case(loads=HubLoads.bundled(name), laws=Laws.paper()), start, end)


def between_rows(values: xr.DataArray) -> xr.DataArray:
    """Values of the downwind row over those of the upwind row."""
    return values.sel(row="downwind", drop=True) / values.sel(row="upwind", drop=True)


def paper_numbers(study: xr.Dataset) -> xr.Dataset:
    """Row values, their normalised forms and the ratios between rows, over (case, row) or (case).

    A row's energy is the mean over its rollers of E_in + E_out + E_cage (34); the spread over rollers is given with it.
    P_max is the largest power (33) at any interface in an orbit; mean and standard deviation (of the whole population)
    are over all (roller, orbit) samples of a row. A row is normalised by its own value in the reference case. NaN
    wherever a roller failed.
    """
    numbers = study[
        ["peak_power_mean", "peak_power_std", "peak_power_max", "orbit_energy"]
    ].drop_vars(["roller", "interface", "start_angle"], errors="ignore")
    numbers.attrs = {}
    total = study.energy.sum("interface", skipna=False)
    for name, statistic, words in (
        ("energy", "mean", "energy in the window, mean over the rollers of the row"),
        ("energy_std", "std", "standard deviation of energy over the rollers"),
        ("energy_min", "min", "smallest energy of a roller"),
        ("energy_max", "max", "largest energy of a roller"),
    ):
        put(numbers, name, getattr(total, statistic)("roller", skipna=False), "J", words)
    by_interface = study.energy.mean("roller", skipna=False)
    put(
        numbers,
        "energy_by_interface",
        by_interface,
        "J",
        "energy at each interface, mean over the rollers of the row",
    )
    both = numbers.energy.sum("row", skipna=False)
    put(
        numbers,
        "both_rows",
        both,
        "J",
        "energy of a mean downwind and a mean upwind roller together",
    )
    for names, reference, base in (
        (("energy", "energy_min", "energy_max"), ENERGY_REFERENCE, numbers.energy),
        (("both_rows",), ENERGY_REFERENCE, both),
        (("peak_power_mean", "peak_power_std"), PEAK_REFERENCE, numbers.peak_power_mean),
    ):
        for name in names:
            words = f"{numbers[name].long_name}, over the mean in case {reference}"
            put(
                numbers,
                f"{name}_normalised",
                numbers[name] / base.sel(case=reference, drop=True),
                "1",
                words,
            )
    put(
        numbers,
        "energy_ratio",
        between_rows(numbers.energy),
        "1",
        "energy of the downwind over the upwind row",
    )
    ratio = between_rows(numbers.peak_power_mean)
    put(numbers, "peak_power_ratio", ratio, "1", "mean P_max of the downwind over the upwind row")
    return numbers


#: Parts of a row's energy, in the order of the stacked figure.
PARTS = (
    "inner, curvature", "inner, contact angle", "outer, curvature", "outer, contact angle", "raceways, sliding", "cage",
)  # fmt: skip


def dissipation(study: xr.Dataset) -> xr.Dataset:
    """Energy per orbit of a mean roller by part and by station, of a `paper_study` with microslip.

    Returns
    -------
    xarray.Dataset
        Over (case, row): part_energy [J] per orbit over `part`, which add up to all of it. At either raceway curvature
        and contact angle are what makes stations slide against each other; the sliding of the middle, of which one
        raceway may take what the other gives, is that of both together. asperity_share [1] of the energy;
        station_energy [J/m] per orbit and length of roller over (raceway, station); load_exponent [1] over (row): slope
        of log energy per orbit over log mean roller load, all cases. NaN wherever a roller failed, and the exponent
        where a row carries no load.
    """

    def per_orbit(values: xr.DataArray) -> xr.DataArray:
        return values.mean("roller", skipna=False) / study.orbits

    mechanisms, energy = per_orbit(study.mechanism_energy), per_orbit(study.energy)
    parts = [
        mechanisms.sel(interface=raceway, mechanism=mechanism, drop=True)
        for raceway in ("inner", "outer")
        for mechanism in ("curvature", "contact angle")
    ]
    sliding = mechanisms.sel(interface=["inner", "outer"], mechanism="sliding", drop=True)
    parts += [sliding.sum("interface", skipna=False), energy.sel(interface="cage", drop=True)]
    part = xr.DataArray(list(PARTS), dims="part", name="part")
    part_energy = xr.concat(parts, part, coords="minimal", compat="override").transpose(
        "case", "row", "part"
    )
    total = energy.sum("interface", skipna=False)
    along = per_orbit(study.station_energy) / float(np.diff(study.station.values).mean())
    exponents = [
        _exponent(study.roller_load.sel(row=row).values, total.sel(row=row).values)
        for row in study.row
    ]
    energies = xr.Dataset()
    put(
        energies,
        "part_energy",
        part_energy,
        "J",
        "energy per orbit of a mean roller by interface and mechanism",
    )
    asperity = per_orbit(study.asperity_energy.sum("interface", skipna=False)) / total
    put(energies, "asperity_share", asperity, "1", "share of the energy that asperities dissipate")
    along = along.transpose("case", "row", "raceway", "station")
    put(
        energies,
        "station_energy",
        along,
        "J/m",
        "energy per orbit and length of roller, by raceway",
    )
    put(
        energies,
        "load_exponent",
        ("row", exponents),
        "1",
        "exponent of energy per orbit over mean roller load, all cases",
    )
    return energies.drop_vars(("start_angle", "roller"), errors="ignore")


def _exponent(load: np.ndarray, energy: np.ndarray) -> float:
    if not (np.isfinite(energy).all() and (load > 0.0).all() and np.unique(load).size > 1):
        return float("nan")
    return float(np.polyfit(np.log(load), np.log(energy), 1)[0])
