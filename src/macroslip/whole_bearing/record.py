"""Results of the integration of a whole bearing."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from macroslip.compiled import jit_called, jit_inline, jit_merged
from macroslip.film.film_law import film_in_range, film_thickness
from macroslip.whole_bearing.detail import Details, new_details
from macroslip.whole_bearing.ledger import FLOWS, STOCKS, stocks
from macroslip.whole_bearing.space import PUSH, SHEAR_CAGE, SHEAR_INNER, SHEAR_OUTER
from macroslip.whole_bearing.traction import (
    CAGE_LOAD,
    CAGE_ROUGH,
    INNER,
    LOAD,
    OUTER,
    ROUGH,
    SKEW,
    cage_shear_from,
    shear_from,
)

#: Traces of a roller by position.
TRACES = (
    "spin", "slip_inner", "slip_outer", "roller_load", "traction_inner", "traction_outer", "traction_cage", "cage_force",
    "power_inner", "power_outer", "power_cage", "pocket_offset", "orbit_speed_deviation", "film_inner", "film_outer",
    "film_cage", "rolling_inner", "rolling_outer", "rolling_cage",
    "skew_power_inner", "skew_power_outer",
)  # fmt: skip
#: Traces of a cage by position.
CAGE_TRACES = ("cage_speed", "cage_lag", "cage_x", "cage_y", "cage_torque")


class BearingRecord(NamedTuple):
    """Results, written in place. Interfaces: inner, outer, cage. Pocket sides: front, rear.

    Attributes
    ----------
    edges : ndarray, shape (orbits + 1,)
        Times [s] at which nominal orbits of the window begin and end; the window opens at the first.
    energy : ndarray, shape (n, 3)
        Frictional energy in the window [J].
    rolling_energy : ndarray, shape (n, 3)
        Energy of rolling resistance in the window [J], apart from `energy`.
    asperity_energy : ndarray, shape (n, 3)
        Part of `energy` that asperities dissipate [J].
    mechanism_energy : ndarray, shape (n, 3, 3)
        The same by interface and by slip of the middle, curvature and contact angle [J].
    orbit_energy, peak_power : ndarray, shape (n, orbits, 3)
        Frictional energy [J] and largest power [W] in each orbit.
    spin_ratio : ndarray, shape (n,)
        Least ratio of spin to that of pure rolling in the window.
    loaded_time, outside_time : ndarray, shape (n, 3)
        Time with load on the interface in the window, and of it that outside the film law's range [s].
    impulse, largest_push, push_time : ndarray, shape (n, 2)
        ∫|N| dt [N s], largest |N| [N] and time in contact [s] in the window, by side of the pocket.
    largest_by_position : ndarray, shape (n, 72)
        Largest |N| in the window by place on the orbit, in parts of 5° from φ = 0 [N].
    slip_square : ndarray, shape (c, 3)
        ∫ dt, ∫ s dt and ∫ s² dt of the cage's relative slip s = Ω_c/Ω_pure − 1 in the window.
    count : ndarray of int, shape (8,)
        Steps, rejections, evaluations of a raceway contact, Newton iterations, evaluations after a rest, and the rejections
        for an unsolved stage, for the error, and for forces not as predicted.
    worst : ndarray, shape (1,)
        Largest force left unbalanced [N].
    end : ndarray, shape (1,)
        Time at which the integration ended [s].
    end_slip : ndarray, shape (n,)
        Mean slip of both raceways there [m/s].
    out_time : ndarray, shape (m,)
        Output times [s].
    trace : ndarray, shape (m, n, 21)
        See `TRACES`; empty first axis where none were requested.
    cage_trace : ndarray, shape (m, c, 5)
        See `CAGE_TRACES`.
    flows, held : ndarray, shape (m, 13) and (m, 3)
        Books, see `macroslip.whole_bearing.ledger`.
    book : ndarray, shape (13,)
        Books as they are now.
    details : Details
        What is recorded of curved contacts.
    """

    edges: np.ndarray
    energy: np.ndarray
    rolling_energy: np.ndarray
    asperity_energy: np.ndarray
    mechanism_energy: np.ndarray
    orbit_energy: np.ndarray
    peak_power: np.ndarray
    spin_ratio: np.ndarray
    loaded_time: np.ndarray
    outside_time: np.ndarray
    impulse: np.ndarray
    largest_push: np.ndarray
    push_time: np.ndarray
    largest_by_position: np.ndarray
    slip_square: np.ndarray
    count: np.ndarray
    worst: np.ndarray
    end: np.ndarray
    end_slip: np.ndarray
    out_time: np.ndarray
    trace: np.ndarray
    cage_trace: np.ndarray
    flows: np.ndarray
    held: np.ndarray
    book: np.ndarray
    details: Details


def new_record(
    edges: np.ndarray, out_time: np.ndarray, count: int, cages: int, *, detailed: bool = True
) -> BearingRecord:
    """An empty record, to be filled with details of the contacts or without."""
    orbits, outputs = edges.size - 1, out_time.size
    return BearingRecord(
        edges=edges,
        energy=np.zeros((count, 3)),
        rolling_energy=np.zeros((count, 3)),
        asperity_energy=np.zeros((count, 3)),
        mechanism_energy=np.zeros((count, 3, 3)),
        orbit_energy=np.zeros((count, orbits, 3)),
        peak_power=np.zeros((count, orbits, 3)),
        spin_ratio=np.full(count, np.inf),
        loaded_time=np.zeros((count, 3)),
        outside_time=np.zeros((count, 3)),
        impulse=np.zeros((count, 2)),
        largest_push=np.zeros((count, 2)),
        push_time=np.zeros((count, 2)),
        largest_by_position=np.zeros((count, 72)),
        slip_square=np.zeros((cages, 3)),
        count=np.zeros(8, dtype=np.int64),
        worst=np.zeros(1),
        end=np.zeros(1),
        end_slip=np.full(count, np.nan),
        out_time=out_time,
        trace=np.full((outputs, count, len(TRACES)), np.nan),
        cage_trace=np.full((outputs, cages, len(CAGE_TRACES)), np.nan),
        flows=np.full((outputs, len(FLOWS)), np.nan),
        held=np.full((outputs, len(STOCKS)), np.nan),
        book=np.zeros(len(FLOWS)),
        details=new_details(count, orbits, wanted=detailed),
    )


@jit_inline
def raceway_powers(sheet, at, ratio, forces, place):
    """Powers [W] of a raceway contact with the forces of a stage at its load [N], ring speed and slip [m/s].

    Forces are that for the spin, the pull, and rolling resistance in both [N]. Returned are friction by mechanism, rolling
    resistance, and the part of friction by asperities; that and the skew moment's part follow the load.
    """
    spin, pull, shear = forces
    load, speed, slip = place
    known = sheet[at + LOAD]
    if load <= 0.0 or known <= 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0
    grown = (load - known) / known
    skew = sheet[at + SKEW] * (1.0 + 1.5 * grown)
    lag = pull - spin + 2.0 / ratio * shear
    return (
        (spin - shear) * slip,
        speed * ratio * lag,
        skew,
        -shear * (2.0 * speed - slip),
        sheet[at + ROUGH] * (1.0 + grown),
    )


@jit_called
def stage_powers(bearing, moment, sheets):
    """Fill the moment's powers [W] of every interface, and rolling resistance in its forces.

    First all friction, then its parts by what makes surfaces slide: slip of the middle, curvature, contact angle; then
    rolling resistance, which is apart from friction, and the part of friction by asperities.
    """
    stations, state, powers = moment.stations, moment.values.rollers, moment.powers
    inner_ratio, outer_ratio = bearing.pitch_radius / bearing.inner_radius, bearing.pitch_radius / bearing.outer_radius
    for j in range(powers.shape[0]):
        sheet, f = sheets[j], moment.force[j]
        at_inner = (stations.inner_load[j], stations.inner_speed[j], state[j, 0])
        at_outer = (stations.outer_load[j], stations.outer_speed[j], state[j, 1])
        f[SHEAR_INNER], f[SHEAR_OUTER] = shear_from(sheet, INNER, *at_inner), shear_from(sheet, OUTER, *at_outer)
        f[SHEAR_CAGE] = cage_shear_from(sheet, f[5], f[6])
        inner = raceway_powers(sheet, INNER, inner_ratio, (f[0], f[2], f[SHEAR_INNER]), at_inner)
        outer = raceway_powers(sheet, OUTER, outer_ratio, (f[1], f[3], f[SHEAR_OUTER]), at_outer)
        for k in range(5):
            powers[j, 0, k + 1], powers[j, 1, k + 1] = inner[k], outer[k]
        powers[j, 0, 0], powers[j, 1, 0] = inner[0] + inner[1] + inner[2], outer[0] + outer[1] + outer[2]
        powers[j, 2, 0] = powers[j, 2, 1] = (f[4] - f[SHEAR_CAGE]) * f[6]
        powers[j, 2, 4] = f[SHEAR_CAGE] * f[6]
        powers[j, 2, 5] = sheet[CAGE_ROUGH] * abs(f[5]) / sheet[CAGE_LOAD] if sheet[CAGE_LOAD] > 0.0 else 0.0


@jit_called
def book_stage(moment, span, orbit, record):
    """Book energies, peaks and pushes of a solved stage that counts for `span` [s] of the window."""
    stations, powers = moment.stations, moment.powers
    for j in range(powers.shape[0]):
        for i in range(3):
            power = powers[j, i, 0]
            record.energy[j, i] += span * power
            record.rolling_energy[j, i] += span * powers[j, i, 4]
            record.asperity_energy[j, i] += span * powers[j, i, 5]
            for k in range(3):
                record.mechanism_energy[j, i, k] += span * powers[j, i, k + 1]
            if orbit >= 0:
                record.orbit_energy[j, orbit, i] += span * power
                record.peak_power[j, orbit, i] = max(record.peak_power[j, orbit, i], power)
        push = moment.force[j, PUSH]
        if push != 0.0:
            side = 1 if push > 0.0 else 0
            record.impulse[j, side] += span * abs(push)
            record.push_time[j, side] += span
            record.largest_push[j, side] = max(record.largest_push[j, side], abs(push))
            place = int((stations.angle[j] / (2.0 * np.pi)) % 1.0 * 72.0) % 72
            record.largest_by_position[j, place] = max(record.largest_by_position[j, place], abs(push))


@jit_merged
def book_state(bearing, shaft_speed, moment, span, record):
    """Book spin ratios, ranges of the film law and the cages' slip for a state that counts for `span` [s]."""
    stations, state, cages, force = moment.stations, moment.values.rollers, moment.values.cages, moment.force
    pitch = bearing.pitch_radius
    rollers = bearing.rollers
    # Films are the same in both rows.
    model = bearing.models.downwind
    pure = -bearing.bodies[0].orbit_ratio * shaft_speed * bearing.outer_radius
    for j in range(rollers.row.size):
        surface = stations.outer_speed[j] - state[j, 1]
        if pure != 0.0:
            record.spin_ratio[j] = min(record.spin_ratio[j], surface / pure)
        inner, outer = stations.inner_load[j], stations.outer_load[j]
        if inner > 0.0:
            record.loaded_time[j, 0] += span
            if not film_in_range(model.inner.film, inner, abs(stations.inner_speed[j] - 0.5 * state[j, 0])):
                record.outside_time[j, 0] += span
        if outer > 0.0:
            record.loaded_time[j, 1] += span
            if not film_in_range(model.outer.film, outer, abs(stations.outer_speed[j] - 0.5 * state[j, 1])):
                record.outside_time[j, 1] += span
        if force[j, 5] != 0.0:
            record.loaded_time[j, 2] += span
            if not film_in_range(model.cage.film, abs(force[j, 5]), 0.5 * abs(force[j, 6])):
                record.outside_time[j, 2] += span
    if shaft_speed != 0.0:
        for c in range(bearing.cages):
            nominal = bearing.bodies[0].orbit_ratio * shaft_speed * pitch
            slip = cages[c, 0] / nominal
            record.slip_square[c, 0] += span
            record.slip_square[c, 1] += span * slip
            record.slip_square[c, 2] += span * slip * slip


