"""Make the table of what films carry where a roller has play."""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from macroslip.compiled import jit
from macroslip.contact.spline import axis, axis_middles, axis_nodes, read_only, tensor_coefficients
from macroslip.reference import by_reference
from macroslip.roller.films import Films
from macroslip.roller.model import RollerModel
from macroslip.roller.play import carried, faded
from macroslip.roller.play_table import CHANNELS, LEAST_FORCE, LEAST_PLAY, PlayTable, no_play_table
from macroslip.roller.table_box import LARGEST_ERROR, TableBox, values_at

#: Distances between nodes of play, body force and ring speed.
_PLAY_SPACING, _FORCE_SPACING, _SPEED_SPACING = 0.08, 0.1, 0.1
#: Largest play of a table [m]: bearings have some tenths of a millimetre.
_MOST_PLAY = 1e-3


@jit
def play_values(films, plays, bodies, speeds, values):
    """Write what films carry at p [m] and u2 [m/s], under B [N] and −B, shape (states, 4)."""
    films = by_reference(films)
    for n in range(plays.size):
        values[n, 0] = carried(films, plays[n], bodies[n], speeds[n])
        values[n, 1] = carried(films, plays[n], -bodies[n], speeds[n])
        values[n, 2] = values[n, 3] = 0.0


def play_table(films: Films, highest_body: float, box: TableBox) -> PlayTable:
    """The table for body forces up to `highest_body` [N].

    Parameters
    ----------
    films : Films
    highest_body : float
    box : TableBox
    """
    play = axis(math.log(LEAST_PLAY), math.log(_MOST_PLAY), _PLAY_SPACING)
    body = axis(math.log(LEAST_FORCE), math.log(highest_body + LEAST_FORCE), _FORCE_SPACING)
    speed = axis(math.log(box.lowest_speed), math.log(box.highest_speed), _SPEED_SPACING)

    def at(one: Films, of_axis) -> np.ndarray:
        plays = np.maximum(np.exp(of_axis(play)) - LEAST_PLAY, 0.0)
        bodies = np.maximum(np.exp(of_axis(body)) - LEAST_FORCE, 0.0)
        states = np.meshgrid(plays, bodies, np.exp(of_axis(speed)), indexing="ij")
        return values_at(partial(play_values, one), states, CHANNELS)

    by_law = films._replace(play_table=no_play_table())
    everywhere = read_only(np.ones((play.cells, body.cells, speed.cells), dtype=np.bool_))
    table = PlayTable(play, body, speed, tensor_coefficients(at(by_law, axis_nodes), 3), everywhere)
    expected = at(by_law, axis_middles)
    off = np.abs(at(films._replace(play_table=table), axis_middles) - expected)
    return table._replace(good=read_only(np.all(off <= LARGEST_ERROR * expected, axis=-1)))


def highest_body_force(model: RollerModel, highest_speed: float) -> float:
    """Largest body force along a contact normal [N] at ring speeds up to the highest one [m/s]."""
    weight = abs(model.weight_in_plane) + abs(model.weight_along_axis)
    return weight + model.centrifugal * (highest_speed / model.outer_radius) ** 2


def faded_load(films: Films, most: float, highest_speed: float) -> float:
    """Elastic load [N] from which on films carry nothing beside it, at body forces up to `most` [N] and speeds [m/s].

    Films grow with speed, and carry more the less the body force presses on one of them.
    """
    found = 1.0
    while not all(faded(films, found, body, highest_speed) for body in (-most, 0.0, most)):
        found *= 1.1
    return found
