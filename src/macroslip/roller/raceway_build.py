"""Make the table of a raceway contact from its laws, and measure how far it is off."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import numpy as np

from macroslip.compiled import jit
from macroslip.contact.spline import axis, axis_middles, axis_nodes, read_only, tensor_coefficients
from macroslip.reference import by_reference
from macroslip.roller.contact_force import CurvedContact, raceway_force
from macroslip.roller.raceway_table import CHANNELS, SLIP_RATIO, RacewayTable
from macroslip.roller.table_box import LARGEST_ERROR, TableBox, error_summary, values_at

#: Part of the largest force at the same load and speed below which an error of force counts as one of this part: a
#: gripped roller's force passes through zero.
_SMALL_FORCE = 0.05
#: Distances between nodes of load, ring speed and slip.
_LOAD_SPACING, _SPEED_SPACING, _RATIO_SPACING = 0.33, 0.055, 0.06
#: Share of the pressure exponent of the middle by which loads are stretched.
_STRETCH = 0.6
#: Least load of a table [N]: the lighter raceway of a free roller carries some newtons of its films.
_LEAST_LOAD = 0.5
#: Ratios of slip to ring speed of a table: from a roller that runs a little ahead to beyond one at rest, near which idle
#: rollers are: next to its ends the splines are less good.
_LEAST_RATIO, _LARGEST_RATIO = -0.02, 1.4
#: Load [N] from which on a roller is held, and the largest ratio of slip to speed it then has; measured on the bundled
#: histories, where rollers above 10 kN slip between −0.006 and 0.001 of the ring's speed.
_HELD_LOAD, _HELD_RATIO = 20e3, 0.02
#: Random loads and speeds at which a finished table is measured, with slips at each, and the largest ratio of slip to
#: speed of a held roller there.
_STATES, _SLIPS, _USUAL_RATIO = 400, 20, 0.006


@jit
def raceway_values(contact, loads, speeds, slips, values):
    """Write what a table holds at states of Q [N], u2 > 0 [m/s] and Δu [m/s], shape (states, 4); NaN for loads of NaN."""
    contact = by_reference(contact)
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
    Held rollers do not slip as much as light ones; the table's values for such states are not used.
    """
    shape, fluid = contact.shape, contact.traction.table.fluid
    stretch = _STRETCH * fluid.exponent * fluid.index / fluid.reference_pressure * contact.traction.pressure
    merging = shape.spin_ratio**2 * shape.contour_radius / (2.0 * shape.curvature_ratio)
    lightest, heaviest = (math.log(q) + stretch * q ** (1.0 / 3.0) for q in (_LEAST_LOAD, box.highest_load))
    load = axis(lightest, heaviest, _LOAD_SPACING)
    speed = axis(math.log(box.lowest_speed), math.log(box.highest_speed), _SPEED_SPACING)
    least, largest = (math.asinh((x - merging) / SLIP_RATIO) for x in (_LEAST_RATIO, _LARGEST_RATIO))
    ratio = axis(least, largest, _RATIO_SPACING)

    def states(of_axis: Callable) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        ratios = merging + SLIP_RATIO * np.sinh(of_axis(ratio))
        grid = np.meshgrid(_loads_at(of_axis(load), stretch), np.exp(of_axis(speed)), ratios, indexing="ij")
        loads = np.where((grid[0] > _HELD_LOAD) & (grid[2] > _HELD_RATIO), np.nan, grid[0])
        return loads, grid[1], grid[1] * grid[2]

    values = values_at(partial(raceway_values, contact), states(axis_nodes), CHANNELS)
    # Along the slip the last known value is repeated.
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
    expected = values_at(partial(raceway_values, contact), states, CHANNELS)
    found = values_at(partial(raceway_values, contact._replace(table=table)), states, CHANNELS)
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
    """Median and largest relative error of force and power at usual random states, and the share that the table holds.

    States are even in the logarithms of load and speed. Rollers with more than `_HELD_LOAD` slip up to `_USUAL_RATIO` of
    the ring's speed, lighter ones up to all of it. An error of force counts as when cells are judged.
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
    return error_summary(both)
