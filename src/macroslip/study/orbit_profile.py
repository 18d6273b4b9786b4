"""Where on their orbit rollers are loaded, slip and lose energy, and how thick their films are, from a run's traces.

Angles count from the bottom along the orbit of a shaft that turns forward; 180 degrees is the top.
"""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from macroslip.bearing import Bearing, geometry
from macroslip.bearing.frames import AXIAL_SIGNS
from macroslip.errors import InputError
from macroslip.film.law import film_in_range, film_thickness
from macroslip.lubricant import Lubricant
from macroslip.roller.forces import LOWEST_ENTRAINMENT_SPEED
from macroslip.roller.model import RollerModel, roller_model

if TYPE_CHECKING:
    import xarray as xr

#: Sectors of the orbit, 5 degrees each.
SECTORS = 72
#: Most samples of a scene, and the least time between them [s].
SCENE_SAMPLES, SCENE_STEP = 2400, 0.05
#: Most samples of time for which films are computed.
_FILM_SAMPLES = 2400


class RunInput(NamedTuple):
    """What a result says of its own input."""

    bearing: Bearing
    models: dict[str, RollerModel]
    settings: dict[str, Any]


def run_input(result: xr.Dataset) -> RunInput:
    """Bearing, rollers and settings a result was computed with, from its attribute `input`.

    Parameters
    ----------
    result : xarray.Dataset
        From `macroslip.simulate`, or read from its netCDF file.

    Raises
    ------
    InputError
        If the dataset says nothing of its input.
    """
    try:
        settings = json.loads(result.attrs["input"])
        bearing = Bearing.from_dict(settings["bearing"])
        lubricant = Lubricant.from_dict(settings["lubricant"])
        forces, laws = settings["forces"], settings["laws"]
        models = {
            row: roller_model(
                bearing, lubricant, AXIAL_SIGNS[row], tilt=settings["drivetrain"]["tilt"],
                gravity=forces["gravity"], drag=forces["drag"], film=laws["film"], traction=laws["traction"],
            )
            for row in result.row.values.tolist()
        }
    except (KeyError, TypeError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(
            "the dataset does not say what it was computed with",
            where="attribute input",
            allowed="a result of macroslip run or macroslip.simulate",
        ) from None
    return RunInput(bearing, models, settings)


def traced_power(result: xr.Dataset) -> xr.DataArray:
    """Frictional power |F Δu| (33) at every time of the traces [W], over (row, roller, time, interface).

    A result that traces power itself, as a law with slip that varies inside the contact must, is taken at its word.
    """
    import xarray as xr

    if "power" in result and "time" in result.power.dims:
        return result.power
    surface_speed = result.spin * geometry.roller_radius(run_input(result).bearing)
    sliding = xr.concat([result.slip, result.slip, surface_speed], result.interface)
    power = np.abs(result.traction * sliding).transpose("row", "roller", "time", "interface")
    return power.assign_attrs(units="W", long_name="frictional power")


def position(result: xr.Dataset) -> xr.DataArray:
    """Angle of every roller from the bottom along the orbit at every time of the traces [degrees, 0 to 360].

    Parameters
    ----------
    result : xarray.Dataset
        With traces that begin at the first sample of the loads, where the rollers' places are known.

    Returns
    -------
    xarray.DataArray
        Over (row, roller, time).

    Raises
    ------
    InputError
        If there are no traces, they begin later, or no roller completed.
    """
    import xarray as xr

    if "time" not in result.dims or not result.sizes["time"]:
        raise InputError("the result has no traces", remedy="Give the case traces, such as traces: {step: 0.05 s}.")
    loads = run_input(result).settings["loads"]
    if abs(float(result.time[0]) - float(loads["start"])) > 1e-9:
        raise InputError(
            f"the traces begin at {float(result.time[0]):g} s, after the loads' {loads['start']:g} s, and where the "
            "rollers are then is not in the result",
            remedy="Leave traces.start away.",
        )
    turned = np.degrees(_travelled(result))
    start = np.degrees(result.start_angle) + 90.0
    angle = np.mod(start + xr.DataArray(turned, dims="time"), 360.0)
    angle = angle.transpose("row", "roller", "time").assign_coords(time=result.time)
    return angle.assign_attrs(units="degree", long_name="angle from the bottom along the orbit")


def _travelled(result: xr.Dataset) -> np.ndarray:
    """Angle [rad], with its sign, that all rollers have travelled since the traces begin."""
    whole = np.isfinite(result.spin_pure.values).all(axis=-1)
    if not whole.any():
        raise InputError("no roller completed, so that nothing is known of the orbit")
    bearing = run_input(result).bearing
    ratio = geometry.roller_radius(bearing) / geometry.outer_contact_radius(bearing)
    speed = -ratio * result.spin_pure.values[whole][0]
    steps = 0.5 * (speed[1:] + speed[:-1]) * np.diff(result.time.values)
    return np.concatenate([[0.0], np.cumsum(steps)])


def in_window(result: xr.Dataset) -> xr.Dataset:
    """The times of the traces inside the window over which energies are taken."""
    time = result.time
    return result.sel(time=(time >= result.attrs["window_start"]) & (time <= result.attrs["window_end"]))


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
    orbits = np.ptp(_travelled(result)[np.isin(result.time.values, window.time.values)]) / (2.0 * np.pi)
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
        {"units": "J/degree", "long_name": "energy per orbit and per degree of the orbit", "energy_ratio": ratio,
         "orbits": float(orbits)},
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

    every = max(1, math.ceil(result.sizes["time"] / samples))
    angle = position(result).isel(time=slice(None, None, every))
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


def films(result: xr.Dataset) -> xr.Dataset:
    """Film thickness, film parameter and whether the formula is in its range, at times of the traces in the window.

    Parameters
    ----------
    result : xarray.Dataset
        With traces from the first sample of the loads on.

    Returns
    -------
    xarray.Dataset
        Over (row, roller, time, interface): film_thickness [m] by the film law of the case; film_parameter Λ [1], film
        thickness over composite roughness; in_range [1] whether W and U are in the range of the formula; and angle
        [degrees] over (row, roller, time). NaN for an interface that carries no load, and after a failure.
    """
    import xarray as xr

    angles = position(result)
    window = in_window(result)
    window = window.isel(time=slice(None, None, max(1, math.ceil(window.sizes["time"] / _FILM_SAMPLES))))
    angle = angles.sel(time=window.time)
    bearing, models, _ = run_input(result)
    load = np.empty((*angle.shape, result.sizes["interface"]))
    radius = geometry.roller_radius(bearing)
    for r, row in enumerate(window.row.values.tolist()):
        load[r, ..., :2] = _raceway_loads(models[row], window.isel(row=r), angle.values[r])
        load[r, ..., 2] = np.abs(window.cage_force.values[r])
    surface = radius * window.spin.values
    ring = radius * window.spin_pure.values
    speed = np.stack([0.5 * np.abs(ring + surface)] * 2 + [0.5 * np.abs(surface)], axis=-1)
    speed = np.maximum(speed, LOWEST_ENTRAINMENT_SPEED)
    thickness, inside = np.full(load.shape, np.nan), np.full(load.shape, np.nan)
    model = next(iter(models.values()))
    for i, contact in enumerate((model.inner, model.outer, model.cage)):
        here = (load[..., i] > 0.0) & np.isfinite(speed[..., i])
        arguments = zip(load[..., i][here].tolist(), speed[..., i][here].tolist(), strict=True)
        found = [(film_thickness(contact.film, *one)[0], film_in_range(contact.film, *one)) for one in arguments]
        if found:
            thickness[..., i][here], inside[..., i][here] = np.array(found, dtype=float).T
    dims = ("row", "roller", "time", "interface")
    coordinates = {name: result[name] for name in ("row", "roller", "interface")} | {"time": window.time}
    return xr.Dataset(
        {
            "film_thickness": (dims, thickness, {"units": "m", "long_name": "film thickness"}),
            "film_parameter": (
                dims, thickness / bearing.composite_roughness,
                {"units": "1", "long_name": "film thickness over composite roughness, Λ"},
            ),
            "in_range": (dims, inside, {"units": "1", "long_name": "whether W and U are in the film formula's range"}),
            "angle": (dims[:3], angle.values, angle.attrs),
        },
        coordinates,
    )


def _raceway_loads(model: RollerModel, row: xr.Dataset, angle: np.ndarray) -> np.ndarray:
    """Normal loads at inner and outer raceway with weight and centrifugal force (18), as `roller.forces.station`."""
    orbital = row.spin_pure.values * model.radius / model.outer_radius
    height = -np.cos(np.radians(angle))  # sine of the position φ
    outward = (model.centrifugal * orbital**2 - model.weight_in_plane * height) * model.cos_contact_angle
    outward = outward + model.weight_along_axis * model.sin_contact_angle
    load = row.roller_load.values
    return np.stack([load + np.maximum(-outward, 0.0), load + np.maximum(outward, 0.0)], axis=-1)


def over_orbit(values: xr.DataArray, angle: xr.DataArray, quantiles: tuple[float, ...] = (0.05, 0.5, 0.95),
               sectors: int = SECTORS) -> xr.DataArray:
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


def scene(result: xr.Dataset, *, samples: int = SCENE_SAMPLES, step: float = SCENE_STEP) -> xr.Dataset:
    """A part of the traces to be played: the one around the largest power.

    Parameters
    ----------
    result : xarray.Dataset
        With traces from the first sample of the loads on.
    samples : int
        Most samples kept.
    step : float
        Least time between samples [s]; finer traces are thinned.

    Returns
    -------
    xarray.Dataset
        Over (row, roller, time), as 32-bit numbers: slip [m/s], roller_load [N] and power [W], summed over the
        interfaces, at the instant; and angle [degrees] of the rollers at the first kept time over (row, roller), and
        travelled [degrees] since then over (time).
    """
    import xarray as xr

    angle = position(result)
    travelled = np.degrees(_travelled(result))
    every = max(1, round(step / float(np.median(np.diff(result.time.values)))))  # two samples at least
    power = traced_power(result).sum("interface", skipna=False).isel(time=slice(None, None, every))
    kept = power.sizes["time"]
    window = np.isin(power.time.values, in_window(result).time.values)
    total = np.where(window, np.nan_to_num(power.values, nan=-1.0).max(axis=(0, 1)), -1.0)
    first = int(np.clip(int(np.argmax(total)) - samples // 2, 0, max(0, kept - samples)))
    part = slice(first, first + samples)
    thin = result.isel(time=slice(None, None, every)).isel(time=part)
    values = {"slip": thin.slip, "roller_load": thin.roller_load, "power": power.isel(time=part)}
    found = xr.Dataset({name: one.transpose("row", "roller", "time").astype(np.float32) for name, one in values.items()})
    found.power.attrs = {"units": "W", "long_name": "frictional power, all interfaces, at the instant"}
    found["angle"] = angle.isel(time=slice(None, None, every)).isel(time=part).isel(time=0, drop=True)
    moved = travelled[::every][part]
    found["travelled"] = ("time", moved - moved[0], {"units": "degree", "long_name": "angle travelled since the start"})
    return found


def orbit_profile(result: xr.Dataset) -> dict[str, xr.Dataset]:
    """What a report shows of one result with traces, without the traces.

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
