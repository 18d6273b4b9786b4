"""Reference rating life from the load on every roller, by ISO/TS 16281:2008: ring by ring, row by row.

The standard cuts a roller into laminae, for line contacts with any profile. A spherical roller touches its raceways in
an ellipse, whose load per length is that of Hertz, w(x) = 3 Q/(4 a) (1 - x^2/a^2); its laminae carry that. Since the
laminae account for the uneven load along the roller, the standard takes the factor lambda nu = 0.83 for such unevenness
out of the load rating. `uniform` is the other end: load spread evenly over the whole length and the factor kept, which
is what ISO 281 assumes of every bearing.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from macroslip.compiled import jit

REDUCTION = 0.83
"""lambda nu: reduction of the load rating for edge stress and uneven load along the roller."""
WEIBULL_SLOPE = 9.0 / 8.0
"""e of line contacts."""
LAMINAE = 30
"""Laminae over the whole length of a roller, as many as the standard asks for at least."""


class RingRatings(NamedTuple):
    """Dynamic load ratings of a roller's contact with each ring.

    Attributes
    ----------
    inner, outer : float
        Q_ci and Q_ce [N]: load on the roller, the same for all, that a tenth of all rings of one row does not bear for
        a million revolutions.
    """

    inner: float
    outer: float


def ring_ratings(
    dynamic_load_rating: float, rows: int, rollers_per_row: int, contact_angle: float, gamma: float
) -> RingRatings:
    """Load ratings of the contacts with inner and outer ring from the bearing's load rating.

    Q_ci = C/(0.378 Z cos(alpha) i^(7/9)) {1 + [1.038 ((1 - gamma)/(1 + gamma))^(143/108)]^(9/2)}^(2/9),
    Q_ce = C/(0.364 Z cos(alpha) i^(7/9)) {1 + [1.038 ((1 - gamma)/(1 + gamma))^(143/108)]^(-9/2)}^(2/9).

    Parameters
    ----------
    dynamic_load_rating : float
        C of the bearing [N].
    rows : int
        Number of rows i [-].
    rollers_per_row : int
        Rollers in a row Z [-].
    contact_angle : float
        alpha [rad].
    gamma : float
        Dw cos(alpha)/Dpw [-].

    Returns
    -------
    RingRatings
        Without the division by lambda nu = 0.83, which goes with laminae.

    References
    ----------
    ISO/TS 16281:2008, section 6.3.1.1. 0.378 and 0.364 are J_r/J_1 and J_r/J_2, Sjövall's and Lundberg's load integrals
    of a bearing loaded over half its circumference, to which the tests compare them.

    Examples
    --------
    >>> inner, outer = ring_ratings(8502e3, 2, 28, math.radians(11.2), 0.0921)
    >>> round(inner / 1e3), round(outer / 1e3)
    (514, 657)
    """
    ratio = 1.038 * ((1.0 - gamma) / (1.0 + gamma)) ** (143 / 108)
    share = dynamic_load_rating / (rollers_per_row * math.cos(contact_angle) * rows ** (7 / 9))
    return RingRatings(share / 0.378 * (1.0 + ratio**4.5) ** (2 / 9), share / 0.364 * (1.0 + ratio**-4.5) ** (2 / 9))


def lamina_loads(
    load: NDArray[np.float64], semi_axis: NDArray[np.float64], roller_length: float
) -> NDArray[np.float64]:
    """Load per length on the laminae of rollers, as the load that spread over the whole length would give it.

    Parameters
    ----------
    load : ndarray, shape (...)
        Roller loads Q [N].
    semi_axis : ndarray, shape (...)
        Semi-axis a of the contact ellipse along the roller [m], where Q is not zero.
    roller_length : float
        Length L [m].

    Returns
    -------
    ndarray, shape (..., LAMINAE/2)
        w L [N] of the laminae from the middle to one end; the other half is alike. Their mean is Q: where the ellipse
        would reach beyond the ends, what is left carries all.
    """
    count = LAMINAE // 2
    edges = np.linspace(0.0, 0.5 * roller_length, count + 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        place = np.minimum(edges / np.where(load > 0.0, semi_axis, np.inf)[..., None], 1.0)
    # Integral of the parabola to each edge, as a share of the half that lies on the roller.
    reached = 1.5 * place - 0.5 * place**3
    share = np.diff(reached, axis=-1)
    total = reached[..., -1:]
    return load[..., None] * np.divide(share, total, out=np.full_like(share, 1 / count), where=total > 0.0) * count


def ring_damage(load: NDArray[np.float64], rating: float, *, stationary: bool) -> NDArray[np.float64]:
    """Damage of one ring of one row, (Q_e/Q_c)^(9/2), from the loads of all its rollers.

    Q_e = (1/Z sum Q_j^4)^(1/4) of a ring that turns against the load, (1/Z sum Q_j^(9/2))^(2/9) of one that stands.

    Parameters
    ----------
    load : ndarray, shape (..., Z, laminae)
        Loads of the row's rollers on their laminae, as `lamina_loads` gives them [N]; one lamina for load that is
        spread evenly.
    rating : float
        Q_c of the ring [N]; with laminae divided by `REDUCTION`.
    stationary : bool
        Whether the ring stands still relative to the load.

    Returns
    -------
    ndarray, shape (...)
        Mean over the laminae, which is the standard's sum with q_c = Q_c (1/n)^(7/9).

    References
    ----------
    ISO/TS 16281:2008, section 6.3.1.2.

    Examples
    --------
    >>> even = np.full((28, 1), 100e3)
    >>> round(ring_damage(even, 500e3, stationary=True).item() * 5**4.5, 9)
    1.0
    """
    exponent = 4.5 if stationary else 4.0
    equivalent = np.mean((load / rating) ** exponent, axis=-2) ** (4.5 / exponent)
    return np.mean(equivalent, axis=-1)


@jit
def damage_series(load, semi_axis, roller_length, rating, stationary):
    """Damage of one ring of one row over a history, as `lamina_loads` and `ring_damage` give it, in one loop.

    Parameters
    ----------
    load : ndarray, shape (Z, n)
        Loads of the row's rollers [N].
    semi_axis : float
        Semi-axis of the contact ellipse along the roller, per Q^(1/3) [m/N^(1/3)].
    roller_length : float
        Length L [m].
    rating : float
        Q_c of the ring [N], without the division by `REDUCTION`.
    stationary : bool
        Whether the ring stands still relative to the load.

    Returns
    -------
    ndarray, shape (2, n)
        With the load along the roller of Hertz, and with load spread evenly.

    Notes
    -----
    The inner loop runs over laminae of rollers of samples, 40 million times for ten minutes; NumPy's powers of the same
    arrays take ten times as long.

    Examples
    --------
    >>> even = np.full((28, 1), 100e3)
    >>> round(float(damage_series(even, 1e-3, 0.106, 500e3, True)[1, 0]) * 5**4.5, 9)
    1.0
    """
    rollers, samples = load.shape
    count = LAMINAE // 2
    lamina = 0.5 * roller_length / count
    found = np.zeros((2, samples))
    sums = np.empty(count)
    # The outer ring's exponent is 9/2 for every roller; the inner one's 4, and the sum to the power 9/8.
    for k in range(samples):
        sums[:] = 0.0
        even = 0.0
        for j in range(rollers):
            carried = load[j, k]
            if carried <= 0.0:
                continue
            reach = semi_axis * carried ** (1.0 / 3.0)
            end = min(0.5 * roller_length / reach, 1.0)
            scale = carried * count * REDUCTION / (rating * (1.5 * end - 0.5 * end * end * end))
            before = 0.0
            for i in range(count):
                place = min((i + 1) * lamina / reach, 1.0)
                reached = 1.5 * place - 0.5 * place * place * place
                ratio = scale * (reached - before)
                fourth = ratio * ratio * ratio * ratio
                sums[i] += fourth * math.sqrt(ratio) if stationary else fourth
                before = reached
            ratio = carried / rating
            fourth = ratio * ratio * ratio * ratio
            even += fourth * math.sqrt(ratio) if stationary else fourth
        power = 1.0 if stationary else 4.5 / 4.0
        for i in range(count):
            found[0, k] += (sums[i] / rollers) ** power / count
        found[1, k] = (even / rollers) ** power
    return found


def reference_life(damage: NDArray[np.float64], axis: int | tuple[int, ...] | None = None) -> NDArray[np.float64]:
    """Basic reference rating life of rings together, L10r = 1e6 (sum (Q_c/Q_e)^(-9/2))^(-8/9) revolutions.

    Parameters
    ----------
    damage : ndarray
        From `ring_damage`.
    axis : int, tuple of int or None
        Axes of rings and rows to take together; None for all.

    Returns
    -------
    ndarray
        L10r [revolutions]; infinite without load.

    References
    ----------
    ISO/TS 16281:2008, section 6.3.2.

    Examples
    --------
    >>> reference_life(np.array([1.0])).item(), round(reference_life(np.array([1.0, 1.0])).item())
    (1000000.0, 540030)
    """
    with np.errstate(divide="ignore"):
        return 1e6 * np.sum(damage, axis=axis) ** (-1.0 / WEIBULL_SLOPE)
