"""A rigid, isoviscous contact of finite length: load, rolling resistance and shear of one film, from one table.

Over the gap h = h0 + x²/(2R_x) + z²/(2R_y), |z| ≤ l/2, Reynolds' equation with p ≥ 0 has the groups κ = l²/(8 R_y h0) and
λ = 2 √(2 R_x h0)/l. `gap_table.csv`, made by `python benchmarks/gap_table.py`, holds the ratios c of

    Q   = 4.895 η0 u R_x l/h0     · atan(√κ)/√κ  · c_Q(κ, λ),
    F_R = 4.601 η0 u l √(R_x/h0)  · asinh(√κ)/√κ · c_F(κ, λ),
    S = ∫∫ dA/h = 2.0144 l √(2R_x/h0) · asinh(√κ)/√κ · c_S(κ, λ)

over ln(1 + κ) and √s, s = λ √(1 + κ) the width of the pressure over that of the film; c = 1 at s = 0, where every slice
is Martin's line. A given contact moves along the line κ λ² = R_x/R_y, so that two splines over one variable serve it.

Fullness φ is the share of the length l over which the gap holds oil, in streaks along the motion that are wide against
√(2R_x h0) and full to far upstream: at a given gap load, resistance and shear go with φ; at a given load h0 goes with φ
where the contact is a line. Narrower streaks lose pressure at their sides, so that F_R and Q are then smaller still.
An inlet that begins to be full at S times the film has the factors of `martin.starved_martin` on Q, F_R and S = ∫∫ dA/h.
"""

from __future__ import annotations

import functools
import math
from importlib.resources import files
from typing import Any, NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline, RectBivariateSpline

from macroslip.compiled import jit_inline
from macroslip.errors import InputError
from macroslip.rolling import martin

#: Largest s and κ of the table.
WIDEST, MOST_CURVED = 4.0, 1e5
_KNOTS = 96


class GapShape(NamedTuple):
    """Geometry of a contact.

    Attributes
    ----------
    rolling_radius : float
        R_x, relative radius of curvature in the plane of rolling [m].
    lateral_radius : float
        R_y, that across it [m]; may be infinite.
    length : float
        l [m].
    """

    rolling_radius: float
    lateral_radius: float
    length: float


class Gap(NamedTuple):
    """The film of a contact, ready for kernels; groups are per η0 u φ (load, rolling) or per φ (shear).

    Attributes
    ----------
    gap_start, gap_step : float
        First knot and spacing of ln h0 [ln m].
    by_gap : array (knots − 1, 3, 4)
        Cubics of ln Q/(φ η0 u) [ln m], ln F_R/(φ η0 u) [ln m] and ln S/φ [ln m] over ln h0.
    load_start, load_step : float
        First knot and spacing of ln Q/(φ η0 u).
    by_load : array (knots − 1, 3, 4)
        Cubics of ln h0, ln F_R/(φ η0 u) and ln S/φ over ln Q/(φ η0 u).
    fullness : float
        φ.
    """

    gap_start: float
    gap_step: float
    by_gap: Any
    load_start: float
    load_step: float
    by_load: Any
    fullness: float


