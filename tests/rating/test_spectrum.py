"""Load duration and damage-equivalent loads of histories whose cycles are known."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip.rating.spectrum import (
    damage_equivalent_load,
    load_duration,
    rainflow_ranges,
    sample_durations,
)


def test_durations_add_up():
    time = np.cumsum(np.random.default_rng(1).uniform(0.01, 0.1, 500))
    assert sample_durations(time).sum() == pytest.approx(time[-1] - time[0], rel=1e-12)
    np.testing.assert_allclose(sample_durations(np.arange(5.0)), [0.5, 1, 1, 1, 0.5])


@given(st.integers(0, 1000), st.integers(1, 30))
def test_shares_add_up_to_one_and_keep_the_mean(seed, classes):
    rng = np.random.default_rng(seed)
    load, weight = rng.normal(0, 1e5, 300), rng.uniform(0, 1, 300)
    edges = np.linspace(load.min(), load.max(), classes + 1)
    shares = load_duration(load, weight, edges)
    assert shares.sum() == pytest.approx(1.0, rel=1e-12)
    middle = 0.5 * (edges[1:] + edges[:-1])
    assert abs(np.dot(shares, middle) - np.average(load, weights=weight)) <= 0.5 * (
        edges[1] - edges[0]
    ) * (1 + 1e-9)


def test_a_sinusoid_is_its_own_equivalent():
    # Ten cycles in ten seconds are one a second: the equivalent range is the range, whatever the slope.
    time = np.linspace(0.0, 10.0, 2001)
    for exponent in (1.0, 4.0, 10.0):
        load = damage_equivalent_load(3e4 * np.sin(2 * np.pi * time), 10.0, exponent)
        assert load == pytest.approx(6e4, rel=0.01)
    # Four times as many cycles: 4^(1/m).
    faster = damage_equivalent_load(3e4 * np.sin(8 * np.pi * time), 10.0, 4.0)
    assert faster == pytest.approx(6e4 * 4**0.25, rel=0.01)
    assert damage_equivalent_load(
        3e4 * np.sin(2 * np.pi * time), 10.0, 4.0, frequency=16.0
    ) == pytest.approx(3e4, rel=0.01)


def test_a_small_cycle_on_a_large_one():
    # ASTM E 1049's example of the method: the small cycle is counted beside the large one, which it interrupts.
    ranges = np.sort(rainflow_ranges(np.array([0.0, 10.0, 4.0, 7.0, 0.0])))
    np.testing.assert_allclose(ranges, [3.0, 10.0], atol=10 / 256)
    both = damage_equivalent_load([0.0, 10.0, 4.0, 7.0, 0.0], 1.0, 3.0)
    assert both == pytest.approx((3.0**3 + 10.0**3) ** (1 / 3), rel=0.01)


def test_what_does_not_vary_has_no_cycles():
    assert damage_equivalent_load(np.full(100, 5e5), 10.0, 4.0) == 0.0
    assert damage_equivalent_load([0.0, 8.0], 1.0, 4.0) == pytest.approx(8.0)  # repeated, one cycle
