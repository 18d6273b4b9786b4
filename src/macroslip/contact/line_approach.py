"""Load of a roller with line contacts over the approach δ of its rings, and the reverse.

A cylindrical roller that touches along a line has at each raceway q(ζ) = c (δ/2 − P(ζ))^n per
length, n = 10/9, with the same profile P = d ln 1/(1 − (2ζ/L)²) at both, so that each takes half of
the approach. The sum over all strips is

    Q = C (δ/2)^n for a straight roller, and Q = C d^n Φ(δ/(2d)) for a logarithmic profile,

with C = c L and Φ(x) = ∫₀¹ (x + ln(1 − t²))₊^n dt, which is one function for all rollers: a power of
x with the exponent n + ½ where the profile alone is touched, and with n far beyond its depth. It
stands here in splines of its logarithm. The sum is that of infinitely many strips; finite ones would
begin to carry one after the other.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.interpolate import BSpline

from macroslip.compiled import jit, jit_inline
from macroslip.contact.line import PALMGREN_EXPONENT
from macroslip.contact.spline import Axis, axis, spline_coefficients

#: Values of ln x between which Φ stands in splines, and their distance. Beyond, it goes on as a
#: power.
_LOWEST = math.log(1e-6)
_HIGHEST = math.log(1e5)
_SPACING = 0.05
#: Step and end of the double-exponential rule: τ from −3.5 to 3.5.
_STEP = 0.04
_LAST = 3.5
#: Newton's iterations for x at values of Φ.
_ITERATIONS = 8


def profile_sum(depths, exponent: float) -> np.ndarray:
    """∫₀¹ (x + ln(1 − t²))₊^m dt of approaches x over the depth of a logarithmic profile [-].

    Parameters
    ----------
    depths : array_like
        x [-], > 0.
    exponent : float
        m [-], > 0.

    Returns
    -------
    ndarray
        Of the shape of `depths`.

    Notes
    -----
    With u = −ln(1 − t²) and by parts it is m ∫₀^x (x − u)^(m−1) √(1 − e^−u) du; both ends are powers,
    which a double-exponential rule (Takahasi and Mori 1974, doi:10.2977/prims/1195192451) takes.

    Examples
    --------
    >>> round(float(profile_sum(1e4, 1.0)), 3)      # x − 2 (1 − ln 2)
    9999.386
    """
    x = np.asarray(depths, dtype=float)[..., None]
    tau = np.arange(-_LAST, _LAST + 0.5 * _STEP, _STEP)
    stretched = math.pi * np.sinh(tau)
    below = 1.0 / (1.0 + np.exp(-stretched))
    above = 1.0 / (1.0 + np.exp(stretched))
    weight = _STEP * math.pi * np.cosh(tau) * below * above
    touched = np.sqrt(-np.expm1(-x * below))
    values = above ** (exponent - 1.0) * touched
    integral = (weight * values).sum(axis=-1)
    return exponent * x[..., 0] ** exponent * integral


@jit_inline
def _on_spline(line, coefficients, coordinate):
    """Value and slope of a spline of one coordinate, continued straight beyond its ends."""
    position = (coordinate - line.first) * line.per_spacing
    inside = min(max(position, 0.0), float(line.cells))
    cell = min(int(inside), line.cells - 1)
    t = inside - cell
    u = 1.0 - t
    first = coefficients[cell]
    second = coefficients[cell + 1]
    third = coefficients[cell + 2]
    fourth = coefficients[cell + 3]
    second_weight = 4.0 - 6.0 * t * t + 3.0 * t * t * t
    third_weight = 4.0 - 6.0 * u * u + 3.0 * u * u * u
    value = u * u * u * first + second_weight * second
    value += third_weight * third + t * t * t * fourth
    slope = -u * u * first + t * (3.0 * t - 4.0) * second + u * (4.0 - 3.0 * u) * third
    slope = 0.5 * (slope + t * t * fourth)
    beyond = position - inside
    return value / 6.0 + slope * beyond, slope * line.per_spacing


_AXIS = axis(_LOWEST, _HIGHEST, _SPACING)
_RATIOS = np.exp(_AXIS.nodes)
_LOAD_SUMS = profile_sum(_RATIOS, PALMGREN_EXPONENT)
_WORK_SUMS = profile_sum(_RATIOS, PALMGREN_EXPONENT + 1.0)
_LOADS = spline_coefficients(np.log(_LOAD_SUMS), 1)
_WORKS = spline_coefficients(np.log(_WORK_SUMS), 1)


def _inverse() -> tuple[Axis, np.ndarray]:
    """Axis of ln Φ and the spline of ln x over it."""
    knots = _AXIS.first + np.arange(-3, _AXIS.cells + 4) / _AXIS.per_spacing
    value = BSpline(knots, _LOADS, 3)
    slope = value.derivative()
    ends = value([_LOWEST, _HIGHEST])
    line = axis(ends[0], ends[1], _SPACING)
    log_approach = np.interp(line.nodes, ends, [_LOWEST, _HIGHEST])
    for _ in range(_ITERATIONS):
        excess = value(log_approach) - line.nodes
        log_approach = log_approach - excess / slope(log_approach)
    return line, spline_coefficients(log_approach, 1)


_LOAD_AXIS, _APPROACHES = _inverse()


class LineLoad(NamedTuple):
    """Load of a roller with line contacts at an approach."""

    load: float  #: Q [N]
    slope: float  #: dQ/dδ [N/m]
    work: float  #: ∫Q dδ [N m]


@jit_inline
def line_load(line_stiffness, profile_depth, approach):
    """Load of a roller with line contacts at both rings, its slope and the work done on it.

    Parameters
    ----------
    line_stiffness : float
        C = c L [N/m^(10/9)], > 0.
    profile_depth : float
        d [m], 0 for a straight roller.
    approach : float
        δ of ring, roller and ring [m], > 0.

    Returns
    -------
    LineLoad

    References
    ----------
    Palmgren, Grundlagen der Wälzlagertechnik, 3rd ed. (1964); ISO/TS 16281:2008, section 5.4.

    Examples
    --------
    A straight roller of 10 mm at 2 µm, and one with a logarithmic profile 5 µm deep:

    >>> from macroslip.contact.line import palmgren_coefficient
    >>> stiffness = 0.01 * palmgren_coefficient(0.01)
    >>> [round(float(line_load(stiffness, depth, 2e-6).load), 1) for depth in (0.0, 5e-6)]
    [289.6, 81.4]
    """
    each = 0.5 * approach
    if profile_depth == 0.0:
        load = line_stiffness * each**PALMGREN_EXPONENT
        slope = PALMGREN_EXPONENT * load / approach
        work = load * approach / (PALMGREN_EXPONENT + 1.0)
        return LineLoad(load, slope, work)
    log_ratio = math.log(each / profile_depth)
    unit = line_stiffness * profile_depth**PALMGREN_EXPONENT
    value, growth = _on_spline(_AXIS, _LOADS, log_ratio)
    load = unit * math.exp(value)
    # Both contacts do the work C d^(n+1)/(n + 1) ∫₀¹ (x + ln(1 − t²))₊^(n+1) dt.
    log_work, _ = _on_spline(_AXIS, _WORKS, log_ratio)
    work_sum = math.exp(log_work) / (PALMGREN_EXPONENT + 1.0)
    slope = growth * load / approach
    work = 2.0 * unit * profile_depth * work_sum
    return LineLoad(load, slope, work)


class LineApproach(NamedTuple):
    """Approach of a roller with line contacts under a load."""

    approach: float  #: δ of ring, roller and ring [m]
    growth: float  #: d(ln δ)/d(ln Q) [-]


@jit_inline
def line_approach(line_stiffness, profile_depth, log_load):
    """Approach of a roller with line contacts at both rings under a load.

    Parameters
    ----------
    line_stiffness : float
        C = c L [N/m^(10/9)], > 0.
    profile_depth : float
        d [m], 0 for a straight roller.
    log_load : float
        ln Q, Q in N.

    Returns
    -------
    LineApproach

    Examples
    --------
    >>> from macroslip.contact.line import palmgren_coefficient
    >>> stiffness = 0.01 * palmgren_coefficient(0.01)
    >>> round(1e6 * line_approach(stiffness, 0.0, math.log(289.6)).approach, 3)
    2.0
    """
    log_stiffness = math.log(line_stiffness)
    if profile_depth == 0.0:
        growth = 1.0 / PALMGREN_EXPONENT
        log_each = (log_load - log_stiffness) * growth
        return LineApproach(2.0 * math.exp(log_each), growth)
    log_depth = math.log(profile_depth)
    log_sum = log_load - log_stiffness - PALMGREN_EXPONENT * log_depth
    log_ratio, growth = _on_spline(_LOAD_AXIS, _APPROACHES, log_sum)
    approach = 2.0 * math.exp(log_depth + log_ratio)
    return LineApproach(approach, growth)


@jit
def line_loads(line_stiffness, profile_depth, approach):
    """Loads, slopes and work of `line_load` at many approaches [m]; all 0 where δ is not above 0.

    Returns an array of shape (3, n) from approaches of shape (n,).
    """
    loads = np.zeros((3, approach.size))
    for n in range(approach.size):
        if approach[n] > 0.0:
            pressed = line_load(line_stiffness, profile_depth, approach[n])
            loads[0, n] = pressed.load
            loads[1, n] = pressed.slope
            loads[2, n] = pressed.work
    return loads


@jit
def line_approaches(line_stiffness, profile_depth, loads):
    """Approaches of `line_approach` [m] under many loads [N]; 0 where Q is not above 0.

    Returns an array of shape (n,) from loads of shape (n,).
    """
    approaches = np.zeros(loads.size)
    for n in range(loads.size):
        if loads[n] > 0.0:
            log_load = math.log(loads[n])
            pressed = line_approach(line_stiffness, profile_depth, log_load)
            approaches[n] = pressed.approach
    return approaches