@functools.cache
def _table() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Coordinates ln(1 + κ) and √s, and ln c over them; mirrored at √s = 0, where c − 1 goes with s."""
    with files("macroslip.rolling").joinpath("gap_table.csv").open(encoding="utf-8") as file:
        columns = np.loadtxt(file, delimiter=",", skiprows=1)
    curvatures, aspects = np.unique(columns[:, 0]), np.unique(columns[:, 1])
    ratios = np.log(columns[:, 2:5]).reshape(curvatures.size, aspects.size, 3)
    aspects = np.concatenate([-aspects[:0:-1], aspects])
    ratios = np.concatenate([ratios[:, :0:-1], ratios], axis=1)
    return curvatures, aspects, ratios


def ratios(kappa: float, aspect: float) -> np.ndarray:
    """c_Q, c_F and c_S at κ and λ.

    Examples
    --------
    >>> bool(np.allclose(ratios(1.0, 0.0), 1.0, atol=1e-12))
    True
    """
    curvatures, aspects, values = _table()
    place = math.log1p(kappa), math.sqrt(aspect * math.sqrt(1.0 + kappa))
    return np.exp([RectBivariateSpline(curvatures, aspects, values[:, :, i])(*place)[0, 0] for i in range(3)])


def prepare_gap(shape: GapShape, fullness: float = 1.0, inlet_film: float = math.inf) -> Gap:
    """The film of a contact.

    Parameters
    ----------
    shape : GapShape
    fullness : float
        φ, above 0 and at most 1: an estimate, 0.03 to 1 for contacts without load.
    inlet_film : float
        Gap where the inlet begins to be full over the film, > 1; infinite where flooded.

    Returns
    -------
    Gap
        From the gap at which κ = 1e5 to that at which s = 4; power laws beyond.

    Raises
    ------
    InputError
        If the fullness is outside its range.
    """
    if not inlet_film > 1.0:
        raise InputError(
            f"the film at the inlet over that of the contact is {inlet_film!r}",
            where="inlet_film",
            allowed="a number above 1; .inf where flooded",
            remedy="It is the gap where the inlet begins to be full over the gap of the contact",
        )
    if not 0.0 < fullness <= 1.0:
        raise InputError(
            f"the fullness of a light contact is {fullness!r}",
            where="fullness",
            allowed="a number above 0 and at most 1",
            remedy="It is the share of the contact's length over which the gap holds oil; 1 means flooded",
        )
    radius, length = shape.rolling_radius, shape.length
    curvature = length**2 / (8.0 * shape.lateral_radius)  # κ h0
    # λ² (1 + κ) = s²: s² = 8 R_x h0/l² + R_x/R_y.
    highest = (WIDEST**2 - radius / shape.lateral_radius) * length**2 / (8.0 * radius)
    lowest = max(curvature / MOST_CURVED, 1e-9 * length)
    log_gap = np.linspace(math.log(lowest), math.log(highest), _KNOTS)
    gap = np.exp(log_gap)
    kappa = curvature / gap
    root = np.sqrt(np.maximum(kappa, 1e-12))
    curvatures, aspects, values = _table()
    places = np.log1p(kappa), np.sqrt(np.sqrt(8.0 * radius * gap * (1.0 + kappa)) / length)
    corrections = [RectBivariateSpline(curvatures, aspects, values[:, :, i]).ev(*places) for i in range(3)]
    narrow, wide = np.log(np.arctan(root) / root), np.log(np.arcsinh(root) / root)
    log_load = np.log(martin.LOAD * radius * length / gap) + narrow + corrections[0]
    log_rolling = np.log(martin.ROLLING_AT_GAP * length * np.sqrt(radius / gap)) + wide + corrections[1]
    log_shear = np.log(martin.SHEAR * length * np.sqrt(2.0 * radius / gap)) + wide + corrections[2]
    starved = np.log(martin.starved_martin(inlet_film))
    log_load, log_rolling, log_shear = log_load + starved[0], log_rolling + starved[1], log_shear + starved[2]
    by_gap = _cubics(log_gap, np.stack([log_load, log_rolling, log_shear]))
    order = slice(None, None, -1)
    even = np.linspace(log_load[-1], log_load[0], _KNOTS)
    over_load = CubicSpline(log_load[order], np.stack([log_gap, log_rolling, log_shear])[:, order], axis=1)(even)
    by_load = _cubics(even, over_load)
    return Gap(
        float(log_gap[0]),
        float(log_gap[1] - log_gap[0]),
        by_gap,
        float(even[0]),
        float(even[1] - even[0]),
        by_load,
        float(fullness),
    )


def _cubics(places: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Coefficients of the cubic splines through rows of values, lowest power first, in units of the spacing."""
    spline = CubicSpline(places, values, axis=1)
    step = places[1] - places[0]
    powers = step ** np.arange(4.0)
    return np.ascontiguousarray(np.transpose(spline.c[::-1], (1, 2, 0)) * powers)


@jit_inline
def _cell(start, step, cells, place):
    """Cell of a place, the place within it, and how far the place lies beyond the ends, in steps."""
    position = (place - start) / step
    inside = min(max(position, 0.0), float(cells))
    cell = min(int(inside), cells - 1)
    return cell, inside - cell, position - inside


@jit_inline
def _value(cubics, cell, which, t, beyond):
    """Value of a spline and its derivative by position; straight on beyond the ends."""
    a, b, c, d = cubics[cell, which, 0], cubics[cell, which, 1], cubics[cell, which, 2], cubics[cell, which, 3]
    slope = b + t * (2.0 * c + 3.0 * t * d)
    return a + t * (b + t * (c + t * d)) + beyond * slope, slope


@jit_inline
def film_at_load(film, log_group):
    """Film of a contact that carries a load.

    Parameters
    ----------
    film : Gap
    log_group : float
        ln Q/(φ η0 u) [ln m].

    Returns
    -------
    tuple of float
        ln h0, ln F_R/(φ η0 u) and ln S/φ, each followed by its derivative by `log_group`.
    """
    cell, t, beyond = _cell(film.load_start, film.load_step, film.by_load.shape[0], log_group)
    gap, gap_slope = _value(film.by_load, cell, 0, t, beyond)
    rolling, rolling_slope = _value(film.by_load, cell, 1, t, beyond)
    shear, shear_slope = _value(film.by_load, cell, 2, t, beyond)
    inverse = 1.0 / film.load_step
    return gap, gap_slope * inverse, rolling, rolling_slope * inverse, shear, shear_slope * inverse


@jit_inline
def film_at_gap(film, log_gap):
    """Film of a contact whose gap is given.

    Parameters
    ----------
    film : Gap
    log_gap : float
        ln h0 [ln m].

    Returns
    -------
    tuple of float
        ln Q/(φ η0 u), ln F_R/(φ η0 u) and ln S/φ, each followed by its derivative by ln h0.
    """
    cell, t, beyond = _cell(film.gap_start, film.gap_step, film.by_gap.shape[0], log_gap)
    load, load_slope = _value(film.by_gap, cell, 0, t, beyond)
    rolling, rolling_slope = _value(film.by_gap, cell, 1, t, beyond)
    shear, shear_slope = _value(film.by_gap, cell, 2, t, beyond)
    inverse = 1.0 / film.gap_step
    return load, load_slope * inverse, rolling, rolling_slope * inverse, shear, shear_slope * inverse
