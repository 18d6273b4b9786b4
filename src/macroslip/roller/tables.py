"""Make the tables of a roller's contacts from their laws, and measure how far they are off."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit
from macroslip.contact.spline import Axis, axis, axis_middles, axis_nodes, read_only, tensor_coefficients
from macroslip.roller.contact_force import CurvedContact, cage_force, raceway_force
from macroslip.roller.films import Films, faded, raceway_film
from macroslip.roller.forces import INNER, OUTER
from macroslip.roller.model import RollerModel
from macroslip.roller.plane_table import CHANNELS as PLANE_CHANNELS
from macroslip.roller.plane_table import PlaneTable, no_plane_table
from macroslip.roller.raceway_table import CHANNELS, SLIP_RATIO, RacewayTable, no_raceway_table
from macroslip.roller.table_store import stored, table_key
from macroslip.traction.film_shear_law import FilmShear

#: Relative error of force and of power in the middle of a cell beyond which the laws are asked there.
LARGEST_ERROR = 5e-5
#: Part of the largest force at the same load and speed below which an error of force counts as one of this part: a
#: gripped roller's force passes through zero.
_SMALL_FORCE = 0.01
#: Distances between nodes: of a raceway's load, ring speed and slip; of load and speed in a plane.
_LOAD_SPACING, _SPEED_SPACING, _RATIO_SPACING = 0.33, 0.055, 0.06
_PLANE_LOAD_SPACING, _PLANE_SPEED_SPACING = 0.2, 0.1
#: Share of the pressure exponent of the middle by which loads are stretched.
_STRETCH = 0.6
#: Least load of a table [N]: the lighter raceway of a free roller carries some newtons of its films.
_LEAST_LOAD, _LEAST_PLANE_LOAD = 0.5, 1e-2
#: Ratios of slip to ring speed of a table: from a roller that runs a little ahead to one at rest.
_LEAST_RATIO, _LARGEST_RATIO = -0.02, 1.0
#: Load [N] from which on a roller is held, and the largest ratio of slip to speed it then has; measured on the bundled
#: histories, where rollers above 10 kN slip between −0.006 and 0.001 of the ring's speed.
_HELD_LOAD, _HELD_RATIO = 20e3, 0.02
#: Least mean speed and slip of a plane as part of the highest ring speed, and the greatest.
_LEAST_SPEED, _MOST_SPEED = 0.02, 1.1
#: Factors to which the loads and speeds of a case are rounded, part of the highest speed below which no table goes, and
#: the highest load of a table, at least [N]. The cage carries the difference of the raceways' tractions, 0.004 of the
#: highest roller load on the bundled histories; here it may be this part.
_LOAD_STEP, _SPEED_STEP, _SLOWEST, _LEAST_HIGHEST_LOAD, _CAGE_LOAD = math.sqrt(2.0), 1.04, 0.25, 100.0, 0.02
#: Random loads and speeds at which a finished table is measured, with slips at each, and the largest ratio of slip to
#: speed of a held roller there.
_STATES, _SLIPS, _USUAL_RATIO = 400, 20, 0.006


class TableBox(NamedTuple):
    """Loads and speeds for which the tables of a case are made.

    Attributes
    ----------
    highest_load, highest_cage_load : float
        At a raceway and at the cage [N].
    lowest_speed, highest_speed : float
        Of the raceways past the roller's centre, |u2| [m/s].
    """

    highest_load: float
    highest_cage_load: float
    lowest_speed: float
    highest_speed: float


def table_box(ring_speeds: np.ndarray, highest_load: float, body_force: float) -> TableBox | None:
    """The box of a case, rounded outward so that cases alike share their tables.

    Parameters
    ----------
    ring_speeds : ndarray
        u2 at all load samples, between which it is linear [m/s].
    highest_load : float
        Largest elastic load of a roller [N].
    body_force : float
        Largest weight and centrifugal force of a roller [N].

    Returns
    -------
    TableBox or None
        None for a shaft that stands still. Of one that turns slowly, or round, speeds below a quarter of the highest one
        are left to the laws.

    Examples
    --------
    >>> [round(one, 4) for one in table_box(np.array([-0.40, -0.38]), 5e4, 40.0)]
    [56568.5425, 1131.3708, 0.3751, 0.405]
    """
    fastest = float(np.max(np.abs(ring_speeds)))
    if fastest == 0.0:
        return None
    load = _LOAD_STEP ** math.ceil(math.log(1.02 * (highest_load + body_force) + _LEAST_HIGHEST_LOAD, _LOAD_STEP))
    turns = np.min(ring_speeds) * np.max(ring_speeds) <= 0.0
    slowest = max(0.0 if turns else float(np.min(np.abs(ring_speeds))), _SLOWEST * fastest)
    return TableBox(
        load,
        max(1e3, _CAGE_LOAD * load),
        _SPEED_STEP ** math.floor(math.log(slowest / 1.001, _SPEED_STEP)),
        _SPEED_STEP ** math.ceil(math.log(fastest * 1.001, _SPEED_STEP)),
    )


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
        Processor time it took to make them [s], whenever that was.
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


def tabulated(models: dict[str, RollerModel], box: TableBox) -> tuple[dict[str, RollerModel], TableReport]:
    """The rollers of both rows with tables for their contacts, and what is known of these.

    Parameters
    ----------
    models : dict of RollerModel
        By row; of rollers that `needs_tables`.
    box : TableBox
    """
    model = next(iter(models.values()))
    inner, of_inner, inner_time = _stored_raceway_table(model.inner, box)
    outer, of_outer, outer_time = _stored_raceway_table(model.outer, box)
    started = time.process_time()
    cage, of_cage = cage_table(model.cage, box)
    films = model.films
    if isinstance(films, Films):
        films = films._replace(
            inner_table=film_table(films, INNER, box),
            outer_table=film_table(films, OUTER, box),
            faded_load=faded_load(films, model, box.highest_speed),
            faded_speed=box.highest_speed,
        )
    spent = inner_time + outer_time + time.process_time() - started
    planes = [cage, *((films.inner_table, films.outer_table) if isinstance(films, Films) else ())]
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
        float(errors[:, 0].max()), float(errors[:, 1].max()), float(errors[:2, 2].min()), size, spent
    )


def _side(contact: CurvedContact) -> float:
    return math.copysign(1.0, contact.shape.spin_ratio)


def _stored_raceway_table(contact: CurvedContact, box: TableBox) -> tuple[RacewayTable, np.ndarray, float]:
    """A raceway's table, its errors and the processor time it took to make [s], from the store or made."""
    shape = contact.shape._replace(spin_ratio=abs(contact.shape.spin_ratio))
    alike = contact._replace(shape=shape, table=no_raceway_table())

    def make() -> list[np.ndarray]:
        started = time.process_time()
        table = raceway_table(alike, box)
        errors = raceway_errors(alike, table, box)
        axes = np.array([table.load, table.speed, table.ratio])
        numbers = np.array([table.stretch, table.merging_ratio, time.process_time() - started])
        return [axes, numbers, table.coefficients, table.good, errors]

    axes, numbers, coefficients, good, errors = stored(table_key(alike, box), make)
    table = RacewayTable(
        *(Axis(float(first), float(per_spacing), int(cells)) for first, per_spacing, cells in axes),
        float(numbers[0]),
        float(numbers[1]),
        1.0,
        coefficients,
        good,
    )
    return table, errors, float(numbers[2])


