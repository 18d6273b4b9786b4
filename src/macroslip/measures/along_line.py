"""Distribution of frictional power along a roller that touches a raceway along a line, by station.

A station is a strip of the line contact: load, film, asperities and slip are its own. Stations of a
tapered roller count from its small to its large end.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.compiled import jit, jit_once
from macroslip.contact.chords import chord_stress_at, film_node
from macroslip.contact.strips import strip_approach
from macroslip.measures.along import (
    FILM_EDGES,
    LEAST_SHARE,
    STATIONS,
    book_slices,
    book_times,
    class_of,
    passed_since,
)
from macroslip.mechanics.speeds import signed_entrainment

if TYPE_CHECKING:
    from macroslip.contact.strips import PreparedStrips

#: Part of a station from which on it counts as touching; those that touch lie side by side.
_LEAST_COVERED = 1e-6
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


@jit_once
def _write_slice(contact, strip, slices, k):
    """Write the slice of a strip: state, and power per length by its own film and asperities."""
    patch = contact.patch
    speed = abs(strip.slip)
    carried = patch.boundary_friction * max(strip.share, LEAST_SHARE) * strip.load
    asperities = carried * min(speed / patch.full_slip, 1.0) * speed
    node = film_node(contact.chords, strip.film)
    stress = chord_stress_at(contact.chords, node, strip.pressure, speed)
    sheared = (1.0 - strip.share) * 2.0 * strip.half_width * stress * speed
    slices.covered[k] = strip.covered
    slices.load[k] = strip.load
    slices.half_width[k] = strip.half_width
    slices.slip[k] = strip.slip
    slices.speed[k] = speed
    slices.power[k] = sheared + asperities
    slices.asperities[k] = asperities


@jit
def line_power_along(maps, interface, contact, state, sample, passes, strips, along):
    """Write the distribution of power along a roller at a line contact.

    Parameters
    ----------
    maps : record of `macroslip.measures.maps.MAPS`
        Times under load by film and slip are added, and slices are written.
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
    slices = maps.slices
    entrainment = signed_entrainment(state[1], state[2])
    passed = passed_since(sample, passes, entrainment)
    first = 0
    while first < STATIONS and strips[first].covered < _LEAST_COVERED:
        first += 1
    count = 0
    while first + count < STATIONS and strips[first + count].covered >= _LEAST_COVERED:
        _write_slice(contact, strips[first + count], slices, count)
        count += 1
    width = 2.0 * patch.half_length / STATIONS
    hot = sample.hot[interface]
    densest, fastest = book_slices(along, slices, first, count, width, hot)
    if passed[0] > 0.0:
        for k in range(count):
            film_ratio = strips[first + k].film / contact.roughness
            times = maps.film_slip[interface, class_of(FILM_EDGES, film_ratio)]
            book_times(times, slices, k, passed)
    along.regime = 1 if sample.film[interface] >= contact.roughness else 0
    return densest, fastest, abs(entrainment)
