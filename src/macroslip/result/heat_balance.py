"""Heat balance of a bearing: temperatures of its oil and rings, and the clearance they leave."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np
import xarray as xr
from scipy.interpolate import PchipInterpolator
from scipy.linalg import expm
from scipy.optimize import root_scalar

from macroslip.arrays import FloatArray
from macroslip.bearing import Bearing
from macroslip.case.case import Case
from macroslip.case.parts import Heat
from macroslip.errors import InputError
from macroslip.input.record import quantities
from macroslip.result.run_input import window_length

#: Thermal expansion of bearing steel from 20 to 100 degC [1/K].
EXPANSION = 11.9e-6
#: Specific heat of bearing steel [J/(kg K)].
SPECIFIC_HEAT = 460.0

HOTTEST = 393.15
"""Highest temperature [K] at which a balance is looked for: 120 degC, beyond which greases and
cages do not last.
"""
#: Distance [K] between the temperatures at which the surplus of heat is asked for a change of sign.
_SCAN_STEP = 0.5
#: Difference [K] between two trial temperatures at which the balance counts as settled.
_SETTLED = 0.2
#: Rise of the second trial temperature over the surroundings [K].
_FIRST_RISE = 30.0
#: Simulations after which a search for the balance ends.
_MOST_TRIALS = 12
#: Diametral preload [m] by which a trial may exceed the warmest one before it: friction rises
#: steeply with it.
_PRELOAD_STEP = 50e-6
_BALANCE = "temperature: balance"


def balance_temperature(
    power: Callable[[float], float], conductance: float, ambient: float, hottest: float = HOTTEST
) -> float:
    """Lowest temperature T [K] with power(T) = conductance (T - ambient), by Brent's method.

    It is found to 1e-9 K. Steady state: the whole friction of the bearing leaves it in proportion
    to its excess temperature. A large bearing takes hours to get there, so the mean power over a
    wind history counts, not that of a gust. Where friction falls with temperature, as in full
    films, there is one solution. Where it rises again, in mixed lubrication or under a preload by
    warm rings, there may be several; a bearing that warms from its surroundings reaches the lowest.

    Parameters
    ----------
    power : Callable[[float], float]
        Friction power of the whole bearing [W] over the temperature of its lubricant [K];
        continuous, not negative. See `tabulated_power`.
    conductance : float
        Heat flow to the surroundings per kelvin [W/K], positive; 40 to 80 is an estimate for the
        main bearing of a 2 MW turbine.
    ambient, hottest : float
        Temperature of the surroundings, and the highest that is accepted [K].

    Returns
    -------
    float
        Temperature [K], from `ambient` to `hottest`. Two solutions closer than 0.5 K may be passed
        over.

    Raises
    ------
    InputError
        If conductance or ambient are out of range, the power is not a finite, non-negative number,
        or the bearing is still heated at the highest temperature.

    Examples
    --------
    >>> round(balance_temperature(lambda temperature: 600.0, conductance=60.0, ambient=288.15), 6)
    298.15
    """
    is_positive = math.isfinite(conductance) and conductance > 0.0
    if not is_positive:
        raise InputError(
            f"the conductance is {conductance:g} W/K",
            allowed="a positive number",
            remedy="40 to 80 W/K is an estimate for the main bearing of a 2 MW turbine.",
        )
    is_below_hottest = math.isfinite(ambient) and 0.0 < ambient < hottest
    if not is_below_hottest:
        raise InputError(
            f"the ambient temperature is {ambient:g} K",
            allowed=f"above 0 K and below {hottest:g} K",
            remedy="Check value and unit.",
        )

    def surplus(temperature: float) -> float:
        heat = power(temperature)
        is_power = math.isfinite(heat) and heat >= 0.0
        if not is_power:
            raise InputError(
                f"the friction power at {temperature:g} K is {heat:g} W",
                allowed="a finite number, not negative",
                remedy="Check the lubricant at that temperature.",
            )
        carried_off = conductance * (temperature - ambient)
        return heat - carried_off

    span = hottest - ambient
    steps = math.ceil(span / _SCAN_STEP)
    temperatures = np.linspace(ambient, hottest, steps + 1)
    colder = ambient
    for temperature in temperatures.tolist():
        left = surplus(temperature)
        if left == 0.0:
            return temperature
        if left < 0.0:
            bracket = (colder, temperature)
            return root_scalar(surplus, bracket=bracket, method="brentq", xtol=1e-9).root
        colder = temperature
    raise InputError(
        f"there is no heat balance up to {hottest:g} K: the friction power exceeds what is carried "
        f"off by {left:.4g} W",
        allowed="a friction power that the surroundings can carry off",
        remedy="Check the conductance, the ambient temperature and the loads.",
    )


def tabulated_power(
    temperatures: Sequence[float], powers: Sequence[float]
) -> Callable[[float], float]:
    """Friction power [W] over temperature [K], interpolated monotonically in a table.

    By SciPy's PCHIP; constant beyond the table's ends. InputError unless there are two or more
    rising temperatures and as many powers, none negative.

    Examples
    --------
    >>> power = tabulated_power([290.0, 310.0, 330.0], [900.0, 600.0, 450.0])
    >>> round(power(310.0), 6), round(power(350.0), 6)
    (600.0, 450.0)
    """
    at = np.asarray(temperatures, dtype=float)
    values = np.asarray(powers, dtype=float)
    are_pairs = at.ndim == 1 and at.shape == values.shape
    if not are_pairs or at.size < 2:
        fault = f"there are {at.size} temperatures and {values.size} powers"
        raise InputError(fault, allowed="as many of the one as of the other, two at least")
    rises = (np.diff(at) > 0.0).all()
    if not (np.isfinite(at).all() and rises):
        raise InputError(
            "the temperatures of the table do not rise", allowed="rising, finite temperatures"
        )
    if not (np.isfinite(values).all() and (values >= 0.0).all()):
        raise InputError(
            "the table has a power that is negative or not finite",
            allowed="powers of 0 W and above",
        )
    curve = PchipInterpolator(at, values)
    coldest = at[0]
    warmest = at[-1]
    return lambda temperature: float(curve(min(max(temperature, coldest), warmest)))


def bearing_friction_power(result: xr.Dataset) -> float:
    """Mean friction power of the bearing over the window [W]: sliding, rolling, cage, ribs and drag.

        P = Z/n Σ (E + E_rolling + E_rib)/t + P_drag

    of n simulated rollers a row that represent all Z. Raises InputError if a roller failed.
    """
    if bool((result.status != 0).any()):
        fault = "a roller failed, so that the friction of the bearing is not known"
        remedy = "Give a temperature, or remove what made the roller fail."
        raise InputError(fault, where=_BALANCE, remedy=remedy)
    energy = float(result.energy.sum() + result.rolling_energy.sum())
    if "rib_energy" in result:
        energy += float(result.rib_energy.sum())
    share = result.attrs["rollers_per_row"] / result.sizes["roller"]
    power = share * energy / window_length(result)
    return power + result.attrs["drag_power"]


def next_temperature(known: Mapping[float, float], case: Case) -> tuple[float, bool]:
    """Temperature [K] to compute next, and whether the balance is settled.

    `known` holds friction powers [W] by temperature [K]. First comes the temperature of the
    surroundings, then 30 K above, then the balance of what is known; it is settled within 0.2 K of
    one that was computed. Where warm rings preload the rollers, a trial adds at most 50 um to the
    preload of the warmest before it: friction rises so steeply there that no trial beyond could be
    trusted.

    Raises InputError if there is no balance, or twelve temperatures have not settled it.

    Examples
    --------
    >>> from macroslip import BearingLoads
    >>> loads = BearingLoads.constant([0.0, -300e3, 0.0], 2.0, 1.0)
    >>> case = Case(loads=loads, temperature="balance", heat=Heat(conductance=40.0, ambient=290.0))
    >>> next_temperature({290.0: 1200.0, 320.0: 600.0}, case)
    (310.0, False)
    """
    heat = case.heat
    assert heat is not None, "the case has no balance"
    if heat.ambient not in known:
        return heat.ambient, False
    temperatures = sorted(known)
    warmest = _warmest_trial(case, temperatures[-1])
    if len(known) == 1:
        return min(heat.ambient + _FIRST_RISE, warmest), False
    powers = [known[temperature] for temperature in temperatures]
    try:
        power = tabulated_power(temperatures, powers)
        balance = balance_temperature(power, heat.to_oil, heat.ambient)
    except InputError as problem:
        if powers[-1] < powers[-2] and warmest < HOTTEST:
            # The table ends where preload stopped the trials, and friction still falls there.
            return warmest, False
        preload = -operating_clearance(case, temperatures[-1])
        if preload <= 0.0:
            raise
        raise InputError(
            f"the bearing runs away: with the oil at {temperatures[-1]:.4g} K the warmer inner "
            f"ring preloads the rollers by {1e6 * preload:.3g} um, and there is no heat balance up "
            f"to {HOTTEST:g} K, because friction rises with the preload",
            where=_BALANCE,
            allowed=problem.allowed,
            remedy="Give the bearing more clearance, or check heat.ring_conductance and "
            "clearance_state.",
        ) from problem
    distance = min(abs(balance - temperature) for temperature in temperatures)
    if distance <= _SETTLED:
        return balance, True
    if len(known) >= _MOST_TRIALS:
        raise InputError(
            f"the balance of temperature was not found in {_MOST_TRIALS} simulations",
            where=_BALANCE,
            remedy="Give a temperature.",
        )
    return min(balance, warmest), False


def _warmest_trial(case: Case, warmest: float) -> float:
    """Temperature [K] at which the preload is `_PRELOAD_STEP` above the warmest trial's."""
    heat = case.heat
    if heat is None or heat.ring_conductance is None:
        return math.inf
    change_above = clearance_change(case, warmest + 1.0)
    per_kelvin = change_above - clearance_change(case, warmest)
    play = max(operating_clearance(case, warmest), 0.0)
    return warmest + (play + _PRELOAD_STEP) / per_kelvin


