"""Load, slip and energy of rollers by their position on the orbit, from a run's traces.

Angles count from the bottom along the orbit of a shaft that turns forward; 180 degrees is the top.
All functions need traces from the first sample of the loads on, and raise InputError as `position`
does.
"""

from __future__ import annotations

import math

import numpy as np
import xarray as xr

from macroslip.bearing import geometry
from macroslip.constants import SECTORS
from macroslip.errors import InputError
from macroslip.result.run_input import run_input
from macroslip.result.variables import VARIABLES, WHOLE
from macroslip.variables import ALWAYS, Variable, VariableTable, described

#: Most samples of time from which quantiles are taken.
_QUANTILE_SAMPLES = 2400
#: Most samples of a scene, and the least time between them [s].
SCENE_SAMPLES = 2400
SCENE_STEP = 0.05
_ORDER = ("row", "roller", "time")
_ANGLE = described("degree", "angle from the bottom along the orbit")
_QUANTILES = ("row", "interface", "quantile", "angle")
_ROLLERS = ("row", "roller")
#: Averages over the orbit.
AVERAGES = VariableTable(
    "Averages over the orbit, `macroslip.result.orbit.orbit_profile`",
    (
        Variable(
            "energy_over_orbit",
            ("row", "interface", "angle"),
            "J/degree",
            ALWAYS,
            "energy per orbit and per degree of the orbit",
        ),
        VARIABLES["film_thickness"]._replace(dims=_QUANTILES, when=ALWAYS),
        Variable(
            "film_parameter",
            _QUANTILES,
            "1",
            ALWAYS,
            "film thickness over composite roughness, Λ",
        ),
        Variable(
            "slip",
            ("row", "quantile", "angle"),
            "1",
            ALWAYS,
            "slip over the speed of the raceways",
        ),
        Variable("roller_load", ("row", "time", "angle"), "N", ALWAYS, "load of the rollers"),
    ),
)
#: A part of the traces, as 32-bit numbers.
SCENE = VariableTable(
    "Part of the traces that a page plays, `macroslip.result.orbit.scene`",
    (
        *(VARIABLES[name] for name in ("slip", "roller_load")),
        Variable("power", _ORDER, "W", ALWAYS, "frictional power, all interfaces, at the instant"),
        *(VARIABLES[name] for name in ("cage_force", "pocket_offset")),
        Variable("cage_lead", ("row", "time"), "degree", WHOLE, "cage ahead of pure rolling"),
        Variable("angle", _ROLLERS, "degree", ALWAYS, _ANGLE["long_name"]),
        Variable("travelled", ("time",), "degree", ALWAYS, "angle travelled since the start"),
    ),
)
#: The bearing at one moment.
STILL = VariableTable(
    "The bearing at the moment of the largest power, `macroslip.result.orbit.still`",
    (
        Variable("angle", _ROLLERS, "degree", ALWAYS, _ANGLE["long_name"]),
        Variable("slip", _ROLLERS, "1", ALWAYS, "slip over the speed of the raceways"),
        VARIABLES["roller_load"]._replace(dims=_ROLLERS, when=ALWAYS),
    ),
)


def position(result: xr.Dataset) -> xr.DataArray:
    """Angle of every roller [degrees, 0 to 360] over (row, roller, time).

    Raises InputError if there are no traces, they begin after the loads, where the rollers' places
    are not known, or no roller completed.
    """
    if "time" not in result.dims or not result.sizes["time"]:
        raise InputError(
            "the result has no traces",
            remedy="Give the case traces, such as traces: {step: 0.05 s}.",
        )
    start = run_input(result).start
    if abs(float(result.time[0]) - start) > 1e-9:
        raise InputError(
            f"the traces begin at {float(result.time[0]):g} s, after the loads' {start:g} s, "
            "and where the "
            "rollers are then is not in the result",
            remedy="Leave traces.start away.",
        )
    turned = xr.DataArray(np.degrees(travelled(result)), dims="time")
    from_bottom = np.degrees(result.start_angle) + 90.0
    angle = np.mod(from_bottom + turned, 360.0)
    with_time = angle.transpose(*_ORDER).assign_coords(time=result.time)
    return with_time.assign_attrs(_ANGLE)


