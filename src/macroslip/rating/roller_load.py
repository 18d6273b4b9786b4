"""Load on every roller over a history of the bearing's load, from the ring balance alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.bearing.frames import AXIAL_SIGNS, ROWS
from macroslip.loads import BearingLoads
from macroslip.mechanisms import Laws
from macroslip.ring.balance import roller_loads
from macroslip.ring.motion import ring_motion
from macroslip.roller.model import highest_load, ring_geometry, roller_model

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from macroslip.bearing import Bearing
    from macroslip.lubricant import Lubricant


def roller_load_history(
    bearing: Bearing, lubricant: Lubricant, loads: BearingLoads
) -> tuple[BearingLoads, NDArray[np.float64]]:
    """Elastic load of every roller at every sample.

    Parameters
    ----------
    bearing : Bearing
    lubricant : Lubricant
        No roller load depends on it.
    loads : BearingLoads
        Load on the inner ring.

    Returns
    -------
    loads : BearingLoads
        The same loads, with samples in between where the shaft turns too far between two of them.
    roller_load : ndarray, shape (2, Z, n)
        Q [N] over row, roller and the samples of these loads.

    Raises
    ------
    InputError
        If a roller load is so high that more than a tenth of it would lie beyond the roller's ends.

    Examples
    --------
    >>> from macroslip import Bearing, BearingLoads, Lubricant
    >>> thrust = BearingLoads.constant([0.0, 0.0, 100e3], 2.1, 1.0)
    >>> _, load = roller_load_history(Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao"), thrust)
    >>> load.shape, round(load[0].sum(axis=0)[0] * np.sin(np.radians(11.2))), load[1].max().item()
    ((2, 28, 21), 100000, 0.0)
    """
    model = roller_model(bearing, lubricant, AXIAL_SIGNS["downwind"], tilt=0.0)
    ring = ring_geometry(bearing, model)
    motion, _ = ring_motion(loads, bearing, ring, highest_load(bearing, lubricant, Laws.physical()))
    found = np.empty((motion.time.size, len(ROWS) * bearing.rollers_per_row))
    for line, angle, place in zip(found, motion.shaft_angle, motion.displacement, strict=True):
        roller_loads(ring, angle, place, line)
    force = np.column_stack([np.interp(motion.time, loads.time, component) for component in loads.force.T])
    finer = BearingLoads(motion.time, motion.shaft_speed, force, loads.source)
    return finer, np.moveaxis(found, 0, -1).reshape(len(ROWS), bearing.rollers_per_row, -1)
