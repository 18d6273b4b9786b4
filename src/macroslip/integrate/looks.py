"""When a roller's contacts are evaluated station by station (a look): at every step that would cost more than the forces.

Between two looks the energies of the raceways are kept, and when they were spent. A look spreads them over the way since the
one before, as if power had passed linearly in time from how it lay along the roller at that one to how it lies now, and
raises the extremes of the orbit.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from macroslip.compiled import jit_part
from macroslip.integrate.detail import Passage, collect
from macroslip.integrate.sealed import book_passage_of
from macroslip.integrate.surface import Way
from macroslip.integrate.tuning import FINE_LOOKS, LOOK_CHANGE, LOOK_RISE, LOOK_TURN
from macroslip.ring.orbit import instant, interval_of
from macroslip.roller.contact_force import LOWEST_ENTRAINMENT_SPEED


class Highest(NamedTuple):
    """Largest values that have been looked at.

    Attributes
    ----------
    inner, outer, cage : float
        Power at the interfaces [W].
    inner_density, outer_density : float
        Power over load^(2/3), to which the area is in proportion.
    ratio : float
        Slide-roll ratio of the middle [-].
    """

    inner: float
    outer: float
    cage: float
    inner_density: float
    outer_density: float
    ratio: float


class Looks(NamedTuple):
    """The last look.

    Attributes
    ----------
    count : int
        Looks so far.
    orbit : int
        Orbit it was in, or −1.
    time : float
        [s]; NaN before the first.
    shaft_angle : float
        [rad].
    inner, outer : float
        Power at the raceways then [W].
    highest : Highest
        In that orbit so far.
    """

    count: int
    orbit: int
    time: float
    shaft_angle: float
    inner: float
    outer: float
    highest: Highest


@jit_part
def no_looks():
    """Before the first look."""
    return Looks(0, -1, math.nan, 0.0, 0.0, 0.0, Highest(0.0, 0.0, 0.0, 0.0, 0.0, 0.0))


@jit_part
def started(looks, path, state):
    """Begin to count the way at a state, if that has not been done yet."""
    if not math.isnan(looks.time):
        return looks
    interval = interval_of(path.motion, state.time, state.interval)
    angle = instant(path.motion, interval, state.time).shaft_angle
    return Looks(0, -1, state.time, angle, 0.0, 0.0, looks.highest)


@jit_part
def _density(power, load):
    return power * load ** (-2.0 / 3.0) if load > 0.0 else 0.0


@jit_part
def _values(state):
    """Values of a state by which a look is decided."""
    at, slip = state.at, state.slip
    inner, outer, cage = state.powers
    entrainment = max(abs(at.ring_speed - 0.5 * slip), LOWEST_ENTRAINMENT_SPEED)
    ratio = abs(slip) / entrainment
    return Highest(inner, outer, cage, _density(inner, at.inner_load), _density(outer, at.outer_load), ratio)


@jit_part
def _is_due(now, looks):
    """Whether a power has changed enough for its orbit, or a value is a new highest one."""
    highest = looks.highest
    due = abs(now.inner - looks.inner) > LOOK_CHANGE * highest.inner
    due |= abs(now.outer - looks.outer) > LOOK_CHANGE * highest.outer
    due |= now.inner_density > LOOK_RISE * highest.inner_density
    due |= now.outer_density > LOOK_RISE * highest.outer_density
    due |= now.cage > LOOK_RISE * highest.cage
    return due or now.ratio > LOOK_RISE * highest.ratio


@jit_part
def follow(record, path, state, energies, length, orbit, looks):
    """Keep the energies of a step that ends in `state`, and look at its contacts where that is due.

    Parameters
    ----------
    record : RollerRecord
    path : Path
    state : State
        At the end of the step.
    energies : tuple of float
        Of the step at inner and outer raceway [J].
    length : float
        Of the step [s].
    orbit : int
        Of the step, or −1.
    looks : Looks

    Returns
    -------
    Looks
    """
    if not path.model.detailed:
        return looks
    since = state.time - 0.5 * length - looks.time
    collect(record, 0, energies[0], since)
    collect(record, 1, energies[1], since)
    turn = abs(state.at.ring_speed) * (state.time - looks.time) / path.model.outer_radius
    if orbit != looks.orbit or turn >= LOOK_TURN or _is_due(_values(state), looks):
        return looked(record, path, state, orbit, looks)
    return looks


@jit_part
def looked(record, path, state, orbit, looks):
    """Look at the contacts."""
    model = path.model
    angle = instant(path.motion, state.interval, state.time).shaft_angle
    way = Way(path.start_angle, model.orbit_ratio, looks.shaft_angle, angle)
    passage = Passage(orbit, way, state.time - looks.time, looks.count % FINE_LOOKS == 0)
    book_passage_of(record, model, state.at, state.forces, state.slip, passage)
    now, before = _values(state), looks.highest
    if orbit == looks.orbit:
        now = Highest(
            max(now.inner, before.inner),
            max(now.outer, before.outer),
            max(now.cage, before.cage),
            max(now.inner_density, before.inner_density),
            max(now.outer_density, before.outer_density),
            max(now.ratio, before.ratio),
        )
    return Looks(looks.count + 1, orbit, state.time, angle, state.powers[0], state.powers[1], now)
