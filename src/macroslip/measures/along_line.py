"""Distribution of frictional power along a roller that touches a raceway along a line, by station.

A station is a strip of the line contact: load, film, asperities and slip are its own. Stations of a
tapered roller count from its small to its large end.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.compiled import jit
from macroslip.contact.chords import chord_stress_at, film_node
from macroslip.contact.strips import strip_approach
from macroslip.measures.along import (
    FILM_EDGES,
    LEAST_SHARE,
    STATIONS,
    Station,
    begin_along,
    book_station,
    class_of,
    leave_station,
    passed_since,
)
from macroslip.mechanics.speeds import signed_entrainment

if TYPE_CHECKING:
    from macroslip.contact.strips import PreparedStrips

#: State of a strip of a line contact.
STRIP = np.dtype(
    [
        # Part of the station that touches [-].
        ("covered", "f8"),
        # Load per length [N/m].
        ("load", "f8"),
        # Film thickness [m].
        ("film", "f8"),
        # Asperities' share of the load [-].
        ("share", "f8"),
        # Slip with its sign [m/s].
        ("slip", "f8"),
        # Half-width of the contact along rolling [m].
        ("half_width", "f8"),
        # Largest pressure [Pa].
        ("pressure", "f8"),
    ]
)


def strips_along(
    law: PreparedStrips, load: np.ndarray, ring_speed: np.ndarray, slip: np.ndarray
) -> np.ndarray:
    """Load, film and asperity share of the strips of a line contact, by station.

    Parameters
    ----------
    law : PreparedStrips
        Laws of the raceway.
    load, ring_speed, slip : ndarray, shape (n,)
        Load [N], > 0, u2 and Δu [m/s].

    Returns
    -------
    ndarray of `STRIP`, shape (n, STATIONS)
        Load, film and slip are those in the middle of the part that touches.
    """
    strips = law.strips
    approach = strip_approach(strips, load)[:, None]
    reach = strips.reach(approach)
    edges = (np.arange(STATIONS + 1) / STATIONS - 0.5) * strips.length
    first = np.maximum(edges[:-1], -reach)
    last = np.minimum(edges[1:], reach)
    touching = last > first
    middle = np.where(touching, 0.5 * (first + last), 0.0)
    state = law.strip_states(middle, approach, ring_speed[:, None], slip[:, None])
    along = np.zeros(middle.shape, STRIP)
    along["covered"] = np.where(touching, (last - first) * STATIONS / strips.length, 0.0)
    along["load"] = state.per_length
    along["film"] = state.film
    along["share"] = state.share
    along["slip"] = state.slip
    along["half_width"] = state.half_width
    along["pressure"] = state.pressure
    return along


@jit
def line_power_along(maps, interface, contact, state, sample, passes, strips, along):
    """Write the distribution of power along a roller at a line contact.

    Parameters
    ----------
    maps : record of `macroslip.measures.maps.MAPS`
        Times under load by film and slip are added.
    interface : int
        0 for the inner raceway, 1 for the outer one.
    contact : macroslip.measures.along.Contact
    state : tuple of float
        Load [N], u2 and Δu [m/s].
    sample : record of `macroslip.measures.samples.SAMPLE`
        What is hottest is written.
    passes : float
        Passes of the roller since the sample before [-].
    strips : ndarray of `STRIP`, shape (STATIONS,)
    along : record of `macroslip.measures.along.ALONG`
        Is written.

    Returns
    -------
    densest : float
        Largest power per area [W/m²].
    fastest : float
        Largest slip [m/s].
    entrainment : float
        Entrainment speed, > 0 [m/s].
    """
    patch = contact.patch
    entrainment = signed_entrainment(state[1], state[2])
    passed = passed_since(sample, passes, entrainment)
    width = 2.0 * patch.half_length / STATIONS
    densest = 0.0
    fastest = 0.0
    begin_along(along)
    for k in range(STATIONS):
        strip = strips[k]
        if strip.covered < 1e-6:
            leave_station(along, k)
            continue
        speed = abs(strip.slip)
        carried = patch.boundary_friction * max(strip.share, LEAST_SHARE) * strip.load
        asperities = carried * min(speed / patch.full_slip, 1.0) * speed
        node = film_node(contact.chords, strip.film)
        stress = chord_stress_at(contact.chords, node, strip.pressure, speed)
        sheared = (1.0 - strip.share) * 2.0 * strip.half_width * stress * speed
        booked = Station(
            k,
            strip.covered,
            width,
            strip.load,
            strip.half_width,
            strip.slip,
            speed,
            sheared + asperities,
            asperities,
        )
        times = maps.film_slip[interface, class_of(FILM_EDGES, strip.film / contact.roughness)]
        density = book_station(along, booked, sample.hot[interface], times, passed)
        densest = max(densest, density)
        fastest = max(fastest, speed)
    along.regime = 1 if sample.film[interface] >= contact.roughness else 0
    return densest, fastest, abs(entrainment)
