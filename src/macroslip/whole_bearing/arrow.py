"""The arrow matrix of a stage: two equations a roller, and a border of one or three a cage.

A roller meets only its cage, so its two unknowns are eliminated on their own, and a solution costs in proportion to the
number of rollers.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit_called, jit_inline


class Arrow(NamedTuple):
    """Matrix and right-hand side.

    Attributes
    ----------
    inverse : ndarray, shape (n, 4)
        Inverse of each roller's 2 × 2 block.
    column, row : ndarray, shape (n, 2, 3)
        Its border: derivatives of its residuals by w, p, q and of the cage's residuals by v_in, v_out.
    slope : ndarray, shape (n, 3)
        Derivatives of the spars' push by x' [N s/m], and of the cage's friction by slip [N s/m] and by the push [-].
    rest : ndarray, shape (n, 2)
        Its residuals [N], or the right-hand side of a solution.
    border : ndarray, shape (c, 3, 3)
    border_rest : ndarray, shape (c, 3)
    """

    inverse: np.ndarray
    column: np.ndarray
    row: np.ndarray
    slope: np.ndarray
    rest: np.ndarray
    border: np.ndarray
    border_rest: np.ndarray


def new_arrow(count: int, cages: int) -> Arrow:
    """Work space for `count` rollers."""
    return Arrow(
        inverse=np.zeros((count, 4)),
        column=np.zeros((count, 2, 3)),
        row=np.zeros((count, 2, 3)),
        slope=np.zeros((count, 3)),
        rest=np.zeros((count, 2)),
        border=np.zeros((cages, 3, 3)),
        border_rest=np.zeros((cages, 3)),
    )


@jit_called
def eliminate(cage_of, size, arrow):
    """Take the rollers out of the cages' borders, once for all right-hand sides of this matrix.

    Parameters
    ----------
    cage_of : ndarray of int, shape (n,)
        Index of each roller's cage.
    size : int
        Unknowns of a cage, one or three.
    arrow : Arrow
    """
    for j in range(cage_of.size):
        border, inverse = arrow.border[cage_of[j]], arrow.inverse[j]
        column, row = arrow.column[j], arrow.row[j]
        i0, i1, i2, i3 = inverse[0], inverse[1], inverse[2], inverse[3]
        for k in range(size):
            ahead, behind = column[0, k], column[1, k]
            first, second = i0 * ahead + i1 * behind, i2 * ahead + i3 * behind
            for i in range(size):
                border[i, k] -= row[0, i] * first + row[1, i] * second


@jit_inline
def _solve_border(matrix, rest, size):
    """Solve the small border in place by Cramer's rule; its diagonal is dominated by mass over step."""
    if size == 1:
        rest[0] /= matrix[0, 0]
        return
    m00, m01, m02 = matrix[0, 0], matrix[0, 1], matrix[0, 2]
    m10, m11, m12 = matrix[1, 0], matrix[1, 1], matrix[1, 2]
    m20, m21, m22 = matrix[2, 0], matrix[2, 1], matrix[2, 2]
    c00, c01, c02 = m11 * m22 - m12 * m21, m12 * m20 - m10 * m22, m10 * m21 - m11 * m20
    determinant = m00 * c00 + m01 * c01 + m02 * c02
    r0, r1, r2 = rest[0], rest[1], rest[2]
    rest[0] = (r0 * c00 + r1 * (m02 * m21 - m01 * m22) + r2 * (m01 * m12 - m02 * m11)) / determinant
    rest[1] = (r0 * c01 + r1 * (m00 * m22 - m02 * m20) + r2 * (m02 * m10 - m00 * m12)) / determinant
    rest[2] = (r0 * c02 + r1 * (m01 * m20 - m00 * m21) + r2 * (m00 * m11 - m01 * m10)) / determinant


@jit_called
def solve(cage_of, size, arrow):
    """Turn `rest` and `border_rest` into the solution of the system that `eliminate` has prepared; parameters as there."""
    for j in range(cage_of.size):
        inverse, rest, row = arrow.inverse[j], arrow.rest[j], arrow.row[j]
        first = inverse[0] * rest[0] + inverse[1] * rest[1]
        second = inverse[2] * rest[0] + inverse[3] * rest[1]
        rest[0], rest[1] = first, second
        border_rest = arrow.border_rest[cage_of[j]]
        for i in range(size):
            border_rest[i] -= row[0, i] * first + row[1, i] * second
    for c in range(arrow.border.shape[0]):
        _solve_border(arrow.border[c], arrow.border_rest[c], size)
    for j in range(cage_of.size):
        inverse, rest, column = arrow.inverse[j], arrow.rest[j], arrow.column[j]
        change = arrow.border_rest[cage_of[j]]
        first, second = 0.0, 0.0
        for k in range(size):
            first += column[0, k] * change[k]
            second += column[1, k] * change[k]
        rest[0] -= inverse[0] * first + inverse[1] * second
        rest[1] -= inverse[2] * first + inverse[3] * second
