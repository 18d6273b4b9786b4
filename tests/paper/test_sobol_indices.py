"""Sobol' indices of a fit against those of functions whose indices are known, and a bad fit."""

import math

import numpy as np
import pytest
from scipy.stats import qmc

from paper.uncertainty import Polynomial, explained_variance, fit, sobol_indices

COUNT = 128


def sample(values, count=COUNT, seed=3):
    return qmc.Sobol(values, rng=np.random.default_rng(seed)).random(count)


def test_a_polynomial_of_second_degree_is_found_again_exactly():
    places = sample(12)
    x = 2.0 * places - 1.0
    values = 3.0 + 2.0 * x[:, 0] - x[:, 4] * x[:, 7] + 0.5 * (1.5 * x[:, 2] ** 2 - 0.5)
    polynomial = fit(places, values)
    np.testing.assert_allclose(polynomial(sample(12, seed=8)), _of(sample(12, seed=8)), atol=1e-10)
    first, total = sobol_indices(polynomial)
    # Variances of the terms: 4/3, 1/9 and 0.25/5.
    whole = 4.0 / 3.0 + 1.0 / 9.0 + 0.05
    expected_first, expected_total = np.zeros(12), np.zeros(12)
    expected_first[[0, 2]] = 4.0 / 3.0 / whole, 0.05 / whole
    expected_total[[0, 2, 4, 7]] = (
        4.0 / 3.0 / whole,
        0.05 / whole,
        1.0 / 9.0 / whole,
        1.0 / 9.0 / whole,
    )
    np.testing.assert_allclose(first, expected_first, atol=1e-9)
    np.testing.assert_allclose(total, expected_total, atol=1e-9)
    assert explained_variance(places, values) == pytest.approx(1.0, abs=1e-9)


def _of(places):
    x = 2.0 * places - 1.0
    return 3.0 + 2.0 * x[:, 0] - x[:, 4] * x[:, 7] + 0.5 * (1.5 * x[:, 2] ** 2 - 0.5)


def test_indices_are_those_that_scipy_estimates_of_the_polynomial():
    from scipy import stats

    places = sample(6)
    polynomial = fit(
        places, np.exp(places[:, 0] + 0.4 * places[:, 1] * places[:, 2]) + 0.2 * places[:, 3]
    )
    first, total = sobol_indices(polynomial)
    dists, rng = [stats.uniform()] * 6, np.random.default_rng(1)
    indices = stats.sobol_indices(
        func=lambda x: polynomial(x.T)[None], n=4096, dists=dists, rng=rng
    )
    np.testing.assert_allclose(first, indices.first_order.ravel(), atol=0.01)
    np.testing.assert_allclose(total, indices.total_order.ravel(), atol=0.01)


def test_an_additive_function_of_known_indices_beside_many_idle_values():
    """Sum of exponentials over 23 values, of which three act: first order and total are the same, by quadrature."""
    weights = {0: 1.0, 9: 0.6, 20: 0.3}
    places = sample(23)
    values = sum(weight * np.exp(places[:, k]) for k, weight in weights.items())
    single = (math.e**2 - 1.0) / 2.0 - (math.e - 1.0) ** 2
    whole = sum(weight**2 * single for weight in weights.values())
    first, total = sobol_indices(fit(places, values))
    for k in range(23):
        expected = weights.get(k, 0.0) ** 2 * single / whole
        assert first[k] == pytest.approx(expected, abs=0.02)
        assert total[k] == pytest.approx(expected, abs=0.02)
    assert explained_variance(places, values) > 0.99


def test_what_no_polynomial_foretells_is_not_said_to_be_known():
    places = sample(23)
    noise = np.random.default_rng(5).normal(size=COUNT)
    assert explained_variance(places, noise) < 0.1
    assert explained_variance(places, np.sin(40.0 * places[:, 0])) < 0.1


def test_a_constant_term_alone_has_no_variance():
    constant = Polynomial(np.zeros((1, 4), dtype=int), np.array([2.5]))
    np.testing.assert_array_equal(constant(sample(4)), 2.5)
    assert not any(index.any() for index in sobol_indices(constant))
