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
from macroslip.integrate.radau_step import WEIGHTS
from macroslip.integrate.surface import STATIONS, raise_density, spread
from macroslip.integrate.tuning import LOOK_EVERY
from macroslip.reference import tuple_type
from macroslip.roller.contact_force import LOWEST_ENTRAINMENT_SPEED, is_curved, slip_field
from macroslip.roller.films import cage_film
from macroslip.traction.slip_field import slip_at
from macroslip.traction.traction_law import chord_traction, patch_traction_microslip

#: Meaning of `RollerRecord.mechanism_energy` by position.
MECHANISMS = ("sliding", "curvature", "contact angle")
#: Meaning of `RollerRecord.extreme` by position.
EXTREMES = ("flash_temperature", "power_density", "slide_roll_ratio", "film_ratio")


class Passage(NamedTuple):
    """What a step leaves on the raceways.

    Attributes
    ----------
    orbit : int
        Orbit the step belongs to, or −1.
    energies : tuple of tuple of float
        Energy of the step's three stages at the inner and at the outer raceway [J].
    way : Way
        What the roller passes in the step.
    """

    orbit: int
    energies: Any
    way: Any


@jit_part
def _mechanism_energies(contact, ring_speed, slip, spin_force, detail, span):
    """Energy in `span` [s] by sliding of the middle, curvature and contact angle [J]."""
    if not contact.shape.microslip:
        return span * slip * spin_force, 0.0, 0.0
    curvature = contact.shape.curvature_ratio * contact.shape.roller_radius
    return (
        span * slip * spin_force,
        span * ring_speed * curvature * detail.lag,
        -span * ring_speed * contact.shape.spin_ratio * detail.skew,
    )


@jit_part
def _add(energies, parts):
    energies[0] += parts[0]
    energies[1] += parts[1]
    energies[2] += parts[2]


@jit_part
def _book_stage(record, model, at, forces, slip, span):
    # Passing a record costs more than this work: a count for every array in it.
    energy, rough = record.mechanism_energy, record.asperity_energy
    ring = at.ring_speed
    _add(energy[0], _mechanism_energies(model.inner, ring, slip, forces.inner, forces.inner_detail, span))
    _add(energy[1], _mechanism_energies(model.outer, ring, slip, forces.outer, forces.outer_detail, span))
    _add(energy[2], _mechanism_energies(model.cage, 0.0, slip - ring, forces.cage, forces.cage_detail, span))
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
def _spread(record, interface, energies, way):
    """Spread the step's energies over the stations, and over the places of the raceway that they pass.

    Along the roller in proportion to the powers of `station_work`; along the way every stage has the part of it that its
    weight is. Without any power yet the energy is kept for later, in the place after the powers.
    """
    powers = record.station_work[interface]
    total = 0.0
    for k in range(STATIONS):
        total += abs(powers[k])
    if total <= 0.0:
        powers[STATIONS] += energies[0] + energies[1] + energies[2]
        return
    energy = powers[STATIONS] + energies[0] + energies[1] + energies[2]
    for k in range(STATIONS):
        record.station_energy[interface, k] += energy * abs(powers[k]) / total
    surface = record.surface_energy
    spread(surface, interface, way, 0.0, 1.0, powers, powers[STATIONS])
    spread(surface, interface, way, 0.0, WEIGHTS[0], powers, energies[0])
    spread(surface, interface, way, WEIGHTS[0], WEIGHTS[0] + WEIGHTS[1], powers, energies[1])
    spread(surface, interface, way, WEIGHTS[0] + WEIGHTS[1], 1.0, powers, energies[2])
    powers[STATIONS] = 0.0