@jit
def raceway_values(contact, loads, speeds, slips, values):
    """Write what a table holds at states of Q [N], u2 > 0 [m/s] and Δu [m/s], shape (states, 4); NaN for loads of NaN."""
    for n in range(loads.size):
        load, speed, slip = loads[n], speeds[n], slips[n]
        if math.isnan(load):
            values[n] = math.nan
            continue
        mean = speed - 0.5 * slip
        found = raceway_force(contact, load, slip, speed, abs(mean), -0.5 if mean >= 0.0 else 0.5)
        root = load ** (1.0 / 3.0)
        values[n, 0] = found.pull / load
        values[n, 1] = found.detail.lag / (load * root * root)
        values[n, 2] = found.detail.skew / (load * root)
        values[n, 3] = found.detail.asperity_power / (load * root * root * speed)


@jit
def cage_values(contact, loads, slips, values):
    """Write ln(F/Δu) and the asperities' part of power at states of Q [N] and Δu [m/s], shape (states, 2)."""
    for n in range(loads.size):
        force, _, _, detail = cage_force(contact, loads[n], slips[n], 0.5 * slips[n], 0.5)
        values[n, 0] = math.log(force / slips[n])
        values[n, 1] = detail.asperity_power / (force * slips[n])


@jit
def film_values(films, raceway, loads, speeds, values):
    """Write ln of sliding per slip and ln of rolling resistance at states of Q [N] and mean speed [m/s], shape (states, 2)."""
    for n in range(loads.size):
        # Sliding is in proportion to slip at a given mean speed.
        found = raceway_film(films, raceway, loads[n], speeds[n], 1.5 * speeds[n])
        values[n, 0] = math.log(found.sliding / speeds[n])
        values[n, 1] = math.log(-found.shear)