def travelled(result: xr.Dataset) -> np.ndarray:
    """Signed angle [rad] that all rollers have travelled since the traces begin, by time."""
    pure_spin = result.spin_pure.values
    whole = np.isfinite(pure_spin).all(axis=-1)
    if not whole.any():
        raise InputError("no roller completed, so that nothing is known of the orbit")
    bearing = run_input(result).bearing
    ratio = geometry.roller_radius(bearing) / geometry.outer_contact_radius(bearing)
    speed = -ratio * pure_spin[whole][0]
    mean_speed = 0.5 * (speed[1:] + speed[:-1])
    steps = np.diff(result.time.values)
    turned = np.cumsum(mean_speed * steps)
    return np.concatenate([[0.0], turned])


def in_window(result: xr.Dataset) -> xr.Dataset:
    """Traces inside the window over which energies are summed."""
    has_begun = result.time >= result.attrs["window_start"]
    goes_on = result.time <= result.attrs["window_end"]
    return result.sel(time=has_begun & goes_on)


def _thinned(size: int, most: int) -> slice:
    """Slice that thins `size` samples evenly to `most` at most."""
    step = max(1, math.ceil(size / most))
    return slice(None, None, step)


def _middles(sectors: int) -> tuple[str, np.ndarray, dict[str, str]]:
    numbers = np.arange(sectors)
    middles = 360.0 / sectors * (numbers + 0.5)
    return "angle", middles, _ANGLE


def _sectors(angle: xr.DataArray, sectors: int) -> np.ndarray:
    numbers = (angle.values * (sectors / 360.0)).astype(int)
    return np.minimum(numbers, sectors - 1)


def _evenly_passed(energy: np.ndarray, passed: np.ndarray) -> np.ndarray:
    """Energy by sector, normalised to equal numbers of passes."""
    per_way = np.zeros(energy.size)
    np.divide(energy, passed, out=per_way, where=passed > 0.0)
    total = per_way.sum()
    return per_way / total * energy.sum() if total != 0.0 else per_way


def energy_over_orbit(result: xr.Dataset, sectors: int = SECTORS) -> xr.DataArray:
    """Frictional energy per orbit and degree [J/degree], mean over the rollers that completed.

    Over (row, interface, angle), the angle being the middle of the sector. The sum over the sectors
    times their width is the energy per orbit, within what the traces' samples resolve; sectors that
    are passed more often than others, because orbits are no whole number, count as if all were
    passed equally often. The attribute `energy_ratio` holds energy from the traces over the
    integrator's own, both rows and all interfaces, `orbits` how many were made.
    """
    angle = position(result)
    window = in_window(result)
    if window.sizes["time"] < 2:
        raise InputError(
            "the traces hold less than two samples of the window", remedy="Give them a later end."
        )
    power = window.power.transpose(*_ORDER, "interface").values
    angles = travelled(result)[np.isin(result.time.values, window.time.values)]
    orbits = np.ptp(angles) / (2.0 * np.pi)
    seconds = np.gradient(window.time.values)
    way = np.abs(np.gradient(angles))
    for weights in (seconds, way):
        weights[[0, -1]] *= 0.5  # trapezoids
    completed = (result.status == 0).values
    sector = _sectors(angle.sel(time=window.time), sectors)
    interfaces = result.sizes["interface"]
    values = np.full((result.sizes["row"], interfaces, sectors), np.nan)
    for row in np.flatnonzero(completed.any(axis=1) & (orbits > 0.0)):
        chosen = completed[row]
        rollers = int(chosen.sum())
        sector_of_sample = sector[row, chosen].ravel()
        passed = np.bincount(sector_of_sample, np.tile(way, rollers), sectors)
        degrees = rollers * orbits * 360.0 / sectors
        for interface in range(interfaces):
            energy = power[row, chosen, :, interface] * seconds
            in_sector = np.bincount(sector_of_sample, energy.ravel(), sectors)
            values[row, interface] = _evenly_passed(in_sector, passed) / degrees
    traced = (power[completed] * seconds[:, None]).sum()
    integrated = result.energy.values[completed].sum()
    about = AVERAGES["energy_over_orbit"].attributes | {
        "energy_ratio": float(traced / integrated) if integrated else math.nan,
        "orbits": float(orbits),
    }
    labels = {"row": result.row, "interface": result.interface, "angle": _middles(sectors)}
    return xr.DataArray(values, labels, ("row", "interface", "angle"), "energy_over_orbit", about)


