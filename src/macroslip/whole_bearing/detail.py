"""What is recorded of curved contacts beside energy: stations, places on the raceways, smearing criteria.

Booked whenever a roller's tractions have been evaluated: the energy since the time before is spread as power lies along
the roller then, over the way that it has travelled. For plain contacts everything here compiles to nothing.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numba.extending import overload

from macroslip.bearing.geometry import ROWS
from macroslip.compiled import jit_called, jit_merged
from macroslip.integrate.detail import EXTREMES, Passage, book_cage, book_raceway, look
from macroslip.integrate.surface import FILM_REGIMES, SECTORS, SLIP_SIGNS, STATIONS, Way
from macroslip.integrate.tuning import FINE_LOOKS
from macroslip.reference import tuple_type
from macroslip.roller.contact_force import is_curved
from macroslip.whole_bearing.space import CAGE_SLIDING, PUSH


class Details(NamedTuple):
    """Details of all rollers, as those of a `macroslip.integrate.record.RollerRecord`.

    Attributes
    ----------
    station_energy : ndarray, shape (n, 2, stations)
        Energy at the raceways by station along the roller [J].
    extreme : ndarray, shape (n, orbits, 3, 4)
        Largest flash temperature [K], power per area [W/m²] and slide-roll ratio, and least Λ, in each complete orbit.
    quadrature : ndarray, shape (n, 2, 2)
        Of states looked at: power by a finer quadrature times time, and what the one in use is off by [J].
    surface_energy : ndarray, shape (2, 2, sectors, stations, 2, 2)
        Energy at the places of the raceways of a row, by sign of slip and film regime [J].
    surface_density : ndarray, shape (2, 2, sectors, stations)
        Largest power per area there [W/m²].
    station_work : ndarray, shape (n, 2, stations + 3)
        Work space, see `macroslip.integrate.record.RollerRecord`.
    place : ndarray, shape (n, 3)
        Where the roller was when it was booked last: its angle and the shaft's [rad], neither wound back, and the time [s].
    looks : ndarray of int, shape (n,)
        How often it has been booked.
    wanted : bool
        Whether anything is booked at all.
    """

    station_energy: np.ndarray
    extreme: np.ndarray
    quadrature: np.ndarray
    surface_energy: np.ndarray
    surface_density: np.ndarray
    station_work: np.ndarray
    place: np.ndarray
    looks: np.ndarray
    wanted: bool


class _One(NamedTuple):
    """The details of one roller, as `macroslip.integrate.detail` books them."""

    station_energy: np.ndarray
    extreme: np.ndarray
    quadrature: np.ndarray
    surface_energy: np.ndarray
    surface_density: np.ndarray
    station_work: np.ndarray


class _Ring(NamedTuple):
    """Speed of a raceway's surface past the roller's centre [m/s]."""

    ring_speed: float


def new_details(count: int, orbits: int, *, wanted: bool) -> Details:
    """Empty details of `count` rollers, to be filled if they are wanted."""
    extreme = np.zeros((count, orbits, 3, len(EXTREMES)))
    extreme[..., EXTREMES.index("film_ratio")] = np.inf
    return Details(
        station_energy=np.zeros((count, 2, STATIONS)),
        extreme=extreme,
        quadrature=np.zeros((count, 2, 2)),
        surface_energy=np.zeros((len(ROWS), 2, SECTORS, STATIONS, len(SLIP_SIGNS), len(FILM_REGIMES))),
        surface_density=np.zeros((len(ROWS), 2, SECTORS, STATIONS)),
        station_work=np.zeros((count, 2, STATIONS + 3)),
        place=np.full((count, 3), np.nan),
        looks=np.zeros(count, dtype=np.int64),
        wanted=wanted,
    )


@jit_merged
def _way(details, stations, j, shaft_angle, time):
    """The way of roller `j` since it was booked last, with the actual speed of its orbit."""
    place, after = details.place[j], stations.angle[j]
    if math.isnan(place[0]):
        place[0], place[1] = after, shaft_angle
    before, shaft_before = place[0], place[1]
    turned = shaft_angle - shaft_before
    ratio = (after - before) / turned if turned != 0.0 else 0.0
    place[0], place[1], place[2] = after, shaft_angle, time
    return Way(before - ratio * shaft_before, ratio, shaft_before, shaft_angle)


@jit_called
def _book_contact(one, interface, contact, place, passage):
    """A raceway contact at its load, ring speed and slip; compiled once for all contacts of the bearing."""
    load, ring_speed, slip = place
    book_raceway(one, passage, interface, contact, load, _Ring(ring_speed), slip)
    if passage.fine:
        look(one, interface, contact, load, ring_speed, slip, passage.span)


@jit_merged
def _book_roller(model, one, moment, j, passage):
    stations, slips, force = moment.stations, moment.values.rollers[j], moment.force[j]
    inner = (stations.inner_load[j], stations.inner_speed[j], slips[0])
    outer = (stations.outer_load[j], stations.outer_speed[j], slips[1])
    _book_contact(one, 0, model.inner, inner, passage)
    _book_contact(one, 1, model.outer, outer, passage)
    book_cage(one, passage.orbit, model.cage, abs(force[PUSH]), -force[CAGE_SLIDING])


@jit_called
def _book(bearing, moment, due, shaft_angle, time, orbit, details):
    if not details.wanted:
        return
    for j in range(due.size):
        if not due[j]:
            continue
        row = bearing.rollers.row[j]
        one = _One(
            details.station_energy[j], details.extreme[j], details.quadrature[j], details.surface_energy[row],
            details.surface_density[row], details.station_work[j],
        )  # fmt: skip
        span = time - details.place[j, 2] if details.looks[j] else 0.0
        way = _way(details, moment.stations, j, shaft_angle, time)
        # No time has passed before the first booking; the second is the first that has details.
        passage = Passage(orbit, way, span, details.looks[j] % FINE_LOOKS == 1)
        details.looks[j] += 1
        # A row's model is named, not indexed: to pick it by a variable would copy all its contacts.
        if row == 0:
            _book_roller(bearing.models.downwind, one, moment, j, passage)
        else:
            _book_roller(bearing.models.upwind, one, moment, j, passage)


@jit_merged
def _collect(first, last, time, h, part, details):
    for j in range(details.station_work.shape[0]):
        since = time + 0.5 * h - details.place[j, 2] if details.looks[j] else 0.0
        for i in range(2):
            energy = h * ((1.0 - part) * first.powers[j, i, 0] + part * last.powers[j, i, 0])
            details.station_work[j, i, STATIONS] += energy
            details.station_work[j, i, STATIONS + 2] += energy * since


def collect(bearing, first, last, time, h, part, details):
    """Add the raceways' energies of a step of `h` from `time` on [s], whose last stage has the weight `part`, to those kept."""