def case_at_balance(case: Case, simulate: Callable[[Case], xr.Dataset]) -> Case:
    """The case at the temperature at which friction power = heat.to_oil (T − ambient).

    Found by `next_temperature`. Three to five simulations, more under a preload, without traces and
    details of the contacts. Load histories of minutes do not change the temperature of a bearing,
    so the balance is that of their mean power if it lasted.
    """
    known: dict[float, float] = {}
    while True:
        temperature, settled = next_temperature(known, case)
        balanced = at_balance(case, temperature)
        if settled:
            return balanced
        trial = replace(balanced, traces=None, contact_details=False)
        known[temperature] = bearing_friction_power(simulate(trial))


def at_balance(case: Case, temperature: float) -> Case:
    """The case at a temperature [K] of its balance, with the clearance that its rings leave there.

    A clearance below 0 is a preload, which the balance of the rings solves as it does any
    clearance.
    """
    case = replace(case, temperature=temperature)
    if case.heat is None or case.heat.ring_conductance is None:
        return case
    left = operating_clearance(case, temperature)
    narrowest = quantities(Bearing)["diametral_clearance"].lowest
    if left < narrowest:
        raise InputError(
            f"at {temperature:.4g} K of the oil the inner ring would be so much warmer than the "
            f"outer one that the diametral clearance is {1e6 * left:.4g} um",
            where=_BALANCE,
            allowed=f"{1e6 * narrowest:g} um and more",
            remedy="Check heat.ring_conductance, or give the bearing more clearance.",
        )
    bearing = case.bearing.replace(diametral_clearance=left)
    return replace(case, bearing=bearing)


