"""The closed patch integral against quadrature, the polylogarithm form and complex-step derivatives."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from macroslip.traction import crook_patch_integral
from macroslip.traction.patch_integral import moment_of_coth, patch_integral

# Where the code changes its formula, and neighbours at both sides.
COOL_LOG, SMALL_P, MEDIUM_P, LARGE_U = 0.5 * math.log(0.02), 0.4, 1.2, 1.1
EDGES_P = [0.0, 1e-300, 1e-12, 1e-6, 1e-3, 0.05, 0.999, 1.001, 2.0, 3.3, 5.0, 10.0, 20.0, 31.0, 45.0, 60.0] + [
    edge * side for edge in (SMALL_P, MEDIUM_P, 0.5, 1.0) for side in (1 - 1e-9, 1.0, 1 + 1e-9)
]
NODES, WEIGHTS = np.polynomial.legendre.leggauss(40)
PANELS = 24


def quadrature(p, log_q0):
    """Φ and its derivatives by ln q0 and by P: ∫₀¹ s e^{Ps} g(B0 e^{Ps}) ds by Gauss panels, complex steps for slopes.

    The integrand is positive and analytic within π/2 of the real axis of ln q, and panels are at most 1.25 wide there,
    so that the sum is exact to rounding.
    """
    p, log_q0 = np.broadcast_arrays(np.asarray(p, dtype=complex), np.asarray(log_q0, dtype=complex))
    s = ((np.arange(PANELS)[:, None] + 0.5 + 0.5 * NODES) / PANELS).ravel()
    weights = np.tile(0.5 * WEIGHTS / PANELS, PANELS)

    def integral(p, log_q0):
        q = np.exp(log_q0[..., None] + 0.5 * p[..., None] * s)
        # For tiny q the complex arcsinh of some libraries loses the imaginary part.
        ratio = np.where(abs(q) < 1e-3, 1 - q**2 * (2 / 3 - 8 / 15 * q**2), 0)
        ratio = np.where(abs(q) < 1e-3, ratio, np.log(q + np.sqrt(1 + q**2)) / (q * np.sqrt(1 + q**2)))
        return (weights * s * np.exp(p[..., None] * s) * ratio).sum(axis=-1)

    tiny = 1e-30
    by_slip = integral(p, log_q0 + 1j * tiny)
    return by_slip.real, by_slip.imag / tiny, integral(p + 1j * tiny, log_q0).imag / tiny


def check(p, log_q0, rel=2e-13, slope_rel=1e-12):
    p, log_q0 = np.broadcast_arrays(p, log_q0)
    found = crook_patch_integral(p, np.exp(log_q0))
    value, by_slip, by_exponent = quadrature(p, log_q0)
    assert found[0] == pytest.approx(value, rel=rel, abs=0.0)
    assert np.all(abs(found[1] - by_slip) <= slope_rel * value)
    assert np.all(abs(found[2] - by_exponent) <= slope_rel * value)


def test_value_and_slopes_over_the_whole_range():
    # B0 from 1e-40 to 1e10, that is ln q0 from −46 to 11.5.
    p, log_q0 = np.meshgrid(EDGES_P, 0.5 * math.log(10.0) * np.linspace(-40.0, 10.0, 51))
    check(p.ravel(), log_q0.ravel())


@pytest.mark.parametrize("side", [-1e-6, -1e-12, 0.0, 1e-12, 1e-6, 1e-3, 0.1, 1.0])
def test_both_sides_of_the_changes_of_formula(side):
    p = np.array(EDGES_P)
    # q1 = q0 e^{P/2} at the end of the series for little heating; u1 and u0 at the end of the power series of M.
    check(p, COOL_LOG - 0.5 * p + side)
    check(p, math.log(math.sinh(LARGE_U)) - 0.5 * p + side)
    check(p, np.full(p.size, math.log(math.sinh(LARGE_U))) + side)


@given(st.floats(0.0, 60.0), st.floats(-40.0, 10.0))
@settings(deadline=None, max_examples=150)
def test_random_places(p, log_b0):
    check(p, 0.5 * math.log(10.0) * log_b0)


def g(b):
    return mpmath.asinh(mpmath.sqrt(b)) / mpmath.sqrt(b * (1 + b)) if b else mpmath.mpf(1)


def high_precision(p, b0):
    """Φ by mpmath's own quadrature of the definition, in panels."""
    p, b0 = mpmath.mpf(p), mpmath.mpf(b0)
    panels = max(1, math.ceil(p / 4))
    return mpmath.quad(lambda s: s * mpmath.exp(p * s) * g(b0 * mpmath.exp(p * s)), mpmath.linspace(0, 1, panels + 1),
                       method="gauss-legendre", maxdegree=5)  # fmt: skip


