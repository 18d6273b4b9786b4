"""Tables of a roller's contacts, made from laws: their box, their nodes and their errors.

Cubic splines over load, speed and slip; `macroslip.contact.look_up` has the coordinates. All of a
case's tables stand in one flat array. The nodes of a raceway's traction are made sheet by sheet,
one for each w^(1/4), at speeds that are the same for all cases alike, so that they share their
files on disk.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from macroslip.contact.kellstroem import SaturatingFriction, saturating_patch
from macroslip.contact.laws import PreparedContact
from macroslip.contact.look_up import REST_SPEED
from macroslip.contact.patch import Patch, patch_of, patch_tractions
from macroslip.contact.rolling import light_contact, rigid_pocket_contact
from macroslip.contact.spline import CHANNELS, Axis, axis, spline_coefficients
from macroslip.contact.starvation import shared_gaps
from macroslip.contact.strips import PreparedStrips
from macroslip.contact.traction import chord_table
from macroslip.storage.tables import remembered, stored, table_key
from macroslip.storage.waiting import TABLES, tell

#: Distances between nodes of a raceway's traction at the default tolerance, 2e-4: of ln Q + k
#: Q^(1/3), of asinh, and of w^(1/4) for the fastest speed of the box of 1 m/s.
_LOAD_SPACING = 0.46
_RATIO_SPACING = 0.06
_SPEED_SPACING = 0.018
#: Factors on these and other distances of the tables for tight and for loose tolerances.
FINEST = 0.5
COARSEST = 2.0
#: Share of the pressure exponent of the middle by which loads are stretched.
_STRETCH = 0.6
#: Least load of a raceway's traction and of other tables [N]; the lighter raceway of a free roller
#: carries some newtons of its films. Below, traction goes with load.
_LEAST_LOAD = 0.05
_LIGHTEST = 1e-3
#: Load up to which the parts of a sheet of traction that are stored together reach at first [N].
_FIRST_PART = 65536.0
#: Slip ratio by which asinh is scaled with microslip, which varies by as much over a contact.
_MICROSLIP = 6e-4
#: The same of a line contact, where only the profile slips.
_LITTLE_MICROSLIP = 6e-5
#: Slip ratio of a roller that spins while the ring is at rest.
_LARGEST_RATIO = 4.0
#: Slip ratio at which rolling comes to rest, v = 2 u2.
_NO_ENTRAINMENT = 4.0 * (math.sqrt(2.0) - 1.0)
#: Part of the Newtonian force that is missing at the slip by which asinh is scaled without
#: microslip.
_BENT = 0.05
#: Distances between nodes of ln Q and ln u of planes, and their least speed as part of the fastest.
_PLANE_LOAD = 0.1
_PLANE_SPEED = 0.05
_SLOWEST = 1e-4
#: Nodes beyond the states of the box: next to its ends a spline is less good.
_BEYOND = 1
#: Part of the largest force or power at the same load and speed below which an error counts as one
#: of this part: a gripped roller's force passes through zero.
_SMALL_FORCE = 0.05
#: Random loads and speeds at which a table is measured, with slips at each; load [N] from which on
#: a roller is held, and its slip ratio there; and the largest slip ratio of lighter ones.
_STATES = 200
_SLIPS = 10
_HELD_LOAD = 20e3
_HELD_RATIO = 0.006
_MOST_RATIO = 1.2


class Box(NamedTuple):
    """States that the tables of a case hold."""

    load: float  #: Highest load of a raceway or the cage [N]
    slowest: float  #: Least w, the speed of a contact (`macroslip.contact.look_up`) [m/s]
    fastest: float  #: Largest w [m/s]
    fineness: float  #: Distances between nodes over those at the default tolerance


def table_box(
    ring_speeds: np.ndarray, highest_load: float, tolerance: float, falling: float = 0.0
) -> Box:
    """Range of states that the tables of a case hold, rounded outward.

    Cases alike then share their tables. u2 is linear between all load samples, at which it is
    given.

    Parameters
    ----------
    ring_speeds : ndarray
        u2 at the load samples [m/s], of either sign.
    highest_load : float
        Largest load of a roller, with weight and centrifugal force [N].
    tolerance : float
        Tolerance of the integrator [-]; the error of a spline goes with the fourth power of the
        distance between its nodes.
    falling : float
        Speed that a roller reaches by itself, however slow the rings are [m/s], ≥ 0.

    Returns
    -------
    Box
        Highest load [N], speeds [m/s] and fineness [-].

    Examples
    --------
    >>> table_box(np.array([-0.40, -0.38]), 5e4, 2e-4)
    Box(load=65536.0, slowest=0.38, fastest=0.46, fineness=1.0)
    """
    speeds = np.abs(ring_speeds)
    fastest = max(float(speeds.max()), 10.0 * REST_SPEED, falling)
    turns = float(ring_speeds.min()) * float(ring_speeds.max()) <= 0.0
    slowest = 0.0 if turns else float(speeds.min())
    load = 2.0 ** math.ceil(math.log2(1.02 * highest_load + 100.0))
    # In steps of √2.
    spacing = (tolerance / 2e-4) ** 0.25
    steps = round(2.0 * math.log2(spacing))
    fineness = min(max(2.0 ** (0.5 * steps), FINEST), COARSEST)
    # A roller at rest has w = 1.12 u2; one that still runs forward when the ring runs back 1.41 u2.
    margin = 1.45 if turns else 1.15
    return Box(load, slowest, round(margin * fastest, 12), fineness)


def larger(box: Box) -> Box:
    """Box with twice the load and 1.5 times the speed, for a state outside this one."""
    return box._replace(load=2.0 * box.load, slowest=0.0, fastest=1.5 * box.fastest)


class Tables:
    """The flat array of a case's tables, while it is filled."""

    def __init__(self) -> None:
        self._parts: list[np.ndarray] = []
        self._size = 0

    def add(self, values: np.ndarray) -> int:
        """Append numbers; returns the index of the first of them."""
        start = self._size
        self._parts.append(values.ravel())
        self._size += values.size
        return start

    def flat(self) -> np.ndarray:
        """All numbers, read-only."""
        numbers = np.concatenate(self._parts) if self._parts else np.zeros(1)
        numbers.flags.writeable = False
        return numbers


