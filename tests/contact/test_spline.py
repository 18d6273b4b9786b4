"""Axes, coefficients and look-ups of cubic splines against SciPy's."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import BSpline, NdBSpline, make_interp_spline

from macroslip.compiled import jit
from macroslip.contact.look_up import PLANE, in_plane, log_load, log_speed
from macroslip.contact.spline import (
    CHANNELS,
    axis,
    spline_coefficients,
    spline_value,
    splines_in_cube,
    splines_in_square,
)
from macroslip.contact.table import Box, Tables, write_plane

SHAPE = (9, 7, 12)
COEFFICIENTS = np.random.default_rng(4).normal(size=SHAPE)
#: Four splines on one grid: multiples of one spline, each with a constant of its own.
FOUR = np.stack([COEFFICIENTS * (n + 1) + n for n in range(CHANNELS)], axis=-1)
#: Knots that make coefficient n the one at n − 1: the cell i of a look-up is the interval from i to i + 1.
KNOTS = tuple(np.arange(-3.0, count + 1.0) for count in SHAPE)
places = [st.floats(0.0, count - 3.0) for count in SHAPE]


@jit
def one_in_cube(table, start, strides, places):
    return spline_value(table, start, strides, places)


@jit
def four_in_cube(table, start, strides, places):
    return splines_in_cube(table, start, strides, places)


@jit
def four_in_square(table, start, stride, t, u):
    return splines_in_square(table, start, stride, t, u)


@jit
def plane_at(plane, tables, load, speed):
    return in_plane(plane, tables, log_load(load), log_speed(speed))


def split(position, count):
    """Cell and place in it."""
    cell = min(int(position), count - 4)
    return cell, position - cell


@given(first=st.floats(-10.0, 10.0), length=st.floats(0.1, 30.0), spacing=st.floats(0.05, 1.0))
def test_an_axis_reaches_from_end_to_end(first, length, spacing):
    grid = axis(first, first + length, spacing)
    assert grid.nodes[0] == first and grid.nodes[-1] == pytest.approx(first + length, abs=1e-12)
    assert grid.cells >= 4 and 1.0 / grid.per_spacing <= spacing * (1.0 + 1e-9)
    np.testing.assert_allclose(grid.middles, 0.5 * (grid.nodes[1:] + grid.nodes[:-1]), atol=1e-12)


def test_coefficients_are_those_of_the_spline_without_knots_next_to_the_ends():
    x = np.arange(9.0)
    values = np.random.default_rng(2).normal(size=(9, 3))
    spline = BSpline(np.arange(-3.0, 12.0), spline_coefficients(values, 1), 3)
    expected = make_interp_spline(x, values, k=3, bc_type="not-a-knot")
    fine = np.linspace(0.0, 8.0, 100)
    np.testing.assert_allclose(spline(fine), expected(fine), atol=1e-12)


def test_cubics_are_exact_in_every_direction():
    def cubic(x, y, z):
        return (1.0 + x - 0.3 * x**3) * (2.0 - y**2 + 0.1 * y**3) * (z - 0.05 * z**3)

    axes = [np.arange(float(count)) for count in (6, 5, 7)]
    coefficients = spline_coefficients(cubic(*np.meshgrid(*axes, indexing="ij")), 3)
    assert coefficients.shape == (8, 7, 9) and coefficients.flags.c_contiguous
    flat, random = coefficients.ravel(), np.random.default_rng(1)
    for position in random.uniform(0.0, 1.0, (50, 3)) * [5.0, 4.0, 6.0]:
        (i, t), (k, s), (j, u) = (
            split(coordinate, count) for coordinate, count in zip(position, (8, 7, 9), strict=True)
        )
        value = one_in_cube(flat, (i * 7 + k) * 9 + j, (63, 9), (t, s, u))
        assert value == pytest.approx(cubic(*position), rel=1e-11, abs=1e-10)


@given(x=places[0], y=places[1], z=places[2])
def test_splines_in_a_cube_and_their_derivatives(x, y, z):
    spline = NdBSpline(KNOTS, COEFFICIENTS, 3)
    (i, t), (k, s), (j, u) = (
        split(coordinate, count) for coordinate, count in zip((x, y, z), SHAPE, strict=True)
    )
    start = (i * SHAPE[1] + k) * SHAPE[2] + j
    value = one_in_cube(COEFFICIENTS.ravel(), start, (SHAPE[1] * SHAPE[2], SHAPE[2]), (t, s, u))
    assert value == pytest.approx(float(spline((x, y, z))), abs=1e-12)
    strides = CHANNELS * SHAPE[1] * SHAPE[2], CHANNELS * SHAPE[2]
    channels = four_in_cube(FOUR.ravel(), CHANNELS * start, strides, (t, s, u))
    for order, values in zip(((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)), channels, strict=True):
        constant = np.arange(4.0) if order == (0, 0, 0) else 0.0
        expected = float(spline((x, y, z), nu=order)) * np.arange(1.0, 5.0) + constant
        np.testing.assert_allclose(values, expected, atol=1e-12)


@given(x=places[0], y=places[1])
def test_splines_in_a_square_and_their_derivatives(x, y):
    spline = NdBSpline(KNOTS[:2], COEFFICIENTS[..., 0], 3)
    (i, t), (j, u) = (
        split(coordinate, count) for coordinate, count in zip((x, y), SHAPE[:2], strict=True)
    )
    table, stride = FOUR[:, :, 0].ravel(), CHANNELS * SHAPE[1]
    channels = four_in_square(table, i * stride + CHANNELS * j, stride, t, u)
    for order, values in zip(((0, 0), (1, 0), (0, 1)), channels, strict=True):
        constant = np.arange(4.0) if order == (0, 0) else 0.0
        expected = float(spline((x, y), nu=order)) * np.arange(1.0, 5.0) + constant
        np.testing.assert_allclose(values, expected, atol=1e-12)


@pytest.fixture(scope="module")
def plane():
    """ln Q + 2 ln u and a wave, over loads from 1 N and speeds from 1 mm/s."""
    record, tables = np.zeros(1, PLANE), Tables()
    tables.add(np.full(7, np.nan))

    def values(load, speed):
        return np.log(load) + 2.0 * np.log(speed), np.sin(np.log(load)) * np.cos(np.log(speed))

    write_plane(record[0], tables, values, 1.0, 1e-3, Box(1e4, 0.0, 1.0, 1.0))
    return record[0], tables.flat()


@given(load=st.floats(0.01, 9.0).map(math.exp), speed=st.floats(-6.8, 0.6).map(math.exp))
def test_a_plane_is_its_function(plane, load, speed):
    value, by_load, by_speed = plane_at(*plane, load, -speed)
    a, b = math.log(load), math.log(speed)
    assert value == pytest.approx((a + 2.0 * b, math.sin(a) * math.cos(b), 0.0, 0.0), abs=2e-6)
    assert by_load == pytest.approx((1.0, math.cos(a) * math.cos(b), 0.0, 0.0), abs=3e-4)
    assert by_speed == pytest.approx((2.0, -math.sin(a) * math.sin(b), 0.0, 0.0), abs=3e-4)


def test_beyond_its_lightest_and_slowest_state_a_plane_stays_as_it_is(plane):
    light, by_load, by_speed = plane_at(*plane, 1e-5, 0.1)
    assert (
        light[0] == pytest.approx(2.0 * math.log(0.1), abs=1e-9)
        and by_load[0] == 0.0
        and by_speed[0] > 1.9
    )
    slow, by_load, by_speed = plane_at(*plane, 10.0, 0.0)
    assert slow[0] == pytest.approx(math.log(10.0) + 2.0 * math.log(1e-3), abs=1e-9)
    assert by_speed[0] == 0.0 and by_load[0] > 0.9
    assert plane_at(*plane, 0.0, 0.0)[0][0] == pytest.approx(2.0 * math.log(1e-3), abs=1e-9)


def test_tables_are_read_only(plane):
    with pytest.raises(ValueError, match="read-only"):
        plane[1][0] = 0.0
