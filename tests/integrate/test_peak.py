"""Peaks between samples against maxima of known functions."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from macroslip.integrate.peak import follow_peak, follow_step, start_peak, vertex
from macroslip.integrate.record import new_record
from macroslip.integrate.tuning import HIGHEST_RISE


@pytest.fixture
def record():
    return new_record(np.array([0.0, 10.0, 20.0]), np.empty(0), 1.0)


def follow(record, times, power, orbit=0):
    samples = np.empty((2, 4))
    start_peak(samples, times[0], power(times[0]), 0.0, 0.0)
    for time in times[1:]:
        follow_peak(record, orbit, samples, time, power(time), 0.0, 0.0)
    return record.peak_power[orbit, 0]


@given(top=st.floats(-0.9, 0.9), height=st.floats(0.1, 100.0), bend=st.floats(0.1, 10.0))
@settings(deadline=None)
def test_vertex_of_a_parabola_is_exact(top, height, bend):
    def parabola(t):
        return height - bend * (t - top) ** 2

    middle = round(top)
    samples = (middle - 1.1, middle, middle + 0.9) if middle == 0 else (middle - 1.0, middle, middle + 1.0)
    values = [parabola(t) for t in samples]
    found = vertex(samples[0], values[0], samples[1], values[1], samples[2], values[2])
    assert found == pytest.approx(height, rel=1e-12, abs=1e-9)


def test_a_straight_line_has_no_vertex():
    assert vertex(0.0, 1.0, 1.0, 2.0, 2.0, 3.0) == 2.0


def test_error_of_a_smooth_peak_is_of_third_order(record):
    """A parabola through three samples errs in proportion to the spacing cubed at least."""
    errors = []
    for step in (0.4, 0.2, 0.1):
        one = new_record(np.array([0.0, 10.0]), np.empty(0), 1.0)
        times = np.arange(0.13, 5.0, step)
        errors.append(abs(follow(one, times, lambda t: math.exp(math.sin(t))) - math.e))
    assert errors[0] < 5e-3 * math.e
    assert errors[2] < errors[0] / 4**2.5


def test_a_kink_adds_a_tenth_at_most(record):
    found = follow(record, [0.0, 1.0, 2.0, 3.0], lambda t: max(0.0, 1.0 - 20.0 * abs(t - 1.3)) + (t == 1.0))
    assert 1.0 <= found <= HIGHEST_RISE


def test_uneven_samples_are_not_extrapolated(record):
    times = [0.0, 1e-3, 1.0]
    values = dict(zip(times, (0.9, 1.0, 0.5), strict=True))
    assert follow(record, times, values.__getitem__) == 1.0


def test_a_step_is_the_same_as_its_three_stages():
    rng = np.random.default_rng(5)
    for _ in range(50):
        one, other = (new_record(np.array([0.0, 10.0]), np.empty(0), 1.0) for _ in range(2))
        left, right = np.empty((2, 4)), np.empty((2, 4))
        powers = rng.uniform(0.0, 1.0, (31, 3)) * rng.uniform(0.0, 5.0, (31, 1))
        times = np.cumsum(rng.uniform(0.1, 1.0, 31)) * 0.3
        for samples in (left, right):
            start_peak(samples, times[0], *powers[0])
        for k in range(1, 31, 3):
            for stage in range(k, k + 3):
                follow_peak(one, 0, left, times[stage], *powers[stage])
            follow_step(other, 0, right, powers[k - 1], times[k : k + 3], *powers[k : k + 3].T)
            np.testing.assert_array_equal(right, left)
        np.testing.assert_array_equal(other.peak_power, one.peak_power)


def test_outside_all_orbits_nothing_is_booked(record):
    follow(record, [0.0, 1.0, 2.0], lambda t: 5.0, orbit=-1)
    assert (record.peak_power == 0.0).all()
