"""Four logarithms and exponentials at once, against mpmath."""

import math

import numpy as np
from mpmath import mp, mpf

from macroslip.contact.logarithms import exponentials, logarithms, two_logarithms


def four_by_four(function, values):
    return np.array([function(*four) for four in values.reshape(-1, 4)]).ravel()


def distance(found, expected):
    """In units of the last place of the expected values."""
    return np.array(
        [abs(float((mpf(a) - b) / mpf(np.spacing(abs(float(b)))))) for a, b in zip(found, expected, strict=True)]
    )


def test_logarithms_are_those_of_mpmath():
    random = np.random.default_rng(0)
    values = np.concatenate([np.exp(random.uniform(-700.0, 700.0, 2000)), 1.0 + random.uniform(-0.3, 0.4, 2000)])
    with mp.workdps(40):
        expected = [mp.log(mpf(x)) for x in values]
        assert distance(four_by_four(logarithms, values), expected).max() < 3.0


def test_exponentials_are_those_of_mpmath():
    values = np.random.default_rng(1).uniform(-700.0, 700.0, 4000)
    with mp.workdps(40):
        assert distance(four_by_four(exponentials, values), [mp.exp(mpf(x)) for x in values]).max() < 3.0


def test_exact_values():
    assert logarithms(1.0, 1.0, 1.0, 1.0) == (0.0, 0.0, 0.0, 0.0)
    assert exponentials(0.0, 0.0, 0.0, 0.0) == (1.0, 1.0, 1.0, 1.0)
    assert two_logarithms(math.e, -1.0) == (1.0, 0.0)


def test_what_has_no_logarithm_is_beyond_any_table():
    found = logarithms(0.0, math.inf, math.nan, 5e-324)
    assert all(math.isfinite(one) and abs(one) > 700.0 for one in found)
    assert math.isfinite(logarithms(-1.0, 1.0, 1.0, 1.0)[0])
