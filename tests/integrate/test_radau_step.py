"""The Radau IIA step by itself: the classical conditions, its order on a nonlinear equation, and its stiff limit."""

from __future__ import annotations

import math

import numpy as np
import pytest

from macroslip.integrate.radau_step import (
    EMBEDDED,
    MATRIX,
    NODES,
    WEIGHTS,
    collocation,
    energy_error,
    newton_update,
    residuals,
    slip_error,
)


def step(force, slope, start, time, h):
    """One step of dv/dt = −F(t, v) with the module's own residuals and Newton update, and mobility 1."""
    z = [0.0, 0.0, 0.0]
    for _ in range(50):
        at = [(time + c * h, start + dz) for c, dz in zip(NODES, z, strict=True)]
        rest = residuals(1 / h, *z, *(force(*point) for point in at))
        update = newton_update(1 / h, *(slope(*point) for point in at), rest)
        z = [a + b for a, b in zip(z, update, strict=True)]
        if max(map(abs, update)) < 1e-15:
            break
    return z


def test_weights_satisfy_the_order_conditions():
    c, b = np.array(NODES), np.array(WEIGHTS)
    for power in range(5):
        assert b @ c**power == pytest.approx(1 / (power + 1), rel=1e-14)
    assert b @ c**5 != pytest.approx(1 / 6, rel=1e-4)
    for power in (1, 2, 3):
        assert MATRIX @ c ** (power - 1) == pytest.approx(c**power / power, rel=1e-13)


def test_embedded_rule_is_of_third_order_and_no_more():
    points = np.array([0.0, *NODES])
    for power in range(3):
        assert abs(energy_error(2.0, *(points**power))) < 1e-14
    assert abs(energy_error(1.0, *(points**3))) > 1e-3
    assert sum(EMBEDDED) == pytest.approx(0.0, abs=1e-15)


def test_order_five_on_a_nonlinear_equation():
    # dv/dt = −v² − sin t + v_exact² has the solution cos t.
    def force(t, v):
        return v * v + math.sin(t) - math.cos(t) ** 2

    def slope(t, v):
        return 2.0 * v

    errors = []
    for steps in (4, 8, 16):
        v, h = 1.0, 1.0 / steps
        for n in range(steps):
            v += step(force, slope, v, n * h, h)[2]
        errors.append(abs(v - math.cos(1.0)))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(orders > 4.7), (errors, orders)


def test_stiff_limit_forgets_the_start_and_follows_the_balance():
    # F = 1e12 (v − 1e-10 cos t): the step must land on the balance whatever it started from.
    z = step(lambda t, v: 1e12 * (v - 0.1 * math.cos(t)), lambda t, v: 1e12, 0.3, 0.0, 0.1)
    assert 0.3 + z[2] == pytest.approx(0.1 * math.cos(0.1), abs=1e-11)


def test_linear_equation_gives_the_stability_function():
    # R(z) = (1 + 2z/5 + z²/20)/(1 − 3z/5 + 3z²/20 − z³/60), Hairer and Wanner table IV.5.6.
    for z in (-0.1, -1.0, -10.0, -1e3):
        found = 1.0 + step(lambda t, v, z=z: -z * v, lambda t, v, z=z: -z, 1.0, 0.0, 1.0)[2]
        exact = (1 + 2 * z / 5 + z * z / 20) / (1 - 3 * z / 5 + 3 * z * z / 20 - z**3 / 60)
        assert found == pytest.approx(exact, rel=1e-10, abs=1e-13)


def test_slip_error_is_of_fourth_order_in_the_step():
    estimates = []
    for h in (0.2, 0.1):
        z = step(lambda t, v: v * v - math.exp(t), lambda t, v: 2 * v, 1.0, 0.0, h)
        estimates.append(abs(slip_error(1 / h, 2.0, 0.0, *z)))
    assert math.log2(estimates[0] / estimates[1]) == pytest.approx(4.0, abs=0.4)


def test_collocation_reproduces_cubics_and_their_rate():
    z = [c**3 - 2 * c for c in NODES]
    for part in (0.0, 0.3, 0.83, 1.0, 1.4):
        increment, rate = collocation(part, *z)
        assert increment == pytest.approx(part**3 - 2 * part, abs=1e-13)
        assert rate == pytest.approx(3 * part**2 - 2, abs=1e-12)
