"""Figures of the heat of a main bearing: residuals of every model, index and its cumulative sum."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

from macroslip.constants import RPM, ZERO_CELSIUS
from macroslip.report.style import BLACK, BLUE, GREEN, GREY, ORANGE, SMALL, finish
from macroslip.scada.heat import BearingHeat
from macroslip.scada.heat_balance import HeatFit
from macroslip.scada.heat_index import FLAGGED
from macroslip.scada.heat_models import FRICTION, PALMGREN, RISE, SKF, SPEED

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Line of each model.
MODEL: Mapping[str, Mapping[str, Any]] = MappingProxyType(
    {
        FRICTION: {"color": BLUE, "linestyle": "-", "marker": "o"},
        SKF: {"color": ORANGE, "linestyle": "--", "marker": "s"},
        PALMGREN: {"color": ORANGE, "linestyle": ":", "marker": "v"},
        SPEED: {"color": GREEN, "linestyle": "-.", "marker": "^"},
        RISE: {"color": GREY, "linestyle": ":", "marker": "d"},
    }
)
#: Windows that a mean of a figure needs.
_LEAST = 10
#: Range of an index that a figure shows.
_SHOWN_INDEX = (0.0, 2.5)
#: What a residual may go with: label, column of the windows, its factor, offset and width of a bin.
OVER: Mapping[str, tuple[str, str, float, float, float]] = MappingProxyType(
    {
        "speed": ("speed of the rotor [rpm]", "rotor_speed", 1.0 / RPM, 0.0, 1.0),
        "temperature": (
            "temperature of the bearing [°C]", "bearing_temperature", 1.0, -ZERO_CELSIUS, 2.5,
        ),
        "wind": ("wind speed [m/s]", "wind_speed", 1.0, 0.0, 1.0),
    }
)  # fmt: skip


def plot_root_mean_squares(axes: Axes, heat: BearingHeat) -> Axes:
    """Root mean square of the residuals of the reference, a bar a model, the least at the top."""
    fits = sorted(heat.fits, key=lambda fit: -fit.residual)
    colours = [BLUE if fit.model.supply else ORANGE for fit in fits]
    residuals = [fit.residual for fit in fits]
    axes.barh(range(len(fits)), residuals, height=0.4, color=colours)
    for line, fit in enumerate(fits):
        axes.annotate(
            fit.model.title,
            (0.0, line + 0.25),
            xytext=(3, 0),
            textcoords="offset points",
            va="bottom",
            fontsize=SMALL,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5},
        )
    axes.axvline(fits[-1].residual, color=BLACK, linewidth=0.8)
    axes.set_ylim(-0.4, len(fits))
    axes.set_yticks([])
    return finish(axes, "root mean square of the residual [K/h]", "")


def plot_residuals(axes: Axes, heat: BearingHeat, over: str) -> Axes:
    """Mean residual of the reference over speed, temperature or wind, a line a model.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    heat : BearingHeat
    over : str
        A key of `OVER`.
    """
    label, column, factor, offset, width = OVER[over]
    chosen = heat.windows["reference"].to_numpy()
    if over != "temperature":
        chosen = chosen & heat.windows["turning"].to_numpy()
    of_windows = heat.windows[column].to_numpy()
    values = factor * of_windows[chosen] + offset
    bins = width * np.round(values / width)
    for fit in shown_fits(heat):
        groups = pd.Series(fit.residuals[chosen]).groupby(bins)
        is_filled = groups.size() >= _LEAST
        means = groups.mean().where(is_filled).dropna()
        name = fit.model.name
        axes.plot(means.index, means, label=name, markersize=4, **MODEL[name])
    axes.axhline(0.0, color=BLACK, linewidth=0.8)
    return finish(axes, label, "mean residual [K/h]")


def shown_fits(heat: BearingHeat) -> Sequence[HeatFit]:
    """The chosen fit and its rivals."""
    rivals = [fit for fit in heat.fits if fit.model.name in (SKF, PALMGREN, SPEED)]
    return [heat.chosen, *rivals]


def plot_index(axes: Axes, heat: BearingHeat, column: str = "r") -> Axes:
    """Weekly index of heat over time, a line a model.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    heat : BearingHeat
    column : str
        `r`, or `r_sibling`.
    """
    _plot_index_column(axes, heat, "week", column, markersize=3)
    axes.axhline(1.0, color=BLACK, linewidth=0.8)
    # A model that expects hardly any heat in some week would flatten all others.
    shown = np.clip(axes.get_ylim(), *_SHOWN_INDEX)
    axes.set_ylim(*shown)
    _dates(axes)
    label = "heat over expected heat [-]" if column == "r" else "index over the sibling's [-]"
    return finish(axes, "", label)


def plot_cusum(axes: Axes, heat: BearingHeat, column: str = "cusum") -> Axes:
    """Cumulative sum of the daily index above 1.10, a line a model; as `plot_index`."""
    days = _plot_index_column(axes, heat, "day", column, marker="")
    axes.axhline(FLAGGED, color=BLACK, linewidth=0.8)
    largest = float(days[column].max())
    highest = min(largest, 6.0 * FLAGGED)
    axes.set_ylim(0.0, max(1.5 * FLAGGED, highest))
    _dates(axes)
    return finish(axes, "", "cumulative sum [-]")


def _plot_index_column(
    axes: Axes, heat: BearingHeat, period: str, column: str, **style: Any
) -> pd.DataFrame:
    """Plot a column of the index over time, a line a model; returns the rows of the period."""
    rows = heat.index_by(period)
    for model, of_model in rows.groupby("model", sort=False):
        of_line = {**MODEL[str(model)], **style}
        axes.plot(of_model["start"], of_model[column], label=str(model), **of_line)
    return rows


def _dates(axes: Axes) -> None:
    from matplotlib.dates import AutoDateLocator, ConciseDateFormatter

    locator = AutoDateLocator(maxticks=7)
    axes.xaxis.set_major_locator(locator)
    axes.xaxis.set_major_formatter(ConciseDateFormatter(locator))
