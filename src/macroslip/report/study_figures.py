"""A study over a lifetime: energy by wind speed, and how often an orbit exceeds an energy or a power."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from macroslip.report.style import ROW, finish

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

#: Curves of `macroslip.study.exceedance.exceedance`, and what is exceeded.
EXCEEDED: Mapping[str, str] = MappingProxyType(
    {"energy_orbits": "energy of an orbit [J]", "power_orbits": "peak power of an orbit [W]"}
)
_MOST_GROUPS = 4


def plot_lifetime(axes: Axes, life: xr.Dataset, group: int) -> Axes:
    """What each wind speed adds to the energy of a roller over the lifetime.

    Takes the dataset of `macroslip.study.lifetime.lifetime_energy` and one of its groups.
    """
    for row in life.row.values.tolist():
        one = life.bin_energy.isel(group=group).sel(row=row)
        axes.plot(one.bin.values, 1e-6 * one.values, label=row, **{key: ROW[row][key] for key in ("color", "marker")})
    axes.set_ylim(bottom=0.0)
    return finish(axes, "wind speed [m/s]", "energy in the lifetime [MJ]", _group_title(life, group))


def plot_exceedance(axes: Axes, curves: xr.Dataset, name: str, group: int) -> Axes:
    """How many orbits a year of a roller exceed what `EXCEEDED` names.

    Takes the dataset of `macroslip.study.exceedance.exceedance` and one of its groups.
    """
    for row in curves.row.values.tolist():
        one = curves[name].isel(group=group).sel(row=row)
        some = one.values > 0.0
        axes.plot(one.threshold.values[some], one.values[some], label=row, color=ROW[row]["color"])
    axes.set_yscale("log")
    drawn = curves.threshold.values[(curves[name].isel(group=group) > 0.0).any("row").values]
    if drawn.size and drawn.max() > 50.0 * drawn.min():
        axes.set_xscale("log")
    return finish(axes, EXCEEDED[name], "orbits a year above it", _group_title(curves, group))


def groups(values: xr.DataArray) -> list[int]:
    """The first groups that have something to draw."""
    positive = (values > 0.0).any([name for name in values.dims if name != "group"])
    return np.flatnonzero(positive.values)[:_MOST_GROUPS].tolist()


def group_labels(dataset: xr.Dataset, group: int) -> list[str]:
    """What distinguishes a group from the others; nothing if there is one."""
    if dataset.sizes["group"] < 2:
        return []
    found = []
    for name, one in dataset.coords.items():
        value = str(one.values[group]) if one.dims == ("group",) and np.unique(one.values).size > 1 else ""
        # A parameter that only other models set has no value.
        if value not in ("", "nan"):
            # The names of parameters have a dot; those of bearings, lubricants and models need no name.
            found.append(f"{str(name).rpartition('.')[2]} {_short(value)}" if "." in str(name) else value)
    return found


def _short(value: str) -> str:
    """A number with three digits; other text as it is."""
    try:
        return f"{float(value):.3g}"
    except ValueError:
        return value


def _group_title(dataset: xr.Dataset, group: int) -> str:
    return "\n".join(group_labels(dataset, group))