def load_zone(result: xr.Dataset, sectors: int = SECTORS, samples: int = 600) -> xr.DataArray:
    """Roller load [N] over (row, time, angle), interpolated between neighbouring rollers.

    The load is given at as many angles as there are sectors, and at `samples` evenly spaced times
    at most.
    """
    angles = position(result)
    every = _thinned(angles.sizes["time"], samples)
    angle = angles.isel(time=every)
    load = result.roller_load.isel(time=every).values
    dims = _middles(sectors)
    values = np.empty((result.sizes["row"], angle.sizes["time"], sectors))
    _, middles, _ = dims
    for r, k in np.ndindex(*values.shape[:2]):
        load_of_samples = load[r, :, k]
        known = angle.values[r, :, k]
        values[r, k] = np.interp(middles, known, load_of_samples, period=360.0)
    labels = {"row": result.row, "time": angle.time, "angle": dims}
    load_over_orbit = AVERAGES["roller_load"]
    return xr.DataArray(
        values, labels, load_over_orbit.dims, load_over_orbit.name, load_over_orbit.attributes
    )


def over_orbit(
    values: xr.DataArray,
    angle: xr.DataArray,
    quantiles: tuple[float, ...] = (0.05, 0.5, 0.95),
    sectors: int = SECTORS,
) -> xr.DataArray:
    """Quantiles of a traced quantity over all rollers and times, by sector of the orbit.

    Parameters
    ----------
    values : xarray.DataArray
        Over (row, roller, time, interface).
    angle : xarray.DataArray
        Of the rollers [degrees] over (row, roller, time).
    quantiles : tuple of float, optional
    sectors : int, optional
        Sectors of the orbit.

    Returns
    -------
    xarray.DataArray
        Over (row, interface, quantile, angle); NaN where a sector holds no value.
    """
    rows = values.sizes["row"]
    interfaces = values.sizes["interface"]
    quantile_values = np.full((rows, interfaces, len(quantiles), sectors), np.nan)
    sectors_by_row = _sectors(angle, sectors).reshape(rows, -1)
    for r, sector in enumerate(sectors_by_row):
        order = np.argsort(sector, kind="stable")
        ends = np.searchsorted(sector[order], np.arange(sectors + 1))
        for i, k in np.ndindex(interfaces, sectors):
            samples = order[ends[k] : ends[k + 1]]
            of_interface = values.values[r, ..., i].ravel()
            in_sector = of_interface[samples]
            known = in_sector[np.isfinite(in_sector)]
            if known.size:
                quantile_values[r, i, :, k] = np.quantile(known, quantiles)
    labels = {
        "row": values.row,
        "interface": values.interface,
        "quantile": list(quantiles),
        "angle": _middles(sectors),
    }
    return xr.DataArray(
        quantile_values,
        labels,
        ("row", "interface", "quantile", "angle"),
        values.name,
        values.attrs,
    )


