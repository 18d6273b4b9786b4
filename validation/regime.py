"""Regime of lubrication of the loaded rollers: share of the loaded time by Λ, over temperature and oil supply.

Beside it stands the film study of the same turbine's main bearing by the authors of the slip model: Hart, de Mello and
Dwyer-Joyce, Wind Energ. Sci. 7 (2022) 1533, doi:10.5194/wes-7-1533-2022. It finds a starved greased contact mixed for about
nine tenths of the time at 35 °C, a change from full to mixed film within 5 °C, and 6 % more film under half the load.
"""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import numpy as np

from macroslip import Bearing, Case, HubLoads, Laws, main_bearing_load
from macroslip.bearing import geometry
from macroslip.constants import ZERO_CELSIUS
from macroslip.contact.laws import PreparedContact, prepare
from macroslip.result.rating import roller_load_series
from validation.comparison import Comparison, Range

BEARING = Bearing.read("skf-240-600-bc")
CASES = tuple(f"{speed}{turbulence}" for speed in range(12, 25, 2) for turbulence in "ABC")
TEMPERATURES = np.arange(25.0, 46.0, 2.5)
#: Film over the film of a flooded contact.
SUPPLIES = (1.0, 0.7, 0.5)
#: Below it asperities begin to carry load.
MIXED = 3.0


@lru_cache
def states(case: str) -> tuple[np.ndarray, np.ndarray]:
    """Loads [N] of the loaded rollers of both rows of a load case, and entrainment speeds in pure rolling [m/s]."""
    hub = HubLoads.bundled(case)
    whole = Case(loads=hub, laws=Laws.physical())
    loads = main_bearing_load(hub, whole.drivetrain)
    time, load = roller_load_series(whole, loads.start, loads.end)
    inner, outer = geometry.inner_contact_radius(BEARING), geometry.outer_contact_radius(BEARING)
    speed = np.abs(np.interp(time, loads.time, loads.shaft_speed)) * inner * outer / (inner + outer)
    loaded = load > 0.0
    return load[loaded], np.broadcast_to(speed[:, None, None], load.shape)[loaded]


@lru_cache
def inner_raceway(case: str, celsius: float, supply: float) -> PreparedContact:
    """The laws of the inner raceway in a load case as the program has them, with its oil supply."""
    whole = Case(
        loads=HubLoads.bundled(case),
        laws=Laws.physical(),
        temperature=ZERO_CELSIUS + celsius,
        oil_supply=supply,
    )
    return prepare(whole.laws, BEARING, whole.oil, 1).inner


def film_ratio(
    case: str, load: np.ndarray, speed: np.ndarray, celsius: float, supply: float
) -> np.ndarray:
    """Λ at the inner raceway, by the film of `laws: {model: physical}` with an oil supply.

    Parameters
    ----------
    case : str
        Load case, under whose mean load and speed the film is `supply` times the flooded one.
    load, speed : ndarray
        Loads of rollers [N] and entrainment speeds [m/s].
    celsius : float
        Temperature of the oil [degC].
    supply : float
        Film over the flooded film, 0.3 to 1.
    """
    contact = inner_raceway(case, celsius, supply)
    return contact.film_thickness(load, speed) / BEARING.composite_roughness


def mixed_share(case: str, celsius: float, supply: float, below: float = MIXED) -> float:
    """Share of the loaded time of a load case with Λ below a limit."""
    return float(np.mean(film_ratio(case, *states(case), celsius, supply) < below))


@lru_cache
def shares() -> np.ndarray:
    """`mixed_share` of every case, shape (supplies, temperatures, cases)."""
    return np.array(
        [
            [[mixed_share(case, celsius, supply) for case in CASES] for celsius in TEMPERATURES]
            for supply in SUPPLIES
        ]
    )


def change(supply: float = 0.7, case: str = "12B") -> float:
    """Kelvin over which the share below Λ = 3 rises from a tenth to nine tenths."""
    celsius = np.arange(25.0, 50.0, 0.5)
    share = [mixed_share(case, temperature, supply) for temperature in celsius]
    return float(np.interp(0.9, share, celsius) - np.interp(0.1, share, celsius))


def half_load() -> float:
    """Film under half the load over the film, at the mean load of a loaded roller and rated speed."""
    load, speed = (float(np.mean(means)) for means in states("12B"))
    thick, thin = (
        float(film_ratio("12B", np.array(roller_load), np.array(speed), 35.0, 1.0))
        for roller_load in (0.5 * load, load)
    )
    return thick / thin


def compare() -> list[Comparison]:
    """The lines of the table."""
    at = int(np.flatnonzero(TEMPERATURES == 35.0)[0])
    share, width, thinner = Range.of(shares()[SUPPLIES.index(0.7), at]), change(), half_load()
    regime = "film, roughness and supply together: mixed friction has to be in the model"
    return [
        Comparison(
            "share of loaded time with Λ < 3 at 35 °C, supply 0.7, 21 load cases", Range(0.9, 0.9), share,
            Range(share.low / 0.9, share.high / 0.9), regime,
        ),
        Comparison(
            "change from full to mixed film [K]", Range(5.0, 5.0), Range(width, width),
            Range(width / 5.0, width / 5.0), "fall of viscosity with temperature",
        ),
        Comparison(
            "film under half the load over the film", Range(1.06, 1.06), Range(thinner, thinner),
            Range(thinner / 1.06, thinner / 1.06), "power of load",
        ),
    ]  # fmt: skip


def draw(path: Path) -> None:
    """Share below Λ = 3 over temperature, and Λ over load."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9, 3.4), layout="constrained")
    left, right = figure.subplots(1, 2)
    for supply, share, colour in zip(SUPPLIES, shares(), ("C0", "C1", "C3"), strict=True):
        left.fill_between(
            TEMPERATURES, share.min(axis=1), share.max(axis=1), alpha=0.25, color=colour
        )
        left.plot(TEMPERATURES, share.mean(axis=1), color=colour, label=f"oil supply {supply:g}")
    left.plot([35.0], [0.9], "k*", ms=10, label="film study of the turbine")
    left.set(
        xlabel="temperature [°C]", ylabel="share of loaded time with Λ < 3", ylim=(-0.03, 1.03)
    )
    left.legend(
        fontsize="x-small", loc="upper left", bbox_to_anchor=(0.0, 1.2), ncols=2, frameon=False
    )
    load, speed = np.geomspace(1e3, 6e4, 60), float(np.mean(states("12B")[1]))
    for celsius, colour in ((25.0, "C0"), (35.0, "C1"), (45.0, "C3")):
        right.plot(
            1e-3 * load,
            film_ratio("12B", load, np.full(60, speed), celsius, 0.7),
            color=colour,
            label=f"{celsius:g} °C",
        )
    right.axhline(MIXED, color="0.7", lw=0.8)
    right.set(xlabel="roller load [kN]", ylabel="Λ, inner raceway, supply 0.7", ylim=(0.0, None))
    right.legend(fontsize="x-small")
    figure.savefig(path, dpi=110)
