"""One roller over one turn from the bottom to the bottom, under constant or time-varying load (figure 3)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.bearing import geometry
from macroslip.bearing.geometry import initial_angles
from macroslip.case.case import Case
from macroslip.case.parts import Traces, Window
from macroslip.errors import InputError
from macroslip.loads import BearingLoads
from macroslip.mechanisms import Laws
from macroslip.result.simulate import simulate
from macroslip.ring.orbit import travel

if TYPE_CHECKING:
    import xarray as xr

#: Kept points of a turn, and integrated samples between them: 0.5° and, at 20 rpm, a quarter of a millisecond.
_POINTS, _FINE = 720, 36
#: Spin, as a part of pure rolling, from which on a roller counts as recovered.
_RECOVERED = 0.99


def static_load(variable: BearingLoads, *, thrust: bool, duration: float) -> BearingLoads:
    """Constant load and speed from the means over the samples of a history.

    The downward part alone, (0, mean F_Y0, 0), leaves an unloaded zone at the top; with thrust it is
    (0, mean F_Y0, mean F_Z0).

    Parameters
    ----------
    variable : BearingLoads
    thrust : bool
        Whether the mean thrust acts too.
    duration : float
        [s].
    """
    _, down, axial = variable.force.mean(axis=0)
    force = [0.0, down, axial if thrust else 0.0]
    return BearingLoads.constant(force, float(variable.shaft_speed.mean()), duration)


def trace_turn(loads: BearingLoads, row: str, roller: int, time: float, laws: Laws = Laws.paper()) -> xr.Dataset:
    """Spin and cumulative frictional energy of one roller over the turn from the bottom to the bottom at `time`.

    The history is integrated from its start, so the roller arrives with its own past.

    Parameters
    ----------
    loads : BearingLoads
        The shaft must not stop or turn back.
    row : str
        "downwind" or "upwind".
    roller : int
        Number in the row.
    time : float
        A time within the turn [s].
    laws : Laws
        Mechanisms in the contacts.

    Returns
    -------
    xarray.Dataset
        Over `angle`, degrees from the bottom along the orbit (180 is the top), 721 points: spin_speed and
        spin_speed_pure [rad/s], energy_fraction, roller_load [N]. Attributes: row, roller, start and end [s], energy
        [J] of the turn, peak_power [W] at any interface, lowest spin ratio, recovery_time [s] from the lowest spin to
        99 % of pure rolling (NaN if it is never that slow, or does not recover).

    Raises
    ------
    InputError
        If no whole turn holds that time.
    """
    import xarray as xr

    case = Case(loads=loads, rollers=[roller])
    angle_at_samples = _angle_from_bottom(loads, case, row, roller)
    start, end = _turn(loads, angle_at_samples, time)
    # The history after the turn has no influence.
    until = loads.window(None, float(loads.time[np.searchsorted(loads.time, end)]))
    step = (end - start) / (_POINTS * _FINE)
    # Rounding may put the last trace time past the end of the turn by one unit in the last place.
    traces = Traces(step=step * (1.0 - 1e-12), start=start, end=end)
    window = Window(start=start, end=end)
    result = simulate(Case(loads=until, rollers=[roller], window=window, traces=traces, laws=laws), threads=1)
    result = result.sel(row=row).isel(roller=0)
    by_interface = result.power.values
    power = by_interface.sum(axis=1)
    seconds = result.time.values
    pieces = 0.5 * (power[1:] + power[:-1]) * np.diff(seconds)
    cumulative = np.concatenate([[0.0], np.cumsum(pieces)])
    angle = np.degrees(np.interp(seconds, loads.time, angle_at_samples))
    angle -= 360.0 * np.round(angle[0] / 360.0)
    ratio = result.spin.values / result.spin_pure.values
    every = slice(None, None, _FINE)

    def variable(values: np.ndarray, units: str, long_name: str) -> tuple:
        return ("angle", values[every], {"units": units, "long_name": long_name})

    return xr.Dataset(
        {
            "spin_speed": variable(np.abs(result.spin.values), "rad/s", "spin speed"),
            "spin_speed_pure": variable(np.abs(result.spin_pure.values), "rad/s", "spin speed in pure rolling"),
            "energy_fraction": variable(cumulative / cumulative[-1], "1", "energy so far over that of the turn"),
            "roller_load": variable(result.roller_load.values, "N", "load of the roller"),
        },
        {"angle": variable(angle, "degree", "angle from the bottom along the orbit")},
        {
            "load": loads.source,
            "row": row,
            "roller": roller,
            "status": int(result.status),
            "start_s": start,
            "end_s": end,
            "energy_J": float(result.energy.sum(skipna=False)),
            **{f"energy_{name}_J": float(result.energy.sel(interface=name)) for name in ("inner", "outer", "cage")},
            "energy_from_traces_J": float(cumulative[-1]),
            "peak_power_W": float(by_interface.max()),
            "lowest_spin_ratio": float(ratio.min()),
            "recovery_time_s": _recovery_time(seconds, ratio),
        },
    )


def static_turn(variable: BearingLoads, row: str, *, thrust: bool, laws: Laws = Laws.paper()) -> xr.Dataset:
    """The ninth turn of the row's first roller under the `static_load` of a history; by then spin is periodic."""
    period = 2.0 * np.pi / (geometry.orbit_ratio(Case(loads=variable).bearing) * float(variable.shaft_speed.mean()))
    return trace_turn(static_load(variable, thrust=thrust, duration=9.5 * period), row, 0, 8.5 * period, laws)


