"""The figures: the paper's, and those beside them. Bands mark what the paper states; "about" reaches from half to twice."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from macroslip.report.style import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    ROW,
    finish,
    legend_above,
    log_ticks,
    new_figure,
)
from macroslip.torque import TorqueHistory
from paper.studies import PARTS
from paper.uncertainty import DRIVER_LEVEL, TOLD_INDEX
from paper.verdicts import number

#: Line and marker of each turbulence class, and its step along the wind-speed axis [m/s], so that bars do not hide each
#: other.
_TURBULENCE: Mapping[str, tuple[dict[str, Any], float]] = {
    "A": ({"color": ORANGE, "marker": "s", "linestyle": "-"}, -0.35),
    "B": ({"color": BLUE, "marker": "o", "linestyle": "--"}, 0.0),
    "C": ({"color": GREEN, "marker": "^", "linestyle": ":"}, 0.35),
}
#: Colour and hatching of `PARTS`: colour for mechanisms, hatching for the outer raceway.
_PART = dict(
    zip(
        PARTS,
        ((BLUE, ""), (ORANGE, ""), (BLUE, "///"), (ORANGE, "///"), (GREY, "..."), (GREEN, "xx")),
        strict=True,
    )
)
_LINES = ("-", "--", "-.", ":", "-")
_WIND_SPEED, _ANGLE = "mean wind speed [m/s]", "angle from the bottom [°]"
_PEAK = r"$P_\mathrm{max}$"
_RAISED = 2.0  # ratio from which on a point is labelled with it
TORQUE_WINDOW = (300.0, 360.0)  # part of the detailed case whose friction torque is drawn [s]


def mark_level(axes: Axes, low: float, high: float, words: str) -> Axes:
    """Shade the values between which a statement puts something, extend the axis to them, and write its words there."""
    axes.axhspan(low, high, color=BLUE, alpha=0.10, linewidth=0.0, zorder=-1)
    bottom, top = axes.get_ylim()
    axes.set_ylim(min(bottom, 0.8 * low), max(top, 1.25 * high))
    alignment = {"transform": axes.get_yaxis_transform(), "ha": "right", "va": "center"}
    axes.text(0.98, (low * high) ** 0.5, words, fontsize=9, color=BLUE, **alignment)
    return axes


def mark_wind_speeds(axes: Axes, low: float, high: float, words: str) -> Axes:
    """Shade the wind speeds [m/s] at which a statement puts something, and write its words at the foot."""
    axes.axvspan(low - 0.8, high + 0.8, color=BLUE, alpha=0.10, linewidth=0.0, zorder=-1)
    axes.text(
        low - 0.6,
        0.02,
        words,
        transform=axes.get_xaxis_transform(),
        va="bottom",
        fontsize=9,
        color=BLUE,
    )
    return axes


def _note(
    axes: Axes, words: str, point: tuple[float, float], shift: tuple[float, float], **options: Any
) -> None:
    """Words beside a place, `shift` points away from it."""
    axes.annotate(
        words, point, xytext=shift, textcoords="offset points", **{"fontsize": 9} | options
    )


def plot_spin(axes: Axes, turn: xr.Dataset, title: str = "") -> Axes:
    """Spin speed of the roller and that of pure rolling over a `trace_turn`; its loaded part is shaded."""
    angle = turn.angle.values
    _shade_loaded(axes, turn)
    dashed = {"color": BLACK, "linestyle": "--", "linewidth": 1.2, "zorder": 3}
    axes.plot(angle, turn.spin_speed_pure.values, label="pure rolling", **dashed)
    axes.plot(angle, turn.spin_speed.values, color=BLUE, linewidth=1.8, label="roller")
    axes.set_ylim(0.0, 1.1 * float(max(turn.spin_speed_pure.max(), turn.spin_speed.max())))
    return finish(axes, "", "spin speed |ω| [rad/s]", title)


def plot_cumulative_energy(axes: Axes, turn: xr.Dataset) -> Axes:
    """Frictional energy since the start of the turn, over that of the whole turn."""
    _shade_loaded(axes, turn)
    axes.plot(turn.angle.values, turn.energy_fraction.values, color=ORANGE, linewidth=1.8)
    axes.set_ylim(0.0, 1.04)
    energy = f"whole turn: {number(turn.attrs['energy_J'])} J"
    axes.text(0.97, 0.05, energy, transform=axes.transAxes, ha="right", fontsize=9)
    return finish(axes, _ANGLE, "energy so far / whole turn [–]")


def _shade_loaded(axes: Axes, turn: xr.Dataset) -> None:
    band = {
        "transform": axes.get_xaxis_transform(),
        "color": "0.88",
        "linewidth": 0.0,
        "label": "loaded",
    }
    axes.fill_between(turn.angle.values, 0.0, 1.0, where=turn.roller_load.values > 0.0, **band)
    axes.set_xlim(0.0, 360.0)
    axes.set_xticks([0, 90, 180, 270, 360])


def turns_figure(turns: Mapping[str, xr.Dataset]) -> Figure:
    """Figure 3: spin above and cumulative energy below, a column for each turn under its title."""
    figure, axes = new_figure(7.2, 5.2, 2, len(turns), sharex=True, sharey="row")
    for column, (title, turn) in enumerate(turns.items()):
        for panel in (
            plot_spin(axes[column], turn, title),
            plot_cumulative_energy(axes[column + len(turns)], turn),
        ):
            if column:
                panel.set_ylabel("")
    legend_above(figure, axes[0])
    return figure


def plot_by_class(
    axes: Axes, numbers: xr.Dataset, name: str, label: str, row: str | None = None
) -> Axes:
    """A variable of `paper_numbers` over mean wind speed, a line for each turbulence class, of one row or of both."""
    for turbulence in sorted(set(numbers.turbulence.values.tolist())):
        part = numbers.isel(case=numbers.turbulence.values == turbulence).sortby("wind_speed")
        style, offset = _TURBULENCE[turbulence]
        of_row = part if row is None else part.sel(row=row)
        middle, bars = of_row[name].values, None
        if row and name == "energy_normalised":
            bars = np.abs(
                np.array([of_row.energy_min_normalised.values, of_row.energy_max_normalised.values])
                - middle
            )
        elif row:
            bars = of_row.peak_power_std_normalised.values
        options = {"markersize": 5, "label": turbulence, **style}
        axes.errorbar(
            part.wind_speed.values + offset,
            middle,
            yerr=bars,
            capsize=2.5,
            elinewidth=1.0,
            **options,
        )
    axes.set_xticks(np.unique(numbers.wind_speed.values))
    return finish(axes, _WIND_SPEED, label, f"{row} row" if row else "")


def energy_figure(numbers: xr.Dataset) -> Figure:
    """Figure 4a: normalised energy of the downwind row and the upwind row, bars over their rollers, and both."""
    figure, axes = new_figure(7.2, 3.5, 1, 3, sharey=True)
    for panel, row in zip(axes, ("downwind", "upwind", None), strict=True):
        name = "energy_normalised" if row else "both_rows_normalised"
        plot_by_class(
            panel, numbers, name, "" if panel is not axes[0] else "energy over that in 12C [–]", row
        )
        mark_wind_speeds(panel, 12.0, 14.0, "paper: highest" if row is None else "")
    finish(axes[2], _WIND_SPEED, "", "both rows")
    legend_above(figure, axes[0], title="turbulence class; bars: range over the rollers of the row")
    return figure


def peak_power_figure(numbers: xr.Dataset) -> Figure:
    """Figure 5a: normalised P_max per orbit, mean ± standard deviation, of both rows. The axis begins at zero."""
    figure, axes = new_figure(7.2, 3.4, 1, 2)
    for panel, row in zip(axes, ("downwind", "upwind"), strict=True):
        label = "" if panel is not axes[0] else f"{_PEAK} over its mean in 14A [–]"
        plot_by_class(panel, numbers, "peak_power_mean_normalised", label, row).set_ylim(bottom=0.0)
    legend_above(figure, axes[0], title="turbulence class; bars: ± standard deviation, cut at zero")
    return figure


def ratio_figure(numbers: xr.Dataset, name: str) -> Figure:
    """Figures 4b and 5b: energy or mean P_max of the downwind over the upwind row."""
    figure, axes = new_figure(4.8, 3.4)
    words = "energy" if name == "energy_ratio" else f"mean {_PEAK}"
    plot_by_class(log_ticks(axes[0]), numbers, name, f"{words}, downwind / upwind [–]")
    if name == "energy_ratio":
        mark_level(axes[0], 5.0, 20.0, "paper: about 10")
    else:
        axes[0].axhline(1.0, color=GREY, linewidth=0.8)
        mark_level(
            mark_wind_speeds(axes[0], 12.0, 12.0, ""),
            2.5,
            10.0,
            "paper: up to 5, highest at 12 m/s",
        )
    legend_above(figure, axes[0], title="turbulence class")
    return figure


def plot_models(axes: Axes, numbers: Mapping[str, xr.Dataset], quantity: str, label: str) -> Axes:
    """A variable of `paper_numbers` by model over mean wind speed: mean and range of the turbulence classes."""
    for (model, of_model), line in zip(numbers.items(), ("--", "-", ":", "-."), strict=False):
        values = of_model[quantity]
        for row in values.row.values.tolist() if "row" in values.dims else [None]:
            by_speed = (values.sel(row=row) if row else values).groupby("wind_speed")
            mean, low, high = (
                getattr(by_speed, name)(skipna=False) for name in ("mean", "min", "max")
            )
            style = ROW[row] if row else {"color": BLACK, "marker": "o"}
            name = f"{model}, {row}" if row else model
            axes.plot(
                mean.wind_speed.values,
                mean.values,
                markersize=4,
                label=name,
                **{**style, "linestyle": line},
            )
            band = {"alpha": 0.15, "linewidth": 0.0, "color": style["color"]}
            axes.fill_between(mean.wind_speed.values, low.values, high.values, **band)
            axes.set_xticks(mean.wind_speed.values)
    return finish(axes, _WIND_SPEED, label)


def models_figure(numbers: Mapping[str, xr.Dataset]) -> Figure:
    """Figures 4 and 5 of every model on the same axes."""
    figure, axes = new_figure(8.6, 6.2, 2, 2, sharex=True)
    plot_models(axes[0], numbers, "both_rows_normalised", "energy, both rows, over that in 12C [–]")
    plot_models(log_ticks(axes[1]), numbers, "energy_ratio", "energy, downwind / upwind [–]")
    plot_models(log_ticks(axes[2]), numbers, "peak_power_mean", f"mean {_PEAK} of an orbit [W]")
    plot_models(
        log_ticks(axes[3]), numbers, "peak_power_ratio", f"mean {_PEAK}, downwind / upwind [–]"
    )
    axes[0].legend(frameon=False, fontsize=8)
    # Bands fill the panel.
    legend_above(figure, axes[2])
    return figure


def stability_figure(stability: xr.Dataset) -> Figure:
    """Figure A1: the two Euler methods entering the load zone, spin and growth of the error.

    The cross marks where explicit Euler was stopped, because slip had left the range that friction allows.
    """
    limit, step = stability.attrs["limit_angle_deg"], stability.attrs["step_s"]
    figure, axes = new_figure(7.2, 3.6, 1, 2, sharex=True)
    angle, explicit = stability.angle.values, stability.spin_ratio_explicit.values
    squares = {
        "color": ORANGE,
        "linewidth": 0.9,
        "marker": "s",
        "markersize": 2.5,
        "label": "explicit Euler",
    }
    axes[0].plot(angle, explicit, **squares)
    axes[0].plot(
        angle,
        stability.spin_ratio_backward.values,
        color=BLUE,
        linewidth=2.4,
        label="backward Euler",
    )
    converged = {"color": BLACK, "linestyle": "--", "linewidth": 1.2, "label": "converged (Radau)"}
    axes[0].plot(angle, stability.spin_ratio_converged.values, **converged)
    axes[0].set_ylim(0.0, 2.2)
    computed = np.flatnonzero(np.isfinite(explicit))
    if 0 < computed.size < angle.size:
        last = angle[computed[-1]]
        axes[0].plot([last], [explicit[computed[-1]]], "x", color=BLACK, markersize=8)
        _note(axes[0], "stopped", (last, 0.62), (6, 0))
    finish(axes[0], _ANGLE, "spin / spin in pure rolling [–]")
    axes[1].plot(angle, stability.deviation_explicit.values, **squares)
    circles = {"color": BLUE, "linewidth": 1.2, "marker": "o", "markersize": 2.5}
    axes[1].plot(angle, stability.deviation_backward.values, **circles)
    axes[1].set_yscale("log")
    finish(axes[1], _ANGLE, "|spin − converged| / pure rolling [–]")
    for panel in axes:
        panel.axvline(limit, color=GREY, linewidth=0.9, linestyle="-.", zorder=0)
    if np.isfinite(limit):
        axes[0].set_xlim(limit - 6.0, limit + 6.0)
        words = f"step ({1e3 * step:g} ms) above\n2 × relaxation time"
        _note(
            axes[1],
            words,
            (limit, 0.02),
            (4, 0),
            xycoords=axes[1].get_xaxis_transform(),
            va="bottom",
            color=GREY,
        )
    legend_above(figure, axes[0])
    return figure


def plot_tolerance(axes: Axes, experiment: xr.Dataset, name: str, label: str) -> Axes:
    """`energy` or `cage_energy` of `nonlinear_tolerance` against the tolerance at which the iteration stops.

    Thin lines are converged; what is above twice that is labelled with its ratio.
    """
    tolerance = experiment.stopping_tolerance.values
    for row in experiment.row.values.tolist():
        of_row, style = experiment.sel(row=row), ROW[row]
        level = float(of_row[f"{name}_converged"])
        axes.plot(tolerance, of_row[name].values, markersize=5, label=f"{row} row", **style)
        axes.axhline(level, color=style["color"], linewidth=0.8, zorder=0)
        for x, y in zip(tolerance, of_row[name].values, strict=True):
            if y > _RAISED * level:
                words = f"{number(y / level)} ×"
                _note(axes, words, (x, y), (-7, 0), ha="right", va="center", color=style["color"])
    axes.set_xscale("log")
    return finish(axes, "relative change of spin at the stop [–]", label)


def nonlinear_tolerance_figure(experiment: xr.Dataset) -> Figure:
    """Energy, and energy at the cage, against the stopping tolerance of backward Euler's iteration."""
    figure, axes = new_figure(7.2, 4.0, 1, 2, sharey=True)
    axes[0].set_yscale("log")
    plot_tolerance(axes[0], experiment, "energy", "energy per orbit [J]")
    static = {
        "color": BLACK,
        "marker": "D",
        "markersize": 7,
        "markerfacecolor": "none",
        "linestyle": ":",
    }
    values = experiment.static_energy.sel(row="downwind").values
    axes[0].plot(
        experiment.stopping_tolerance.values, values, label="downwind, static load", **static
    )
    plot_tolerance(axes[1], experiment, "cage_energy", "cage energy per orbit [J]")
    legend_above(figure, axes[0])
    return figure


