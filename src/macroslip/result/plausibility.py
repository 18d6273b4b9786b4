"""Plausibility checks of loads and results: confused units, turned axes, laws beyond their range.

Every sentence says what was found, what is usual, and what to look at. Nothing is refused: a rare
case may be right.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from macroslip.constants import RPM
from macroslip.kinds import KINDS, kind_of
from macroslip.loads import BearingLoads, HubLoads, RollerLoads
from macroslip.result.run_input import stored_settings

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.bearing import Bearing

#: Static load rating over rotor weight of main bearings, generously: 62 for the base bearing.
_WEIGHTS = (5.0, 2000.0)
#: Weights of rotors [N], where no bearing is known.
_ROTORS = (5e3, 1e7)
#: Highest plausible shaft speed [rad/s]: 40 rpm.
_FASTEST = 40.0 * np.pi / 30.0
#: Largest static safety and contact pressure [Pa] of a bearing in use.
_SAFEST = 100.0
_PRESSURE = 4e9
#: Largest mean lateral over vertical force; 0.10 in simulations of whole turbines.
_SIDEWAYS = 0.2
#: Share of the rollers' load that films may carry without the balance of the rings.
_FILMS = 0.05
#: Share of the most loaded roller's load beyond its ends from which on a note says so.
_CUT = 0.01
#: Numbers of a rating that are judged.
JUDGED = ("static_safety", "largest_pressure", "share_below_minimum_load")
#: Share of the time, or of the loaded time, beyond which a range counts as left.
_MOST = 0.5


def doubtful_loads(
    loads: HubLoads | BearingLoads | RollerLoads, bearing: Bearing | None = None
) -> list[str]:
    """Sentences on loads that no rotor in fixed axes has; none where all is plausible.

    The rotor's weight is compared with the static load rating of a bearing; without one, with 5 kN
    to 10 MN.

    Examples
    --------
    >>> doubtful_loads(HubLoads.bundled("14B"))
    []
    >>> upwards = HubLoads.constant((160e3, 0.0, 260e3), (0.0, 0.0, 0.0), 2.0, 10.0)
    >>> doubtful_loads(upwards)[0][:44]
    "the rotor's weight acts upwards: the mean of"
    """
    doubts = []
    fastest = float(np.abs(loads.shaft_speed).max())
    carries_rotor = bearing is None or kind_of(bearing).carries_rotors_only
    if fastest > _FASTEST and carries_rotor:
        doubts.append(
            f"the shaft turns at up to {fastest / RPM:.3g} rpm, and rotors on main bearings stay "
            "below 40 rpm; is the speed that of the generator, or in another unit?"
        )
    if isinstance(loads, HubLoads):
        # A weight in axes that turn says nothing of the rotor's.
        doubts += _loads_that_turn(loads) or _doubtful_weight(loads, bearing)
        thrust = float(loads.force[:, 0].mean())
        if thrust < 0.0:
            doubts.append(
                f"the mean thrust is {thrust / 1e3:.3g} kN, against the wind, and x points "
                "downwind; is the axis turned round, or the rotor downwind of the tower? Loads are "
                "those of a rotor upwind of it."
            )
    return doubts


def _loads_that_turn(loads: HubLoads) -> list[str]:
    """Sentence on transverse forces that turn with the rotor, or are turned back by another angle.

    In axes that turn, fy and fz go round with amplitude W, the rotor's weight, and have a mean near
    zero. Turned back by an angle that is wrong by δ, the weight has a mean fy of W sin δ.
    """
    lateral = loads.force[:, 1:]
    mean_y, mean_z = lateral.mean(axis=0)
    deviations = lateral.std(axis=0)
    for name, deviation in zip(("fy", "fz"), deviations, strict=True):
        if deviation > abs(mean_z):
            return [
                f"{name} goes up and down by {_plain(deviation / 1e3)} kN (its standard "
                f"deviation), more than the rotor's weight, a mean fz of {_plain(mean_z / 1e3)} "
                "kN; are these axes that turn with the rotor, or is the angle that of another "
                "bearing?"
            ]
    if abs(mean_y) > _SIDEWAYS * abs(mean_z):
        angle = math.degrees(math.atan2(mean_y, -mean_z))
        return [
            f"the rotor's weight acts sideways: fy is {_plain(mean_y / 1e3)} kN and fz "
            f"{_plain(mean_z / 1e3)} kN on average, turned by {angle:.0f} degrees; is y the "
            "vertical axis, or do rotating channels count from another azimuth (AzimB1Up)?"
        ]
    return []


def _doubtful_weight(loads: HubLoads, bearing: Bearing | None) -> list[str]:
    """Note on a mean vertical force that cannot be the weight of a rotor on this bearing."""
    lift = float(loads.force[:, 2].mean())
    if lift > 0.0:
        return [
            f"the rotor's weight acts upwards: the mean of the vertical force is {lift / 1e3:+.3g} "
            "kN, and z points up; is the axis turned round, or the force that of the shaft on the "
            "rotor?"
        ]
    rating = bearing.static_load_rating if bearing is not None else None
    weight = f"the rotor weighs {_plain(-lift / 1e3)} kN"
    lightest, heaviest = _WEIGHTS
    if rating and lift < 0.0 and not lightest <= rating / -lift <= heaviest:
        return [
            f"{weight}, which is 1/{_plain(rating / -lift)} of the bearing's static load rating "
            f"C0, and main bearings have 1/{_WEIGHTS[0]:g} to 1/{_WEIGHTS[1]:g}; are the forces in "
            "another unit?"
        ]
    lightest_rotor, heaviest_rotor = _ROTORS
    if not rating and lift < 0.0 and not lightest_rotor <= -lift <= heaviest_rotor:
        return [f"{weight}, and rotors weigh 5 to 10,000 kN; are the forces in another unit?"]
    return []


def _plain(value: float) -> str:
    """A number with three digits, or whole from 100 on."""
    return f"{value:,.0f}" if abs(value) >= 100.0 else f"{value:.3g}"


def doubtful_result(result: xr.Dataset) -> list[str]:
    """Sentences on numbers of a result and its rating that are implausible or beyond its laws.

    With those on its loads.
    """
    doubts = result.attrs.get("doubtful_loads", "").splitlines()
    doubts += _doubtful_rating(result) + _preload_by_heat(result)
    return doubts + _films_in_balance(result) + _cut_contacts(result)


def _doubtful_rating(result: xr.Dataset) -> list[str]:
    """Sentences on safety, pressure, minimum load, film law and life."""
    doubts = []
    largest = {name: float(result[name].max()) for name in JUDGED if name in result}
    safety = largest.get("static_safety", 0.0)
    if safety > _SAFEST:
        doubts.append(
            f"the static safety is {_plain(safety)}, and main bearings in use have 2 to 50: the "
            "loads are too small for this bearing, or in another unit."
        )
    pressure = largest.get("largest_pressure", 0.0)
    if pressure > _PRESSURE:
        doubts.append(
            f"the largest pressure is {pressure / 1e9:.3g} GPa, beyond the 4 GPa that the static "
            "load rating stands for: the loads are too large for this bearing, or in another unit."
        )
    share = largest.get("share_below_minimum_load", 0.0)
    if share > _MOST:
        doubts.append(
            "the load is below the minimum that the maker requires for "
            f"{100.0 * share:.3g} % of the time: rollers skid."
        )
    if "outside_film_range" in result:
        at_raceways = result.outside_film_range.sel(interface=["inner", "outer"])
        outside = float(at_raceways.mean("roller").max())
        if outside > _MOST:
            doubts.append(
                f"the film's formula is outside its range for {100.0 * outside:.3g} % of the "
                "loaded time at a raceway: film thickness and traction are extrapolated there."
            )
    entries = stored_settings(result).get("bearing", {})
    dynamic_rating = entries.get("dynamic_load_rating", {})
    if "basic_life" in result and dynamic_rating.get("tag") == "D":
        doubts.append(
            "C of the bearing was not given and is that of its estimated inside, 0.80 to 0.96 of "
            "what makers publish: lives are 0.5 to 0.9 of those by the maker's C."
        )
    for kind in KINDS.values():
        doubts += kind.doubts(result)
    return doubts


def _preload_by_heat(result: xr.Dataset) -> list[str]:
    """Sentence on a warm inner ring that takes all clearance."""
    preload = -result.attrs.get("operating_clearance", 0.0)
    loss = result.attrs.get("clearance_loss", 0.0)
    if preload <= 0.0 or loss <= 0.0:
        return []
    return [
        f"the inner ring is so much warmer than the outer one that it takes {1e6 * loss:.3g} um of "
        f"clearance and preloads the rollers by {1e6 * preload:.3g} um: friction, heat and loads "
        "of the rollers rise with it, and a little more heat may seize the bearing; give it more "
        "clearance, or check heat.ring_conductance."
    ]


def _films_in_balance(result: xr.Dataset) -> list[str]:
    """Sentence on films that carry a load which the balance of the rings does not know."""
    if "mean_film_load" not in result or "mean_elastic_load" not in result.attrs:
        return []
    films = float(result.mean_film_load.mean())
    load = films + float(result.attrs["mean_elastic_load"])
    if not films > _FILMS * load:
        return []
    return [
        f"films of oil carry {100.0 * films / load:.3g} % of the rollers' load, and the balance "
        "of the rings does not know them: in oil so thick the rings stand further apart, and "
        "loads, energies and torque are less than computed; take a warmer or thinner oil, or a "
        "larger load."
    ]


def _cut_contacts(result: xr.Dataset) -> list[str]:
    """Sentence on contacts that reach beyond the rollers' ends, where they are cut off."""
    share = result.attrs.get("truncated_share", 0.0)
    if not share > _CUT:
        return []
    return [
        f"the contact of the most loaded roller would reach beyond its ends and is cut off there, "
        f"with {100.0 * share:.2g} % of its load: the pressure at the edges, which a roller's profile "
        "relieves, is not computed; check the loads, or give a closer osculation if the bearing has "
        "one."
    ]