def book_details(bearing, moment, due, shaft_angle, time, orbit, details):
    """Spread the energies of the rollers that are due, and raise the extremes of orbit `orbit`, unless it is −1.

    Parameters
    ----------
    bearing : WholeBearing
    moment : Moment
        A solved stage with its powers.
    due : ndarray of bool, shape (n,)
    shaft_angle, time : float
        [rad] and [s].
    orbit : int
    details : Details
    """


@overload(collect)
def _collect_of(bearing, first, last, time, h, part, details):
    if has_details(bearing):
        return lambda bearing, first, last, time, h, part, details: _collect(first, last, time, h, part, details)
    return lambda bearing, first, last, time, h, part, details: None


@overload(book_details)
def _book_details_of(bearing, moment, due, shaft_angle, time, orbit, details):
    if has_details(bearing):
        return lambda bearing, moment, due, shaft_angle, time, orbit, details: _book(
            bearing, moment, due, shaft_angle, time, orbit, details
        )
    return lambda bearing, moment, due, shaft_angle, time, orbit, details: None


def has_details(bearing) -> bool:
    """Whether the contacts of a bearing, given by its numba type, are curved."""
    known = tuple_type(bearing)
    models = dict(zip(known.fields, known.types, strict=True))["models"]
    return is_curved(models.types[0].types[-1])
