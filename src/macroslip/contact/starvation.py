"""Starvation: film and rolling resistance of an elastic contact whose inlet is not full.

The state of an inlet is S, the gap where it begins to be full over the film of the contact. Outside
a Hertzian line contact the gap rises as h* (1 + y), y with the power 3/2 of the way, and the
reduced pressure has to reach 1/α_p at the edge:

    1/α_p = ∫ 12 η0 u (h − h*)/h³ dx from the place where h = S h*.

So h*^(4/3) goes with ∫₀^(S−1) y^(2/3)/(1 + y)³ dy, an incomplete beta function, whatever load and
speed are.
"""

from __future__ import annotations

import functools
import math

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.special import betainc, betaincinv

from macroslip.contact.gap import starved_martin

#: Least and largest S − 1 of tables.
_LEAST = 1e-3
_LARGEST = 1e7
_KNOTS = 400
#: Distance between neighbouring gaps at which tables are made, in the logarithm, and the gap over
#: the flooded film from which on tables of two of them serve for those between.
_GAP_SPACING = 0.125
_WIDE = 8.0
#: Gap over the flooded film from which on they may be farther apart, by a whole number.
_WIDEST = 100.0
_WIDER_SPACING = 2


def film_factor(inlet):
    """Film thickness over that of a flooded contact, I(5/3, 4/3; 1 − 1/S)^(3/4), from S > 1.

    Examples
    --------
    >>> [round(float(film_factor(inlet)), 3) for inlet in (2.0, 3.0, 10.0, 175.0)]
    [0.515, 0.705, 0.937, 0.999]
    """
    return betainc(5.0 / 3.0, 4.0 / 3.0, 1.0 - 1.0 / np.asarray(inlet)) ** 0.75


def inlet_for_film(factor: float) -> float:
    """S [-] at which the film is `factor` times that of a flooded contact.

    `factor` is above 0 and at most 1; S is infinite at 1.

    Examples
    --------
    >>> round(inlet_for_film(0.7), 3), inlet_for_film(1.0)
    (2.963, inf)
    """
    share = 1.0 - float(betaincinv(5.0 / 3.0, 4.0 / 3.0, factor ** (4.0 / 3.0)))
    return 1.0 / share if share > 0.0 else math.inf


def inlet_for_rolling(factor: float) -> float:
    """S [-] at which `macroslip.contact.rolling.starvation_factor` is `factor`.

    `factor` is above 0.12 and below 1.

    Examples
    --------
    >>> round(inlet_for_rolling(0.9), 1)
    174.7
    """
    square = 1.0 - factor
    linear = 162.8 - 193.1 * factor
    return max(
        1.0 + _LEAST,
        (math.sqrt(linear * linear + 4.0 * square * 1257.0 * factor) - linear) / (2.0 * square),
    )


def _within(spline: CubicSpline, coordinate) -> np.ndarray:
    """Values of a spline, of which those at its ends are held beyond them."""
    return spline(np.clip(coordinate, spline.x[0], spline.x[-1]))


@functools.cache
def _inlets() -> CubicSpline:
    """Ln(S − 1) over ln(S `film_factor`)."""
    above = np.geomspace(_LEAST, _LARGEST, _KNOTS)
    inlet = 1.0 + above
    return CubicSpline(np.log(inlet * film_factor(inlet)), np.log(above))


@functools.cache
def _film_factors() -> CubicSpline:
    """Ln `film_factor` over ln(S `film_factor`)."""
    inlet = 1.0 + np.geomspace(_LEAST, _LARGEST, _KNOTS)
    factor = film_factor(inlet)
    return CubicSpline(np.log(inlet * factor), np.log(factor))


@functools.cache
def _martin() -> CubicSpline:
    """Ln of the starved over the flooded rolling force of a rigid line contact, over ln(S − 1)."""
    above = np.geomspace(_LEAST, _LARGEST, 80)
    rolling = [starved_martin(1.0 + excess)[1] for excess in above]
    return CubicSpline(np.log(above), np.log(rolling))


