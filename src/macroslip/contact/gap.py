"""A rigid, isoviscous contact of finite length: load, rolling resistance and shear of its film.

Over the gap h = h0 + x²/(2R_x) + z²/(2R_y), |z| ≤ l/2, Reynolds' equation with p ≥ 0 has the groups
κ = l²/(8 R_y h0) and λ = 2 √(2 R_x h0)/l. `gap_table.csv`, which `benchmarks/gap_table.py` makes,
holds the ratios c of

    Q   = 4.895 η0 u R_x l/h0     · atan(√κ)/√κ  · c_Q(κ, λ),
    F_R = 4.601 η0 u l √(R_x/h0)  · asinh(√κ)/√κ · c_F(κ, λ),
    S = ∫∫ dA/h = 2.0144 l √(2R_x/h0) · asinh(√κ)/√κ · c_S(κ, λ)

over ln(1 + κ) and √s, s = λ √(1 + κ) the width of the pressure over that of the film; c = 1 at s =
0, where every slice is Martin's line. A given contact moves along the line κ λ² = R_x/R_y, so that
two splines over one variable serve it.

An inlet that begins to be full at S times the film has the factors of `starved_martin` on Q, F_R
and ∫∫ dA/h.
"""

from __future__ import annotations

import functools
import math
from importlib.resources import files
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline, RectBivariateSpline
from scipy.optimize import brentq

#: Martin's rigid, isoviscous, flooded line contact: in x = √(2 R h0) t the gap is h0 (1 + t²), and
#: the pressure that vanishes far upstream and ends with zero slope at t_e is dp/dt = 12 η0 u √(2 R
#: h0)/h0² (t² − t_e²)/(1 + t²)³. Martin, Engineering (London) 102 (1916) 119; the coefficients are
#: computed from this equation. Location of the film's end t_e:
EXIT = 0.475129920093054
#: Load per length times h0 over η0 u R: h0 = 4.895 η0 u R/w. Rigid where M is below about 0.3.
LOAD = 4.894968493913377
#: Rolling force of one surface per length over η0 u √(R/h0).
ROLLING_AT_GAP = 4.601076874757563
#: Rolling force of one surface per length, ½ ∫ h dp/dx dx, over √(η0 u w).
ROLLING = ROLLING_AT_GAP / math.sqrt(LOAD)
#: ∫dx/h over √(2 R/h0), from far upstream to the film's end: π/2 + atan(`EXIT`).
SHEAR = 0.5 * math.pi + math.atan(EXIT)
#: Film of the volume flow, which is the film where the pressure is highest, over h0.
FLOW = 1.0 + EXIT**2
#: Largest s and κ of the table of rigid gaps.
WIDEST = 4.0
MOST_CURVED = 1e5
_KNOTS = 96
#: Least S for which a gap of a given inlet is computed; straight on below.
_LEAST_INLET = 1.1
#: Quantities of a rigid gap.
_LOAD = 0
_ROLLING = 1
_SHEAR = 2


def starved_martin(inlet: float) -> tuple[float, float, float]:
    """Load, rolling force and shear of a starved line contact over those of a flooded one.

    Both have the same h0.

    The film begins with no pressure at t_i < 0, where the gap is S times the film of the volume
    flow, h0 (1 + t_e²); the pressure ends with zero slope at t_e, which follows from t_i by
    Martin's equation. The factors on Q, F_R and ∫dx/h hold at a given h0 and are at most 1 [-]. S
    is > 1, and infinite where flooded.

    Resistance suffers first: at S = 10 it halves, while shear keeps 85 % and load 82 %.

    Examples
    --------
    >>> [round(factor, 3) for factor in starved_martin(10.0)]
    [0.815, 0.499, 0.852]
    """
    if math.isinf(inlet):
        return 1.0, 1.0, 1.0

    def squared(t: float) -> float:  # ∫ dt/(1 + t²)²
        gap = 1.0 + t * t
        return 0.5 * (t / gap + math.atan(t))

    def cubed(t: float) -> float:  # ∫ dt/(1 + t²)³
        gap = 1.0 + t * t
        return 0.25 * t / gap**2 + 0.75 * squared(t)

    def start_of(end: float) -> float:  # where the gap is S times the film of the volume flow
        film = 1.0 + end * end
        return -math.sqrt(inlet * film - 1.0)

    def flow(end: float) -> float:
        start = start_of(end)
        by_speed = squared(end) - squared(start)
        by_pressure = cubed(end) - cubed(start)
        return by_speed - (1.0 + end * end) * by_pressure

    end = float(brentq(flow, 0.0, 0.5, xtol=1e-15))
    start = start_of(end)
    film = 1.0 + end * end

    # −∫ t dp and ∫ (1 + t²) dp, dp = 1/(1 + t²)² − (1 + t_e²)/(1 + t²)³.
    def antiderivative(t: float) -> float:
        gap = 1.0 + t * t
        return -0.5 / gap + 0.25 * film / gap**2

    load = -24.0 * (antiderivative(end) - antiderivative(start))
    rise = math.atan(end) - math.atan(start)
    squares = squared(end) - squared(start)
    rolling = 6.0 * math.sqrt(2.0) * (rise - film * squares)
    return load / LOAD, rolling / ROLLING_AT_GAP, rise / SHEAR


