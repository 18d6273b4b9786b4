"""Skew in a report: places on the orbit count from the bottom."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from macroslip.report.bearing_figures import plot_skew_over_orbit


def test_the_bottom_of_the_bearing_is_at_the_left_of_the_picture():
    places = np.radians(2.5 + 5.0 * np.arange(72))
    skew = np.zeros((2, 72))
    skew[0, np.argmin(np.abs(places - 1.5 * np.pi))] = 2e-3  # at the bottom
    result = xr.Dataset(
        {
            "skew_by_position": (("row", "position"), skew),
            "skew_power_by_position": (("row", "position"), skew),
        },
        {"row": ["downwind", "upwind"], "position": places},
    )
    axes = plot_skew_over_orbit(Figure().subplots(), result)
    line = np.asarray(axes.lines[0].get_xydata())
    assert line[np.argmax(line[:, 1])].tolist() in ([2.5, 2.0], [357.5, 2.0])
    assert np.all(np.diff(line[:, 0]) > 0.0)
