"""Sheets of the tables of a raceway contact: all loads and slips at one ring speed, made from the contact's laws.

The speeds of sheets are the same for all cases, so that cases of one bearing, oil and laws share their sheets, whatever
range of speeds each has.
"""

from __future__ import annotations

import math
import time
from functools import partial
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit
from macroslip.contact.spline import Axis, axis, axis_middles, axis_nodes, spline_coefficients
from macroslip.contact.table_store import stored, table_key
from macroslip.reference import by_reference
from macroslip.roller.contact_force import CurvedContact, raceway_force
from macroslip.roller.raceway_table import CHANNELS, SLIP_RATIO, no_raceway_table
from macroslip.roller.table_box import SPEED_SPACING, values_at

#: Distances between nodes of load and slip.
_LOAD_SPACING, _RATIO_SPACING = 0.33, 0.06
#: Share of the pressure exponent of the middle by which loads are stretched.
_STRETCH = 0.6
#: Least load of a table [N]: the lighter raceway of a free roller carries some newtons of its films.
LEAST_LOAD = 0.5
#: Ratios of slip to ring speed of a table: from a roller that runs a little ahead to beyond one at rest, near which idle
#: rollers are: next to its ends the splines are less good.
_LEAST_RATIO, LARGEST_RATIO = -0.02, 1.4
#: Load [N] from which on a roller is held, and the largest ratio of slip to speed it then has; measured on the bundled
#: histories, where rollers above 10 kN slip between −0.006 and 0.001 of the ring's speed.
HELD_LOAD, _HELD_RATIO = 20e3, 0.02


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


class SheetAxes(NamedTuple):
    """Coordinates of a contact's sheets.

    Attributes
    ----------
    load, ratio : Axis
        Of ln Q + k Q^(1/3) and of asinh((Δu/u2 − x_v)/x_0).
    stretch : float
        k [N^(−1/3)].
    merging_ratio : float
        x_v [-].
    """

    load: Axis
    ratio: Axis
    stretch: float
    merging_ratio: float

    def loads(self, coordinates: np.ndarray) -> np.ndarray:
        """Loads of the given coordinates [N], by Newton's iteration in the logarithm, in which they are concave."""
        logarithm = np.array(coordinates)
        for _ in range(100):
            root = np.exp(logarithm / 3.0)
            logarithm -= (logarithm + self.stretch * root - coordinates) / (1.0 + self.stretch * root / 3.0)
        return np.exp(logarithm)

    def ratios(self, coordinates: np.ndarray) -> np.ndarray:
        """Ratios Δu/u2 of the given coordinates."""
        return self.merging_ratio + SLIP_RATIO * np.sinh(coordinates)


class Sheet(NamedTuple):
    """A sheet.

    Attributes
    ----------
    coefficients : ndarray, shape (loads + 2, ratios + 2, 4)
        Of the splines over load and slip through the values at its speed.
    middles : ndarray, shape (loads − 1, ratios − 1, 4)
        Values in the middles of the cells of load, slip and speed between this sheet and the next.
    seconds : ndarray, shape (1,)
        Processor time it took to make [s].
    """

    coefficients: np.ndarray
    middles: np.ndarray
    seconds: np.ndarray


def bare(contact: CurvedContact) -> CurvedContact:
    """The contact without a table, its roller's axis tilted to the positive side."""
    shape = contact.shape._replace(spin_ratio=abs(contact.shape.spin_ratio))
    return contact._replace(shape=shape, table=no_raceway_table())


def sheet_axes(contact: CurvedContact, highest_load: float) -> SheetAxes:
    """Axes of the sheets of a contact up to a load [N]."""
    shape, fluid = contact.shape, contact.traction.table.fluid
    stretch = _STRETCH * fluid.exponent * fluid.index / fluid.reference_pressure * contact.traction.pressure
    merging = shape.spin_ratio**2 * shape.contour_radius / (2.0 * shape.curvature_ratio)
    lightest, heaviest = (math.log(q) + stretch * q ** (1.0 / 3.0) for q in (LEAST_LOAD, highest_load))
    least, largest = (math.asinh((x - merging) / SLIP_RATIO) for x in (_LEAST_RATIO, LARGEST_RATIO))
    return SheetAxes(axis(lightest, heaviest, _LOAD_SPACING), axis(least, largest, _RATIO_SPACING), stretch, merging)


def made_sheet(contact: CurvedContact, axes: SheetAxes, number: int) -> Sheet:
    """The sheet at ln u2 = `number` spacings, from the contact's laws.

    Parameters
    ----------
    contact : CurvedContact
        From `bare`.
    axes : SheetAxes
    number : int

    Notes
    -----
    Held rollers do not slip as much as light ones; what a sheet has for such states is not used.
    """
    # Compilation, at the first sheet after installation, is no part of the time.
    raceway_values(contact, *np.full((3, 1), np.nan), np.empty((1, CHANNELS)))
    started = time.thread_time()

    def values(of_axis, speed: float) -> np.ndarray:
        loads, ratios = np.meshgrid(axes.loads(of_axis(axes.load)), axes.ratios(of_axis(axes.ratio)), indexing="ij")
        loads = np.where((loads > HELD_LOAD) & (ratios > _HELD_RATIO), np.nan, loads)
        return values_at(
            partial(raceway_values, contact), (loads, np.full(loads.shape, speed), speed * ratios), CHANNELS
        )

    nodes = values(axis_nodes, math.exp(number * SPEED_SPACING))
    # Along the slip the last known value is repeated.
    last = np.maximum.accumulate(np.where(np.isnan(nodes[..., :1]), 0, np.arange(nodes.shape[1])[:, None]), axis=1)
    nodes = np.take_along_axis(nodes, np.broadcast_to(last, nodes.shape), axis=1)
    for dimension in (0, 1):
        nodes = spline_coefficients(nodes, dimension)
    middles = values(axis_middles, math.exp((number + 0.5) * SPEED_SPACING))
    return Sheet(nodes, middles, np.array([time.thread_time() - started]))


def stored_sheets(contact: CurvedContact, axes: SheetAxes, numbers: range, key: str) -> list[Sheet]:
    """Sheets by number, from the store or made; `key` is that of the contact."""

    def one(number: int) -> Sheet:
        return Sheet(*stored(table_key(key, axes, number), lambda: made_sheet(contact, axes, number)))

    return [one(number) for number in numbers]
