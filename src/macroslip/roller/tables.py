"""Tables for the contacts of a roller: made from its laws or found in store, with what is known of them."""

from __future__ import annotations

import math
import time
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import NamedTuple

import numpy as np

from macroslip.contact.spline import Axis
from macroslip.contact.table_store import stored, table_key
from macroslip.roller.contact_force import CurvedContact
from macroslip.roller.films import Films
from macroslip.roller.forces import INNER, OUTER
from macroslip.roller.model import RollerModel
from macroslip.roller.plane_build import cage_table, film_table, pocket_table
from macroslip.roller.play_build import faded_load, highest_body_force, play_table
from macroslip.roller.raceway_build import raceway_errors, raceway_table, raceway_values
from macroslip.roller.raceway_table import CHANNELS, RacewayTable, no_raceway_table
from macroslip.roller.table_box import TableBox
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
        raceways = pool.map(partial(_stored_raceway_table, box=box), (model.inner, model.outer))
        (inner, of_inner, inner_time), (outer, of_outer, outer_time) = raceways
    cage, of_cage = cage_table(model.cage, box)
    films = model.films
    if isinstance(films, Films):
        films = films._replace(inner_table=film_table(films, INNER, box), outer_table=film_table(films, OUTER, box))
        body = highest_body_force(model, box.highest_speed)
        films = films._replace(
            cage_table=pocket_table(films, box),
            play_table=play_table(films, body, box),
            faded_load=faded_load(films, body, box.highest_speed),
            faded_speed=box.highest_speed,
        )
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


def _side(contact: CurvedContact) -> float:
    return math.copysign(1.0, contact.shape.spin_ratio)


def _stored_raceway_table(contact: CurvedContact, box: TableBox) -> tuple[RacewayTable, np.ndarray, float]:
    """A raceway's table, its errors and the processor time it took to make [s], from the store or made."""
    shape = contact.shape._replace(spin_ratio=abs(contact.shape.spin_ratio))
    alike = contact._replace(shape=shape, table=no_raceway_table())

    def make() -> list[np.ndarray]:
        # Compilation, at the first table after installation, is no part of the time.
        raceway_values(alike, *np.full((3, 1), np.nan), np.empty((1, CHANNELS)))
        started = time.thread_time()
        table = raceway_table(alike, box)
        errors = raceway_errors(alike, table, box)
        axes = np.array([table.load, table.speed, table.ratio])
        numbers = np.array([table.stretch, table.merging_ratio, time.thread_time() - started])
        return [axes, numbers, table.coefficients, table.good, errors]

    axes, numbers, coefficients, good, errors = stored(table_key(alike, box), make)
    load, speed, ratio = (Axis(float(first), float(per_spacing), int(cells)) for first, per_spacing, cells in axes)
    table = RacewayTable(load, speed, ratio, float(numbers[0]), float(numbers[1]), 1.0, coefficients, good)
    return table, errors, float(numbers[2])
