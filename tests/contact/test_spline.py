"""Axes and coefficients of splines against SciPy's."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import make_interp_spline

from macroslip.contact.spline import (
    NOWHERE,
    Axis,
    axis,
    axis_middles,
    axis_nodes,
    cell_of,
    read_only,
    spline_coefficients,
    tensor_coefficients,
)

WEIGHTS = np.array([1.0, 4.0, 1.0, 0.0]) / 6.0, np.array([1.0, 23.0, 23.0, 1.0]) / 48.0


@given(first=st.floats(-10.0, 10.0), length=st.floats(0.1, 30.0), spacing=st.floats(0.05, 1.0))
def test_an_axis_reaches_from_end_to_end(first, length, spacing):
    one = axis(first, first + length, spacing)
    nodes, middles = axis_nodes(one), axis_middles(one)
    assert nodes[0] == first and nodes[-1] == pytest.approx(first + length, abs=1e-12)
    assert one.cells >= 4 and 1.0 / one.per_spacing <= spacing * (1.0 + 1e-9)
    np.testing.assert_allclose(middles, 0.5 * (nodes[1:] + nodes[:-1]), atol=1e-12)
    for number, middle in enumerate(middles):
        cell, place = cell_of(one, middle)
        assert cell == number and place == pytest.approx(0.5)


def test_outside_an_axis_there_is_no_cell():
    one = Axis(1.0, 2.0, 4)
    assert [cell_of(one, x)[0] for x in (0.999, 1.0, 2.999, 3.0, np.nan, np.inf)] == [-1, 0, 3, -1, -1, -1]
    assert cell_of(NOWHERE, 0.0)[0] == -1


def test_coefficients_are_those_of_the_spline_without_knots_next_to_the_ends():
    x = np.arange(9.0)
    values = np.random.default_rng(2).normal(size=(9, 3))
    found = spline_coefficients(values, 0)
    expected = make_interp_spline(x, values, k=3, bc_type="not-a-knot")
    for cell in range(8):
        for place, weights in zip((0.0, 0.5), WEIGHTS, strict=True):
            np.testing.assert_allclose(weights @ found[cell : cell + 4], expected(cell + place), atol=1e-12)


def test_a_tensor_spline_is_a_spline_of_splines_and_not_to_be_written():
    values = np.random.default_rng(3).normal(size=(6, 7, 4))
    found = tensor_coefficients(values, 2)
    np.testing.assert_allclose(found, spline_coefficients(spline_coefficients(values, 1), 0), atol=1e-12)
    assert found.shape == (8, 9, 4) and found.flags.c_contiguous and not found.flags.writeable
    assert not read_only(np.zeros((3, 4)).T).flags.writeable
