"""Tables for the contacts of a roller: made from its laws or found in store, with what is known of them."""

from __future__ import annotations

import math
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import NamedTuple

import numpy as np

from macroslip.contact.table_store import remembered, table_key
from macroslip.roller.contact_force import CurvedContact
from macroslip.roller.films import Films
from macroslip.roller.forces import INNER, OUTER
from macroslip.roller.model import RollerModel
from macroslip.roller.plane_build import cage_table, film_table, pocket_table
from macroslip.roller.play_build import faded_load, highest_body_force, play_table
from macroslip.roller.raceway_build import raceway_table
from macroslip.roller.table_box import TableBox, wide_box
from macroslip.traction.film_shear_law import FilmShear


class TableReport(NamedTuple):
    """What a result says of its tables.

    Attributes
    ----------
    typical_error, worst_error : float
        Relative, of force and power: the median and the largest over random states that the tables know.
    known : float
        Share of the states at which the tables stand in for the laws [-].
    size : int
        [bytes].
    build_time : float
        Processor time it took to make those of the raceways [s], whenever that was.
    """

    typical_error: float
    worst_error: float
    known: float
    size: int
    build_time: float


def needs_tables(model: RollerModel) -> bool:
    """Whether traction at the raceways is summed over many chords, so that tables save time."""
    inner = model.inner
    return isinstance(inner, CurvedContact) and isinstance(inner.traction, FilmShear) and inner.shape.microslip


def tabulated(
    models: dict[str, RollerModel], box: TableBox, threads: int = 1
) -> tuple[dict[str, RollerModel], TableReport]:
    """The rollers of both rows with tables for their contacts, and what is known of these.

    Parameters
    ----------
    models : dict of RollerModel
        By row; of rollers that `needs_tables`.
    box : TableBox
    threads : int
        With two or more, the tables of both raceways are made at once.
    """
    model = next(iter(models.values()))
    with ThreadPoolExecutor(min(threads, 2)) as pool:
        raceways = pool.map(partial(raceway_table, box=box), (model.inner, model.outer))
        (inner, of_inner, inner_time), (outer, of_outer, outer_time) = raceways
    small = wide_box(box)
    cage, of_cage = remembered(table_key(model.cage, small), lambda: cage_table(model.cage, small))
    films = model.films
    if isinstance(films, Films):
        body = highest_body_force(model, small.highest_speed)
        films = remembered(table_key(films, body, small), partial(_with_tables, films, body, small))
        load = faded_load(films, highest_body_force(model, box.highest_speed), box.highest_speed)
        films = films._replace(faded_load=load, faded_speed=box.highest_speed)
    planes: list = [cage]
    if isinstance(films, Films):
        planes += [films.inner_table, films.outer_table, films.cage_table, films.play_table]
    errors = np.array([of_inner, of_outer, of_cage])
    found = {}
    for row, one in models.items():
        found[row] = one._replace(
            inner=one.inner._replace(table=inner._replace(side=_side(one.inner))),
            outer=one.outer._replace(table=outer._replace(side=_side(one.outer))),
            cage=one.cage._replace(table=cage),
            films=films,
        )
    size = sum(table.coefficients.nbytes + table.good.nbytes for table in (inner, outer, *planes))
    return found, TableReport(
        float(errors[:, 0].max()), float(errors[:, 1].max()), float(errors[:2, 2].min()), size, inner_time + outer_time
    )


def _with_tables(films: Films, body: float, box: TableBox) -> Films:
    """Films with their tables, for body forces up to `body` [N]."""
    films = films._replace(inner_table=film_table(films, INNER, box), outer_table=film_table(films, OUTER, box))
    return films._replace(cage_table=pocket_table(films, box), play_table=play_table(films, body, box))


def _side(contact: CurvedContact) -> float:
    return math.copysign(1.0, contact.shape.spin_ratio)
