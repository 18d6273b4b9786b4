"""Forces on a roller at three stations at once, as the stages of a step need them.

If all its laws take numbers in lanes (`macroslip.contact.lanes`) the three are computed in the lanes of vector registers, by
the same source as one. Most of the work are logarithms and exponentials of films and tractions, and those take as long for
four numbers as for one.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from macroslip.compiled import jit, jit_inline
from macroslip.contact.lanes import gathered, scattered
from macroslip.film.film_law import film_takes_lanes
from macroslip.reference import tuple_type
from macroslip.roller.contact_force import PlainContact
from macroslip.roller.films import NoFilms
from macroslip.roller.forces import SlipForces, Station, slip_forces
from macroslip.traction.traction_law import traction_takes_lanes


class AtStages(NamedTuple):
    """Three stations, and the slip at each [m/s]."""

    at1: Any
    at2: Any
    at3: Any
    v1: float
    v2: float
    v3: float


def _is_plain(contact) -> bool:
    """Whether a contact, by its numba type, is plain, with laws that take numbers in lanes."""
    kind = tuple_type(contact)
    if kind.instance_class is not PlainContact:
        return False
    film, traction = (tuple_type(kind.types[kind.fields.index(name)]).instance_class for name in ("film", "traction"))
    return film_takes_lanes(film) and traction_takes_lanes(traction)


def takes_lanes(model) -> bool:
    """Whether all laws of a roller, by its numba type, take numbers in lanes."""
    kind = tuple_type(model)
    parts = {name: kind.types[kind.fields.index(name)] for name in ("inner", "outer", "cage", "films")}
    return tuple_type(parts.pop("films")).instance_class is NoFilms and all(map(_is_plain, parts.values()))


@jit
def stage_forces(model, given):
    """`slip_forces` at three stations.

    Parameters
    ----------
    model : RollerModel
        Which `takes_lanes`.
    given : AtStages

    Returns
    -------
    tuple of 3 SlipForces
        Those of `slip_forces` to rounding.
    """
    at1, at2, at3 = given.at1, given.at2, given.at3
    at = Station(
        gathered(at1.ring_speed, at2.ring_speed, at3.ring_speed),
        0.0,
        0.0,
        gathered(at1.inner_load, at2.inner_load, at3.inner_load),
        gathered(at1.outer_load, at2.outer_load, at3.outer_load),
        gathered(at1.tangential, at2.tangential, at3.tangential),
    )
    found = slip_forces(model, at, gathered(given.v1, given.v2, given.v3))
    inner, outer, cage = scattered(found.inner), scattered(found.outer), scattered(found.cage)
    slope, inner_slope, outer_slope = scattered(found.slope), scattered(found.inner_slope), scattered(found.outer_slope)
    load, load_slope = scattered(found.cage_load), scattered(found.cage_load_slope)
    return (
        _plain(inner[0], outer[0], cage[0], (slope[0], inner_slope[0], outer_slope[0]), load[0], load_slope[0]),
        _plain(inner[1], outer[1], cage[1], (slope[1], inner_slope[1], outer_slope[1]), load[1], load_slope[1]),
        _plain(inner[2], outer[2], cage[2], (slope[2], inner_slope[2], outer_slope[2]), load[2], load_slope[2]),
    )


@jit_inline
def _plain(inner, outer, cage, slopes, cage_load, cage_load_slope):
    """Forces without rolling resistance, of plain contacts."""
    none = (0.0, 0.0, 0.0)
    return SlipForces(
        inner, outer, cage, slopes[0], slopes[1], slopes[2], cage_load, cage_load_slope, 0.0, none, None, None, None
    )
