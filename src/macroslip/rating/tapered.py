"""Rating of tapered roller bearings: ISO 281 and ISO 76 by the geometry, ISO/TS 16281 by strips."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from macroslip.arrays import FloatArray
from macroslip.bearing import load_ratings
from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.contact.hertz import effective_modulus
from macroslip.contact.line import line_pressure
from macroslip.contact.line_rolling import raceway_curvatures
from macroslip.rating.iso import REDUCTION, reference_life, ring_ratings
from macroslip.ring.tapered import ROW_SIGNS, TaperedBalance, TaperedRing, strip_loads


class TaperedRatings(NamedTuple):
    """Load ratings and axial factors of both rows together."""

    dynamic: float  #: C [N]
    static: float  #: C0 [N]
    axial_factor_e: float  #: e [-]
    axial_factor_y1: float  #: Y1 for axial over radial load up to e [-]
    axial_factor_y2: float  #: Y2 above e [-]
    axial_factor_y0: float  #: Y0 [-]


def tapered_ratings(bearing: TaperedBearing) -> TaperedRatings:
    """Load ratings of a double-row tapered roller bearing and its axial factors.

    Parameters
    ----------
    bearing : TaperedBearing
        Its file's C and C0 count where it has them; makers' differ from the standards' formulas by
        up to 40 %.

    Returns
    -------
    TaperedRatings
        e = 1.5 tan α, Y1 = 0.45 cot α, Y2 = 0.67 cot α and Y0 = 0.44 cot α with the nominal contact
        angle α, the half-angle of the outer ring's raceway.

    References
    ----------
    ISO 281:2007, table 8; ISO 76:2006, table 5.

    Examples
    --------
    >>> ratings = tapered_ratings(TaperedBearing.read("tdo-main-bearing"))
    >>> round(ratings.dynamic / 1e3), round(ratings.axial_factor_e, 3)
    (8090, 0.88)
    """
    row = tapered_geometry(bearing)
    # ISO counts diameter and pitch circle at the roller's middle, and the angle of the outer ring.
    dynamic = bearing.dynamic_load_rating
    if dynamic is None:
        dynamic = load_ratings.dynamic_load_rating_of(bearing)
    static = bearing.static_load_rating
    if static is None:
        static = load_ratings.static_load_rating_of(bearing)
    cotangent = 1.0 / math.tan(row.outer_angle)
    return TaperedRatings(
        dynamic=dynamic,
        static=static,
        axial_factor_e=1.5 / cotangent,
        axial_factor_y1=0.45 * cotangent,
        axial_factor_y2=0.67 * cotangent,
        axial_factor_y0=0.44 * cotangent,
    )


def equivalent_load(ratings: TaperedRatings, radial: ArrayLike, axial: ArrayLike) -> FloatArray:
    """Dynamic equivalent radial load of a double-row tapered roller bearing [N].

    It knows neither moments nor preload: with these use `tapered_reference_life`.

    Parameters
    ----------
    ratings : TaperedRatings
    radial, axial : array_like
        Radial load F_r, not negative, and axial load F_a of either sign [N].

    Returns
    -------
    ndarray
        P = F_r + Y1 |F_a| for |F_a|/F_r up to e, and 0.67 F_r + Y2 |F_a| above.

    References
    ----------
    ISO 281:2007, section 8.3.

    Examples
    --------
    >>> ratings = tapered_ratings(TaperedBearing.read("tdo-main-bearing"))
    >>> [round(float(load) / 1e3) for load in equivalent_load(ratings, [1300e3, 0.0], [700e3, 700e3])]
    [1837, 799]
    """
    across = np.asarray(radial, float)
    along = np.abs(axial)
    mixed = across + ratings.axial_factor_y1 * along
    axial_load = 0.67 * across + ratings.axial_factor_y2 * along
    is_mixed = along <= ratings.axial_factor_e * across
    return np.where(is_mixed, mixed, axial_load)


def static_equivalent_load(
    ratings: TaperedRatings, radial: ArrayLike, axial: ArrayLike
) -> FloatArray:
    """Static equivalent radial load P0 = F_r + Y0 |F_a| [N] of a double-row bearing.

    Parameters
    ----------
    ratings : TaperedRatings
    radial, axial : array_like
        Radial load F_r, not negative, and axial load F_a of either sign [N].

    References
    ----------
    ISO 76:2006, section 6.2.

    Examples
    --------
    >>> ratings = tapered_ratings(TaperedBearing.read("tdo-main-bearing"))
    >>> round(float(static_equivalent_load(ratings, 1300e3, 700e3)) / 1e3)
    1825
    """
    across = np.asarray(radial, float)
    return across + ratings.axial_factor_y0 * np.abs(axial)


def strip_damage(strips: FloatArray, rating: float, stationary: bool) -> FloatArray:
    """Damage of one ring of a row by its strips, (q_e/q_c)^(9/2), mean over the strips.

    Parameters
    ----------
    strips : ndarray, shape (..., rollers, k)
        Loads of the strips of a row's rollers [N].
    rating : float
        Q_c of the ring [N], without the division by 0.83.
    stationary : bool
        Whether the ring is at rest relative to the load.

    Returns
    -------
    ndarray, shape (...)
        On every strip q_e is the mean over the rollers with the power 9/2 on a ring at rest, 4 on
        one that turns, and q_c = Q_c (1/k)^(7/9)/0.83.

    References
    ----------
    ISO/TS 16281:2008, section 6.3.1.2.

    Examples
    --------
    Even loads of Q_c on every roller, spread evenly over the strips:

    >>> even = np.full((34, 41), 500e3 / 41)
    >>> round(float(strip_damage(even, 500e3, True)) / 0.83**4.5, 9)
    1.0
    """
    count = strips.shape[-1]
    ratio = strips * count * REDUCTION / rating
    if stationary:
        over_rollers = (ratio**4.5).mean(axis=-2)
        return over_rollers.mean(axis=-1)
    over_turn = (ratio**4.0).mean(axis=-2)
    return (over_turn ** (4.5 / 4.0)).mean(axis=-1)


def tapered_reference_life(
    bearing: TaperedBearing,
    ring: TaperedRing,
    balance: TaperedBalance,
    shaft_angle: FloatArray,
) -> float:
    """Basic reference rating life of both rows under a load history [revolutions of the shaft].

    Moments, preload, tilt of rollers and their profile count, by the loads of the strips.

    Parameters
    ----------
    bearing : TaperedBearing
    ring : TaperedRing
        That of the balance.
    balance : TaperedBalance
    shaft_angle : ndarray, shape (n,)
        Shaft angles of the balance [rad], n ≥ 2; damage is weighted by the angle turned.

    Returns
    -------
    float
        L10r [revolutions]; infinite without load, NaN where the shaft does not turn.

    References
    ----------
    ISO/TS 16281:2008, section 6.3.
    """
    # Every sample stands for half of the angle to each of its neighbours.
    turned = np.abs(np.gradient(shaft_angle))
    if not turned.any():
        return math.nan
    damage = strip_rating(bearing, ring, balance, shaft_angle).damage
    mean_damage = np.average(damage, axis=-1, weights=turned)
    return float(reference_life(mean_damage))


class StripRating(NamedTuple):
    """Damage and largest pressures of the raceways over a load history, from the loads of strips."""

    damage: FloatArray  #: (Q_e/Q_c)^(9/2) over (row, raceway, sample)
    pressure: FloatArray  #: Largest pressure [Pa] over (row, raceway)


def strip_rating(
    bearing: TaperedBearing,
    ring: TaperedRing,
    balance: TaperedBalance,
    shaft_angle: FloatArray,
) -> StripRating:
    """Damage of every raceway at every sample, and its largest pressure, by the loads of strips.

    Parameters
    ----------
    bearing : TaperedBearing
    ring : TaperedRing
        That of the balance.
    balance : TaperedBalance
    shaft_angle : ndarray, shape (n,)
        Shaft angles of the balance [rad].

    Returns
    -------
    StripRating

    References
    ----------
    ISO/TS 16281:2008, section 6.3.
    """
    row = tapered_geometry(bearing)
    projected = bearing.roller_diameter * math.cos(row.outer_angle)
    gamma = projected / (2.0 * bearing.pitch_radius)
    rating = ring_ratings(
        tapered_ratings(bearing).dynamic,
        len(ROW_SIGNS),
        bearing.rollers_per_row,
        row.outer_angle,
        gamma,
    )
    damage = np.zeros((len(ROW_SIGNS), 2, len(shaft_angle)))
    largest = np.zeros((len(ROW_SIGNS), 2))
    for sample in range(len(shaft_angle)):
        of_raceways = np.stack(strip_loads(ring, balance, shaft_angle, sample))
        strips = of_raceways.shape[-1]
        inner, outer = of_raceways.reshape(2, len(ROW_SIGNS), -1, strips)
        damage[:, 0, sample] = strip_damage(inner, rating.inner, stationary=False)
        damage[:, 1, sample] = strip_damage(outer, rating.outer, stationary=True)
        by_raceway = np.stack([inner, outer], axis=1)
        largest = np.maximum(largest, by_raceway.max(axis=(2, 3)))
    modulus = effective_modulus(*(bearing.youngs_modulus, bearing.poisson_ratio) * 2)
    curvature = np.array(raceway_curvatures(row))
    strip = bearing.roller_length / ring.profile.size
    pressure = line_pressure(largest / strip, curvature, modulus)
    return StripRating(damage, pressure)