def typical_turn(loads: BearingLoads, result: xr.Dataset, row: str, laws: Laws = Laws.paper()) -> xr.Dataset:
    """The turn of the row's first roller whose energy comes closest to the median of all rollers' orbits but the last.

    Parameters
    ----------
    loads : BearingLoads
    result : xarray.Dataset
        Of simulating these loads; its orbits are counted from the roller's place at the start, which for the first
        roller is the bottom or half a pitch past it.
    row : str
    """
    energy = result.orbit_energy.sel(row=row).isel(orbit=slice(None, -1)).sum("interface", skipna=False)
    roller = int(result.roller.values[0])
    orbit = int(np.argmin(np.abs(energy.isel(roller=0).values - np.median(energy.values))))
    middle = 0.5 * (result.orbit_start.values[orbit] + result.orbit_end.values[orbit])
    return trace_turn(loads, row, roller, float(middle), laws)


def largest_peak(result: xr.Dataset, row: str) -> tuple[int, int]:
    """Number of the roller and of the orbit with the row's largest power at any interface, the last orbit left out.

    A turn from the bottom that begins in the last orbit may not end before the loads do.
    """
    peak = result.peak_power.sel(row=row).isel(orbit=slice(None, -1)).max("interface").values
    # A failed roller (NaN) has no peak to compare.
    roller, orbit = np.unravel_index(int(np.argmax(np.nan_to_num(peak, nan=-1.0))), peak.shape)
    return int(result.roller.values[roller]), int(orbit)


def peak_turn(loads: BearingLoads, result: xr.Dataset, row: str, laws: Laws = Laws.paper()) -> xr.Dataset:
    """The turn with the row's largest frictional power. Parameters are those of `typical_turn`."""
    roller, orbit = largest_peak(result, row)
    # An orbit counted from the roller's place at the start lies in two turns from the bottom.
    ends = float(result.orbit_start.values[orbit]), float(result.orbit_end.values[orbit]) - 1e-6
    return max((trace_turn(loads, row, roller, end, laws) for end in ends), key=lambda turn: turn.peak_power_W)


def inflexion_angle(turn: xr.Dataset) -> float:
    """Angle of the inflexion of spin nearest the top [degrees from the bottom], in the unloaded zone; NaN if none.

    There the deceleration is least: the slope of the spin speed has a maximum.
    """
    angle, free = turn.angle.values, turn.roller_load.values == 0.0
    slope = np.gradient(turn.spin_speed.values, angle)
    middle = slice(1, -1)
    # The load affects neighbours of a loaded sample through the difference quotient.
    inside = free[middle] & free[2:] & free[:-2]
    inside &= np.roll(inside, 1) & np.roll(inside, -1)
    maximum = inside & (slope[middle] >= slope[:-2]) & (slope[middle] > slope[2:])
    found = angle[middle][maximum]
    return float(found[np.argmin(np.abs(found - 180.0))]) if found.size else float("nan")


def _angle_from_bottom(loads: BearingLoads, case: Case, row: str, roller: int) -> np.ndarray:
    """Angle of the roller along its orbit from the bottom at the load samples, rising without wrap [rad]."""
    if loads.shaft_speed.min() <= 0.0:
        raise InputError("the shaft stops or turns back", where=loads.source, allowed="speeds above 0")
    begin = initial_angles(row, case.bearing.rollers_per_row)[roller] + 0.5 * np.pi
    return begin + travel(loads.time, loads.shaft_speed, geometry.orbit_ratio(case.bearing))


def _turn(loads: BearingLoads, angle: np.ndarray, time: float) -> tuple[float, float]:
    """Start and end [s] of the turn from bottom to bottom that holds `time`."""
    # A roller that has just come to the bottom begins a turn, whatever the rounding.
    turns = np.floor(np.interp(time, loads.time, angle) / (2.0 * np.pi) + 1e-9)
    marks = 2.0 * np.pi * np.array([turns, turns + 1.0])
    if marks[0] < angle[0] - 1e-9 or marks[1] > angle[-1]:
        raise InputError(f"no whole turn holds t = {time:g} s", where=loads.source, remedy="Choose another time.")
    start, end = np.interp(marks, angle, loads.time)
    return float(start), float(end)


def _recovery_time(seconds: np.ndarray, ratio: np.ndarray) -> float:
    lowest = int(np.argmin(ratio))
    recovered = np.flatnonzero(ratio[lowest:] >= _RECOVERED)
    if ratio[lowest] >= _RECOVERED or recovered.size == 0:
        return float("nan")
    return float(seconds[lowest + recovered[0]] - seconds[lowest])
