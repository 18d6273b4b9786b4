"""Ratings of radial roller bearings by ISO 76, ISO 281 and ISO/TS 16281.

With the makers' minimum load.

Lives are in revolutions. Load ratings themselves (C0, C, C_u) stand in
`macroslip.bearing.load_ratings`.

ISO/TS 16281 cuts a roller into laminae, for line contacts with any profile. A spherical roller
touches its raceways in an ellipse, whose load per length is Hertz', w(x) = 3 Q/(4 a) (1 - x^2/a^2);
its laminae carry that. Since the laminae account for the uneven load along the roller, the standard
takes the factor lambda nu = 0.83 for such unevenness out of the load rating.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from macroslip.arrays import FloatArray
from macroslip.compiled import jit

LIFE_EXPONENT = 10.0 / 3.0
"""p in L = (C/P)^p of roller bearings."""
LARGEST_MODIFICATION = 50.0
"""a_ISO is not to be taken larger."""
VISCOSITY_RATIO_RANGE = (0.1, 4.0)
"""Viscosity ratios for which a_ISO is defined; above it the factor at the upper end holds."""
REDUCTION = 0.83
"""lambda nu: reduction of the load rating for edge stress and uneven load along the roller."""
WEIBULL_SLOPE = 9.0 / 8.0
"""e of line contacts."""
LAMINAE = 30
"""Laminae over the whole length of a roller, the least number that the standard requires."""
MINIMUM_SHARE = 0.01
"""Least equivalent load over static load rating of spherical roller bearings."""
MINIMUM_SHARE_OF_ROLLERS = 0.02
"""Least equivalent load over dynamic load rating of roller bearings in general."""


def static_equivalent_load(
    radial_load: ArrayLike, axial_load: ArrayLike, factor_y0: float
) -> FloatArray:
    """Static equivalent radial load P0 = Fr + Y0 |Fa| [N] of a double-row bearing.

    ISO 76:2006, section 6.2, X0 = 1.

    Of Fr, not negative, and Fa, either sign [N], with the catalogue's Y0 [-]; 0.44 cot(alpha) in
    the standard.

    Examples
    --------
    >>> float(static_equivalent_load(300e3, -100e3, 2.2))
    520000.0
    """
    return np.asarray(radial_load, float) + factor_y0 * np.abs(axial_load)


def static_safety(static_load_rating: float, equivalent_load: ArrayLike) -> FloatArray:
    """Static safety factor S0 = C0/P0 [-] of loads [N] by ISO 76:2006; infinite without load.

    Examples
    --------
    >>> round(float(static_safety(16300e3, 520e3)), 2)
    31.35
    """
    with np.errstate(divide="ignore"):
        return static_load_rating / np.asarray(equivalent_load, float)


def minimum_load(static_load_rating: float) -> float:
    """Least dynamic equivalent load P_min = 0.01 C0 [N] of a spherical roller bearing.

    Below it rollers skid.

    A rule of thumb, which depends on neither speed nor lubricant: SKF, Rolling bearings, catalogue
    17000 EN (2018), chapter on spherical roller bearings, "Minimum load".

    Examples
    --------
    >>> minimum_load(16300e3)
    163000.0
    """
    return MINIMUM_SHARE * static_load_rating


def minimum_load_of_rollers(dynamic_load_rating: float) -> float:
    """Least dynamic equivalent load of a roller bearing so that rollers do not skid, 0.02 C [N].

    The rule of thumb for roller bearings of any kind: SKF, Rolling bearings, catalogue 17000 EN
    (2018), "Requisite minimum load". Formulas of single makers take speed and viscosity too.

    Examples
    --------
    >>> minimum_load_of_rollers(500e3)
    10000.0
    """
    return MINIMUM_SHARE_OF_ROLLERS * dynamic_load_rating


def dynamic_equivalent_load(
    radial_load: ArrayLike, axial_load: ArrayLike, e: float, y1: float, y2: float
) -> FloatArray:
    """Dynamic equivalent radial load of a double-row spherical roller bearing.

    P = Fr + Y1 |Fa| where |Fa| <= e Fr, else 0.67 Fr + Y2 |Fa|. As catalogues round the factors, P
    has a step of up to a few per cent at |Fa| = e Fr.

    Parameters
    ----------
    radial_load : array_like
        Fr [N], not negative.
    axial_load : array_like
        Fa [N], either sign.
    e : float
        Limit of Fa/Fr for Y1 [-]; 1.5 tan(alpha) in the standard.
    y1 : float
        Axial load factor below the limit [-]; 0.45 cot(alpha) in the standard.
    y2 : float
        Axial load factor above the limit [-]; 0.67 cot(alpha) in the standard.

    Returns
    -------
    ndarray
        P [N].

    References
    ----------
    ISO 281:2007, table 8.

    Examples
    --------
    >>> dynamic_equivalent_load([300e3, 300e3], [50e3, -150e3], 0.3, 2.3, 3.4).round().tolist()
    [415000.0, 711000.0]
    """
    radial = np.asarray(radial_load, float)
    axial = np.abs(axial_load)
    light = radial + y1 * axial
    heavy = 0.67 * radial + y2 * axial
    is_light = axial <= e * radial
    return np.where(is_light, light, heavy)


def basic_life(load_rating: float, equivalent_load: ArrayLike) -> FloatArray:
    """Basic rating life with 90 % reliability, L10 = 1e6 (C/P)^(10/3) revolutions of loads [N].

    It is infinite without load.

    ISO 281:2007, section 8; valid to P = C/2, no range is stated below.

    Examples
    --------
    >>> f"{basic_life(8502e3, 415e3):.4g}"
    '2.353e+10'
    """
    with np.errstate(divide="ignore"):
        ratio = load_rating / np.asarray(equivalent_load, float)
        return 1e6 * ratio**LIFE_EXPONENT


def mean_equivalent_load(equivalent_load: ArrayLike, revolutions: ArrayLike) -> float:
    """Constant load [N] with the life of a varying one, P_m = (sum P^p n / sum n)^(1/p), p = 10/3.

    It is NaN at rest.

    Of loads P [N] and the revolutions n made under each, not negative, in any unit.

    Examples
    --------
    >>> round(mean_equivalent_load([100e3, 200e3], [1.0, 1.0]))
    167127
    """
    weight = np.asarray(revolutions, float)
    if weight.sum() == 0.0:
        return math.nan
    return float(
        np.average(np.asarray(equivalent_load, float) ** LIFE_EXPONENT, weights=weight)
        ** (1 / LIFE_EXPONENT)
    )


def reference_viscosity(speed: float, pitch: float) -> float:
    """Kinematic viscosity [m2/s] that the standard requires.

    At a speed [rad/s], not zero, and a pitch diameter [m].

    nu1 = 45000 n^-0.83 Dpw^-0.5 mm2/s (n in rpm, Dpw in mm); from 1000 rpm on 4500 n^-0.5 Dpw^-0.5.
    ISO 281:2007, section 9.3.3.2, equations (26) and (27).

    Examples
    --------
    >>> round(reference_viscosity(2 * math.pi * 20 / 60, 0.7454) * 1e6, 1)
    137.1
    """
    rpm = abs(speed) * 30.0 / math.pi
    by_speed = 45000.0 * rpm**-0.83 if rpm < 1000.0 else 4500.0 * rpm**-0.5
    millimetres = 1e3 * pitch
    return 1e-6 * by_speed * millimetres**-0.5


def life_modification(
    viscosity_ratio: float, contamination: float, load_ratio: ArrayLike
) -> FloatArray:
    """Life modification factor a_ISO [-] of radial roller bearings.

    a_ISO = 0.1 [1 - (1.5859 - A/kappa^B) (e_C C_u/P)^0.4]^-9.185, at most 50, with (A, B) =
    (1.3993, 0.054381) for kappa below 0.4, (1.2348, 0.19087) to 1, and (1.2348, 0.071739) to 4.
    kappa = nu/nu1 [-] is at least 0.1; above 4 the value at 4 holds. Below 0.1, or NaN, the
    standard defines no factor, and it is NaN. e_C [-] is 0 (very severe) to 1 (extreme
    cleanliness), C_u/P [-] not negative.

    ISO 281:2007, section 9.3.3.3, equations (31) to (33) and figure 4.

    Examples
    --------
    >>> life_modification(1.0, 1.0, [0.1, 0.5, 5.0]).round(3).tolist()
    [0.399, 1.714, 50.0]
    >>> life_modification(0.05, 1.0, 1.0).item()
    nan
    """
    ratio = np.asarray(load_ratio, float)
    lowest, highest = VISCOSITY_RATIO_RANGE
    if not viscosity_ratio >= lowest:
        return np.full_like(ratio, np.nan)
    kappa = min(viscosity_ratio, highest)
    a, b = (
        (1.3993, 0.054381)
        if kappa < 0.4
        else (1.2348, 0.19087)
        if kappa < 1.0
        else (1.2348, 0.071739)
    )
    # At kappa 0.1 the film's part is zero but for the rounding of its coefficients. Where the
    # bracket is not positive the endurance limit is reached.
    by_film = max(1.5859 - a / kappa**b, 0.0)
    cleanliness = (contamination * ratio) ** 0.4
    bracket = 1.0 - by_film * cleanliness
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        finite = 0.1 * np.abs(bracket) ** -9.185
        factor = np.where(bracket > 0.0, finite, np.inf)
    return np.minimum(factor, LARGEST_MODIFICATION)


class RingRatings(NamedTuple):
    """Load ratings of the rings of one row [N].

    Under such a load on each roller a tenth of the rings fail before 1e6 revolutions.
    """

    inner: float
    outer: float


def ring_ratings(
    dynamic_load_rating: float, rows: int, rollers_per_row: int, contact_angle: float, gamma: float
) -> RingRatings:
    """Dynamic load ratings of a roller's contacts with inner and outer ring.

    They follow from the bearing's load rating. With
    g = [1.038 ((1 - gamma)/(1 + gamma))^(143/108)]^(9/2),

    Q_ci = C/(0.378 Z cos(alpha) i^(7/9)) (1 + g)^(2/9),
    Q_ce = C/(0.364 Z cos(alpha) i^(7/9)) (1 + 1/g)^(2/9),

    without the division by lambda nu = 0.83, which goes with laminae.

    Parameters
    ----------
    dynamic_load_rating : float
        C of the bearing [N].
    rows : int
        Number of rows i.
    rollers_per_row : int
        Number of rollers in a row Z.
    contact_angle : float
        alpha [rad].
    gamma : float
        Dw cos(alpha)/Dpw [-], 0 to 1.

    Returns
    -------
    RingRatings
        Q_ci and Q_ce [N].

    References
    ----------
    ISO/TS 16281:2008, section 6.3.1.1. 0.378 and 0.364 are J_r/J_1 and J_r/J_2, Sjövall's and
    Lundberg's load integrals of a bearing loaded over half its circumference, to which the tests
    compare them.

    Examples
    --------
    >>> inner, outer = ring_ratings(8502e3, 2, 28, math.radians(11.2), 0.0921)
    >>> round(inner / 1e3), round(outer / 1e3)
    (514, 657)
    """
    diameter_ratio = (1.0 - gamma) / (1.0 + gamma)
    ratio = 1.038 * diameter_ratio ** (143 / 108)
    effective_rollers = rollers_per_row * math.cos(contact_angle) * rows ** (7 / 9)
    share = dynamic_load_rating / effective_rollers
    inner = share / 0.378 * (1.0 + ratio**4.5) ** (2 / 9)
    outer = share / 0.364 * (1.0 + ratio**-4.5) ** (2 / 9)
    return RingRatings(inner, outer)


@jit
def damage_series(load, semi_axis, roller_length, rating, stationary):
    """Damage of one ring of one row over a history, (Q_e/Q_c)^(9/2).

    Q_e = (1/Z sum Q_j^4)^(1/4) of a ring that turns against the load, (1/Z sum Q_j^(9/2))^(2/9) of
    one at rest. Along the roller the damage is the mean over laminae, on each of which a load Q_j
    counts that spread over the whole length would give what it bears per length: Hertz' ellipse, or
    what lies within the roller's ends, carrying all. The mean is the standard's sum with
    q_c = Q_c (1/n)^(7/9).

    Parameters
    ----------
    load : ndarray, shape (Z, n)
        Loads of the row's rollers [N]; those not above 0 count as none.
    semi_axis : float
        Semi-axis of the contact ellipse along the roller, per Q^(1/3) [m/N^(1/3)].
    roller_length : float
        Effective length L of a roller [m].
    rating : float
        Q_c of the ring [N], without the division by `REDUCTION`.
    stationary : bool
        Whether the ring is at rest relative to the load.

    Returns
    -------
    ndarray, shape (2, n)
        Damage [-] with the load along the roller of Hertz, and with load spread evenly and the
        factor 0.83 kept, which is what ISO 281 assumes of every bearing.

    Notes
    -----
    The inner loop runs over laminae of rollers of samples, 40 million times for ten minutes;
    NumPy's powers of the same arrays take ten times as long.

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
    damage = np.zeros((2, samples))
    sums = np.empty(count)
    # The outer ring's exponent is 9/2 for every roller; the inner one's 4, and the sum to the power
    # 9/8.
    for k in range(samples):
        sums[:] = 0.0
        even = 0.0
        for j in range(rollers):
            carried = load[j, k]
            if carried <= 0.0:
                continue
            reach = semi_axis * carried ** (1.0 / 3.0)
            end = min(0.5 * roller_length / reach, 1.0)
            covered = 1.5 * end - 0.5 * end * end * end
            scale = carried * count * REDUCTION / (rating * covered)
            before = 0.0
            for i in range(count):
                end_of_lamina = min((i + 1) * lamina / reach, 1.0)
                reached = 1.5 * end_of_lamina - 0.5 * end_of_lamina * end_of_lamina * end_of_lamina
                ratio = scale * (reached - before)
                fourth = ratio * ratio * ratio * ratio
                sums[i] += fourth * math.sqrt(ratio) if stationary else fourth
                before = reached
            ratio = carried / rating
            fourth = ratio * ratio * ratio * ratio
            even += fourth * math.sqrt(ratio) if stationary else fourth
        power = 1.0 if stationary else 4.5 / 4.0
        for i in range(count):
            damage[0, k] += (sums[i] / rollers) ** power / count
        damage[1, k] = (even / rollers) ** power
    return damage


def reference_life(damage: FloatArray, axis: int | tuple[int, ...] | None = None) -> FloatArray:
    """Basic reference rating life of rings together [revolutions].

    L10r = 1e6 (sum (Q_c/Q_e)^(-9/2))^(-8/9).

    ISO/TS 16281:2008, section 6.3.2; of `damage_series`, over the axes of the rings and rows to
    take together, None for all. Without load the life is infinite.

    Examples
    --------
    >>> reference_life(np.array([1.0])).item(), round(reference_life(np.array([1.0, 1.0])).item())
    (1000000.0, 540030)
    """
    with np.errstate(divide="ignore"):
        total = np.sum(damage, axis=axis)
        return 1e6 * total ** (-1.0 / WEIBULL_SLOPE)
