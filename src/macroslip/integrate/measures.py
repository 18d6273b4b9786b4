"""Values of a roller's state by its laws: frictional powers, range of the film law, and traces."""

from __future__ import annotations

import math

from numba import types
from numba.extending import overload

from macroslip.compiled import jit_part
from macroslip.film.film_law import film_in_range, film_thickness
from macroslip.roller.contact_force import LOWEST_ENTRAINMENT_SPEED
from macroslip.roller.friction_power import friction_power


@jit_part
def powers(model, at, forces, slip):
    """Frictional power (33) at inner, outer and cage interface [W]."""
    return (
        friction_power(model.inner, slip, at.ring_speed, forces.inner, forces.inner_detail),
        friction_power(model.outer, slip, at.ring_speed, forces.outer, forces.outer_detail),
        abs(forces.cage * (at.ring_speed - slip)),
    )


@jit_part
def note_state(record, model, at, forces, slip, span):
    """Book spin ratio and range of the film law for a state held over `span` [s] of the window."""
    if abs(at.ring_speed) >= record.slowest and at.ring_speed != 0.0:
        ratio = (at.ring_speed - slip) / at.ring_speed
        if ratio < record.spin_ratio[0]:
            record.spin_ratio[0] = ratio
    raceway_speed = abs(at.ring_speed - 0.5 * slip)
    _note_range(record, 0, model.inner, at.inner_load, raceway_speed, span)
    _note_range(record, 1, model.outer, at.outer_load, raceway_speed, span)
    _note_range(record, 2, model.cage, abs(forces.cage_load), 0.5 * abs(at.ring_speed - slip), span)


@jit_part
def _note_range(record, interface, contact, load, speed, span):
    if load > 0.0:
        record.loaded_time[interface] += span
        if not film_in_range(contact.film, load, speed):
            record.outside_time[interface] += span


@jit_part
def _film(contact, load, speed):
    """Film thickness [m], or NaN for a contact without load."""
    if load <= 0.0:
        return math.nan
    return film_thickness(contact.film, load, max(speed, LOWEST_ENTRAINMENT_SPEED))[0]


def skew_moment(detail):
    """Skew moment of a contact [N m]; NaN for a plain one, which has none."""
    return math.nan if detail is None else detail.skew


@overload(skew_moment)
def _skew_moment(detail):
    if isinstance(detail, types.NoneType):
        return lambda detail: math.nan
    return lambda detail: detail.skew


@jit_part
def write_trace(record, model, index, at, forces, slip):
    """Write the state to the traces at an index."""
    row = record.trace[index]
    row[0] = slip
    row[1] = at.ring_speed
    row[2] = at.elastic_load
    row[3] = forces.inner
    row[4] = forces.outer
    row[5] = forces.cage
    row[6] = forces.cage_load
    row[7], row[8], row[9] = powers(model, at, forces, slip)
    raceway_speed = abs(at.ring_speed - 0.5 * slip)
    row[10] = _film(model.inner, at.inner_load, raceway_speed)
    row[11] = _film(model.outer, at.outer_load, raceway_speed)
    row[12] = _film(model.cage, abs(forces.cage_load), 0.5 * abs(at.ring_speed - slip))
    row[13] = skew_moment(forces.inner_detail)
    # A traction that drives the spin up acts along +x at the inner raceway, along −x at the outer one.
    row[14] = -skew_moment(forces.outer_detail)
    row[15], row[16], row[17] = forces.rolling_power
