"""Oil supply of the inlets of the contacts.

One choice of a case, from which films, rolling and idle contacts follow.

The state of all inlets is the gap from which on they are full of oil [m]. In a contact of film h it
is S = gap/h, from which film and rolling resistance follow (`macroslip.contact.starvation`), and
the rigid film of an idle contact (`contact.gap`).
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.constants import FLOODED_GAP
from macroslip.errors import InputError
from macroslip.input.fields import Context, Form
from macroslip.input.units import is_finite_number
from macroslip.kinds import kind_of

if TYPE_CHECKING:
    from macroslip.bearing import Bearing
    from macroslip.case.case import Case
    from macroslip.contact.mechanisms import Laws
    from macroslip.loads import BearingLoads
    from macroslip.lubricant import Lubricant

FLOODED, SKF = WORDS = ("flooded", "skf")
#: Least film over flooded film.
_LEAST = 0.3


@dataclass(frozen=True)
class OilSupply(Form):
    """A word, or the film over the flooded film."""

    form = (
        f"{FLOODED}, {SKF}, or film / flooded film at the inner raceway under the mean load, "
        f"{_LEAST:g} to 1"
    )

    def read(self, value: Any, context: Context) -> str | float:
        """The word, or the number."""
        if value in WORDS:
            return value
        if not is_finite_number(value) or not _LEAST <= value <= 1.0:
            raise self.wrong(value)
        return float(value)

    def json(self) -> dict[str, Any]:
        """The words, or the number."""
        return {
            "anyOf": [{"enum": list(WORDS)}, {"type": "number", "minimum": _LEAST, "maximum": 1}]
        }


def inlet_supply(supply: str | float | None, laws: Laws) -> str | float:
    """Oil supply in effect: that of the case.

    Otherwise SKF's replenishment where a mechanism depends on it.
    """
    if supply is not None:
        return supply
    return SKF if laws.asks_for_oil else FLOODED


def check_supply(supply_given: str | float | None, bearing: Bearing, laws: Laws) -> None:
    """Refuse an oil supply that no law uses, or that the bearing lacks diameters for.

    Parameters
    ----------
    supply_given : str, float or None
        Supply that a case gives: `flooded`, `skf`, or film over flooded film [-]; None where it
        gives none.
    bearing : Bearing
    laws : Laws

    Raises
    ------
    InputError
        If the laws have neither a starved film nor rolling resistance, or if SKF's replenishment is
        asked for and the bearing has no bore or outside diameter.
    """
    supply = inlet_supply(supply_given, laws)
    if supply not in (FLOODED, 1.0) and not laws.asks_for_oil:
        raise InputError(
            f"oil_supply is {supply!r}, and laws: {laws.name} have neither a starved film nor "
            "rolling resistance",
            where="oil_supply",
            allowed=f"{FLOODED} with these laws",
            remedy="Leave it out, set laws.starvation: true, or choose model: physical.",
        )
    missing = [
        key for key in ("bore_diameter", "outside_diameter") if getattr(bearing, key) is None
    ]
    if supply == SKF and missing:
        raise InputError(
            f"SKF's replenishment factor goes with the bearing's size, and {bearing.name} has no "
            f"{' and no '.join(missing)}",
            where="oil_supply",
            allowed=f"{SKF} with both diameters; otherwise {FLOODED}, or a number from {_LEAST:g} "
            "to 1",
            remedy="Add them to the bearing file, or give the film over the flooded film as a "
            "number.",
        )


def oil_gap(
    supply: str | float, bearing: Bearing, oil: Lubricant, loads: BearingLoads, laws: Laws
) -> float:
    """Gap from which on inlets are full, from the inner raceway under the mean load and speed.

    The mean load is that of the loaded rollers of the row with the larger share, under the mean
    force on the inner ring. Means are over the angle that the shaft turns, so that time at rest
    does not count.

    Parameters
    ----------
    supply : str or float
        `flooded`; `skf`: as much as makes the rolling resistance SKF's replenishment factor times
        the flooded one; or film over flooded film [-].
    bearing : Bearing
    oil : Lubricant
    loads : BearingLoads
    laws : Laws

    Returns
    -------
    float
        The gap [m]. 1 m counts as flooded, and is given without load or motion as well.
    """
    steps = np.diff(loads.time)
    seconds = np.convolve(steps, [0.5, 0.5])
    shaft_speed = np.abs(loads.shaft_speed)
    turned = shaft_speed * seconds
    if not turned.any():
        return FLOODED_GAP
    force = np.average(loads.force, axis=0, weights=turned)
    speed = np.average(shaft_speed, weights=turned)
    mean_force = tuple(map(float, force))
    return _gap(supply, bearing, oil, laws, mean_force, float(speed))


@functools.lru_cache(maxsize=64)
def _gap(
    supply: str | float,
    bearing: Bearing,
    oil: Lubricant,
    laws: Laws,
    force: tuple[float, ...],
    speed: float,
) -> float:
    """`oil_gap` from the mean force [N] and the mean size of the shaft's speed [rad/s], > 0."""
    from macroslip.contact.laws import prepare
    from macroslip.contact.rolling import replenishment
    from macroslip.contact.starvation import film_factor, inlet_for_film, inlet_for_rolling

    if supply in (FLOODED, 1.0):
        return FLOODED_GAP
    if supply == SKF:
        diameters = bearing.bore_diameter, bearing.outside_diameter
        factor = kind_of(bearing).replenishment_factor
        kinematic = oil.viscosity / oil.density
        filled = float(replenishment(kinematic, speed, *diameters, type_factor=factor))
        inlet = math.inf
        if filled < 1.0:
            inlet = inlet_for_rolling(filled)
    else:
        inlet = inlet_for_film(float(supply))
    load, entrainment = _inner_raceway(bearing, oil, force, speed)
    if not load > 0.0 or math.isinf(inlet):
        return FLOODED_GAP
    laws_of_contacts = prepare(laws, bearing, oil.supplied(FLOODED_GAP), 1)
    flooded = float(laws_of_contacts.inner.film_thickness(load, entrainment))
    starved = inlet * float(film_factor(inlet)) * flooded
    return min(starved, FLOODED_GAP)


def _inner_raceway(
    bearing: Bearing, oil: Lubricant, force: tuple[float, ...], speed: float
) -> tuple[float, float]:
    """Mean load of a loaded roller [N] and entrainment speed of the inner raceway [m/s].

    Under a force on the inner ring [N] and a size of the shaft's speed [rad/s].
    """
    from macroslip.roller.model import roller_model

    model = roller_model(bearing, oil, 1, tilt=0.0)
    loads = kind_of(bearing).roller_loads(bearing, model, np.array(force))
    row = max(loads.reshape(bearing.rows, -1), key=np.sum)
    loaded = row[row > 0.0]
    load = 0.0
    if loaded.size:
        load = float(loaded.mean())
    entrainment = speed * model.orbit_ratio * model.outer_radius
    return load, entrainment


def supply_note(case: Case) -> str:
    """State of the inlets in a line, for a result; empty if no law asks for oil."""
    if not case.laws.asks_for_oil:
        return ""
    gap = case.oil.oil_gap
    if gap >= FLOODED_GAP:
        return f"oil_supply {case.inlet_supply}: flooded inlets"
    micrometres = 1e6 * gap
    return f"oil_supply {case.inlet_supply}: inlets are full from a gap of {micrometres:.3g} um on"
