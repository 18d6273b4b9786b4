"""What depends on load and one speed as a table: friction of the cage's contact, and the oil of a raceway contact.

Cubic splines over ln Q and the logarithm of the speed. What goes with powers of both is held as it is, not as a logarithm:
a spline is as good relative to its value, where that grows by a few per cent from node to node, and needs no exponential. A cell in which their error is too large is marked;
there, as outside the table, the laws themselves are evaluated.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit_inline
from macroslip.contact.spline import NOWHERE, Axis, cell_of, no_cells
from macroslip.contact.spline_cell import channels_in_square

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
        Whether the splines are used in a cell in place of the laws.
    """

    load: Axis
    speed: Axis
    coefficients: np.ndarray
    good: np.ndarray


class PlaneValues(NamedTuple):
    """Whether a table holds a state, its splines, and their derivatives by the logarithms of load and speed."""

    known: bool
    value: tuple[float, float, float, float]
    by_load: tuple[float, float, float, float]
    by_speed: tuple[float, float, float, float]


def no_plane_table() -> PlaneTable:
    """An empty table."""
    return PlaneTable(NOWHERE, NOWHERE, *no_cells(2, CHANNELS))


@jit_inline
def _times(four, factor):
    return four[0] * factor, four[1] * factor, four[2] * factor, four[3] * factor


@jit_inline
def plane_values(table, log_load, log_speed):
    """Look a state up: ln Q [ln N] and the logarithm of a speed [ln m/s]."""
    zeros = (0.0, 0.0, 0.0, 0.0)
    if table.load.cells == 0:
        return PlaneValues(False, zeros, zeros, zeros)
    i, t = cell_of(table.load, log_load)
    j, u = cell_of(table.speed, log_speed)
    if i < 0 or j < 0 or not table.good[i, j]:
        return PlaneValues(False, zeros, zeros, zeros)
    found = channels_in_square(table.coefficients, (i, j), (t, u))  # pyright: ignore[reportCallIssue]
    value, by_load, by_speed = found
    return PlaneValues(True, value, _times(by_load, table.load.per_spacing), _times(by_speed, table.speed.per_spacing))
