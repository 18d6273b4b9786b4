"""The numbers that a study keeps of a case: of rows, the case, its rating and load cycles."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd
import xarray as xr

from macroslip.bearing.geometry import AXIAL_SIGNS, ROWS, orbit_ratio
from macroslip.case.case import Case
from macroslip.errors import InputError
from macroslip.imposed.status import Status
from macroslip.loads import BearingLoads
from macroslip.rating.spectrum import rainflow_ranges
from macroslip.result.criteria import YEARLY
from macroslip.result.damage import damage
from macroslip.result.heat_balance import bearing_friction_power
from macroslip.result.rating import rate_case
from macroslip.result.run_input import window_length

_INTERFACES = ("inner", "outer", "cage")
_OVER = "over all rollers and complete orbits"
_IN_WINDOW = "energy dissipated by a roller in the window, all interfaces"
_PER_ORBIT = "energy of a roller per orbit"
_PEAK = "largest power at any interface per orbit"
_HERTZ = "load along the roller as in a Hertz contact"
#: Units and meaning of the numbers of each row of rollers.
ROW_VARIABLES = {
    "energy_mean": ("J", f"{_IN_WINDOW}: mean over rollers"),
    "energy_min": ("J", f"{_IN_WINDOW}: smallest roller"),
    "energy_max": ("J", f"{_IN_WINDOW}: largest roller"),
    "energy_inner": (
        "J",
        "energy dissipated at the inner raceway in the window, mean over rollers",
    ),
    "energy_outer": (
        "J",
        "energy dissipated at the outer raceway in the window, mean over rollers",
    ),
    "energy_cage": ("J", "energy dissipated at the cage in the window, mean over rollers"),
    "orbit_energy_mean": ("J", f"{_PER_ORBIT}, all interfaces: mean {_OVER}"),
    "orbit_energy_inner": ("J", f"{_PER_ORBIT} at the inner raceway: mean {_OVER}"),
    "orbit_energy_outer": ("J", f"{_PER_ORBIT} at the outer raceway: mean {_OVER}"),
    "orbit_energy_cage": ("J", f"{_PER_ORBIT} at the cage: mean {_OVER}"),
    "orbit_energy_max": ("J", f"{_PER_ORBIT}, all interfaces: largest {_OVER}"),
    "peak_power_mean": ("W", f"{_PEAK}: mean {_OVER}"),
    "peak_power_std": ("W", f"{_PEAK}: standard deviation {_OVER}"),
    "peak_power_max": ("W", "largest power at any interface in the window, over all rollers"),
    "lowest_spin_ratio": (
        "1",
        "smallest ratio of spin to spin in pure rolling in the window, of all rollers",
    ),
    "failed_rollers": ("1", "number of rollers whose integration failed"),
    **{yearly.run_name: (yearly.run_unit, yearly.run_meaning) for yearly in YEARLY},
}
#: The same of the rating of a case.
RATING_VARIABLES = {
    "static_safety": ("1", "static safety factor C0/P0, the least"),
    "equivalent_load": ("N", "mean dynamic equivalent load P"),
    "basic_life": ("h", "basic rating life L10h, ISO 281"),
    "modified_life": ("h", "modified rating life, ISO 281"),
    "reference_life": ("h", f"basic reference rating life, ISO/TS 16281, {_HERTZ}"),
    "modified_reference_life": ("h", f"modified reference rating life, {_HERTZ}"),
    "viscosity_ratio": ("1", "viscosity ratio kappa at the mean speed"),
    "least_film_ratio": (
        "1",
        "film ratio Lambda, 5 % of loaded rollers below: least of all raceways",
    ),
    "largest_pressure": ("Pa", "largest Hertz pressure of all raceways"),
    "share_below_minimum_load": ("1", "share of time in which P is below the maker's minimum load"),
    "share_below_fatigue_load_limit": ("1", "share of time in which P is below C_u"),
    "damage_equivalent_load_4": (
        "N",
        "range of the damage-equivalent radial load at 1 Hz, exponent 4",
    ),
    "damage_equivalent_load_10": (
        "N",
        "range of the damage-equivalent radial load at 1 Hz, exponent 10",
    ),
}
#: The same of the case as a whole.
CASE_VARIABLES = {
    "window_length": ("s", "length of the window"),
    "orbits": ("1", "complete orbits in the window"),
    "loads_length": ("s", "length of the loads"),
    "shaft_speed_mean": ("rad/s", "mean shaft speed of the loads"),
    "contact_torque": (
        "N m",
        "friction torque of the contacts of all rollers: mean over the turns of the shaft",
    ),
    "friction_power": (
        "W",
        "sliding, rolling, cage and drag of the whole bearing: mean over the window",
    ),
    **RATING_VARIABLES,
    "simulate_seconds": ("s", "wall time of the simulation where it was computed"),
    "other_seconds": (
        "s",
        "wall time of everything else: reading the loads, hashing, summary, storing",
    ),
}
#: Units of all columns of numbers; names of columns by row end in the row.
NUMBERS = {
    f"{name}_{row}": units for name, (units, _) in ROW_VARIABLES.items() for row in AXIAL_SIGNS
}
NUMBERS |= {name: units for name, (units, _) in CASE_VARIABLES.items()}


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
        "damage_equivalent_load_4": range_of.sel(wohler_exponent=4.0),
        "damage_equivalent_load_10": range_of.sel(wohler_exponent=10.0),
    }
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
    about = {"units": "N", "long_name": "range of the cycle, middle of its class"}
    return xr.Dataset(
        {
            "load_cycles": (
                ("component", "load_range"),
                counts,
                {"units": "1", "long_name": "cycles of the bearing's load"},
            )
        },
        {"component": list(COMPONENTS), "load_range": ("load_range", middle, about)},
    )