def orbit_profile(result: xr.Dataset) -> dict[str, xr.Dataset]:
    """Averages over traces that a report shows of one result.

    "result" is the result without its traces; "orbit" has `energy_over_orbit`, and quantiles of
    film_thickness [m] and film_parameter [1] over (row, interface, quantile, angle), and of slip
    over the speed of the raceways [1]; the others are "load_zone", "scene" and "still".
    """
    orbit = energy_over_orbit(result).to_dataset()
    window = in_window(result)
    every = _thinned(window.sizes["time"], _QUANTILE_SAMPLES)
    traced = window.isel(time=every)
    angle = position(result).sel(time=traced.time)
    film = traced.film_thickness.transpose(*_ORDER, "interface")
    thickness = over_orbit(film, angle)
    orbit["film_thickness"] = thickness
    with np.errstate(invalid="ignore", divide="ignore"):
        slip = 1.0 - traced.spin / traced.spin_pure
    slip = slip.expand_dims(interface=["raceways"], axis=-1)
    slip_over_orbit = over_orbit(slip, angle)
    over_rollers = slip_over_orbit.isel(interface=0, drop=True)
    orbit["slip"] = over_rollers.assign_attrs(AVERAGES["slip"].attributes)
    roughness = run_input(result).bearing.composite_roughness
    film_parameter = thickness / roughness
    orbit["film_parameter"] = film_parameter.assign_attrs(AVERAGES["film_parameter"].attributes)
    return {
        "result": result.drop_dims("time"),
        "orbit": orbit,
        "load_zone": load_zone(result).to_dataset(),
        "scene": scene(result),
        "still": still(result),
    }


def still(result: xr.Dataset) -> xr.Dataset:
    """The bearing at the moment of the largest frictional power in the traces.

    Over (row, roller): angle [degrees], slip [1] over the speed of the raceways, 1 for a roller
    that does not spin, and roller_load [N].
    """
    angle = position(result)
    of_rollers = in_window(result).power.sum("interface")
    power = of_rollers.max(("row", "roller"))
    largest = int(power.argmax("time"))
    moment = result.sel(time=power.time[largest])
    slip = 1.0 - moment.spin / moment.spin_pure
    slip = slip.assign_attrs(STILL["slip"].attributes)
    values = {"angle": angle.sel(time=moment.time), "slip": slip}
    return xr.Dataset(values | {"roller_load": moment.roller_load})


def scene(
    result: xr.Dataset, *, samples: int = SCENE_SAMPLES, step: float = SCENE_STEP
) -> xr.Dataset:
    """Excerpt of the traces around the largest power, for the animation of a page.

    At most `samples`, at least `step` [s] apart, over (row, roller, time), as 32-bit numbers: slip
    [m/s], roller_load [N] and power [W], summed over the interfaces, at the instant; and angle
    [degrees] of the rollers at the first kept time over (row, roller), and travelled [degrees]
    since then over (time). Where pockets were computed also cage_force [N], pocket_offset [m], and
    cage_lead [degrees], by which a cage is ahead of pure rolling, over (row, time).
    """
    angle = position(result)
    turned = np.degrees(travelled(result))
    interval = float(np.median(np.diff(result.time.values)))  # two samples at least
    every = slice(None, None, max(1, round(step / interval)))
    power = result.power.sum("interface", skipna=False).isel(time=every).transpose(*_ORDER)
    window = np.isin(power.time.values, in_window(result).time.values)
    largest = np.nan_to_num(power.values, nan=-1.0).max(axis=(0, 1))
    total = np.where(window, largest, -1.0)
    middle = int(np.argmax(total))
    last_start = max(0, total.size - samples)
    first = max(middle - samples // 2, 0)
    first = min(first, last_start)
    part = slice(first, first + samples)
    thin = result.isel(time=every).isel(time=part)
    values = {"slip": thin.slip, "roller_load": thin.roller_load, "power": power.isel(time=part)}
    if "pocket_offset" in thin:
        values |= {name: thin[name] for name in ("cage_force", "pocket_offset")}
    played = xr.Dataset(
        {name: variable.transpose(*_ORDER).astype(np.float32) for name, variable in values.items()}
    )
    played.power.attrs = SCENE["power"].attributes
    if "pocket_offset" in thin:
        pitch_radius = run_input(result).bearing.pitch_radius
        lag = thin.cage_lag.transpose("cage", "time").values
        lead = np.degrees(lag / pitch_radius).astype(np.float32)
        of_rows = np.broadcast_to(lead, (result.sizes["row"], lead.shape[1]))
        played["cage_lead"] = SCENE["cage_lead"].of(of_rows)
    played["angle"] = angle.isel(time=every).isel(time=part).isel(time=0, drop=True)
    moved = turned[every][part]
    return played.assign(travelled=SCENE["travelled"].of(moved - moved[0]))
