"""The reproduction's figures, put together from the plot functions; each returns a Figure."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from macroslip.report.orbit_figures import plot_cumulative_energy, plot_spin
from macroslip.report.style import GREY, legend_above, new_figure
from macroslip.reproduction.solver_figures import (
    plot_deviation,
    plot_nonlinear_tolerance,
    plot_stability,
    plot_step_size,
)
from macroslip.reproduction.wind_speed_figures import (
    plot_energy,
    plot_energy_ratio,
    plot_peak_power,
    plot_peak_power_ratio,
)

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


def turns_figure(turns: Mapping[str, xr.Dataset]) -> Figure:
    """Figure 3: spin above and cumulative energy below, a column for each turn under its title."""
    figure, axes = new_figure(7.2, 5.2, 2, len(turns), sharex=True, sharey="row")
    for column, (title, turn) in enumerate(turns.items()):
        plot_spin(axes[column], turn, title).set_xlabel("")
        plot_cumulative_energy(axes[column + len(turns)], turn)
        if column:
            axes[column].set_ylabel("")
            axes[column + len(turns)].set_ylabel("")
    legend_above(figure, axes[0])
    return figure


def energy_figure(numbers: xr.Dataset) -> Figure:
    """Figure 4a: normalised energy of the downwind row, the upwind row and both."""
    figure, axes = new_figure(7.2, 3.5, 1, 3, sharey=True)
    for one, row in zip(axes, ("downwind", "upwind", None), strict=True):
        plot_energy(one, numbers, row)
    return _finish_columns(figure, axes, "turbulence class; bars: range over the rollers of the row")


def energy_ratio_figure(numbers: xr.Dataset) -> Figure:
    """Figure 4b: energy of the downwind over the upwind row."""
    figure, axes = new_figure(4.8, 3.4)
    plot_energy_ratio(axes[0], numbers)
    legend_above(figure, axes[0], title="turbulence class")
    return figure


def peak_power_figure(numbers: xr.Dataset) -> Figure:
    """Figure 5a: normalised P_max per orbit, mean ± standard deviation, of both rows."""
    figure, axes = new_figure(7.2, 3.4, 1, 2)
    for one, row in zip(axes, ("downwind", "upwind"), strict=True):
        plot_peak_power(one, numbers, row)
    return _finish_columns(figure, axes, "turbulence class; bars: ± standard deviation, cut at zero")


def peak_power_ratio_figure(numbers: xr.Dataset) -> Figure:
    """Figure 5b: mean P_max of the downwind over the upwind row."""
    figure, axes = new_figure(4.8, 3.4)
    plot_peak_power_ratio(axes[0], numbers)
    legend_above(figure, axes[0], title="turbulence class")
    return figure


def stability_figure(stability: xr.Dataset) -> Figure:
    """Figure A1: the two Euler methods entering the load zone, spin and growth of the error."""
    limit, step = stability.attrs["limit_angle_deg"], stability.attrs["step_s"]
    figure, axes = new_figure(7.2, 3.6, 1, 2, sharex=True)
    plot_stability(axes[0], stability).set_xlim(limit - 6.0, limit + 6.0)
    plot_deviation(axes[1], stability)
    note = f"step ({1e3 * step:g} ms) above\n2 × relaxation time"
    axes[1].annotate(
        note,
        (limit, 0.02),
        xycoords=axes[1].get_xaxis_transform(),
        xytext=(4, 0),
        textcoords="offset points",
        ha="left",
        va="bottom",
        fontsize=9,
        color=GREY,
    )
    legend_above(figure, axes[0])
    return figure


def nonlinear_tolerance_figure(experiment: xr.Dataset) -> Figure:
    """Energy against the stopping tolerance of backward Euler's iteration."""
    figure, axes = new_figure(5.2, 4.0)
    plot_nonlinear_tolerance(axes[0], experiment).legend(frameon=False, fontsize=9, loc="upper left")
    return figure


def step_size_figure(experiment: xr.Dataset) -> Figure:
    """P_max against the fixed step of backward Euler."""
    figure, axes = new_figure(4.8, 3.6)
    plot_step_size(axes[0], experiment).legend(frameon=False, fontsize=9, loc="center left")
    return figure


def _finish_columns(figure: Figure, axes: list, legend_title: str) -> Figure:
    for one in axes[1:]:
        one.set_ylabel("")
    legend_above(figure, axes[0], title=legend_title)
    return figure
