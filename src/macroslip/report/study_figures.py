"""Figures of several results: energy by wind speed, exceedance, effects, values by result.

Every function draws on the axes that it takes, and returns them.
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.report.style import BLUE, GREY, ORANGE, ROW, finish
from macroslip.study.year import design_names

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

#: Curves of `macroslip.study.exceedance.exceedance`, and the quantity that is exceeded.
EXCEEDED: Mapping[str, str] = MappingProxyType(
    {"energy_orbits": "energy of an orbit [J]", "power_orbits": "peak power of an orbit [W]"}
)
#: Designs whose curves fit into one figure.
MOST_CURVES = 6
#: Letters of a result's name that fit under a figure.
_NAME_LENGTH = 16
#: Letters in a line of a label beside a figure.
_LABEL_LENGTH = 20


def _curves(
    values: xr.DataArray, shown: Sequence[int]
) -> Iterator[tuple[xr.DataArray, dict[str, Any]]]:
    """The curve of each row and design with its style; several designs have a colour each.

    Names that are too long for a legend are numbers in the order of the designs.
    """
    names = design_names(values)
    if any(len(names[group]) > _NAME_LENGTH for group in shown):
        names = {group: f"design {k + 1}" for k, group in enumerate(shown)}
    for k, group in enumerate(shown):
        for row in values.row.values.tolist():
            style = dict(ROW[row])
            if len(shown) > 1:
                style |= {
                    "color": f"C{k}",
                    "label": names[group] if row == values.row.values[0] else None,
                }
            yield values.isel(group=group).sel(row=row), {"label": row, "markersize": 4, **style}


def _rows(values: xr.DataArray, shown: Sequence[int]) -> str:
    if len(shown) > 1 and values.sizes["row"] > 1:
        return "lines downwind, dashes upwind"
    return ""


def plot_lifetime(axes: Axes, life: xr.Dataset, shown: Sequence[int]) -> Axes:
    """Energy of a roller over the lifetime by wind speed, the designs overlaid.

    Takes the dataset of `macroslip.study.lifetime.lifetime_energy` and some of its groups.
    """
    life = life.isel(bin=np.isfinite(life.bin.values))
    for curve, style in _curves(life.bin_energy, shown):
        axes.plot(curve.bin.values, 1e-6 * curve.values, **style)
    axes.set_ylim(bottom=0.0)
    return finish(axes, "wind speed [m/s]", "lifetime energy [MJ]", _rows(life.bin_energy, shown))


def plot_exceedance(axes: Axes, curves: xr.Dataset, name: str, shown: Sequence[int]) -> Axes:
    """Orbits a year in which a roller exceeds a quantity of `EXCEEDED`, the designs overlaid.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    curves : xarray.Dataset
        From `macroslip.study.exceedance.exceedance`.
    name : str
        A curve of `EXCEEDED`.
    shown : sequence of int
        Groups of `curves` that are drawn.
    """
    for curve, style in _curves(curves[name], shown):
        curve = curve[curve.values > 0.0]
        axes.plot(curve.threshold.values, curve.values, **style | {"marker": ""})
    axes.set_yscale("log")
    drawn = curves.threshold.values[
        (curves[name].isel(group=list(shown)) > 0.0).any(["group", "row"]).values
    ]
    if drawn.size and drawn.max() > 50.0 * drawn.min():
        axes.set_xscale("log")
    return finish(axes, EXCEEDED[name], "orbits a year above", _rows(curves[name], shown))


def plot_effects(axes: Axes, effects: xr.Dataset, quantity: str) -> Axes:
    """Main effects of sampled parameters on a quantity with twice their standard error.

    Takes the dataset of `macroslip.study.effects.effects`.
    """
    of_quantity = effects.sel(quantity=quantity)
    of_quantity = of_quantity.isel(
        parameter=np.argsort(np.abs(np.nan_to_num(of_quantity.main_effect.values)))[-10:]
    )
    names = [
        str(name).replace(".", "\n").replace("_", " ") for name in of_quantity.parameter.values
    ]
    effect = 100.0 * of_quantity.main_effect.values
    error = 200.0 * of_quantity.main_effect_error.values
    axes.barh(
        names,
        effect,
        xerr=error,
        color=[BLUE if value < 0.0 else ORANGE for value in effect],
        capsize=3,
    )
    axes.axvline(0.0, color=GREY, linewidth=0.8)
    return finish(axes, "change from lower to upper half [%]", "", quantity.replace("_", " "))


def plot_by_result(
    axes: Axes, names: Sequence[str], rows: Sequence[str], values: np.ndarray, label: str
) -> Axes:
    """A value of every result and row, over the results.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    names, rows : sequence of str
        Names of the results and of their rows.
    values : ndarray
        Values over (result, row); NaN where one is missing, which is left out.
    label : str
        Quantity and [unit].
    """
    middles = np.arange(len(names))
    for k, row in enumerate(rows):
        style = {**ROW.get(row, {}), "linestyle": "none"}
        axes.plot(
            middles + 0.16 * (k - 0.5), values[:, k], markersize=5, label=f"{row} row", **style
        )
    shown = [
        name if len(name) <= _NAME_LENGTH else f"…{name[1 - _NAME_LENGTH :]}" for name in names
    ]
    upright = len(names) > 4 or sum(map(len, shown)) > 32
    axes.set_xticks(middles, shown, rotation=90 if upright else 0)
    axes.set_xlim(-0.5, len(names) - 0.5)
    highest = max(float(np.nanmax(values, initial=0.0)), 1e-12)
    axes.set_ylim(0.0, 1.08 * highest)
    return finish(axes, "", textwrap.fill(label, _LABEL_LENGTH))


def drawable(values: xr.DataArray, order: Sequence[int]) -> list[int]:
    """The first groups in this order that have something to draw."""
    other_dims = [name for name in values.dims if name != "group"]
    positive = (values > 0.0).any(other_dims).values
    return [group for group in order if positive[group]][:MOST_CURVES]
