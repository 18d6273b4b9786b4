"""Times of a record in UTC: offsets, zones, the hour that clocks repeat."""

from __future__ import annotations

from typing import NamedTuple
from zoneinfo import ZoneInfo

import numpy as np
import pandas as pd

from macroslip.constants import HOUR
from macroslip.errors import InputError
from macroslip.input.messages import shown
from macroslip.scada.description import Clock

#: End of a text that tells its offset from UTC.
_OFFSET = r"(?:Z|UTC|[+-]\d\d:?\d\d)\s*$"
#: First time of a record without times; only differences count.
_BEGINNING = pd.Timestamp("2000-01-01", tz="UTC")


class Times(NamedTuple):
    """Times of rows, shape (rows,)."""

    utc: pd.DatetimeIndex  #: Start of the mean; NaT where it is not known
    is_repeated: np.ndarray  #: True in an hour that the clock shows twice, where `utc` is in doubt
    has_offset: bool  #: True if the texts have their offset from UTC


def consecutive_times(count: int, first: int, step: float) -> Times:
    """Times of rows that follow one another: `count` rows from row `first` on, `step` [s] each."""
    seconds = step * np.arange(first, first + count)
    offsets = pd.to_timedelta(seconds, unit="s")
    is_repeated = np.zeros(count, dtype=bool)
    return Times(pd.DatetimeIndex(_BEGINNING + offsets), is_repeated, True)


def utc_times(values: pd.Series, clock: Clock, where: str) -> Times:
    """Times of rows in UTC, of the start of each mean.

    An offset in the text counts, else the zone of the clock; a time without either is taken as it
    is. Of the hour that clocks of a zone show twice no row can be placed: its rows are marked.

    Raises InputError if no time can be read.

    Examples
    --------
    >>> clock = Clock(column="t", zone="Europe/Paris", stamp="end")
    >>> utc_times(pd.Series(["2015-07-01 12:10:00"]), clock, "").utc[0]
    Timestamp('2015-07-01 10:00:00+0000', tz='UTC')
    """
    if pd.api.types.is_numeric_dtype(values):
        raise InputError(
            f"the times are numbers, such as {shown(values.iloc[0])}",
            where=where,
            allowed="dates with times, as text or as dates of the table",
        )
    is_date = pd.api.types.is_datetime64_any_dtype(values)
    has_offset = False
    if is_date:
        has_offset = values.dt.tz is not None
    else:
        texts = values.astype("string")
        known = texts.dropna()
        has_offset = bool(len(known)) and bool(known.str.contains(_OFFSET, regex=True).all())
        values = _parsed(texts, clock, where)
    index = pd.DatetimeIndex(values)
    index = index.tz_localize("UTC") if index.tz is None else index.tz_convert("UTC")
    repeated = np.zeros(len(index), dtype=bool)
    if not has_offset and clock.zone is not None:
        naive = index.tz_localize(None)
        zone = ZoneInfo(clock.zone)
        placed = naive.tz_localize(zone, ambiguous="NaT", nonexistent="NaT")
        # Either of the two times tells the month in which the row is counted.
        earlier = naive.tz_localize(zone, ambiguous=repeated, nonexistent="NaT")
        index = earlier.tz_convert("UTC")
        repeated = np.asarray(placed.isna() & ~index.isna())
    if clock.stamp == "end":
        index = index - pd.Timedelta(seconds=clock.step)
    return Times(index.as_unit("ns"), repeated, has_offset)


def _parsed(texts: pd.Series, clock: Clock, where: str) -> pd.Series:
    """Texts as dates; those without an offset as if they were UTC."""
    form = clock.format or "ISO8601"
    dates = pd.to_datetime(texts, format=form, utc=True, errors="coerce")
    unread = texts.notna() & dates.isna()
    if bool(unread.all()) or unread.mean() > 0.5:
        example = "empty"
        if bool(unread.any()):
            example = texts[unread].iloc[0]
        raise InputError(
            f"the time {shown(example)} cannot be read",
            where=where,
            allowed=clock.format or "ISO 8601, such as 2015-01-01T00:10:00+01:00",
            remedy="Give time.format, such as '%d.%m.%Y %H:%M' for 31.12.2015 23:50.",
        )
    return dates


def hours_shown_twice(utc: pd.DatetimeIndex, differs: np.ndarray, step: float) -> np.ndarray:
    """Rows in hours of which a record without zone holds two different copies.

    Parameters
    ----------
    utc : DatetimeIndex, shape (rows,)
        Times as they are written.
    differs : ndarray of bool, shape (rows,)
        True where a row repeats the time of another row with other values.
    step : float
        Time from row to row [s].

    Returns
    -------
    ndarray of bool, shape (rows,)
        True in an hour at least half of whose rows are there twice.
    """
    number, _ = pd.factorize(utc.floor("h"))
    twice = np.bincount(number, weights=differs)
    rows_of_half_an_hour = max(0.5 * HOUR / step, 2.0)
    is_twice = twice >= rows_of_half_an_hour
    return is_twice[number]
