"""The paper's traction in closed form: a Newtonian Barus film over the Hertz ellipse.

Crook's shear heating may be left out.

With p = p0 √(1 − ρ²) the integral over the ellipse is one-dimensional: F = 2π a b (η0 Δu/h) Φ, with

    Φ(P, B0) = ∫₀¹ s e^{Ps} g(B0 e^{Ps}) ds,   g(B) = asinh √B/√(B(1 + B)),
    P = α_p p0,   B0 = β η0 Δu²/(8k).

Put q = √B0 e^{Ps/2} and u = asinh q. Then Φ = I/(h² q0²) with h = P/2, q0 = √B0 and

    I = ∫₀^h y w(x0 + y) dy = h u1²/2 − [M(u1) − M(u0)]/2,
    w = u tanh u,   M(u) = ∫₀^u t² coth t dt,

in which x = ln q, and u0, u1 belong to s = 0 and s = 1. M has a power series for small u and a
polylogarithm form for large u. For small P the bracket cancels, and Φ is taken by a Gauss rule with
the weight s: the integrand's singularities, B = −1, lie π/P or more from the interval, so that the
error of n nodes is of order (4π/P)^(−2n), below round-off. For small B0 e^P the power series of g
is integrated term by term; its first term, ∫₀¹ s e^{Ps} ds = [e^P (P − 1) + 1]/P², is a power series
where that cancels. The same I gives the derivatives: dI/dx0 = h w1 − (u1² − u0²)/2 and
dI/dh = h w1.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.special import roots_jacobi, zeta

from macroslip.compiled import jit, jit_inline
from macroslip.contact.interface import Interface
from macroslip.contact.look_up import arsinh
from macroslip.elementary import exponential

#: Power series of g, (−4)^n (n!)²/(2n + 1)!, and B up to which it is used; what its last term
#: leaves out is below 1e-16.
_G_SERIES = np.array(
    [(-4.0) ** n * math.factorial(n) ** 2 / math.factorial(2 * n + 1) for n in range(9)]
)
_COOL = 0.02
#: 1/(n + 1) of its terms.
_RECIPROCALS = 1.0 / np.arange(1, _G_SERIES.size + 1)
#: Coefficients of M(u)/u² in powers of u²: B_2n 2^2n/((2n)! (2n + 2)) = −(−1)^n 2 ζ(2n)/(π^2n (2n +
#: 2)), and u up to which they are used. By Riemann's zeta: SciPy's own Bernoulli numbers are good
#: to 12 digits only.
_TERMS = np.arange(1, 18)
_M_SERIES = np.concatenate(
    [[0.5], -((-1.0) ** _TERMS) * zeta(2.0 * _TERMS) / (math.pi ** (2.0 * _TERMS) * (_TERMS + 1.0))]
)
_SMALL_U = 1.1
_HALF_ZETA_3 = 0.6010284515797971
#: Coefficients of ∫₀¹ s e^{Ps} ds in powers of P, for P up to `_LARGEST_P`.
_COLD_SERIES = np.array([1.0 / (math.factorial(k) * (k + 2)) for k in range(17)])
#: Least P served by the power series of g: its slope by P is a difference over P.
_LEAST_P = 0.1
#: Largest P served by the Gauss rule, its nodes and weights of ∫₀¹ s f(s) ds.
_LARGEST_P = 0.8
_RULE = roots_jacobi(7, 0.0, 1.0)
_PLACES = (1.0 + _RULE[0]) / 2.0
_WEIGHTS = _RULE[1] / 4.0


@jit_inline
def moment_of_coth(u):
    """M(u) = ∫₀^u t² coth t dt for u ≥ 0, to a few units in the last place [-].

    Examples
    --------
    >>> float(round(moment_of_coth(1.0), 12))
    0.579874655329
    """
    total = 0.0
    if u < _SMALL_U:
        for k in range(_M_SERIES.size - 1, -1, -1):
            total = total * u * u + _M_SERIES[k]
        return total * u * u
    decay = power = exponential(-2.0 * u)
    n = 1.0
    while power > 1e-18:
        term = u * u + (u + 0.5 / n) / n
        total += power * term / n
        power *= decay
        n += 1.0
    return u * u * u / 3.0 + _HALF_ZETA_3 - total


@jit_inline
def _reduction(heating):
    """G(B) and its logarithmic slope B g'(B)."""
    if heating < _COOL:
        g = 0.0
        slope = 0.0
        for n in range(_G_SERIES.size - 1, -1, -1):
            g = g * heating + _G_SERIES[n]
            slope = slope * heating + n * _G_SERIES[n]
        return g, slope
    root = math.sqrt(heating)
    hypotenuse = math.sqrt(1.0 + heating)
    g = arsinh(root, hypotenuse) / (root * hypotenuse)
    slope = 0.5 * (1.0 - (1.0 + 2.0 * heating) * g) / (1.0 + heating)
    return g, slope