def inlet_at_gap(gap, flooded_film):
    """S of contacts whose inlets are full from a given gap on.

    It follows from that gap and the film that the contact had flooded, both [m].

    It solves S `film_factor`(S) = gap/flooded_film.

    Examples
    --------
    >>> round(float(inlet_at_gap(2.963 * 0.7e-6, 1e-6)), 3)
    2.963
    """
    return 1.0 + np.exp(_within(_inlets(), np.log(gap) - np.log(flooded_film)))


def film_factor_at_gap(gap, flooded_film):
    """Film thickness over that of a flooded contact, of contacts full from a given gap on.

    It is `film_factor` of `inlet_at_gap`, by a table of its own, with which contacts by the thousand
    take a tenth of the time. Gap and flooded film are in metres.

    Examples
    --------
    >>> round(float(film_factor_at_gap(2.963 * 0.7e-6, 1e-6)), 3)
    0.7
    """
    return np.exp(_within(_film_factors(), np.log(gap) - np.log(flooded_film)))


def rigid_rolling_factor(inlet):
    """Rolling force of a starved rigid line contact over that of a flooded one with the same gap.

    S is > 1.

    Examples
    --------
    >>> round(float(rigid_rolling_factor(10.0)), 3)
    0.499
    """
    return np.exp(_within(_martin(), np.log(np.asarray(inlet) - 1.0)))


def shared_gaps(
    oil_gap: float, flooded_film: float, fineness: float
) -> tuple[tuple[float, float], ...]:
    """Gaps of a grid that all cases share, with weights that make a table of them.

    Where inlets are nearly full, what a contact does is nearly linear in the reciprocal of the gap
    from which on they are full. At a fineness of 1, with a gap of 8 to 20 times the flooded film, 1/h is
    interpolated within 5e-5, and from 20 to 100 times within 2e-5; beyond, where gaps are twice as far
    apart, within 1e-5. Under lighter loads, whose films may be as thick as the gap, it is within 6e-5 up
    to 100 times and within 3e-4 beyond. Tables of cases whose gaps differ by their mean loads and speeds
    only are then sums of the same few.

    Parameters
    ----------
    oil_gap : float
        Gap where the inlet begins to be full [m]; infinite where flooded.
    flooded_film : float
        Film of the contact under its highest load, flooded [m].
    fineness : float
        Distances between nodes of tables over those at the default tolerance.

    Returns
    -------
    tuple of (float, float)
        Gaps [m] and weights [-], of sum 1: two neighbours of the grid, or the gap itself where the
        inlet is flooded, or so empty that the film is far from flooded.

    Examples
    --------
    >>> [(round(1e6 * gap, 1), round(weight, 3)) for gap, weight in shared_gaps(2e-4, 1e-6, 1.0)]
    [(158.5, 0.061), (203.5, 0.939)]
    >>> [(round(1e6 * gap, 1), round(weight, 3)) for gap, weight in shared_gaps(2e-5, 1e-6, 1.0)]
    [(18.9, 0.543), (21.4, 0.457)]
    >>> shared_gaps(2e-6, 1e-6, 1.0)
    ((2e-06, 1.0),)
    """
    if math.isinf(oil_gap) or oil_gap < _WIDE * flooded_film:
        return ((oil_gap, 1.0),)
    spacing = _GAP_SPACING * fineness**2
    if oil_gap >= _WIDEST * flooded_film:
        spacing *= _WIDER_SPACING
    number = math.floor(math.log(oil_gap) / spacing)
    near = math.exp(number * spacing)
    far = math.exp((number + 1) * spacing)
    per_near = 1.0 / near
    weight = (1.0 / oil_gap - per_near) / (1.0 / far - per_near)
    return (near, 1.0 - weight), (far, weight)
