"""How a case loads its rows of rollers, from the ring balance alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.bearing.geometry import AXIAL_SIGNS, ROWS
from macroslip.contact.interface import highest_load
from macroslip.loads import BearingLoads, main_bearing_load
from macroslip.ring.balance import roller_loads
from macroslip.ring.motion import ring_motion
from macroslip.roller.model import ring_geometry, roller_model

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

    from macroslip.case.case import Case

#: One of so many samples of the ring balance is used.
_EVERY = 5


def roller_load_series(case: Case, start: float, end: float) -> tuple[NDArray, NDArray]:
    """Elastic load of every roller at every fifth sample of the ring balance between two times.

    Parameters
    ----------
    case : Case
    start, end : float
        [s] on the loads' time axis.

    Returns
    -------
    time : ndarray, shape (m,)
        [s].
    load : ndarray, shape (m, 2, rollers)
        [N], by time, row and roller.

    Raises
    ------
    InputError
        As `macroslip.simulate`.
    """
    loads = case.loads if isinstance(case.loads, BearingLoads) else main_bearing_load(case.loads, case.drivetrain)
    model = roller_model(case.bearing, case.oil, AXIAL_SIGNS["downwind"], tilt=case.drivetrain.tilt)
    ring = ring_geometry(case.bearing, model)
    motion, _ = ring_motion(loads, case.bearing, ring, highest_load(case.bearing, case.oil, case.laws))
    here = np.flatnonzero((motion.time >= start) & (motion.time <= end))[::_EVERY]
    found = np.empty((here.size, len(ROWS) * case.bearing.rollers_per_row))
    for line, k in zip(found, here, strict=True):
        roller_loads(ring, motion.shaft_angle[k], motion.displacement[k], line)
    return motion.time[here], found.reshape(here.size, len(ROWS), -1)


def row_loads(case: Case, start: float, end: float) -> xr.Dataset:
    """Mean loads of the bearing and of its rows between two times.

    Parameters
    ----------
    case : Case
    start, end : float
        [s] on the loads' time axis.

    Returns
    -------
    xarray.Dataset
        radial_load and thrust [N], means of √(F_X0² + F_Y0²) and F_Z0 over the samples; over row: roller_load [N], mean
        over all rollers and every fifth sample of the elastic load, and loaded_share [1], how many of these carry any.

    Raises
    ------
    InputError
        As `macroslip.simulate`.

    Examples
    --------
    >>> from macroslip import BearingLoads, Case
    >>> thrust = BearingLoads.constant([0.0, 0.0, 100e3], 2.1, 1.0)
    >>> row_loads(Case(loads=thrust), 0.0, 1.0).loaded_share.values.tolist()
    [1.0, 0.0]
    """
    import xarray as xr

    loads = case.loads if isinstance(case.loads, BearingLoads) else main_bearing_load(case.loads, case.drivetrain)
    _, by_row = roller_load_series(case, start, end)
    inside = (loads.time >= start) & (loads.time <= end)
    x, y, axial = loads.force[inside].T

    def value(values: object, units: str, long_name: str, *dims: str) -> tuple:
        return dims, values, {"units": units, "long_name": long_name}

    return xr.Dataset(
        {
            "radial_load": value(float(np.hypot(x, y).mean()), "N", "mean radial load of the bearing"),
            "thrust": value(float(axial.mean()), "N", "mean thrust on the bearing, positive downwind"),
            "roller_load": value(by_row.mean(axis=(0, 2)), "N", "elastic load, mean over rollers and samples", "row"),
            "loaded_share": value((by_row > 0.0).mean(axis=(0, 2)), "1", "share of rollers and time under load", "row"),
        },
        {"row": list(ROWS)},
    )