@jit_called
def _film(contact, load, speed):
    return film_thickness(contact.film, load, max(speed, 1e-6))[0] if load > 0.0 else np.nan


@jit_merged
def write_output(bearing, index, shaft_speed, moment, record):
    """Write traces and books at output time `index`."""
    stations, state, cages = moment.stations, moment.values.rollers, moment.values.cages
    force, powers = moment.force, moment.powers
    record.flows[index] = record.book
    stocks(bearing, shaft_speed, state, cages, record.held[index])
    pitch, rollers = bearing.pitch_radius, bearing.rollers
    model = bearing.models.downwind
    for c in range(bearing.cages):
        turning = cages[c, 0] + 0.5 * shaft_speed * bearing.inner_radius
        line = record.cage_trace[index, c]
        line[0], line[1], line[2], line[3] = turning / pitch, cages[c, 1], cages[c, 4], cages[c, 5]
        line[4] = 0.0
    for j in range(rollers.row.size):
        f, line = force[j], record.trace[index, j]
        orbital = 0.5 * (state[j, 0] - state[j, 1] + shaft_speed * rollers.inner_radius[j])
        line[0] = (stations.outer_speed[j] - state[j, 1]) / bearing.radius
        line[1], line[2] = state[j, 0], state[j, 1]
        line[3] = stations.elastic_load[j]
        # Traction without rolling resistance, as on an imposed orbit.
        line[4], line[5], line[6] = f[0] - f[SHEAR_INNER], f[1] - f[SHEAR_OUTER], f[4] - f[SHEAR_CAGE]
        line[7] = f[5]
        line[8], line[9], line[10] = powers[j, 0, 0], powers[j, 1, 0], powers[j, 2, 0]
        line[11] = state[j, 2]
        line[12] = (orbital - 0.5 * shaft_speed * bearing.inner_radius) / pitch
        line[13] = _film(model.inner, stations.inner_load[j], abs(stations.inner_speed[j] - 0.5 * state[j, 0]))
        line[14] = _film(model.outer, stations.outer_load[j], abs(stations.outer_speed[j] - 0.5 * state[j, 1]))
        line[15] = _film(model.cage, abs(f[5]), 0.5 * abs(f[6]))
        line[19], line[20] = powers[j, 0, 3], powers[j, 1, 3]
        line[16], line[17], line[18] = powers[j, 0, 4], powers[j, 1, 4], powers[j, 2, 4]
        record.cage_trace[index, rollers.cage[j], 4] -= pitch * (f[5] + bearing.lever * f[4])
