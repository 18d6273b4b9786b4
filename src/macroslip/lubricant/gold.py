"""Pressure-viscosity coefficient from kinematic viscosity and oil family."""

from __future__ import annotations


def gold(kinematic_viscosity: float, factor: float, exponent: float) -> float:
    """Pressure-viscosity coefficient by the power law of Gold et al., alpha_p = s nu^t in 1/GPa, with nu in mm2/s.

    A mean over oils of one family, measured up to 0.2 GPa; single oils scatter by about 20 % around it.

    Parameters
    ----------
    kinematic_viscosity : float
        nu at ambient pressure and the temperature of interest [m2/s], positive; fitted for about 5 to 1000 mm2/s.
    factor, exponent : float
        s and t of the oil family; see `macroslip.lubricant.base_oil`.

    Returns
    -------
    float
        alpha_p [1/Pa].

    References
    ----------
    P. W. Gold, A. Schmidt, H. Dicke, J. Loos, C. Assmann, "Viscosity-pressure-temperature behaviour of mineral and
    synthetic oils", Journal of Synthetic Lubrication 18 (2001) 51-79.

    Examples
    --------
    >>> round(gold(460e-6, 7.382, 0.1335) * 1e9, 2)
    16.74
    """
    return factor * (kinematic_viscosity * 1e6) ** exponent * 1e-9
