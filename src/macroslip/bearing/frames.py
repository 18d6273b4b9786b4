"""Rows, roller positions and contact normals in the bearing frame.

The bearing frame has Z0 along the shaft, pointing downwind, Y0 up and X0 = Y0 x Z0 horizontal. A roller's position is
its angle from +X0, counter-clockwise about Z0: 90 deg is the top, -90 deg the bottom.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from macroslip.errors import InputError

if TYPE_CHECKING:
    from numpy.typing import NDArray

ROWS: tuple[str, ...] = ("downwind", "upwind")
"""Names of the rows, in the order in which results list them."""

AXIAL_SIGNS: Mapping[str, int] = MappingProxyType({"downwind": 1, "upwind": -1})
"""Axial sign s of each row: the downwind row (+1) carries downwind thrust."""

# The rows are staggered by half a pitch.
_STAGGER = MappingProxyType({"downwind": 0.0, "upwind": 0.5})


def initial_angles(row: str, rollers_per_row: int) -> NDArray[np.float64]:
    """Positions of a row's rollers at the start, evenly spaced from the bottom, rows staggered by half a pitch.

    Parameters
    ----------
    row : str
        One of `ROWS`.
    rollers_per_row : int
        Number of rollers Z in the row, at least 1.

    Returns
    -------
    ndarray, shape (Z,)
        Angles [rad], rising: -pi/2 + 2 pi j/Z downwind, -pi/2 + 2 pi (j + 1/2)/Z upwind.

    Raises
    ------
    InputError
        If there is no such row.

    Examples
    --------
    >>> np.degrees(initial_angles("downwind", 4)).round(9).tolist()
    [-90.0, 0.0, 90.0, 180.0]
    >>> np.degrees(initial_angles("upwind", 4)).round(9).tolist()
    [-45.0, 45.0, 135.0, 225.0]
    """
    if row not in ROWS:
        raise InputError(f"there is no row {row!r}", allowed=" or ".join(ROWS), remedy="Choose one of the two rows.")
    return -np.pi / 2 + 2 * np.pi * (np.arange(rollers_per_row) + _STAGGER[row]) / rollers_per_row
