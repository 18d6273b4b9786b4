"""Energies, powers and shares of time in the window, from the steps of either engine."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from macroslip.compiled import jit, jit_inline

if TYPE_CHECKING:
    from macroslip.contact.laws import RollerLaws

#: Meaning of `Totals.mechanism_energy` by position: what makes surfaces slide.
MECHANISMS = ("sliding", "curvature", "contact angle")
INTERFACES = ("inner", "outer", "cage")
#: A kink has no parabola; what one may add to the samples is bounded by this factor. And how uneven samples may be for
#: a parabola: where spacing changes more, a fast transient has just ended, and a parabola would extrapolate it.
HIGHEST_RISE, MOST_UNEVEN = 1.1, 4.0
#: Part of the largest raceway speed of a history below which the ratio of spins is not taken: through standstill both
#: spins pass zero, one a little after the other, and their ratio is any number.
SPIN_RATIO_SPEED = 0.1


class Totals(NamedTuple):
    """Sums over the steps of one roller. Interfaces are in the order inner, outer, cage.

    Attributes
    ----------
    edges : ndarray, shape (orbits + 1,)
        Times at which orbits of the window begin and end [s]; the window opens at the first.
    energy, rolling_energy, asperity_energy : ndarray, shape (3,)
        Dissipated by friction in the window (34), by rolling resistance, which is apart from it, and the part of friction
        by asperities [J].
    mechanism_energy : ndarray, shape (3, 3)
        Energy of friction by interface and mechanism [J].
    orbit_energy, peak_power : ndarray, shape (orbits, 3)
        Energy [J] and largest power (33) [W] in each complete orbit.
    spin_ratio : ndarray, shape (2,)
        Smallest ω/ω_pure in the window [-], and speed of the rings from which on it has a meaning [m/s].
    samples : ndarray, shape (2, 4)
        The last two times [s] and powers [W], newest last, for the parabola through three.
    place : ndarray of int, shape (2,)
        Orbit and stretch of the last step.
    """

    edges: np.ndarray
    energy: np.ndarray
    rolling_energy: np.ndarray
    asperity_energy: np.ndarray
    mechanism_energy: np.ndarray
    orbit_energy: np.ndarray
    peak_power: np.ndarray
    spin_ratio: np.ndarray
    samples: np.ndarray
    place: np.ndarray


def new_totals(edges: np.ndarray, highest_speed: float) -> Totals:
    """Nothing yet, for orbits with these edges [s] and the largest raceway speed of the history [m/s]."""
    orbits = edges.size - 1
    return Totals(
        edges=edges,
        energy=np.zeros(3),
        rolling_energy=np.zeros(3),
        asperity_energy=np.zeros(3),
        mechanism_energy=np.zeros((3, len(MECHANISMS))),
        orbit_energy=np.zeros((orbits, 3)),
        peak_power=np.zeros((orbits, 3)),
        spin_ratio=np.array([np.inf, SPIN_RATIO_SPEED * highest_speed]),
        samples=np.zeros((2, 4)),
        place=np.array([-1, -1]),
    )


@jit
def orbit_at(edges, time, likely):
    """Index of the complete orbit that holds `time`, or −1 outside all of them; `likely` is looked at first."""
    if likely >= 0 and edges[likely] <= time < edges[likely + 1]:
        return likely
    if time < edges[0] or time >= edges[-1]:
        return -1
    return np.searchsorted(edges, time, side="right") - 1


@jit
def vertex(ta, pa, tb, pb, tc, pc):
    """Largest value of the parabola through three samples with ta < tb < tc and pb the largest.

    Examples
    --------
    >>> vertex(0.0, 0.0, 1.0, 3.0, 2.0, 2.0)
    3.125
    """
    left = (pb - pa) / (tb - ta)
    right = (pc - pb) / (tc - tb)
    curvature = (right - left) / (tc - ta)
    if curvature >= 0.0:
        return pb
    slope = (left * (tc - tb) + right * (tb - ta)) / (tc - ta)
    return pb - 0.25 * slope * slope / curvature


@jit_inline
def _follow(samples, peak, time, powers):
    """Take up the powers at a new time; raise the orbit's peaks to them and to the parabolas through three of them."""
    before, after = samples[1, 0] - samples[0, 0], time - samples[1, 0]
    even = before > 0.0 and after > 0.0 and before < MOST_UNEVEN * after and after < MOST_UNEVEN * before
    for interface in range(3):
        power = powers[interface]
        peak[interface] = max(peak[interface], power)
        first, middle = samples[0, interface + 1], samples[1, interface + 1]
        if even and middle > first and middle > power and HIGHEST_RISE * middle > peak[interface]:
            top = vertex(samples[0, 0], first, samples[1, 0], middle, time, power)
            peak[interface] = max(peak[interface], min(top, HIGHEST_RISE * middle))
        samples[0, interface + 1] = middle
        samples[1, interface + 1] = power
    samples[0, 0], samples[1, 0] = samples[1, 0], time


