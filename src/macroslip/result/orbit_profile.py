"""Where on their orbit rollers are loaded, slip and lose energy, and how thick their films are, from a run's traces.

Angles count from the bottom along the orbit of a shaft that turns forward; 180 degrees is the top.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from macroslip.result.orbit_films import films
from macroslip.result.orbit_position import in_window, position, travelled
from macroslip.result.orbit_scene import scene
from macroslip.result.traced_power import traced_power

if TYPE_CHECKING:
    import xarray as xr

#: Sectors of the orbit, 5 degrees each.
SECTORS = 72


def energy_over_orbit(result: xr.Dataset, sectors: int = SECTORS) -> xr.DataArray:
    """Frictional energy per orbit of a roller and per degree of the orbit, mean over the row's rollers [J/degree].

    The sum over the sectors times their width is the energy per orbit, within what the traces' samples resolve; the
    attribute `energy_ratio` holds energy from the traces over the integrator's own, both rows and all interfaces.

    Parameters
    ----------
    result : xarray.Dataset
        With traces from the first sample of the loads on.
    sectors : int

    Returns
    -------
    xarray.DataArray
        Over (row, interface, angle), the angle being the middle of the sector; failed rollers are left out.
    """
    import xarray as xr

    angles, traced = position(result), traced_power(result)
    window = in_window(result)
    power = traced.sel(time=window.time)
    angle = angles.sel(time=window.time)
    seconds = np.gradient(window.time.values)
    seconds[[0, -1]] *= 0.5  # trapezoids
    good = (result.status == 0).values
    width = 360.0 / sectors
    orbits = np.ptp(travelled(result)[np.isin(result.time.values, window.time.values)]) / (2.0 * np.pi)
    values = np.full((result.sizes["row"], result.sizes["interface"], sectors), np.nan)
    for r in range(result.sizes["row"]):
        if not good[r].any() or orbits <= 0.0:
            continue
        sector = np.minimum((angle.values[r, good[r]] / width).astype(int), sectors - 1)
        for i in range(result.sizes["interface"]):
            energy = power.values[r, good[r], :, i] * seconds
            total = np.bincount(sector.ravel(), energy.ravel(), sectors)
            values[r, i] = total / (good[r].sum() * orbits * width)
    traced_energy = float((power.values[good] * seconds[:, None]).sum())
    ratio = traced_energy / float(result.energy.values[good].sum()) if result.energy.values[good].sum() else math.nan
    return xr.DataArray(
        values,
        {"row": result.row, "interface": result.interface, "angle": _middles(sectors)},
        ("row", "interface", "angle"),
        "energy_over_orbit",
        {
            "units": "J/degree",
            "long_name": "energy per orbit and per degree of the orbit",
            "energy_ratio": ratio,
            "orbits": float(orbits),
        },
    )


def _middles(sectors: int) -> tuple[str, np.ndarray, dict[str, str]]:
    width = 360.0 / sectors
    attributes = {"units": "degree", "long_name": "angle from the bottom along the orbit"}
    return "angle", width * (np.arange(sectors) + 0.5), attributes


def load_zone(result: xr.Dataset, sectors: int = SECTORS, samples: int = 600) -> xr.DataArray:
    """Roller load over angle and time: at each time the rollers' loads, interpolated between neighbours [N].

    Parameters
    ----------
    result : xarray.Dataset
        With traces from the first sample of the loads on.
    sectors : int
        Angles at which the load is given.
    samples : int
        Most times kept, evenly spaced.

    Returns
    -------
    xarray.DataArray
        Over (row, time, angle).
    """
    import xarray as xr

    angles = position(result)
    every = max(1, math.ceil(result.sizes["time"] / samples))
    angle = angles.isel(time=slice(None, None, every))
    load = result.roller_load.isel(time=slice(None, None, every)).values
    dims = _middles(sectors)
    values = np.empty((result.sizes["row"], angle.sizes["time"], sectors))
    for r in range(result.sizes["row"]):
        for k in range(angle.sizes["time"]):
            values[r, k] = np.interp(dims[1], angle.values[r, :, k], load[r, :, k], period=360.0)
    return xr.DataArray(
        values,
        {"row": result.row, "time": angle.time, "angle": dims},
        ("row", "time", "angle"),
        "roller_load",
        {"units": "N", "long_name": "load of the rollers"},
    )


def over_orbit(
    values: xr.DataArray, angle: xr.DataArray, quantiles: tuple[float, ...] = (0.05, 0.5, 0.95), sectors: int = SECTORS
) -> xr.DataArray:
    """Quantiles of a traced quantity over all rollers and times, by sector of the orbit.

    Parameters
    ----------
    values : xarray.DataArray
        Over (row, roller, time, interface).
    angle : xarray.DataArray
        [degrees], over (row, roller, time).
    quantiles : tuple of float
    sectors : int

    Returns
    -------
    xarray.DataArray
        Over (row, interface, quantile, angle); NaN where a sector holds no value.
    """
    import xarray as xr

    found = np.full((values.sizes["row"], values.sizes["interface"], len(quantiles), sectors), np.nan)
    sector = np.minimum((angle.values * (sectors / 360.0)).astype(int), sectors - 1)
    for r in range(values.sizes["row"]):
        order = np.argsort(sector[r].ravel(), kind="stable")
        ends = np.searchsorted(sector[r].ravel()[order], np.arange(sectors + 1))
        for i in range(values.sizes["interface"]):
            one = values.values[r, ..., i].ravel()[order]
            for k in range(sectors):
                here = one[ends[k] : ends[k + 1]]
                here = here[np.isfinite(here)]
                if here.size:
                    found[r, i, :, k] = np.quantile(here, quantiles)
    return xr.DataArray(
        found,
        {"row": values.row, "interface": values.interface, "quantile": list(quantiles), "angle": _middles(sectors)},
        ("row", "interface", "quantile", "angle"),
        values.name,
        values.attrs,
    )


def orbit_profile(result: xr.Dataset) -> dict[str, xr.Dataset]:
    """Averages over traces that a report shows of one result.

    Parameters
    ----------
    result : xarray.Dataset
        From `macroslip.simulate`, with traces from the first sample of the loads on.

    Returns
    -------
    dict
        "result": the result without its traces; "orbit": `energy_over_orbit`, and quantiles of film_thickness [m] and
        film_parameter [1] over (row, interface, quantile, angle); "load_zone"; "scene".

    Raises
    ------
    InputError
        As `position`.
    """
    film = films(result)
    orbit = energy_over_orbit(result).to_dataset()
    for name in ("film_thickness", "film_parameter"):
        orbit[name] = over_orbit(film[name], film.angle)
    return {
        "result": result.drop_dims("time"),
        "orbit": orbit,
        "load_zone": load_zone(result).to_dataset(),
        "scene": scene(result),
    }
