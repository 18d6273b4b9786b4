"""What depends on load and one speed as a table: friction of the cage's contact, and the oil of a raceway contact.

Cubic splines over ln Q and the logarithm of the speed. A cell in which they miss the laws by more than they may is marked;
there, as outside the table, the laws themselves are asked.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit_inline
from macroslip.contact.spline import NOWHERE, Axis, cell_of, read_only
from macroslip.traction.spline_cell import channels_in_square

#: Splines of a table.
CHANNELS = 4


class PlaneTable(NamedTuple):
    """Four splines over load and a speed.

    Attributes
    ----------
    load, speed : Axis
        Of ln Q and of the logarithm of the speed.
    coefficients : ndarray, shape (loads + 2, speeds + 2, 4)
    good : ndarray of bool, shape of the cells
        Whether the splines stand in for the laws in a cell.
    """

    load: Axis
    speed: Axis
    coefficients: np.ndarray
    good: np.ndarray


class PlaneValues(NamedTuple):
    """Whether a table knows a state, its first two splines, and their derivatives by ln Q and by the speed's logarithm."""

    known: bool
    first: float
    second: float
    first_by_load: float
    second_by_load: float
    first_by_speed: float
    second_by_speed: float


def no_plane_table() -> PlaneTable:
    """A table that knows no state."""
    return PlaneTable(NOWHERE, NOWHERE, read_only(np.empty((0, 0, CHANNELS))), read_only(np.empty((0, 0), dtype=np.bool_)))


@jit_inline
def plane_values(table, load, speed):
    """Look a state up: Q > 0 [N] and the magnitude of a speed [m/s]."""
    nothing = PlaneValues(False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    if table.load.cells == 0 or speed <= 0.0:
        return nothing
    i, t = cell_of(table.load, math.log(load))
    j, u = cell_of(table.speed, math.log(speed))
    if i < 0 or j < 0 or not table.good[i, j]:
        return nothing
    value, by_first, by_second = channels_in_square(table.coefficients, (i, j), (t, u))
    per_load, per_speed = table.load.per_spacing, table.speed.per_spacing
    return PlaneValues(
        True,
        value[0],
        value[1],
        by_first[0] * per_load,
        by_first[1] * per_load,
        by_second[0] * per_speed,
        by_second[1] * per_speed,
    )
