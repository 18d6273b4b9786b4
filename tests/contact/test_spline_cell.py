"""Cells of cubic B-splines against SciPy's."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numba import TypingError
from scipy.interpolate import BSpline, NdBSpline

from macroslip.compiled import jit
from macroslip.contact.spline_cell import (
    along_line,
    channels_in_cell,
    channels_in_square,
    in_cell,
)

SHAPE = (9, 7, 12)
COEFFICIENTS = np.random.default_rng(4).normal(size=SHAPE)
#: Knots that make coefficient n the one at n − 1: the cell i of a look-up is the interval from i to i + 1.
KNOTS = [np.arange(-3.0, count + 1.0) for count in SHAPE]

places = [st.floats(0.0, count - 3.0) for count in SHAPE]


@jit
def line(coefficients, cell, place):
    return along_line(coefficients, cell, place)


@jit
def cell(coefficients, cells, first, third, weights):
    return in_cell(coefficients, cells, first, third, weights)


@jit
def four_in_cell(coefficients, cells, places):
    return channels_in_cell(coefficients, cells, places)


@jit
def four_in_square(coefficients, cells, places):
    return channels_in_square(coefficients, cells, places)


def split(place, count):
    """Cell and place in it."""
    number = min(int(place), count - 4)
    return number, place - number


def weights(place, derivative=0):
    """Weights of the four coefficients around a place in [0, 1]."""
    return tuple(float(BSpline(np.arange(-3.0, 5.0), np.eye(4)[n], 3)(place, nu=derivative)) for n in range(4))


@given(place=places[2])
def test_a_line(place):
    spline = BSpline(KNOTS[2], COEFFICIENTS[0, 0], 3)
    found = line(COEFFICIENTS[0, 0].copy(), *split(place, SHAPE[2]))
    np.testing.assert_allclose(found, [spline(place), spline(place, nu=1)], atol=1e-13)


@given(x=places[0], y=places[1], z=places[2])
def test_a_cell(x, y, z):
    spline = NdBSpline(tuple(KNOTS), COEFFICIENTS, 3)
    (i, t), (k, s), (j, u) = (split(place, count) for place, count in zip((x, y, z), SHAPE, strict=True))
    for derivative in (0, 1):
        found = cell(COEFFICIENTS, (i, k, j), t, u, weights(s, derivative))
        orders = [(0, derivative, 0), (1, derivative, 0), (0, derivative, 1)]
        expected = [float(spline((x, y, z), nu=order)) for order in orders]
        np.testing.assert_allclose(found, expected, atol=1e-12)


@pytest.mark.parametrize(
    "coefficients", [np.zeros(SHAPE, order="F"), np.zeros(SHAPE, dtype=np.float32), np.zeros(SHAPE[:2])]
)
def test_other_arrays_are_refused_and_not_misread(coefficients):
    with pytest.raises(TypingError, match="coefficients of a spline are an array of float64"):
        cell(coefficients, (0, 0, 0), 0.5, 0.5, (0.0, 0.0, 0.0, 1.0))


@given(x=places[0], y=places[1], z=places[2])
def test_four_splines_in_a_cell(x, y, z):
    four = np.stack([COEFFICIENTS * (n + 1) + n for n in range(4)], axis=-1)
    cells, there = zip(*(split(place, count) for place, count in zip((x, y, z), SHAPE, strict=True)), strict=True)
    spline = NdBSpline(tuple(KNOTS), COEFFICIENTS, 3)
    orders = ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))
    for order, values in zip(orders, four_in_cell(four, cells, there), strict=True):
        constant = np.arange(4.0) if order == (0, 0, 0) else 0.0
        expected = float(spline((x, y, z), nu=order)) * np.arange(1.0, 5.0) + constant
        np.testing.assert_allclose(values, expected, atol=1e-12)


@given(x=places[0], y=places[1])
def test_four_splines_in_a_square(x, y):
    four = np.stack([COEFFICIENTS[..., 0] * (n + 1) + n for n in range(4)], axis=-1)
    cells, there = zip(*(split(place, count) for place, count in zip((x, y), SHAPE[:2], strict=True)), strict=True)
    found = four_in_square(four, cells, there)
    spline = NdBSpline(tuple(KNOTS[:2]), COEFFICIENTS[..., 0], 3)
    for order, values in zip(((0, 0), (1, 0), (0, 1)), found, strict=True):
        expected = float(spline((x, y), nu=order))
        constant = np.arange(4.0) if order == (0, 0) else 0.0
        np.testing.assert_allclose(values, expected * np.arange(1.0, 5.0) + constant, atol=1e-12)
