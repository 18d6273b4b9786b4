"""Dynamic equivalent load, basic and modified rating life of radial roller bearings by ISO 281:2007.

Lives are in revolutions. Radial roller bearings have the life exponent p = 10/3.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

LIFE_EXPONENT = 10.0 / 3.0
"""p in L = (C/P)^p of roller bearings."""
LARGEST_MODIFICATION = 50.0
"""a_ISO is not to be taken larger."""
VISCOSITY_RATIO_RANGE = (0.1, 4.0)
"""Viscosity ratios for which a_ISO is defined; above it the factor at the upper end holds."""


def dynamic_equivalent_load(
    radial_load: ArrayLike, axial_load: ArrayLike, e: float, y1: float, y2: float
) -> NDArray[np.float64]:
    """Dynamic equivalent radial load of a double-row bearing.

    P = Fr + Y1 |Fa| where |Fa| <= e Fr, else 0.67 Fr + Y2 |Fa|.

    Parameters
    ----------
    radial_load : array_like
        Fr [N], not negative.
    axial_load : array_like
        Fa [N], either sign.
    e, y1, y2 : float
        Factors of the catalogue [-]; 1.5 tan(alpha), 0.45 cot(alpha) and 0.67 cot(alpha) in the standard. As catalogues
        round them, P has a step of up to a few per cent at |Fa| = e Fr.

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
    radial, axial = np.asarray(radial_load, float), np.abs(axial_load)
    return np.where(axial <= e * radial, radial + y1 * axial, 0.67 * radial + y2 * axial)


def basic_life(load_rating: float, equivalent_load: ArrayLike) -> NDArray[np.float64]:
    """Basic rating life with 90 % reliability, L10 = 1e6 (C/P)^(10/3) revolutions; infinite without load.

    Valid to P = C/2; no range is stated below.

    Parameters
    ----------
    load_rating : float
        C [N].
    equivalent_load : array_like
        P [N].

    Returns
    -------
    ndarray
        L10 [revolutions].

    References
    ----------
    ISO 281:2007, section 8.

    Examples
    --------
    >>> f"{basic_life(8502e3, 415e3):.4g}"
    '2.353e+10'
    """
    with np.errstate(divide="ignore"):
        return 1e6 * (load_rating / np.asarray(equivalent_load, float)) ** LIFE_EXPONENT


def mean_equivalent_load(equivalent_load: ArrayLike, revolutions: ArrayLike) -> float:
    """Constant load with the life of a varying one, P_m = (sum P^p n / sum n)^(1/p), p = 10/3.

    Parameters
    ----------
    equivalent_load : array_like, shape (n,)
        P [N].
    revolutions : array_like, shape (n,)
        Revolutions made under each load, not negative; any unit.

    Returns
    -------
    float
        P_m [N]; NaN where nothing turns.

    Examples
    --------
    >>> round(mean_equivalent_load([100e3, 200e3], [1.0, 1.0]))
    167127
    """
    weight = np.asarray(revolutions, float)
    if weight.sum() == 0.0:
        return math.nan
    return float(np.average(np.asarray(equivalent_load, float) ** LIFE_EXPONENT, weights=weight) ** (1 / LIFE_EXPONENT))


def reference_viscosity(speed: float, pitch: float) -> float:
    """Kinematic viscosity that the standard requires, nu1 = 45000 n^-0.83 Dpw^-0.5 mm2/s (n in rpm, Dpw in mm).

    From 1000 rpm on it is 4500 n^-0.5 Dpw^-0.5.

    Parameters
    ----------
    speed : float
        Speed of the shaft [rad/s], not zero; its sign does not matter.
    pitch : float
        Pitch diameter Dpw [m].

    Returns
    -------
    float
        nu1 [m2/s].

    References
    ----------
    ISO 281:2007, section 9.3.3.2, equations (26) and (27).

    Examples
    --------
    >>> round(reference_viscosity(2 * math.pi * 20 / 60, 0.7454) * 1e6, 1)
    137.1
    """
    rpm = abs(speed) * 30.0 / math.pi
    by_speed = 45000.0 * rpm**-0.83 if rpm < 1000.0 else 4500.0 * rpm**-0.5
    return 1e-6 * by_speed * (1e3 * pitch) ** -0.5


def life_modification(viscosity_ratio: float, contamination: float, load_ratio: ArrayLike) -> NDArray[np.float64]:
    """Life modification factor a_ISO of radial roller bearings.

    a_ISO = 0.1 [1 - (1.5859 - A/kappa^B) (e_C C_u/P)^0.4]^-9.185, at most 50, with (A, B) = (1.3993, 0.054381) for
    kappa below 0.4, (1.2348, 0.19087) to 1, and (1.2348, 0.071739) to 4.

    Parameters
    ----------
    viscosity_ratio : float
        kappa = nu/nu1 [-], at least 0.1; above 4 the value at 4 holds.
    contamination : float
        e_C [-], 0 (very severe) to 1 (extreme cleanliness).
    load_ratio : array_like
        C_u/P [-], not negative.

    Returns
    -------
    ndarray
        a_ISO [-]; NaN for kappa below 0.1 or none, where the standard defines no factor.

    References
    ----------
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
    if kappa < 0.4:
        film = 1.5859 - 1.3993 / kappa**0.054381
    elif kappa < 1.0:
        film = 1.5859 - 1.2348 / kappa**0.19087
    else:
        film = 1.5859 - 1.2348 / kappa**0.071739
    # At kappa 0.1 the film's part is zero but for the rounding of its coefficients. Where the bracket is not positive the
    # endurance limit is reached.
    bracket = 1.0 - max(film, 0.0) * (contamination * ratio) ** 0.4
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        factor = np.where(bracket > 0.0, 0.1 * np.abs(bracket) ** -9.185, np.inf)
    return np.minimum(factor, LARGEST_MODIFICATION)
