"""What an integration leaves behind: energies, peaks, counts and traces, filled by every method in the same way."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit_part
from macroslip.integrate.detail import EXTREMES, MECHANISMS
from macroslip.integrate.surface import FILM_REGIMES, SECTORS, SLIP_SIGNS, STATIONS
from macroslip.integrate.tuning import SPIN_RATIO_SPEED

#: Meaning of `RollerRecord.count` by position.
COUNTS = ("steps", "rejections", "force_evaluations")
#: Channels of `RollerRecord.trace` by position.
TRACES = (
    *("slip", "ring_speed", "roller_load", "force_inner", "force_outer", "force_cage", "cage_load"),
    *("power_inner", "power_outer", "power_cage", "film_inner", "film_outer", "film_cage", "skew_inner", "skew_outer"),
    *("rolling_inner", "rolling_outer", "rolling_cage"),
)


class RollerRecord(NamedTuple):
    """Results of one roller, written in place. Interfaces are in the order inner, outer, cage.

    Attributes
    ----------
    edges : ndarray, shape (orbits + 1,)
        Times at which orbits of the window begin and end [s]; the window opens at the first.
    energy : ndarray, shape (3,)
        Energy dissipated in the window (34) [J].
    orbit_energy, peak_power : ndarray, shape (orbits, 3)
        Energy [J] and largest power (33) [W] in each complete orbit.
    spin_ratio : ndarray, shape (1,)
        Smallest ω/ω_pure in the window, of states at which the rings move past the roller at `slowest` or more [-].
    slowest : float
        Speed of the rings [m/s] from which on the spin ratio has a meaning.
    loaded_time, outside_time : ndarray, shape (3,)
        Time in the window with load on the interface, and the part of it outside the film law's range [s].
    count : ndarray of int, shape (3,)
        Steps, rejections and force evaluations, of the whole integration.
    worst : ndarray, shape (1,)
        Largest force left unbalanced by an accepted implicit step [N].
    end : ndarray, shape (2,)
        Time [s] and slip [m/s] at which the integration ended.
    trace_time : ndarray, shape (m,)
        Times of the traces [s].
    trace : ndarray, shape (m, 18)
        Traces, see `TRACES`; NaN after an integration that ended early.
    rolling_energy : ndarray, shape (3,)
        Energy of rolling resistance in the window [J], apart from `energy`.
    mechanism_energy : ndarray, shape (3, 3)
        Energy in the window by interface and mechanism [J], see `macroslip.integrate.detail`; this and what follows is
        filled for curved contacts only.
    asperity_energy : ndarray, shape (3,)
        Part of the energy dissipated by asperities [J].
    station_energy : ndarray, shape (2, stations)
        Energy at the raceways by station along the roller [J].
    extreme : ndarray, shape (orbits, 3, 4)
        Largest flash temperature [K], power per area [W/m²] and slide-roll ratio, and least Λ, in each complete orbit.
    quadrature : ndarray, shape (2, 2)
        Of states looked at: energy by a finer quadrature, and what the one in use is off by [J].
    surface_energy : ndarray, shape (2, sectors, stations, 2, 2)
        Energy at the places of the raceways, by sign of slip and film regime [J], see `macroslip.integrate.surface`.
    surface_density : ndarray, shape (2, sectors, stations)
        Largest power per area at the places of the raceways, mean over the contact's width [W/m²].
    station_work : ndarray, shape (2, stations + 3)
        Work space: power at each station when the raceway last had load, with the sign of slip [W], energy not yet given
        to them [J], the film regime they belong to, and that energy times the time since the last look [J s].
    """

    edges: np.ndarray
    energy: np.ndarray
    orbit_energy: np.ndarray
    peak_power: np.ndarray
    spin_ratio: np.ndarray
    slowest: float
    loaded_time: np.ndarray
    outside_time: np.ndarray
    count: np.ndarray
    worst: np.ndarray
    end: np.ndarray
    trace_time: np.ndarray
    trace: np.ndarray
    rolling_energy: np.ndarray
    mechanism_energy: np.ndarray
    asperity_energy: np.ndarray
    station_energy: np.ndarray
    extreme: np.ndarray
    quadrature: np.ndarray
    surface_energy: np.ndarray
    surface_density: np.ndarray
    station_work: np.ndarray


def new_record(edges: np.ndarray, trace_time: np.ndarray, highest_speed: float) -> RollerRecord:
    """An empty record for the given orbit edges [s], trace times [s] and largest raceway speed [m/s]."""
    orbits = edges.size - 1
    extreme = np.zeros((orbits, 3, len(EXTREMES)))
    extreme[..., EXTREMES.index("film_ratio")] = np.inf
    return RollerRecord(
        edges=edges,
        energy=np.zeros(3),
        orbit_energy=np.zeros((orbits, 3)),
        peak_power=np.zeros((orbits, 3)),
        spin_ratio=np.full(1, np.inf),
        slowest=SPIN_RATIO_SPEED * highest_speed,
        loaded_time=np.zeros(3),
        outside_time=np.zeros(3),
        count=np.zeros(3, dtype=np.int64),
        worst=np.zeros(1),
        end=np.zeros(2),
        trace_time=trace_time,
        trace=np.full((trace_time.size, len(TRACES)), np.nan),
        rolling_energy=np.zeros(3),
        mechanism_energy=np.zeros((3, len(MECHANISMS))),
        asperity_energy=np.zeros(3),
        station_energy=np.zeros((2, STATIONS)),
        extreme=extreme,
        quadrature=np.zeros((2, 2)),
        surface_energy=np.zeros((2, SECTORS, STATIONS, len(SLIP_SIGNS), len(FILM_REGIMES))),
        surface_density=np.zeros((2, SECTORS, STATIONS)),
        station_work=np.zeros((2, STATIONS + 3)),
    )


@jit_part
def orbit_at(record, time, likely):
    """Index of the complete orbit that holds `time`, or −1 outside all of them; `likely` is looked at first."""
    edges = record.edges
    if likely >= 0 and edges[likely] <= time < edges[likely + 1]:
        return likely
    if time < edges[0] or time >= edges[-1]:
        return -1
    low, high = 0, edges.size - 1
    while high - low > 1:
        middle = (low + high) // 2
        if edges[middle] <= time:
            low = middle
        else:
            high = middle
    return low


@jit_part
def add_energy(record, orbit, inner, outer, cage):
    """Book energies [J] spent in the window, and in orbit `orbit` unless it is −1."""
    record.energy[0] += inner
    record.energy[1] += outer
    record.energy[2] += cage
    if orbit >= 0:
        record.orbit_energy[orbit, 0] += inner
        record.orbit_energy[orbit, 1] += outer
        record.orbit_energy[orbit, 2] += cage


@jit_part
def add_rolling(record, powers, span):
    """Book rolling powers [W] held over `span` [s] of the window."""
    energy = record.rolling_energy
    energy[0] += span * powers[0]
    energy[1] += span * powers[1]
    energy[2] += span * powers[2]


@jit_part
def raise_peak(record, orbit, interface, power):
    """Let the orbit's peak power be at least `power` [W]."""
    if orbit >= 0 and power > record.peak_power[orbit, interface]:
        record.peak_power[orbit, interface] = power
