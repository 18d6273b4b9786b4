"""Pictures of a bearing whose rollers and cages move together."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes


def plot_force_by_position(axes: Axes, result: xr.Dataset, row: str) -> Axes:
    """Largest force of a spar by place on the orbit, on a logarithmic radius; polar axes, looking downwind.

    Parameters
    ----------
    axes : matplotlib Axes
        Polar.
    result : xarray.Dataset
        Of a whole bearing.
    row : str

    Returns
    -------
    matplotlib Axes
    """
    force = result.largest_force_by_position.sel(row=row)
    place = result.position.values
    values = np.maximum(force.values, 1e-1)
    # Looking downwind +X0 is on the left, and φ runs clockwise.
    axes.set_theta_zero_location("W")
    axes.set_theta_direction(-1)
    # A full turn later, not back across the picture.
    axes.plot(np.append(place, place[0] + 2.0 * np.pi), np.append(values, values[0]), drawstyle="steps-mid")
    axes.set_rscale("log")
    axes.set_rlim(1e-1, max(10.0, 2.0 * float(values.max())))
    axes.set_xticks(np.radians([0.0, 90.0, 180.0, 270.0]), ["+X0", "top", "−X0", "bottom"])
    axes.set_title(f"{row} row [N]")
    return axes


def plot_residuals(axes: Axes, result: xr.Dataset) -> Axes:
    """Residuals of the balances over time, each over what has passed through by the end.

    Parameters
    ----------
    axes : matplotlib Axes
    result : xarray.Dataset
        Of a whole bearing.

    Returns
    -------
    matplotlib Axes
    """
    impulse = float(abs(result.book_inner_impulse).max()) or 1.0
    spent = float(abs(result.book_raceway_loss[-1])) + float(abs(result.pocket_loss[-1])) or 1.0
    time = result.book_time.values
    for values, label in (
        (result.momentum_residual / impulse, "angular momentum"),
        (result.energy_residual / spent, "energy"),
    ):
        axes.plot(time, np.maximum(np.abs(values.values), 1e-17), label=label)
    axes.set_yscale("log")
    axes.set_xlabel("time [s]")
    axes.set_ylabel("residual / passed through [–]")
    axes.set_title("Books")
    return axes