def step_size_figure(experiment: xr.Dataset) -> Figure:
    """Mean P_max per orbit against the fixed step of backward Euler; thin lines are converged."""
    figure, axes = new_figure(4.8, 3.6)
    for row in experiment.row.values.tolist():
        of_row, color = experiment.sel(row=row), ROW[row]["color"]
        level = float(of_row.mean_peak_power_converged)
        axes[0].axhline(level, color=color, linewidth=0.8, zorder=0)
        axes[0].plot(
            experiment.step.values,
            of_row.mean_peak_power.values,
            markersize=5,
            label=f"{row} row",
            **ROW[row],
        )
        across = axes[0].get_yaxis_transform()
        _note(axes[0], "converged", (0.6, level), (0, 3), xycoords=across, ha="center", color=color)
    axes[0].set_xscale("log")
    finish(log_ticks(axes[0]), "fixed step [s]", f"mean {_PEAK} per orbit [W]")
    axes[0].legend(frameon=False, fontsize=9, loc="center left")
    return figure


def plot_parts(axes: Axes, parts: xr.DataArray, row: str) -> Axes:
    """`part_energy` [J] of `dissipation`, stacked, over mean wind speed; a part below zero is drawn below the axis."""
    mean = parts.sel(row=row).groupby("wind_speed").mean(skipna=False)
    speeds = mean.wind_speed.values
    above, below = np.zeros(speeds.size), np.zeros(speeds.size)
    for name, (color, hatch) in _PART.items():
        values = mean.sel(part=name).values
        bottom = np.where(values >= 0.0, above, below)
        axes.bar(
            speeds,
            values,
            1.3,
            bottom=bottom,
            color=color,
            hatch=hatch,
            edgecolor="white",
            label=name,
        )
        above = above + np.maximum(np.nan_to_num(values), 0.0)
        below = below + np.minimum(np.nan_to_num(values), 0.0)
    axes.set_xticks(speeds)
    return finish(axes, _WIND_SPEED, "energy per orbit of a roller [J]", f"{row} row")


