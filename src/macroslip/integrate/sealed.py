"""A roller as the integrators see it: the numbers of its geometry, and its laws by their addresses.

The integrators are compiled once, for all laws; what a law does is compiled once, for all integrators. Each function here
does for a `SealedModel` in a kernel what its namesake does for a `RollerModel`, which plain Python may give it too.
"""

from __future__ import annotations

import threading
import weakref
from typing import Any, NamedTuple

import numba
import numpy as np
from numba.extending import overload

from macroslip.compiled import entry, jit, jit_part
from macroslip.integrate.detail import Passage, book_stage, book_step
from macroslip.integrate.held_contact import relaxation_rate, rising_at, slips_everywhere
from macroslip.integrate.measures import note_state, powers, write_trace
from macroslip.integrate.record import new_record
from macroslip.integrate.surface import Way
from macroslip.reference import Reference, calling, packed, write
from macroslip.ring.orbit import Instant
from macroslip.roller.contact_force import CurvedContact, Detail
from macroslip.roller.forces import SlipForces, Station, slip_forces, station
from macroslip.roller.model import RollerModel


class Entries(NamedTuple):
    """Addresses of a roller's laws, compiled for its contacts."""

    station: int
    forces: int
    powers: int
    rising: int
    relaxation: int
    note: int
    stage: int
    step: int
    trace: int


