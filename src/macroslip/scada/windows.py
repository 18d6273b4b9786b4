"""Windows of two hours without break in a record, over which a heat balance is drawn up."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray

from macroslip.arrays import BoolArray, FloatArray
from macroslip.constants import HOUR

#: Length of a window [s].
LENGTH = 7200.0


@dataclass(frozen=True, eq=False)
class Windows:
    """Stretches of a record without break; the last row of one may be the first of the next."""

    first: NDArray[np.intp]  #: Number of the first row of each window
    steps: int  #: Steps of time in a window, one less than its rows
    step: float  #: Length of a step [s]

    def __len__(self) -> int:
        return self.first.size

    @property
    def rows(self) -> NDArray[np.intp]:
        """Numbers of the rows over (window, row)."""
        return self.first[:, None] + np.arange(self.steps + 1)

    def mean(self, values: ArrayLike) -> FloatArray:
        """Mean of each window by the trapezoidal rule, of a value for every row of the record.

        Examples
        --------
        >>> Windows(np.array([0, 2]), 2, 600.0).mean([0.0, 1.0, 4.0, 4.0, 4.0])
        array([1.5, 4. ])
        """
        inside = np.asarray(values, dtype=float)[self.rows]
        ends = 0.5 * (inside[:, 0] + inside[:, -1])
        between = inside[:, 1:-1].sum(axis=1)
        return (ends + between) / self.steps

    def rate(self, values: ArrayLike) -> FloatArray:
        """Change of a value from the first to the last row of each window, per hour.

        Examples
        --------
        >>> Windows(np.array([0]), 6, 600.0).rate([300.0, 0, 0, 0, 0, 0, 301.5])
        array([1.5])
        """
        known = np.asarray(values, dtype=float)
        hours = self.steps * self.step / HOUR
        before = known[self.first]
        after = known[self.first + self.steps]
        return (after - before) / hours

    def at(self, chosen: BoolArray) -> Windows:
        """Those that are chosen."""
        return Windows(self.first[chosen], self.steps, self.step)


def unbroken_windows(
    time: pd.DatetimeIndex, usable: ArrayLike, jump: ArrayLike, step: float
) -> Windows:
    """Windows of two hours without break, one after the other from the start of each stretch.

    Parameters
    ----------
    time : DatetimeIndex
        Times of n rows, rising.
    usable : array_like of bool, shape (n,)
        Whether a row is used.
    jump : array_like of bool, shape (n,)
        Whether the temperature jumps from the row before to this one, which breaks a stretch.
    step : float
        Time from row to row [s].

    Returns
    -------
    Windows
        Neighbours within a stretch share a row.

    Examples
    --------
    >>> time = pd.date_range("2024-01-01", periods=30, freq="10min", tz="UTC")
    >>> usable = np.arange(30) != 14
    >>> unbroken_windows(time, usable, np.zeros(30, bool), 600.0).first.tolist()
    [0, 15]
    """
    usable = np.asarray(usable, dtype=bool)
    steps = round(LENGTH / step)
    nanoseconds = np.diff(time.as_unit("ns").asi8)
    later = nanoseconds / 1e9
    is_next = np.abs(later - step) < 0.5 * step
    jumped = np.asarray(jump, dtype=bool)
    follows = is_next & ~jumped[1:]
    is_joined = follows & usable[1:] & usable[:-1]
    joined = np.r_[False, is_joined]
    stretch = np.cumsum(~joined)
    # Number of a row within its stretch.
    starts = np.flatnonzero(~joined)
    start_of_stretch = starts[stretch - 1]
    inside = np.arange(usable.size) - start_of_stretch
    begins = usable & (inside % steps == 0)
    candidates = np.flatnonzero(begins)
    has_end = candidates + steps < usable.size
    candidates = candidates[has_end]
    stretch_of_end = stretch[candidates + steps]
    whole = stretch_of_end == stretch[candidates]
    return Windows(candidates[whole], steps, step)
