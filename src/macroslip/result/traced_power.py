"""Frictional power at the times of a run's traces."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.bearing import geometry
from macroslip.result.run_input import run_input

if TYPE_CHECKING:
    import xarray as xr


def traced_power(result: xr.Dataset) -> xr.DataArray:
    """Frictional power |F Δu| (33) at every time of the traces [W], over (row, roller, time, interface).

    A result that traces power itself, which laws with slip that varies inside the contact require, is used as it is.
    """
    import xarray as xr

    if "power" in result and "time" in result.power.dims:
        return result.power
    surface_speed = result.spin * geometry.roller_radius(run_input(result).bearing)
    sliding = xr.concat([result.slip, result.slip, surface_speed], result.interface)
    power = np.abs(result.traction * sliding).transpose("row", "roller", "time", "interface")
    return power.assign_attrs(units="W", long_name="frictional power")
