"""The laws of a roller compiled by themselves, for integrators that call them by address."""

from __future__ import annotations

import threading
import weakref
from typing import Any

import numba
import numpy as np
from numba.extending import overload

from macroslip.compiled import entry, jit, jit_inline
from macroslip.integrate import entry_types as types
from macroslip.integrate.ahead import wait_for_all
from macroslip.integrate.detail import book_passage
from macroslip.integrate.entry_types import PLAIN, StageForces, Value
from macroslip.integrate.held_contact import relaxation_rate, rising_at, slips_everywhere
from macroslip.integrate.measures import note_state, write_trace
from macroslip.integrate.sealed import Entries, SealedModel
from macroslip.reference import Reference, packed, write
from macroslip.roller.contact_force import CurvedContact, Detail, is_curved
from macroslip.roller.forces import SlipForces, slip_forces, station
from macroslip.roller.friction_power import power_rule
from macroslip.roller.model import RollerModel
from macroslip.roller.stage_forces import stage_forces, takes_lanes


def _known(detail):
    return PLAIN if detail is None else detail


@overload(_known)
def _known_of(detail):
    if isinstance(detail, numba.types.NoneType):
        return lambda detail: Detail(0.0, np.nan, 0.0)
    return lambda detail: detail


def _station(model, given, result):
    write(result, station(model, given.start_angle, given.now))


@jit_inline
def _detailed(found):
    """Forces with details whatever the contacts are."""
    return SlipForces(
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
    )


def _forces(model, given, result):
    write(result, _detailed(slip_forces(model, given.at, given.slip)))


def _stages(model, given, result):
    one, two, three = stage_forces(model, given)
    write(result, StageForces(_detailed(one), _detailed(two), _detailed(three)))


def _rising(model, given, result):
    write(
        result, Value(rising_at(model, given.inner_load, given.outer_load, given.ring_speed, given.entrainment_speed))
    )


def _relaxation(model, given, result):
    write(result, Value(relaxation_rate(model, given.inner_load, given.ring_speed)))


def _note(model, given, record):
    state = given.state
    note_state(record, model, state.at, state.forces, state.slip, given.span)


def _passage(model, given, record):
    state = given.state
    book_passage(record, model, state.at, state.forces, state.slip, given.passage)


def _trace(model, given, record):
    state = given.state
    write_trace(record, model, given.index, state.at, state.forces, state.slip)


#: For each entry: the function, the type of its argument, and the type of its result.
_ENTRIES = {
    "station": (_station, types.AT_PLACE, types.STATION),
    "forces": (_forces, types.AT_SLIP, types.FORCES),
    "stages": (_stages, types.AT_STAGES, types.STAGE_FORCES),
    "rising": (_rising, types.LOADS, types.VALUE),
    "relaxation": (_relaxation, types.LOADS, types.VALUE),
    "note": (_note, types.HELD_TYPE, types.RECORD_TYPE),
    "passage": (_passage, types.PASSED_TYPE, types.RECORD_TYPE),
    "trace": (_trace, types.TRACED_TYPE, types.RECORD_TYPE),
}

#: Numbers of a roller that its sealed model repeats.
_GEOMETRY = [name for name in SealedModel._fields if name in RollerModel._fields]

#: Entries that `macroslip.integrate.ahead` compiles at a first run, while this process compiles the others.
AHEAD = ("passage", "station", "note", "trace")

_compiled: dict[Any, Any] = {}
_lock = threading.Lock()


def compiled_entry(kind: Any, name: str) -> Any:
    """An entry of all rollers of a type, compiled once."""
    if (kind, name) not in _compiled:
        function, given, result = _ENTRIES[name]
        target = result if isinstance(result, Reference) else Reference(result)
        _compiled[kind, name] = entry(function, Reference(kind), Reference(given), target)
    return _compiled[kind, name]


def _addresses(kind: Any) -> dict[str, int]:
    names = [name for name in _ENTRIES if name != "stages" or takes_lanes(kind)]
    with _lock:
        for name in sorted(names, key=AHEAD.__contains__):
            if name in AHEAD and is_curved(kind.types[-1]):
                wait_for_all()
            compiled_entry(kind, name)
        return {name: _compiled[kind, name].address for name in names}


@jit
def _pack(model, buffer):
    return packed(model, buffer)


def sealed(model: RollerModel, *, detailed: bool = True) -> SealedModel:
    """A roller as the integrators take it.

    Parameters
    ----------
    model : RollerModel
    detailed : bool
        Whether to record the places and extremes of curved contacts.

    Returns
    -------
    SealedModel
        Of the same type whatever the laws are, which are compiled on the first call for such a roller.
    """
    addresses = _addresses(numba.typeof(model))
    entries = Entries(**{"stages": 0} | addresses)
    data = np.empty(_pack(model, np.empty(0, dtype=np.uint8)), dtype=np.uint8)
    _pack(model, data)
    # The bytes point to the model's arrays.
    weakref.finalize(data, _forget, model)
    curved = isinstance(model.inner, CurvedContact)
    return SealedModel(
        **{name: getattr(model, name) for name in _GEOMETRY},
        microslip=slips_everywhere(model.inner),
        curved=curved,
        detailed=curved and detailed,
        lanes="stages" in addresses,
        inner_power=power_rule(model.inner),
        outer_power=power_rule(model.outer),
        data=data,
        entries=entries,
    )


def _forget(model: RollerModel) -> None:
    """Do nothing. The finalizer that calls this keeps the model alive until then."""
