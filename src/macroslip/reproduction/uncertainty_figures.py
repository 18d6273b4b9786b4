"""Spread of results over the ranges of estimated values, and the values that drive it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.report.style import BLACK, BLUE, ORANGE, finish, log_ticks, new_figure
from macroslip.report.wording import three_digits
from macroslip.reproduction.uncertainty_summary import DRIVER_LEVEL, TOLD_INDEX

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def plot_ranges(axes: Axes, summary: xr.Dataset) -> Axes:
    """Range of 5 to 95 % and median of every quantity over its value with the base values, on a logarithmic axis.

    Takes what `macroslip.reproduction.uncertainty_summary.uncertainty_summary` gives. Beside the names are the median and
    the ends of the range in the quantity's own unit.
    """
    places = np.arange(summary.sizes["quantity"])[::-1]
    for place, k in zip(places, range(places.size), strict=True):
        one = summary.isel(quantity=k)
        low, middle, high = one.range.values / float(one.base)
        if np.isfinite([low, middle, high]).all():
            axes.plot([low, high], [place, place], color=BLUE, linewidth=3.0, solid_capstyle="butt", zorder=1)
            axes.plot(middle, place, color=BLACK, marker="|", markersize=11, markeredgewidth=2.0, zorder=2)
    names = []
    for k in range(places.size):
        one = summary.isel(quantity=k)
        low, middle, high = (three_digits(value) for value in one.range.values)
        unit = "" if str(one.units.values) == "1" else f" {one.units.values}"
        names.append(f"{one.quantity.values}\n{middle}{unit} ({low} to {high})")
    axes.set_yticks(places, names, fontsize=8)
    axes.axvline(1.0, color=BLACK, linewidth=0.8)
    return finish(log_ticks(axes, "x"), "over the value with the base values [–]", "")


def plot_correlations(axes: Axes, summary: xr.Dataset) -> Axes:
    """Rank correlation of every quantity with every value; a filled square where it is no chance.

    Takes what `macroslip.reproduction.uncertainty_summary.uncertainty_summary` gives. The area of a square is the size of the
    correlation; orange and marked + where the quantity rises with the value, blue and − where it falls.
    """
    rank, chance = summary.rank_correlation.values, summary.probability.values
    for q in range(rank.shape[0]):
        for p in range(rank.shape[1]):
            value, place = rank[q, p], rank.shape[0] - 1 - q
            if not np.isfinite(value):
                continue
            color, sure = (ORANGE if value > 0.0 else BLUE), chance[q, p] < DRIVER_LEVEL
            axes.scatter(
                p,
                place,
                s=330.0 * abs(value),
                marker="s",
                facecolor=color if sure else "none",
                edgecolor=color,
                linewidth=0.8,
            )
            if sure:
                sign = "+" if value > 0.0 else "−"
                axes.annotate(sign, (p, place), ha="center", va="center", color="white", fontsize=9)
    _grid(axes, summary, beyond=-0.4)
    return finish(axes, "varied value", "", "rank correlation")


def plot_indices(axes: Axes, summary: xr.Dataset) -> Axes:
    """Sobol' indices of every quantity's logarithm: the area of a square is the total index, filled up to the first order.

    Takes what `macroslip.reproduction.uncertainty_summary.uncertainty_summary` gives. On the right is the part of the
    variance that the polynomial behind the indices predicts.
    """
    first, total, known = summary.first_order.values, summary.total_order.values, summary.explained.values
    for q in range(total.shape[0]):
        place = total.shape[0] - 1 - q
        for p in range(total.shape[1]):
            if total[q, p] >= TOLD_INDEX:
                axes.scatter(
                    p, place, s=330.0 * total[q, p], marker="s", facecolor="none", edgecolor=BLUE, linewidth=0.8
                )
                axes.scatter(p, place, s=330.0 * max(first[q, p], 0.0), marker="s", facecolor=BLUE, linewidth=0.0)
        if np.isfinite(known[q]):
            axes.annotate(f"{known[q]:.2f}", (total.shape[1] - 0.2, place), va="center", fontsize=8)
    _grid(axes, summary, beyond=1.6)
    return finish(axes, "varied value", "", "Sobol' index, and part predicted")


def uncertainty_figure(summary: xr.Dataset) -> Figure:
    """Ranges of the results on the left, then what drives them: rank correlations and Sobol' indices."""
    figure, axes = new_figure(16.0, 7.2, 1, 3)
    plot_ranges(axes[0], summary)
    plot_correlations(axes[1], summary)
    plot_indices(axes[2], summary)
    axes[0].set_ylim(axes[1].get_ylim())
    return figure


def _grid(axes: Axes, summary: xr.Dataset, *, beyond: float) -> None:
    """Axes of one square for every quantity and varied value, as far as `beyond` squares past the last value."""
    values = summary.sizes["parameter"]
    names = [str(name) for name in summary.parameter.values]
    axes.set_xticks(np.arange(values), names, rotation=60, ha="right", rotation_mode="anchor")
    axes.set_yticks([])
    axes.set_xlim(-0.6, values + beyond)
    axes.set_ylim(-0.6, summary.sizes["quantity"] - 0.4)
