"""Where a roller lies in the tables of its contacts: all logarithms of a force evaluation, four at a time."""

from __future__ import annotations

from typing import Any, NamedTuple

from numba.extending import overload

from macroslip.compiled import jit_inline
from macroslip.contact.logarithms import exponentials, logarithms
from macroslip.reference import tuple_type
from macroslip.roller.contact_force import CurvedContact, is_curved, is_known
from macroslip.roller.raceway_table import raceway_place, scaled_ratio


class Places(NamedTuple):
    """Places of a roller's state in tables; None for plain contacts, which have none.

    Attributes
    ----------
    inner, outer : RacewayPlace or None
    inner_film, outer_film : tuple of 2 float or None
        Logarithms of load and mean speed.
    surface : float or None
        Logarithm of the speed of the roller's surface.
    """

    inner: Any
    outer: Any
    inner_film: Any
    outer_film: Any
    surface: Any


@jit_inline
def _curved_places(model, at, slip):
    ring_speed, inner, outer = at.ring_speed, model.inner.table, model.outer.table
    inner_scaled, outer_scaled = scaled_ratio(inner, ring_speed, slip), scaled_ratio(outer, ring_speed, slip)
    inner_load, outer_load, speed, mean = logarithms(
        at.inner_load, at.outer_load, abs(ring_speed), abs(ring_speed - 0.5 * slip)
    )
    inner_root, outer_root, _, _ = exponentials(inner_load * (1.0 / 3.0), outer_load * (1.0 / 3.0), 0.0, 0.0)
    inner_ratio, outer_ratio, surface, _ = logarithms(inner_scaled[2], outer_scaled[2], abs(ring_speed - slip), 1.0)
    return Places(
        raceway_place(inner, (inner_load, inner_root), speed, inner_ratio, inner_scaled),
        raceway_place(outer, (outer_load, outer_root), speed, outer_ratio, outer_scaled),
        (inner_load, mean),
        (outer_load, mean),
        surface,
    )


def places_of(model, at, slip):
    """Places of a state in the tables of a roller's contacts.

    Parameters
    ----------
    model : RollerModel
    at : Station
    slip : float
        v [m/s].

    Returns
    -------
    Places
    """
    return _curved_places(model, at, slip) if isinstance(model.inner, CurvedContact) else Places(*[None] * 5)


@overload(places_of)
def _places_of(model, at, slip):
    # A model's contacts are its last three fields.
    if is_curved(tuple_type(model).types[-1]):
        return lambda model, at, slip: _curved_places(model, at, slip)
    return lambda model, at, slip: Places(None, None, None, None, None)


@jit_inline
def _with_cage_load(places, load):
    log_load, _, _, _ = logarithms(load, 1.0, 1.0, 1.0)
    return log_load, places.surface


def with_cage_load(places, load):
    """Logarithms of the cage's load [N] and of the speed of the roller's surface; None where there are no places."""
    return None if places.surface is None else _with_cage_load(places, load)


@overload(with_cage_load)
def _with_cage_load_of(places, load):
    if is_known(tuple_type(places).types[-1]):
        return lambda places, load: _with_cage_load(places, load)
    return lambda places, load: None
