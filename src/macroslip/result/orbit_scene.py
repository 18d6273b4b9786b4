"""A part of a run's traces to be played."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.result.orbit_position import in_window, position, travelled
from macroslip.result.run_input import run_input
from macroslip.result.traced_power import traced_power

if TYPE_CHECKING:
    import xarray as xr

#: Most samples of a scene, and the least time between them [s].
SCENE_SAMPLES, SCENE_STEP = 2400, 0.05


def scene(result: xr.Dataset, *, samples: int = SCENE_SAMPLES, step: float = SCENE_STEP) -> xr.Dataset:
    """A part of the traces to be played, around the largest power.

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
        travelled [degrees] since then over (time). Where pockets were computed also cage_force [N], pocket_offset [m],
        and cage_lead [degrees], by which a cage is ahead of pure rolling, over (row, time).
    """
    import xarray as xr

    angle = position(result)
    turned = np.degrees(travelled(result))
    every = max(1, round(step / float(np.median(np.diff(result.time.values)))))  # two samples at least
    power = traced_power(result).sum("interface", skipna=False).isel(time=slice(None, None, every))
    kept = power.sizes["time"]
    window = np.isin(power.time.values, in_window(result).time.values)
    total = np.where(window, np.nan_to_num(power.values, nan=-1.0).max(axis=(0, 1)), -1.0)
    first = int(np.clip(int(np.argmax(total)) - samples // 2, 0, max(0, kept - samples)))
    part = slice(first, first + samples)
    thin = result.isel(time=slice(None, None, every)).isel(time=part)
    values = {"slip": thin.slip, "roller_load": thin.roller_load, "power": power.isel(time=part)}
    order = ("row", "roller", "time")
    found = xr.Dataset({name: one.transpose(*order).astype(np.float32) for name, one in values.items()})
    found.power.attrs = {"units": "W", "long_name": "frictional power, all interfaces, at the instant"}
    if "pocket_offset" in thin:
        for name in ("cage_force", "pocket_offset"):
            found[name] = thin[name].transpose(*order).astype(np.float32)
        found["cage_lead"] = (
            ("row", "time"),
            _leads(thin),
            {"units": "degree", "long_name": "cage ahead of pure rolling"},
        )
    found["angle"] = angle.isel(time=slice(None, None, every)).isel(time=part).isel(time=0, drop=True)
    moved = turned[::every][part]
    found["travelled"] = ("time", moved - moved[0], {"units": "degree", "long_name": "angle travelled since the start"})
    return found


def _leads(result: xr.Dataset) -> np.ndarray:
    """Angle by which each row's cage is ahead of pure rolling [degrees], shape (row, time)."""
    pitch = run_input(result).bearing.pitch_radius
    lead = np.degrees(result.cage_lag.transpose("cage", "time").values / pitch).astype(np.float32)
    return np.broadcast_to(lead, (result.sizes["row"], lead.shape[1]))
