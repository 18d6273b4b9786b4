"""Pressure-viscosity coefficient of oil families."""

import numpy as np
import pytest

from macroslip.lubricant.base_oil import BASE_OILS
from macroslip.lubricant.temperature import gold


def test_it_is_a_power_law_in_mm2_per_second():
    nu = np.array([10e-6, 100e-6, 1000e-6])
    slope = np.diff(np.log([gold(value, 7.382, 0.1335) for value in nu])) / np.log(10.0)
    assert slope == pytest.approx([0.1335, 0.1335], rel=1e-12)
    assert gold(1e-6, 7.382, 0.1335) == pytest.approx(7.382e-9, rel=1e-14)


def test_families_are_ordered_as_their_friction():
    # Mineral oils have the largest coefficients, polyglycols the smallest.
    alpha = {name: gold(320e-6, oil.gold_factor, oil.gold_exponent) for name, oil in BASE_OILS.items()}
    assert alpha["mineral"] > alpha["pao-mineral"] > alpha["pao"] > alpha["ester"] > alpha["polyglycol"]
    assert all(10e-9 < value < 25e-9 for value in alpha.values())


def test_ranges_hold_their_means():
    for oil in BASE_OILS.values():
        low, mean, high = oil.limiting_shear
        assert 0.02 < low <= mean <= high < 0.07
