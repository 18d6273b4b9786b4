"""Figures of several results: energy by wind speed, how often an orbit exceeds an energy or a power, values by result.

Every function draws on the axes that it takes, and returns them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from macroslip.report.style import ROW, finish

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

#: Curves of `macroslip.study.exceedance.exceedance`, and the quantity that is exceeded.
EXCEEDED: Mapping[str, str] = MappingProxyType(
    {"energy_orbits": "energy of an orbit [J]", "power_orbits": "peak power of an orbit [W]"}
)
_MOST_GROUPS = 4
#: Letters of a result's name that fit under a figure.
_NAME_LENGTH = 16


def plot_lifetime(axes: Axes, life: xr.Dataset, group: int) -> Axes:
    """Energy of a roller over the lifetime by wind speed.

    Takes the dataset of `macroslip.study.lifetime.lifetime_energy` and one of its groups.
    """
    for row in life.row.values.tolist():
        one = life.bin_energy.isel(group=group).sel(row=row)
        axes.plot(one.bin.values, 1e-6 * one.values, label=row, **{key: ROW[row][key] for key in ("color", "marker")})
    axes.set_ylim(bottom=0.0)
    return finish(axes, "wind speed [m/s]", "energy in the lifetime [MJ]", "\n".join(group_labels(life, group)))


def plot_exceedance(axes: Axes, curves: xr.Dataset, name: str, group: int) -> Axes:
    """How many orbits a year of a roller exceed what `EXCEEDED` names.

    Takes the dataset of `macroslip.study.exceedance.exceedance` and one of its groups.
    """
    values = curves[name].isel(group=group)
    for row in curves.row.values.tolist():
        one = values.sel(row=row)
        one = one[one.values > 0.0]
        style = {key: ROW[row][key] for key in ("color", "linestyle")}
        axes.plot(one.threshold.values, one.values, label=row, **style)
    axes.set_yscale("log")
    drawn = curves.threshold.values[(values > 0.0).any("row").values]
    if drawn.size and drawn.max() > 50.0 * drawn.min():
        axes.set_xscale("log")
    return finish(axes, EXCEEDED[name], "orbits a year above it", "\n".join(group_labels(curves, group)))


def plot_by_result(axes: Axes, names: Sequence[str], rows: Sequence[str], values: np.ndarray, label: str) -> Axes:
    """A value of every result and row, over the results.

    Takes values over (result, row); one that is missing is left out.
    """
    places = np.arange(len(names))
    for k, row in enumerate(rows):
        style = {**ROW.get(row, {}), "linestyle": "none"}
        axes.plot(places + 0.16 * (k - 0.5), values[:, k], markersize=5, label=f"{row} row", **style)
    shown = [name if len(name) <= _NAME_LENGTH else f"{name[: _NAME_LENGTH - 1]}…" for name in names]
    upright = len(names) > 4 or sum(map(len, shown)) > 32
    axes.set_xticks(places, shown, rotation=90 if upright else 0)
    axes.set_xlim(-0.5, len(names) - 0.5)
    axes.set_ylim(0.0, 1.08 * max(float(np.nanmax(values, initial=0.0)), 1e-12))
    return finish(axes, "", label)


def plot_case_energies(axes: Axes, study: xr.Dataset) -> Axes:
    """Energy of each case of a study, mean over the rollers of both rows, with the range of the rollers.

    Takes a dataset with `energy` [J] over (case, row, roller, interface).
    """
    total = study.energy.sum("interface", skipna=False)
    places = np.arange(study.sizes["case"])
    for k, row in enumerate(study.row.values.tolist()):
        one = total.sel(row=row)
        mean = one.mean("roller", skipna=False).values
        bars = [mean - one.min("roller").values, one.max("roller").values - mean]
        style = {**ROW[row], "linestyle": "none", "elinewidth": 1.0, "capsize": 2.5, "markersize": 5}
        axes.errorbar(places + 0.16 * (k - 0.5), mean, yerr=bars, label=f"{row} row", **style)
    axes.set_xticks(places, [str(name) for name in study.case.values], rotation=90 if study.sizes["case"] > 8 else 0)
    axes.set_ylim(0.0, 1.08 * max(axes.get_ylim()[1], 1e-12))
    return finish(axes, "case", "energy of a roller [J]")


def groups(values: xr.DataArray) -> list[int]:
    """The first groups that have something to draw."""
    positive = (values > 0.0).any([name for name in values.dims if name != "group"])
    return np.flatnonzero(positive.values)[:_MOST_GROUPS].tolist()


def group_labels(dataset: xr.Dataset, group: int) -> list[str]:
    """Values that distinguish a group from the others; none if there is one group."""
    if dataset.sizes["group"] < 2:
        return []
    found = []
    for name, one in dataset.coords.items():
        value = str(one.values[group]) if one.dims == ("group",) and np.unique(one.values).size > 1 else ""
        # A parameter that only other models set has no value.
        if value not in ("", "nan"):
            # The names of parameters have a dot; bearings, lubricants and models need no name.
            found.append(f"{str(name).rpartition('.')[2]} {_short(value)}" if "." in str(name) else value)
    return found


def _short(value: str) -> str:
    """A number with three digits; other text as it is."""
    try:
        return f"{float(value):.3g}"
    except ValueError:
        return value
