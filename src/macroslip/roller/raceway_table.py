"""A raceway contact as a table: what it returns depends on load, ring speed and slip only, and is looked up.

Traction with microslip is smooth, but on scales that differ: slip's falls with the exponential of pressure, and both
sides of the lines of pure rolling matter. The coordinates are ln Q + k Q^(1/3), ln |u2| and asinh((Δu/u2 − x_v)/x_0), with
x_v the ratio of slip to ring speed at which the two lines of pure rolling merge, and the quantities pull/Q, lag/Q^(5/3),
skew/Q^(4/3) and power of asperities/(Q^(5/3) |u2|), cubic splines all four. Traction is odd under (u2, Δu) → (−u2, −Δu).

A cell in which the splines' error is too large is marked; there, as outside the table, the laws themselves are
evaluated. A table changes the time of an evaluation, and results by no more than its measured error.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit_inline
from macroslip.contact.logarithms import exponentials, logarithms
from macroslip.contact.spline import NOWHERE, Axis, cell_of, no_cells
from macroslip.contact.spline_cell import channels_in_cell

#: Ratio of slip to ring speed by which the third coordinate is scaled.
SLIP_RATIO = 6e-4
#: Quantities of a table.
CHANNELS = 4


class RacewayTable(NamedTuple):
    """Table of a raceway contact with microslip.

    Attributes
    ----------
    load, speed, ratio : Axis
        Of ln Q + k Q^(1/3), ln |u2| and asinh((Δu/u2 − x_v)/x_0).
    stretch : float
        k [N^(−1/3)].
    merging_ratio : float
        x_v [-].
    side : float
        1 where the roller's axis is tilted as that of the table's, −1 where the other way: the sign of the skew moment.
    coefficients : ndarray, shape (loads + 2, speeds + 2, ratios + 2, 4)
    good : ndarray of bool, shape of the cells
        Whether the splines are used in a cell in place of the laws.
    """

    load: Axis
    speed: Axis
    ratio: Axis
    stretch: float
    merging_ratio: float
    side: float
    coefficients: np.ndarray
    good: np.ndarray


class TableForce(NamedTuple):
    """What a table gives: whether it holds the state, and force, lag [N], skew moment [N m] and asperities' power [W].

    The slopes are by slip at constant ring speed [N s/m].
    """

    known: bool
    pull: float
    lag: float
    skew: float
    asperity_power: float
    pull_slope: float
    lag_slope: float


class TableSlopes(NamedTuple):
    """What a table gives with all derivatives: by load, ring speed and slip, each at constant others.

    Attributes
    ----------
    known : bool
        Whether the table holds the state.
    value, by_load, by_speed, by_slip : tuple of 3 float
        Force and lag [N] and skew moment [N m], and their derivatives [1/N, s/m].
    asperity_power : float
        [W].
    """

    known: bool
    value: tuple[float, float, float]
    by_load: tuple[float, float, float]
    by_speed: tuple[float, float, float]
    by_slip: tuple[float, float, float]
    asperity_power: float


def no_raceway_table() -> RacewayTable:
    """An empty table."""
    return RacewayTable(NOWHERE, NOWHERE, NOWHERE, 0.0, 0.0, 1.0, *no_cells(3, CHANNELS))


class RacewayPlace(NamedTuple):
    """Where a state lies in a table.

    Attributes
    ----------
    load, speed, ratio : float
        Its coordinates ln Q + k Q^(1/3), ln |u2| and asinh z.
    root_load : float
        Q^(1/3) [N^(1/3)].
    size : float
        √(1 + z²).
    """

    load: float
    speed: float
    ratio: float
    root_load: float
    size: float


@jit_inline
def scaled_ratio(table, ring_speed, slip):
    """The scaled ratio z = (Δu/u2 − x_v)/x_0, √(1 + z²), and |z| + √(1 + z²), whose logarithm is asinh |z|."""
    z = (slip / ring_speed - table.merging_ratio) * (1.0 / SLIP_RATIO)
    size = math.sqrt(z * z + 1.0)
    return z, size, abs(z) + size


@jit_inline
def raceway_place(table, load, log_speed, log_ratio, scaled):
    """A place from ln Q and Q^(1/3), ln |u2| and asinh |z|; `scaled` from `scaled_ratio`.

    Returns
    -------
    RacewayPlace
    """
    log_load, root = load
    return RacewayPlace(
        log_load + table.stretch * root, log_speed, math.copysign(log_ratio, scaled[0]), root, scaled[1]
    )


@jit_inline
def place_of(table, load, ring_speed, slip):
    """Place of Q > 0 [N], u2 [m/s] and Δu [m/s] in a table.

    Returns
    -------
    RacewayPlace
        Outside any table where the shaft is at rest.
    """
    scaled = scaled_ratio(table, ring_speed, slip)
    log_load, log_speed, log_ratio, _ = logarithms(load, abs(ring_speed), scaled[2], 1.0)
    root, _, _, _ = exponentials(log_load * (1.0 / 3.0), 0.0, 0.0, 0.0)
    return raceway_place(table, (log_load, root), log_speed, log_ratio, scaled)


@jit_inline
def _cell_of_place(table, place):
    """Cell of a place, and the places in it; cell −1 where the table does not hold it."""
    nowhere = (-1, -1, -1), (0.0, 0.0, 0.0)
    if table.load.cells == 0:
        return nowhere
    i, t = cell_of(table.load, place.load)
    k, s = cell_of(table.speed, place.speed)
    j, u = cell_of(table.ratio, place.ratio)
    if i < 0 or k < 0 or j < 0 or not table.good[i, k, j]:
        return nowhere
    return (i, k, j), (t, s, u)


@jit_inline
def _grown(scale, power, value, by_coordinate, by_load):
    """Derivative by load of scale · Q · value, where scale · Q goes with the load to `power`."""
    return scale * (value * power + by_coordinate * by_load)


@jit_inline
def table_slopes(table, place, load, ring_speed, slip):
    """Look a state up with all derivatives: its place, Q > 0 [N], u2 [m/s] and Δu [m/s].

    Returns
    -------
    TableSlopes
        Zeros where the table does not hold the state.
    """
    cell, places = _cell_of_place(table, place)
    none = (0.0, 0.0, 0.0)
    if cell[0] < 0:
        return TableSlopes(False, none, none, none, none, 0.0)
    found = channels_in_cell(table.coefficients, cell, places)  # pyright: ignore[reportCallIssue]
    value, first, second, third = found
    sign, root = math.copysign(1.0, ring_speed), place.root_load
    pull, lag, skew = sign * load, sign * load * root * root, sign * table.side * load * root
    by_load = table.load.per_spacing * (1.0 + table.stretch * root * (1.0 / 3.0))
    by_speed = table.speed.per_spacing / ring_speed
    by_slip = table.ratio.per_spacing / (SLIP_RATIO * place.size * ring_speed)
    along = -slip / ring_speed * by_slip
    return TableSlopes(
        True,
        (pull * value[0], lag * value[1], skew * value[2]),
        (
            _grown(pull / load, 1.0, value[0], first[0], by_load),
            _grown(lag / load, 5.0 / 3.0, value[1], first[1], by_load),
            _grown(skew / load, 4.0 / 3.0, value[2], first[2], by_load),
        ),
        (
            pull * (second[0] * by_speed + third[0] * along),
            lag * (second[1] * by_speed + third[1] * along),
            skew * (second[2] * by_speed + third[2] * along),
        ),
        (pull * third[0] * by_slip, lag * third[1] * by_slip, skew * third[2] * by_slip),
        load * root * root * abs(ring_speed) * value[3],
    )


@jit_inline
def table_force(table, place, load, ring_speed, slip):
    """Look a state up; parameters as for `table_slopes`, of which this is a part.

    Returns
    -------
    TableForce
        Zeros where the table does not hold the state.
    """
    found = table_slopes(table, place, load, ring_speed, slip)
    (pull, lag, skew), (pull_slope, lag_slope, _) = found.value, found.by_slip
    return TableForce(found.known, pull, lag, skew, found.asperity_power, pull_slope, lag_slope)
