"""Shear stress of a Newtonian film that its own shear heats (Crook): one point of the contact."""

from __future__ import annotations

import math

from macroslip.compiled import jit


@jit
def heating_number(viscosity, temperature_viscosity, thermal_conductivity, slip):
    """Crook's heating number B = β η_s Δu²/(8k) [-].

    Parameters
    ----------
    viscosity : float
        Viscosity η_s at the wall temperature and local pressure [Pa s].
    temperature_viscosity : float
        Exponential temperature coefficient of viscosity β [1/K].
    thermal_conductivity : float
        Conductivity of the lubricant k [W/(m K)].
    slip : float
        Slip Δu [m/s], any sign.

    Notes
    -----
    The mid-film temperature rise is ln(1 + B)/β.

    References
    ----------
    Crook, Phil. Trans. R. Soc. A 254 (1961) 237, doi:10.1098/rsta.1961.0014.

    Examples
    --------
    >>> heating_number(0.54, 0.056, 0.125, 10.0)
    3.024
    """
    return temperature_viscosity * viscosity * slip * slip / (8.0 * thermal_conductivity)


@jit
def thermal_reduction(heating):
    """Factor asinh(√B)/√(B(1 + B)) by which shear heating lowers the effective viscosity [-].

    Parameters
    ----------
    heating : float
        Heating number B ≥ 0.

    Notes
    -----
    Exact solution of k T'' = −τ²/η(T) between cool walls with η = η_s exp(−β(T − T_wall)); valid for any B ≥ 0 as
    long as conduction across the film is the only way for heat to leave and walls stay at inlet temperature.

    References
    ----------
    Crook (1961), as cited in `heating_number`.

    Examples
    --------
    >>> round(thermal_reduction(1.0), 9)
    0.62322524
    >>> thermal_reduction(0.0)
    1.0
    """
    if heating < 1e-8:
        return 1.0 - heating * 2.0 / 3.0
    return math.asinh(math.sqrt(heating)) / math.sqrt(heating * (1.0 + heating))


@jit
def shear_stress(viscosity, temperature_viscosity, thermal_conductivity, film_thickness, slip):
    """Shear stress on the slower wall of a self-heated film, τ = η_eff Δu/h (27) [Pa].

    Parameters
    ----------
    viscosity : float
        Viscosity at wall temperature and local pressure [Pa s].
    temperature_viscosity : float
        β [1/K].
    thermal_conductivity : float
        k [W/(m K)].
    film_thickness : float
        h [m], > 0.
    slip : float
        Δu [m/s]; the stress has its sign.

    Notes
    -----
    At fixed film the stress peaks at B = 2.2767 and falls beyond.

    Examples
    --------
    >>> round(shear_stress(0.54, 0.056, 0.125, 1e-6, 0.1), 3)
    53989.116
    """
    heating = heating_number(viscosity, temperature_viscosity, thermal_conductivity, slip)
    return viscosity * thermal_reduction(heating) * slip / film_thickness


@jit
def shear_stress_slope(viscosity, temperature_viscosity, thermal_conductivity, film_thickness, slip):
    """Derivative dτ/dΔu = (η_s/h)[√(1+B) − √B asinh √B]/(1+B)^1.5 of `shear_stress` [Pa s/m].

    Parameters are those of `shear_stress`. Negative beyond the peak at B = 2.2767.

    Examples
    --------
    >>> round(shear_stress_slope(0.54, 0.056, 0.125, 1e-6, 0.0), 1)
    540000.0
    """
    heating = heating_number(viscosity, temperature_viscosity, thermal_conductivity, slip)
    root = math.sqrt(heating)
    bracket = math.sqrt(1.0 + heating) - root * math.asinh(root)
    return viscosity / film_thickness * bracket / (1.0 + heating) ** 1.5
