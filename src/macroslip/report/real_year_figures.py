"""Figures of a year at the winds and temperatures of a turbine.

Every function draws on the axes that it takes, and returns them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.report.style import BLUE, GREY, ORANGE, colour_scale, finish, log_ticks
from macroslip.result.criteria import SUMMED

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes

WIND = "wind_speed [m/s]"
OIL = "oil_temperature [degC]"
#: Quantities that a year sums up; extremes of single runs say little of a temperature.
_SUMS = ("energy", *(yearly.name for yearly in SUMMED))


def plot_over_wind_and_temperature(axes: Axes, bins: pd.DataFrame, column: str, title: str) -> Axes:
    """Share of production's total that each bin of wind speed and temperature has [%].

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    bins : pandas.DataFrame
        Rows in which the rotor turns, of one design, of `macroslip.study.real_year.RealYear.bins`.
    column : str
        What is shared out: `share`, `energy [J]`, or a sum of a criterion, such as `wear [m]`.
    title : str
        Its name.
    """
    table = bins.pivot_table(index=OIL, columns=WIND, values=column, aggfunc="sum")
    values = np.array(table, dtype=float)
    image = axes.pcolormesh(
        _edges(np.array(table.columns, dtype=float)),
        _edges(np.array(table.index, dtype=float)),
        100.0 * values / np.nansum(values),
        cmap="cividis",
        vmin=0.0,
        rasterized=True,
    )
    colour_scale(axes, image, "% of production")
    return finish(axes, "wind speed [m/s]", "oil [°C]", title)


def _edges(middles: np.ndarray) -> np.ndarray:
    """Edges half-way between ascending middles; the outer ones as far out as the next are in."""
    if middles.size == 1:
        return middles[0] + np.array([-0.5, 0.5])
    between = 0.5 * (middles[1:] + middles[:-1])
    first = 2.0 * middles[0] - between[0]
    last = 2.0 * middles[-1] - between[-1]
    return np.concatenate([[first], between, [last]])


def plot_over_fixed(axes: Axes, table: pd.DataFrame) -> Axes:
    """Sums of a year relative to a year at 35 °C: at measured and mean temperature, and 5 K either way.

    Takes `macroslip.study.real_year.RealYear.table` of one design.
    """
    is_known = (table["fixed"] > 0.0) & table["real"].notna()
    shown = table[table["quantity"].isin(_SUMS) & is_known]
    positions = np.arange(len(shown))
    fixed = shown["fixed"].to_numpy()
    real = shown["real"].to_numpy() / fixed
    cooler = shown["oil_cooler"].to_numpy() / fixed
    warmer = shown["oil_warmer"].to_numpy() / fixed
    lowest = np.minimum(cooler, warmer)
    highest = np.maximum(cooler, warmer)
    down = np.abs(real - lowest)
    up = np.abs(highest - real)
    axes.errorbar(
        positions,
        real,
        yerr=np.stack([down, up]),
        fmt="o",
        color=BLUE,
        capsize=4,
        label="measured temperatures, ± 5 K",
    )
    axes.plot(
        positions + 0.15,
        shown["at_mean"].to_numpy() / fixed,
        linestyle="none",
        marker="s",
        color=ORANGE,
        label="at the mean temperature",
    )
    axes.axhline(1.0, color=GREY, linewidth=0.8)
    names = [str(name).replace("_", "\n") for name in shown["quantity"]]
    axes.set_xticks(positions, names)
    axes.set_xlim(-0.5, len(shown) - 0.5)
    log_ticks(axes)
    return finish(axes, "", "over a year at 35 °C")
