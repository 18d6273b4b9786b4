"""Numbers in lanes against the same formulas for one number at a time."""

import math

import numpy as np
import pytest

from macroslip.compiled import jit
from macroslip.contact.lanes import chosen, every, gathered, scattered


@jit
def formula(x, y):
    total = 0.5 * x - y / 3.0
    total += math.exp(-abs(x)) * math.log(abs(y) + 1.0)
    total *= 2.0 - x
    total -= y
    total /= 1.0 + x * x
    return math.copysign(math.copysign(0.25, y), x) + -total / (1.0 - 2.0 / (3.0 + y * y))


@jit
def three(x1, x2, x3, y1, y2, y3):
    return scattered(formula(gathered(x1, x2, x3), gathered(y1, y2, y3)))


@jit
def larger(x1, x2, x3, bound):
    x = gathered(x1, x2, x3)
    return scattered(chosen(x > bound, x, -1.0)), scattered(chosen(bound >= x, 1.0, 0.0)), every(x > bound)


def test_a_formula_in_lanes_is_that_of_each_number():
    for numbers in np.random.default_rng(0).normal(0.0, 3.0, (500, 6)):
        expected = [formula(x, y) for x, y in zip(numbers[:3], numbers[3:], strict=True)]
        assert three(*numbers) == pytest.approx(expected, rel=1e-13, abs=1e-14)


def test_comparisons_choose_in_every_lane():
    assert larger(1.0, 2.0, 3.0, 1.5) == ((-1.0, 2.0, 3.0), (1.0, 0.0, 0.0), False)
    assert larger(1.0, 2.0, 3.0, 0.5) == ((1.0, 2.0, 3.0), (0.0, 0.0, 0.0), True)
    assert larger(1.0, math.nan, 3.0, 0.5)[2] is False


def test_what_is_not_in_lanes_is_the_same_in_all():
    assert scattered(2.0) == (2.0, 2.0, 2.0)