class GapShape(NamedTuple):
    """Geometry of a contact."""

    rolling_radius: float  #: R_x, relative radius of curvature in the plane of rolling [m]
    lateral_radius: float  #: R_y, that across it [m]; may be infinite
    length: float  #: l [m]


class Gap(NamedTuple):
    """Rigid, isoviscous film of a contact of finite length.

    Load and rolling resistance are per η0 u.
    """

    log_gaps: np.ndarray  #: Shape (knots,). ln h0 [ln m], even.
    #: Shape (4, knots − 1, 3). Cubics of ln Q/(η0 u) [ln m], ln F_R/(η0 u) [ln m] and ln S [ln m]
    #: over ln h0, highest power first.
    by_gap: np.ndarray
    log_loads: np.ndarray  #: Shape (knots,). ln Q/(η0 u) [ln m], even.
    #: Shape (4, knots − 1, 3). Cubics of ln h0, ln F_R/(η0 u) and ln S over ln Q/(η0 u).
    by_load: np.ndarray


@functools.cache
def _ratio_splines() -> list[RectBivariateSpline]:
    """Splines of ln c_Q, ln c_F and ln c_S over ln(1 + κ) and √s.

    They are mirrored at √s = 0, where c − 1 goes with s.
    """
    with files("macroslip.contact").joinpath("gap_table.csv").open(encoding="utf-8") as file:
        columns = np.loadtxt(file, delimiter=",", skiprows=1)
    curvatures = np.unique(columns[:, 0])
    aspects = np.unique(columns[:, 1])
    log_ratios = np.log(columns[:, 2:5])
    values = log_ratios.reshape(curvatures.size, aspects.size, 3)
    aspects = np.concatenate([-aspects[:0:-1], aspects])
    values = np.concatenate([values[:, :0:-1], values], axis=1)
    return [RectBivariateSpline(curvatures, aspects, values[:, :, k]) for k in range(3)]


def ratios(kappa, aspect) -> np.ndarray:
    """c_Q, c_F and c_S at κ and λ, the first axis of the result.

    Examples
    --------
    >>> bool(np.allclose(ratios(1.0, 0.0), 1.0, atol=1e-12))
    True
    """
    curvature = np.log1p(kappa)
    width = np.sqrt(aspect * np.sqrt(1.0 + kappa))
    log_ratios = [spline.ev(curvature, width) for spline in _ratio_splines()]
    return np.exp(log_ratios)


def _slices(shape: GapShape, gap: np.ndarray, kappa: np.ndarray) -> np.ndarray:
    """Q/(η0 u) [m], F_R/(η0 u) [m] and S [m] of slices side by side, each Martin's line."""
    radius = shape.rolling_radius
    length = shape.length
    root = np.sqrt(np.maximum(kappa, 1e-12))
    narrow = np.arctan(root) / root
    wide = np.arcsinh(root) / root
    load = LOAD * radius * length / gap * narrow
    rolling = ROLLING_AT_GAP * length * np.sqrt(radius / gap) * wide
    shear = SHEAR * length * np.sqrt(2.0 * radius / gap) * wide
    return np.stack([load, rolling, shear])


