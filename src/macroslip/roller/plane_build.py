"""Make the tables of what depends on load and one speed: the cage's contact, and the oil of the raceway contacts."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import numpy as np

from macroslip.compiled import jit
from macroslip.contact.spline import axis, axis_middles, axis_nodes, read_only, tensor_coefficients
from macroslip.reference import by_reference
from macroslip.roller.cage_force import cage_force
from macroslip.roller.contact_force import CurvedContact
from macroslip.roller.films import Films, cage_film, raceway_film
from macroslip.roller.plane_table import CHANNELS, PlaneTable, no_plane_table
from macroslip.roller.play import log_film
from macroslip.roller.table_box import LARGEST_ERROR, TableBox, error_summary, values_at

#: Distances between nodes of load and speed, and the least load [N].
_LOAD_SPACING, _SPEED_SPACING, _LEAST_LOAD = 0.1, 0.05, 1e-2
#: Least mean speed and slip of a plane as part of the highest ring speed, and the greatest.
_LEAST_SPEED, _MOST_SPEED = 0.02, 1.1
#: Random states at which a finished table is measured.
_STATES = 4000


@jit
def cage_values(contact, loads, slips, values):
    """Write F/Δu and the asperities' part of power at states of Q [N] and Δu [m/s], shape (states, 2)."""
    contact = by_reference(contact)
    for n in range(loads.size):
        force, _, _, detail = cage_force(contact, loads[n], slips[n], 0.5 * slips[n], 0.5)
        values[n, 0] = force / slips[n]
        values[n, 1] = detail.asperity_power / (force * slips[n])  # pyright: ignore[reportOptionalMemberAccess]


@jit
def film_values(films, raceway, loads, speeds, values):
    """Write sliding per slip, rolling resistance and ln of the film at Q [N] and mean speed [m/s], shape (states, 3)."""
    films = by_reference(films)
    for n in range(loads.size):
        # Sliding is in proportion to slip at a given mean speed.
        found = raceway_film(films, raceway, loads[n], speeds[n], 1.5 * speeds[n])
        values[n, 0] = found.sliding / speeds[n]
        values[n, 1] = -found.shear
        law, table = (films.outer, films.outer_table) if raceway else (films.inner, films.inner_table)
        values[n, 2] = log_film(law, table, math.log(loads[n]), math.log(speeds[n]))[0]


@jit
def pocket_values(films, loads, speeds, values):
    """Write sliding per slip and rolling resistance per mean speed at Q [N] and mean speed [m/s], shape (states, 2)."""
    films = by_reference(films)
    for n in range(loads.size):
        found = cage_film(films, loads[n], 2.0 * speeds[n])
        values[n, 0] = -0.5 * found.sliding / speeds[n]
        values[n, 1] = -found.shear / speeds[n]


def _plane(tabled: Callable, scales: tuple[float, ...], highest_load: float, box: TableBox) -> PlaneTable:
    """A table of the results of the kernel `tabled(table)`, which falls back on the laws.

    An error of each is judged as part of its scale, or of itself where that is NaN.
    """
    kernel, quantities = tabled(no_plane_table()), len(scales)
    load = axis(math.log(_LEAST_LOAD), math.log(highest_load), _LOAD_SPACING)
    bounds = _LEAST_SPEED * box.highest_speed, _MOST_SPEED * box.highest_speed
    speed = axis(math.log(bounds[0]), math.log(bounds[1]), _SPEED_SPACING)

    def states(of_axis: Callable) -> list[np.ndarray]:
        return np.meshgrid(np.exp(of_axis(load)), np.exp(of_axis(speed)), indexing="ij")

    values = np.zeros((load.cells + 1, speed.cells + 1, CHANNELS))
    values[..., :quantities] = values_at(kernel, states(axis_nodes), quantities)
    everywhere = read_only(np.ones((load.cells, speed.cells), dtype=np.bool_))
    table = PlaneTable(load, speed, tensor_coefficients(values, 2), everywhere)
    middles = states(axis_middles)
    expected = values_at(kernel, middles, quantities)
    off = np.abs(values_at(tabled(table), middles, quantities) - expected)
    good = np.all(off <= LARGEST_ERROR * np.where(np.isnan(scales), np.abs(expected), scales), axis=-1)
    return table._replace(good=read_only(good))


def film_table(films: Films, raceway: int, box: TableBox) -> PlaneTable:
    """The oil of a raceway contact over ln Q and ln of the mean speed: sliding per slip, resistance and ln of the film.

    Parameters
    ----------
    films : Films
    raceway : int
        0 the inner, 1 the outer.
    box : TableBox
    """
    name = "outer_table" if raceway else "inner_table"

    def tabled(table: PlaneTable) -> Callable:
        return partial(film_values, films._replace(**{name: table}), raceway)

    return _plane(tabled, (math.nan, math.nan, 1.0), box.highest_load, box)


def pocket_table(films: Films, box: TableBox) -> PlaneTable:
    """The oil in the pocket over ln Q and ln of the mean speed: sliding per slip and resistance per mean speed."""

    def tabled(table: PlaneTable) -> Callable:
        return partial(pocket_values, films._replace(cage_table=table))

    return _plane(tabled, (math.nan, math.nan), box.highest_cage_load, box)


def cage_table(contact: CurvedContact, box: TableBox) -> tuple[PlaneTable, np.ndarray]:
    """The cage's contact over ln Q and ln |Δu|: F/Δu and the part of its power that asperities dissipate.

    Returns
    -------
    PlaneTable, ndarray
        With the median and the largest relative error of force at random states, and the share of states that it holds.
    """

    def tabled(table: PlaneTable) -> Callable:
        return partial(cage_values, contact._replace(table=table))

    table = _plane(tabled, (math.nan, 1.0), box.highest_cage_load, box)
    random = np.random.default_rng(2)
    loads = np.exp(random.uniform(math.log(_LEAST_LOAD), math.log(box.highest_cage_load), _STATES))
    slips = box.highest_speed * np.exp(random.uniform(math.log(_LEAST_SPEED), 0.0, _STATES))
    expected = values_at(tabled(no_plane_table()), (loads, slips), 2)[:, 0]
    return table, error_summary(np.abs(values_at(tabled(table), (loads, slips), 2)[:, 0] / expected - 1.0))
