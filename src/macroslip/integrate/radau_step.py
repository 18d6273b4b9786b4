"""One step of the three-stage Radau IIA method (order 5, L-stable) for the slip of a roller.

The stage equations are those of v(t) = v0 + [u2(t) − u2(t0)] − (r²/I_z') ∫ F dt: the ring's speed u2 enters by its exact
difference and only the forces are integrated numerically. Multiplied by the inverse of the method's matrix and divided
by h r²/I_z' they read, in newtons,

    R_i = Σ_j (A⁻¹)_ij (v_j − v0 − u2_j + u2_0)/(h r²/I_z') + F_i + F_o + F_c |_i = 0,

so a tolerance on the residual is a tolerance on force, however stiff the contact. Every stage has its own derivative of
the force, and Newton's matrix A⁻¹/(h r²/I_z') + diag(F') is exact.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit

_ROOT_6 = math.sqrt(6.0)
#: Stage times c and matrix A of Radau IIA, order 5 (Hairer & Wanner, Solving ODEs II, table IV.5.6).
NODES = ((4.0 - _ROOT_6) / 10.0, (4.0 + _ROOT_6) / 10.0, 1.0)
MATRIX = np.array(
    [
        [(88.0 - 7.0 * _ROOT_6) / 360.0, (296.0 - 169.0 * _ROOT_6) / 1800.0, (-2.0 + 3.0 * _ROOT_6) / 225.0],
        [(296.0 + 169.0 * _ROOT_6) / 1800.0, (88.0 + 7.0 * _ROOT_6) / 360.0, (-2.0 - 3.0 * _ROOT_6) / 225.0],
        [(16.0 - _ROOT_6) / 36.0, (16.0 + _ROOT_6) / 36.0, 1.0 / 9.0],
    ]
)
WEIGHTS = (float(MATRIX[2, 0]), float(MATRIX[2, 1]), float(MATRIX[2, 2]))
A11, A12, A13, A21, A22, A23, A31, A32, A33 = (float(x) for x in np.linalg.inv(MATRIX).ravel())
#: Real eigenvalue of A⁻¹.
EIGENVALUE = float(min(np.linalg.eigvals(np.linalg.inv(MATRIX)), key=lambda z: abs(z.imag)).real)


def _embedded_difference() -> tuple[float, float, float, float]:
    """Weights of (third-order rule with weight 1/EIGENVALUE at the start) − (Radau rule), at nodes 0, c1, c2, 1."""
    first = 1.0 / EIGENVALUE
    powers = np.vander(NODES, 3, increasing=True).T
    rest = np.linalg.solve(powers, np.array([1.0 - first, 0.5, 1.0 / 3.0]))
    one, two, three = (float(x) for x in rest - np.array(WEIGHTS))
    return first, one, two, three


EMBEDDED = _embedded_difference()


class Residuals(NamedTuple):
    """Stage residuals [N]."""

    first: float
    second: float
    third: float


@jit
def residuals(scale, z1, z2, z3, f1, f2, f3):
    """R_i from stage increments z_i = v_i − v0 − (u2_i − u2_0) [m/s] and forces [N]; `scale` is 1/(h r²/I_z')."""
    return Residuals(
        scale * (A11 * z1 + A12 * z2 + A13 * z3) + f1,
        scale * (A21 * z1 + A22 * z2 + A23 * z3) + f2,
        scale * (A31 * z1 + A32 * z2 + A33 * z3) + f3,
    )


@jit
def newton_update(scale, d1, d2, d3, residual):
    """Solve [scale A⁻¹ + diag(d)] Δ = −R. No pivoting: for d ≥ 0 all leading minors are positive."""
    m11 = scale * A11 + d1
    m12 = scale * A12
    m13 = scale * A13
    q2 = scale * A21 / m11
    q3 = scale * A31 / m11
    m22 = scale * A22 + d2 - q2 * m12
    m23 = scale * A23 - q2 * m13
    r2 = -residual.second + q2 * residual.first
    p3 = (scale * A32 - q3 * m12) / m22
    m33 = scale * A33 + d3 - q3 * m13 - p3 * m23
    r3 = -residual.third + q3 * residual.first - p3 * r2
    x3 = r3 / m33
    x2 = (r2 - m23 * x3) / m22
    return (-residual.first - m12 * x2 - m13 * x3) / m11, x2, x3


@jit
def slip_error(scale, slope, force_0, z1, z2, z3):
    """Estimated error of the slip after the step [m/s] (Hairer & Wanner IV.8), filtered by the least slope [N s/m]."""
    e1 = -(13.0 + 7.0 * _ROOT_6) / 3.0
    e2 = -(13.0 - 7.0 * _ROOT_6) / 3.0
    e3 = -1.0 / 3.0
    return (-force_0 + scale * (e1 * z1 + e2 * z2 + e3 * z3)) / (scale * EIGENVALUE + slope)


@jit
def energy_error(step, p0, p1, p2, p3):
    """Estimated error of the energy spent in the step [J], from powers at the start and at the stages [W]."""
    return step * (EMBEDDED[0] * p0 + EMBEDDED[1] * p1 + EMBEDDED[2] * p2 + EMBEDDED[3] * p3)


@jit
def collocation(part, z1, z2, z3):
    """Increment of the collocation polynomial [m/s] at a part of the step, and its derivative by that part [m/s].

    Examples
    --------
    >>> increment, rate = collocation(0.5, NODES[0] ** 3, NODES[1] ** 3, 1.0)
    >>> round(increment, 12), round(rate, 12)
    (0.125, 0.75)
    """
    a, b = NODES[0], NODES[1]
    # Newton's divided differences through (0, 0), (a, z1), (b, z2), (1, z3).
    first = z1 / a
    second = ((z2 - z1) / (b - a) - first) / b
    third = ((z3 - z2) / (1.0 - b) - (z2 - z1) / (b - a)) / (1.0 - a) - second
    increment = part * (first + (part - a) * (second + (part - b) * third))
    rate = first + second * (2.0 * part - a) + third * ((part - a) * (part - b) + part * (2.0 * part - a - b))
    return increment, rate
