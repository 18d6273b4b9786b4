"""Preloads and moments that a tapered roller bearing cannot carry."""

from __future__ import annotations

import math

import numpy as np

from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.errors import InputError
from macroslip.rating.tapered import tapered_ratings
from macroslip.ring.tapered import TaperedRing, tapered_balance

#: Largest load of a roller over the mean of a half-loaded row, for line contacts without clearance.
_LARGEST_OVER_MEAN = 4.08


def static_roller_load(bearing: TaperedBearing) -> float:
    """Load of the hardest roller at the static load rating, 4.08 C0/(i Z cos α_o) [N].

    Parameters
    ----------
    bearing : TaperedBearing

    References
    ----------
    ISO 76:2006: half of the rollers are loaded by a radial load C0, and 4.08 is Sjövall's integral
    for line contacts.

    Examples
    --------
    >>> round(static_roller_load(TaperedBearing.read("tdo-main-bearing")) / 1e3)
    1113
    """
    static = tapered_ratings(bearing).static
    rollers = bearing.rows * bearing.rollers_per_row
    return _LARGEST_OVER_MEAN * static / (rollers * math.cos(bearing.outer_angle))


def check_preload(bearing: TaperedBearing, ring: TaperedRing) -> None:
    """InputError for a preload that presses rollers beyond the static load rating by itself.

    Parameters
    ----------
    bearing : TaperedBearing
        With the preload that a temperature difference leaves.
    ring : TaperedRing
        Of the bearing.
    """
    if bearing.preload <= 0.0:
        return
    no_force = np.zeros((1, 3))
    no_moment = np.zeros((1, 2))
    alone = tapered_balance(ring, np.zeros(1), no_force, no_moment)
    load = float(alone.outer_load.max())
    limit = static_roller_load(bearing)
    if load > limit:
        raise InputError(
            f"a preload of {bearing.written('preload')} alone presses every roller with "
            f"{load / 1e3:.4g} kN, beyond the static load rating",
            where=f"{bearing.name}, preload with the temperature difference",
            allowed=f"roller loads up to {limit / 1e3:.4g} kN, those of C0 on half of the rollers",
            remedy="Check preload, its unit, and the temperature difference.",
        )


def check_moment(bearing: TaperedBearing, ring: TaperedRing, moment: np.ndarray) -> None:
    """InputError for moments that rows whose load centres (nearly) meet cannot carry.

    Parameters
    ----------
    bearing : TaperedBearing
    ring : TaperedRing
        Of all rows on the shaft.
    moment : ndarray, shape (n, 2)
        About X0 and Y0 through the middle of all rows [N m].
    """
    centre = tapered_geometry(bearing).load_centre
    centres = ring.axial_position - ring.sign * centre
    spread = float(np.ptp(centres))
    moments = np.linalg.norm(moment, axis=1)
    largest = float(moments.max())
    static = tapered_ratings(bearing).static
    if largest > static * spread:
        raise InputError(
            f"the load centres of the rows are {1e3 * spread:.4g} mm apart in "
            f"{bearing.arrangement} arrangement, which carries no moment of {largest / 1e3:.4g} kN m",
            where=f"{bearing.name}, row_offset and arrangement",
            allowed=f"moments up to C0 times that distance, {static * spread / 1e3:.4g} kN m",
            remedy="In X arrangement rows need to stand far apart, and in O they may be close; check "
            "hub_to_bearing and the units of the loads too.",
        )