def _at(kernel: Callable, states: Sequence[np.ndarray], count: int) -> np.ndarray:
    """Values of `kernel` at states of one shape, with `count` more along a last dimension."""
    values = np.empty((states[0].size, count))
    kernel(*(np.ascontiguousarray(one).ravel() for one in states), values)
    return values.reshape(*states[0].shape, count)


def _loads_at(coordinates: np.ndarray, stretch: float) -> np.ndarray:
    """Loads of the given coordinates, by Newton's iteration in the logarithm, in which they are concave."""
    logarithm = np.array(coordinates)
    for _ in range(100):
        root = np.exp(logarithm / 3.0)
        logarithm -= (logarithm + stretch * root - coordinates) / (1.0 + stretch * root / 3.0)
    return np.exp(logarithm)


def raceway_table(contact: CurvedContact, box: TableBox) -> RacewayTable:
    """The table of a raceway contact with microslip.

    Parameters
    ----------
    contact : CurvedContact
        Without a table.
    box : TableBox

    Notes
    -----
    Held rollers do not slip as much as light ones; what the table holds of such states is not asked for.
    """
    shape, fluid = contact.shape, contact.traction.table.fluid
    stretch = _STRETCH * fluid.exponent * fluid.index / fluid.reference_pressure * contact.traction.pressure
    merging = shape.spin_ratio**2 * shape.contour_radius / (2.0 * shape.curvature_ratio)
    load = axis(*(math.log(q) + stretch * q ** (1.0 / 3.0) for q in (_LEAST_LOAD, box.highest_load)), _LOAD_SPACING)
    speed = axis(math.log(box.lowest_speed), math.log(box.highest_speed), _SPEED_SPACING)
    ratio = axis(*(math.asinh((x - merging) / SLIP_RATIO) for x in (_LEAST_RATIO, _LARGEST_RATIO)), _RATIO_SPACING)

    def states(of_axis: Callable) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        ratios = merging + SLIP_RATIO * np.sinh(of_axis(ratio))
        grid = np.meshgrid(_loads_at(of_axis(load), stretch), np.exp(of_axis(speed)), ratios, indexing="ij")
        loads = np.where((grid[0] > _HELD_LOAD) & (grid[2] > _HELD_RATIO), np.nan, grid[0])
        return loads, grid[1], grid[1] * grid[2]

    values = _at(partial(raceway_values, contact), states(axis_nodes), CHANNELS)
    # Along the slip the last known value goes on.
    last = np.maximum.accumulate(np.where(np.isnan(values[..., :1]), 0, np.arange(values.shape[2])[:, None]), axis=2)
    values = np.take_along_axis(values, np.broadcast_to(last, values.shape), axis=2)
    everywhere = read_only(np.ones((load.cells, speed.cells, ratio.cells), dtype=np.bool_))
    table = RacewayTable(load, speed, ratio, stretch, merging, 1.0, tensor_coefficients(values, 3), everywhere)
    force, power = _deviations(contact, table, states(axis_middles))
    good = (force <= LARGEST_ERROR) & (power <= LARGEST_ERROR)  # NaN is no good
    return table._replace(good=read_only(good))


