"""The numbers that a study keeps of a case: of rows, the case, its rating and load cycles."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import pandas as pd
import xarray as xr

from macroslip.bearing.geometry import AXIAL_SIGNS, ROWS, orbit_ratio
from macroslip.case.case import Case
from macroslip.errors import InputError
from macroslip.imposed.status import Status
from macroslip.loads import BearingLoads
from macroslip.rating.spectrum import rainflow_ranges
from macroslip.rating.variables import RATED, RATING
from macroslip.result.criteria import YEARLY
from macroslip.result.damage import damage
from macroslip.result.heat_balance import bearing_friction_power
from macroslip.result.rating import rate_case
from macroslip.result.run_input import window_length
from macroslip.variables import ALWAYS, Variable, VariableTable, described

#: Interfaces by what they are in words.
_INTERFACES = {"inner": "inner raceway", "outer": "outer raceway", "cage": "cage"}
#: Exponents of the damage-equivalent loads that are kept.
EXPONENTS = (4, 10)
_OVER = "over all rollers and complete orbits"
_IN_WINDOW = "energy dissipated by a roller in the window, all interfaces"
_PER_ORBIT = "energy of a roller per orbit"
_PEAK = "largest power at any interface per orbit"
_HERTZ = "load along the roller as in a Hertz contact"
_ROW = ("case", "row")
_CASE = ("case",)
#: When numbers of criteria are there.
_WITH_DETAILS = "with details of the contacts: laws with microslip or asperities"


def _of_rating(name: str, more: str = "") -> Variable:
    """Variable of the summary with name, unit and meaning of the rating."""
    variable = RATING[name]
    return variable._replace(dims=_CASE, when=RATED, long_name=variable.long_name + more)


#: The numbers of each row of rollers.
ROW_VARIABLES = VariableTable(
    "Summary of a study, by row",
    (
        Variable("energy_mean", _ROW, "J", ALWAYS, f"{_IN_WINDOW}: mean over rollers"),
        Variable("energy_min", _ROW, "J", ALWAYS, f"{_IN_WINDOW}: smallest roller"),
        Variable("energy_max", _ROW, "J", ALWAYS, f"{_IN_WINDOW}: largest roller"),
        *(
            Variable(
                f"energy_{interface}",
                _ROW,
                "J",
                ALWAYS,
                f"energy dissipated at the {place} in the window, mean over rollers",
            )
            for interface, place in _INTERFACES.items()
        ),
        Variable(
            "orbit_energy_mean",
            _ROW,
            "J",
            ALWAYS,
            f"{_PER_ORBIT}, all interfaces: mean {_OVER}",
        ),
        *(
            Variable(
                f"orbit_energy_{interface}",
                _ROW,
                "J",
                ALWAYS,
                f"{_PER_ORBIT} at the {place}: mean {_OVER}",
            )
            for interface, place in _INTERFACES.items()
        ),
        Variable(
            "orbit_energy_max",
            _ROW,
            "J",
            ALWAYS,
            f"{_PER_ORBIT}, all interfaces: largest {_OVER}",
        ),
        Variable("peak_power_mean", _ROW, "W", ALWAYS, f"{_PEAK}: mean {_OVER}"),
        Variable("peak_power_std", _ROW, "W", ALWAYS, f"{_PEAK}: standard deviation {_OVER}"),
        Variable(
            "peak_power_max",
            _ROW,
            "W",
            ALWAYS,
            "largest power at any interface in the window, over all rollers",
        ),
        Variable(
            "lowest_spin_ratio",
            _ROW,
            "1",
            ALWAYS,
            "smallest ratio of spin to spin in pure rolling in the window, of all rollers",
        ),
        Variable("failed_rollers", _ROW, "1", ALWAYS, "number of rollers whose integration failed"),
        *(
            Variable(yearly.run_name, _ROW, yearly.run_unit, _WITH_DETAILS, yearly.run_meaning)
            for yearly in YEARLY
        ),
    ),
)
#: The numbers of the rating of a case.
RATING_VARIABLES = VariableTable(
    "Summary of a study, rating",
    (
        _of_rating("static_safety"),
        _of_rating("equivalent_load"),
        _of_rating("basic_life"),
        _of_rating("modified_life"),
        _of_rating("reference_life", f", {_HERTZ}"),
        _of_rating("modified_reference_life", f", {_HERTZ}"),
        _of_rating("viscosity_ratio"),
        Variable(
            "least_film_ratio",
            _CASE,
            "1",
            RATED,
            "film ratio Lambda, 5 % of loaded rollers below: least of all raceways",
        ),
        _of_rating("largest_pressure", " of all raceways"),
        _of_rating("share_below_minimum_load"),
        _of_rating("share_below_fatigue_load_limit"),
        *(
            Variable(
                f"damage_equivalent_load_{exponent}",
                _CASE,
                "N",
                RATED,
                f"range of the damage-equivalent radial load at 1 Hz, exponent {exponent}",
            )
            for exponent in EXPONENTS
        ),
    ),
)
#: The numbers of the case as a whole.
CASE_VARIABLES = VariableTable(
    "Summary of a study, by case",
    (
        Variable("window_length", _CASE, "s", ALWAYS, "length of the window"),
        Variable("orbits", _CASE, "1", ALWAYS, "complete orbits in the window"),
        Variable("loads_length", _CASE, "s", ALWAYS, "length of the loads"),
        Variable("shaft_speed_mean", _CASE, "rad/s", ALWAYS, "mean shaft speed of the loads"),
        Variable(
            "contact_torque",
            _CASE,
            "N m",
            ALWAYS,
            "friction torque of the contacts of all rollers: mean over the turns of the shaft",
        ),
        Variable(
            "friction_power",
            _CASE,
            "W",
            ALWAYS,
            "sliding, rolling, cage and drag of the whole bearing: mean over the window",
        ),
        *RATING_VARIABLES.values(),
        Variable(
            "simulate_seconds",
            _CASE,
            "s",
            ALWAYS,
            "wall time of the simulation where it was computed",
        ),
        Variable(
            "other_seconds",
            _CASE,
            "s",
            ALWAYS,
            "wall time of everything else: reading the loads, hashing, summary, storing",
        ),
    ),
)
#: Cycles of the load of a case.
CYCLES = VariableTable(
    "Load cycles of a case, with `cycles: true`",
    (
        Variable(
            "load_cycles",
            ("component", "load_range"),
            "1",
            "with `cycles: true`",
            "cycles of the bearing's load",
        ),
    ),
)
#: Units of all columns of numbers; names of columns by row end in the row.
NUMBERS = {
    f"{name}_{row}": variable.units
    for name, variable in ROW_VARIABLES.items()
    for row in AXIAL_SIGNS
}
NUMBERS |= {name: variable.units for name, variable in CASE_VARIABLES.items()}


class OverTemperature(NamedTuple):
    """How a number of runs at several oil temperatures is averaged over time."""

    #: `mean` by the share of time; `largest` or `least` of any temperature that occurs; `life`,
    #: whose inverses are averaged.
    mean: str = "mean"
    #: True if it grows by factors over the temperature, so that its logarithm is interpolated.
    by_factors: bool = False


#: Lives of a run that accumulate by the rule of Palmgren and Miner.
LIVES = ("basic_life", "modified_life", "reference_life", "modified_reference_life")
_ENERGIES = [name for name, variable in ROW_VARIABLES.items() if variable.units in ("J", "W")]
#: The same of every number of the summary that is not averaged linearly.
OVER_TEMPERATURE: dict[str, OverTemperature] = {
    **dict.fromkeys(
        (*_ENERGIES, "friction_power", "contact_torque"), OverTemperature("mean", True)
    ),
    **dict.fromkeys(("peak_power_max", "orbit_energy_max"), OverTemperature("largest", True)),
    **dict.fromkeys(LIVES, OverTemperature("life", True)),
    "largest_pressure": OverTemperature("largest"),
    **dict.fromkeys(
        ("lowest_spin_ratio", "static_safety", "least_film_ratio"), OverTemperature("least")
    ),
    **{
        yearly.run_name: OverTemperature(
            "largest" if yearly.drawn == "largest" else "mean", yearly.by_factors
        )
        for yearly in YEARLY
    },
}


def rows_with_numbers(runs: pd.DataFrame) -> tuple[str, ...]:
    """Names of the rows of rollers that a table of runs has numbers of; both without any run."""
    rows = []
    for row in AXIAL_SIGNS:
        failed_rollers = runs[f"failed_rollers_{row}"]
        if np.isfinite(failed_rollers).any():
            rows.append(row)
    return tuple(rows) or ROWS


#: Components whose cycles are counted.
COMPONENTS = ("radial", "axial")
#: Classes of ranges, 40 a decade from 1 N to 1e8 N: every load that is accepted, to 6 %.
RANGE_EDGES = np.logspace(0.0, 8.0, 321)


def summary_values(result: xr.Dataset, case: Case) -> dict[str, float]:
    """The numbers of a case by the names of `NUMBERS`, but for times of computation.

    Values that a failed roller enters are NaN, and so are means of peaks and energies per orbit
    without a complete orbit.
    """
    # An orbit without values stands for none.
    of_orbits = result[["orbit_energy", "peak_power"]].pad(
        orbit=(0, int(not result.sizes["orbit"]))
    )
    energy = result.energy
    orbit_energy = of_orbits.orbit_energy
    rollers = ["roller"]
    samples = ["roller", "orbit"]
    total = energy.sum("interface", skipna=False)
    of_orbit = orbit_energy.sum("interface", skipna=False)
    peaks = of_orbits.peak_power.max("interface", skipna=False)
    mean_orbit = orbit_energy.mean(samples, skipna=False)
    values_of_rows = {
        "energy_mean": total.mean(rollers, skipna=False),
        "energy_min": total.min(rollers, skipna=False),
        "energy_max": total.max(rollers, skipna=False),
        **{
            f"energy_{interface}": energy.sel(interface=interface).mean(rollers, skipna=False)
            for interface in _INTERFACES
        },
        "orbit_energy_mean": of_orbit.mean(samples, skipna=False),
        **{
            f"orbit_energy_{interface}": mean_orbit.sel(interface=interface)
            for interface in _INTERFACES
        },
        "orbit_energy_max": of_orbit.max(samples, skipna=False),
        "peak_power_mean": peaks.mean(samples, skipna=False),
        "peak_power_std": peaks.std(samples, skipna=False),
        "peak_power_max": result.window_peak_power.max(["roller", "interface"], skipna=False),
        "lowest_spin_ratio": result.min_spin_ratio.min(rollers, skipna=False),
        "failed_rollers": (result.status != Status.COMPLETED).sum(rollers),
        **damage_values(result),
    }
    loads = case.loads
    # In an orbit the shaft turns by 2π over the ratio of the speeds.
    turned = 2.0 * np.pi / orbit_ratio(case.bearing)
    failed = bool((result.status != Status.COMPLETED).any())
    unknown = dict.fromkeys(NUMBERS, math.nan)
    by_row = {}
    for name, values in values_of_rows.items():
        for row in result.row.values.tolist():
            by_row[f"{name}_{row}"] = float(values.sel(row=row))
    contact_energy = case.bearing.rollers_per_row * float(mean_orbit.sum(skipna=False))
    friction_power = math.nan
    if not failed:
        friction_power = bearing_friction_power(result)
    return (
        unknown
        | by_row
        | {
            "window_length": window_length(result),
            "orbits": float(result.sizes["orbit"]),
            "loads_length": loads.duration,
            "shaft_speed_mean": float(np.mean(loads.shaft_speed)),
            "contact_torque": contact_energy / turned,
            "friction_power": friction_power,
            **rating_values(case),
        }
    )


def damage_values(result: xr.Dataset) -> dict[str, xr.DataArray]:
    """Numbers of damage of each row, of the criteria; NaN without details of the contacts."""
    nothing = np.full(result.sizes["row"], np.nan)
    unknown = xr.DataArray(nothing, {"row": result.row}, "row")
    if "surface_work" not in result:
        return {yearly.run_name: unknown for yearly in YEARLY}
    criteria = damage(result)
    values = {yearly.run_name: yearly.of_run(criteria, result) for yearly in YEARLY}
    return {name: unknown if value is None else value for name, value in values.items()}


def rating_values(case: Case) -> dict[str, float]:
    """The numbers of a rating, NaN for a case without a rating or a bearing without its values."""
    nothing = dict.fromkeys(RATING_VARIABLES, math.nan)
    if not case.rating:
        return nothing
    try:
        rating = rate_case(case)
    except InputError:
        return nothing
    range_of = rating.damage_equivalent_load.sel(load="radial")
    hertz = rating.sel(load_along_roller="hertz")
    derived = {
        "reference_life": hertz.reference_life,
        "modified_reference_life": hertz.modified_reference_life,
        "least_film_ratio": rating.film_ratio_low.min(),
        "largest_pressure": rating.largest_pressure.max(),
    }
    for exponent in EXPONENTS:
        load = range_of.sel(wohler_exponent=float(exponent))
        derived[f"damage_equivalent_load_{exponent}"] = load
    return {
        name: float(derived[name] if name in derived else rating[name]) for name in RATING_VARIABLES
    }


def load_cycles(loads: BearingLoads) -> xr.Dataset:
    """Count the cycles of a load history by classes of range.

    Cycles of the axial load move load from one row of rollers to the other and back, and a row that
    is unloaded is a row that slips; cycles of the radial load load housing, shaft and ring seats.

    `load_cycles` over (component, load_range) are those of the whole history, which is taken as
    repeating, so that every cycle closes; `load_range` is the geometric middle of a class [N].

    `fatpack.find_rainflow_ranges`, 256 levels between the smallest and the largest load; smaller
    ripples do not count. ASTM E 1049-85, Standard Practices for Cycle Counting in Fatigue Analysis,
    doi:10.1520/E1049-85R17.

    Examples
    --------
    >>> time = np.linspace(0.0, 10.0, 1001)
    >>> force = np.zeros((1001, 3))
    >>> force[:, 2] = 45e3 * np.sin(2.0 * np.pi * time)
    >>> cycles = load_cycles(BearingLoads(time, np.full(1001, 2.0), force, "ten cycles of 90 kN")).sel(component="axial")
    >>> most = cycles.load_cycles.argmax("load_range")
    >>> float(cycles.load_cycles.sum()), f"{float(cycles.load_range[most]):.3g} N"
    (10.0, '9.17e+04 N')
    """
    counts = []
    for series in (loads.radial_load, loads.axial_load):
        ranges = []
        if np.ptp(series) >= RANGE_EDGES[0]:
            ranges = rainflow_ranges(series)
        in_class, _ = np.histogram(ranges, RANGE_EDGES)
        counts.append(in_class.astype(float))
    lower_edges = RANGE_EDGES[:-1]
    upper_edges = RANGE_EDGES[1:]
    middle = np.sqrt(upper_edges * lower_edges)
    about = described("N", "range of the cycle, middle of its class")
    return xr.Dataset(
        CYCLES.put({"load_cycles": counts}),
        {"component": list(COMPONENTS), "load_range": ("load_range", middle, about)},
    )