def shown_cases(parts: xr.Dataset) -> list[str]:
    """A case of the lowest, the middle and the highest wind speed, of turbulence B where there is one."""
    speeds = np.unique(parts.wind_speed.values)
    shown = []
    for speed in dict.fromkeys(speeds[k] for k in (0, speeds.size // 2, -1)):
        names = parts.case.values[parts.wind_speed.values == speed].tolist()
        shown.append(next((name for name in names if name.endswith("B")), names[0]))
    return shown


def plot_stations(axes: Axes, along: xr.DataArray, row: str, cases: list[str]) -> Axes:
    """`station_energy` [J/m] of `dissipation` along the roller, by raceway, of some cases."""
    for case, color in zip(cases, (BLUE, ORANGE, GREEN), strict=False):
        for raceway, line in (("inner", "-"), ("outer", "--")):
            of_raceway = along.sel(case=case, row=row, raceway=raceway)
            axes.plot(
                1e3 * of_raceway.station.values,
                of_raceway.values,
                color=color,
                linestyle=line,
                label=f"{case}, {raceway}",
            )
    axes.set_ylim(bottom=0.0)
    return finish(
        axes, "place along the roller [mm]", "energy per orbit and length [J/m]", f"{row} row"
    )


def mechanisms_figure(parts: xr.Dataset) -> Figure:
    """Energy of both rows by interface and mechanism, and along the roller."""
    figure, axes = new_figure(8.6, 3.9, 1, 3)
    for panel, row in zip(axes, ("downwind", "upwind"), strict=False):
        plot_parts(panel, parts.part_energy, row)
    plot_stations(axes[2], parts.station_energy, "downwind", shown_cases(parts))
    axes[2].legend(frameon=False, fontsize=7, loc="upper right")
    legend_above(figure, axes[0], ncols=3)
    return figure


def torque_figure(histories: Mapping[str, TorqueHistory], start: float, end: float) -> Figure:
    """Friction torques [N m] between two times [s], the legend with the means over all of the time."""
    figure, axes = new_figure(7.2, 4.2)
    for (name, history), color, line in zip(
        histories.items(), (BLUE, ORANGE, GREEN, BLACK, GREY), _LINES, strict=False
    ):
        inside = (history.time >= start) & (history.time <= end)
        label = f"{name} (mean {np.nanmean(history.torque):.3g} N m)"
        axes[0].plot(
            history.time[inside],
            history.torque[inside],
            color=color,
            linestyle=line,
            linewidth=1.3,
            label=label,
        )
    finish(log_ticks(axes[0]), "time [s]", "friction torque [N m]")
    legend_above(figure, axes[0], ncols=2)
    return figure


def plot_ranges(axes: Axes, summary: xr.Dataset) -> Axes:
    """Range of 5 to 95 % and median of every quantity over its value with the base values, of an `uncertainty_summary`."""
    names, heights = [], np.arange(summary.sizes["quantity"])[::-1]
    for k, height in enumerate(heights):
        of_quantity = summary.isel(quantity=k)
        low, middle, high = of_quantity.range.values
        ratios = of_quantity.range.values / float(of_quantity.base)
        if np.isfinite(ratios).all():
            axes.plot(
                ratios[[0, 2]],
                [height, height],
                color=BLUE,
                linewidth=3.0,
                solid_capstyle="butt",
                zorder=1,
            )
            axes.plot(
                ratios[1],
                height,
                color=BLACK,
                marker="|",
                markersize=11,
                markeredgewidth=2.0,
                zorder=2,
            )
        unit = "" if str(of_quantity.units.values) == "1" else f" {of_quantity.units.values}"
        names.append(
            f"{of_quantity.quantity.values}\n{number(middle)}{unit} ({number(low)} to {number(high)})"
        )
    axes.set_yticks(heights, names, fontsize=8)
    axes.axvline(1.0, color=BLACK, linewidth=0.8)
    return finish(log_ticks(axes, "x"), "over the value with the base values [–]", "")


def plot_squares(axes: Axes, summary: xr.Dataset, name: str) -> Axes:
    """`rank_correlation` or `total_order` of every quantity with every value: a square of that area.

    Correlations are orange where the quantity rises with the value and blue where it falls, and filled where they are no
    chance. Sobol' indices, of the quantity's logarithm, are filled up to the first order; on the right is the part of the
    variance that the polynomial behind them predicts.
    """
    values, rank = summary[name].values, name == "rank_correlation"
    for q, p in np.argwhere(np.abs(values) >= (0.0 if rank else TOLD_INDEX)):
        value, point = values[q, p], (p, values.shape[0] - 1 - q)
        color = ORANGE if rank and value > 0.0 else BLUE
        full = (
            value * (summary.probability.values[q, p] < DRIVER_LEVEL)
            if rank
            else summary.first_order.values[q, p]
        )
        edge = {"marker": "s", "edgecolor": color, "linewidth": 0.8}
        axes.scatter(*point, s=330.0 * abs(value), facecolor="none", **edge)
        axes.scatter(*point, s=330.0 * abs(full), facecolor=color, marker="s", linewidth=0.0)
        if rank and full:
            axes.annotate(
                "+" if value > 0.0 else "−",
                point,
                ha="center",
                va="center",
                color="white",
                fontsize=9,
            )
    if not rank:
        for q, known in enumerate(summary.explained.values):
            point = values.shape[1] - 0.2, values.shape[0] - 1 - q
            axes.annotate(
                f"{known:.2f}" if np.isfinite(known) else "–", point, va="center", fontsize=8
            )
    names = summary.parameter.values.tolist()
    axes.set_xticks(np.arange(len(names)), names, rotation=60, ha="right", rotation_mode="anchor")
    axes.set_yticks([])
    axes.set_xlim(-0.6, len(names) + (-0.4 if rank else 1.6))
    axes.set_ylim(-0.6, summary.sizes["quantity"] - 0.4)
    return finish(
        axes, "varied value", "", "rank correlation" if rank else "Sobol' index, and part predicted"
    )


def uncertainty_figure(summary: xr.Dataset) -> Figure:
    """Ranges of the results on the left, then what drives them: rank correlations and Sobol' indices."""
    figure, axes = new_figure(16.0, 7.2, 1, 3)
    plot_ranges(axes[0], summary)
    plot_squares(axes[1], summary, "rank_correlation")
    plot_squares(axes[2], summary, "total_order")
    axes[0].set_ylim(axes[1].get_ylim())
    return figure