def write_plane(
    record: np.void, tables: Tables, values: Callable, lightest: float, slowest: float, box: Box
) -> None:
    """Make a table over ln Q and ln u and write its address.

    Parameters
    ----------
    record : record of `PLANE`
        Written.
    tables : Tables
        The tables to which its coefficients are added.
    values : callable
        Up to four quantities from load [N] and speed [m/s], arrays of one shape.
    lightest : float
        Least load [N], > 0.
    slowest : float
        Least speed [m/s], > 0.
    box : Box
        Highest load, highest speed and fineness.
    """
    load_spacing = _PLANE_LOAD * box.fineness
    load = axis(math.log(lightest), math.log(box.load), load_spacing)
    fastest = 2.0 * box.fastest
    speed_spacing = _PLANE_SPEED * box.fineness
    speed = axis(math.log(slowest), math.log(fastest), speed_spacing)
    states = np.meshgrid(np.exp(load.nodes), np.exp(speed.nodes), indexing="ij")
    nodes = np.zeros((*states[0].shape, CHANNELS))
    for channel, numbers in enumerate(values(*states)):
        nodes[..., channel] = numbers
    record["start"] = tables.add(spline_coefficients(nodes, 2))
    record["load"] = tuple(load)
    record["speed"] = tuple(speed)


def film_values(
    contact: PreparedContact, load: np.ndarray, speed: np.ndarray
) -> tuple[np.ndarray, ...]:
    """Quantities of the plane of a contact's film: ln h and the asperities' share of the load."""
    film = contact.film_thickness(load, speed)
    return np.log(film), contact.asperity_share(load, speed, film)


def oil_values(
    contact: PreparedContact, load: np.ndarray, speed: np.ndarray
) -> tuple[np.ndarray, ...]:
    """Quantities of the plane of a raceway's oil at loads Q [N] and speeds [m/s].

    Sliding per slip, rolling resistance, and ln of the volume flow's film.
    """
    if isinstance(contact, PreparedStrips):
        conductance, resistance, film = contact.light(load, speed)
    else:
        conductance, resistance, film = light_contact(contact.rolling, load, speed)
    return conductance, resistance, np.log(film)