@jit_inline
def _book_peaks(step, totals, orbit):
    """Follow the powers over a step."""
    samples = totals.samples
    if step.stretch != totals.place[1]:
        for row in range(2):
            samples[row, 0] = step.start
            for interface in range(3):
                samples[row, interface + 1] = step.power_before[interface]
    peak = totals.peak_power[orbit] if orbit >= 0 else np.zeros(3)
    if orbit >= 0 and orbit != totals.place[0]:
        # The power before the step may be the peak of an orbit that has just begun.
        for interface in range(3):
            peak[interface] = max(peak[interface], step.power_before[interface])
    if step.sampled == 0:
        for k in range(step.stages):
            _follow(samples, peak, step.time[k], step.power[k])


@jit
def book(steps, j, totals):
    """Add the steps of roller `j` in a buffer to its totals.

    Parameters
    ----------
    steps : ndarray of `STEP`, shape (n, rollers)
    j : int
    totals : Totals
        Changed in place.
    """
    edges = totals.edges
    for n in range(steps.shape[0]):
        step = steps[n, j]
        if step.start < edges[0]:
            continue
        orbit = orbit_at(edges, 0.5 * (step.start + step.end), totals.place[0])
        for k in range(step.stages):
            weight = step.weight[k]
            for i in range(3):
                energy = weight * step.power[k, i]
                totals.energy[i] += energy
                totals.rolling_energy[i] += weight * step.rolling[k, i]
                totals.asperity_energy[i] += weight * step.rough[k, i]
                totals.mechanism_energy[i, 0] += energy
                if orbit >= 0:
                    totals.orbit_energy[orbit, i] += energy
            for i in range(2):
                lag, skew = weight * step.lag_power[k, i], weight * step.skew_power[k, i]
                totals.mechanism_energy[i, 0] -= lag + skew
                totals.mechanism_energy[i, 1] += lag
                totals.mechanism_energy[i, 2] += skew
        _book_peaks(step, totals, orbit)
        totals.place[0], totals.place[1] = orbit, step.stretch
        last, pure = step.stages - 1, step.pure_speed
        if step.weight[last] > 0.0 and pure != 0.0 and abs(pure) >= totals.spin_ratio[1]:
            surface = step.outer_speed[last] - step.outer_slip[last]
            totals.spin_ratio[0] = min(totals.spin_ratio[0], surface / pure)


def film_times(steps: np.ndarray, laws: RollerLaws, window: float) -> np.ndarray:
    """Time with load on each interface, and the part of it outside the film law's range [s], shape (2, 3).

    Parameters
    ----------
    steps : ndarray of `STEP`, shape (n,)
        The state at its end counts for a step.
    laws : RollerLaws
    window : float
        Start of the window [s].
    """
    counted = steps[(steps["start"] >= window) & (steps["weight"][:, 0] > 0.0)]
    found = np.zeros((2, 3))
    if not counted.size:
        return found
    at = np.arange(counted.size), counted["stages"] - 1
    span = counted["weight"].sum(axis=1, where=np.arange(counted["weight"].shape[1]) < counted["stages"][:, None])
    for i, (law, load, speed) in enumerate(
        (
            (laws.inner, counted["inner_load"][at], counted["inner_speed"][at] - 0.5 * counted["inner_slip"][at]),
            (laws.outer, counted["outer_load"][at], counted["outer_speed"][at] - 0.5 * counted["outer_slip"][at]),
            (laws.cage, np.abs(counted["cage_load"][at]), 0.5 * counted["cage_speed"][at]),
        )
    ):
        loaded = load > 0.0
        outside = ~law.film_in_range(load[loaded], np.abs(speed[loaded]))
        found[:, i] = span[loaded].sum(), span[loaded][outside].sum()
    return found


def spin_ratio(totals: Totals) -> float:
    """Smallest ratio of spin to spin in pure rolling; NaN where there is none."""
    return float(totals.spin_ratio[0]) if math.isfinite(totals.spin_ratio[0]) else math.nan