def operating_clearance(case: Case, temperature: float) -> float:
    """Diametral clearance at an oil temperature [K] of the balance [m]; below 0 a preload."""
    if case.heat is None or case.heat.ring_conductance is None:
        return case.bearing.diametral_clearance
    return case.bearing.diametral_clearance - clearance_change(case, temperature)


def clearance_change(case: Case, temperature: float) -> float:
    """Diametral clearance [m] that the rings take with the oil at a temperature [K] of the balance.

    The bearing's clearance is that of a mounted bearing: cold, with both rings at one temperature,
    if its `clearance_state` is cold; otherwise warm, with the oil at `reference_temperature(case)`,
    where the inner ring is warmer already. Then only the difference to that state is taken, which
    is negative for a colder oil.
    """
    heat = case.heat
    assert heat is not None, "the case has no balance"
    rings = rings_at_balance(heat, temperature)
    loss = clearance_loss(case.bearing, *rings)
    if case.bearing.clearance_state == "cold":
        return loss
    reference_rings = rings_at_balance(heat, reference_temperature(case))
    return loss - clearance_loss(case.bearing, *reference_rings)


def reference_temperature(case: Case) -> float:
    """Temperature of the oil [K] at which the bearing's warm clearance holds.

    That of `heat.clearance_temperature`, without it that of the lubricant's values; not below the
    surroundings, at whose temperature no friction warms the inner ring.
    """
    heat = case.heat
    assert heat is not None, "the case has no balance"
    clearance_temperature = heat.clearance_temperature
    return max(
        case.lubricant.inlet_temperature
        if clearance_temperature is None
        else clearance_temperature,
        heat.ambient,
    )


