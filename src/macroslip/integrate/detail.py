"""What curved contacts leave behind beside energy: mechanisms, stations, smearing criteria and the quadrature's error.

For plain contacts every function here compiles to nothing.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from numba.extending import overload

from macroslip.compiled import jit_part
from macroslip.contact.flash_temperature import flash_temperature
from macroslip.film.asperity_load import asperity_share
from macroslip.film.film_law import film_thickness
from macroslip.integrate.surface import STATIONS, raise_density, sectors_of, spread
from macroslip.reference import tuple_type
from macroslip.roller.contact import cage_contact
from macroslip.roller.contact_force import LOWEST_ENTRAINMENT_SPEED, is_curved, slip_field
from macroslip.traction.slip_field import slip_at
from macroslip.traction.traction_law import chord_traction, patch_traction_microslip

#: Meaning of `RollerRecord.mechanism_energy` by position.
MECHANISMS = ("sliding", "curvature", "contact angle")
#: Meaning of `RollerRecord.extreme` by position.
EXTREMES = ("flash_temperature", "power_density", "slide_roll_ratio", "film_ratio")


class Passage(NamedTuple):
    """What a roller has passed since its contacts were looked at last.

    Attributes
    ----------
    orbit : int
        Orbit it is in, or −1.
    way : Way
        What it has passed.
    span : float
        Time since then [s].
    fine : bool
        Whether to look at the quadrature's error too.
    """

    orbit: int
    way: Any
    span: float
    fine: bool


@jit_part
def _book_mechanisms(energies, rule, slip, ring_speed, force, detail, span):
    energies[0] += span * slip * force
    if rule.microslip:
        energies[1] += span * ring_speed * rule.curvature * detail.lag
        energies[2] -= span * ring_speed * rule.spin * detail.skew


@jit_part
def book_mechanisms(record, rules, at, forces, slip, span):
    """Book energies by mechanism, and that of asperities, for a state of curved contacts that counts for `span` [s].

    `rules` are the `PowerRule` of inner and outer raceway.
    """
    energy, rough = record.mechanism_energy, record.asperity_energy
    ring = at.ring_speed
    _book_mechanisms(energy[0], rules[0], slip, ring, forces.inner, forces.inner_detail, span)
    _book_mechanisms(energy[1], rules[1], slip, ring, forces.outer, forces.outer_detail, span)
    energy[2, 0] += span * (slip - ring) * forces.cage
    rough[0] += span * forces.inner_detail.asperity_power
    rough[1] += span * forces.outer_detail.asperity_power
    rough[2] += span * forces.cage_detail.asperity_power


@jit_part
def _raise(record, orbit, interface, flash, density, ratio, film_ratio):
    if orbit < 0:
        return
    extreme = record.extreme[orbit, interface]
    extreme[0] = max(extreme[0], flash)
    extreme[1] = max(extreme[1], density)
    extreme[2] = max(extreme[2], ratio)
    extreme[3] = min(extreme[3], film_ratio)


@jit_part
def collect(record, interface, energy, since):
    """Keep energy [J] of a raceway, spent so long after the last look [s], until its contact is looked at."""
    record.station_work[interface, STATIONS] += energy
    record.station_work[interface, STATIONS + 2] += energy * since


@jit_part
def _mean_time(powers, span):
    """Mean time of the energy that was kept, over the time since the last look; that is forgotten then."""
    kept, moment = powers[STATIONS] * span, powers[STATIONS + 2]
    powers[STATIONS + 2] = 0.0
    return min(max(moment / kept, 0.0), 1.0) if kept > 0.0 else 0.5


@jit_part
def _spread(record, interface, passed, part, mean_time):
    """Spread a part of what was kept over the stations, and over the places of the raceway that were passed.

    Along the roller it is in proportion to the powers of `station_work`; along the way it is linear, with the
    `mean_time` that it has. Without any power yet it is kept further.
    """
    powers = record.station_work[interface]
    energy, total = part * powers[STATIONS], 0.0
    for k in range(STATIONS):
        total += abs(powers[k])
    if total <= 0.0:
        return
    per_power = energy / total
    for k in range(STATIONS):
        record.station_energy[interface, k] += per_power * abs(powers[k])
    growth = min(max(3.0 * (2.0 * mean_time - 1.0), -1.0), 1.0)
    spread(record.surface_energy, interface, passed, powers, per_power, growth)
    powers[STATIONS] -= energy


@jit_part
def book_raceway(record, passage, interface, contact, load, at, slip):
    """Spread the energy kept so far as power lies along the roller, and raise the extremes.

    How power lies along the roller is taken as linear in time from the last look to this one. Without load all energy is
    spread as power lay when there last was some; before that it is kept.
    """
    ring_speed, passed = at.ring_speed, sectors_of(passage.way, interface)
    powers = record.station_work[interface]
    mean_time = _mean_time(powers, passage.span)
    if load <= 0.0:
        _spread(record, interface, passed, 1.0, mean_time)
        return
    _spread(record, interface, passed, 1.0 - mean_time, mean_time)
    entrainment = max(abs(ring_speed - 0.5 * slip), LOWEST_ENTRAINMENT_SPEED)
    film, _, _ = film_thickness(contact.film, load, entrainment)
    share = asperity_share(contact.asperity_load, load, entrainment, film)
    field = slip_field(contact.shape, slip, ring_speed)
    root_load = load ** (1.0 / 3.0)
    across, along = contact.semi_axis_across * root_load, contact.semi_axis_along * root_load
    width = 2.0 * contact.shape.half_length / STATIONS
    boundary = 0.75 * contact.asperity_friction.coefficient * share * load / across
    # Flash temperature goes with P'/√b: where its square is the largest, it is taken once.
    hottest, flash_power, flash_width, density, fastest = 0.0, 0.0, along, 0.0, 0.0
    for k in range(STATIONS):
        left = k * width - contact.shape.half_length
        # What the ellipse covers of the station, so that the lightest contact too lies in the two middle ones.
        first, last = max(left, -across), min(left + width, across)
        if last - first < 1e-6 * width:
            powers[k] = 0.0
            continue
        station, covered = 0.5 * (first + last), (last - first) / width
        height = 1.0 - station * station / (across * across)
        local = slip_at(field, contact.shape.contour_radius, station)
        speed = abs(local)
        chord = math.sqrt(height)
        pull = (1.0 - share) * chord_traction(contact.traction, load, film, across, chord, speed)
        pull += boundary * height * min(speed / contact.asperity_friction.full_slip, 1.0)
        powers[k] = math.copysign(pull * speed * covered, local)
        half_width = along * chord
        per_length = pull * speed
        mean = per_length / (2.0 * half_width)
        if per_length * mean > hottest:
            hottest, flash_power, flash_width = per_length * mean, per_length, half_width
        density = max(density, mean)
        raise_density(record.surface_density, interface, passed, k, mean)
        fastest = max(fastest, speed)
    flash = flash_temperature(
        flash_power, flash_width, ring_speed - slip, ring_speed, contact.effusivity_1, contact.effusivity_2
    )
    powers[STATIONS + 1] = 1.0 if film >= contact.roughness else 0.0
    _spread(record, interface, passed, 1.0, mean_time)
    _raise(record, passage.orbit, interface, flash, density, fastest / entrainment, film / contact.roughness)


@jit_part
def book_cage(record, orbit, contact, load, surface):
    """Raise the extremes of the cage's contact, whose roller's surface moves at `surface` [m/s].

    Its power is computed anew. The force in the spin equation includes the oil of the pocket, and what the last correction of
    slip left, and the force of a light contact is far smaller than either.
    """
    if load <= 0.0:
        return
    entrainment = max(0.5 * abs(surface), LOWEST_ENTRAINMENT_SPEED)
    film, _, _ = film_thickness(contact.film, load, entrainment)
    root_load = load ** (1.0 / 3.0)
    across, along = contact.semi_axis_across * root_load, contact.semi_axis_along * root_load
    per_length = 0.75 * cage_contact(contact, load, -surface).power / across
    flash = flash_temperature(per_length, along, surface, 0.0, contact.effusivity_1, contact.effusivity_2)
    _raise(record, orbit, 2, flash, per_length / (2.0 * along), abs(surface) / entrainment, film / contact.roughness)


@jit_part
def look(record, interface, contact, load, ring_speed, slip, span):
    """Film power by the rule in use and by a much finer one."""
    if load <= 0.0 or not contact.shape.microslip:
        return
    entrainment = max(abs(ring_speed - 0.5 * slip), LOWEST_ENTRAINMENT_SPEED)
    film, _, _ = film_thickness(contact.film, load, entrainment)
    field = slip_field(contact.shape, slip, ring_speed)
    shape = contact.shape
    used = patch_traction_microslip(contact.traction, load, film, field, shape, False)
    fine = patch_traction_microslip(contact.traction, load, film, field, shape, True)
    curvature = ring_speed * shape.curvature_ratio * shape.roller_radius
    spin = ring_speed * shape.spin_ratio
    found = slip * (used.force - used.lag) + curvature * used.lag - spin * used.skew
    better = slip * (fine.force - fine.lag) + curvature * fine.lag - spin * fine.skew
    record.quadrature[interface, 0] += span * better
    record.quadrature[interface, 1] += span * abs(found - better)


@jit_part
def _book_passage(record, model, at, forces, slip, passage):
    book_raceway(record, passage, 0, model.inner, at.inner_load, at, slip)
    book_raceway(record, passage, 1, model.outer, at.outer_load, at, slip)
    book_cage(record, passage.orbit, model.cage, abs(forces.cage_load), at.ring_speed - slip)
    if passage.fine:
        look(record, 0, model.inner, at.inner_load, at.ring_speed, slip, passage.span)
        look(record, 1, model.outer, at.outer_load, at.ring_speed, slip, passage.span)


def book_passage(record, model, at, forces, slip, passage):
    """Book stations, places, extremes and, if the passage requests it, the quadrature's error at the state that ends it."""


def _is_curved(model) -> bool:
    # A model's contacts are its last three fields.
    return is_curved(tuple_type(model).types[-1])


@overload(book_passage)
def _book_passage_of(record, model, at, forces, slip, passage):
    if _is_curved(model):
        return lambda record, model, at, forces, slip, passage: _book_passage(record, model, at, forces, slip, passage)
    return lambda record, model, at, forces, slip, passage: None
