"""Laws for the viscosity of a lubricant under pressure."""

from __future__ import annotations

import math

from macroslip.compiled import jit


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
