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

from macroslip.compiled import jit


def _power_series_of_m() -> np.ndarray:
    """Coefficients of M(u)/u² in powers of u²: B_2n 2^2n/((2n)! (2n + 2)) = −(−1)^n 2 ζ(2n)/(π^2n (2n + 2)).

    By Riemann's zeta: SciPy's own Bernoulli numbers are good to 12 digits only.
    """
    from scipy.special import zeta

    n = np.arange(1, _SERIES_TERMS)
    return np.concatenate([[0.5], -((-1.0) ** n) * zeta(2.0 * n) / (math.pi ** (2.0 * n) * (n + 1.0))])


def _gauss_rule(nodes: int) -> tuple[np.ndarray, np.ndarray]:
    """Nodes and weights of ∫₀¹ s f(s) ds, exact for polynomials f of degree 2·nodes − 1."""
    from scipy.special import roots_jacobi

    x, weights = roots_jacobi(nodes, 0.0, 1.0)
    return (1.0 + x) / 2.0, weights / 4.0


_SERIES_TERMS = 18
#: B0 e^P below which the power series of g is used, and its coefficients (−4)^n (n!)²/(2n + 1)!; what the last one
#: leaves out is below 1e-16.
_COOL = 0.02
_G_SERIES = np.array([(-4.0) ** n * math.factorial(n) ** 2 / math.factorial(2 * n + 1) for n in range(9)])
_G1, _G2, _G3, _G4, _G5, _G6, _G7, _G8 = (float(g) for g in _G_SERIES[1:])
_M_SERIES = _power_series_of_m()
_GAUSS_NODES_FEW, _GAUSS_WEIGHTS_FEW = _gauss_rule(5)
_GAUSS_NODES_MANY, _GAUSS_WEIGHTS_MANY = _gauss_rule(8)
_HALF_ZETA_3 = 0.6010284515797971
# Largest P served by the 5-node and by the 8-node rule. The integrand's singularities, B = −1, lie π/P or more from the
# interval of s, so that the error of n nodes is of order (4π/P)^(−2n).
_P_FEW, _P_MANY = 0.4, 1.2


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
    growth = math.exp(0.5 * p)
    heating = root_heating * root_heating
    q1 = root_heating * growth
    cool = q1 * q1 < _COOL
    if p < _P_MANY:
        return _patch_by_gauss(p, root_heating, cool)
    if cool:
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


@jit
def _patch_by_series(p, heating, exp_p):
    """The same three numbers from g(B) = Σ g_n B^n, integrated term by term, for small B0 e^P and P not small."""
    value = 0.0
    slope_log_slip = 0.0
    slope_pressure = 0.0
    # (B0 e^P)^n e^P and e^{−(n+1)P} keep every factor within floating point.
    power = exp_p
    decay = 1.0
    for n in range(_G_SERIES.size):
        decay /= exp_p
        x = (n + 1.0) * p
        weight = _G_SERIES[n] * power
        term = weight * (x - 1.0 + decay) / (x * x)
        value += term
        slope_log_slip += 2.0 * n * term
        slope_pressure += (weight - 2.0 * term) / p
        if abs(term) < 1e-17 * value:
            break
        power *= heating * exp_p
    return value, slope_log_slip, slope_pressure


@jit
def _g_and_slope(heating):
    """g(B) and its logarithmic slope B g'(B) by the power series of g, for B below `_COOL`."""
    g = _G8
    steep = 8.0 * _G8
    g = g * heating + _G7
    steep = steep * heating + 7.0 * _G7
    g = g * heating + _G6
    steep = steep * heating + 6.0 * _G6
    g = g * heating + _G5
    steep = steep * heating + 5.0 * _G5
    g = g * heating + _G4
    steep = steep * heating + 4.0 * _G4
    g = g * heating + _G3
    steep = steep * heating + 3.0 * _G3
    g = g * heating + _G2
    steep = steep * heating + 2.0 * _G2
    g = g * heating + _G1
    steep = steep * heating + _G1
    return g * heating + 1.0, steep * heating


@jit
def _patch_by_gauss(p, root_heating, cool):
    """The same three numbers from ∫₀¹ s e^{Ps} g(B0 e^{Ps}) ds by Gauss-Jacobi quadrature, for small P."""
    few = p < _P_FEW
    nodes = _GAUSS_NODES_FEW if few else _GAUSS_NODES_MANY
    weights = _GAUSS_WEIGHTS_FEW if few else _GAUSS_WEIGHTS_MANY
    value = 0.0
    slope_log_slip = 0.0
    slope_pressure = 0.0
    for k in range(nodes.size):
        growth = math.exp(p * nodes[k])
        heating = root_heating * root_heating * growth
        if cool:
            g, steep = _g_and_slope(heating)
        else:
            root = math.sqrt(heating)
            g = math.asinh(root) / (root * math.sqrt(1.0 + heating))
            steep = 0.5 * (1.0 - (1.0 + 2.0 * heating) * g) / (1.0 + heating)
        share = weights[k] * growth
        value += share * g
        slope_log_slip += share * 2.0 * steep
        slope_pressure += share * (g + steep) * nodes[k]
    return value, slope_log_slip, slope_pressure
