"""Where on the raceways energy is dissipated: energy and largest power per area, by angle and place along the roller.

The outer raceway is at rest, and the angle of a place on it is φ, from +X0 towards +Y0. The inner raceway turns with
the shaft, and the angle of a place on it is counted from where +X0 was at the first sample: φ less the shaft's angle.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from macroslip.compiled import jit_part

#: Sectors of a raceway, 5° each.
SECTORS = 72
#: Stations along the roller's length.
STATIONS = 24
#: Meaning of `RollerRecord.surface_energy` by its last two positions.
SLIP_SIGNS = ("negative", "positive")
FILM_REGIMES = ("below 1", "1 and above")


class Way(NamedTuple):
    """A part of the way of a roller.

    Attributes
    ----------
    start_angle : float
        Its position φ at the first sample [rad].
    orbit_ratio : float
        Orbital speed over shaft speed [-].
    before, after : float
        The shaft's angle before and after it [rad].
    """

    start_angle: float
    orbit_ratio: float
    before: float
    after: float


class Passed(NamedTuple):
    """Sectors of a raceway that a way leads through.

    Attributes
    ----------
    start, end : float
        Of the way, in sectors and not wound back to one turn; `start` is the lower one.
    lowest, count : int
        The first sector, not wound back either, and how many there are.
    first : int
        The first sector as the maps count it.
    direction : float
        1 where the way leads from `start` to `end`, −1 where the other way.
    """

    start: float
    end: float
    lowest: int
    count: int
    first: int
    direction: float


@jit_part
def sectors_of(way, interface):
    """Sectors of a raceway, 0 the inner and 1 the outer, that a `Way` leads through: `Passed`."""
    ratio = way.orbit_ratio if interface == 1 else way.orbit_ratio - 1.0
    per_angle = SECTORS / (2.0 * math.pi)
    before = (way.start_angle + ratio * way.before) * per_angle
    after = (way.start_angle + ratio * way.after) * per_angle
    start, end = min(before, after), max(before, after)
    lowest = math.floor(start)
    direction = 1.0 if before <= after else -1.0
    return Passed(start, end, lowest, math.floor(end) - lowest + 1, lowest % SECTORS, direction)


@jit_part
def spread(surface, interface, passed, powers, per_power, growth):
    """Give the places a roller passes their energy, linearly along the way.

    Parameters
    ----------
    surface : ndarray, shape (raceways, sectors, stations, signs of slip, film regimes)
        Energies [J].
    interface : int
    passed : Passed
    powers : ndarray, shape (stations + 2,)
        Powers along the roller in proportion to which energy is given [W], with the sign of slip, and in the last
        place which film regime it is.
    per_power : float
        Energy per power [J/W].
    growth : float
        Of the energy along the way, over its mean: from −1, nothing at the end, to 1, nothing at the beginning.
    """
    regime, place = int(powers[STATIONS + 1]), passed.first
    for n in range(passed.count):
        sector, share = passed.lowest + n, per_power
        if passed.count > 1:
            way = passed.end - passed.start
            here = (max(passed.start, float(sector)) - passed.start) / way
            there = (min(passed.end, sector + 1.0) - passed.start) / way
            share *= (there - here) * (1.0 + passed.direction * growth * (there + here - 1.0))
        energies = surface[interface, place]
        for k in range(STATIONS):
            energies[k, 1 if powers[k] > 0.0 else 0, regime] += share * abs(powers[k])
        place = place + 1 if place + 1 < SECTORS else 0


@jit_part
def raise_density(largest, interface, passed, station, density):
    """Let the largest power per area of the places a roller passes be at least `density` [W/m²]."""
    place = passed.first
    for _ in range(passed.count):
        densities = largest[interface, place]
        densities[station] = max(densities[station], density)
        place = place + 1 if place + 1 < SECTORS else 0
