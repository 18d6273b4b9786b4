"""Pressure-viscosity coefficient over temperature and pressure, by Roelands' law with a constant index Z."""

from __future__ import annotations

import math

from macroslip.lubricant.roelands_index import ROELANDS_PRESSURE, roelands_index


def pressure_viscosity_at(index: float, viscosity: float) -> float:
    """Pressure-viscosity coefficient at ambient pressure, alpha_p = Z (ln eta0 + 9.67)/p_r; inverse of `roelands_index`.

    Z is a constant of the oil, so alpha_p falls with temperature as ln eta0 does.

    Parameters
    ----------
    index : float
        Z [-]; 0.4 to 0.7 for most oils.
    viscosity : float
        Viscosity eta0 at ambient pressure and at the temperature [Pa s], above exp(-9.67) = 6.3e-5 Pa s.

    Returns
    -------
    float
        alpha_p [1/Pa].

    Raises
    ------
    InputError
        If the viscosity is too low for the law.

    References
    ----------
    C. J. A. Roelands, Correlational Aspects of the Viscosity-Temperature-Pressure Relationship of Lubricating Oils,
    thesis, Delft (1966), with p_r = 1.96e8 Pa.

    Examples
    --------
    >>> round(pressure_viscosity_at(0.4546, 0.54) * 1e9, 2), round(pressure_viscosity_at(0.4546, 0.233) * 1e9, 2)
    (21.0, 19.05)
    """
    return index / roelands_index(viscosity, 1.0)


def mean_pressure_viscosity(viscosity: float, pressure_viscosity: float, pressure: float) -> float:
    """Mean pressure-viscosity coefficient up to a pressure, alpha(p) = ln(eta/eta0)/p, by Roelands' law.

    It is what eta = eta0 exp(alpha(p) p) needs to hold at that pressure.

    Parameters
    ----------
    viscosity : float
        Viscosity eta0 at ambient pressure [Pa s], above exp(-9.67) = 6.3e-5 Pa s.
    pressure_viscosity : float
        Initial slope alpha_p [1/Pa], positive.
    pressure : float
        Pressure p above ambient [Pa], positive.

    Returns
    -------
    float
        alpha(p) [1/Pa], below alpha_p for Z < 1.

    Raises
    ------
    InputError
        If the viscosity is too low for the law.

    References
    ----------
    As `pressure_viscosity_at`.

    Examples
    --------
    >>> round(mean_pressure_viscosity(0.54, 2.1e-8, 1e9) * 1e9, 2)
    11.55
    """
    index = roelands_index(viscosity, pressure_viscosity)
    constant = pressure_viscosity * ROELANDS_PRESSURE / index
    return constant * math.expm1(index * math.log1p(pressure / ROELANDS_PRESSURE)) / pressure
