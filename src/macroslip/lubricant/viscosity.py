"""Viscosity and density of a lubricant under pressure."""

from __future__ import annotations

import math

from macroslip.compiled import jit
from macroslip.lubricant.temperature import ROELANDS_PRESSURE


@jit
def barus(viscosity: float, pressure_viscosity: float, pressure: float) -> float:
    """Viscosity under pressure by Barus' exponential law, eta = eta0 exp(alpha_p p).

    Valid to a few 0.1 GPa. At the pressures of a loaded raceway contact (1 GPa and more) it overstates the viscosity by
    orders of magnitude; the base model keeps it because the paper does.

    Parameters
    ----------
    viscosity : float
        Viscosity eta0 at ambient pressure [Pa s], positive.
    pressure_viscosity : float
        Coefficient alpha_p [1/Pa], not negative.
    pressure : float
        Pressure p above ambient [Pa], not negative.

    Returns
    -------
    float
        Viscosity [Pa s]; infinite where it exceeds the largest float.

    References
    ----------
    C. Barus, "Isothermals, isopiestics and isometrics relative to viscosity", American Journal of Science 45 (1893).

    Examples
    --------
    >>> round(barus(0.54, 2.1e-8, 1e8), 6)
    4.409732
    """
    return viscosity * math.exp(pressure_viscosity * pressure)


@jit
def roelands(viscosity: float, pressure_viscosity: float, pressure: float) -> float:
    """Viscosity under pressure by Roelands' law, eta = eta0 exp{(ln eta0 + 9.67) [(1 + p/p_r)^Z - 1]}.

    Z is such that d ln eta/dp is alpha_p at p = 0, as Barus' law has it everywhere; for Z < 1 Roelands' viscosity is
    below Barus' at every pressure. Fitted to oils up to about 1 GPa; above, real viscosities rise faster again, of which
    only the logarithm enters the stress of a film that thins under shear.

    Parameters
    ----------
    viscosity : float
        Viscosity eta0 at ambient pressure [Pa s], above exp(-9.67) = 6.3e-5 Pa s; see `roelands_index`.
    pressure_viscosity : float
        Initial slope alpha_p [1/Pa], positive.
    pressure : float
        Pressure p above ambient [Pa], not negative.

    Returns
    -------
    float
        Viscosity [Pa s]; NaN where eta0 is too low for the law.

    References
    ----------
    C. J. A. Roelands, Correlational Aspects of the Viscosity-Temperature-Pressure Relationship of Lubricating Oils,
    thesis, Delft (1966), with p_r = 1.96e8 Pa.

    Examples
    --------
    >>> round(roelands(0.54, 2.1e-8, 1e8), 4)
    3.4904
    """
    constant = math.log(viscosity) + 9.67
    if not constant > 0.0:
        return math.nan
    index = pressure_viscosity * ROELANDS_PRESSURE / constant
    return viscosity * math.exp(constant * math.expm1(index * math.log1p(pressure / ROELANDS_PRESSURE)))


@jit
def dowson_higginson(pressure: float) -> float:
    """Density under pressure over density at ambient pressure, 1 + 0.6 p/(1 + 1.7 p) with p in GPa.

    Fitted to mineral oils up to 0.4 GPa and widely used beyond; it tends to 1.353.

    Parameters
    ----------
    pressure : float
        Pressure p above ambient [Pa], not negative.

    Returns
    -------
    float
        Density ratio [-], 1 to 1.353.

    References
    ----------
    Dowson and Higginson, Elasto-hydrodynamic Lubrication, Pergamon (1966).

    Examples
    --------
    >>> round(dowson_higginson(1e9), 4)
    1.2222
    """
    return 1.0 + 0.6e-9 * pressure / (1.0 + 1.7e-9 * pressure)
