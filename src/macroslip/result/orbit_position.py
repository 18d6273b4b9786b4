"""Where the rollers are at the times of a run's traces.

Angles count from the bottom along the orbit of a shaft that turns forward; 180 degrees is the top.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.bearing import geometry
from macroslip.errors import InputError
from macroslip.result.run_input import run_input

if TYPE_CHECKING:
    import xarray as xr


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
    turned = np.degrees(travelled(result))
    start = np.degrees(result.start_angle) + 90.0
    angle = np.mod(start + xr.DataArray(turned, dims="time"), 360.0)
    angle = angle.transpose("row", "roller", "time").assign_coords(time=result.time)
    return angle.assign_attrs(units="degree", long_name="angle from the bottom along the orbit")


def travelled(result: xr.Dataset) -> np.ndarray:
    """Angle [rad], with its sign, that all rollers have travelled since the traces begin, at each of their times."""
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
