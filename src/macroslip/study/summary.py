"""What the summary keeps of a case: a few numbers for each row of rollers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.bearing.geometry import orbit_ratio
from macroslip.imposed.status import Status
from macroslip.result.thermal_balance import bearing_friction_power
from macroslip.study.rating_values import VARIABLES as RATING_VARIABLES
from macroslip.study.rating_values import rating_values

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.case.case import Case

_INTERFACES = ("inner", "outer", "cage")
_OVER = "over all rollers and complete orbits"
#: Units and meaning of the numbers of each row of rollers.
ROW_VARIABLES = {
    "energy_mean": ("J", "energy dissipated by a roller in the window, all interfaces: mean over rollers"),
    "energy_min": ("J", "energy dissipated by a roller in the window, all interfaces: smallest roller"),
    "energy_max": ("J", "energy dissipated by a roller in the window, all interfaces: largest roller"),
    "energy_inner": ("J", "energy dissipated at the inner raceway in the window, mean over rollers"),
    "energy_outer": ("J", "energy dissipated at the outer raceway in the window, mean over rollers"),
    "energy_cage": ("J", "energy dissipated at the cage in the window, mean over rollers"),
    "orbit_energy_mean": ("J", f"energy of a roller per orbit, all interfaces: mean {_OVER}"),
    "orbit_energy_inner": ("J", f"energy of a roller per orbit at the inner raceway: mean {_OVER}"),
    "orbit_energy_outer": ("J", f"energy of a roller per orbit at the outer raceway: mean {_OVER}"),
    "orbit_energy_cage": ("J", f"energy of a roller per orbit at the cage: mean {_OVER}"),
    "orbit_energy_max": ("J", f"energy of a roller per orbit, all interfaces: largest {_OVER}"),
    "peak_power_mean": ("W", f"largest power at any interface per orbit: mean {_OVER}"),
    "peak_power_std": ("W", f"largest power at any interface per orbit: standard deviation {_OVER}"),
    "peak_power_max": ("W", f"largest power at any interface per orbit: largest {_OVER}"),
    "lowest_spin_ratio": ("1", "smallest ratio of spin to spin in pure rolling in the window, of all rollers"),
    "failed_rollers": ("1", "number of rollers whose integration failed"),
}
#: The same of the case as a whole.
CASE_VARIABLES = {
    "window_length": ("s", "length of the window"),
    "orbits": ("1", "complete orbits in the window"),
    "loads_length": ("s", "length of the loads"),
    "shaft_speed_mean": ("rad/s", "mean shaft speed of the loads"),
    "contact_torque": ("N m", "friction torque of the contacts of all rollers: mean over the turns of the shaft"),
    "friction_power": ("W", "sliding, rolling, cage and drag of the whole bearing: mean over the window"),
    **RATING_VARIABLES,
    "simulate_seconds": ("s", "wall time of the simulation where it was computed"),
    "other_seconds": ("s", "wall time of everything else: reading the loads, hashing, summary, storing"),
}


#: Variables that are stored whatever is to be kept: which rollers failed, and how.
ALWAYS_KEPT = ("status", "end_time", "end_slip")


def kept(result: xr.Dataset, names: Sequence[str] | None) -> xr.Dataset:
    """What is stored of a result: some of its variables with all coordinates and attributes, or all of them.

    Parameters
    ----------
    result : xarray.Dataset
        From `simulate`.
    names : sequence of str, optional
        Variables to keep beside `ALWAYS_KEPT`; None: all.
    """
    if names is None:
        return result
    return result.drop_vars([name for name in result.data_vars if name not in (*names, *ALWAYS_KEPT)])


def row_values(result: xr.Dataset) -> dict[str, list[float]]:
    """The numbers of each row of rollers, in the order of `row`.

    Parameters
    ----------
    result : xarray.Dataset
        From `simulate`.

    Returns
    -------
    dict
        A list by name of `ROW_VARIABLES`. Values that a failed roller enters are NaN, and so are peaks and energies per
        orbit without a complete orbit.
    """
    energy = result.energy.transpose("row", "roller", "interface").values
    orbit_energy = _orbit_energy(result)
    orbits = result.orbit_energy.transpose("row", "roller", "orbit", "interface").values.sum(axis=-1)
    peaks = result.peak_power.transpose("row", "roller", "orbit", "interface").values.max(axis=-1)
    orbits, peaks = (values.reshape(values.shape[0], -1) for values in (orbits, peaks))
    total = energy.sum(axis=-1)
    interfaces = list(result.interface.values)
    found = {
        "energy_mean": total.mean(axis=1),
        "energy_min": total.min(axis=1),
        "energy_max": total.max(axis=1),
        **{f"energy_{name}": energy[..., interfaces.index(name)].mean(axis=1) for name in _INTERFACES},
        "orbit_energy_mean": _over_samples(np.mean, orbits),
        **{f"orbit_energy_{name}": orbit_energy[:, interfaces.index(name)] for name in _INTERFACES},
        "orbit_energy_max": _over_samples(np.max, orbits),
        "peak_power_mean": _over_samples(np.mean, peaks),
        "peak_power_std": _over_samples(np.std, peaks),
        "peak_power_max": _over_samples(np.max, peaks),
        "lowest_spin_ratio": result.min_spin_ratio.transpose("row", "roller").values.min(axis=1),
        "failed_rollers": (result.status.transpose("row", "roller").values != Status.COMPLETED).sum(axis=1),
    }
    return {name: [float(value) for value in values] for name, values in found.items()}


def case_values(result: xr.Dataset, case: Case) -> dict[str, float]:
    """The numbers of the case as a whole, without times of computation."""
    loads, bearing = case.loads, case.bearing
    # In an orbit the shaft turns by 2π over the ratio of the speeds.
    turned = 2.0 * np.pi / orbit_ratio(bearing)
    return {
        "window_length": float(result.attrs["window_end"] - result.attrs["window_start"]),
        "orbits": float(result.sizes["orbit"]),
        "loads_length": loads.duration,
        "shaft_speed_mean": float(np.mean(loads.shaft_speed)),
        "contact_torque": bearing.rollers_per_row * float(_orbit_energy(result).sum()) / turned,
        "friction_power": _friction_power(result),
        **rating_values(case),
    }


def _friction_power(result: xr.Dataset) -> float:
    """Mean friction power of the whole bearing [W]; NaN where a roller failed."""
    return math.nan if bool((result.status != Status.COMPLETED).any()) else bearing_friction_power(result)


def _orbit_energy(result: xr.Dataset) -> np.ndarray:
    """Energy per orbit over (row, interface) [J], mean over rollers and orbits; NaN without a complete orbit."""
    energy = result.orbit_energy.transpose("row", "roller", "orbit", "interface").values
    if not result.sizes["orbit"]:
        return np.full((energy.shape[0], energy.shape[-1]), np.nan)
    return energy.mean(axis=(1, 2))


def _over_samples(function: Any, samples: np.ndarray) -> np.ndarray:
    return function(samples, axis=1) if samples.shape[1] else np.full(samples.shape[0], np.nan)
