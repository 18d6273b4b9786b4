"""Dissipation inside the contacts, and the paper's figures 4 and 5 under every model."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from macroslip.report.style import BLACK, BLUE, GREEN, GREY, ORANGE, ROW, finish, legend_above, log_ticks, new_figure

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Colour and hatching of the parts of `macroslip.reproduction.dissipation.PARTS`: colour for mechanisms, hatching for outer.
_PART = {
    "inner, curvature": (BLUE, ""),
    "outer, curvature": (BLUE, "///"),
    "inner, contact angle": (ORANGE, ""),
    "outer, contact angle": (ORANGE, "///"),
    "raceways, sliding": (GREY, "..."),
    "cage": (GREEN, "xx"),
}
_MODEL_LINES = ("--", "-", ":", "-.")


def plot_parts(axes: Axes, parts: xr.DataArray, row: str) -> Axes:
    """Energy per orbit of a mean roller by interface and mechanism, stacked, over mean wind speed.

    Takes `part_energy` [J] of `macroslip.reproduction.dissipation.dissipation`, over (case, row, part) with the coordinate
    wind_speed; cases of one wind speed are averaged. A part below zero is drawn below the axis.
    """
    mean = parts.sel(row=row).groupby("wind_speed").mean(skipna=False)
    speeds = mean.wind_speed.values
    above, below = np.zeros(speeds.size), np.zeros(speeds.size)
    for name, (color, hatch) in _PART.items():
        values = mean.sel(part=name).values
        bottom = np.where(values >= 0.0, above, below)
        axes.bar(speeds, values, 1.3, bottom=bottom, color=color, hatch=hatch, edgecolor="white", label=name)
        above = above + np.maximum(np.nan_to_num(values), 0.0)
        below = below + np.minimum(np.nan_to_num(values), 0.0)
    axes.set_xticks(speeds)
    return finish(axes, "mean wind speed [m/s]", "energy per orbit of a roller [J]", f"{row} row")


def plot_stations(axes: Axes, along: xr.DataArray, row: str, cases: tuple[str, ...]) -> Axes:
    """Energy per orbit and length along the roller, by raceway, of some cases.

    Takes `station_energy` [J/m] of `macroslip.reproduction.dissipation.dissipation`, over (case, row, raceway, station).
    """
    colors = (BLUE, ORANGE, GREEN, BLACK)
    for case, color in zip(cases, colors, strict=False):
        for raceway, line in (("inner", "-"), ("outer", "--")):
            one = along.sel(case=case, row=row, raceway=raceway)
            axes.plot(1e3 * one.station.values, one.values, color=color, linestyle=line, label=f"{case}, {raceway}")
    axes.set_ylim(bottom=0.0)
    return finish(axes, "place along the roller [mm]", "energy per orbit and length [J/m]", f"{row} row")


def plot_models(
    axes: Axes, numbers: Mapping[str, xr.Dataset], quantity: str, label: str, row: str | None = None
) -> Axes:
    """One quantity of figure 4 or 5 under every model over mean wind speed, mean and range of the turbulence classes.

    Parameters
    ----------
    axes : Axes
    numbers : mapping
        From `macroslip.reproduction.paper_numbers.paper_numbers`, by model.
    quantity : str
        A variable of them, over (case) or (case, row).
    label : str
        Of the vertical axis, with its unit.
    row : str, optional
        The row; both, each with its own colour, if the quantity has rows and none is named.
    """
    for (model, one), line in zip(numbers.items(), _MODEL_LINES, strict=False):
        values = one[quantity]
        rows = [None] if "row" not in values.dims else [row] if row else values.row.values.tolist()
        for which in rows:
            part = values if which is None else values.sel(row=which)
            by_speed = part.groupby("wind_speed")
            mean, low, high = (getattr(by_speed, name)(skipna=False) for name in ("mean", "min", "max"))
            style = (
                {"color": BLACK, "marker": "o"}
                if which is None
                else {key: ROW[which][key] for key in ("color", "marker")}
            )
            name = model if len(rows) == 1 else f"{model}, {which}"
            speeds = mean.wind_speed.values
            axes.plot(speeds, mean.values, linestyle=line, markersize=4, label=name, **style)
            axes.fill_between(speeds, low.values, high.values, alpha=0.15, linewidth=0.0, color=style["color"])
    axes.set_xticks(mean.wind_speed.values)
    return finish(axes, "mean wind speed [m/s]", label)


def mechanisms_figure(parts: xr.Dataset) -> Figure:
    """Energy of both rows by interface and mechanism, and along the roller. Takes what `dissipation` gives."""
    figure, axes = new_figure(8.6, 3.9, 1, 3)
    for one, row in zip(axes, ("downwind", "upwind"), strict=False):
        plot_parts(one, parts.part_energy, row)
    plot_stations(axes[2], parts.station_energy, "downwind", shown_cases(parts))
    axes[2].legend(frameon=False, fontsize=7, loc="upper right")
    legend_above(figure, axes[0], ncols=3)
    return figure


def models_figure(numbers: Mapping[str, xr.Dataset]) -> Figure:
    """Figures 4 and 5 of every model on the same axes."""
    figure, axes = new_figure(8.6, 6.2, 2, 2, sharex=True)
    plot_models(axes[0], numbers, "both_rows_normalised", "energy, both rows, over that in 12C [–]")
    plot_models(log_ticks(axes[1]), numbers, "energy_ratio", "energy, downwind / upwind [–]")
    plot_models(log_ticks(axes[2]), numbers, "peak_power_mean", r"mean $P_\mathrm{max}$ of an orbit [W]")
    plot_models(log_ticks(axes[3]), numbers, "peak_power_ratio", r"mean $P_\mathrm{max}$, downwind / upwind [–]")
    axes[0].legend(frameon=False, fontsize=8)
    # Bands fill the panel.
    legend_above(figure, axes[2])
    return figure


def shown_cases(parts: xr.Dataset) -> tuple[str, ...]:
    """A case of the lowest, the middle and the highest wind speed, of turbulence B where there is one."""
    speeds = np.unique(parts.wind_speed.values)
    chosen = dict.fromkeys(float(speeds[k]) for k in (0, speeds.size // 2, -1))
    found = []
    for speed in chosen:
        names = parts.case.values[parts.wind_speed.values == speed].tolist()
        found.append(next((name for name in names if name.endswith("B")), names[0]))
    return tuple(found)
