"""What films carry where a roller has play, as a table: the load q depends on play, body force and ring speed.

Cubic splines of q, one for a body force that points outward and one for inward, over ln(p + p0), ln(|B| + B0) and
ln |u2|. A cell in which their error is too large is marked; there, as outside the table, the equation is solved.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit_inline
from macroslip.contact.logarithms import logarithms
from macroslip.contact.spline import NOWHERE, Axis, cell_of, no_cells
from macroslip.contact.spline_cell import channels_in_cell

#: Splines of a table; two are used.
CHANNELS = 4
#: Play p0 [m] and force B0 [N] added before the logarithm is taken, since both may be zero.
LEAST_PLAY, LEAST_FORCE = 1e-6, 1.0


class PlayTable(NamedTuple):
    """Splines over play, body force and ring speed.

    Attributes
    ----------
    play, body, speed : Axis
        Of ln(p + p0), ln(|B| + B0) and ln |u2|.
    coefficients : ndarray, shape (plays + 2, forces + 2, speeds + 2, 4)
    good : ndarray of bool, shape of the cells
        Whether the splines are used in a cell in place of the law.
    """

    play: Axis
    body: Axis
    speed: Axis
    coefficients: np.ndarray
    good: np.ndarray


def no_play_table() -> PlayTable:
    """An empty table."""
    return PlayTable(NOWHERE, NOWHERE, NOWHERE, *no_cells(3, CHANNELS))


@jit_inline
def tabled_load(table, play, body, ring_speed):
    """Load q [N] of the film that no body force presses on, from play p ≥ 0 [m], B [N] and u2 [m/s].

    NaN where the table does not hold the state.
    """
    if table.play.cells == 0 or ring_speed == 0.0:
        return math.nan
    log_play, log_body, log_speed, _ = logarithms(play + LEAST_PLAY, abs(body) + LEAST_FORCE, abs(ring_speed), 1.0)
    i, t = cell_of(table.play, log_play)
    k, s = cell_of(table.body, log_body)
    j, u = cell_of(table.speed, log_speed)
    if i < 0 or k < 0 or j < 0 or not table.good[i, k, j]:
        return math.nan
    value, _, _, _ = channels_in_cell(table.coefficients, (i, k, j), (t, s, u))  # pyright: ignore[reportCallIssue]
    return value[0] if body >= 0.0 else value[1]
