"""The step of a held roller by itself: its linear algebra, its stability function, and what it says of its error."""

from __future__ import annotations

import math

import numpy as np
import pytest

from macroslip.integrate.held_step import SIMPSON, held_energy_error, held_update


def test_update_solves_the_linear_equations():
    scale, d2, d3 = 3.0, 7.0, 11.0
    matrix = np.array([[d2, scale], [-4.0 * scale, 3.0 * scale + d3]])
    for rest in ([1.0, -2.0], [0.3, 5.0]):
        np.testing.assert_allclose(matrix @ held_update(scale, d2, d3, *rest), -np.array(rest), rtol=1e-14)


def linear_step(z):
    """Slips at the middle and the end of a step of dv/dt = z v from 1, with the step as unit of time."""
    rest_2, rest_3 = -z, -z
    increment_2, increment_3 = held_update(1.0, -z, -z, rest_2, rest_3)
    return 1.0 + increment_2, 1.0 + increment_3


@pytest.mark.parametrize("z", [-0.1, -1.0, -10.0, -1e3])
def test_stability_function(z):
    assert linear_step(z)[1] == pytest.approx((1.0 + z / 4.0) / (1.0 - 0.75 * z + 0.25 * z * z), rel=1e-12)


def test_the_start_is_forgotten():
    assert max(map(abs, linear_step(-1e9))) < 1e-8


@pytest.mark.parametrize("growth", [0.05, 0.2, 0.5])
def test_energy_error_is_on_the_safe_side_and_of_the_right_order(growth):
    power = [math.exp(growth * t) for t in (0.0, 0.5, 1.0)]
    energy = float(np.dot(SIMPSON, power))
    error = abs(energy - math.expm1(growth) / growth)
    assert 40.0 * error < held_energy_error(energy, 1.0, power[0], power[2]) < 160.0 * error


def test_no_energy_is_no_excuse():
    assert held_energy_error(0.0, 1.0, 0.0, 0.0) == math.inf
