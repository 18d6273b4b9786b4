"""Figures of a year at the winds and temperatures of a turbine.

Every function draws on the axes that it takes, and returns them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.report.style import BLUE, GREY, LABEL, ORANGE, SMALL, finish

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes

WIND = "wind_speed [m/s]"
OIL = "oil_temperature [degC]"


def plot_over_wind_and_temperature(axes: Axes, bins: pd.DataFrame, column: str, title: str) -> Axes:
    """Share of production's total that each bin of wind speed and temperature has [%].

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    bins : pandas.DataFrame
        Rows in which the rotor turns, of one design, of `macroslip.study.real_year.RealYear.bins`.
    column : str
        What is shared out: `share`, `energy [J]` or `wear [m]`.
    title : str
        Its name.
    """
    table = bins.pivot_table(index=OIL, columns=WIND, values=column, aggfunc="sum")
    winds = _grid(np.array(table.columns, dtype=float))
    oils = _grid(np.array(table.index, dtype=float))
    nearest = {"method": "nearest", "tolerance": 1e-6}
    table = table.reindex(oils, **nearest).reindex(winds, axis="columns", **nearest)
    values = 100.0 * table.to_numpy() / np.nansum(table.to_numpy())
    half_wind = 0.5 * _step(winds)
    half_oil = 0.5 * _step(oils)
    image = axes.imshow(
        values,
        origin="lower",
        aspect="auto",
        cmap="cividis",
        vmin=0.0,
        extent=(
            winds[0] - half_wind, winds[-1] + half_wind, oils[0] - half_oil, oils[-1] + half_oil,
        ),
        interpolation="nearest",
    )  # fmt: skip
    scale = axes.figure.colorbar(image, ax=axes, pad=0.02)
    scale.set_label("% of production's", fontsize=LABEL)
    scale.ax.tick_params(labelsize=SMALL)
    return finish(axes, "wind speed [m/s]", "oil [°C]", title)


def _step(values: np.ndarray) -> float:
    """Smallest distance of ascending values; 1 where there is one only."""
    return float(np.diff(values).min()) if values.size > 1 else 1.0


def _grid(values: np.ndarray) -> np.ndarray:
    """Even values from the first to the last, at the smallest distance."""
    step = _step(values)
    return values[0] + step * np.arange(round((values[-1] - values[0]) / step) + 1)


def plot_over_fixed(axes: Axes, table: pd.DataFrame) -> Axes:
    """Numbers of a year over those at 35 °C: real, at the mean temperature, oil 5 K off the sensor.

    Takes `macroslip.study.real_year.RealYear.table` of one design.
    """
    shown = table[(table["fixed"] > 0.0) & table["real"].notna()]
    places = np.arange(len(shown))
    fixed = shown["fixed"].to_numpy()
    real = shown["real"].to_numpy() / fixed
    ends = np.stack([shown["oil_cooler"].to_numpy(), shown["oil_warmer"].to_numpy()]) / fixed
    off = np.abs(np.stack([real - ends.min(axis=0), ends.max(axis=0) - real]))
    axes.errorbar(
        places, real, yerr=off, fmt="o", color=BLUE, capsize=4, label="real, oil 5 K off the sensor"
    )
    axes.plot(
        places + 0.15,
        shown["at_mean"].to_numpy() / fixed,
        linestyle="none",
        marker="s",
        color=ORANGE,
        label="at the mean temperature",
    )
    axes.axhline(1.0, color=GREY, linewidth=0.8)
    axes.set_yscale("log")
    names = [str(name).replace("_", "\n") for name in shown["quantity"]]
    axes.set_xticks(places, names)
    axes.set_xlim(-0.5, len(shown) - 0.5)
    from matplotlib.ticker import LogLocator, ScalarFormatter

    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.yaxis.set_major_formatter(ScalarFormatter())
    axes.yaxis.set_minor_formatter("")
    return finish(axes, "", "over a year at 35 °C")
