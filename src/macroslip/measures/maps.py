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

from macroslip.compiled import jit, jit_inline
from macroslip.constants import SECTORS
from macroslip.contact.chords import SLICES
from macroslip.measures.along import ALONG, FILM_EDGES, SLIP_EDGES, STATIONS

#: Sectors of a raceway per angle [1/rad].
PER_ANGLE = SECTORS / (2.0 * math.pi)
#: Meaning of the last two positions of the energies of places.
SLIP_SIGNS = ("negative", "positive")
FILM_REGIMES = ("below 1", "1 and above")
_PLACES = (2, SECTORS, STATIONS)
#: Sums over the samples: the fields of `Details` of the same names. A record in place of arrays,
#: whose references would be counted at every sample.
MAPS = np.dtype(
    [
        # Energy by raceway and station along the roller [J].
        ("station_energy", "f8", (2, STATIONS)),
        # Energy by raceway, sector, station, sign of slip and film regime [J].
        ("surface_energy", "f8", (*_PLACES, len(SLIP_SIGNS), len(FILM_REGIMES))),
        # Largest power per area by raceway, sector and station [W/m²].
        ("surface_density", "f8", _PLACES),
        # Energy of asperities by raceway, sector and station [J].
        ("surface_asperities", "f8", _PLACES),
        # ∫∫ p |v| dA dt by raceway, sector and station [J].
        ("surface_work", "f8", _PLACES),
        # Passes over each sector by raceway [-].
        ("surface_passes", "f8", (2, SECTORS)),
        # By raceway, ∫∫ p |v| dA dt times load [J N], and itself [J].
        ("working_load", "f8", (2, 2)),
        # By raceway, class of Λ and of the slide-roll ratio: time under load times the part of the
        # length [s]; passes [-].
        ("film_slip", "f8", (2, len(FILM_EDGES) + 1, len(SLIP_EDGES) + 1, 2)),
        # How power lies along the roller: two records a raceway, and one for the peaks.
        ("along", ALONG, (5,)),
        # Slices of the contact of a sample while it is computed.
        ("slices", SLICES),
        # Which of the two, by raceway, is of the last sample with load.
        ("last", "i8", (2,)),
    ]
)


@jit_inline
def _share(way, sector, mean_time):
    """Share of a sector in a way through sectors that is passed with linearly varying speed."""
    start = min(way[0], way[1])
    end = max(way[0], way[1])
    if math.floor(start) == math.floor(end):
        return 1.0
    growth = min(max(3.0 * (2.0 * mean_time - 1.0), -1.0), 1.0)
    here = (max(start, float(sector)) - start) / (end - start)
    there = (min(end, sector + 1.0) - start) / (end - start)
    return (there - here) * (1.0 + (growth if way[0] <= way[1] else -growth) * (there + here - 1.0))


@jit
def spread(maps, interface, way, mean_time, spent, before, after):
    """Distribute energies over the stations and over the raceway sectors that were passed.

    They are spread as power lay at the sample before and as it lies now. Along the roller they are
    in proportion to the powers; along the way, from one sector to another, they are linear, with
    the mean time that they have.

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
    stations = range(min(before.first, after.first), max(before.behind, after.behind))
    for k in stations:
        maps.station_energy[interface, k] += spent[0] * abs(before.power[k]) + spent[1] * abs(
            after.power[k]
        )
    lowest = math.floor(min(way[0], way[1]))
    for n in range(math.floor(max(way[0], way[1])) - lowest + 1):
        share = _share(way, lowest + n, mean_time)
        even = _share(way, lowest + n, 0.5)
        sector = int((lowest + n) % SECTORS)
        energy = maps.surface_energy[interface, sector]
        rough = maps.surface_asperities[interface, sector]
        work = maps.surface_work[interface, sector]
        maps.surface_passes[interface, sector] += even * abs(way[1] - way[0])
        for k in stations:
            old = before.power[k]
            new = after.power[k]
            energy[k, 1 if old > 0.0 else 0, before.regime] += share * spent[0] * abs(old)
            energy[k, 1 if new > 0.0 else 0, after.regime] += share * spent[1] * abs(new)
            rough[k] += share * (spent[2] * before.rough[k] + spent[3] * after.rough[k])
            work[k] += even * (spent[4] * before.work[k] + spent[5] * after.work[k])
