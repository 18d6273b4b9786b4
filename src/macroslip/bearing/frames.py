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
    from numpy.typing import ArrayLike, NDArray

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


def contact_normal(angle: ArrayLike, contact_angle: float, axial_sign: int) -> NDArray[np.float64]:
    """Direction in which the rollers push on the outer ring, n = (cos phi cos alpha, sin phi cos alpha, s sin alpha).

    Parameters
    ----------
    angle : array_like, shape (...)
        Roller positions phi [rad].
    contact_angle : float
        Contact angle alpha [rad], 0 to below pi/4.
    axial_sign : int
        Axial sign s of the row, +1 downwind or -1 upwind.

    Returns
    -------
    ndarray, shape (..., 3)
        Unit vectors (X0, Y0, Z0), pointing outward; a load on the inner ring along them presses on the roller.

    Examples
    --------
    >>> contact_normal(np.radians(-90), np.radians(30), -1).round(6).tolist()
    [0.0, -0.866025, -0.5]
    """
    angle = np.asarray(angle, dtype=float)
    cosine = np.cos(contact_angle)
    axial = np.full_like(angle, axial_sign * np.sin(contact_angle))
    return np.stack([np.cos(angle) * cosine, np.sin(angle) * cosine, axial], axis=-1)
