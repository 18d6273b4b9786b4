"""Index of the heat of a bearing over time: measured over expected by the reference."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd

from macroslip.arrays import FloatArray

#: Periods over which windows are drawn together, as pandas names them, and windows that each needs.
PERIODS: Mapping[str, tuple[str, int]] = {"day": ("D", 4), "week": ("W", 12), "month": ("M", 48)}
#: Index above which a day adds to the sum, and sum that is flagged.
TOLERATED = 1.10
FLAGGED = 1.0


def index_over(
    start: pd.DatetimeIndex,
    measured: FloatArray,
    expected: FloatArray,
    period: str,
) -> pd.DataFrame:
    """Index of each period: sum of the measured over the sum of the expected heat.

    Parameters
    ----------
    start : DatetimeIndex
        Times of n windows.
    measured, expected : ndarray, shape (n,)
        Heat, or rise of temperature, of each window in one unit.
    period : str
        A key of `PERIODS`.

    Returns
    -------
    DataFrame
        `start` of the period (UTC), number of `windows`, index `r` [-], and its standard `error`
        [-] by the scatter of the windows. Periods with too few windows are left out, and such
        whose expected heat is not positive.

    Examples
    --------
    >>> start = pd.date_range("2024-01-01", periods=4, freq="2h", tz="UTC")
    >>> index_over(start, np.array([1.2, 1.3, 1.2, 1.3]), np.ones(4), "day").r.tolist()
    [1.25]
    """
    code, least = PERIODS[period]
    periods = start.tz_localize(None).to_period(code)
    begins = periods.start_time
    table = pd.DataFrame({"start": begins, "measured": measured, "expected": expected})
    sums = table.groupby("start", sort=True).agg(
        windows=("measured", "size"), measured=("measured", "sum"), expected=("expected", "sum")
    )
    ratio = sums["measured"] / sums["expected"]
    ratio_of_period = ratio.reindex(table["start"]).to_numpy()
    fitted = ratio_of_period * table["expected"]
    table["off"] = table["measured"] - fitted
    square = table["off"] ** 2
    squares = square.groupby(table["start"]).sum()
    freedom = np.maximum(sums["windows"] - 1, 1)
    windows = sums["windows"]
    scatter = np.sqrt(squares * windows / freedom)
    error = scatter / sums["expected"]
    index = pd.DataFrame({"windows": windows, "r": ratio, "error": error})
    is_known = (windows >= least) & (sums["expected"] > 0.0)
    return index[is_known].reset_index()


def cusum(index: FloatArray) -> FloatArray:
    """Cumulative sum of an index, S ← max(0, S + r − 1.10), day by day.

    E. S. Page, Continuous inspection schemes, Biometrika 41 (1954) 100, doi:10.2307/2333009.
    A day without a number leaves the sum as it is.

    Examples
    --------
    >>> cusum(np.array([1.0, 1.3, np.nan, 1.3])).round(6).tolist()
    [0.0, 0.2, 0.2, 0.4]
    """
    total = 0.0
    sums = np.empty(index.size)
    for day, value in enumerate(index):
        if np.isfinite(value):
            excess = value - TOLERATED
            total = max(0.0, total + excess)
        sums[day] = total
    return sums


def first_flag(days: pd.DataFrame, column: str = "cusum") -> pd.Timestamp | None:
    """First day whose cumulative sum is flagged; None if there is none."""
    is_above = days[column] > FLAGGED
    above = days.loc[is_above, "start"]
    return None if above.empty else above.iloc[0]
