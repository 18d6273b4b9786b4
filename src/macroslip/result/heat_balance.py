"""The temperature at which friction heats a bearing as much as its surroundings cool it, and those of its rings."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator
from scipy.linalg import expm
from scipy.optimize import root_scalar

from macroslip.bearing import Bearing
from macroslip.case.case import Case
from macroslip.case.parts import Heat
from macroslip.errors import InputError

#: Of bearing steel: thermal expansion [1/K], from 20 to 100 degC, and specific heat [J/(kg K)].
EXPANSION, SPECIFIC_HEAT = 11.9e-6, 460.0

HOTTEST = 393.15
"""Highest temperature [K] at which a balance is looked for: 120 degC, beyond which greases and cages do not last."""
#: Change of temperature [K] between two guesses at which the balance counts as found, first rise over the surroundings
#: [K], and most guesses.
_CLOSE, _FIRST_RISE, _MOST = 0.2, 30.0, 10
_BALANCE = "temperature: balance"


def balance_temperature(
    power: Callable[[float], float], conductance: float, ambient: float, hottest: float = HOTTEST
) -> float:
    """Temperature T [K] of the heat balance power(T) = conductance (T - ambient), to 1e-9 K, by Brent's method.

    Steady state: the whole friction of the bearing leaves it in proportion to its excess temperature. A large bearing
    takes hours to get there, so the mean power over a wind history counts, not that of a gust. Where friction falls
    with temperature, as in full films, there is one solution; where it rises again in mixed lubrication, this may be
    one of several. Raises InputError if conductance or ambient are no such numbers, the power is not a finite,
    non-negative number, or the bearing is still heated at the highest temperature. T lies from `ambient` to `hottest`.

    Parameters
    ----------
    power : Callable[[float], float]
        Friction power of the whole bearing [W] over the temperature of its lubricant [K]; continuous, not negative. See
        `tabulated_power`.
    conductance : float
        Heat flow to the surroundings per kelvin [W/K], positive; 40 to 80 is an estimate for the main bearing of a 2 MW
        turbine.
    ambient, hottest : float
        Temperature of the surroundings, and the highest that is accepted [K].

    Examples
    --------
    >>> round(balance_temperature(lambda temperature: 600.0, conductance=60.0, ambient=288.15), 6)
    298.15
    """
    if not (math.isfinite(conductance) and conductance > 0.0):
        remedy = "40 to 80 W/K is an estimate for the main bearing of a 2 MW turbine."
        raise InputError(
            f"the conductance is {conductance:g} W/K", allowed="a positive number", remedy=remedy
        )
    if not (math.isfinite(ambient) and 0.0 < ambient < hottest):
        what = f"the ambient temperature is {ambient:g} K"
        raise InputError(
            what, allowed=f"above 0 K and below {hottest:g} K", remedy="Check value and unit."
        )

    def surplus(temperature: float) -> float:
        heat = power(temperature)
        if not (math.isfinite(heat) and heat >= 0.0):
            what = f"the friction power at {temperature:g} K is {heat:g} W"
            remedy = "Check the lubricant at that temperature."
            raise InputError(what, allowed="a finite number, not negative", remedy=remedy)
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


def tabulated_power(
    temperatures: Sequence[float], powers: Sequence[float]
) -> Callable[[float], float]:
    """Friction power [W] over temperature [K] from a table, monotone between its points, constant beyond its ends.

    By SciPy's PCHIP. InputError unless there are two or more rising temperatures and as many powers, none negative.

    Examples
    --------
    >>> power = tabulated_power([290.0, 310.0, 330.0], [900.0, 600.0, 450.0])
    >>> round(power(310.0), 6), round(power(350.0), 6)
    (600.0, 450.0)
    """
    at, values = np.asarray(temperatures, dtype=float), np.asarray(powers, dtype=float)
    if at.ndim != 1 or at.shape != values.shape or at.size < 2:
        what = f"there are {at.size} temperatures and {values.size} powers"
        raise InputError(what, allowed="as many of the one as of the other, two at least")
    if not (np.isfinite(at).all() and (np.diff(at) > 0.0).all()):
        raise InputError(
            "the temperatures of the table do not rise", allowed="rising, finite temperatures"
        )
    if not (np.isfinite(values).all() and (values >= 0.0).all()):
        raise InputError(
            "the table has a power that is negative or not finite",
            allowed="powers of 0 W and above",
        )
    curve = PchipInterpolator(at, values)
    return lambda temperature: float(curve(min(max(temperature, at[0]), at[-1])))


def bearing_friction_power(result: xr.Dataset) -> float:
    """Mean friction power of the whole bearing over the window [W]: sliding, rolling, cage and drag.

        P = Z/n Σ (E + E_rolling)/t + P_drag

    of n simulated rollers a row that represent all Z. Raises InputError if a roller failed.
    """
    if bool((result.status != 0).any()):
        what = "a roller failed, so that the friction of the bearing is not known"
        remedy = "Give a temperature, or remove what made the roller fail."
        raise InputError(what, where=_BALANCE, remedy=remedy)
    span = result.attrs["window_end"] - result.attrs["window_start"]
    energy = float(result.energy.sum() + result.rolling_energy.sum())
    share = result.attrs["rollers_per_row"] / result.sizes["roller"]
    return share * energy / span + result.attrs["drag_power"]


def next_temperature(known: Mapping[float, float], heat: Heat) -> tuple[float, bool]:
    """Temperature [K] to compute next, by the powers [W] known by temperature [K]; and whether the balance is settled.

    First comes the temperature of the surroundings, then 30 K above, then the balance of what is known; it is settled
    within 0.2 K of one that was computed. Raises InputError if there is no balance, or ten temperatures have not
    settled it.

    Examples
    --------
    >>> next_temperature({290.0: 1200.0, 320.0: 600.0}, Heat(conductance=40.0, ambient=290.0))
    (310.0, False)
    """
    for first in (heat.ambient, heat.ambient + _FIRST_RISE):
        if first not in known:
            return first, False
    places = sorted(known)
    found = balance_temperature(
        tabulated_power(places, [known[place] for place in places]), heat.to_oil, heat.ambient
    )
    if min(abs(found - place) for place in places) <= _CLOSE:
        return found, True
    if len(known) >= _MOST:
        what = f"the balance of temperature was not found in {_MOST} simulations"
        raise InputError(what, where=_BALANCE, remedy="Give a temperature.")
    return found, False


def case_at_balance(case: Case, simulate: Callable[[Case], xr.Dataset]) -> Case:
    """The case at the temperature at which friction power = heat.to_oil (T − ambient), by `next_temperature`.

    Three to five simulations, without traces and details of the contacts. Load histories of minutes do not change the
    temperature of a bearing, so the balance is that of their mean power if it lasted.
    """
    heat = case.heat
    assert heat is not None, "the case has no balance"
    known: dict[float, float] = {}
    while True:
        temperature, settled = next_temperature(known, heat)
        balanced = at_balance(case, temperature)
        if settled:
            return balanced
        known[temperature] = bearing_friction_power(
            simulate(replace(balanced, traces=None, contact_details=False))
        )


def at_balance(case: Case, temperature: float) -> Case:
    """The case at a temperature [K] of its balance, with the clearance that rings of their own temperatures leave there.

    An inner ring that takes more than the clearance leaves none: a preload is not modelled, and a result says so.
    """
    case = replace(case, temperature=temperature)
    if case.heat is None or case.heat.ring_conductance is None:
        return case
    loss = clearance_loss(case.bearing, *rings_at_balance(case.heat, temperature))
    left = max(case.bearing.diametral_clearance - loss, 0.0)
    return replace(case, bearing=case.bearing.replace(diametral_clearance=left))


def rings_at_balance(heat: Heat, temperature: float) -> tuple[float, float]:
    """Temperatures of inner and outer ring [K] where the balance has the oil at a temperature [K]."""
    power = heat.to_oil * (temperature - heat.ambient)
    inner, outer = ring_temperatures(heat, power, [math.inf], (heat.ambient, heat.ambient))[0]
    return float(inner), float(outer)


def ring_temperatures(
    heat: Heat, power: float, time: Sequence[float], start: tuple[float, float]
) -> NDArray[np.float64]:
    """Temperatures T_i and T_o of inner and outer ring over time under a constant friction power [K], shape (n, 2); exact.

        m_i c dT_i/dt = P/2 − G_r (T_i − T_o),   m_o c dT_o/dt = P/2 + G_r (T_i − T_o) − G (T_o − T_ambient)

    `heat` has the masses and the ring conductance, InputError without; `power` is P [W], 0 for a cooling curve; `time`
    n times since the start [s], infinite for the steady state; `start` both temperatures then, inner and outer [K].

    Examples
    --------
    >>> heat = Heat(conductance=60.0, ambient=293.15, inner_mass=4000.0, outer_mass=3000.0, ring_conductance=100.0)
    >>> ring_temperatures(heat, 1000.0, [0.0, float("inf")], (293.15, 293.15)).round(2).tolist()
    [[293.15, 293.15], [314.82, 309.82]]
    """
    if heat.ring_conductance is None or heat.inner_mass is None or heat.outer_mass is None:
        allowed = "inner_mass, outer_mass and ring_conductance"
        raise InputError("the masses of the rings are not given", where="heat", allowed=allowed)
    between, out = heat.ring_conductance, heat.conductance
    capacity = SPECIFIC_HEAT * np.array([[heat.inner_mass], [heat.outer_mass]])
    rate = np.array([[-between, between], [between, -between - out]]) / capacity
    outer = heat.ambient + power / out
    steady = np.array([outer + 0.5 * power / between, outer])
    return np.array(
        [steady + (expm(rate * t) @ (start - steady) if math.isfinite(t) else 0.0) for t in time]
    )


def clearance_loss(bearing: Bearing, inner: float, outer: float) -> float:
    """Diametral clearance [m] that an inner ring takes which is warmer than the outer one, both in K or both in degC.

    Thermal expansion of steel, 11.9e-6 per kelvin (tag R), over the pitch diameter.

    Examples
    --------
    >>> round(1e6 * clearance_loss(Bearing.read("skf-240-600-bc"), 318.15, 313.15), 1)
    44.4
    """
    return EXPANSION * 2.0 * bearing.pitch_radius * (inner - outer)
