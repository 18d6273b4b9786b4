"""Skew over the orbit, drawn for a report."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.report.style import ROW, finish

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes


def plot_skew_over_orbit(axes: Axes, result: xr.Dataset) -> Axes:
    """Mean skew of pressed rollers over the orbit, a line a row, and dashed what it adds to the power of one roller.

    Takes a result with `skew_by_position` [rad] and `skew_power_by_position` [W].
    """
    angle = (np.degrees(result.position.values) + 90.0) % 360.0
    order, power = np.argsort(angle), axes.twinx()
    for row in result.row.values.tolist():
        colour, one = ROW[row]["color"], result.sel(row=row)
        axes.plot(angle[order], 1e3 * one.skew_by_position.values[order], color=colour, label=f"{row} row")
        power.plot(angle[order], one.skew_power_by_position.values[order], color=colour, linestyle="--")
    axes.axhline(0.0, color="0.6", linewidth=0.6)
    axes.set_xlim(0.0, 360.0)
    axes.set_xticks([0.0, 90.0, 180.0, 270.0, 360.0])
    power.set_ylabel("added power, dashed [W]")
    return finish(axes, "angle from the bottom, top at 180 [°]", "skew [mrad]")
