"""Roelands' index Z, the constant of an oil that joins viscosity and pressure-viscosity coefficient."""

from __future__ import annotations

import math

from macroslip.errors import InputError

#: Pressure p_r in Roelands' law [Pa].
ROELANDS_PRESSURE = 1.96e8
#: Viscosity [Pa s] that every oil has where Roelands' lines meet; the law holds above it.
ROELANDS_LOWEST_VISCOSITY = math.exp(-9.67)


def roelands_index(viscosity: float, pressure_viscosity: float) -> float:
    """Roelands' index that gives the law the initial slope alpha_p, Z = alpha_p p_r / (ln eta0 + 9.67).

    Parameters
    ----------
    viscosity : float
        Viscosity eta0 at ambient pressure [Pa s], above exp(-9.67) = 6.3e-5 Pa s.
    pressure_viscosity : float
        Slope alpha_p = d ln eta/dp at ambient pressure [1/Pa], positive.

    Returns
    -------
    float
        Z [-]; 0.5 to 0.7 for most oils.

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
    >>> round(roelands_index(0.54, 2.1e-8), 4)
    0.4546
    """
    constant = math.log(viscosity) + 9.67 if viscosity > 0.0 else -math.inf
    if not constant > 0.0:
        raise InputError(
            f"Roelands' law has no viscosity of {viscosity:g} Pa s at ambient pressure",
            where="viscosity",
            allowed=f"above {ROELANDS_LOWEST_VISCOSITY:.2g} Pa s, where ln(viscosity) + 9.67 is positive",
            remedy="Check the unit; lubricating oils have 0.001 to 10 Pa s. Barus' law has no such limit",
        )
    return pressure_viscosity * ROELANDS_PRESSURE / constant
