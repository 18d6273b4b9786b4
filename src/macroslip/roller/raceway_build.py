"""Make the table of a raceway contact from its sheets, and measure how far it is off."""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from macroslip.contact.spline import Axis, axis_middles, middle_values, read_only, spline_coefficients
from macroslip.contact.table_store import remembered, table_key
from macroslip.roller.contact_force import CurvedContact
from macroslip.roller.raceway_sheets import (
    HELD_LOAD,
    LARGEST_RATIO,
    LEAST_LOAD,
    Sheet,
    SheetAxes,
    bare,
    raceway_values,
    sheet_axes,
    stored_sheets,
)
from macroslip.roller.raceway_table import CHANNELS, SLIP_RATIO, RacewayTable
from macroslip.roller.table_box import LARGEST_ERROR, SPEED_SPACING, TableBox, error_summary, values_at

#: Part of the largest force at the same load and speed below which an error of force counts as one of this part: a
#: gripped roller's force passes through zero.
_SMALL_FORCE = 0.05
#: Cells of speed of a table, at least, and beyond the speeds of its box: next to its ends the splines are less good.
_LEAST_CELLS, _BEYOND = 4, 1
#: Random loads and speeds at which a finished table is measured, with slips at each, and the largest ratio of slip to
#: speed of a held roller there.
_STATES, _SLIPS, _USUAL_RATIO = 200, 10, 0.006


def sheet_numbers(box: TableBox) -> range:
    """Numbers of the sheets of a table for the speeds of a box, one more than the table has cells.

    Examples
    --------
    >>> sheet_numbers(TableBox(1e4, 1e3, math.exp(-18 * SPEED_SPACING), math.exp(-12 * SPEED_SPACING)))
    range(-19, -10)
    """
    # Speeds of a box are those of sheets, but for rounding.
    first = math.floor(math.log(box.lowest_speed) / SPEED_SPACING + 1e-6) - _BEYOND
    last = math.ceil(math.log(box.highest_speed) / SPEED_SPACING - 1e-6) + _BEYOND
    missing = max(_LEAST_CELLS - (last - first), 0)
    return range(first - missing // 2, last + (missing + 1) // 2 + 1)


def raceway_table(contact: CurvedContact, box: TableBox) -> tuple[RacewayTable, np.ndarray, float]:
    """The table of a raceway contact with microslip, made, or from what was made before.

    Parameters
    ----------
    contact : CurvedContact
    box : TableBox

    Returns
    -------
    RacewayTable, ndarray, float
        With its errors as from `error_summary`, and the processor time that its sheets took to make [s].
    """
    alike = bare(contact)
    key = table_key(alike)

    def make() -> tuple[RacewayTable, np.ndarray, float]:
        axes, numbers = sheet_axes(alike, box.highest_load), sheet_numbers(box)
        sheets = stored_sheets(alike, axes, numbers, key)
        table = from_sheets(alike, axes, numbers, sheets)
        return table, raceway_errors(alike, table, box), float(sum(one.seconds[0] for one in sheets))

    return remembered(table_key(key, box), make)


def from_sheets(contact: CurvedContact, axes: SheetAxes, numbers: range, sheets: list[Sheet]) -> RacewayTable:
    """The table of the sheets of these numbers, which follow one another."""
    along_speed = np.stack([one.coefficients for one in sheets], axis=1)
    coefficients = read_only(spline_coefficients(along_speed, 1))
    speed = Axis(numbers[0] * SPEED_SPACING, 1.0 / SPEED_SPACING, len(numbers) - 1)
    force, power = _deviations(
        contact,
        (
            axes.loads(axis_middles(axes.load))[:, None, None],
            axes.ratios(axis_middles(axes.ratio)),
        ),
        np.stack([one.middles for one in sheets[:-1]], axis=1),
        middle_values(coefficients, 3),
    )
    good = (force <= LARGEST_ERROR) & (power <= LARGEST_ERROR)  # NaN is no good
    return RacewayTable(
        axes.load, speed, axes.ratio, axes.stretch, axes.merging_ratio, 1.0, coefficients, read_only(good)
    )


def _deviations(
    contact: CurvedContact, states: tuple[np.ndarray, np.ndarray], expected: np.ndarray, found: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Relative errors of force and power of what a table holds, shape (..., slips, 4), at loads and ratios of slip."""
    loads, ratios = states
    root = np.cbrt(loads)
    shape = contact.shape
    curvature = shape.curvature_ratio * shape.roller_radius

    def spin_and_power(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        lag = values[..., 1] * root**2
        spin = values[..., 0] - lag
        return spin, ratios * spin + curvature * lag - shape.spin_ratio * values[..., 2] * root

    spin, power = spin_and_power(expected)
    found_spin, found_power = spin_and_power(found)
    off = np.maximum(np.abs(found_spin - spin), np.abs(found[..., 0] - expected[..., 0]))
    # Where held rollers do not go nothing is expected.
    largest = np.nanmax(np.abs(spin), axis=-1, keepdims=True)
    # Asperities dissipate a small part of the power; an error of it counts as one of the power.
    rough = np.abs(found[..., 3] - expected[..., 3]) * root**2
    power_off = np.maximum(np.abs(found_power - power), rough)
    return off / np.maximum(np.abs(spin), _SMALL_FORCE * largest), power_off / power


def raceway_errors(contact: CurvedContact, table: RacewayTable, box: TableBox) -> np.ndarray:
    """Median and largest relative error of force and power at usual random states, and the share that the table holds.

    States are even in the logarithms of load and speed. Rollers with more than `HELD_LOAD` slip up to `_USUAL_RATIO` of
    the ring's speed, lighter ones up to all of it. An error of force counts as when cells are judged.
    """
    random = np.random.default_rng(1)
    loads = np.exp(random.uniform(math.log(LEAST_LOAD), math.log(box.highest_load), (_STATES, 1)))
    speeds = np.exp(random.uniform(math.log(box.lowest_speed), math.log(box.highest_speed), (_STATES, 1)))
    held = loads > HELD_LOAD
    middle = table.merging_ratio
    low = np.arcsinh((np.where(held, -_USUAL_RATIO, -1e-3) - middle) / SLIP_RATIO)
    high = np.arcsinh((np.where(held, _USUAL_RATIO, LARGEST_RATIO) - middle) / SLIP_RATIO)
    ratios = middle + SLIP_RATIO * np.sinh(random.uniform(low, high, (_STATES, _SLIPS)))
    states = np.broadcast_to(loads, ratios.shape), np.broadcast_to(speeds, ratios.shape), speeds * ratios
    expected, found = (
        values_at(partial(raceway_values, one), states, CHANNELS) for one in (contact, contact._replace(table=table))
    )
    return error_summary(np.maximum(*_deviations(contact, (loads, ratios), expected, found)))
