"""Density of a lubricant over temperature."""

from __future__ import annotations

THERMAL_EXPANSION = 0.65
"""Fall of density with temperature [kg/(m3 K)]: 0.60 to 0.68 for mineral oils and PAO in petroleum measurement tables."""


def density_at(density: float, temperature: float, other_temperature: float) -> float:
    """Density at another temperature, rho(T) = rho(T0) - 0.65 kg/(m3 K) (T - T0).

    Valid for mineral oils, PAO and esters from -20 to 150 degC, to about half a per cent.

    Parameters
    ----------
    density : float
        rho(T0) [kg/m3].
    temperature : float
        T0 [K].
    other_temperature : float
        T [K].

    Returns
    -------
    float
        rho(T) [kg/m3].

    References
    ----------
    The slope is an engineering estimate; ASTM D1250 tabulates it for lubricating oils by their density.

    Examples
    --------
    >>> density_at(860.0, 288.15, 313.15)
    843.75
    """
    return density - THERMAL_EXPANSION * (other_temperature - temperature)
