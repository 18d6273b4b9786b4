"""Loads and speeds for which the tables of a case are made, and how they are measured."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

#: Relative error of force and of power in the middle of a cell beyond which the laws are asked there.
LARGEST_ERROR = 3e-5
#: Factor to which the highest load is rounded, part of the highest speed below which no table goes, and the highest load
#: of a table, at least [N]. The cage carries the difference of the raceways' tractions, 0.004 of the highest roller load on
#: the bundled histories; here it may be this part.
_LOAD_STEP, _SLOWEST, _LEAST_HIGHEST_LOAD, _CAGE_LOAD = 2.0, 0.25, 100.0, 0.02
#: Distance between nodes of the logarithm of speed, at whose multiples they lie; and multiples of these to which the
#: speeds of small tables are rounded.
SPEED_SPACING, _WIDE_SPEED = 0.055, 4


class TableBox(NamedTuple):
    """Loads and speeds for which the tables of a case are made.

    Attributes
    ----------
    highest_load, highest_cage_load : float
        At a raceway and at the cage [N].
    lowest_speed, highest_speed : float
        Of the raceways past the roller's centre, |u2| [m/s].
    """

    highest_load: float
    highest_cage_load: float
    lowest_speed: float
    highest_speed: float


def table_box(ring_speeds: np.ndarray, highest_load: float, body_force: float) -> TableBox | None:
    """The box of a case, rounded outward so that cases alike share their tables.

    Parameters
    ----------
    ring_speeds : ndarray
        u2 at all load samples, between which it is linear [m/s].
    highest_load : float
        Largest elastic load of a roller [N].
    body_force : float
        Largest weight and centrifugal force of a roller [N].

    Returns
    -------
    TableBox or None
        None for a shaft that stands still. Of one that turns slowly, or round, speeds below a quarter of the highest one
        are left to the laws.

    Examples
    --------
    >>> [round(one, 4) for one in table_box(np.array([-0.40, -0.38]), 5e4, 40.0)]
    [65536.0, 1310.72, 0.3716, 0.4148]
    """
    fastest = float(np.max(np.abs(ring_speeds)))
    if fastest == 0.0:
        return None
    highest = 1.02 * (highest_load + body_force) + _LEAST_HIGHEST_LOAD
    load = _LOAD_STEP ** math.ceil(math.log(highest, _LOAD_STEP))
    turns = np.min(ring_speeds) * np.max(ring_speeds) <= 0.0
    slowest = max(0.0 if turns else float(np.min(np.abs(ring_speeds))), _SLOWEST * fastest)
    return TableBox(
        load,
        max(1e3, _CAGE_LOAD * load),
        *_rounded(slowest / 1.001, fastest * 1.001, SPEED_SPACING),
    )


def _rounded(slowest: float, fastest: float, step: float) -> tuple[float, float]:
    """Two speeds [m/s], rounded outward to multiples of a step in the logarithm."""
    return math.exp(step * math.floor(math.log(slowest) / step)), math.exp(step * math.ceil(math.log(fastest) / step))


def wide_box(box: TableBox) -> TableBox:
    """The box with its speeds rounded further outward, for tables that are cheap to make over more speeds.

    Cases of one bearing then share theirs.
    """
    low, high = _rounded(box.lowest_speed * 1.001, box.highest_speed / 1.001, _WIDE_SPEED * SPEED_SPACING)
    return box._replace(lowest_speed=low, highest_speed=high)


def values_at(kernel: Callable, states: Sequence[np.ndarray], count: int) -> np.ndarray:
    """Values of `kernel` at states of one shape, with `count` more along a last dimension."""
    values = np.empty((states[0].size, count))
    kernel(*(np.ascontiguousarray(one).ravel() for one in states), values)
    return values.reshape(*states[0].shape, count)


def error_summary(errors: np.ndarray) -> np.ndarray:
    """Median and largest of relative errors, and the share of states at which there is one: elsewhere laws were asked."""
    known = errors[errors > 0.0]
    return np.array([np.median(known), known.max(), known.size / errors.size]) if known.size else np.zeros(3)
