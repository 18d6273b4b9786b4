"""What changes when one value does: a tornado chart."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.report.style import BLUE, GREY, ORANGE, finish

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes


def plot_tornado(axes: Axes, table: xr.Dataset, quantity: str, row: str) -> Axes:
    """Energy or peak power of a row with each value low and high, over that of the case, the widest bar on top.

    Parameters
    ----------
    axes : Axes
    table : xarray.Dataset
        From `macroslip.reproduction.sensitivity.sensitivity`.
    quantity : str
        `energy` or `peak_power`.
    row : str

    Notes
    -----
    The axis is logarithmic, so that half and double reach equally far. The value that was set is written at the end of its
    bar; the low value's bar is hatched.
    """
    one = table.sel(row=row)
    ratio = (one[quantity] / one[quantity].sel(level="base")).transpose("variation", "level")
    reach = np.abs(np.log(ratio)).max("level").values
    order = np.argsort(np.nan_to_num(reach))
    for place, k in enumerate(order):
        entry = one.isel(variation=int(k))
        for level, color, hatch in (("low", ORANGE, "///"), ("high", BLUE, "")):
            value = float(ratio.isel(variation=int(k)).sel(level=level))
            if not np.isfinite(value) or float(entry.value.sel(level=level)) == float(entry.value.sel(level="base")):
                continue
            axes.barh(place, value - 1.0, left=1.0, height=0.62, color=color, hatch=hatch, edgecolor="white")
            side = 1 if value > 1.0 else -1
            axes.annotate(
                f"{float(entry.value.sel(level=level)):g}",
                (value, place),
                xytext=(4 * side, 0),
                textcoords="offset points",
                ha="left" if side > 0 else "right",
                va="center",
                fontsize=9,
            )
    names = [_labelled(str(table.variation[int(k)].values), str(table.unit[int(k)].values)) for k in order]
    axes.set_yticks(np.arange(len(names)), names)
    axes.axvline(1.0, color=GREY, linewidth=0.9)
    axes.set_xscale("log")
    low, high = float(min(ratio.min(), 0.9)), float(max(ratio.max(), 1.1))
    margin = (high / low) ** 0.18
    axes.set_xlim(low / margin, high * margin)
    _plain_ticks(axes, low / margin, high * margin)
    words = {"energy": "energy", "peak_power": r"mean $P_\mathrm{max}$"}[quantity]
    return finish(axes, f"{words} / that of the base case [–]", "", f"{row} row")


def _labelled(name: str, unit: str) -> str:
    return name if unit == "1" else f"{name} [{unit}]"


def _plain_ticks(axes: Axes, low: float, high: float) -> None:
    from matplotlib.ticker import FixedLocator, NullFormatter, NullLocator

    choices = [0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.2, 1.4, 1.7, 2.0]
    if high / low > 4.0:
        choices = [0.01, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0]
    axes.xaxis.set_major_locator(FixedLocator([value for value in choices if low <= value <= high]))
    axes.xaxis.set_major_formatter("{x:g}")
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_minor_formatter(NullFormatter())
