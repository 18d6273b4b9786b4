"""Slip over a curved and tilted contact, and the quadrature over the patch that its pure-rolling lines need.

With the station ζ along the roller's axis and the drop of the common contour h = ζ²/(2 R_d),

    v(ζ) = Δu + κ h − s ζ,

where κ = ω_rel − (Ω_in − Ω) cos α and s = −(Ω_in − Ω) sin α at the inner raceway, κ = ω_rel + Ω cos α and s = −Ω sin α
at the outer one of the downwind row, with ζ along z'; in the upwind row sin α is negative. Where v passes through zero
the roller rolls purely. A film that grips changes its stress from one limit to the other there within a small part of
the contact's length, the smaller the higher the load, so the quadrature is divided at these lines and graded towards
them. The grid moves with the lines, and its motion enters the derivatives: without it the derivative of the quadrature
would miss the jump that lies between two nodes.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit


class SlipField(NamedTuple):
    """Slip over the stations of a contact, v(ζ) = sliding + curvature_rate ζ²/(2 R_d) − spin_rate ζ [m/s].

    Attributes
    ----------
    sliding : float
        Δu [m/s], slip at ζ = 0.
    curvature_rate : float
        κ [1/s].
    spin_rate : float
        s [1/s].
    curvature_slope : float
        dκ/dΔu [1/m] along the change of state to which derivatives refer; −1/r if only the roller's spin changes.
    """

    sliding: float
    curvature_rate: float
    spin_rate: float
    curvature_slope: float


class RollingLines(NamedTuple):
    """Stations of pure rolling ζ1 ≤ ζ2 [m], kept within the contact, and how they move with Δu [s]."""

    first: float
    second: float
    first_by_slip: float
    second_by_slip: float


@jit
def slip_at(field, contour_radius, station):
    """Local slip v(ζ) [m/s] at a station [m] of a contact with common contour radius R_d [m].

    Examples
    --------
    >>> round(slip_at(SlipField(0.004, -10.0, 0.2, -30.0), 0.4107, 0.02), 6)
    -0.00487
    """
    return field.sliding + station * (field.curvature_rate * station / (2.0 * contour_radius) - field.spin_rate)


@jit
def rolling_lines(field, contour_radius, half_length):
    """Stations at which a contact rolls purely.

    Parameters
    ----------
    field : SlipField
    contour_radius : float
        R_d [m].
    half_length : float
        Half length of the patch [m].

    Returns
    -------
    RollingLines
        A line outside the patch is put on its nearer end; where v has no zero both are put on its extremum. So the two
        change continuously with the state, and with them everything integrated between them.

    Examples
    --------
    >>> lines = rolling_lines(SlipField(0.004, -10.0, 0.0, 0.0), 0.4, 0.03)
    >>> round(lines.first, 6), round(lines.second, 6)
    (-0.017889, 0.017889)
    """
    bend = 0.5 * field.curvature_rate / contour_radius
    spin = field.spin_rate
    root = spin * spin - 4.0 * bend * field.sliding
    if root <= 0.0:
        root = 0.0
        first = second = 0.5 * spin / bend if bend != 0.0 else half_length
    else:
        root = math.sqrt(root)
        larger = 0.5 * (spin + math.copysign(root, spin))
        first = larger / bend if bend != 0.0 else math.copysign(math.inf, larger)
        second = field.sliding / larger
        if first > second:
            first, second = second, first
    # Where the two are about to merge they move infinitely fast; there the grid's motion is left out.
    moves = root > 1e-7 * (abs(spin) + abs(bend) * half_length)
    first_by_slip, second_by_slip = 0.0, 0.0
    if -half_length < first < half_length:
        if moves:
            drop = 0.5 * first * first / contour_radius
            first_by_slip = -(1.0 + field.curvature_slope * drop) / (2.0 * bend * first - spin)
    else:
        first = min(max(first, -half_length), half_length)
    if -half_length < second < half_length:
        if moves:
            drop = 0.5 * second * second / contour_radius
            second_by_slip = -(1.0 + field.curvature_slope * drop) / (2.0 * bend * second - spin)
    else:
        second = min(max(second, -half_length), half_length)
    return RollingLines(first, second, first_by_slip, second_by_slip)


def graded_rule(nodes: int) -> tuple[np.ndarray, np.ndarray]:
    """Quadrature on [0, 1], graded towards both ends: nodes m and weights.

    Gauss-Legendre in t with m = 3t² − 2t³. At a line of pure rolling this resolves how fast stress turns there; at the end
    of an ellipse it makes the root of the chord's length smooth.
    """
    t, weights = np.polynomial.legendre.leggauss(nodes)
    t, weights = 0.5 * (t + 1.0), 0.5 * weights
    return t * t * (3.0 - 2.0 * t), weights * 6.0 * t * (1.0 - t)
