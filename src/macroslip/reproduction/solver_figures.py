"""What the numerical method does to the result (figure A1 of the paper, and the two experiments beside it)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.report.style import BLACK, BLUE, GREY, ORANGE, ROW, finish, log_ticks

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

#: Ratio to the static energy from which on a point is labelled with it.
RAISED = 2.0
_ANGLE = "angle from the bottom [°]"


def plot_stability(axes: Axes, stability: xr.Dataset) -> Axes:
    """Figure A1: spin over pure rolling by explicit and backward Euler and converged.

    Takes the dataset of `macroslip.reproduction.stability.compare_stability`. The cross marks where
    explicit Euler was stopped, because slip had left the range that friction allows.
    """
    angle = stability.angle.values
    explicit = {"color": ORANGE, "linewidth": 0.9, "marker": "s", "markersize": 2.5}
    axes.plot(angle, stability.spin_ratio_explicit.values, label="explicit Euler", **explicit)
    axes.plot(angle, stability.spin_ratio_backward.values, color=BLUE, linewidth=2.4, label="backward Euler")
    converged = stability.spin_ratio_converged.values
    axes.plot(angle, converged, color=BLACK, linestyle="--", linewidth=1.2, label="converged (Radau)")
    axes.set_ylim(0.0, 2.2)
    _mark_limit(axes, stability)
    computed = np.flatnonzero(np.isfinite(stability.spin_ratio_explicit.values))
    if 0 < computed.size < angle.size:
        last = angle[computed[-1]]
        axes.plot([last], stability.spin_ratio_explicit.values[computed[-1:]], "x", color=BLACK, markersize=8)
        axes.annotate("stopped", (last, 0.62), fontsize="small", color=BLACK, xytext=(6, 0), textcoords="offset points")
    return finish(axes, _ANGLE, "spin / spin in pure rolling [–]")


def plot_deviation(axes: Axes, stability: xr.Dataset) -> Axes:
    """Figure A1, growth of the error: distance of both Euler methods from the converged spin, over pure rolling."""
    angle = stability.angle.values
    style = {"explicit": (ORANGE, "s", 0.9), "backward": (BLUE, "o", 1.2)}
    for name, (color, marker, width) in style.items():
        values = stability[f"deviation_{name}"].values
        options = {"color": color, "marker": marker, "markersize": 2.5, "linewidth": width}
        axes.plot(angle, values, label=f"{name} Euler", **options)
    axes.set_yscale("log")
    _mark_limit(axes, stability)
    return finish(axes, _ANGLE, "|spin − converged| / pure rolling [–]")


def plot_nonlinear_tolerance(axes: Axes, experiment: xr.Dataset) -> Axes:
    """Energy per orbit against the tolerance at which backward Euler's iteration stops, with the converged level.

    Takes the dataset of `macroslip.reproduction.solver_experiments.nonlinear_tolerance`.
    """
    tolerance = experiment.stopping_tolerance.values
    for row in experiment.row.values:
        one = experiment.sel(row=row)
        axes.plot(tolerance, one.energy.values, markersize=5, label=f"{row}, time-varying load", **ROW[row])
    downwind = experiment.sel(row="downwind")
    for x, y, ratio in zip(tolerance, downwind.energy.values, downwind.ratio.values, strict=True):
        if ratio > RAISED:
            axes.annotate(
                f"{float(f'{ratio:.3g}'):,g} × static",
                (x, y),
                xytext=(-7, 0),
                textcoords="offset points",
                ha="right",
                va="center",
                fontsize=9,
                color=BLUE,
            )
    static = experiment.static_energy.sel(row="downwind").values
    open_marker = {"marker": "D", "markersize": 7, "markerfacecolor": "none", "linestyle": ":"}
    axes.plot(tolerance, static, color=BLACK, label="downwind, static load", **open_marker)
    level = float(experiment.energy_converged.sel(row="downwind"))
    axes.axhline(level, color=GREY, linewidth=0.8, zorder=0, label="converged (downwind, time-varying)")
    axes.set_xscale("log")
    axes.set_yscale("log")
    return finish(axes, "relative change of spin at which the iteration stops [–]", "energy per orbit [J]")


def plot_cage_energy(axes: Axes, experiment: xr.Dataset) -> Axes:
    """Cage energy per orbit against the tolerance at which backward Euler's iteration stops, with the converged levels.

    Takes the dataset of `macroslip.reproduction.solver_experiments.nonlinear_tolerance`.
    """
    tolerance = experiment.stopping_tolerance.values
    for row in experiment.row.values:
        one = experiment.sel(row=row)
        axes.plot(tolerance, one.cage_energy.values, markersize=5, label=f"{row} row", **ROW[row])
        level = float(one.cage_energy_converged)
        axes.axhline(level, color=ROW[row]["color"], linewidth=0.8, zorder=0)
        for x, y in zip(tolerance, one.cage_energy.values, strict=True):
            if y > RAISED * level:
                axes.annotate(
                    f"{float(f'{y / level:.3g}'):,g} × converged",
                    (x, y),
                    xytext=(-7, 0),
                    textcoords="offset points",
                    ha="right",
                    va="center",
                    fontsize=9,
                    color=ROW[row]["color"],
                )
    axes.set_xscale("log")
    axes.set_yscale("log")
    return finish(axes, "relative change of spin at the stop [–]", "cage energy per orbit [J]")


def plot_step_size(axes: Axes, experiment: xr.Dataset) -> Axes:
    """Mean P_max per orbit against the fixed step of backward Euler, with the converged levels.

    Takes the dataset of `macroslip.reproduction.solver_experiments.step_size`.
    """
    for row in experiment.row.values:
        one = experiment.sel(row=row)
        color = ROW[row]["color"]
        axes.axhline(float(one.mean_peak_power_converged), color=color, linewidth=0.8, zorder=0)
        axes.plot(experiment.step.values, one.mean_peak_power.values, markersize=5, label=f"{row} row", **ROW[row])
        level = (0.6, float(one.mean_peak_power_converged))
        axes.annotate(
            "converged",
            level,
            xycoords=axes.get_yaxis_transform(),
            xytext=(0, 3),
            textcoords="offset points",
            ha="center",
            fontsize=9,
            color=color,
        )
    axes.set_xscale("log")
    return finish(log_ticks(axes), "fixed step [s]", r"mean $P_\mathrm{max}$ per orbit [W]")


def _mark_limit(axes: Axes, stability: xr.Dataset) -> None:
    axes.axvline(stability.attrs["limit_angle_deg"], color=GREY, linewidth=0.9, linestyle="-.", zorder=0)