def _deviations(
    contact: CurvedContact, table: RacewayTable, states: tuple[np.ndarray, np.ndarray, np.ndarray]
) -> tuple[np.ndarray, np.ndarray]:
    """Relative errors of force and power of a table at states whose last dimension is slip."""
    loads, speeds, slips = states
    expected = _at(partial(raceway_values, contact), states, CHANNELS)
    found = _at(partial(raceway_values, contact._replace(table=table)), states, CHANNELS)
    root = np.cbrt(loads)
    shape = contact.shape
    curvature = shape.curvature_ratio * shape.roller_radius

    def spin_and_power(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        lag = values[..., 1] * root**2
        spin = values[..., 0] - lag
        return spin, slips * spin + speeds * (curvature * lag - shape.spin_ratio * values[..., 2] * root)

    spin, power = spin_and_power(expected)
    found_spin, found_power = spin_and_power(found)
    off = np.maximum(np.abs(found_spin - spin), np.abs(found[..., 0] - expected[..., 0]))
    largest = np.nanmax(np.abs(spin), axis=-1, keepdims=True)
    # Asperities dissipate a small part of the power; an error of it counts as one of the power.
    rough = np.abs(found[..., 3] - expected[..., 3]) * root**2 * speeds
    power_off = np.maximum(np.abs(found_power - power), rough)
    return off / np.maximum(np.abs(spin), _SMALL_FORCE * largest), power_off / power


def raceway_errors(contact: CurvedContact, table: RacewayTable, box: TableBox) -> np.ndarray:
    """Median and largest relative error of force and power at random states where rollers go, and the share it knows.

    States are even in the logarithms of load and speed. Rollers with more than `_HELD_LOAD` slip up to `_USUAL_RATIO` of
    the ring's speed, lighter ones up to all of it. An error of force counts relative to the force, or to a hundredth of
    the largest at that load where that is more.
    """
    random = np.random.default_rng(1)
    loads = np.exp(random.uniform(math.log(_LEAST_LOAD), math.log(box.highest_load), (_STATES, 1)))
    speeds = np.exp(random.uniform(math.log(box.lowest_speed), math.log(box.highest_speed), (_STATES, 1)))
    held = loads > _HELD_LOAD
    middle = table.merging_ratio
    low = np.arcsinh((np.where(held, -_USUAL_RATIO, -1e-3) - middle) / SLIP_RATIO)
    high = np.arcsinh((np.where(held, _USUAL_RATIO, _LARGEST_RATIO) - middle) / SLIP_RATIO)
    slips = speeds * (middle + SLIP_RATIO * np.sinh(random.uniform(low, high, (_STATES, _SLIPS))))
    states = np.broadcast_to(loads, slips.shape), np.broadcast_to(speeds, slips.shape), slips
    both = np.maximum(*_deviations(contact, table, states))
    return _summary(both)


def _summary(errors: np.ndarray) -> np.ndarray:
    """Median and largest of relative errors, and the share of states at which there is one: elsewhere laws were asked."""
    known = errors[errors > 0.0]
    return np.array([np.median(known), known.max(), known.size / errors.size]) if known.size else np.zeros(3)


def _plane(kernel: Callable, tabled: Callable, highest_load: float, box: TableBox) -> PlaneTable:
    """A table of `kernel`; `tabled(table)` is the same kernel with a table in place of the laws."""
    load = axis(math.log(_LEAST_PLANE_LOAD), math.log(highest_load), _PLANE_LOAD_SPACING)
    bounds = _LEAST_SPEED * box.highest_speed, _MOST_SPEED * box.highest_speed
    speed = axis(math.log(bounds[0]), math.log(bounds[1]), _PLANE_SPEED_SPACING)

    def states(of_axis: Callable) -> list[np.ndarray]:
        return np.meshgrid(np.exp(of_axis(load)), np.exp(of_axis(speed)), indexing="ij")

    values = np.zeros((load.cells + 1, speed.cells + 1, PLANE_CHANNELS))
    values[..., :2] = _at(kernel, states(axis_nodes), 2)
    everywhere = read_only(np.ones((load.cells, speed.cells), dtype=np.bool_))
    table = PlaneTable(load, speed, tensor_coefficients(values, 2), everywhere)
    middles = states(axis_middles)
    good = np.all(np.abs(_at(tabled(table), middles, 2) - _at(kernel, middles, 2)) <= LARGEST_ERROR, axis=-1)
    return table._replace(good=read_only(good))


def film_table(films: Films, raceway: int, box: TableBox) -> PlaneTable:
    """The oil of a raceway contact over ln Q and ln of the mean speed: ln of sliding per slip, ln of rolling resistance.

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

    return _plane(tabled(no_plane_table()), tabled, box.highest_load, box)


def faded_load(films: Films, model: RollerModel, highest_speed: float) -> float:
    """Elastic load [N] from which on films carry nothing beside it, at ring speeds up to the highest one [m/s].

    Films grow with speed, and carry more the less the body force presses on one of them.
    """
    most = abs(model.weight_in_plane) + abs(model.weight_along_axis)
    most += model.centrifugal * (highest_speed / model.outer_radius) ** 2
    found = 1.0
    while not all(faded(films, found, body, highest_speed) for body in (-most, 0.0, most)):
        found *= 1.1
    return found


def cage_table(contact: CurvedContact, box: TableBox) -> tuple[PlaneTable, np.ndarray]:
    """The cage's contact over ln Q and ln |Δu|: ln(F/Δu) and the part of its power that asperities dissipate.

    Returns
    -------
    PlaneTable, ndarray
        With the median and the largest relative error of force at random states, and the share it knows.
    """

    def tabled(table: PlaneTable) -> Callable:
        return partial(cage_values, contact._replace(table=table))

    table = _plane(tabled(no_plane_table()), tabled, box.highest_cage_load, box)
    random = np.random.default_rng(2)
    loads = np.exp(random.uniform(math.log(_LEAST_PLANE_LOAD), math.log(box.highest_cage_load), _STATES))
    slips = box.highest_speed * np.exp(random.uniform(math.log(_LEAST_SPEED), 0.0, _STATES))
    off = _at(tabled(table), (loads, slips), 2) - _at(tabled(no_plane_table()), (loads, slips), 2)
    return table, _summary(np.abs(off[:, 0]))
