"""Crook's shear stress integrated over the Hertz ellipse, in closed form, without cancellation.

With p = p0 √(1 − ρ²) the integral over the ellipse is one-dimensional: F = 2π a b (η0 Δu/h) Φ, with

    Φ(P, B0) = ∫₀¹ s e^{Ps} g(B0 e^{Ps}) ds,   g(B) = asinh √B/√(B(1 + B)),   P = α_p p0,   B0 = β η0 Δu²/(8k).

Put q = √B0 e^{Ps/2} and u = asinh q. Then Φ = I/(h² q0²) with h = P/2, q0 = √B0 and

    I = ∫₀^h y w(x0 + y) dy = h u1²/2 − [M(u1) − M(u0)]/2,   w = u tanh u,   M(u) = ∫₀^u t² coth t dt,

in which x = ln q, and u0, u1 belong to s = 0 and s = 1. M has a power series for small u and a polylogarithm form for
large u. For small P the bracket cancels and the integral over y, then analytic in a wide neighbourhood, is taken by a
Gauss rule whose error is below round-off; for small B0 e^P the power series of g is integrated term by term. The same I gives
all derivatives: dI/dx0 = h w1 − (u1² − u0²)/2 and dI/dh = h w1.
"""

from __future__ import annotations

import math

import numpy as np
from numba.extending import overload

from macroslip.compiled import jit
from macroslip.contact.lanes import every, gathered, is_lanes, scattered
from macroslip.traction.patch_gauss import G_SERIES, cool_patch, hot_patch


def _power_series_of_m() -> np.ndarray:
    """Coefficients of M(u)/u² in powers of u²: B_2n 2^2n/((2n)! (2n + 2)) = −(−1)^n 2 ζ(2n)/(π^2n (2n + 2)).

    By Riemann's zeta: SciPy's own Bernoulli numbers are good to 12 digits only.
    """
    from scipy.special import zeta

    n = np.arange(1, _SERIES_TERMS)
    return np.concatenate([[0.5], -((-1.0) ** n) * zeta(2.0 * n) / (math.pi ** (2.0 * n) * (n + 1.0))])


_SERIES_TERMS = 18
#: B0 e^P below which the power series of g is used; what its last term leaves out is below 1e-16.
_COOL = 0.02
_G_SERIES = np.array(G_SERIES)
_M_SERIES = _power_series_of_m()
_HALF_ZETA_3 = 0.6010284515797971
#: Largest P served by the Gauss rule, and B0 below which B0 e^P is below `_COOL` up to there.
_LARGEST_P = 1.2
_COOL_START = _COOL * math.exp(-_LARGEST_P)


@jit
def moment_of_coth(u):
    """M(u) = ∫₀^u t² coth t dt for u ≥ 0, to a few units in the last place [-].

    Examples
    --------
    >>> round(moment_of_coth(1.0), 12)
    0.579874655329
    """
    if u < 1.1:
        square = u * u
        total = 0.0
        for k in range(_SERIES_TERMS - 1, -1, -1):
            total = total * square + _M_SERIES[k]
        return total * square
    decay = math.exp(-2.0 * u)
    total = 0.0
    power = decay
    n = 1.0
    while power > 1e-18:
        total += power * (u * u + (u + 0.5 / n) / n) / n
        power *= decay
        n += 1.0
    return u * u * u / 3.0 + _HALF_ZETA_3 - total


@jit
def patch_integral(pressure_exponent, root_heating):
    """Patch integral Φ of Crook's traction over the Hertz ellipse and its derivatives [-].

    Parameters
    ----------
    pressure_exponent : float
        P = α_p p0, 0 to 60.
    root_heating : float
        q0 = √B0 = |Δu| √(β η0/(8k)), 0 to 1e5.

    Returns
    -------
    value : float
        Φ = F/(2π a b η0 Δu/h).
    slope_log_slip : float
        ∂Φ/∂ ln q0 at fixed P; dF/dΔu at fixed film is 2π a b (η0/h)(Φ + slope_log_slip).
    slope_pressure : float
        ∂Φ/∂P at fixed q0.

    Notes
    -----
    Relative error of the value below 1e-12 over P in [0, 60] and B0 in [1e-40, 1e10].

    References
    ----------
    Derivation in the module's docstring; Crook (1961), doi:10.1098/rsta.1961.0014, for the local law.

    Examples
    --------
    >>> round(patch_integral(5.0, 1.0)[0], 12)
    1.160551948246
    """
    p = pressure_exponent
    heating = root_heating * root_heating
    if p < _LARGEST_P:
        return cool_patch(p, heating) if heating < _COOL_START else hot_patch(p, heating)
    growth = math.exp(0.5 * p)
    q1 = root_heating * growth
    if q1 * q1 < _COOL:
        return _patch_by_series(p, heating, growth * growth)
    h = 0.5 * p
    u0 = math.asinh(root_heating)
    u1 = math.asinh(q1)
    w1 = u1 * (q1 / math.sqrt(1.0 + q1 * q1))
    integral = 0.5 * (h * u1 * u1 - (moment_of_coth(u1) - moment_of_coth(u0)))
    slope = h * w1 - 0.5 * (u1 - u0) * (u1 + u0)
    scale = 1.0 / (h * h * heating)
    value = integral * scale
    return value, slope * scale - 2.0 * value, 0.5 * w1 * h * scale - value / h


def patch_of(pressure_exponent, root_heating):
    """`patch_integral` of floats, or of numbers in lanes."""
    return patch_integral(pressure_exponent, root_heating)


@overload(patch_of)
def _patch_of(pressure_exponent, root_heating):
    if not is_lanes(pressure_exponent):
        return lambda pressure_exponent, root_heating: patch_integral(pressure_exponent, root_heating)
    return lambda pressure_exponent, root_heating: _patch_in_lanes(pressure_exponent, root_heating)


@jit
def _patch_in_lanes(p, root_heating):
    if every(p >= _LARGEST_P):
        heating, exp_p = root_heating * root_heating, math.exp(p)
        if every(heating * exp_p < _COOL):
            return _patch_by_series(p, heating, exp_p)
    p1, p2, p3 = scattered(p)
    q1, q2, q3 = scattered(root_heating)
    one, two, three = patch_integral(p1, q1), patch_integral(p2, q2), patch_integral(p3, q3)
    return gathered(one[0], two[0], three[0]), gathered(one[1], two[1], three[1]), gathered(one[2], two[2], three[2])


def _settled(term, value):
    """Whether a term adds nothing to a sum, in any lane."""
    return abs(term) < 1e-17 * value


@overload(_settled)
def _settled_of(term, value):
    if is_lanes(term):
        return lambda term, value: every(abs(term) < 1e-17 * value)
    return lambda term, value: abs(term) < 1e-17 * value


@jit
def _patch_by_series(p, heating, exp_p):
    """The same three numbers from g(B) = Σ g_n B^n, integrated term by term, for small B0 e^P and P not small."""
    # Of the type of P: a float, or lanes.
    value = slope_log_slip = slope_pressure = 0.0 * p
    # (B0 e^P)^n e^P and e^{−(n+1)P} keep every factor within floating point.
    power = exp_p
    decay = 1.0 + value
    for n in range(_G_SERIES.size):
        decay /= exp_p
        x = (n + 1.0) * p
        weight = _G_SERIES[n] * power
        term = weight * (x - 1.0 + decay) / (x * x)
        value += term
        slope_log_slip += 2.0 * n * term
        slope_pressure += (weight - 2.0 * term) / p
        if _settled(term, value):
            break
        power *= heating * exp_p
    return value, slope_log_slip, slope_pressure
