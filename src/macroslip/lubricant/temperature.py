"""Properties of an oil over temperature and pressure.

These are viscosity, density, pressure-viscosity coefficient and Eyring stress.

Kinematic viscosity follows Walther's line, as ASTM D341 draws it; the pressure-viscosity
coefficient follows Roelands' law with a constant index Z:

* C. Walther, "Ueber die Auswertung von Viskositaetsangaben", Erdoel und Teer 7 (1931) 382-384. ASTM
  D341, Standard
  Practice for Viscosity-Temperature Equations and Charts for Liquid Petroleum or Hydrocarbon
  Products.
* C. J. A. Roelands, Correlational Aspects of the Viscosity-Temperature-Pressure Relationship of
  Lubricating Oils, thesis,
  Delft (1966), with p_r = 1.96e8 Pa.

Both laws refuse, by `InputError`, a viscosity that is too low for them.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from macroslip.errors import InputError

_SHIFT = 0.7
_MM2 = 1e-6
#: Pressure p_r in Roelands' law [Pa].
ROELANDS_PRESSURE = 1.96e8
#: Viscosity [Pa s] that every oil has where Roelands' lines meet; the law holds above it.
ROELANDS_LOWEST_VISCOSITY = math.exp(-9.67)
#: Fall of density with temperature [kg/(m3 K)]: 0.60 to 0.68 for mineral oils and PAO in petroleum
#: measurement tables.
THERMAL_EXPANSION = 0.65


class WaltherLine(NamedTuple):
    """Straight line of log10 log10(nu + 0.7) over log10 T, with nu in mm2/s and T in K."""

    intercept: float  #: A [-], its value at T = 1 K
    slope: float  #: B [-], by which it falls with log10 T, positive; 2.5 to 4 for most oils


def walther_viscosity(line: WaltherLine, temperature: float) -> float:
    """Kinematic viscosity nu [m2/s] at a temperature T [K], log10 log10(nu + 0.7) = A - B log10 T.

    In this equation nu is in mm2/s.

    Valid for liquid hydrocarbons above 2 mm2/s between cloud point and first boiling; interpolation
    between the two given viscosities is good to a few per cent, extrapolation by more than 30 K
    less so.

    Examples
    --------
    >>> line = walther_line_through(313.15, 320e-6, 373.15, 24e-6)
    >>> round(walther_viscosity(line, 323.15) * 1e6, 1)
    179.4
    """
    ordinate = line.intercept - line.slope * math.log10(temperature)
    shifted = 10.0**10.0**ordinate
    return (shifted - _SHIFT) * _MM2


def walther_coefficient(line: WaltherLine, temperature: float) -> float:
    """Relative fall of the kinematic viscosity [1/K] at T [K].

    It is -d ln nu/dT = B (nu + 0.7) ln(nu + 0.7)/(nu T), nu in mm2/s.

    `walther_viscosity` differentiated; 0.02 to 0.08 for most oils.

    Examples
    --------
    >>> line = walther_line_through(313.15, 320e-6, 373.15, 24e-6)
    >>> round(walther_coefficient(line, 313.15), 4)
    0.0619
    """
    viscosity = walther_viscosity(line, temperature) / _MM2
    shifted = viscosity + _SHIFT
    return line.slope * shifted * math.log(shifted) / (viscosity * temperature)


def walther_line_through(
    first_temperature: float,
    first_viscosity: float,
    second_temperature: float,
    second_viscosity: float,
) -> WaltherLine:
    """Walther's line through two kinematic viscosities at two temperatures.

    Parameters
    ----------
    first_temperature, second_temperature : float
        Temperatures [K], > 0, different from each other.
    first_viscosity, second_viscosity : float
        Kinematic viscosities at these [m2/s], above 0.3 mm2/s.

    Returns
    -------
    WaltherLine
        Intercept and slope [-].

    Raises
    ------
    InputError
        If the viscosity does not fall with temperature.

    Examples
    --------
    >>> line = walther_line_through(313.15, 460e-6, 373.15, 46e-6)
    >>> round(line.intercept, 4), round(line.slope, 4)
    (7.077, 2.6651)
    """
    first = _ordinate(first_viscosity)
    second = _ordinate(second_viscosity)
    ratio = second_temperature / first_temperature
    slope = (first - second) / math.log10(ratio)
    if not slope > 0.0:
        raise InputError(
            f"the viscosity is {first_viscosity / _MM2:g} mm2/s at {first_temperature:g} K and "
            f"{second_viscosity / _MM2:g} mm2/s at {second_temperature:g} K",
            allowed="a viscosity that falls with temperature",
            remedy="Check which of the two belongs to which temperature.",
        )
    intercept = first + slope * math.log10(first_temperature)
    return WaltherLine(intercept, slope)


def walther_line_with_slope(
    temperature: float, viscosity: float, coefficient: float
) -> WaltherLine:
    """Line through one kinematic viscosity [m2/s] at T [K] and its relative fall [1/K].

    It is the inverse of `walther_coefficient`.

    Raises InputError if the coefficient is not positive.

    Examples
    --------
    >>> line = walther_line_with_slope(308.15, 600e-6, 0.0553)
    >>> [round(walther_viscosity(line, 273.15 + celsius) * 1e6, 1) for celsius in (40, 100)]
    [458.7, 46.1]
    """
    if not coefficient > 0.0:
        fault = f"the kinematic viscosity falls by {coefficient:g} of itself per kelvin"
        remedy = "Check the temperature-viscosity coefficient; oils have 0.02 to 0.08 1/K."
        raise InputError(fault, allowed="a positive number", remedy=remedy)
    ordinate = _ordinate(viscosity)
    number = viscosity / _MM2
    shifted = number + _SHIFT
    slope = coefficient * number * temperature / (shifted * math.log(shifted))
    intercept = ordinate + slope * math.log10(temperature)
    return WaltherLine(intercept, slope)


def _ordinate(viscosity: float) -> float:
    """log10 log10(nu + 0.7)."""
    shifted = viscosity / _MM2 + _SHIFT
    if not shifted > 1.0:
        fault = f"Walther's line has no viscosity of {viscosity / _MM2:g} mm2/s"
        remedy = "Check the unit; lubricating oils have 2 to 5000 mm2/s."
        raise InputError(
            fault, allowed="above 0.3 mm2/s, and reliable above 2 mm2/s", remedy=remedy
        )
    return math.log10(math.log10(shifted))


def density_at(density: float, temperature: float, other_temperature: float) -> float:
    """Density [kg/m3] at another temperature [K], rho(T) = rho(T0) - 0.65 kg/(m3 K) (T - T0).

    Valid for mineral oils, PAO and esters from -20 to 150 degC, to about half a per cent. The slope
    is an engineering estimate; ASTM D1250 tabulates it for lubricating oils by their density.

    Examples
    --------
    >>> density_at(860.0, 288.15, 313.15)
    843.75
    """
    return density - THERMAL_EXPANSION * (other_temperature - temperature)


def dowson_higginson(pressure):
    """Density under pressure over density at ambient pressure [-].

    It is 1 + 0.6 p/(1 + 1.7 p) with p in GPa, given in Pa.

    Fitted to mineral oils up to 0.4 GPa and widely used beyond; it tends to 1.353. Dowson and
    Higginson, Elasto-hydrodynamic Lubrication, Pergamon (1966).

    Examples
    --------
    >>> round(dowson_higginson(1e9), 4)
    1.2222
    """
    return 1.0 + 0.6e-9 * pressure / (1.0 + 1.7e-9 * pressure)


def roelands_index(viscosity: float, pressure_viscosity: float) -> float:
    """Roelands' index [-] that gives the law the initial slope alpha_p.

    Z = alpha_p p_r / (ln eta0 + 9.67).

    0.5 to 0.7 for most oils. eta0 [Pa s] is the viscosity at ambient pressure, above exp(-9.67) =
    6.3e-5 Pa s, and alpha_p [1/Pa] the positive slope d ln eta/dp there.

    Examples
    --------
    >>> round(roelands_index(0.54, 2.1e-8), 4)
    0.4546
    """
    constant = math.log(viscosity) + 9.67 if viscosity > 0.0 else -math.inf
    if not constant > 0.0:
        fault = f"Roelands' law has no viscosity of {viscosity:g} Pa s at ambient pressure"
        allowed = (
            f"above {ROELANDS_LOWEST_VISCOSITY:.2g} Pa s, where ln(viscosity) + 9.67 is positive"
        )
        remedy = (
            "Check the unit; lubricating oils have 0.001 to 10 Pa s. Barus' law has no such limit"
        )
        raise InputError(fault, where="viscosity", allowed=allowed, remedy=remedy)
    return pressure_viscosity * ROELANDS_PRESSURE / constant


def pressure_viscosity_at(index: float, viscosity: float) -> float:
    """Coefficient [1/Pa] at ambient pressure, alpha_p = Z (ln eta0 + 9.67)/p_r, eta0 in Pa s.

    Inverse of `roelands_index`.

    Z is a constant of the oil, so alpha_p falls with temperature as ln eta0 does.

    Examples
    --------
    >>> [round(pressure_viscosity_at(0.4546, one) * 1e9, 2) for one in (0.54, 0.233)]
    [21.0, 19.05]
    """
    return index / roelands_index(viscosity, 1.0)


def mean_pressure_viscosity(viscosity: float, pressure_viscosity: float, pressure: float) -> float:
    """Mean pressure-viscosity coefficient [1/Pa] up to a pressure p [Pa].

    By Roelands' law, alpha(p) = ln(eta/eta0)/p.

    eta = eta0 exp{(ln eta0 + 9.67) [(1 + p/p_r)^Z - 1]}, fitted to oils up to about 1 GPa. It is
    what eta = eta0 exp(alpha(p) p) needs to hold at that pressure, and below alpha_p for Z < 1.
    Arguments as `roelands_index`.

    Examples
    --------
    >>> round(mean_pressure_viscosity(0.54, 2.1e-8, 1e9) * 1e9, 2)
    11.55
    """
    index = roelands_index(viscosity, pressure_viscosity)
    constant = pressure_viscosity * ROELANDS_PRESSURE / index
    exponent = index * math.log1p(pressure / ROELANDS_PRESSURE)
    return constant * math.expm1(exponent) / pressure


def gold(kinematic_viscosity: float, factor: float, exponent: float) -> float:
    """Pressure-viscosity coefficient [1/Pa] by the power law of Gold and co-workers.

    It is alpha_p = s nu^t in 1/GPa, with nu in mm2/s.

    A mean over oils of one family, measured up to 0.2 GPa; single oils scatter by about 20 % around
    it. nu is at ambient pressure and the temperature of interest, positive, fitted for about 5 to
    1000 mm2/s; `factor` and `exponent` are s and t of the oil family; see
    `macroslip.lubricant.base_oil`.

    P. W. Gold, A. Schmidt, H. Dicke, J. Loos, C. Assmann, "Viscosity-pressure-temperature behaviour
    of mineral and synthetic oils", Journal of Synthetic Lubrication 18 (2001) 51-79.

    Examples
    --------
    >>> round(gold(460e-6, 7.382, 0.1335) * 1e9, 2)
    16.74
    """
    return factor * (kinematic_viscosity * 1e6) ** exponent * 1e-9


def eyring_stress(limiting_shear: float, mean_pressure_viscosity: float) -> float:
    """Eyring stress [Pa] over temperature and pressure, tau_E = 2 gamma/alpha(T, p).

    Shear stress far above tau_E is tau_E ln(2 eta s/tau_E), in which ln eta contains alpha p. As
    gamma hardly depends on temperature while alpha falls, tau_E rises with temperature: for a PAO
    at 1 GPa 6.9, 7.8 and 8.7 MPa at 40, 60 and 80 degC. Under Roelands' law with constant Z the
    ratio of two temperatures does not depend on the pressure. gamma is the limiting shear stress
    over pressure [-], 0.03 to 0.06, and alpha(T, p) = ln(eta/eta0)/p at the temperature and
    pressure [1/Pa], positive; see `mean_pressure_viscosity`.

    A. Arana, J. Larranaga, I. Ulacia, "Partial EHL friction coefficient model to predict power
    losses in cylindrical gears", Proc. IMechE Part J 233 (2019) 303-316.

    Examples
    --------
    >>> round(eyring_stress(0.035, 1.0145e-8) / 1e6, 2)
    6.9
    """
    return 2.0 * limiting_shear / mean_pressure_viscosity
