"""A load history in pictures: on the main bearing, as a spectrum, and which rows it loads."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from macroslip.report.style import BLACK, BLUE, GREEN, ORANGE, finish, new_figure, program_style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from macroslip.loads import BearingLoads

#: Length of the pieces whose spectra are averaged [s].
_SPECTRUM_PIECE = 100.0


def plot_bearing_load(axes: Axes, loads: BearingLoads) -> Axes:
    """Radial load and thrust on the main bearing [kN] over time."""
    radial = loads.radial_load / 1e3
    axes.plot(loads.time, radial, color=BLUE, linewidth=0.8, label="radial load")
    thrust = loads.axial_load / 1e3
    axes.plot(loads.time, thrust, color=ORANGE, linewidth=0.8, label="thrust")
    axes.legend(frameon=False, fontsize=9, loc="upper right")
    return finish(axes, "time [s]", "load [kN]", "load on the main bearing")


def plot_shaft_speed(axes: Axes, loads: BearingLoads) -> Axes:
    """Shaft speed [rpm] over time."""
    rpm = loads.shaft_speed * 30.0 / math.pi
    axes.plot(loads.time, rpm, color=BLACK, linewidth=0.8)
    return finish(axes, "time [s]", "shaft speed [rpm]", "shaft speed")


def plot_direction(axes: Axes, loads: BearingLoads) -> Axes:
    """Radial load in the plane of the bearing [kN], looking downwind: X0 points to the left."""
    to_left, up, _ = loads.force.T / 1e3
    mean_to_left, mean_up, _ = loads.force.mean(axis=0) / 1e3
    axes.plot(to_left, up, color=BLUE, linewidth=0.4, alpha=0.6)
    axes.plot(mean_to_left, mean_up, color=ORANGE, marker="o", label="mean")
    axes.invert_xaxis()
    axes.axhline(0.0, color=BLACK, linewidth=0.5)
    axes.axvline(0.0, color=BLACK, linewidth=0.5)
    axes.set_aspect("equal", adjustable="datalim")
    axes.legend(frameon=False, fontsize=9)
    return finish(axes, "F_X0 [kN], to the left", "F_Y0 [kN], up", "radial load, looking downwind")


def plot_spectrum(axes: Axes, loads: BearingLoads) -> Axes:
    """Spectral density of radial load and thrust [kN²/Hz], with the shaft's 1P and 3P."""
    from scipy.signal import welch

    step = float(np.median(np.diff(loads.time)))
    samples = round(_SPECTRUM_PIECE / step)
    piece = min(loads.time.size, max(8, samples))
    for values, color, name in (
        (loads.radial_load, BLUE, "radial load"),
        (loads.axial_load, ORANGE, "thrust"),
    ):
        frequency, density = welch(values / 1e3, 1.0 / step, nperseg=piece)
        if np.any(density[1:] > 0.0):
            axes.plot(frequency[1:], density[1:], color=color, linewidth=0.9, label=name)
    mean_speed = abs(float(loads.shaft_speed.mean()))
    turns = mean_speed / (2.0 * math.pi)
    if turns > 0.0:
        for multiple in (1, 3):
            axes.axvline(
                multiple * turns, color=GREEN, linewidth=0.8, linestyle=":", label=f"{multiple}P"
            )
    if axes.lines:
        axes.set(xscale="log", yscale="log")
        axes.legend(frameon=False, fontsize=9)
    return finish(axes, "frequency [Hz]", "density [kN²/Hz]", "spectrum")


def plot_empty_row(axes: Axes, time: NDArray, carried: NDArray, share: float) -> Axes:
    """Load that the rollers of the upwind row carry together [kN] over time.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    time : ndarray
        Times [s].
    carried : ndarray
        Sum of the rollers' loads at these times [N].
    share : float
        Share of time in which the row is empty [1].
    """
    axes.fill_between(time, carried / 1e3, color=BLUE, alpha=0.5, linewidth=0.0)
    axes.set_ylim(bottom=0.0)
    return finish(
        axes,
        "time [s]",
        "sum of loads [kN]",
        f"upwind row: empty {100.0 * share:.3g} % of the time",
    )


@program_style()
def load_figure(loads: BearingLoads, time: NDArray, carried: NDArray) -> Figure:
    """All of it on one page; `carried` [N] is the load of the upwind row at times [s]."""
    figure, axes = new_figure(9.6, 9.6, 3, 2)
    plot_bearing_load(axes[0], loads)
    plot_shaft_speed(axes[1], loads)
    plot_direction(axes[2], loads)
    plot_spectrum(axes[3], loads)
    share_empty = float(np.mean(carried <= 0.0))
    plot_empty_row(axes[4], time, carried, share_empty)
    radial = loads.radial_load / 1e3
    exceeded = np.sort(radial)[::-1]
    percent = np.linspace(0.0, 100.0, exceeded.size)
    axes[5].plot(percent, exceeded, color=BLUE, linewidth=1.2)
    finish(axes[5], "share of time [%]", "radial load exceeded [kN]", "load duration")
    figure.suptitle(loads.source, fontsize=10, x=0.01, ha="left")
    return figure
