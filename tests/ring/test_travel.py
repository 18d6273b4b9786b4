"""Path and orbits of rollers against dense sums and root finding."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from macroslip.ring.orbit import orbit_times, travel

RATIO = 0.4539

histories = st.lists(st.tuples(st.floats(0.01, 20.0), st.floats(-4.0, 4.0)), min_size=2, max_size=8)


def dense_path(time, speed, ratio, until):
    """∫|Ω| dt by the midpoint rule on pieces that do not change sign."""
    total = 0.0
    for k in range(time.size - 1):
        start, end = time[k], min(time[k + 1], until)
        if end <= start:
            break
        cuts = [start, end]
        if speed[k] * speed[k + 1] < 0.0:
            zero = time[k] + (time[k + 1] - time[k]) * speed[k] / (speed[k] - speed[k + 1])
            cuts = [start, *([zero] if start < zero < end else []), end]
        for low, high in itertools.pairwise(cuts):
            # The midpoint rule is exact for a linear integrand.
            total += abs(np.interp(0.5 * (low + high), time, speed)) * (high - low)
    return abs(ratio) * total


def arrays(history):
    return np.cumsum([step for step, _ in history]), np.array([speed for _, speed in history])


@given(histories)
@settings(deadline=None, max_examples=100)
def test_path_counts_forth_and_back(history):
    time, speed = arrays(history)
    path = travel(time, speed, RATIO)
    assert path[0] == 0.0 and np.all(np.diff(path) >= 0.0)
    assert path == pytest.approx(
        [dense_path(time, speed, RATIO, t) for t in time], rel=1e-11, abs=1e-12
    )
    # Which way round does not matter, neither of the shaft nor of the orbit.
    assert travel(time, -speed, RATIO) == pytest.approx(path, rel=1e-15, abs=0.0)
    assert travel(time, speed, -RATIO) == pytest.approx(path, rel=1e-15, abs=0.0)


@given(histories)
@settings(deadline=None, max_examples=60)
def test_orbits_end_where_the_path_says(history):
    time, speed = arrays(history)
    times = orbit_times(time, speed, RATIO)
    total = dense_path(time, speed, RATIO, time[-1])
    assert abs(times.size - total / (2 * math.pi)) <= 1.0 + 1e-9
    assert np.all(np.diff(times) > 0.0)
    for number, end in enumerate(times, start=1):
        assert time[0] < end <= time[-1]
        assert dense_path(time, speed, RATIO, end) == pytest.approx(
            2 * math.pi * number, rel=1e-10, abs=1e-10
        )


def test_whole_number_of_orbits_keeps_the_last():
    # Sums of many samples round; the orbit that ends with the record still counts.
    for samples in (2, 9, 15, 101, 527, 543, 1001, 12001, 19999):
        time = np.linspace(0.0, 12.0, samples)
        times = orbit_times(time, np.full(samples, 2.0 * math.pi), 0.25)
        assert times == pytest.approx([4.0, 8.0, 12.0], rel=1e-12, abs=0.0)
        assert times[-1] <= 12.0


def test_a_shaft_may_turn_round_at_a_sample_but_for_rounding():
    time = np.arange(41) / 2
    speed = 2.0 * math.pi * np.cos(np.pi * time)
    assert 0.0 < abs(speed[1]) < 1e-14
    times = orbit_times(time, speed, 1.0)
    assert times == pytest.approx(2.0 * np.arange(1, 11), rel=1e-12)


def test_standstill_completes_nothing():
    time = np.array([0.0, 50.0, 100.0])
    assert travel(time, np.zeros(3), RATIO).tolist() == [0.0, 0.0, 0.0]
    assert orbit_times(time, np.zeros(3), RATIO).size == 0
    # An orbit that ends as the shaft stops, ends there, not later.
    time, speed = (
        np.array([0.0, 2 * math.pi, 2 * math.pi + 1e-9, 50.0]),
        np.array([1.0, 1.0, 0.0, 0.0]),
    )
    assert orbit_times(time, speed, 1.0) == pytest.approx([2 * math.pi], rel=1e-9, abs=0.0)