def cage_values(
    contact: PreparedContact, pocket_gap: float, load: np.ndarray, speed: np.ndarray
) -> tuple[np.ndarray, ...]:
    """Quantities of the plane of the cage's contact.

    Parameters
    ----------
    contact : PreparedContact
        Laws of the contact.
    pocket_gap : float
        Largest gap between roller and spar [m], > 0.
    load : ndarray
        Q [N], > 0.
    speed : ndarray
        Surface speed of the roller [m/s], > 0.

    Returns
    -------
    tuple of ndarray
        Friction per slip [N s/m] and the asperities' share of its power [-]; with oil in the pocket
        also its sliding force per slip and its rolling resistance per mean speed [N s/m].
    """
    none = np.zeros_like(load)
    friction = none
    rough = none
    if contact.closed_form is None:
        pull, _, _, power = tractions(contact, load, none, -speed)
        friction = -pull / speed
        rough = power / (-pull * speed)
    if contact.rolling is None:
        return friction, rough
    mean_speed = 0.5 * speed
    oil = rigid_pocket_contact(contact.rolling, load, mean_speed, pocket_gap)
    return friction, rough, *oil


def tractions(
    contact: PreparedContact, load: np.ndarray, ring_speed: np.ndarray, slip: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Traction of a contact by its laws, the roller's axis tilted to the positive side.

    Parameters
    ----------
    contact : PreparedContact
        Laws of the contact.
    load : ndarray
        Q [N], > 0.
    ring_speed, slip : ndarray
        u2 and v [m/s], of either sign and of the shape of `load`.

    Returns
    -------
    pull, lag : ndarray
        Forces [N].
    skew : ndarray
        Moment [N m].
    asperity_power : ndarray
        Power of asperities [W].
    """
    if isinstance(contact, PreparedStrips):
        return contact.tractions(load, ring_speed, slip)
    entrainment = np.maximum(np.abs(ring_speed - 0.5 * slip), REST_SPEED)
    film = contact.film_thickness(load, entrainment)
    share = contact.asperity_share(load, entrainment, film)
    if contact.fluid is not None:
        chords = chord_table(contact.fluid)
        values = patch_tractions(patch_of(contact), chords, load, film, share, ring_speed, slip)
        return values[..., 0], values[..., 1], values[..., 2], values[..., 3]
    if contact.friction is not None:
        states = (load, ring_speed, slip, entrainment, share)
        return _saturating_tractions(contact.friction, patch_of(contact), *states)
    # Asperities have their full friction from a slip of `full_slip` [m/s] on.
    saturation = np.clip(slip / contact.full_slip, -1.0, 1.0)
    rough = contact.boundary_friction * share * load * saturation
    sheared = (1.0 - share) * contact.uniform_traction(load, film, slip)
    none = np.zeros_like(load)
    return sheared + rough, none, none, rough * slip


def _saturating_tractions(
    friction: SaturatingFriction, patch: Patch, load, ring_speed, slip, entrainment, share
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """`tractions` of a raceway with Kellström's friction, whose asperities have their share."""
    limit, ratio = friction
    # Largest coefficient of friction [-], and the slip [m/s] from which on it acts.
    film_limit = limit * (1.0 - share)
    film_slip = ratio * entrainment
    film = saturating_patch(patch, film_limit, film_slip, load, ring_speed, slip)
    rough_limit = patch.boundary_friction * share
    rough = saturating_patch(patch, rough_limit, patch.full_slip, load, ring_speed, slip)
    pull = film.pull + rough.pull
    lag = film.lag + rough.lag
    skew = film.skew + rough.skew
    return pull, lag, skew, rough.power


class _Grid(NamedTuple):
    """Axes of a traction table and the numbers of their coordinates."""

    load: Axis  #: Of ln Q + k Q^(1/3), Q in N
    speed: Axis  #: Of w^(1/4), w in m/s
    ratio: Axis  #: Of asinh((y − y_m)/y_0)
    stretch: float  #: k [N^(−1/3)]
    middle: float  #: y_m [-]
    scale: float  #: y_0 [-]

    def loads(self, coordinates: np.ndarray) -> np.ndarray:
        """Loads of coordinates [N], by Newton's iteration in their logarithm.

        The coordinates are concave in it.
        """
        logarithm = np.array(coordinates)
        for _ in range(100):
            root = np.exp(logarithm / 3.0)
            excess = logarithm + self.stretch * root - coordinates
            slope = 1.0 + self.stretch * root / 3.0
            logarithm -= excess / slope
        return np.exp(logarithm)

    def slips(self, coordinates: np.ndarray) -> np.ndarray:
        """Slips as part of w, from −2 to 2, of coordinates."""
        ratio = self.middle + self.scale * np.sinh(coordinates)
        ratio = np.clip(ratio, -_LARGEST_RATIO, _LARGEST_RATIO)
        return ratio / (1.0 + 0.0625 * ratio * ratio)

    def coordinates(self, slip: np.ndarray | float) -> np.ndarray:
        """Coordinates of slips as part of w."""
        # Speed of the ring as part of w.
        ring_share = np.sqrt(1.0 - 0.25 * np.square(slip))
        ratio = 2.0 * slip / (1.0 + ring_share)
        return np.arcsinh((ratio - self.middle) / self.scale)


def _grid(contact: PreparedContact, box: Box) -> _Grid:
    shape = contact.shape
    hertz = contact.interface.hertz
    # A law of one's own may rise with the oil's viscosity.
    fluid = contact.fluid
    middle = 0.0
    per_pressure = contact.interface.lubricant.pressure_viscosity
    if fluid is not None:
        per_pressure = fluid.exponent * fluid.index / fluid.reference_pressure
    stretch = _STRETCH * per_pressure * hertz.pressure
    if shape.microslip:
        middle = shape.spin_ratio**2 * shape.contour_radius / (2.0 * shape.curvature_ratio)
        scale = _LITTLE_MICROSLIP if isinstance(contact, PreparedStrips) else _MICROSLIP
    else:
        scale = _bent_ratio(contact, box)
    # A node at no slip, where the splines are exact: errors beside it hide the force of a roller
    # that cold oil grips. And the slip without entrainment in the middle between two: there the
    # film ends, and a node would spread that over its cells.
    fine = _RATIO_SPACING * box.fineness
    beyond = _NO_ENTRAINMENT - middle
    cells_below = math.floor(math.asinh(beyond / scale) / fine)
    scale = beyond / math.sinh(fine * (cells_below + 0.5))
    lowest = math.asinh((_LARGEST_RATIO + middle) / scale)
    highest = math.asinh((_LARGEST_RATIO - middle) / scale)
    below = math.ceil(lowest / fine)
    above = math.ceil(highest / fine)
    ratio_axis = Axis(-below * fine, 1.0 / fine, below + above)
    return _Grid(_load_axis(box, stretch), _speed_axis(box), ratio_axis, stretch, middle, scale)


def _stretched_load(load: float, stretch: float) -> float:
    """The coordinate ln Q + k Q^(1/3) of a load Q [N]."""
    return math.log(load) + stretch * load ** (1.0 / 3.0)


def _load_axis(box: Box, stretch: float) -> Axis:
    """Axis of ln Q + k Q^(1/3) of a table, Q in N.

    All tables of a contact have the same loads, as far as they go.
    """
    spacing = _LOAD_SPACING * box.fineness
    lightest = _stretched_load(_LEAST_LOAD, stretch)
    length = _stretched_load(box.load, stretch) - lightest
    return Axis(lightest, 1.0 / spacing, max(math.ceil(length / spacing), 4))


def _speed_axis(box: Box) -> Axis:
    """Axis of w^(1/4) of a table, w in m/s.

    Speeds of sheets are those of all cases whose fastest speed is of the same order. Orders go by
    factors of four, such as 1/4 to 1 m/s: fast and slow winds of a turbine share one.
    """
    order = 2 * math.ceil(0.5 * math.log2(box.fastest)) - 1
    spacing = _SPEED_SPACING * box.fineness * 2.0 ** (0.25 * order)
    node_below = math.floor(box.slowest**0.25 / spacing)
    node_above = math.ceil(box.fastest**0.25 / spacing)
    first = max(node_below - _BEYOND, 0)
    last = max(node_above + _BEYOND, first + 4)
    return Axis(first * spacing, 1.0 / spacing, last - first)


def _bent_ratio(contact: PreparedContact, box: Box) -> float:
    """Slip ratio from which traction bends at the highest load, with one slip all over."""
    ratio = np.geomspace(1e-16, 1.0, 200)
    load = np.full_like(ratio, box.load)
    speed = np.full_like(ratio, box.fastest)
    pull, *_ = tractions(contact, load, speed, speed * ratio)
    conductance = pull / ratio
    bent = conductance < (1.0 - _BENT) * pull[0] / ratio[0]
    first_bent = ratio[np.argmax(bent)] if bent.any() else 1.0
    return float(min(first_bent, _MICROSLIP))


def _sheet(contact: PreparedContact, grid: _Grid, loads: np.ndarray, speed: float) -> np.ndarray:
    """Quantities at given loads [N] and all slip ratios at one speed w [m/s]."""
    slips = grid.slips(grid.ratio.nodes)
    load, slip = np.meshgrid(loads, slips, indexing="ij")
    speed = max(speed, REST_SPEED)
    square = np.maximum(1.0 - 0.25 * slip * slip, 0.0)
    ring_speed = speed * np.sqrt(square)
    pull, lag, skew, rough = tractions(contact, load, ring_speed, speed * slip)
    root = np.cbrt(load)
    heavy = load * root * root
    channels = [pull / load, lag / heavy, skew / (load * root), rough / (heavy * speed)]
    return np.stack(channels, axis=-1)


def contact_parts(contact: PreparedContact) -> tuple:
    """Numbers and laws on which a contact's traction depends, for the key of its table."""
    interface = contact.interface
    oil = contact.interface.lubricant
    sources = contact.own_sources
    return (
        contact.film_name, contact.oil_gap, contact.thermal_loading, contact.fluid, contact.traction_name,
        contact.friction, contact.asperity_name, tuple(patch_of(contact)), interface.rolling_radius, interface.modulus, interface.roughness, interface.hardness,
        oil.viscosity, oil.pressure_viscosity, sources, repr(oil) if sources else "",
        contact.strips if isinstance(contact, PreparedStrips) else None,
    )  # fmt: skip


class TableErrors(NamedTuple):
    """Relative errors of force and power of a traction table."""

    typical: float  #: Median of the errors [-]
    worst: float  #: Largest error [-]


def table_gaps(contact: PreparedContact, box: Box) -> tuple[tuple[float, float], ...]:
    """Gaps at which a raceway's tables are made, with weights that make its own table of theirs.

    See `macroslip.contact.starvation.shared_gaps`.
    """
    flooded = replace(contact, oil_gap=math.inf)
    film = flooded.film_thickness(box.load, box.fastest)
    return shared_gaps(contact.inlet_gap, float(film), box.fineness)


class _Splines(NamedTuple):
    """Splines of a traction table, and the slips up to which its force rises."""

    coefficients: np.ndarray  #: Coefficients of the splines
    #: Slip as part of w up to which the moment on the roller rises with slip on either side [-]
    rising: np.ndarray


def write_traction(
    record: np.void, tables: Tables, contact: PreparedContact, box: Box
) -> TableErrors:
    """Make the table of a raceway's traction, or take it from the cache, and write its address.

    Parameters
    ----------
    record : record of `TRACTION`
        Written.
    tables : Tables
        The tables to which its coefficients are added.
    contact : PreparedContact
        Laws of the raceway.
    box : Box
        States that the table holds.

    Returns
    -------
    TableErrors
        Relative errors of force and power [-].
    """
    gaps = table_gaps(contact, box)
    nearest_gap, _ = gaps[0]
    grid = _grid(contact.at_gap(nearest_gap), box)
    splines = remembered(
        table_key("splines of traction", *contact_parts(contact), grid, gaps),
        lambda: _splines(contact, grid, gaps),
    )
    record["start"] = tables.add(splines.coefficients)
    record["rising"] = tables.add(splines.rising)
    for name in ("load", "speed", "ratio"):
        record[name] = tuple(getattr(grid, name))
    record["stretch"] = grid.stretch
    record["middle"] = grid.middle
    record["scale"] = grid.scale
    record["side"] = math.copysign(1.0, contact.shape.spin_ratio)
    return _errors(contact, grid, splines.coefficients, box)


def _splines(
    contact: PreparedContact, grid: _Grid, gaps: tuple[tuple[float, float], ...]
) -> _Splines:
    """Splines of a contact's own traction, from those at gaps of which it is the weighted sum."""
    nodes = sum(weight * _nodes(contact.at_gap(gap), grid) for gap, weight in gaps)
    return _Splines(spline_coefficients(nodes, 3), _rising(grid, nodes))


def _nodes(contact: PreparedContact, grid: _Grid) -> np.ndarray:
    """Traction at the nodes of a grid, computed or read from the cache."""
    key = table_key(
        "traction",
        *contact_parts(contact),
        (grid.load.first, grid.load.per_spacing),
        (grid.ratio, grid.stretch, grid.middle, grid.scale),
    )
    loads = grid.loads(grid.load.nodes)
    ends = ends_of_parts(grid.load, lambda load: _stretched_load(load, grid.stretch))
    sheets = []
    for node in grid.speed.nodes:
        # Grids that begin elsewhere have the same speeds but for rounding. A sheet is made at the
        # rounded one, so that it does not tell which case made it.
        root_speed = round(float(node), 12)
        sheets.append(
            stored_sheet(
                (key, root_speed),
                loads,
                ends,
                lambda part, speed=root_speed**4: _sheet(contact, grid, part, speed),
            )
        )
        tell(TABLES, len(sheets), grid.speed.cells + 1)
    return np.stack(sheets, axis=1)


def ends_of_parts(loads: Axis, coordinate: Callable[[float], float]) -> list[int]:
    """Numbers of the nodes of load at which the parts of a sheet begin, and the number of all.

    Sheets are stored in parts, the loads up to 65,536 N and those of each doubling beyond, so that a
    case with heavier rollers makes only what one with lighter ones has not made.

    Parameters
    ----------
    loads : Axis
        Of the coordinate of load; its first node and the distance between nodes are those of all
        cases alike.
    coordinate : callable
        The coordinate of a load [N].

    Returns
    -------
    list of int
        Rising from 0.

    Examples
    --------
    >>> ends_of_parts(Axis(math.log(2e3), 5.0, 24), math.log)
    [0, 19, 22, 25]
    """
    ends = [0]
    load = _FIRST_PART
    while True:
        beyond = coordinate(load) - loads.first
        end = math.ceil(beyond * loads.per_spacing) + 1
        if end > loads.cells:
            return [*ends, loads.cells + 1]
        ends.append(end)
        load *= 2.0


def stored_sheet(
    key: tuple, loads: np.ndarray, ends: list[int], make: Callable[[np.ndarray], np.ndarray]
) -> np.ndarray:
    """Sheet of a table, of parts that are made or read from the store.

    Parameters
    ----------
    key : tuple
        What the sheet depends on beside its loads, see `macroslip.storage.tables.table_key`.
    loads : ndarray, shape (n,)
        Of the nodes [N].
    ends : list of int
        As of `ends_of_parts`.
    make : callable
        Quantities at some of the loads, which are its first axis.

    Returns
    -------
    ndarray, shape (n, ...)
        Quantities at all loads.
    """
    parts: list[np.ndarray] = []
    for first, end in itertools.pairwise(ends):
        part = loads[first:end]
        parts += stored(table_key(*key, first, end), lambda loads=part: [make(loads)])
    return np.concatenate(parts)


def _rising(grid: _Grid, nodes: np.ndarray) -> np.ndarray:
    """Slip as part of w up to which the moment on the roller rises with slip on either side.

    Over loads and speeds.

    Of each node the least of it and its neighbours'.
    """
    from scipy.ndimage import minimum_filter

    load = grid.loads(grid.load.nodes)
    root = np.cbrt(load)[:, None, None]
    pull = nodes[..., 0]
    lag = nodes[..., 1] * root**2
    spin = pull - lag
    slip = grid.slips(grid.ratio.nodes)
    falls = np.diff(spin, axis=-1) < 0.0
    centre = int(np.searchsorted(slip, grid.middle))
    above = falls[..., centre:]
    below = falls[..., :centre][..., ::-1]
    upper = np.append(slip[centre:-1], 2.0)
    lower = np.append(-slip[centre:0:-1], 2.0)
    up = np.where(above.any(-1), upper[above.argmax(-1)], 2.0)
    down = np.where(below.any(-1), lower[below.argmax(-1)], 2.0)
    return minimum_filter(np.minimum(up, down), size=3)


def _errors(
    contact: PreparedContact, grid: _Grid, coefficients: np.ndarray, box: Box
) -> TableErrors:
    """Errors at random states, even in the logarithms of load and speed.

    Rollers with more than 20 kN slip up to .6 % of the ring's speed, lighter ones up to all of it
    and more.
    """
    state = _random_states(grid, box)
    interpolated = _interpolated(grid, coefficients, state)
    load, speed, slip = state
    root = np.cbrt(load)
    heavy = load * root * root
    along = speed * np.sqrt(1.0 - 0.25 * slip * slip)
    sliding = speed * slip
    expected = tractions(contact, load, along, sliding)
    scales = (load, heavy, load * root, heavy * speed)
    scaled = [value * scale for value, scale in zip(interpolated, scales, strict=True)]
    spin, power = _spin_and_power(contact, along, sliding, expected)
    other, other_power = _spin_and_power(contact, along, sliding, scaled)
    force_error = _relative_error(other, spin)
    power_error = _relative_error(other_power, power)
    error = np.maximum(force_error, power_error)
    return TableErrors(float(np.median(error)), float(error.max()))


def _relative_error(values: np.ndarray, expected: np.ndarray) -> np.ndarray:
    """Error over the expected size, or over a part of the largest at the same load and speed [-]."""
    size = np.abs(expected)
    largest = size.max(axis=-1, keepdims=True)
    return np.abs(values - expected) / np.maximum(size, _SMALL_FORCE * largest)


class _States(NamedTuple):
    """States of a contact at which a table is compared with its law, arrays of one shape."""

    load: np.ndarray  #: Q [N]
    speed: np.ndarray  #: Root mean square of both surfaces' speeds, as the grid has it [m/s]
    slip: np.ndarray  #: Slip over that speed [-]


def _random_states(grid: _Grid, box: Box) -> _States:
    """Draw states inside the box of a table, shape (states, slips)."""
    random = np.random.default_rng(1)
    log_load = random.uniform(math.log(1.0), math.log(box.load), (_STATES, 1))
    load = np.exp(log_load)
    slowest = max(box.slowest, 0.02 * box.fastest)
    speed = random.uniform(slowest, box.fastest, (_STATES, 1))
    held = load > _HELD_LOAD
    low = grid.coordinates(np.where(held, -_HELD_RATIO, -1e-3))
    high = grid.coordinates(np.where(held, _HELD_RATIO, _MOST_RATIO))
    slip = grid.slips(random.uniform(low, high, (_STATES, _SLIPS)))
    load = np.broadcast_to(load, slip.shape)
    speed = np.broadcast_to(speed, slip.shape)
    return _States(load, speed, slip)


def _interpolated(grid: _Grid, coefficients: np.ndarray, state: _States) -> list[np.ndarray]:
    """Look up every channel of a table at states, by an interpolation of its own."""
    from scipy.ndimage import map_coordinates

    stretched_load = np.log(state.load) + grid.stretch * np.cbrt(state.load)
    coordinates = (
        (grid.load, stretched_load),
        (grid.speed, state.speed**0.25),
        (grid.ratio, grid.coordinates(state.slip)),
    )
    nodes = [(at - axis.first) * axis.per_spacing + 1.0 for axis, at in coordinates]
    return [
        map_coordinates(coefficients[..., channel], nodes, order=3, prefilter=False)
        for channel in range(CHANNELS)
    ]


def _spin_and_power(
    contact: PreparedContact,
    along: np.ndarray,
    slip: np.ndarray,
    channels: list[np.ndarray] | tuple[np.ndarray, ...],
) -> tuple[np.ndarray, np.ndarray]:
    """Force that drives the spin [N] and power [W] from a table's channels at slips [m/s]."""
    shape = contact.shape
    curvature = shape.curvature_ratio * shape.roller_radius if shape.microslip else 0.0
    pull, lag, skew, _ = channels
    spin = pull - lag
    rolling = along * (curvature * lag - abs(shape.spin_ratio) * skew)
    return spin, slip * spin + rolling
