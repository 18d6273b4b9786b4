"""Look-ups in the tables of a contact, for compiled code: traction, oil, film, and the cage.

A raceway's traction depends on load Q, ring speed u2 and slip v. With U = |u2|, c = v sign u2, the
speed w = √(U² + c²/4 + w0²) and the slip ratio y = 2 c/(w + U), between −4 and 4 and smooth where a
ring comes to rest, a table has the coordinates ln Q + k Q^(1/3), w^(1/4) and asinh((y − y_m)/y_0),
and the quantities pull/Q, lag/Q^(5/3), skew/Q^(4/3) and power of asperities/(Q^(5/3) w). Traction
is odd under (u2, v) → (−u2, −v). Near rest, w ≪ w0, it goes with slip.

Other tables are planes over ln Q and the logarithm of a speed. Beyond the lightest load and the
slowest speed of a table its values there serve; `macroslip.contact.table` makes tables that hold
all heavier and faster states of a case.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit_evaluation, jit_inline
from macroslip.contact.spline import (
    CHANNELS,
    splines_along_first,
    splines_in_cube,
    splines_in_square,
)
from macroslip.elementary import exponential, logarithm

#: w0 [m/s]: speed below which a contact counts as at rest.
REST_SPEED = 1e-6
#: Least speed whose logarithm is taken [m/s], and least load [N].
_LEAST_SPEED = 1e-12
_LEAST_LOAD = 1e-12
#: Size of z below which the inverse hyperbolic sine is its power series, whose coefficients in
#: powers of z² times z are these.
_SMALL_SINE = 0.125
_ARSINH_SERIES = np.array(
    [
        (-0.25) ** n * math.factorial(2 * n) / (math.factorial(n) ** 2 * (2 * n + 1))
        for n in range(9)
    ]
)

#: Evenly spaced nodes of one coordinate, as in `macroslip.contact.spline.Axis`.
AXIS = np.dtype(
    [
        ("first", "f8"),  # coordinate of the first node
        ("per_spacing", "f8"),  # reciprocal of the distance between nodes
        ("cells", "i8"),  # number of cells between the nodes
    ]
)
#: Where a plane stands in the flat array of tables, and its axes.
PLANE = np.dtype(
    [
        ("start", "i8"),  # number of its first coefficient
        ("load", AXIS),  # of ln Q, Q in N
        ("speed", AXIS),  # of ln |u|, u in m/s
    ]
)
#: Where the table of a raceway's traction stands in the flat array, its axes, and its coordinates.
TRACTION = np.dtype(
    [
        ("start", "i8"),  # number of its first coefficient
        ("rising", "i8"),  # number of the first of the slips v/w up to which its moment rises
        ("load", AXIS),  # of ln Q + k Q^(1/3), Q in N
        ("speed", AXIS),  # of w^(1/4), w in m/s
        ("ratio", AXIS),  # of asinh((y − y_m)/y_0)
        ("stretch", "f8"),  # k [N^(−1/3)]
        ("middle", "f8"),  # y_m [-]
        ("scale", "f8"),  # y_0 [-]
        ("side", "f8"),  # sign of the tilt of the roller's axis, which the skew moment has [-]
    ]
)


class ContactLoad(NamedTuple):
    """Normal load of a contact, with its logarithm and cube root."""

    load: float  #: Q [N]
    logarithm: float  #: ln Q [ln N]
    root: float  #: Q^(1/3) [N^(1/3)]


class Traction(NamedTuple):
    """Traction of a raceway contact on the roller."""

    pull: float  #: ∫τ dA [N], with the sign of the slip
    #: ∫τ h/r dA [N]: by so much the moment about the roller's axis, over r, falls short of the pull
    lag: float
    skew: float  #: ∫τ ζ dA [N m]
    asperity_power: float  #: Part of the frictional power that asperities dissipate [W]
    pull_by_slip: float  #: Slope of the pull by v at constant u2 [N s/m]
    lag_by_slip: float  #: Slope of the lag by v at constant u2 [N s/m]
    pull_by_speed: float  #: Slope of the pull by u2 at constant v [N s/m]
    lag_by_speed: float  #: Slope of the lag by u2 at constant v [N s/m]
    pull_by_load: float  #: Slope of the pull by Q [-]
    lag_by_load: float  #: Slope of the lag by Q [-]


@jit_evaluation
def cell_of(axis, coordinate):
    """Cell of a coordinate, the position in it from 0 to 1, and its derivative by the coordinate.

    Beyond the ends the position stays at the end, and the derivative is 0.
    """
    first = axis.first * axis.per_spacing
    position = coordinate * axis.per_spacing
    if position <= first:
        return 0, 0.0, 0.0
    if position >= first + axis.cells:
        return axis.cells - 1, 1.0, 0.0
    cell = int(position - first)
    # Exact near 0, so that slips that are tiny beside the axis stay different: cold oil may grip at
    # 1e-19 of the rings' speed.
    return cell, position - (first + cell), axis.per_spacing


@jit_evaluation
def log_load(load):
    """Ln Q of a load Q ≥ 0 [N]; without load that of the least load."""
    return logarithm(max(load, _LEAST_LOAD))


@jit_evaluation
def log_speed(speed):
    """Ln |u| of a speed [m/s]; at rest that of the least speed."""
    return logarithm(max(abs(speed), _LEAST_SPEED))


@jit_evaluation
def contact_load(load):
    """Load Q > 0 [N] with its logarithm and its cube root."""
    log_load = logarithm(load)
    return ContactLoad(load, log_load, exponential(log_load * (1.0 / 3.0)))


class _PlaneCell(NamedTuple):
    """Cell of a plane, and the position in it."""

    start: int  #: Number of its first coefficient
    stride: int  #: From one node to the next along the load
    t: float  #: Position along the load [-], 0 to 1
    u: float  #: Position along the speed [-], 0 to 1
    load_slope: float  #: Of t by ln Q
    speed_slope: float  #: Of u by ln |u|


@jit_evaluation
def _plane_cell(plane, log_load, log_speed):
    """Cell of a plane at logarithms of load and speed."""
    i, t, load_slope = cell_of(plane.load, log_load)
    j, u, speed_slope = cell_of(plane.speed, log_speed)
    stride = CHANNELS * (plane.speed.cells + 3)
    start = plane.start + i * stride + CHANNELS * j
    return _PlaneCell(start, stride, t, u, load_slope, speed_slope)


@jit_evaluation
def _times(four, factor):
    """Four numbers times a factor."""
    return four[0] * factor, four[1] * factor, four[2] * factor, four[3] * factor


@jit_evaluation
def in_plane(plane, tables, log_load, log_speed):
    """Four quantities of a plane over load and speed, and their derivatives.

    Parameters
    ----------
    plane : record of `PLANE`
        Where the plane stands in the tables, and its axes.
    tables : int or ndarray
        The flat array of tables, or its address.
    log_load : float
        ln Q of the load [N].
    log_speed : float
        ln |u| of the speed [m/s].

    Returns
    -------
    value, by_load, by_speed : tuple of four floats
        The quantities, and their derivatives by ln Q and by ln |u|. Beyond the ends of an axis the
        values at its end serve, and the derivative is 0.
    """
    cell = _plane_cell(plane, log_load, log_speed)
    value, first, second = splines_in_square(tables, cell.start, cell.stride, cell.t, cell.u)  # pyright: ignore[reportCallIssue, reportGeneralTypeIssues]
    return value, _times(first, cell.load_slope), _times(second, cell.speed_slope)


@jit_evaluation
def along_load(plane, tables, log_load, log_speed):
    """Four quantities of a plane over load and speed, and their derivatives by load.

    Parameters
    ----------
    plane : record of `PLANE`
        Where the plane stands in the tables, and its axes.
    tables : int or ndarray
        The flat array of tables, or its address.
    log_load : float
        ln Q of the load [N].
    log_speed : float
        ln |u| of the speed [m/s].

    Returns
    -------
    value, by_load : tuple of four floats
        As those of `in_plane`.
    """
    cell = _plane_cell(plane, log_load, log_speed)
    value, first = splines_along_first(tables, cell.start, cell.stride, cell.t, cell.u)  # pyright: ignore[reportCallIssue, reportGeneralTypeIssues]
    return value, _times(first, cell.load_slope)


class ContactSpeeds(NamedTuple):
    """Speeds of a raceway contact, and the coordinates of the tables that follow from them.

    Contacts of the same ring speed u2 and slip v share them. From `speed` on all are 0 where the
    closed form of traction serves.
    """

    ring: float  #: u2 [m/s]
    slip: float  #: v = Δu in the middle of the contact [m/s]
    mean: float  #: Mean speed of the surfaces u2 − v/2, with its sign [m/s]
    log_mean: float  #: Logarithm of its magnitude [ln m/s]
    speed: float  #: w [m/s]
    root_speed: float  #: w^(1/4) [(m/s)^(1/4)]
    ratio: float  #: y [-]
    speed_by_slip: float  #: ∂w/∂v at |u2| and v sign u2 [-]
    speed_by_ring: float  #: ∂w/∂u2 at |u2| and v sign u2 [-]
    ratio_by_slip: float  #: ∂y/∂v at |u2| and v sign u2 [s/m]
    ratio_by_ring: float  #: ∂y/∂u2 at |u2| and v sign u2 [s/m]


@jit_inline
def contact_speed(ring_speed, slip):
    """Speed w of a raceway contact, by which tables are looked up, √(u2² + Δu²/4) [m/s].

    Parameters
    ----------
    ring_speed : float
        u2 [m/s].
    slip : float
        Δu [m/s].

    Examples
    --------
    >>> contact_speed(0.3, 0.8)
    0.5
    """
    return math.sqrt(ring_speed * ring_speed + 0.25 * slip * slip)


@jit_evaluation
def contact_speeds(ring_speed, slip, closed_form):
    """Speeds of a raceway contact.

    Parameters
    ----------
    ring_speed, slip : float
        u2 and Δu in the middle of the contact [m/s], of either sign.
    closed_form : int
        1 where the closed form of traction serves and no table of traction is looked up.

    Returns
    -------
    ContactSpeeds
    """
    mean = ring_speed - 0.5 * slip
    log_mean = log_speed(mean)
    if closed_form:
        return ContactSpeeds(ring_speed, slip, mean, log_mean, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    ring = abs(ring_speed)
    sliding = slip * math.copysign(1.0, ring_speed)
    speed = math.sqrt(ring * ring + 0.25 * sliding * sliding + REST_SPEED * REST_SPEED)
    per_speed = 1.0 / speed
    per_sum = 1.0 / (speed + ring)
    ratio = 2.0 * sliding * per_sum
    speed_by_slip = 0.25 * sliding * per_speed
    speed_by_ring = ring * per_speed
    return ContactSpeeds(
        ring_speed,
        slip,
        mean,
        log_mean,
        speed,
        math.sqrt(math.sqrt(speed)),
        ratio,
        speed_by_slip,
        speed_by_ring,
        per_sum * (2.0 - ratio * speed_by_slip),
        -ratio * per_sum * (1.0 + speed_by_ring),
    )


@jit_evaluation
def arsinh(z, root):
    """Inverse hyperbolic sine of z, with its root √(1 + z²), to rounding.

    The C library's takes three times as long.

    Examples
    --------
    >>> [round(float(arsinh(z, math.hypot(1.0, z))), 12) for z in (-0.1, 2.0)]
    [-0.099834078899, 1.443635475179]
    """
    if abs(z) < _SMALL_SINE:
        square = z * z
        total = 0.0
        for k in range(_ARSINH_SERIES.size - 1, -1, -1):
            total = total * square + _ARSINH_SERIES[k]
        return total * z
    return math.copysign(logarithm(abs(z) + root), z)


class TractionCell(NamedTuple):
    """Cell of a table of traction, and the position in it."""

    start: int  #: Number of its first coefficient
    strides: tuple[int, int]  #: From one node to the next along load and speed
    position: tuple[float, float, float]  #: Along load, speed and slip ratio [-], 0 to 1
    load_slope: float  #: Of the position along the load by ln Q + k Q^(1/3)
    speed_slope: float  #: Of the position along the speed by w^(1/4)
    ratio_slope: float  #: Of the position along the slip ratio by y


#: What stands for a cell where the closed form serves, and for a plane where it does not.
NO_CELL = TractionCell(0, (0, 0), (0.0, 0.0, 0.0), 0.0, 0.0, 0.0)
NO_PLANE = ((0.0, 0.0, 0.0, 0.0),) * 3


@jit_evaluation
def traction_cell(table, load, speeds):
    """Cell of a contact in its table of traction.

    Contacts look up side by side what their cells are computed for first.

    Parameters
    ----------
    table : record of `TRACTION`
    load : ContactLoad
        Q > 0.
    speeds : ContactSpeeds
        With the coordinates of tables.

    Returns
    -------
    TractionCell
    """
    z = (speeds.ratio - table.middle) / table.scale
    size = math.sqrt(z * z + 1.0)
    stretched_load = load.logarithm + table.stretch * load.root
    i, t, load_slope = cell_of(table.load, stretched_load)
    k, s, speed_slope = cell_of(table.speed, speeds.root_speed)
    j, u, ratio_slope = cell_of(table.ratio, arsinh(z, size))
    inner = CHANNELS * (table.ratio.cells + 3)
    outer = inner * (table.speed.cells + 3)
    start = table.start + i * outer + k * inner + CHANNELS * j
    ratio_slope /= table.scale * size
    return TractionCell(start, (outer, inner), (t, s, u), load_slope, speed_slope, ratio_slope)


@jit_evaluation
def traction(table, tables, load, speeds, cell):
    """Traction of a raceway contact from its table.

    Parameters
    ----------
    table : record of `TRACTION`
    tables : int or ndarray
        The flat array of tables, or its address.
    load : ContactLoad
        Q > 0.
    speeds : ContactSpeeds
        With the coordinates of tables.
    cell : TractionCell

    Returns
    -------
    Traction
    """
    sign = math.copysign(1.0, speeds.ring)
    root = load.root
    value, first, second, third = splines_in_cube(tables, cell.start, cell.strides, cell.position)  # pyright: ignore[reportCallIssue, reportGeneralTypeIssues]
    if speeds.ring == 0.0 and speeds.slip == 0.0:
        # At rest nothing slips; the table has its slowest speed.
        value = (0.0, 0.0, 0.0, 0.0)
    # Derivatives of the coordinates by Q, by w and by y.
    load_slope = cell.load_slope * (1.0 + table.stretch * root * (1.0 / 3.0))
    speed_slope = cell.speed_slope * 0.25 * speeds.root_speed / speeds.speed
    ratio_slope = cell.ratio_slope
    heavy = load.load * root * root
    pull_by_w = load.load * second[0] * speed_slope
    pull_by_y = load.load * third[0] * ratio_slope
    lag_by_w = heavy * second[1] * speed_slope
    lag_by_y = heavy * third[1] * ratio_slope
    return Traction(
        sign * load.load * value[0],
        sign * heavy * value[1],
        sign * table.side * load.load * root * value[2],
        # Where asperities have nearly nothing, splines pass a little below zero.
        heavy * speeds.speed * max(value[3], 0.0),
        # Derivatives by v and by u2 take the sign twice.
        pull_by_w * speeds.speed_by_slip + pull_by_y * speeds.ratio_by_slip,
        lag_by_w * speeds.speed_by_slip + lag_by_y * speeds.ratio_by_slip,
        pull_by_w * speeds.speed_by_ring + pull_by_y * speeds.ratio_by_ring,
        lag_by_w * speeds.speed_by_ring + lag_by_y * speeds.ratio_by_ring,
        sign * (value[0] + first[0] * load_slope),
        sign * root * root * ((5.0 / 3.0) * value[1] + first[1] * load_slope),
    )


@jit_inline
def _nearest_node(axis, coordinate):
    """Number of the node nearest to a coordinate."""
    cell, position, _ = cell_of(axis, coordinate)
    return cell + 1 if position > 0.5 else cell


@jit_inline
def rising_slip(table, tables, load, speed):
    """Slip up to which the moment of the traction on the roller rises with slip.

    Parameters
    ----------
    table : record of `TRACTION`
        Where the table of the raceway's traction stands, and its axes.
    tables : int or ndarray
        The flat array of tables, or its address.
    load : float
        Q [N], ≥ 0.
    speed : float
        Highest speed of the ring, |u2| [m/s].

    Returns
    -------
    float
        Size of the slip [m/s], > 0.
    """
    ln_load = log_load(load)
    stretched = ln_load + table.stretch * exponential(ln_load * (1.0 / 3.0))
    row = _nearest_node(table.load, stretched)
    column = _nearest_node(table.speed, math.sqrt(math.sqrt(speed)))
    columns = table.speed.cells + 1
    return tables[table.rising + row * columns + column] * speed
