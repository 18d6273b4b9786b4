"""Smearing when a roller enters the load zone, compared with published rig tests."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

REFERENCES = (
    "Evans, Barr, Houpert and Boyd, Tribol. Trans. 56 (2013) 703: smearing of cylindrical roller "
    "bearings",
    "Fowell, Ioannides and Kadiric, Tribol. Trans. 57 (2014) 472: power and temperature at its "
    "onset",
    "Hamer, Sayles and Ioannides, J. Tribol. 113 (1991) 805: collapse of sliding films",
)
#: Slip at which smearing began on a rig with cylindrical roller bearings (Evans 2013): about this
#: at light load, less at higher.
RIG_SLIDE_ROLL_RATIO = 0.05


def entries_beyond(largest: ArrayLike, entries: ArrayLike, limit: float) -> tuple[NDArray, NDArray]:
    """Least and largest number of entries beyond a limit.

    `largest` has over (..., roller, orbit) the largest value of the entries, in the unit of
    `limit`, NaN without one;
    `entries` how many entries each of these orbits has.

    One, or all, of the entries in an orbit whose largest is beyond. They differ where rollers enter
    several times in an orbit.

    Examples
    --------
    >>> [int(one) for one in entries_beyond([[0.02, 0.7, np.nan]], [[1, 3, 0]], 0.05)]
    [1, 3]
    """
    beyond = np.asarray(largest) > limit
    entries_there = np.where(beyond, entries, 0)
    rollers_and_orbits = (-2, -1)
    orbits_beyond = beyond.sum(axis=rollers_and_orbits)
    return orbits_beyond, entries_there.sum(axis=rollers_and_orbits)
