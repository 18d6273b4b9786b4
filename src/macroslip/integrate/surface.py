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


@jit_part
def sector_of(way, interface, part):
    """Place of a roller on a raceway after part of its way, in sectors, with fraction and not wound back to one turn."""
    turned = way.before + part * (way.after - way.before)
    ratio = way.orbit_ratio if interface == 1 else way.orbit_ratio - 1.0
    return (way.start_angle + ratio * turned) * (SECTORS / (2.0 * math.pi))


@jit_part
def spread(surface, interface, way, powers, energy):
    """Give the places a roller passes the energy of its way, evenly.

    Parameters
    ----------
    surface : ndarray, shape (raceways, sectors, stations, signs of slip, film regimes)
        Energies [J].
    powers : ndarray, shape (stations + 2,)
        Powers along the roller in proportion to which the energy is given [W], with the sign of slip, and in the last
        place which film regime it is.
    energy : float
        [J].
    """
    total = 0.0
    for k in range(STATIONS):
        total += abs(powers[k])
    if total <= 0.0 or energy == 0.0:
        return
    start, end = sector_of(way, interface, 0.0), sector_of(way, interface, 1.0)
    if start > end:
        start, end = end, start
    length = end - start
    regime = int(powers[STATIONS + 1])
    lowest, highest = math.floor(start), math.floor(end)
    for sector in range(lowest, highest + 1):
        passed = 1.0 if lowest == highest else (min(end, sector + 1.0) - max(start, float(sector))) / length
        share = energy * passed / total
        place = surface[interface, sector % SECTORS]
        for k in range(STATIONS):
            place[k, 1 if powers[k] > 0.0 else 0, regime] += share * abs(powers[k])


@jit_part
def raise_density(largest, interface, way, station, density):
    """Let the largest power per area of the places a roller passes be at least `density` [W/m²]."""
    start, end = sector_of(way, interface, 0.0), sector_of(way, interface, 1.0)
    if start > end:
        start, end = end, start
    for sector in range(math.floor(start), math.floor(end) + 1):
        place = largest[interface, sector % SECTORS]
        place[station] = max(place[station], density)
