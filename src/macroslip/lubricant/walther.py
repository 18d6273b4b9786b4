"""Kinematic viscosity over temperature by Walther's line, as ASTM D341 draws it."""

from __future__ import annotations

import math
from typing import NamedTuple

from macroslip.errors import InputError

_SHIFT = 0.7
_MM2 = 1e-6


class WaltherLine(NamedTuple):
    """Straight line of log10 log10(nu + 0.7) over log10 T, with nu in mm2/s and T in K.

    Parameters
    ----------
    intercept : float
        A [-], its value at T = 1 K.
    slope : float
        B [-], by which it falls with log10 T, positive; 2.5 to 4 for most oils.
    """

    intercept: float
    slope: float


def walther_viscosity(line: WaltherLine, temperature: float) -> float:
    """Kinematic viscosity at a temperature, log10 log10(nu + 0.7) = A - B log10 T.

    Valid for liquid hydrocarbons above 2 mm2/s between cloud point and first boiling; interpolation between the two
    given viscosities is good to a few per cent, extrapolation by more than 30 K less so.

    Parameters
    ----------
    line : WaltherLine
        A and B.
    temperature : float
        T [K], positive.

    Returns
    -------
    float
        nu [m2/s].

    References
    ----------
    C. Walther, "Ueber die Auswertung von Viskositaetsangaben", Erdoel und Teer 7 (1931) 382-384. ASTM D341, Standard
    Practice for Viscosity-Temperature Equations and Charts for Liquid Petroleum or Hydrocarbon Products.

    Examples
    --------
    >>> line = walther_line_through(313.15, 320e-6, 373.15, 24e-6)
    >>> round(walther_viscosity(line, 323.15) * 1e6, 1)
    179.4
    """
    return (10.0**10.0 ** (line.intercept - line.slope * math.log10(temperature)) - _SHIFT) * _MM2


def walther_coefficient(line: WaltherLine, temperature: float) -> float:
    """Relative fall of the kinematic viscosity, -d ln nu/dT = B (nu + 0.7) ln(nu + 0.7)/(nu T), with nu in mm2/s.

    Parameters
    ----------
    line : WaltherLine
        A and B.
    temperature : float
        T [K], positive.

    Returns
    -------
    float
        [1/K]; 0.02 to 0.08 for most oils.

    References
    ----------
    As `walther_viscosity`, differentiated.

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
    first_temperature: float, first_viscosity: float, second_temperature: float, second_viscosity: float
) -> WaltherLine:
    """Line through two kinematic viscosities.

    Parameters
    ----------
    first_temperature, second_temperature : float
        T [K], positive, not equal.
    first_viscosity, second_viscosity : float
        nu [m2/s], above 0.3 mm2/s, the lower one at the higher temperature.

    Returns
    -------
    WaltherLine
        A and B.

    Raises
    ------
    InputError
        If the viscosity does not fall with temperature, or is too low for the law.

    References
    ----------
    As `walther_viscosity`.

    Examples
    --------
    >>> line = walther_line_through(313.15, 460e-6, 373.15, 46e-6)
    >>> round(line.intercept, 4), round(line.slope, 4)
    (7.077, 2.6651)
    """
    ordinates = _ordinate(first_viscosity), _ordinate(second_viscosity)
    slope = (ordinates[0] - ordinates[1]) / math.log10(second_temperature / first_temperature)
    if not slope > 0.0:
        raise InputError(
            f"the viscosity is {first_viscosity / _MM2:g} mm2/s at {first_temperature:g} K and "
            f"{second_viscosity / _MM2:g} mm2/s at {second_temperature:g} K",
            allowed="a viscosity that falls with temperature",
            remedy="Check which of the two belongs to which temperature.",
        )
    return WaltherLine(ordinates[0] + slope * math.log10(first_temperature), slope)


def walther_line_with_slope(temperature: float, viscosity: float, coefficient: float) -> WaltherLine:
    """Line through one kinematic viscosity and its relative fall with temperature; inverse of `walther_coefficient`.

    Parameters
    ----------
    temperature : float
        T [K], positive.
    viscosity : float
        nu [m2/s], above 0.3 mm2/s.
    coefficient : float
        -d ln nu/dT [1/K], positive.

    Returns
    -------
    WaltherLine
        A and B.

    Raises
    ------
    InputError
        If the coefficient is not positive, or the viscosity too low for the law.

    References
    ----------
    As `walther_viscosity`.

    Examples
    --------
    >>> line = walther_line_with_slope(308.15, 600e-6, 0.0553)
    >>> [round(walther_viscosity(line, 273.15 + celsius) * 1e6, 1) for celsius in (40, 100)]
    [458.7, 46.1]
    """
    if not coefficient > 0.0:
        raise InputError(
            f"the kinematic viscosity falls by {coefficient:g} of itself per kelvin",
            allowed="a positive number",
            remedy="Check the temperature-viscosity coefficient; oils have 0.02 to 0.08 1/K.",
        )
    ordinate = _ordinate(viscosity)
    number = viscosity / _MM2
    slope = coefficient * number * temperature / ((number + _SHIFT) * math.log(number + _SHIFT))
    return WaltherLine(ordinate + slope * math.log10(temperature), slope)


def _ordinate(viscosity: float) -> float:
    """log10 log10(nu + 0.7)."""
    shifted = viscosity / _MM2 + _SHIFT
    if not shifted > 1.0:
        raise InputError(
            f"Walther's line has no viscosity of {viscosity / _MM2:g} mm2/s",
            allowed="above 0.3 mm2/s, and reliable above 2 mm2/s",
            remedy="Check the unit; lubricating oils have 2 to 5000 mm2/s.",
        )
    return math.log10(math.log10(shifted))
