import numpy as np
import pandas as pd
import pytest
from scipy.integrate import trapezoid

from macroslip.scada.windows import unbroken_windows


def times(rows: int) -> pd.DatetimeIndex:
    return pd.date_range("2024-05-01", periods=rows, freq="10min", tz="UTC")


def test_a_day_without_break_has_eleven_windows_that_share_their_ends():
    windows = unbroken_windows(times(144), np.ones(144, bool), np.zeros(144, bool), 600.0)
    assert windows.first.tolist() == list(range(0, 132, 12))


def test_no_window_crosses_a_gap_a_dropped_row_or_a_jump():
    rows = 400
    random = np.random.default_rng(5)
    time = times(rows).delete([100, 101])
    usable = random.random(time.size) > 0.02
    jump = random.random(time.size) > 0.98
    windows = unbroken_windows(time, usable, jump, 600.0)
    assert len(windows) > 3
    for rows_of_window in windows.rows:
        assert usable[rows_of_window].all()
        assert not jump[rows_of_window[1:]].any()
        assert time[rows_of_window[-1]] - time[rows_of_window[0]] == pd.Timedelta(hours=2)


def test_no_stretch_of_two_hours_is_left_out():
    usable = np.ones(40, dtype=bool)
    usable[13] = False
    windows = unbroken_windows(times(40), usable, np.zeros(40, bool), 600.0)
    assert windows.first.tolist() == [0, 14, 26]


def test_means_are_those_of_the_trapezoidal_rule():
    values = np.random.default_rng(1).normal(size=60)
    windows = unbroken_windows(times(60), np.ones(60, bool), np.zeros(60, bool), 600.0)
    expected = [trapezoid(values[rows], dx=1.0 / 12.0) for rows in windows.rows]
    assert windows.mean(values) == pytest.approx(expected, rel=1e-12)
    slope = 0.3 * np.arange(60)
    assert windows.rate(slope) == pytest.approx(1.8, rel=1e-12)
