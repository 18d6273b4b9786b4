"""Energy and peak power over mean wind speed and turbulence (figures 4 and 5 of the paper).

All functions take the dataset of `macroslip.reproduction.paper_numbers.paper_numbers`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.report.style import CLASS_OFFSET, GREY, TURBULENCE, finish, log_ticks

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

_WIND_SPEED = "mean wind speed [m/s]"


def plot_energy(axes: Axes, numbers: xr.Dataset, row: str | None) -> Axes:
    """Figure 4a: energy over the reference case's, of one row with the range of its rollers, or of both (row None)."""
    for turbulence, part in _classes(numbers):
        x = part.wind_speed.values + CLASS_OFFSET[turbulence]
        if row is None:
            axes.plot(x, part.both_rows_normalised.values, markersize=5, label=turbulence, **TURBULENCE[turbulence])
            continue
        one = part.sel(row=row)
        middle = one.energy_normalised.values
        bars = np.array([middle - one.energy_min_normalised.values, one.energy_max_normalised.values - middle])
        _with_bars(axes, x, middle, bars, turbulence)
    return _finish(axes, numbers, "energy over that in 12C [–]", "both rows" if row is None else f"{row} row")


def plot_energy_ratio(axes: Axes, numbers: xr.Dataset) -> Axes:
    """Figure 4b: energy of the downwind row over that of the upwind row."""
    for turbulence, part in _classes(numbers):
        x = part.wind_speed.values + CLASS_OFFSET[turbulence]
        axes.plot(x, part.energy_ratio.values, markersize=5, label=turbulence, **TURBULENCE[turbulence])
    return _finish(axes, numbers, "energy, downwind / upwind [–]")


def plot_peak_power(axes: Axes, numbers: xr.Dataset, row: str) -> Axes:
    """Figure 5a: mean ± standard deviation of P_max per orbit over the mean in the reference case, of one row.

    The axis begins at zero, which power cannot be below; bars that reach further down are cut there.
    """
    for turbulence, part in _classes(numbers):
        x = part.wind_speed.values + CLASS_OFFSET[turbulence]
        one = part.sel(row=row)
        _with_bars(axes, x, one.peak_power_mean_normalised.values, one.peak_power_std_normalised.values, turbulence)
    axes.set_ylim(bottom=0.0)
    return _finish(axes, numbers, r"$P_\mathrm{max}$ over its mean in 14A [–]", f"{row} row")


def plot_peak_power_ratio(axes: Axes, numbers: xr.Dataset) -> Axes:
    """Figure 5b: mean P_max of the downwind row over that of the upwind row, with a line where they are alike."""
    axes.axhline(1.0, color=GREY, linewidth=0.8)
    for turbulence, part in _classes(numbers):
        x = part.wind_speed.values + CLASS_OFFSET[turbulence]
        axes.plot(x, part.peak_power_ratio.values, markersize=5, label=turbulence, **TURBULENCE[turbulence])
    return _finish(log_ticks(axes), numbers, r"mean $P_\mathrm{max}$, downwind / upwind [–]")


def _classes(numbers: xr.Dataset) -> list[tuple[str, xr.Dataset]]:
    found = sorted(set(numbers.turbulence.values.tolist()))
    parts = [(turbulence, numbers.isel(case=numbers.turbulence.values == turbulence)) for turbulence in found]
    return [(turbulence, part.sortby("wind_speed")) for turbulence, part in parts]


def _with_bars(axes: Axes, x: np.ndarray, middle: np.ndarray, bars: np.ndarray, turbulence: str) -> None:
    axes.errorbar(
        x, middle, yerr=bars, markersize=5, capsize=2.5, elinewidth=1.0, label=turbulence, **TURBULENCE[turbulence]
    )


def _finish(axes: Axes, numbers: xr.Dataset, y_label: str, title: str = "") -> Axes:
    axes.set_xticks(np.unique(numbers.wind_speed.values))
    return finish(axes, _WIND_SPEED, y_label, title)
