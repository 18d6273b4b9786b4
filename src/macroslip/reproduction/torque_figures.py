"""Friction torque of the whole bearing over time, computed and by handbooks."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from macroslip.report.style import BLACK, BLUE, GREEN, GREY, ORANGE, finish, legend_above, log_ticks, new_figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from macroslip.torque import TorqueHistory

_STYLES = ((BLUE, "-"), (ORANGE, "--"), (GREEN, "-."), (BLACK, ":"), (GREY, "-"))


def plot_torque(axes: Axes, histories: Mapping[str, TorqueHistory], start: float, end: float) -> Axes:
    """Torques [N m] by name between two times [s], on a logarithmic axis."""
    for (name, one), (color, line) in zip(histories.items(), _STYLES, strict=False):
        inside = (one.time >= start) & (one.time <= end)
        axes.plot(one.time[inside], one.torque[inside], color=color, linestyle=line, linewidth=1.3, label=name)
    return finish(log_ticks(axes), "time [s]", "friction torque [N m]")


def torque_figure(histories: Mapping[str, TorqueHistory], start: float, end: float) -> Figure:
    """A part of the history above each other, the legend with the means over all of it."""
    figure, axes = new_figure(7.2, 4.2)
    named = {f"{name} (mean {np.nanmean(one.torque):.3g} N m)": one for name, one in histories.items()}
    plot_torque(axes[0], named, start, end)
    legend_above(figure, axes[0], ncols=2)
    return figure
