"""Spin and frictional energy of one roller over one turn (figure 3 of the paper).

All functions take a turn from `macroslip.reproduction.single_roller.trace_turn`; its loaded part is shaded.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from macroslip.report.style import BLACK, BLUE, ORANGE, ROW, finish
from macroslip.report.wording import energy_text, three_digits

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

_ANGLE = "angle from the bottom, top at 180 [°]"


def plot_spin(axes: Axes, turn: xr.Dataset, title: str = "") -> Axes:
    """Spin speed of the roller and that of pure rolling over the turn."""
    angle = turn.angle.values
    shade_loaded(axes, turn)
    dashed = {"color": BLACK, "linestyle": "--", "linewidth": 1.2, "zorder": 3}
    axes.plot(angle, turn.spin_speed_pure.values, label="pure rolling", **dashed)
    axes.plot(angle, turn.spin_speed.values, color=BLUE, linewidth=1.8, label="roller")
    top = 1.1 * float(turn.spin_speed_pure.max())
    axes.set_ylim(0.0, max(top, 1.1 * float(turn.spin_speed.max())))
    return _finish(axes, "spin speed |ω| [rad/s]", title)


def plot_cumulative_energy(axes: Axes, turn: xr.Dataset, title: str = "") -> Axes:
    """Frictional energy since the start of the turn, over that of the whole turn."""
    shade_loaded(axes, turn)
    axes.plot(turn.angle.values, turn.energy_fraction.values, color=ORANGE, linewidth=1.8)
    axes.set_ylim(0.0, 1.04)
    energy = f"whole turn: {energy_text(turn.attrs['energy_J'])}"
    axes.text(0.97, 0.05, energy, transform=axes.transAxes, ha="right", fontsize=9)
    return _finish(axes, "energy so far / whole turn [–]", title)


def plot_varying_over_static(axes: Axes, ratios: Mapping[str, Mapping[str, float]]) -> Axes:
    """Energy per orbit under time-varying over that under static load, on a logarithmic axis.

    Takes ratios [-] by the name of the static load and by row.
    """
    for place, (_name, rows) in enumerate(ratios.items()):
        for k, (row, ratio) in enumerate(rows.items()):
            x = place + 0.34 * (k - 0.5)
            style = {"color": ROW[row]["color"], "marker": ROW[row]["marker"], "linestyle": "none"}
            axes.plot([x], [ratio], markersize=7, label="" if place else f"{row} row", **style)
            axes.annotate(
                three_digits(ratio), (x, ratio), xytext=(0, 8), textcoords="offset points", ha="center", fontsize=9
            )
    axes.set_xticks(range(len(ratios)), [f"static: {name}" for name in ratios])
    axes.set_xlim(-0.5, len(ratios) - 0.5)
    axes.set_yscale("log")
    axes.yaxis.set_major_formatter("{x:g}")
    return finish(axes, "", "energy, time-varying / static [–]")


def shade_loaded(axes: Axes, turn: xr.Dataset) -> Axes:
    """Shade the angles at which the rings press on the roller."""
    loaded = turn.roller_load.values > 0.0
    axes.fill_between(
        turn.angle.values,
        0.0,
        1.0,
        where=loaded,
        transform=axes.get_xaxis_transform(),
        color="0.88",
        linewidth=0.0,
        label="loaded",
    )
    return axes


def _finish(axes: Axes, y_label: str, title: str) -> Axes:
    axes.set_xlim(0.0, 360.0)
    axes.set_xticks([0, 90, 180, 270, 360])
    return finish(axes, _ANGLE, y_label, title)
