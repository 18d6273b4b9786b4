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
"""Laminae over the whole length of a roller, the least number that the standard requires."""


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


@jit
def damage_series(load, semi_axis, roller_length, rating, stationary):
    """Damage of one ring of one row over a history, (Q_e/Q_c)^(9/2), from the loads of all its rollers.

    Q_e = (1/Z sum Q_j^4)^(1/4) of a ring that turns against the load, (1/Z sum Q_j^(9/2))^(2/9) of one at rest. Along
    the roller it is the mean over laminae, on each of which a load Q_j counts that spread over the whole length would give
    what it bears per length: that of Hertz' ellipse, of which what is left carries all where it would reach beyond the ends.
    The mean is the standard's sum with q_c = Q_c (1/n)^(7/9).

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
        Whether the ring is at rest relative to the load.

    Returns
    -------
    ndarray, shape (2, n)
        With the load along the roller of Hertz, and with load spread evenly.

    Notes
    -----
    The inner loop runs over laminae of rollers of samples, 40 million times for ten minutes; NumPy's powers of the same
    arrays take ten times as long.

    References
    ----------
    ISO/TS 16281:2008, section 6.3.1.2.

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
        From `damage_series`.
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
