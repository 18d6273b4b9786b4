"""A roller as the integrators use it: the numbers of its geometry, and the addresses of its laws.

The integrators are compiled once, for all laws; what a law does is compiled once, for all integrators. Each function here
does for a `SealedModel` in a kernel what its namesake does for a `RollerModel`, which plain Python may give it too.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba.extending import overload

from macroslip.integrate.detail import book_mechanisms, book_passage
from macroslip.integrate.entry_types import (
    AT_PLACE,
    AT_SLIP,
    AT_STAGES,
    FORCES,
    HELD_TYPE,
    LOADS,
    PASSED_TYPE,
    RECORD_TYPE,
    STAGE_FORCES,
    STATION,
    TRACED_TYPE,
    VALUE,
    AtPlace,
    AtSlip,
    Held,
    Loads,
    Passed,
    StageForces,
    Traced,
    WithForces,
)
from macroslip.integrate.held_contact import relaxation_rate, rising_at, slips_everywhere
from macroslip.integrate.measures import note_state, powers, write_trace
from macroslip.reference import calling
from macroslip.roller.contact_force import CurvedContact
from macroslip.roller.forces import slip_forces, station
from macroslip.roller.friction_power import PowerRule, power_rule, raceway_power


class Entries(NamedTuple):
    """Addresses of a roller's laws, compiled for its contacts; 0 for `stages` where they come one by one."""

    station: int
    forces: int
    stages: int
    rising: int
    relaxation: int
    note: int
    passage: int
    trace: int


class SealedModel(NamedTuple):
    """A `RollerModel` whose contacts and films are hidden from the integrators.

    Attributes
    ----------
    radius, mobility, stiffness, cos_contact_angle, sin_contact_angle, radial_play, orbit_ratio, outer_radius : float
        As in `RollerModel`.
    microslip : bool
        Whether most places of a gripped contact slip.
    curved : bool
        Whether contacts have mechanisms to book.
    detailed : bool
        Whether to book their places and extremes too.
    lanes : bool
        Whether forces at the stages of a step are computed at the same time.
    inner_power, outer_power : PowerRule
        Of the raceways.
    data : ndarray of uint8
        The roller with its laws.
    entries : Entries
    """

    radius: float
    mobility: float
    stiffness: float
    cos_contact_angle: float
    sin_contact_angle: float
    radial_play: float
    orbit_ratio: float
    outer_radius: float
    microslip: bool
    curved: bool
    detailed: bool
    lanes: bool
    inner_power: PowerRule
    outer_power: PowerRule
    data: np.ndarray
    entries: Entries


_call_station = calling(AT_PLACE, STATION)
_call_forces = calling(AT_SLIP, FORCES)
_call_stages = calling(AT_STAGES, STAGE_FORCES)
_call_value = calling(LOADS, VALUE)
_call_held = calling(HELD_TYPE, RECORD_TYPE)
_call_passed = calling(PASSED_TYPE, RECORD_TYPE)
_call_traced = calling(TRACED_TYPE, RECORD_TYPE)


def has_microslip(model):
    """Whether most places of a gripped roller's contacts slip."""
    return slips_everywhere(model.inner)


@overload(has_microslip)
def _has_microslip(model):
    return lambda model: model.microslip


def station_of(model, start_angle, now):
    """`macroslip.roller.forces.station`."""
    return station(model, start_angle, now)


@overload(station_of)
def _station_of(model, start_angle, now):
    def implementation(model, start_angle, now):
        return _call_station(model.entries.station, model.data.ctypes.data, AtPlace(start_angle, now))

    return implementation


def forces_of(model, at, slip):
    """`macroslip.roller.forces.slip_forces`, with details whatever the contacts are."""
    return slip_forces(model, at, slip)


@overload(forces_of)
def _forces_of(model, at, slip):
    def implementation(model, at, slip):
        return _call_forces(model.entries.forces, model.data.ctypes.data, AtSlip(at, slip))

    return implementation


def stage_forces_of(model, given):
    """Forces at three stations, at the same time where the laws allow that."""
    return StageForces(*(slip_forces(model, *one) for one in zip(given[:3], given[3:], strict=True)))