def operating_rings(case: Case) -> dict[str, float]:
    """Attributes of a result at its balance: temperatures of the rings [K], and clearances [m].

    They are empty for a case whose rings have no temperatures of their own. `clearance_loss` is
    what the rings took off the clearance of the bearing file, `operating_clearance` what they left.
    """
    heat = case.heat
    if heat is None or heat.ring_conductance is None or not isinstance(case.temperature, float):
        return {}
    inner, outer = rings_at_balance(heat, case.temperature)
    return {
        "inner_ring_temperature": inner,
        "outer_ring_temperature": outer,
        "clearance_loss": clearance_change(case, case.temperature),
        "operating_clearance": case.bearing.diametral_clearance,
    }


def rings_at_balance(heat: Heat, temperature: float) -> tuple[float, float]:
    """Temperatures of inner and outer ring [K] with the oil at a temperature [K] of the balance."""
    power = heat.to_oil * (temperature - heat.ambient)
    start = (heat.ambient, heat.ambient)
    (steady,) = ring_temperatures(heat, power, [math.inf], start)
    inner, outer = steady
    return float(inner), float(outer)


def ring_temperatures(
    heat: Heat, power: float, time: Sequence[float], start: tuple[float, float]
) -> FloatArray:
    """Temperatures of inner and outer ring under a constant friction power, exact.

        m_i c dT_i/dt = P/2 − G_r (T_i − T_o)
        m_o c dT_o/dt = P/2 + G_r (T_i − T_o) − G (T_o − T_ambient)

    Parameters
    ----------
    heat : Heat
        With the masses m_i, m_o [kg] and the ring conductance G_r [W/K].
    power : float
        P [W]; 0 for a cooling curve.
    time : sequence of float
        n times since the start [s]; infinite for the steady state.
    start : tuple of float
        Temperatures of inner and outer ring at the start [K].

    Returns
    -------
    ndarray, shape (n, 2)
        T_i and T_o [K].

    Raises
    ------
    InputError
        If the masses or the ring conductance are not given.

    Examples
    --------
    >>> rings = {"inner_mass": 4000.0, "outer_mass": 3000.0, "ring_conductance": 100.0}
    >>> heat = Heat(conductance=60.0, ambient=293.15, **rings)
    >>> ring_temperatures(heat, 1000.0, [0.0, float("inf")], (293.15, 293.15)).round(2).tolist()
    [[293.15, 293.15], [314.82, 309.82]]
    """
    if heat.ring_conductance is None or heat.inner_mass is None or heat.outer_mass is None:
        allowed = "inner_mass, outer_mass and ring_conductance"
        raise InputError("the masses of the rings are not given", where="heat", allowed=allowed)
    between = heat.ring_conductance
    out = heat.conductance
    masses = np.array([[heat.inner_mass], [heat.outer_mass]])
    capacity = SPECIFIC_HEAT * masses
    conductances = [[-between, between], [between, -between - out]]
    rate = np.array(conductances) / capacity
    outer = heat.ambient + power / out
    inner = outer + 0.5 * power / between
    steady = np.array([inner, outer])
    temperatures = []
    for t in time:
        left = 0.0
        if math.isfinite(t):
            left = expm(rate * t) @ (start - steady)
        temperatures.append(steady + left)
    return np.array(temperatures)


def clearance_loss(bearing: Bearing, inner: float, outer: float) -> float:
    """Diametral clearance [m] that an inner ring takes which is warmer than the outer one.

    Thermal expansion of steel, 11.9e-6 per kelvin (tag R), over the pitch diameter. Both
    temperatures are in K or both in degC.

    Examples
    --------
    >>> round(1e6 * clearance_loss(Bearing.read("skf-240-600-bc"), 318.15, 313.15), 1)
    44.4
    """
    return EXPANSION * 2.0 * bearing.pitch_radius * (inner - outer)
