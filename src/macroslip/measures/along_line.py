"""Distribution of frictional power along a roller that touches a raceway along a line, by station.

A station is a strip of the line contact: load, film, asperities and slip are its own. Stations of a
tapered roller count from its small to its large end.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.compiled import jit_once
from macroslip.contact.chords import film_node, write_film
from macroslip.contact.strips import strip_approach
from macroslip.measures.along import FILM_EDGES, STATIONS, class_of
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
def write_line(contact, strips, state, sample, interface, slices, start):
    """Write the slices of a line contact at the stations that touch.

    Parameters
    ----------
    contact : macroslip.measures.along.Contact
    strips : ndarray of `STRIP`, shape (STATIONS,)
    state : tuple of float
        Load [N], > 0, u2 and Δu [m/s].
    sample : record of `macroslip.measures.samples.SAMPLE`
        Which stations touch is written.
    interface : int
        0 for the inner raceway, 1 for the outer one.
    slices : record of `macroslip.contact.chords.SLICES`
    start : int
        Number of the first slice.
    """
    per_entrainment = 1.0 / signed_entrainment(state[1], state[2])
    first = 0
    while first < STATIONS and strips[first].covered < _LEAST_COVERED:
        first += 1
    count = 0
    while first + count < STATIONS and strips[first + count].covered >= _LEAST_COVERED:
        strip = strips[first + count]
        k = start + count
        slices.covered[k] = strip.covered
        slices.pressure[k] = strip.pressure
        slices.load[k] = strip.load
        slices.half_width[k] = strip.half_width
        slices.share[k] = strip.share
        slices.slip[k] = strip.slip
        slices.speed[k] = abs(strip.slip)
        slices.ratio[k] = strip.slip * per_entrainment
        slices.film_class[k] = class_of(FILM_EDGES, strip.film / contact.roughness)
        write_film(film_node(contact.chords, strip.film), slices, k, k + 1)
        count += 1
    sample.touched[interface, 0] = first
    sample.touched[interface, 1] = count
