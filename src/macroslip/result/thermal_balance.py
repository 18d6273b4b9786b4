"""The temperature to which its own friction warms a bearing: found by simulating it, before its results count."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from macroslip.errors import InputError
from macroslip.result.heat_balance import balance_temperature, tabulated_power

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.case.case import Case
    from macroslip.case.parts import Heat

#: Change of temperature [K] between two guesses at which the balance counts as found, first rise over the surroundings
#: [K], and most guesses.
_CLOSE, _FIRST_RISE, _MOST = 0.2, 30.0, 10


def bearing_friction_power(result: xr.Dataset) -> float:
    """Mean friction power of the whole bearing over the window [W]: sliding, rolling, cage and drag.

        P = Z/n Σ (E + E_rolling)/t + P_drag

    of n simulated rollers a row that represent all Z.

    Parameters
    ----------
    result : xarray.Dataset
        From `macroslip.simulate`.

    Raises
    ------
    InputError
        If a roller failed.
    """
    if bool((result.status != 0).any()):
        raise InputError(
            "a roller failed, so that the friction of the bearing is not known",
            where="temperature: balance",
            remedy="Give a temperature, or remove what made the roller fail.",
        )
    span = result.attrs["window_end"] - result.attrs["window_start"]
    energy = float(result.energy.sum() + result.rolling_energy.sum())
    share = result.attrs["rollers_per_row"] / result.sizes["roller"]
    return share * energy / span + result.attrs["drag_power"]


def next_temperature(known: Mapping[float, float], heat: Heat) -> tuple[float, bool]:
    """Temperature at which friction, as far as it is known, is what the bearing loses; and whether that is settled.

    Parameters
    ----------
    known : mapping of float to float
        Friction power [W] by temperature [K], as far as it was computed.
    heat : Heat

    Returns
    -------
    (float, bool)
        The temperature to compute next [K]; first that of the surroundings, then 30 K above, then the balance of what is
        known. Settled: within 0.2 K of one that was computed.

    Raises
    ------
    InputError
        If there is no balance, or ten temperatures have not settled it.

    Examples
    --------
    >>> from macroslip import Heat
    >>> next_temperature({290.0: 1200.0, 320.0: 600.0}, Heat(conductance=40.0, ambient=290.0))
    (310.0, False)
    """
    for first in (heat.ambient, heat.ambient + _FIRST_RISE):
        if first not in known:
            return first, False
    places = sorted(known)
    found = balance_temperature(
        tabulated_power(places, [known[place] for place in places]), heat.conductance, heat.ambient
    )
    if min(abs(found - place) for place in places) <= _CLOSE:
        return found, True
    if len(known) >= _MOST:
        raise InputError(
            f"the balance of temperature was not found in {_MOST} simulations",
            where="temperature: balance",
            remedy="Give a temperature.",
        )
    return found, False


def case_at_balance(case: Case, simulate: Callable[[Case], xr.Dataset]) -> Case:
    """The case at the temperature at which friction power = conductance (T − ambient).

    Parameters
    ----------
    case : Case
        With `temperature="balance"` and its `heat`.
    simulate : callable
        Simulates a case at a given temperature.

    Returns
    -------
    Case
        The same with its temperature [K], within 0.2 K.

    Raises
    ------
    InputError
        If there is no balance.

    Notes
    -----
    Power is computed at the surroundings' temperature and 30 K above, and then at the balance of what is known, until
    that moves no more: three to five simulations, without traces and details of the contacts. Load histories of
    minutes do not change the temperature of a bearing, so the balance is that of their mean power if it lasted.
    """
    heat = case.heat
    assert heat is not None, "the case has no balance"
    known: dict[float, float] = {}
    while True:
        temperature, settled = next_temperature(known, heat)
        if settled:
            return replace(case, temperature=temperature)
        trial = replace(case, temperature=temperature, traces=None, contact_details=False)
        known[temperature] = bearing_friction_power(simulate(trial))