def _starved(gap: np.ndarray, oil_gap: float, widest_inlet: float) -> np.ndarray:
    """Factors of `starved_martin` at gaps h0 [m], the first axis of the result."""
    if math.isinf(oil_gap):
        return np.array(starved_martin(widest_inlet))[:, None]
    inlets = np.minimum(widest_inlet, oil_gap / (FLOW * gap))
    factors = [starved_martin(inlet) for inlet in inlets.tolist()]
    return np.array(factors).T


# Both rows have the same contacts, and runs of a study many of them in common.
@functools.lru_cache(maxsize=64)
def prepare_gap(shape: GapShape, oil_gap: float = math.inf, widest_inlet: float = math.inf) -> Gap:
    """Rigid film of a contact, from the gap at which κ = 1e5 to that at which s = 4.

    Beyond these gaps it follows power laws.

    `oil_gap` is the gap where the inlet begins to be full [m], always wider than the film, infinite
    where flooded; `widest_inlet` the largest S, > 1: where a surface ends, as a spar does, or
    infinite.
    """
    radius = shape.rolling_radius
    length = shape.length
    curvature = length**2 / (8.0 * shape.lateral_radius)  # κ h0
    # λ² (1 + κ) = s²: s² = 8 R_x h0/l² + R_x/R_y.
    radius_ratio = radius / shape.lateral_radius
    highest = (WIDEST**2 - radius_ratio) * length**2 / (8.0 * radius)
    lowest = max(curvature / MOST_CURVED, 1e-9 * length)
    highest = min(highest, oil_gap / (_LEAST_INLET * FLOW))
    lowest = min(lowest, 1e-3 * highest)
    log_gap = np.linspace(math.log(lowest), math.log(highest), _KNOTS)
    gap = np.exp(log_gap)
    kappa = curvature / gap
    aspect = np.sqrt(8.0 * radius * gap) / length
    slices = _slices(shape, gap, kappa)
    correction = ratios(kappa, aspect)
    starved = _starved(gap, oil_gap, widest_inlet)
    values = np.log(slices * correction * starved).T
    by_gap = CubicSpline(log_gap, values).c
    # Load falls with the gap.
    rising_load = values[::-1, _LOAD]
    log_loads = np.linspace(rising_load[0], rising_load[-1], _KNOTS)
    of_load = np.column_stack([log_gap, values[:, _ROLLING], values[:, _SHEAR]])[::-1]
    over_load = CubicSpline(rising_load, of_load)(log_loads)
    by_load = CubicSpline(log_loads, over_load).c
    return Gap(log_gap, by_gap, log_loads, by_load)


def _cubic(knots: np.ndarray, cubics: np.ndarray, which: int, coordinate):
    """Value of a spline over even knots, continued straight beyond its ends."""
    first = knots[0]
    last = knots[-1]
    inside = np.clip(coordinate, first, last)
    per_step = (knots.size - 1) / (last - first)
    position = (inside - first) * per_step
    cell = np.minimum(position.astype(int), knots.size - 2)
    t = inside - knots[cell]
    a, b, c, d = np.ascontiguousarray(cubics[:, :, which])[:, cell]
    value = ((a * t + b) * t + c) * t + d
    slope = (3.0 * a * t + 2.0 * b) * t + c
    return value + (coordinate - inside) * slope


def film_at_load(gap: Gap, log_group):
    """Ln h0, ln F_R/(η0 u) and ln S of a contact that carries a load, from ln Q/(η0 u) [ln m]."""
    coordinate = np.asarray(log_group, dtype=float)
    return tuple(_cubic(gap.log_loads, gap.by_load, k, coordinate) for k in range(3))


def film_at_gap(gap: Gap, log_gap):
    """Ln Q/(η0 u), ln F_R/(η0 u) and ln S of a contact whose gap is given, from ln h0 [ln m]."""
    coordinate = np.asarray(log_gap, dtype=float)
    return tuple(_cubic(gap.log_gaps, gap.by_gap, k, coordinate) for k in range(3))
