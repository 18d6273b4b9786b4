"""What a kernel gives to a roller's laws, which it calls by address, and what it gets: bundles of numbers and their types."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numba import typeof

from macroslip.integrate.detail import Passage
from macroslip.integrate.record import new_record
from macroslip.integrate.surface import Way
from macroslip.reference import Reference
from macroslip.ring.orbit import Instant
from macroslip.roller.contact_force import Detail
from macroslip.roller.forces import SlipForces, Station
from macroslip.roller.stage_forces import AtStages


class AtPlace(NamedTuple):
    """A place on the orbit at the first sample [rad], and the ring's motion."""

    start_angle: float
    now: Instant


class AtSlip(NamedTuple):
    """A station, and slip [m/s]."""

    at: Station
    slip: float


class WithForces(NamedTuple):
    """A station, the forces there, and slip [m/s]."""

    at: Station
    forces: SlipForces
    slip: float


class Held(NamedTuple):
    """A state held over a time [s]."""

    state: WithForces
    span: float


class Passed(NamedTuple):
    """A state, and what the roller has passed."""

    state: WithForces
    passage: Passage


class Traced(NamedTuple):
    """A state, and its place in the traces."""

    state: WithForces
    index: int


class Loads(NamedTuple):
    """Loads on both raceways [N], and speeds [m/s]."""

    inner_load: float
    outer_load: float
    ring_speed: float
    entrainment_speed: float


class Value(NamedTuple):
    """One number."""

    value: float


class StageForces(NamedTuple):
    """Forces at the three stages of a step."""

    first: Any
    second: Any
    third: Any


#: Details of a plain contact: zero, and no skew moment.
PLAIN = Detail(0.0, np.nan, 0.0)
_NO_STATION = Station(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
_NO_FORCES = SlipForces(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, (0.0, 0.0, 0.0), PLAIN, PLAIN, PLAIN)
_STATE = WithForces(_NO_STATION, _NO_FORCES, 0.0)
_HELD = Held(_STATE, 0.0)
_PASSED = Passed(_STATE, Passage(0, Way(0.0, 0.0, 0.0, 0.0), 0.0, False))
_RECORD = new_record(np.zeros(1), np.zeros(0), 0.0)


RECORD_TYPE = Reference(typeof(_RECORD))
AT_PLACE = typeof(AtPlace(0.0, Instant(0.0, 0.0, 0.0, 0.0, 0.0)))
AT_SLIP = typeof(AtSlip(_NO_STATION, 0.0))
LOADS, VALUE = typeof(Loads(0.0, 0.0, 0.0, 0.0)), typeof(Value(0.0))
STATION, FORCES = typeof(_NO_STATION), typeof(_NO_FORCES)
AT_STAGES = typeof(AtStages(_NO_STATION, _NO_STATION, _NO_STATION, 0.0, 0.0, 0.0))
STAGE_FORCES = typeof(StageForces(_NO_FORCES, _NO_FORCES, _NO_FORCES))
HELD_TYPE, PASSED_TYPE, TRACED_TYPE = typeof(_HELD), typeof(_PASSED), typeof(Traced(_STATE, 0))
