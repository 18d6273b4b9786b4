"""Energies, powers and shares of time in the window, from the steps of either engine."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit, jit_inline, jit_once
from macroslip.contact.laws import PreparedContact, PreparedLaws
from macroslip.mechanics.speeds import signed_entrainment
from macroslip.ring.orbit import last_before

#: Kinds of sliding by which `Totals.mechanism_energy` is divided, in its order.
MECHANISMS = ("sliding", "curvature", "contact angle")
INTERFACES = ("inner", "outer", "cage")
RACEWAYS = INTERFACES[:2]
_CAGE = INTERFACES.index("cage")
#: Power that the polynomial through a step's stages may have between them, over the highest at the
#: stages. Where power has a kink in a step the polynomial tells nothing, and this bounds it.
HIGHEST_RISE = 1.1
#: Part of the largest raceway speed of a history below which the ratio of spins is not taken:
#: through standstill both spins pass zero, one a little after the other, and their ratio is any
#: number.
SPIN_RATIO_SPEED = 0.1
#: Raceway speed [m/s] below which it never is: a rotor on its brake trembles, and its rollers
#: neither roll nor slip.
STANDSTILL = 1e-3
#: Buffers of steps for whose records a batch has room, as far as not said otherwise, and least number
#: of records.
_BUFFERS = 4
_LEAST_BATCH = 1024


#: The state at the end of a step; signs and interfaces are those of `STEP`.
END = np.dtype(
    [
        # Time from the start of the step that counts with the state [s]: 0 before the window, and
        # for a row without weight.
        ("span", "f8"),
        # Speed u2 of the raceways past a roller in pure rolling [m/s].
        ("pure_speed", "f8"),
        # Slip Δu at the middle of the inner contact [m/s].
        ("inner_slip", "f8"),
        # Slip Δu at the middle of the outer contact [m/s].
        ("outer_slip", "f8"),
        # Speed u2 of the inner ring past the roller's centre [m/s].
        ("inner_speed", "f8"),
        # Speed u2 of the outer ring past the roller's centre [m/s].
        ("outer_speed", "f8"),
        # Speed of the roller's surface past the cage [m/s].
        ("cage_speed", "f8"),
        # Normal load of the inner contact, with body forces and films [N].
        ("inner_load", "f8"),
        # Normal load of the outer contact, with body forces and films [N].
        ("outer_load", "f8"),
        # Normal load of the rings alone [N].
        ("elastic_load", "f8"),
        # F_n,cage, positive where the cage pushes the roller along the orbit [N].
        ("cage_load", "f8"),
        # Friction by interface, without rolling resistance [N].
        ("force", "f8", (3,)),
        # Frictional power by interface [W].
        ("power", "f8", (3,)),
        # Power of rolling resistance by interface [W].
        ("rolling", "f8", (3,)),
        # Part of the raceways' power by the contact angle [W].
        ("skew_power", "f8", (2,)),
        # Friction of a tapered roller's rib, positive where it drives the spin up [N].
        ("rib_force", "f8"),
        ("rib_power", "f8"),  # power of the rib's friction [W]
    ]
)


#: Loads and entrainment speeds of the interfaces at the end of a step.
CONTACTS = np.dtype(
    [
        ("span", "f8"),  # time for which the state counts, as of `END` [s]
        ("load", "f8", (3,)),  # normal load by interface, not negative [N]
        # Entrainment speed by interface, without sign and from `LOWEST_SPEED` on [m/s].
        ("speed", "f8", (3,)),
    ]
)


@jit_inline
def write_contacts(end, contacts):
    """Write a record of `CONTACTS` of the state at the end of a step, a record of `END`."""
    contacts.span = end.span
    contacts.load[0] = end.inner_load
    contacts.load[1] = end.outer_load
    contacts.load[2] = abs(end.cage_load)
    contacts.speed[0] = abs(signed_entrainment(end.inner_speed, end.inner_slip))
    contacts.speed[1] = abs(signed_entrainment(end.outer_speed, end.outer_slip))
    # The spar is at rest, and the slip against it is that of the roller's surface.
    contacts.speed[2] = abs(signed_entrainment(0.0, -end.cage_speed))


@jit
def contacts_at(ends, contacts):
    """Write loads and entrainment speeds of many states.

    Parameters
    ----------
    ends : ndarray of `END`, shape (n,)
    contacts : ndarray of `CONTACTS`, shape (n,)
        Is filled.
    """
    for n in range(ends.shape[0]):
        write_contacts(ends[n], contacts[n])


@jit_inline
def write_end(step, end):
    """Write the state at the end of a step to a record of `END`.

    The time that counts with it is not written.
    """
    last = step.stages - 1
    end.pure_speed = step.pure_speed
    end.inner_slip = step.inner_slip[last]
    end.outer_slip = step.outer_slip[last]
    end.inner_speed = step.inner_speed[last]
    end.outer_speed = step.outer_speed[last]
    end.cage_speed = step.cage_speed[last]
    end.cage_load = step.cage_load[last]
    end.inner_load = step.inner_load[last]
    end.outer_load = step.outer_load[last]
    end.elastic_load = step.elastic_load[last]
    for i in range(3):
        end.force[i] = step.force[last, i]
        end.power[i] = step.power[last, i]
        end.rolling[i] = step.rolling[last, i]
    end.skew_power[0] = step.skew_power[last, 0]
    end.skew_power[1] = step.skew_power[last, 1]
    end.rib_force = step.rib_force[last]
    end.rib_power = step.rib_power[last]


class Batch:
    """Buffer of records that are processed together once there are enough.

    It has room for the records of `buffers` buffers of steps.
    """

    def __init__(self, kind: np.dtype, buffers: int = _BUFFERS):
        self._records = np.zeros(0, kind)
        self._buffers = buffers
        self.count = 0

    def room(self, count: int, work: Callable[[np.ndarray], None]) -> np.ndarray:
        """Free rows for new records behind those in the buffer.

        Where there is none, `work` takes these first.
        """
        if self.count + count > self._records.size:
            self._hand_over(work)
        if count > self._records.size:
            self._records = np.zeros(max(self._buffers * count, _LEAST_BATCH), self._records.dtype)
        return self._records[self.count : self.count + count]

    def empty(self, work: Callable[[np.ndarray], None]) -> None:
        """Process remaining records and release the buffer."""
        self._hand_over(work)
        self._records = self._records[:0].copy()

    def _hand_over(self, work: Callable[[np.ndarray], None]) -> None:
        if self.count:
            work(self._records[: self.count])
        self.count = 0


def loaded_contacts(
    contacts: np.ndarray, laws: PreparedLaws
) -> list[tuple[PreparedContact, np.ndarray, np.ndarray]]:
    """Laws, load [N] and entrainment speed [m/s] of every interface, of records of `CONTACTS`."""
    return [
        (getattr(laws, name), contacts["load"][:, i], contacts["speed"][:, i])
        for i, name in enumerate(INTERFACES)
    ]


class Totals(NamedTuple):
    """Sums over the steps of one roller. Interfaces are in the order inner, outer, cage."""

    #: Times at which orbits of the window begin and end [s]; the window opens at the first
    edges: np.ndarray
    energy: np.ndarray  #: Energy dissipated by friction (34) in the window by interface [J]
    rolling_energy: np.ndarray  #: Dissipated by rolling resistance, apart from friction [J]
    asperity_energy: np.ndarray  #: Part of the energy of friction by asperities [J]
    mechanism_energy: np.ndarray  #: Energy of friction by interface and mechanism [J]
    orbit_energy: np.ndarray  #: Energy by complete orbit and interface [J]
    #: Largest power (33) in each complete orbit, and last in the rest of the window, by interface
    #: [W]
    peak_power: np.ndarray
    #: Smallest ω/ω_pure in the window [-], −inf once the shaft has turned back; speed of the rings
    #: from which on it has a meaning [m/s]; and the sign of that speed, 0 before.
    spin_ratio: np.ndarray
    #: Time [s], and the integral over it of the load that films carry beside the rings' [N s]
    film_load: np.ndarray
    latest: np.ndarray  #: Orbit of the last step; -2 before the first
    #: At a tapered roller's rib, in each complete orbit and last in the rest of the window: energy
    #: of friction, the part of it by asperities [J], and largest power [W]
    rib: np.ndarray


def new_totals(edges: np.ndarray, highest_speed: float) -> Totals:
    """Empty totals for orbits with these edges [s] and this largest raceway speed [m/s]."""
    orbits = edges.size - 1
    shapes = (3, 3, 3, (3, len(MECHANISMS)), (orbits, 3), (orbits + 1, 3))
    ratio = np.array([np.inf, max(SPIN_RATIO_SPEED * highest_speed, STANDSTILL), 0.0])
    sums = [np.zeros(2), np.array([-2]), np.zeros((orbits + 1, 3))]
    return Totals._make([edges, *map(np.zeros, shapes), ratio, *sums])


@jit
def orbit_at(edges, time, likely):
    """Index of the complete orbit that holds `time`, or −1 outside all of them.

    The orbit `likely` is tried first.
    """
    if likely >= 0 and edges[likely] <= time < edges[likely + 1]:
        return likely
    if time < edges[0] or time >= edges[-1]:
        return -1
    return last_before(edges, time)


@jit_inline
def _divided_differences(ta, pa, tb, pb, tc, pc):
    """First and second divided difference of three points."""
    left = (pb - pa) / (tb - ta)
    right = (pc - pb) / (tc - tb)
    return left, (right - left) / (tc - ta)


@jit_inline
def _highest_by_differences(second, third, end, value, differences):
    """Largest value of a polynomial in Newton's form, from its first point at 0 to its last.

    It is p(s) = p_0 + s (d_1 + (s − s_1)(d_2 + (s − s_2) d_3)), whose derivative has at most one zero
    at which p falls afterwards.

    Parameters
    ----------
    second, third : float
        Second and third point s_1 and s_2, after the first one.
    end : float
        Last point.
    value : float
        Value p_0 at the first point.
    differences : tuple of three floats
        Divided differences d_1, d_2 and d_3; d_3 is 0 for a parabola.

    Returns
    -------
    float
    """
    first_difference, second_difference, third_difference = differences
    cubic = 3.0 * third_difference
    quadratic = 2.0 * (second_difference - (second + third) * third_difference)
    linear = first_difference - second * second_difference + second * third * third_difference
    change = second_difference + (end - third) * third_difference
    last = value + end * (first_difference + (end - second) * change)
    highest = max(value, last)
    discriminant = quadratic * quadratic - 4.0 * cubic * linear
    if discriminant <= 0.0:
        return highest
    # Of the two forms of this root the one in which nothing cancels.
    root = math.sqrt(discriminant)
    if quadratic <= 0.0:
        top = 2.0 * linear / (root - quadratic)
    elif cubic != 0.0:
        top = -0.5 * (quadratic + root) / cubic
    else:
        return highest
    if not 0.0 < top < end:
        return highest
    change = second_difference + (top - third) * third_difference
    rise = first_difference + (top - second) * change
    return max(highest, value + top * rise)


@jit
def highest_of_parabola(ta, pa, tb, pb, tc, pc):
    """Largest value of the parabola through three points, between the first and the last.

    Parameters
    ----------
    ta, tb, tc : float
        Times, ta < tb < tc [s].
    pa, pb, pc : float
        Values at these times, of any unit.

    Returns
    -------
    float
        Largest value, of the same unit.

    Examples
    --------
    >>> highest_of_parabola(0.0, 0.0, 1.0, 3.0, 2.0, 2.0)
    3.125
    """
    first, second = _divided_differences(ta, pa, tb, pb, tc, pc)
    return _highest_by_differences(tb - ta, 0.0, tc - ta, pa, (first, second, 0.0))


@jit
def highest_of_cubic(ta, pa, tb, pb, tc, pc, td, pd):
    """Largest value of the cubic through four points, between the first and the last.

    Parameters
    ----------
    ta, tb, tc, td : float
        Times, ta < tb < tc < td [s].
    pa, pb, pc, pd : float
        Values at these times, of any unit.

    Returns
    -------
    float
        Largest value, of the same unit.

    Examples
    --------
    Of t³ − 3 t, which is 2 at −1:

    >>> highest_of_cubic(-1.5, 1.125, -0.5, 1.375, 0.5, -1.375, 1.0, -2.0)
    2.0
    """
    first, second = _divided_differences(ta, pa, tb, pb, tc, pc)
    _, later = _divided_differences(tb, pb, tc, pc, td, pd)
    third = (later - second) / (td - ta)
    return _highest_by_differences(tb - ta, tc - ta, td - ta, pa, (first, second, third))


@jit_inline
def _highest_between(step, interface):
    """Highest power of an interface by the polynomial through the stages of a step [W].

    The start is a point of it, but not at the cage of an imposed orbit, whose steps have three
    stages: its load jumps with the shaft's acceleration, and so may its power between two steps.
    """
    time = step.time
    power = step.power
    if step.stages == 3 and (interface == _CAGE or time[0] == step.start):
        return highest_of_parabola(
            time[0], power[0, interface], time[1], power[1, interface], time[2], power[2, interface]
        )
    before = step.power_before[interface]
    if step.stages == 3:
        return highest_of_cubic(
            step.start,
            before,
            time[0],
            power[0, interface],
            time[1],
            power[1, interface],
            time[2],
            power[2, interface],
        )
    if step.stages == 2:
        return highest_of_parabola(
            step.start, before, time[0], power[0, interface], time[1], power[1, interface]
        )
    return power[0, interface]


@jit_once
def _book_peaks(step, totals, orbit):
    """Update the peaks of power of an orbit with those of a step.

    No polynomial reaches across a step: loads have a kink at every sample and pockets one at every
    touch, at which steps end. Where a step was sampled, its samples count and no polynomial: they
    lie so near to each other that they are the peak, and the end of a film is a cusp among them.
    """
    # Outside all complete orbits `orbit` is -1, the last line.
    peak = totals.peak_power[orbit]
    is_sample = step.weight[0] == 0.0
    # Samples leave out what is not resolved; of a sampled step's stages the end counts.
    from_stage = step.stages - 1 if step.sampled else 0
    for interface in range(3):
        # That of the end of the step before, or of an instant after, when loads have jumped.
        highest = step.power_before[interface]
        for k in range(from_stage, step.stages):
            highest = max(highest, step.power[k, interface])
        bound = HIGHEST_RISE * highest
        if not is_sample and not step.sampled and bound > peak[interface]:
            highest = max(highest, min(_highest_between(step, interface), bound))
        peak[interface] = max(peak[interface], highest)


@jit
def book(steps, j, totals, states, contacts):
    """Add a roller's steps to its frictional energy E = ∫P dt (34) and to its other totals.

    Of the load that films carry beside that of the rings the lighter one of the two raceways'
    counts, which the roller's body force does not load.

    Parameters
    ----------
    steps : ndarray of `macroslip.roller.step.STEP`, shape (n, rollers)
    j : int
        Index of the roller.
    totals : Totals
        Energies [J], peaks of power [W] and other sums, which are raised.
    states : ndarray of `END`, shape (n,)
        Is filled with the states at the ends of the steps.
    contacts : ndarray of `CONTACTS`, shape (n,)
        Is filled with loads and entrainment speeds there.
    """
    edges = totals.edges
    for n in range(steps.shape[0]):
        step = steps[n, j]
        state = states[n]
        write_end(step, state)
        state.span = 0.0
        write_contacts(state, contacts[n])
        if step.start < edges[0]:
            continue
        orbit = orbit_at(edges, 0.5 * (step.start + step.end), totals.latest[0])
        rib = totals.rib[orbit]
        span = 0.0
        films = 0.0
        for k in range(step.stages):
            weight = step.weight[k]
            span += weight
            rib[0] += weight * step.rib_power[k]
            rib[1] += weight * step.rib_rough[k]
            rib[2] = max(rib[2], step.rib_power[k])
            films += weight * (min(step.inner_load[k], step.outer_load[k]) - step.elastic_load[k])
            for i in range(3):
                energy = weight * step.power[k, i]
                totals.energy[i] += energy
                totals.rolling_energy[i] += weight * step.rolling[k, i]
                totals.asperity_energy[i] += weight * step.rough[k, i]
                totals.mechanism_energy[i, 0] += energy
                if orbit >= 0:
                    totals.orbit_energy[orbit, i] += energy
            for i in range(2):
                lag = weight * step.lag_power[k, i]
                skew = weight * step.skew_power[k, i]
                totals.mechanism_energy[i, 0] -= lag + skew
                totals.mechanism_energy[i, 1] += lag
                totals.mechanism_energy[i, 2] += skew
        totals.film_load[0] += span
        totals.film_load[1] += films
        if step.weight[0] > 0.0:
            state.span = span
            contacts[n].span = span
        _book_peaks(step, totals, orbit)
        totals.latest[0] = orbit
        last = step.stages - 1
        pure = step.pure_speed
        if step.weight[last] > 0.0 and pure != 0.0 and abs(pure) >= totals.spin_ratio[1]:
            surface = step.outer_speed[last] - step.outer_slip[last]
            ratio = surface / pure
            way = math.copysign(1.0, pure)
            if totals.spin_ratio[2] == -way:
                ratio = -np.inf
            totals.spin_ratio[0] = min(totals.spin_ratio[0], ratio)
            totals.spin_ratio[2] = way


def law_times(contacts: np.ndarray, laws: PreparedLaws) -> np.ndarray:
    """Time with load, and its parts outside the laws' ranges [s], shape (3, interface).

    The laws are those of the film and of the asperities; `contacts` are records of `CONTACTS`.
    """
    span = contacts["span"]
    times = np.zeros((3, len(INTERFACES)))
    for i, (law, load, speed) in enumerate(loaded_contacts(contacts, laws)):
        loaded = (load > 0.0) & (span > 0.0)
        time = span[loaded]
        load = load[loaded]
        times[0, i] = time.sum()
        times[1, i] = time[~law.film_in_range(load, speed[loaded])].sum()
        times[2, i] = time[~law.asperity_share_in_range(load)].sum()
    return times


def spin_ratio(totals: Totals) -> float:
    """Smallest ratio of spin to spin in pure rolling.

    It is NaN where there is none, or where pure rolling passes zero.
    """
    return float(totals.spin_ratio[0]) if math.isfinite(totals.spin_ratio[0]) else math.nan
