"""Temperature at which the friction of a bearing heats it as much as its surroundings cool it."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.optimize import root_scalar

from macroslip.errors import InputError

HOTTEST = 393.15
"""Highest temperature [K] at which a balance is looked for: 120 degC, beyond which greases and cages do not last."""


def balance_temperature(
    power: Callable[[float], float], conductance: float, ambient: float, hottest: float = HOTTEST
) -> float:
    """Temperature T of the heat balance power(T) = conductance (T - ambient).

    Steady state: the whole friction of the bearing, rolling, sliding, drag and cage, leaves it by conduction and
    convection in proportion to its excess temperature. A large bearing takes hours to get there, so the mean power over a
    wind history counts, not that of a gust. Where friction falls with temperature, as it does in full films, there is
    one solution; where it rises again in mixed lubrication, there may be several, and this is one of them.

    Parameters
    ----------
    power : Callable[[float], float]
        Friction power of the whole bearing [W] over the temperature of its lubricant [K]; continuous, not negative. See
        `tabulated_power`.
    conductance : float
        Heat flow to the surroundings per kelvin [W/K], positive; 40 to 80 is an estimate for the main bearing of a 2 MW
        turbine.
    ambient : float
        Temperature of the surroundings [K].
    hottest : float
        Highest temperature that is accepted [K].

    Returns
    -------
    float
        T [K], from `ambient` to `hottest`, to 1e-9 K.

    Raises
    ------
    InputError
        If conductance or ambient are no such numbers, the power is not a finite, non-negative number, or the bearing is
        still heated at the highest temperature.

    References
    ----------
    First law of thermodynamics; root by Brent's method, SciPy `root_scalar`.

    Examples
    --------
    >>> round(balance_temperature(lambda temperature: 600.0, conductance=60.0, ambient=288.15), 6)
    298.15
    """
    if not (math.isfinite(conductance) and conductance > 0.0):
        raise InputError(
            f"the conductance is {conductance:g} W/K",
            allowed="a positive number",
            remedy="40 to 80 W/K is an estimate for the main bearing of a 2 MW turbine.",
        )
    if not (math.isfinite(ambient) and 0.0 < ambient < hottest):
        raise InputError(
            f"the ambient temperature is {ambient:g} K",
            allowed=f"above 0 K and below {hottest:g} K",
            remedy="Check value and unit.",
        )

    def surplus(temperature: float) -> float:
        heat = power(temperature)
        if not (math.isfinite(heat) and heat >= 0.0):
            raise InputError(
                f"the friction power at {temperature:g} K is {heat:g} W",
                allowed="a finite number, not negative",
                remedy="Check the lubricant at that temperature.",
            )
        return heat - conductance * (temperature - ambient)

    if surplus(ambient) == 0.0:
        return ambient
    left = surplus(hottest)
    if left > 0.0:
        raise InputError(
            f"there is no heat balance up to {hottest:g} K: the friction power exceeds what is carried off by {left:.4g} W",
            allowed="a friction power that the surroundings can carry off",
            remedy="Check the conductance, the ambient temperature and the loads.",
        )
    return root_scalar(surplus, bracket=(ambient, hottest), method="brentq", xtol=1e-9).root


def tabulated_power(temperatures: Sequence[float], powers: Sequence[float]) -> Callable[[float], float]:
    """Friction power over temperature from a table, monotone between its points and constant beyond its ends.

    Parameters
    ----------
    temperatures : Sequence[float]
        Rising temperatures [K], two at least, shape (n,).
    powers : Sequence[float]
        Friction power at these temperatures [W], not negative, shape (n,).

    Returns
    -------
    Callable[[float], float]
        Power [W] at a temperature [K], for `balance_temperature`.

    Raises
    ------
    InputError
        If the two do not belong together, the temperatures do not rise, or a power is negative or not finite.

    References
    ----------
    F. N. Fritsch, J. Butland, "A method for constructing local monotone piecewise cubic interpolants", SIAM Journal on
    Scientific and Statistical Computing 5 (1984) 300-304, as implemented in SciPy.

    Examples
    --------
    >>> power = tabulated_power([290.0, 310.0, 330.0], [900.0, 600.0, 450.0])
    >>> round(power(310.0), 6), round(power(350.0), 6)
    (600.0, 450.0)
    """
    at, values = np.asarray(temperatures, dtype=float), np.asarray(powers, dtype=float)
    if at.ndim != 1 or at.shape != values.shape or at.size < 2:
        raise InputError(
            f"there are {at.size} temperatures and {values.size} powers",
            allowed="as many of the one as of the other, two at least",
        )
    if not (np.isfinite(at).all() and (np.diff(at) > 0.0).all()):
        raise InputError("the temperatures of the table do not rise", allowed="rising, finite temperatures")
    if not (np.isfinite(values).all() and (values >= 0.0).all()):
        raise InputError("the table has a power that is negative or not finite", allowed="powers of 0 W and above")
    curve = PchipInterpolator(at, values)
    return lambda temperature: float(curve(min(max(temperature, at[0]), at[-1])))
