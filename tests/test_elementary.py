"""Exponential, logarithm, sine, cosine and arc tangent of compiled code against mpmath and the C library."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip.compiled import jit
from macroslip.elementary import arctangent, cosine_and_sine, exponential, logarithm

RANDOM = np.random.default_rng(7)


@jit
def exponentials(x, result):
    for n in range(x.size):
        result[n] = exponential(x[n])


@jit
def logarithms(x, result):
    for n in range(x.size):
        result[n] = logarithm(x[n])


@jit
def cosines_and_sines(angle, result):
    for n in range(angle.size):
        result[n, 0], result[n, 1] = cosine_and_sine(angle[n])


@jit
def arctangents(x, result):
    for n in range(x.size):
        result[n] = arctangent(x[n])


def of(function, x, *shape):
    """Values of a compiled function over an array."""
    x = np.asarray(x, dtype=float)
    result = np.empty((x.size, *shape))
    function(x, result)
    return result


def exact(function, x):
    """Values by 40 digits, rounded once."""
    with mpmath.workdps(40):
        return np.array([float(function(mpmath.mpf(float(argument)))) for argument in x])


def test_exponential_is_good_to_two_units_in_the_last_place():
    x = np.concatenate(
        [RANDOM.uniform(-707.0, 708.0, 2000), RANDOM.uniform(-1.0, 1.0, 2000), [0.0]]
    )
    expected = exact(mpmath.exp, x)
    assert (np.abs(of(exponentials, x) - expected) <= 2.0 * np.spacing(expected)).all()


def test_logarithm_is_good_to_two_units_in_the_last_place():
    x = np.concatenate(
        [
            np.exp(RANDOM.uniform(-700.0, 700.0, 2000)),
            RANDOM.uniform(0.5, 2.0, 2000),
            1.0 + RANDOM.uniform(-1e-6, 1e-6, 500),
            [1.0, 0.6875, 1.375, np.nextafter(0.6875, 0.0), np.nextafter(1.375, 0.0)],
        ]
    )
    expected = exact(mpmath.log, x)
    assert (np.abs(of(logarithms, x) - expected) <= 2.0 * np.spacing(np.abs(expected))).all()


def test_cosine_and_sine_of_angles_of_many_turns():
    angle = np.concatenate([RANDOM.uniform(-8.0, 8.0, 2000), RANDOM.uniform(-1e6, 1e6, 2000)])
    expected = np.stack([exact(mpmath.cos, angle), exact(mpmath.sin, angle)], axis=1)
    np.testing.assert_allclose(of(cosines_and_sines, angle, 2), expected, rtol=0.0, atol=2.3e-16)


def test_cosine_and_sine_at_quarters_of_a_turn():
    quarters = np.arange(-9, 10) * math.pi / 2.0
    expected = np.stack([np.cos(quarters), np.sin(quarters)], axis=1)
    np.testing.assert_allclose(of(cosines_and_sines, quarters, 2), expected, rtol=0.0, atol=1e-16)


def test_what_is_no_number_stays_none_and_overflow_has_bounds():
    assert np.isnan(of(exponentials, [math.nan]))[0]
    assert np.isnan(of(logarithms, [math.nan]))[0]
    assert np.isnan(of(cosines_and_sines, [math.nan], 2)).all()
    assert of(logarithms, [math.inf])[0] == math.inf
    small, large = of(exponentials, [-math.inf, math.inf])
    assert 0.0 < small < 1e-300
    assert 1e300 < large < math.inf


@given(st.floats(-700.0, 700.0))
def test_logarithm_undoes_the_exponential(x):
    again = of(logarithms, of(exponentials, [x]))[0]
    assert again == pytest.approx(x, rel=1e-15, abs=4e-16)


def test_python_has_the_c_librarys():
    assert exponential(0.3) == math.exp(0.3)
    assert logarithm(0.3) == math.log(0.3)
    assert cosine_and_sine(0.3) == (math.cos(0.3), math.sin(0.3))


def test_arc_tangent_is_good_to_two_units_in_the_last_place():
    near = np.tan(np.pi / 8.0 * np.array([1.0, 3.0]))
    x = np.concatenate(
        [
            RANDOM.uniform(-4.0, 4.0, 4000),
            RANDOM.choice([-1.0, 1.0], 2000) * np.exp(RANDOM.uniform(-300.0, 300.0, 2000)),
            [0.0, 1.0, -1.0, np.inf, -np.inf],
            near,
            np.nextafter(near, np.inf),
        ]
    )
    expected = exact(mpmath.atan, x)
    assert (np.abs(of(arctangents, x) - expected) <= 2.0 * np.spacing(np.abs(expected))).all()
    assert np.isnan(of(arctangents, [np.nan])).all()