class SealedModel(NamedTuple):
    """A `RollerModel` whose contacts and films the integrators cannot see.

    Attributes
    ----------
    radius, mobility, stiffness, cos_contact_angle, sin_contact_angle, radial_play, orbit_ratio, outer_radius : float
        As in `RollerModel`.
    microslip : bool
        Whether a gripped contact slips in most places all the same.
    curved : bool
        Whether contacts have mechanisms and places to book.
    data : ndarray of uint8
        The roller with its
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
    data: np.ndarray
    entries: Entries


class _AtPlace(NamedTuple):
    start_angle: float
    now: Instant


class _AtSlip(NamedTuple):
    at: Station
    slip: float


class _WithForces(NamedTuple):
    at: Station
    forces: SlipForces
    slip: float


class _Held(NamedTuple):
    state: _WithForces
    span: float


class _Passed(NamedTuple):
    held: _Held
    passage: Passage


class _Traced(NamedTuple):
    state: _WithForces
    index: int


class _Loads(NamedTuple):
    inner_load: float
    outer_load: float
    ring_speed: float
    entrainment_speed: float


class _Value(NamedTuple):
    value: float


class _Powers(NamedTuple):
    """Frictional power at inner raceway, outer raceway and cage [W]."""

    inner: float
    outer: float
    cage: float


#: What a plain contact adds to its force: nothing, and no skew moment is known.
_PLAIN = Detail(0.0, np.nan, 0.0)
_NO_STATION = Station(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
_NO_FORCES = SlipForces(*(0.0,) * 9, (0.0, 0.0, 0.0), _PLAIN, _PLAIN, _PLAIN)
_STATE = _WithForces(_NO_STATION, _NO_FORCES, 0.0)
_HELD = _Held(_STATE, 0.0)
_STAGES = (0.0, 0.0, 0.0)
_PASSED = _Passed(_HELD, Passage(0, (_STAGES, _STAGES), Way(0.0, 0.0, 0.0, 0.0)))
_RECORD = new_record(np.zeros(1), np.zeros(0), 0.0)


def _known(detail):
    return _PLAIN if detail is None else detail


@overload(_known)
def _known_of(detail):
    if isinstance(detail, numba.types.NoneType):
        return lambda detail: Detail(0.0, np.nan, 0.0)
    return lambda detail: detail


@jit_part
def _station(model, given, result):
    write(result, station(model, given.start_angle, given.now))


@jit_part
def _forces(model, given, result):
    found = slip_forces(model, given.at, given.slip)
    write(
        result,
        SlipForces(
            found.inner,
            found.outer,
            found.cage,
            found.slope,
            found.inner_slope,
            found.outer_slope,
            found.cage_load,
            found.cage_load_slope,
            found.resistance,
            found.rolling_power,
            _known(found.inner_detail),
            _known(found.outer_detail),
            _known(found.cage_detail),
        ),
    )


@jit_part
def _powers(model, given, result):
    inner, outer, cage = powers(model, given.at, given.forces, given.slip)
    write(result, _Powers(inner, outer, cage))


@jit_part
def _rising(model, given, result):
    write(
        result, _Value(rising_at(model, given.inner_load, given.outer_load, given.ring_speed, given.entrainment_speed))
    )


@jit_part
def _relaxation(model, given, result):
    write(result, _Value(relaxation_rate(model, given.inner_load, given.ring_speed)))


@jit_part
def _note(model, given, record):
    state = given.state
    note_state(record, model, state.at, state.forces, state.slip, given.span)


@jit_part
def _stage(model, given, record):
    state = given.state
    book_stage(record, model, state.at, state.forces, state.slip, given.span)


@jit_part
def _step(model, given, record):
    state = given.held.state
    book_step(record, model, state.at, state.forces, state.slip, given.held.span, given.passage)


@jit_part
def _trace(model, given, record):
    state = given.state
    write_trace(record, model, given.index, state.at, state.forces, state.slip)


def _type(example):
    return numba.typeof(example)


_RECORD_TYPE = Reference(_type(_RECORD))
_AT_PLACE = _type(_AtPlace(0.0, Instant(0.0, 0.0, 0.0, 0.0, 0.0)))
_AT_SLIP, _WITH_FORCES = _type(_AtSlip(_NO_STATION, 0.0)), _type(_STATE)
_LOADS, _VALUE = _type(_Loads(0.0, 0.0, 0.0, 0.0)), _type(_Value(0.0))
_STATION, _FORCES, _POWERS = _type(_NO_STATION), _type(_NO_FORCES), _type(_Powers(0.0, 0.0, 0.0))
_HELD_TYPE, _PASSED_TYPE, _TRACED_TYPE = _type(_HELD), _type(_PASSED), _type(_Traced(_STATE, 0))

#: What each entry runs, is given, and leaves.
_ENTRIES = {
    "station": (_station, _AT_PLACE, _STATION),
    "forces": (_forces, _AT_SLIP, _FORCES),
    "powers": (_powers, _WITH_FORCES, _POWERS),
    "rising": (_rising, _LOADS, _VALUE),
    "relaxation": (_relaxation, _LOADS, _VALUE),
    "note": (_note, _HELD_TYPE, _RECORD_TYPE),
    "stage": (_stage, _HELD_TYPE, _RECORD_TYPE),
    "step": (_step, _PASSED_TYPE, _RECORD_TYPE),
    "trace": (_trace, _TRACED_TYPE, _RECORD_TYPE),
}
_call_station = calling(_AT_PLACE, _STATION)
_call_forces = calling(_AT_SLIP, _FORCES)
_call_powers = calling(_WITH_FORCES, _POWERS)
_call_value = calling(_LOADS, _VALUE)
_call_held = calling(_HELD_TYPE, _RECORD_TYPE)
_call_passed = calling(_PASSED_TYPE, _RECORD_TYPE)
_call_traced = calling(_TRACED_TYPE, _RECORD_TYPE)

_compiled: dict[Any, dict[str, Any]] = {}
_lock = threading.Lock()


def _entries(kind: Any) -> dict[str, Any]:
    """The entries of all rollers of a type, which is compiled once."""
    with _lock:
        if kind not in _compiled:
            _compiled[kind] = {
                name: entry(
                    function,
                    Reference(kind),
                    Reference(given),
                    result if isinstance(result, Reference) else Reference(result),
                )
                for name, (function, given, result) in _ENTRIES.items()
            }
        return _compiled[kind]


@jit
def _pack(model, buffer):
    return packed(model, buffer)


def sealed(model: RollerModel) -> SealedModel:
    """A roller as the integrators take it.

    Parameters
    ----------
    model : RollerModel

    Returns
    -------
    SealedModel
        Of the same type whatever the laws are, which are compiled on the first call for such a roller.
    """
    entries = Entries(**{name: one.address for name, one in _entries(numba.typeof(model)).items()})
    data = np.empty(_pack(model, np.empty(0, dtype=np.uint8)), dtype=np.uint8)
    _pack(model, data)
    # The bytes point to the model's arrays.
    weakref.finalize(data, _forget, model)
    return SealedModel(
        radius=model.radius,
        mobility=model.mobility,
        stiffness=model.stiffness,
        cos_contact_angle=model.cos_contact_angle,
        sin_contact_angle=model.sin_contact_angle,
        radial_play=model.radial_play,
        orbit_ratio=model.orbit_ratio,
        outer_radius=model.outer_radius,
        microslip=slips_everywhere(model.inner),
        curved=isinstance(model.inner, CurvedContact),
        data=data,
        entries=entries,
    )


def _forget(model: RollerModel) -> None:
    """Nothing: to be called with a model keeps it until then."""


def has_microslip(model):
    """Whether a gripped roller slips in most places all the same."""
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
        return _call_station(model.entries.station, model.data.ctypes.data, _AtPlace(start_angle, now))

    return implementation


def forces_of(model, at, slip):
    """`macroslip.roller.forces.slip_forces`, with details whatever the contacts are."""
    return slip_forces(model, at, slip)


@overload(forces_of)
def _forces_of(model, at, slip):
    def implementation(model, at, slip):
        return _call_forces(model.entries.forces, model.data.ctypes.data, _AtSlip(at, slip))

    return implementation


def powers_of(model, at, forces, slip):
    """`macroslip.integrate.measures.powers`."""
    return powers(model, at, forces, slip)


@overload(powers_of)
def _powers_of(model, at, forces, slip):
    def implementation(model, at, forces, slip):
        found = _call_powers(model.entries.powers, model.data.ctypes.data, _WithForces(at, forces, slip))
        return found.inner, found.outer, found.cage

    return implementation


def rising_of(model, inner_load, outer_load, ring_speed, entrainment_speed):
    """`macroslip.integrate.held_contact.rising_at`."""
    return rising_at(model, inner_load, outer_load, ring_speed, entrainment_speed)


@overload(rising_of)
def _rising_of(model, inner_load, outer_load, ring_speed, entrainment_speed):
    def implementation(model, inner_load, outer_load, ring_speed, entrainment_speed):
        given = _Loads(inner_load, outer_load, ring_speed, entrainment_speed)
        return _call_value(model.entries.rising, model.data.ctypes.data, given).value

    return implementation


def relaxation_of(model, load, ring_speed):
    """`macroslip.integrate.held_contact.relaxation_rate`."""
    return relaxation_rate(model, load, ring_speed)


@overload(relaxation_of)
def _relaxation_of(model, load, ring_speed):
    def implementation(model, load, ring_speed):
        given = _Loads(load, load, ring_speed, ring_speed)
        return _call_value(model.entries.relaxation, model.data.ctypes.data, given).value

    return implementation


def note_state_of(record, model, at, forces, slip, span):
    """`macroslip.integrate.measures.note_state`."""
    note_state(record, model, at, forces, slip, span)


@overload(note_state_of)
def _note_state_of(record, model, at, forces, slip, span):
    def implementation(record, model, at, forces, slip, span):
        _call_held(model.entries.note, model.data.ctypes.data, _Held(_WithForces(at, forces, slip), span), record)

    return implementation


def book_stage_of(record, model, at, forces, slip, span):
    """`macroslip.integrate.detail.book_stage`."""
    book_stage(record, model, at, forces, slip, span)


@overload(book_stage_of)
def _book_stage_of(record, model, at, forces, slip, span):
    def implementation(record, model, at, forces, slip, span):
        if model.curved:
            _call_held(model.entries.stage, model.data.ctypes.data, _Held(_WithForces(at, forces, slip), span), record)

    return implementation


def book_step_of(record, model, at, forces, slip, span, passage):
    """`macroslip.integrate.detail.book_step`."""
    book_step(record, model, at, forces, slip, span, passage)


@overload(book_step_of)
def _book_step_of(record, model, at, forces, slip, span, passage):
    def implementation(record, model, at, forces, slip, span, passage):
        if model.curved:
            given = _Passed(_Held(_WithForces(at, forces, slip), span), passage)
            _call_passed(model.entries.step, model.data.ctypes.data, given, record)

    return implementation


def write_trace_of(record, model, index, at, forces, slip):
    """`macroslip.integrate.measures.write_trace`."""
    write_trace(record, model, index, at, forces, slip)


@overload(write_trace_of)
def _write_trace_of(record, model, index, at, forces, slip):
    def implementation(record, model, index, at, forces, slip):
        given = _Traced(_WithForces(at, forces, slip), index)
        _call_traced(model.entries.trace, model.data.ctypes.data, given, record)

    return implementation
