"""Maps of dissipated energy on the raceways and along the roller.

A sample spreads the energies since the one before over the way since then, as if power had passed
linearly in time from how it lay along the roller at that one to how it lies now.

The outer raceway is at rest, and the angle of a place on it is φ, from +X0 towards +Y0. The inner
raceway turns with the shaft, and the angle of a place on it is counted from where +X0 was at the
first load sample: φ less the shaft's angle. A roller of a whole bearing is ahead of pure rolling,
or behind: φ is its own.
"""

from __future__ import annotations

import math

import numpy as np

from macroslip.compiled import jit_inline, jit_once
from macroslip.constants import SECTORS
from macroslip.measures.along import ALONG, FILM_EDGES, SLIP_EDGES, STATIONS

#: Sectors of a raceway per angle [1/rad].
PER_ANGLE = SECTORS / (2.0 * math.pi)
#: Stations that are added up together.
_GROUP = 8
#: Meaning of the last two positions of the energies of places.
SLIP_SIGNS = ("negative", "positive")
FILM_REGIMES = ("below 1", "1 and above")
#: A place of a raceway: a sector of it, by station where not said otherwise.
_SECTOR = np.dtype(
    [
        # Energy by film regime, sign of slip and station along the roller [J].
        ("energy", "f8", (len(FILM_REGIMES), len(SLIP_SIGNS), STATIONS)),
        # Largest power per area [W/m²].
        ("density", "f8", (STATIONS,)),
        # Energy of asperities [J].
        ("asperities", "f8", (STATIONS,)),
        # ∫∫ p |v| dA dt [J].
        ("work", "f8", (STATIONS,)),
        # Passes over the sector [-].
        ("passes", "f8"),
    ]
)
#: Sums over the samples. A record in place of arrays, whose references would be counted at every
#: sample.
MAPS = np.dtype(
    [
        # By raceway and sector.
        ("surface", _SECTOR, (2, SECTORS)),
        # By raceway, ∫∫ p |v| dA dt times load [J N], and itself [J].
        ("working_load", "f8", (2, 2)),
        # By raceway, class of Λ and of the slide-roll ratio: time under load times the part of the
        # length [s]; passes [-].
        ("film_slip", "f8", (2, len(FILM_EDGES) + 1, len(SLIP_EDGES) + 1, 2)),
        # How power lies along the roller: two records a raceway, and one for the peaks.
        ("along", ALONG, (5,)),
        # Which of the two, by raceway, is of the last sample with load.
        ("last", "i8", (2,)),
    ]
)


@jit_once
def _add(sector, stations, shares, spent, before, after):
    """Add the energies of a sector, and raise its power per area to that of now.

    To both regimes all is added, to one of them without weight: the processor adds several stations
    at once where each goes the same way.
    """
    share, even = shares
    old = share * spent[0]
    new = share * spent[1]
    old_thick = old if before.regime == 1 else 0.0
    new_thick = new if after.regime == 1 else 0.0
    old_thin = old - old_thick
    new_thin = new - new_thick
    old_rough = share * spent[2]
    new_rough = share * spent[3]
    old_work = even * spent[4]
    new_work = even * spent[5]
    # That the index is not negative the compiler has to see.
    from_first = max(stations[0], 0)
    for n in range(stations[1]):
        k = from_first + n
        sector.energy[0, 0, k] += old_thin * before.negative[k] + new_thin * after.negative[k]
        sector.energy[0, 1, k] += old_thin * before.positive[k] + new_thin * after.positive[k]
        sector.energy[1, 0, k] += old_thick * before.negative[k] + new_thick * after.negative[k]
        sector.energy[1, 1, k] += old_thick * before.positive[k] + new_thick * after.positive[k]
        sector.asperities[k] += old_rough * before.rough[k] + new_rough * after.rough[k]
        sector.work[k] += old_work * before.work[k] + new_work * after.work[k]
        sector.density[k] = max(sector.density[k], after.density[k])


@jit_inline
def spread(maps, interface, way, mean_time, spent, before, after):
    """Distribute energies over the stations and over the raceway sectors that were passed.

    They are spread as power lay at the sample before and as it lies now. Along the roller they are
    in proportion to the powers; along the way, from one sector to another, they are linear, with
    the mean time that they have. The largest power per area of the sectors is raised to that of now.

    Parameters
    ----------
    maps : record of `MAPS`
        Energies and passes are added.
    interface : int
        0 for the inner raceway, 1 for the outer one.
    way : tuple of float
        Places on the raceway at the sample before and now [sectors].
    mean_time : float
        Part of the time in between at which the energy was spent in the mean [-].
    spent : tuple of float
        Energy [J] and energy of asperities [J] over their power, and the time of the work of
        pressure and slip [s], each before and now.
    before, after : record of `macroslip.measures.along.ALONG`
        How power lay at the sample before, and lies now.
    """
    # Whole groups of stations, which the processor adds up at once.
    first = min(before.first, after.first) // _GROUP * _GROUP
    behind = (max(before.behind, after.behind) + _GROUP - 1) // _GROUP * _GROUP
    stations = first, behind - first
    start = min(way[0], way[1])
    end = max(way[0], way[1])
    lowest = math.floor(start)
    sectors = math.floor(end) - lowest + 1
    growth = min(max(3.0 * (2.0 * mean_time - 1.0), -1.0), 1.0)
    if way[0] > way[1]:
        growth = -growth
    per_way = 1.0 / (end - start) if sectors > 1 else 0.0
    for n in range(lowest, lowest + sectors):
        sector = maps.surface[interface, int(n % SECTORS)]
        share = 1.0
        even = 1.0
        if sectors > 1:
            here = (max(start, float(n)) - start) * per_way
            there = (min(end, n + 1.0) - start) * per_way
            even = there - here
            share = even * (1.0 + growth * (there + here - 1.0))
        sector.passes += even * (end - start)
        _add(sector, stations, (share, even), spent, before, after)