@pytest.mark.parametrize("p", [0.0, 1e-3, 0.25, 1.19, 1.21, 5.0, 23.9, 60.0])
@pytest.mark.parametrize("b0", [1e-40, 1e-16, 1e-6, 1.0, 1e10])
def test_agrees_with_high_precision_quadrature(p, b0):
    with mpmath.workdps(25):
        exact = float(high_precision(p, b0))
    assert patch_integral(p, math.sqrt(b0))[0] == pytest.approx(exact, rel=1e-12, abs=0.0)


def polylogarithms(p, q0):
    """Φ in the closed form with dilogarithm and trilogarithm, which cancels and so needs many digits."""
    u0, u1 = mpmath.asinh(q0), mpmath.asinh(q0 * mpmath.exp(p / 2))

    def j(u):
        decay = mpmath.exp(-2 * u)
        parts = u * mpmath.polylog(2, decay) / 2 + mpmath.polylog(3, decay) / 4
        return u**3 / 3 - mpmath.ln2 * u**2 / 2 + parts

    bracket = j(u1) - j(u0) - mpmath.log(q0) * (u1**2 - u0**2) / 2
    return bracket * (2 / p) ** 2 / q0**2


@pytest.mark.parametrize("p", [0.2, 0.3, 1.1, 1.3, 5.0, 20.0, 60.0])
@pytest.mark.parametrize("q0", [1e-15, 1e-4, 0.03, 0.7, 20.0, 1e5])
def test_agrees_with_the_polylogarithm_form_and_its_derivatives(p, q0):
    with mpmath.workdps(60):
        p, q0 = mpmath.mpf(p), mpmath.mpf(q0)
        exact = polylogarithms(p, q0)
        step = mpmath.mpf(10) ** -12
        by_slip = (polylogarithms(p, q0 * (1 + step)) - polylogarithms(p, q0 * (1 - step))) / (2 * step)
        by_exponent = (polylogarithms(p + step, q0) - polylogarithms(p - step, q0)) / (2 * step)
        exact, by_slip, by_exponent = float(exact), float(by_slip), float(by_exponent)
    found = patch_integral(float(p), float(q0))
    assert found[0] == pytest.approx(exact, rel=1e-12, abs=0.0)
    assert found[1:] == pytest.approx((by_slip, by_exponent), abs=1e-11 * exact)


CHECK_VALUES = [
    (5.0, 1.0, 1.1605519482465), (20.0, 1e-8, 10921939.2718642),
    (31.0, 1e-3, 3799.648428429768), (0.5, 1e-16, 0.702557458599744),
]  # fmt: skip


@pytest.mark.parametrize(("p", "b0", "expected"), CHECK_VALUES)
def test_published_check_values(p, b0, expected):
    assert patch_integral(p, math.sqrt(b0))[0] == pytest.approx(expected, rel=2e-14, abs=0.0)


@pytest.mark.parametrize("p", [0.0, 1e-9, 0.1, 0.4, 0.999999, 1.0, 1.2, 5.0, 60.0, 350.0])
def test_cold_patch_is_the_linear_limit(p):
    with mpmath.workdps(40):
        x = mpmath.mpf(p)
        series = mpmath.nsum(lambda k: x**k / (mpmath.factorial(k) * (k + 2)), [0, mpmath.inf]) if p < 0.01 else None
        value = series if p < 0.01 else (mpmath.exp(x) * (x - 1) + 1) / x**2
        # ∫ s² e^{xs} ds
        slope = (mpmath.exp(x) - 2 * value) / x if p > 1e-12 else mpmath.mpf(1) / 3
        value, slope = float(value), float(slope)
    found = patch_integral(p, 0.0)
    assert found == pytest.approx((value, 0.0, slope), rel=2e-14, abs=0.0)


def test_cold_patch_stays_a_number_beyond_the_range():
    # e^{2P} is beyond floating point here, though the value is not.
    assert all(math.isfinite(part) for part in patch_integral(650.0, 0.0))


@pytest.mark.parametrize("u", [0.0, 1e-8, 0.01, 0.5, 1.0, 1.1 - 1e-12, 1.1, 1.1 + 1e-12, 2.0, 10.0, 45.0])
def test_moment_of_coth(u):
    with mpmath.workdps(30):
        panels = mpmath.linspace(0, u, 2 + int(u))
        exact = float(mpmath.quad(lambda t: t * t * mpmath.coth(t) if t else mpmath.mpf(0), panels)) if u else 0.0
    assert moment_of_coth(u) == pytest.approx(exact, rel=1e-15 * 4, abs=0.0)


def test_elementwise_function_broadcasts():
    p, q0 = np.array([0.5, 5.0, 20.0]), np.array([[1e-8], [1.0]])
    parts = crook_patch_integral(p, q0)
    assert [part.shape for part in parts] == [(2, 3)] * 3
    assert [part[1, 2] for part in parts] == list(patch_integral(20.0, 1.0))
    assert [float(part) for part in crook_patch_integral(5.0, 1.0)] == list(patch_integral(5.0, 1.0))
