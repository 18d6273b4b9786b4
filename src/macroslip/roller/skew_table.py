"""Skew of a roller as a table over load, speed and skew, for compiled functions.

From it follows the skew at which a roller is in equilibrium.

The table is made for a roller of the downwind row with the shaft forward (u2 < 0). Skew and moment
change their signs with the row, and with the direction of turning; tilt, shift and axial force with
the row alone, slip with the direction alone.

A roller that the rings press turns from ψ = 0 the way its net moment drives it, to the first skew
at which the moment of a spar that presses on it holds it, or to its stop. It takes tenths of a
second, and is taken to be there at once.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from macroslip.compiled import jit, jit_inline
from macroslip.contact.look_up import cell_of
from macroslip.contact.spline import CHANNELS, Axis, spline_coefficients, splines_in_cube
from macroslip.contact.table import Box, contact_parts, ends_of_parts, stored_sheet, table_gaps
from macroslip.errors import MacroslipError
from macroslip.roller.skew import LARGEST_SKEW, Equilibrium, SkewStop, equilibrium, raceways
from macroslip.storage.tables import remembered, table_key
from macroslip.storage.waiting import TABLES, tell

if TYPE_CHECKING:
    from macroslip.bearing import Bearing
    from macroslip.contact.laws import PreparedLaws

#: Lightest load [N], distances between nodes of ln Q, u^¼ [(m/s)^¼] and asinh(ψ/ψ0), and ψ0 [rad].
_LIGHTEST = 2e3
_LOAD = 0.2
_SPEED = 0.06
_SKEW = 0.3
_SCALE = 2e-4
#: Least speed of a table as part of the fastest; below it, powers are in proportion to speed, and
#: moments do not change.
_SLOWEST = 0.1
#: Iterations for an equilibrium between two nodes.
_ITERATIONS = 6


class SkewTable(NamedTuple):
    """Tables of a skewed roller's forces, moments and powers: three cubes of four splines each.

    The first has the moment about the contact normal, the added powers of both raceways and the
    axial force; the second tilt, moment of the inner raceway, push along the orbit and axial shift;
    the third the added slip and the added powers of the asperities.
    """

    tables: np.ndarray  #: Coefficients of the three cubes, one after another
    size: int  #: Numbers of a cube
    load: Axis  #: Of ln Q, Q in N
    speed: Axis  #: Of u^¼, u = |u2| in m/s
    skew: Axis  #: Of asinh(ψ/ψ0)


class Guide(NamedTuple):
    """Skew guidance of the rollers of one row by the cage."""

    side: float  #: Axial sign s of the row [-]
    largest: float  #: Largest skew [rad]
    arm: float  #: Moment of the two spars over the force of either, at the stop [m]
    effective_radius: float  #: Moment of one spar over its force and the skew [m/rad]


class Turned(NamedTuple):
    """A roller at its equilibrium skew, or against a stop."""

    skew: float  #: ψ [rad]
    stop_moment: float  #: Moment about +y' that its stop carries [N m]; 0 away from it
    inner_power: float  #: Power that skew adds at the inner raceway [W]
    outer_power: float  #: Power that skew adds at the outer raceway [W]
    axial: float  #: Force on the inner ring along z' [N]
    tilt: float  #: θ [rad]
    inner_moment: float  #: Moment of the inner raceway about +y' [N m]
    outer_moment: float  #: Moment of the outer raceway about +y' [N m]
    unbalanced: float  #: Size of the moment about +y' that neither spar nor stop carries [N m]
    shift: float  #: δ [m]
    slip: float  #: Slip that skew adds to Δu [m/s]
    inner_rough: float  #: Power that skew adds to the inner raceway's asperities [W]
    outer_rough: float  #: Power that skew adds to the outer raceway's asperities [W]


def skew_table(laws: PreparedLaws, bearing: Bearing, box: Box) -> SkewTable:
    """Skew table of a bearing's rollers, made or read from the cache.

    Raises MacroslipError where no equilibrium was found.

    Parameters
    ----------
    laws : PreparedLaws
        Of the downwind row.
    box : Box
        States that it holds; loads below 2 kN have the forces and powers of 2 kN in proportion to
        theirs.
    """
    slowest = max(box.slowest, _SLOWEST * box.fastest) ** 0.25
    first = max(math.floor(slowest / _SPEED), 1)  # at rest there is no slip, and no equilibrium
    last = max(math.ceil(box.fastest**0.25 / _SPEED), first + 4)
    end = math.ceil(math.asinh(LARGEST_SKEW / _SCALE) / _SKEW)
    range_of_logarithm = math.log(max(box.load / _LIGHTEST, 4.0))
    load = Axis(math.log(_LIGHTEST), 1.0 / _LOAD, math.ceil(range_of_logarithm / _LOAD))
    skew = Axis(-end * _SKEW, 1.0 / _SKEW, 2 * end)
    speed = Axis(first * _SPEED, 1.0 / _SPEED, last - first)
    axes = load, speed, skew
    (first_gap, first_weight), *other_gaps = table_gaps(laws.inner, box)
    cubes = first_weight * _cubes(laws, first_gap, bearing, axes)
    for gap, weight in other_gaps:
        cubes = cubes + weight * _cubes(laws, gap, bearing, axes)
    return SkewTable(cubes.ravel(), cubes[0].size, load, speed, skew)


def _cubes(
    laws: PreparedLaws, oil_gap: float, bearing: Bearing, axes: tuple[Axis, Axis, Axis]
) -> np.ndarray:
    """Coefficients of three cubes with inlets full from a gap on [m], shape (3, coefficients).

    Made or from store.
    """
    load, speed, skew = axes
    laws = laws._replace(inner=laws.inner.at_gap(oil_gap), outer=laws.outer.at_gap(oil_gap))
    pair = raceways(laws, bearing, 1)
    numbers = []
    for contact in pair:
        geometry = tuple(contact)[2:]
        numbers.append((contact_parts(contact.laws), geometry, contact.laws.rolling))
    key = table_key("skew", tuple(numbers), load.first, load.per_spacing, skew)
    first = round(speed.first / _SPEED)
    loads = np.exp(load.nodes)
    ends = ends_of_parts(load, math.log)

    def make() -> np.ndarray:
        sheets = []
        for n in range(first, first + speed.cells + 1):
            sheets.append(
                stored_sheet(
                    (key, n),
                    loads,
                    ends,
                    lambda part, at=(n * _SPEED) ** 4: _sheet(laws, bearing, part, skew, at),
                )
            )
            tell(TABLES, len(sheets), speed.cells + 1)
        nodes = np.stack(sheets, axis=1)
        cubes = []
        for channel in (0, 4, 8):
            quantities = nodes[..., channel : channel + CHANNELS]
            cubes.append(spline_coefficients(quantities, 3).ravel())
        return np.stack(cubes)

    return remembered(table_key(key, load, speed), make)


def _sheet(
    laws: PreparedLaws, bearing: Bearing, loads: np.ndarray, skew: Axis, speed: float
) -> np.ndarray:
    """Quantities of the table at loads [N] and all skews at one speed, shape (loads, skews, 12)."""
    angles = _SCALE * np.sinh(skew.nodes[skew.cells // 2 :])
    pair = raceways(laws, bearing, 1)
    both = np.array([-1.0, 1.0])[:, None]
    states: list[Equilibrium] = []
    for angle in angles:
        start = states[-1] if states else None
        at = equilibrium(pair, laws, loads, -speed, both * angle, start)
        unknown = np.isnan(at.slip).any(axis=0)
        if unknown.any():
            worst = loads[unknown].max()
            raise MacroslipError(
                f"no equilibrium of a skewed roller was found at {worst:.4g} N, {speed:.3g} m/s and {1e3 * angle:.3g} mrad. "
                "This is a defect of the solver; please report it with the bearing and the oil."
            )
        states.append(at)
    quantities = [_scaled(state, states[0], loads, speed) for state in states]
    negative, positive = np.stack(quantities, axis=2)
    return np.concatenate([negative[:, :0:-1], positive], axis=1)


def _scaled(at: Equilibrium, straight: Equilibrium, load: np.ndarray, speed: float) -> np.ndarray:
    """Quantities of the table, shape (2, loads, 12)."""
    per_moment = load ** (-4.0 / 3.0)
    per_power = 1.0 / (load * speed)[:, None]
    added = (at.power - straight.power) * per_power
    rough = (at.asperity_power - straight.asperity_power) * per_power
    slip = (at.slip - straight.slip) / speed
    inner_moment = at.moments[..., 0] * per_moment
    unused = np.zeros_like(at.slip)
    return np.stack(
        [
            at.moment * per_moment, added[..., 0], added[..., 1], at.axial / load,
            at.tilt, inner_moment, at.push / load, at.shift,
            slip, rough[..., 0], rough[..., 1], unused,
        ],
        axis=-1,
    )  # fmt: skip


@jit_inline
def _at(table, part, load, speed, coordinate):
    """Four quantities of a cube of the table at given load, speed and skew."""
    j, u, _ = cell_of(table.skew, coordinate)
    inner = CHANNELS * (table.skew.cells + 3)
    outer = inner * (table.speed.cells + 3)
    row, t = load
    column, s = speed
    start = part * table.size + row * outer + column * inner + CHANNELS * j
    value, _, _, _ = splines_in_cube(table.tables, start, (outer, inner), (t, s, u))  # pyright: ignore[reportCallIssue, reportGeneralTypeIssues]
    return value


@jit_inline
def raceway_push(table, load, ring_speed):
    """Force of the raceways on a straight roller along the orbit [N].

    It presses the roller on a spar beside weight and drag.
    """
    i, t, _ = cell_of(table.load, math.log(load))
    k, s, _ = cell_of(table.speed, math.sqrt(math.sqrt(abs(ring_speed))))
    _, _, push, _ = _at(table, 1, (i, t), (k, s), 0.0)
    return -math.copysign(load, ring_speed) * push


@jit_inline
def _arm(guide, coordinate):
    """Straightening moment of a spar over its force at a coordinate of skew [m]."""
    skew = _SCALE * math.sinh(coordinate)
    return min(guide.effective_radius * skew, 0.5 * guide.arm)


@jit_inline
def _net_moment(table, guide, row, column, way, press, coordinate):
    """Net skew moment over Q^(4/3) at a coordinate of skew [N m/N^(4/3)]; > 0 turns it further."""
    moment, _, _, _ = _at(table, 0, row, column, way * coordinate)
    return way * moment - press * _arm(guide, coordinate)


@jit_inline
def _equilibrium_skew(table, guide, row, column, way, press, moment):
    """Smallest equilibrium skew, as a coordinate; True if the roller is at the stop.

    `moment` is the net skew moment without skew over Q^(4/3), > 0 where the roller turns.
    """
    end = math.asinh(guide.largest / _SCALE)
    low = 0.0
    high = 0.0
    excess = moment
    beyond = moment
    while beyond > 0.0 and high < end:
        low = high
        excess = beyond
        high = min(low + 1.0 / table.skew.per_spacing, end)
        beyond = _net_moment(table, guide, row, column, way, press, high)
    if beyond > 0.0 or high <= 0.0:
        return high, beyond > 0.0
    # Regula falsi, which halves the value at an end that stays (Illinois).
    side = 0
    coordinate = low + (high - low) * excess / (excess - beyond)
    for _ in range(_ITERATIONS):
        net = _net_moment(table, guide, row, column, way, press, coordinate)
        if net > 0.0:
            low = coordinate
            excess = net
            beyond = 0.5 * beyond if side > 0 else beyond
            side = 1
        else:
            high = coordinate
            beyond = net
            excess = 0.5 * excess if side < 0 else excess
            side = -1
        coordinate = low + (high - low) * excess / (excess - beyond)
    return coordinate, beyond > 0.0


@jit
def turned(table, guide, load, ring_speed, push):
    """Equilibrium skew of a roller under its skew moment and a spar, with the forces there.

    Parameters
    ----------
    table : SkewTable
    guide : Guide
    load : float
        Elastic load Q > 0 [N].
    ring_speed : float
        u2 [m/s].
    push : float
        Force with which a spar presses on the roller [N], of either sign.

    Returns
    -------
    Turned
    """
    size = abs(ring_speed)
    i, t, _ = cell_of(table.load, math.log(load))
    k, s, _ = cell_of(table.speed, math.sqrt(math.sqrt(size)))
    row = (i, t)
    column = (k, s)
    heavy = load ** (4.0 / 3.0)
    press = abs(push) / heavy
    straight_moment, _, _, _ = _at(table, 0, row, column, 0.0)
    way = math.copysign(1.0, straight_moment)
    coordinate, stops = _equilibrium_skew(
        table, guide, row, column, way, press, way * straight_moment
    )
    at = way * coordinate
    # As `_scaled` has them: moment, powers and force; tilt, moment, push and shift; changes.
    forces = _at(table, 0, row, column, at)
    stance = _at(table, 1, row, column, at)
    changes = _at(table, 2, row, column, at)
    moment = forces[0]
    inner_moment = stance[1]
    angle = way * _SCALE * math.sinh(coordinate)
    residual = heavy * (moment - way * press * _arm(guide, coordinate))
    stop_moment = residual if stops else 0.0
    unbalanced = 0.0 if stops else abs(residual)
    # Straight, nothing is added, not even by rounding.
    tilt = 0.0
    shift = 0.0
    slip = 0.0
    power = 0.0
    axial = 0.0
    if coordinate > 0.0:
        power = load * size
        axial = guide.side * load * forces[3]
        tilt = guide.side * stance[0]
        shift = guide.side * stance[3]
        slip = -ring_speed * changes[0]
    mirror = -guide.side * math.copysign(1.0, ring_speed)
    return Turned(
        mirror * angle, mirror * stop_moment, power * forces[1], power * forces[2], axial, tilt,
        mirror * heavy * inner_moment, mirror * heavy * (moment - inner_moment), unbalanced,
        shift, slip, power * changes[1], power * changes[2],
    )  # fmt: skip


def guide_of(stop: SkewStop, axial_sign: int) -> Guide:
    """Cage guidance of the rollers of a row."""
    return Guide(float(axial_sign), stop.largest, stop.arm, stop.effective_radius)
