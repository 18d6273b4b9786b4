"""The temperature at which a case's own friction warms its bearing: found by simulating it, before its results count."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from macroslip.errors import InputError
from macroslip.result.heat_balance import balance_temperature, tabulated_power

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.case.case import Case

#: Change of temperature [K] between two guesses at which the balance counts as found, first rise over the surroundings
#: [K], and most guesses.
_CLOSE, _FIRST_RISE, _MOST = 0.2, 30.0, 8


def friction_power(result: xr.Dataset) -> float:
    """Mean friction power of the whole bearing over the window [W]: sliding, rolling, cage and drag.

        P = Z/n Σ (E + E_rolling)/t + P_drag

    of n simulated rollers a row that stand for all Z.

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
            remedy="Give a temperature, or mend what made the roller fail.",
        )
    span = result.attrs["window_end"] - result.attrs["window_start"]
    energy = float(result.energy.sum() + result.rolling_energy.sum())
    share = result.attrs["rollers_per_row"] / result.sizes["roller"]
    return share * energy / span + result.attrs["drag_power"]


def balanced(case: Case, simulate: Callable[[Case], xr.Dataset]) -> Case:
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
    that moves no more: three to five simulations. They have no traces. Load histories of minutes do not change the
    temperature of a bearing, so the balance is that of their mean power if it lasted.
    """
    heat = case.heat
    assert heat is not None, "the case asks for no balance"
    known: dict[float, float] = {}

    def compute(temperature: float) -> None:
        known[temperature] = friction_power(simulate(replace(case, temperature=temperature, traces=None)))

    compute(heat.ambient)
    compute(heat.ambient + _FIRST_RISE)
    for _ in range(_MOST):
        places = sorted(known)
        power = tabulated_power(places, [known[place] for place in places])
        found = balance_temperature(power, heat.conductance, heat.ambient)
        if min(abs(found - place) for place in places) <= _CLOSE:
            return replace(case, temperature=found)
        compute(found)
    raise InputError(
        f"the balance of temperature was not found in {_MOST + 2} simulations",
        where="temperature: balance",
        remedy="Give a temperature.",
    )
