"""Eyring stress of a lubricant from its limiting shear stress."""

from __future__ import annotations


def eyring_stress(limiting_shear: float, mean_pressure_viscosity: float) -> float:
    """Eyring stress over temperature and pressure, tau_E = 2 gamma/alpha(T, p).

    Shear stress far above tau_E is tau_E ln(2 eta s/tau_E), in which ln eta contains alpha p. As gamma hardly depends on
    temperature while alpha falls, tau_E rises with temperature: for a PAO at 1 GPa 6.9, 7.8 and 8.7 MPa at 40, 60 and
    80 degC. Under Roelands' law with constant Z the ratio of two temperatures does not depend on the pressure.

    Parameters
    ----------
    limiting_shear : float
        Limiting shear stress over pressure gamma [-]; 0.03 to 0.06.
    mean_pressure_viscosity : float
        ln(eta/eta0)/p at the temperature and pressure [1/Pa], positive; see
        `macroslip.lubricant.pressure_viscosity.mean_pressure_viscosity`.

    Returns
    -------
    float
        tau_E [Pa].

    References
    ----------
    A. Arana, J. Larranaga, I. Ulacia, "Partial EHL friction coefficient model to predict power losses in cylindrical
    gears", Proc. IMechE Part J 233 (2019) 303-316.

    Examples
    --------
    >>> round(eyring_stress(0.035, 1.0145e-8) / 1e6, 2)
    6.9
    """
    return 2.0 * limiting_shear / mean_pressure_viscosity
