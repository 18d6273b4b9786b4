import numpy as np
import pandas as pd
import pytest

from macroslip.scada.heat_index import cusum, first_flag, index_over


def hours(count: int, start: str = "2024-03-01") -> pd.DatetimeIndex:
    return pd.date_range(start, periods=count, freq="2h", tz="UTC")


def test_the_index_is_a_ratio_of_sums():
    random = np.random.default_rng(3)
    expected = random.uniform(0.5, 2.0, 36)
    measured = 1.2 * expected + random.normal(0.0, 0.1, 36)
    days = index_over(hours(36), measured, expected, "day")
    assert days["windows"].tolist() == [12, 12, 12]
    parts = np.split(measured, 3), np.split(expected, 3)
    assert days["r"].tolist() == pytest.approx(
        [m.sum() / e.sum() for m, e in zip(*parts, strict=True)]
    )
    assert days["start"].tolist() == [pd.Timestamp(f"2024-03-0{day}") for day in (1, 2, 3)]


def test_its_error_is_the_scatter_of_many_records():
    random = np.random.default_rng(8)
    expected = np.linspace(0.8, 1.2, 12)
    tables = [
        index_over(hours(12), expected + random.normal(0.0, 0.3, 12), expected, "day")
        for _ in range(400)
    ]
    indices = np.array([float(table["r"].iloc[0]) for table in tables])
    told = np.sqrt(np.mean([float(table["error"].iloc[0]) ** 2 for table in tables]))
    assert told == pytest.approx(indices.std(), rel=0.1)


def test_periods_with_few_windows_are_left_out():
    start = hours(3).append(hours(5, "2024-03-02"))
    days = index_over(start, np.ones(8), np.ones(8), "day")
    assert days["start"].tolist() == [pd.Timestamp("2024-03-02")]
    assert index_over(start, np.ones(8), np.ones(8), "week").empty


def test_a_step_of_three_tenths_is_flagged_on_the_sixth_day():
    index = np.r_[np.ones(10), np.full(10, 1.3)]
    sums = cusum(index)
    assert sums[:10].tolist() == [0.0] * 10
    days = pd.DataFrame({"start": hours(20), "cusum": sums})
    assert first_flag(days) == days["start"].iloc[15]
    assert first_flag(days.iloc[:15]) is None