@jit_inline
def _patch_by_rule(p, heating):
    value = 0.0
    by_slip = 0.0
    by_pressure = 0.0
    for k in range(_PLACES.size):
        growth = exponential(p * _PLACES[k])
        g, slope = _reduction(heating * growth)
        share = growth * _WEIGHTS[k]
        value += share * g
        by_slip += share * 2.0 * slope
        by_pressure += share * (g + slope) * _PLACES[k]
    return value, by_slip, by_pressure


@jit_inline
def _cold_patch(p, exp_p):
    """∫₀¹ s e^{Ps} ds, which is Φ without heating."""
    if p >= _LARGEST_P:
        # No factor leaves floating point before the value does.
        return exp_p * (p - 1.0 + 1.0 / exp_p) / (p * p)
    value = 0.0
    for k in range(_COLD_SERIES.size - 1, -1, -1):
        value = value * p + _COLD_SERIES[k]
    return value


@jit_inline
def _patch_by_series(p, heating, exp_p):
    """Φ and its derivatives by the power series of g, integrated term by term."""
    value = _cold_patch(p, exp_p)
    by_slip = 0.0
    per_p = 1.0 / p
    by_pressure = (exp_p - 2.0 * value) * per_p
    per_exp_p = 1.0 / exp_p
    # (B0 e^P)^n e^P and e^{−(n+1)P} keep every factor within floating point.
    power = exp_p * (heating * exp_p)
    decay = per_exp_p
    for n in range(1, _G_SERIES.size):
        decay *= per_exp_p
        x = (n + 1.0) * p
        weight = _G_SERIES[n] * power
        per_x = per_p * _RECIPROCALS[n]
        term = weight * (x - 1.0 + decay) * per_x * per_x
        value += term
        by_slip += 2.0 * n * term
        by_pressure += (weight - 2.0 * term) * per_p
        if abs(term) < 1e-17 * value:
            break
        power *= heating * exp_p
    return value, by_slip, by_pressure


@jit
def patch_integral(pressure_exponent, root_heating):
    """Patch integral Φ of Crook's traction over the Hertz ellipse, and its derivatives [-].

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
    Derivation in the module's docstring; Crook (1961), doi:10.1098/rsta.1961.0014, for the local
    law.

    Examples
    --------
    >>> round(patch_integral(5.0, 1.0)[0], 12)
    1.160551948246
    """
    p = pressure_exponent
    heating = root_heating * root_heating
    growth = exponential(0.5 * p)
    q1 = root_heating * growth
    if p >= _LEAST_P and q1 * q1 < _COOL:
        return _patch_by_series(p, heating, growth * growth)
    if p < _LARGEST_P:
        return _patch_by_rule(p, heating)
    h = 0.5 * p
    hypotenuse = math.sqrt(1.0 + q1 * q1)
    u0 = arsinh(root_heating, math.sqrt(1.0 + heating))
    u1 = arsinh(q1, hypotenuse)
    w1 = u1 * (q1 / hypotenuse)
    coth_moment = moment_of_coth(u1) - moment_of_coth(u0)
    integral = 0.5 * (h * u1 * u1 - coth_moment)
    slope = h * w1 - 0.5 * (u1 - u0) * (u1 + u0)
    scale = 1.0 / (h * h * heating)
    value = integral * scale
    by_slip = slope * scale - 2.0 * value
    by_heating = 0.5 * w1 * h * scale - value / h
    return value, by_slip, by_heating


#: Φ of `patch_integral` for arrays.
_patch = np.vectorize(
    lambda exponent, heating: patch_integral(exponent, heating)[0], otypes=[float]
)


class BarusCrook(NamedTuple):
    """Numbers of the paper's traction law for one interface."""

    #: 2π a b η0 per Q^(2/3) [N^(1/3) s]: force per slip at unit film, without the patch integral
    conductance: float
    pressure_exponent: float  #: P = α_p p0 per Q^(1/3) [N^(-1/3)]
    heating: float  #: √(β η0/(8k)) [s/m], so that q0 = heating·|Δu|; zero without heating


def prepare_barus_crook(interface: Interface, *, heated: bool) -> BarusCrook:
    """Numbers of the paper's traction law from Hertz coefficients and lubricant."""
    hertz = interface.hertz
    oil = interface.lubricant
    return BarusCrook(
        conductance=2.0 * math.pi * hertz.semi_axis_across * hertz.semi_axis_along * oil.viscosity,
        pressure_exponent=oil.pressure_viscosity * hertz.pressure,
        heating=math.sqrt(
            oil.temperature_viscosity * oil.viscosity / (8.0 * oil.thermal_conductivity)
        )
        * heated,
    )


def barus_crook_traction(law: BarusCrook, load, film_thickness, slip):
    """Traction of the paper's film over the Hertz ellipse.

    Parameters
    ----------
    law : BarusCrook
        Constants of the interface.
    load : array_like
        Q [N], > 0.
    film_thickness : array_like
        h [m], > 0.
    slip : array_like
        Δu [m/s], of either sign.

    Returns
    -------
    ndarray
        Force [N] with the sign of the slip.
    """
    root = np.cbrt(load)
    patch = _patch(law.pressure_exponent * root, law.heating * np.abs(slip))
    return law.conductance * root * root / film_thickness * patch * slip