@jit_part
def book_raceway(record, passage, interface, contact, load, at, slip):
    """Spread the step's energies as the power at its end lies along the roller, and raise the extremes.

    A step that ends without load spreads them as the last one with load; before that they are kept for the first one.
    """
    ring_speed, energies, way = at.ring_speed, passage.energies[interface], passage.way
    powers = record.station_work[interface]
    if load <= 0.0:
        _spread(record, interface, energies, way)
        return
    entrainment = max(abs(ring_speed - 0.5 * slip), LOWEST_ENTRAINMENT_SPEED)
    film, _, _ = film_thickness(contact.film, load, entrainment)
    share = asperity_share(contact.asperity_load, load, entrainment, film)
    field = slip_field(contact.shape, slip, ring_speed)
    root_load = load ** (1.0 / 3.0)
    across, along = contact.semi_axis_across * root_load, contact.semi_axis_along * root_load
    width = 2.0 * contact.shape.half_length / STATIONS
    boundary = 0.75 * contact.asperity_friction.coefficient * share * load / across
    flash, density, fastest = 0.0, 0.0, 0.0
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
        roller, ring = ring_speed - slip, ring_speed
        flash = max(
            flash, flash_temperature(pull * speed, half_width, roller, ring, contact.effusivity_1, contact.effusivity_2)
        )
        mean = pull * speed / (2.0 * half_width)
        density = max(density, mean)
        raise_density(record.surface_density, interface, way, k, mean)
        fastest = max(fastest, speed)
    powers[STATIONS + 1] = 1.0 if film >= contact.roughness else 0.0
    _spread(record, interface, energies, way)
    _raise(record, passage.orbit, interface, flash, density, fastest / entrainment, film / contact.roughness)


@jit_part
def book_cage(record, orbit, contact, load, surface, power):
    """Raise the extremes of the cage's contact, whose roller's surface moves at `surface` [m/s], by its power [W]."""
    if load <= 0.0:
        return
    entrainment = max(0.5 * abs(surface), LOWEST_ENTRAINMENT_SPEED)
    film, _, _ = film_thickness(contact.film, load, entrainment)
    root_load = load ** (1.0 / 3.0)
    across, along = contact.semi_axis_across * root_load, contact.semi_axis_along * root_load
    per_length = 0.75 * abs(power) / across
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
def _book_step(record, model, at, forces, slip, span, passage):
    book_raceway(record, passage, 0, model.inner, at.inner_load, at, slip)
    book_raceway(record, passage, 1, model.outer, at.outer_load, at, slip)
    load = abs(forces.cage_load)
    if load > 0.0:
        surface = at.ring_speed - slip
        # The oil that fills the pocket is sheared over all of it, and leaves no heat in Hertz' ellipse of a light contact.
        pull = forces.cage - cage_film(model.films, load, surface).sliding
        book_cage(record, passage.orbit, model.cage, load, surface, pull * surface)
    if record.count[0] % LOOK_EVERY == 0:
        look(record, 0, model.inner, at.inner_load, at.ring_speed, slip, span)
        look(record, 1, model.outer, at.outer_load, at.ring_speed, slip, span)


@jit_part
def in_stages(energy):
    """The energy of a step with constant power, in the parts of three stages [J]."""
    return energy * WEIGHTS[0], energy * WEIGHTS[1], energy * WEIGHTS[2]


def book_stage(record, model, at, forces, slip, span):
    """Book energies by mechanism for a state that counts for `span` [s]."""


def book_step(record, model, at, forces, slip, span, passage):
    """Book stations, places, extremes and now and then the quadrature's error, for a step that ends in this state."""


def _is_curved(model) -> bool:
    # A model's contacts are its last three fields.
    return is_curved(tuple_type(model).types[-1])


@overload(book_stage)
def _book_stage_of(record, model, at, forces, slip, span):
    if _is_curved(model):
        return lambda record, model, at, forces, slip, span: _book_stage(record, model, at, forces, slip, span)
    return lambda record, model, at, forces, slip, span: None


@overload(book_step)
def _book_step_of(record, model, at, forces, slip, span, passage):
    if _is_curved(model):
        return lambda record, model, at, forces, slip, span, passage: _book_step(
            record, model, at, forces, slip, span, passage
        )
    return lambda record, model, at, forces, slip, span, passage: None
