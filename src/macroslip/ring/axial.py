"""Axial travel of the inner ring, and reversals of the thrust on it."""

from __future__ import annotations

import numpy as np

from macroslip.constants import HOUR


def travel_rate(time: np.ndarray, position: np.ndarray, start: float, end: float) -> float:
    """Way that a ring travels along its axis, forth and back, an hour.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Rising times [s].
    position : ndarray, shape (n,)
        dZ of the ring [m], linear in between.
    start, end : float
        Begin and end of the window [s], between the first and the last time.

    Returns
    -------
    float
        ∫ |d dZ| over the duration of the window [m/h]; 0 for a window without duration.

    Examples
    --------
    >>> round(travel_rate(np.array([0.0, 1800.0, 3600.0]), np.array([0.0, 2e-4, 0.0]), 0.0, 3600.0), 9)
    0.0004
    """
    inside = _within(time, position, start, end)
    travelled = float(np.abs(np.diff(inside)).sum())
    return _hourly(travelled, start, end)


def reversal_rate(
    time: np.ndarray, force: np.ndarray, dead_band: float, start: float, end: float
) -> float:
    """Reversals of a force an hour: changes of its sign beyond a dead band.

    A change counts where the force was beyond the band on one side before and is beyond it on the
    other side now; what happens within the band does not count.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Rising times [s].
    force : ndarray, shape (n,)
        Force [N], linear in between.
    dead_band : float
        Size of a force up to which its sign does not count [N], ≥ 0.
    start, end : float
        Begin and end of the window [s], between the first and the last time.

    Returns
    -------
    float
        Changes over the duration of the window [1/h]; 0 for a window without duration.

    Examples
    --------
    >>> force = np.array([3e4, -1e3, 2e4, -3e4, -2e4])
    >>> reversal_rate(np.arange(5.0), force, 1e4, 0.0, 4.0)
    900.0
    """
    inside = _within(time, force, start, end)
    beyond = inside[np.abs(inside) > dead_band]
    signs = np.sign(beyond)
    reversals = np.count_nonzero(np.diff(signs))
    return _hourly(float(reversals), start, end)


def _within(time: np.ndarray, values: np.ndarray, start: float, end: float) -> np.ndarray:
    """Values at the times inside a window, and at its ends."""
    is_inside = (time > start) & (time < end)
    times = np.concatenate([[start], time[is_inside], [end]])
    return np.interp(times, time, values)


def _hourly(total: float, start: float, end: float) -> float:
    """A total of a window from `start` to `end` [s] an hour."""
    if end <= start:
        return 0.0
    return total * HOUR / (end - start)
