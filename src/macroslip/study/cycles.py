"""Cycles of the load on the main bearing, counted by the rainflow method.

Raceways and rollers meet a load cycle at every pass, whatever the turbine does; what rainflow adds are the slow cycles
of the bearing's load as a whole. Two are counted. Cycles of the axial load move load from one row of rollers to the
other and back, and a row that is unloaded is a row that slips. Cycles of the radial load load housing, shaft and
ring seats.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.rating.spectrum import rainflow_ranges

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.loads import BearingLoads

COMPONENTS = ("radial", "axial")
#: Classes of ranges, 40 a decade from 1 N to 1e8 N: every load that is accepted, to 6 %.
RANGE_EDGES = np.logspace(0.0, 8.0, 321)


def counted(loads: BearingLoads) -> xr.Dataset:
    """Count the cycles of a load history by classes of range.

    Parameters
    ----------
    loads : BearingLoads

    Returns
    -------
    xarray.Dataset
        `load_cycles` over (component, load_range): cycles in the whole history, which is taken as repeating, so that
        every cycle closes. `load_range` is the geometric middle of a class [N].

    Notes
    -----
    `fatpack.find_rainflow_ranges`, 256 levels between the smallest and the largest load; smaller ripples do not count.
    ASTM E 1049-85, Standard Practices for Cycle Counting in Fatigue Analysis, doi:10.1520/E1049-85R17.

    Examples
    --------
    >>> from macroslip import BearingLoads
    >>> time = np.linspace(0.0, 10.0, 1001)
    >>> force = np.zeros((1001, 3))
    >>> force[:, 2] = 45e3 * np.sin(2.0 * np.pi * time)
    >>> found = counted(BearingLoads(time, np.full(1001, 2.0), force, "ten cycles of 90 kN")).sel(component="axial")
    >>> most = found.load_cycles.argmax("load_range")
    >>> float(found.load_cycles.sum()), f"{float(found.load_range[most]):.3g} N"
    (10.0, '9.17e+04 N')
    """
    import xarray as xr

    from_shaft = {"radial": np.hypot(loads.force[:, 0], loads.force[:, 1]), "axial": loads.force[:, 2]}
    counts = np.array([_histogram(from_shaft[name]) for name in COMPONENTS])
    middle = np.sqrt(RANGE_EDGES[1:] * RANGE_EDGES[:-1])
    return xr.Dataset(
        {
            "load_cycles": (
                ("component", "load_range"),
                counts,
                {"units": "1", "long_name": "cycles of the bearing's load"},
            )
        },
        {
            "component": list(COMPONENTS),
            "load_range": (
                "load_range",
                middle,
                {"units": "N", "long_name": "range of the cycle, middle of its class"},
            ),
        },
    )


def _histogram(series: np.ndarray) -> np.ndarray:
    if np.ptp(series) < RANGE_EDGES[0]:
        return np.zeros(RANGE_EDGES.size - 1)
    return np.histogram(rainflow_ranges(series), RANGE_EDGES)[0].astype(float)
