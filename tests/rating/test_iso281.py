"""Equivalent load, lives and the modification factor against the standard's own marks."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip.rating.iso import (
    basic_life,
    dynamic_equivalent_load,
    life_modification,
    mean_equivalent_load,
    reference_viscosity,
)


def test_equivalent_load_is_continuous_with_the_standards_factors():
    # e = 1.5 tan, Y1 = 0.45 cot, Y2 = 0.67 cot: at Fa = e Fr both branches give 1.675 Fr.
    alpha = math.radians(11.31)
    factors = 1.5 * math.tan(alpha), 0.45 / math.tan(alpha), 0.67 / math.tan(alpha)
    below, above = dynamic_equivalent_load(1.0, factors[0] * np.array([1 - 1e-12, 1 + 1e-12]), *factors)
    assert below == pytest.approx(1 + 1.5 * 0.45, rel=1e-9)
    assert above == pytest.approx(below, rel=1e-9)
    assert dynamic_equivalent_load(1.0, 0.0, *factors) == 1.0
    assert dynamic_equivalent_load(0.0, -1.0, *factors) == pytest.approx(factors[2])


def test_basic_life():
    assert basic_life(8502e3, 8502e3) == 1e6
    assert basic_life(2.0, 1.0) == pytest.approx(1e6 * 2 ** (10 / 3))
    assert math.isinf(basic_life(1.0, 0.0))


@given(st.lists(st.tuples(st.floats(1e3, 1e6), st.floats(1e-3, 1e3)), min_size=1, max_size=10))
def test_mean_load_has_the_life_of_palmgren_and_miner(parts):
    load, turns = np.array(parts).T
    mean = mean_equivalent_load(load, turns)
    assert turns.sum() / basic_life(1e6, mean) == pytest.approx(np.sum(turns / basic_life(1e6, load)), rel=1e-9)
    assert load.min() * (1 - 1e-12) <= mean <= load.max() * (1 + 1e-12)


def test_mean_load_of_a_shaft_that_stands():
    assert math.isnan(mean_equivalent_load([1.0, 2.0], [0.0, 0.0]))


def test_reference_viscosity():
    at = 2 * math.pi / 60
    # Both branches of the standard meet near 1000 rpm: 45000 n^-0.83 and 4500 n^-0.5.
    assert reference_viscosity(999.999 * at, 0.1) == pytest.approx(reference_viscosity(1000.001 * at, 0.1), rel=0.03)
    assert reference_viscosity(-20 * at, 0.7454) == reference_viscosity(20 * at, 0.7454)
    # Written out: 45000 20^-0.83 100^-0.5 and 4500 2500^-0.5 100^-0.5.
    assert reference_viscosity(20 * at, 0.1) * 1e6 == pytest.approx(4500 * math.exp(-0.83 * math.log(20)), rel=1e-12)
    assert reference_viscosity(2500 * at, 0.1) * 1e6 == pytest.approx(9.0, rel=1e-12)


def test_modification_factor_has_the_limits_of_the_standards_figure():
    # Without fatigue limit or cleanliness all curves begin at 0.1; the one for the thinnest film stays there.
    for kappa in (0.1, 0.3, 0.5, 1.0, 2.0, 4.0):
        assert life_modification(kappa, 1.0, 0.0) == pytest.approx(0.1, rel=1e-12)
        assert life_modification(kappa, 1.0, 1e6) == (50.0 if kappa > 0.1 else 0.1)
    # Each curve has a pole where (1.5859 - A/kappa^B)(e_C C_u/P)^0.4 is 1; near it the factor is at its ceiling.
    pole = (1.0 / (1.5859 - 1.2348)) ** 2.5
    assert life_modification(1.0, 1.0, pole * 0.999) == 50.0
    assert life_modification(1.0, 1.0, 0.05 * pole) < 50.0
    # The branches meet at kappa 0.4 and 1.
    ratio = np.array([0.05, 0.2, 1.0])
    for kappa in (0.4, 1.0):
        below, above = (life_modification(kappa + side * 1e-9, 0.6, ratio) for side in (-1, 1))
        np.testing.assert_allclose(below, above, rtol=2e-3)
    assert np.array_equal(life_modification(7.0, 0.6, ratio), life_modification(4.0, 0.6, ratio))
    assert (
        np.isnan(life_modification(0.09, 1.0, ratio)).all() and np.isnan(life_modification(math.nan, 1.0, ratio)).all()
    )


@given(st.floats(0.1, 4.0), st.floats(0.01, 1.0), st.floats(1e-3, 5.0))
def test_cleaner_thicker_and_lighter_is_never_worse(kappa, contamination, ratio):
    factor = life_modification(kappa, contamination, ratio)
    assert 0.1 <= factor <= 50.0
    # The standard's branches meet but for rounding of their coefficients.
    assert life_modification(min(4.0, 1.1 * kappa), contamination, ratio) >= factor * (1 - 2e-3)
    assert life_modification(kappa, min(1.0, 1.1 * contamination), ratio) >= factor
    assert life_modification(kappa, contamination, 1.1 * ratio) >= factor
