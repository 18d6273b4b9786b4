"""Load from which on a raceway grips a tapered roller, so that it rolls and does not slip."""

from __future__ import annotations

import math

from scipy.optimize import brentq

from macroslip.bearing.geometry import roller_mass
from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.constants import GRAVITY
from macroslip.contact.line_rolling import (
    line_contacts,
    line_film,
    line_traction,
    rolling_resistance,
)
from macroslip.errors import InputError
from macroslip.lubricant import Lubricant

#: Least and largest load that is tried [N].
_LOADS = (1e-2, 1e7)


def grip_load(
    bearing: TaperedBearing,
    lubricant: Lubricant,
    shaft_speed: float,
    *,
    slide_roll_ratio: float = 0.01,
    film_factor: float = 1.0,
    rolling: str = "zhou-hoeprich",
) -> float:
    """Load of a raceway at which its traction drives an idling roller at a given slide-roll ratio [N].

    The inner raceway has to pass on the rolling resistance of the contact and half of the roller's
    weight. A line contact under a light load is nearly Newtonian, so that the answer depends on the
    slide-roll ratio that one is ready to call grip.

    Parameters
    ----------
    bearing : TaperedBearing
    lubricant : Lubricant
        At its temperature.
    shaft_speed : float
        Speed of the inner ring [rad/s], > 0.
    slide_roll_ratio : float, optional
        Slip over the entrainment speed that counts as grip [-].
    film_factor : float, optional
        Film over the film with a full inlet [-], above 0 and at most 1.
    rolling : {"zhou-hoeprich", "goksem-hargreaves"}, optional
        Rolling resistance; the second one, which hardly knows load, asks for 7 % more.

    Returns
    -------
    float
        Q [N].

    Raises
    ------
    InputError
        If no load up to 10 MN grips the roller.

    Examples
    --------
    >>> bearing = TaperedBearing.read("tdo-main-bearing")
    >>> oil = Lubricant.read("vg460-pao").at(308.15)
    >>> 10e3 < grip_load(bearing, oil, 1.2566, film_factor=0.7) < 25e3
    True
    """
    row = tapered_geometry(bearing)
    inner, _ = line_contacts(bearing, lubricant)
    speed = float(row.surface_speed(shaft_speed))
    mass = roller_mass(bearing.density, row.roller_radius, bearing.roller_length)
    weight = 0.5 * mass * GRAVITY

    def missing(log_load: float) -> float:
        load = math.exp(log_load)
        film = film_factor * line_film(inner, load, speed)
        grip = line_traction(inner, load, film, slide_roll_ratio * speed)
        return float(grip - rolling_resistance(inner, load, speed, rolling) - weight)

    least, largest = (math.log(load) for load in _LOADS)
    if missing(largest) <= 0.0:
        raise InputError(
            f"no load up to {_LOADS[1] / 1e6:g} MN grips a roller of {bearing.name} at "
            f"{shaft_speed:.4g} rad/s",
            allowed="a lubricant and a speed whose film transmits more traction",
            remedy="Check the lubricant's viscosity and the speed.",
        )
    if missing(least) >= 0.0:
        return _LOADS[0]
    return math.exp(brentq(missing, least, largest, xtol=1e-6))