@overload(stage_forces_of)
def _stage_forces_of(model, given):
    def implementation(model, given):
        if model.lanes:
            return _call_stages(model.entries.stages, model.data.ctypes.data, given)
        return StageForces(
            forces_of(model, given.at1, given.v1),
            forces_of(model, given.at2, given.v2),
            forces_of(model, given.at3, given.v3),
        )

    return implementation


def powers_of(model, at, forces, slip):
    """`macroslip.integrate.measures.powers`."""
    return powers(model, at, forces, slip)


@overload(powers_of)
def _powers_of(model, at, forces, slip):
    def implementation(model, at, forces, slip):
        ring = at.ring_speed
        inner = raceway_power(model.inner_power, slip, ring, forces.inner, forces.inner_detail)
        outer = raceway_power(model.outer_power, slip, ring, forces.outer, forces.outer_detail)
        return inner, outer, abs(forces.cage * (ring - slip))

    return implementation


def rising_of(model, inner_load, outer_load, ring_speed, entrainment_speed):
    """`macroslip.integrate.held_contact.rising_at`."""
    return rising_at(model, inner_load, outer_load, ring_speed, entrainment_speed)


@overload(rising_of)
def _rising_of(model, inner_load, outer_load, ring_speed, entrainment_speed):
    def implementation(model, inner_load, outer_load, ring_speed, entrainment_speed):
        given = Loads(inner_load, outer_load, ring_speed, entrainment_speed)
        return _call_value(model.entries.rising, model.data.ctypes.data, given).value

    return implementation


def relaxation_of(model, load, ring_speed):
    """`macroslip.integrate.held_contact.relaxation_rate`."""
    return relaxation_rate(model, load, ring_speed)


@overload(relaxation_of)
def _relaxation_of(model, load, ring_speed):
    def implementation(model, load, ring_speed):
        given = Loads(load, load, ring_speed, ring_speed)
        return _call_value(model.entries.relaxation, model.data.ctypes.data, given).value

    return implementation


def note_state_of(record, model, at, forces, slip, span):
    """`macroslip.integrate.measures.note_state`."""
    note_state(record, model, at, forces, slip, span)


@overload(note_state_of)
def _note_state_of(record, model, at, forces, slip, span):
    def implementation(record, model, at, forces, slip, span):
        _call_held(model.entries.note, model.data.ctypes.data, Held(WithForces(at, forces, slip), span), record)

    return implementation


def book_mechanisms_of(record, model, at, forces, slip, span):
    """`macroslip.integrate.detail.book_mechanisms`, for curved contacts."""
    if isinstance(model.inner, CurvedContact):
        book_mechanisms(record, (power_rule(model.inner), power_rule(model.outer)), at, forces, slip, span)


@overload(book_mechanisms_of)
def _book_mechanisms_of(record, model, at, forces, slip, span):
    def implementation(record, model, at, forces, slip, span):
        if model.curved:
            book_mechanisms(record, (model.inner_power, model.outer_power), at, forces, slip, span)

    return implementation


def book_passage_of(record, model, at, forces, slip, passage):
    """`macroslip.integrate.detail.book_passage`."""
    book_passage(record, model, at, forces, slip, passage)


@overload(book_passage_of)
def _book_passage_of(record, model, at, forces, slip, passage):
    def implementation(record, model, at, forces, slip, passage):
        if model.detailed:
            given = Passed(WithForces(at, forces, slip), passage)
            _call_passed(model.entries.passage, model.data.ctypes.data, given, record)

    return implementation


def write_trace_of(record, model, index, at, forces, slip):
    """`macroslip.integrate.measures.write_trace`."""
    write_trace(record, model, index, at, forces, slip)


@overload(write_trace_of)
def _write_trace_of(record, model, index, at, forces, slip):
    def implementation(record, model, index, at, forces, slip):
        given = Traced(WithForces(at, forces, slip), index)
        _call_traced(model.entries.trace, model.data.ctypes.data, given, record)

    return implementation
