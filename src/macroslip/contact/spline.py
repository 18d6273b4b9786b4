"""Cubic splines on even grids: their axes, and coefficients through given values.

A spline of n nodes along an axis has n + 2 coefficients there; `macroslip.contact.spline_cell` has the values in a cell.

References
----------
de Boor, A Practical Guide to Splines, Springer (1978), doi:10.1007/978-1-4612-6333-3.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit_inline


class Axis(NamedTuple):
    """Evenly spaced nodes of one coordinate.

    Attributes
    ----------
    first : float
        Coordinate of the first node.
    per_spacing : float
        Reciprocal of the distance between nodes.
    cells : int
        Between the nodes; an axis without cells holds no coordinate.
    """

    first: float
    per_spacing: float
    cells: int


#: The axis of an empty table.
NOWHERE = Axis(0.0, 1.0, 0)


def axis(first: float, last: float, spacing: float) -> Axis:
    """Nodes from `first` to `last`, at most `spacing` apart and at least five.

    Examples
    --------
    >>> axis(0.0, 1.0, 0.1)
    Axis(first=0.0, per_spacing=10.0, cells=10)
    """
    cells = max(math.ceil((last - first) / spacing * (1.0 - 1e-12)), 4)
    return Axis(float(first), cells / (last - first), cells)


def log_axis(bounds: tuple[float, float], spacing: float) -> Axis:
    """Nodes of a logarithm between two values of its argument.

    Examples
    --------
    >>> log_axis((1.0, math.e), 0.1).cells
    10
    """
    return axis(math.log(bounds[0]), math.log(bounds[1]), spacing)


def axis_nodes(one: Axis) -> np.ndarray:
    """Coordinates of an axis' nodes."""
    return one.first + np.arange(one.cells + 1) / one.per_spacing


def axis_middles(one: Axis) -> np.ndarray:
    """Coordinates of the middles of an axis' cells."""
    return one.first + (np.arange(one.cells) + 0.5) / one.per_spacing


@jit_inline
def cell_of(one, coordinate):
    """Cell of a coordinate and the place in it, from 0 to 1; the cell −1 outside the axis.

    Examples
    --------
    >>> cell_of(Axis(1.0, 2.0, 4), 1.75), cell_of(Axis(1.0, 2.0, 4), 3.0)
    ((1, 0.5), (-1, 0.0))
    """
    place = (coordinate - one.first) * one.per_spacing
    if not 0.0 <= place < one.cells:
        return -1, 0.0
    cell = int(place)
    return cell, place - cell


@jit_inline
def nearest_cell(one, coordinate):
    """Cell next to a coordinate, the place in it, from 0 to 1, and what of the coordinate lies outside the axis.

    Examples
    --------
    >>> nearest_cell(Axis(1.0, 2.0, 4), 1.75), nearest_cell(Axis(1.0, 2.0, 4), 3.5)
    ((1, 0.5, 0.0), (3, 1.0, 0.5))
    """
    place = (coordinate - one.first) * one.per_spacing
    inside = min(max(place, 0.0), float(one.cells))
    cell = min(int(inside), one.cells - 1)
    return cell, inside - cell, (place - inside) / one.per_spacing


def spline_coefficients(values: np.ndarray, dimension: int) -> np.ndarray:
    """Coefficients along one dimension of the spline through `values`, not-a-knot at both ends.

    Examples
    --------
    >>> spline_coefficients(np.arange(6.0), 0).round(12)
    array([-1.,  0.,  1.,  2.,  3.,  4.,  5.,  6.])
    """
    count = values.shape[dimension]
    matrix = np.zeros((count + 2, count + 2))
    for row in range(count):
        matrix[row + 1, row : row + 3] = (1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0)
    matrix[0, :5] = matrix[-1, -5:] = (1.0, -4.0, 6.0, -4.0, 1.0)
    moved = np.moveaxis(values, dimension, 0)
    ends = np.zeros((1, *moved.shape[1:]))
    right = np.concatenate([ends, moved, ends])
    solved = np.linalg.solve(matrix, right.reshape(count + 2, -1)).reshape(right.shape)
    return np.moveaxis(solved, 0, dimension)


def middle_values(coefficients: np.ndarray, dimensions: int) -> np.ndarray:
    """Values of the tensor-product spline in the middles of its cells, from its coefficients.

    Examples
    --------
    >>> middle_values(np.arange(-1.0, 6.0), 1)
    array([0.5, 1.5, 2.5, 3.5])
    """
    for dimension in range(dimensions):
        moved = np.moveaxis(coefficients, dimension, 0)
        outer, inner = moved[:-3] + moved[3:], moved[1:-2] + moved[2:-1]
        coefficients = np.moveaxis((outer + 23.0 * inner) / 48.0, 0, dimension)
    return coefficients


def tensor_coefficients(values: np.ndarray, dimensions: int) -> np.ndarray:
    """Coefficients of the tensor-product spline along the first `dimensions` dimensions, read-only and in C order."""
    for dimension in range(dimensions):
        values = spline_coefficients(values, dimension)
    return read_only(values)


def no_cells(dimensions: int, channels: int) -> tuple[np.ndarray, np.ndarray]:
    """Coefficients and marks of the cells of an empty table; all its axes are `NOWHERE`."""
    none = (0,) * dimensions
    return read_only(np.empty((*none, channels))), read_only(np.empty(none, dtype=np.bool_))


def read_only(values: np.ndarray) -> np.ndarray:
    """The same values in C order and not to be written: what kernels take for a table, and threads share."""
    values = np.ascontiguousarray(values)
    values.setflags(write=False)
    return values
