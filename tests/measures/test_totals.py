"""From steps to numbers: totals against plain sums, peaks against known maxima, energies of places and stations, and samples."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip import Laws
from macroslip.compiled import jit
from macroslip.constants import SECTORS
from macroslip.contact.patch import fine_power
from macroslip.measures import details as sampling
from macroslip.measures.along import contacts_of
from macroslip.measures.details import ContactSampler, new_details
from macroslip.measures.maps import spread
from macroslip.measures.quadrature import quadrature_energies
from macroslip.measures.roller import RollerMeasures, Row, Wanted
from macroslip.measures.samples import PEAK, PEAKS, SAMPLE, choose, samples_of_peaks
from macroslip.measures.totals import (
    CONTACTS,
    END,
    HIGHEST_RISE,
    RACEWAYS,
    SPIN_RATIO_SPEED,
    book,
    contacts_at,
    highest_of_cubic,
    highest_of_parabola,
    law_times,
    loaded_contacts,
    new_totals,
    orbit_at,
)
from macroslip.roller.step import STEP
from tests.one_roller import RATED, limits_of, models, motion_of, rollers, walk
from tests.quick import COARSE

EDGES = np.array([0.5, 2.0, 7.9, 14.6])
WIDTH = 2.0 * math.pi / SECTORS
ANGLE = -0.55
#: A time under load after a sample of the loads, 4.9 s, by rounding only.
LATE = float(np.nextafter(4.9, 10.0))


@pytest.fixture(scope="module")
def walked():
    """A roller with all mechanisms through two and a half orbits with load zones: model, roller, motion and steps."""
    made = models(Laws.physical())
    roller = rollers(made, tolerance=COARSE.tolerance)["downwind"]
    motion = motion_of(
        np.linspace(0.0, 16.0, 321),
        RATED * (1.0 + 0.01 * np.sin(np.arange(321.0))),
        (0.0, -2.2e-4, 0.0),
    )
    steps, status, _ = walk(
        roller, motion, limits_of(roller, motion, 2e-4), sorted([*EDGES, LATE, 16.0]), ANGLE
    )
    assert status == 0 and LATE not in steps["end"] and 4.9 in steps["end"]
    return made["downwind"], roller, motion, steps


def booked(steps, cuts=()):
    return booked_with_contacts(steps, cuts)[0]


def booked_with_contacts(steps, cuts=()):
    """Totals, and loads and entrainment speeds at the ends of the steps."""
    totals = new_totals(EDGES, 0.4)
    contacts = np.zeros(steps.size, CONTACTS)
    for part, at_ends in zip(np.split(steps, cuts), np.split(contacts, cuts), strict=True):
        book(part[:, None].copy(), 0, totals, np.zeros(part.size, END), at_ends)
    return totals, contacts


def test_totals_are_sums_over_the_steps(walked):
    steps = walked[3]
    totals, inside = booked(steps), steps[steps["start"] >= EDGES[0]]
    weight = inside["weight"][..., None]
    for name, field in (
        ("energy", "power"),
        ("rolling_energy", "rolling"),
        ("asperity_energy", "rough"),
    ):
        expected = (weight * inside[field]).sum(axis=(0, 1))
        assert (expected[:2] > 0.0).all()
        np.testing.assert_allclose(getattr(totals, name), expected, rtol=1e-10)
    lag, skew = ((weight * inside[name]).sum(axis=(0, 1)) for name in ("lag_power", "skew_power"))
    np.testing.assert_allclose(
        totals.mechanism_energy[:2, 1:], np.stack([lag, skew], axis=1), rtol=1e-9
    )
    np.testing.assert_allclose(totals.mechanism_energy.sum(axis=1), totals.energy, rtol=1e-10)
    assert (totals.mechanism_energy[2, 1:] == 0.0).all()
    middle = 0.5 * (inside["start"] + inside["end"])
    for orbit in range(3):
        here = inside[(middle >= EDGES[orbit]) & (middle < EDGES[orbit + 1])]
        np.testing.assert_allclose(
            totals.orbit_energy[orbit],
            (here["weight"][..., None] * here["power"]).sum(axis=(0, 1)),
            rtol=1e-10,
        )
        # A peak is at least the largest sample and, by the polynomial, at most a tenth above it.
        largest = np.where(
            (np.arange(3) < here["stages"][:, None])[..., None], here["power"], 0.0
        ).max(axis=(0, 1))
        largest = np.maximum(largest, here["power_before"][0])
        assert (totals.peak_power[orbit] >= largest).all() and (
            totals.peak_power[orbit] <= HIGHEST_RISE * largest
        ).all()
    rows = inside[inside["weight"][:, 0] > 0.0]
    ratio = ((rows["outer_speed"] - rows["outer_slip"])[:, 2] / rows["pure_speed"]).min()
    assert totals.spin_ratio[0] == pytest.approx(ratio, rel=1e-12)


def test_nothing_depends_on_where_buffers_end(walked):
    steps = walked[3]
    whole = booked(steps)
    for cuts in ([5], [1, 2, 3, 100], range(1, steps.size)):
        for name, other in booked(steps, cuts)._asdict().items():
            np.testing.assert_array_equal(other, getattr(whole, name), err_msg=name)


def test_spin_ratio_is_taken_where_rings_run(walked):
    slow = walked[3].copy()
    slow["pure_speed"] = 0.9 * SPIN_RATIO_SPEED * 0.4
    assert booked(slow).spin_ratio[0] == math.inf


def test_time_with_load_and_out_of_range(walked):
    model, _, _, steps = walked
    times = law_times(booked_with_contacts(steps)[1], model.laws)
    inside = steps[(steps["start"] >= EDGES[0]) & (steps["weight"][:, 0] > 0.0)]
    span = inside["end"] - inside["start"]
    loaded = [
        inside["inner_load"][:, 2] > 0.0,
        inside["outer_load"][:, 2] > 0.0,
        inside["cage_load"][:, 2] != 0.0,
    ]
    np.testing.assert_allclose(times[0], [span[carrying].sum() for carrying in loaded], rtol=1e-10)
    assert ((times[1:] >= 0.0) & (times[1:] <= times[0] * (1 + 1e-12))).all()
    loads = inside["inner_load"][:, 2]
    light = (loads > 0.0) & ~model.laws.inner.asperity_share_in_range(np.maximum(loads, 1e-9))
    assert times[2, 0] == pytest.approx(span[light].sum(), rel=1e-10)


def test_load_of_films_is_what_raceways_carry_beside_the_rings(walked):
    """Against a trapezoid through the ends of the steps."""
    _, _, _, steps = walked
    time, films = booked(steps).film_load
    inside = steps[steps["start"] >= EDGES[0]]
    assert time == pytest.approx(16.0 - EDGES[0], rel=1e-12)
    at, last = inside["end"], inside["stages"] - 1
    load = {
        name: inside[name][np.arange(at.size), last]
        for name in ("elastic_load", "inner_load", "outer_load")
    }
    beside = np.minimum(load["inner_load"], load["outer_load"]) - load["elastic_load"]
    assert films == pytest.approx(np.trapezoid(beside, at), rel=0.05) and films > 0.0


# --- Peaks -----------------------------------------------------------------------------------------------------------


@given(top=st.floats(-0.9, 0.9), height=st.floats(0.1, 100.0), bend=st.floats(0.1, 10.0))
def test_vertex_of_a_parabola_is_exact(top, height, bend):
    points = (number for t in (-1.0, 0.2, 1.0) for number in (t, height - bend * (t - top) ** 2))
    assert highest_of_parabola(*points) == pytest.approx(height, rel=1e-12, abs=1e-9)
    assert highest_of_parabola(0.0, 1.0, 1.0, 2.0, 2.0, 3.0) == 3.0


@given(
    coefficients=st.tuples(*[st.floats(-10.0, 10.0).map(lambda x: round(x, 3))] * 4),
    middle=st.floats(0.1, 0.5),
)
def test_highest_value_of_a_cubic_is_that_of_its_critical_points(coefficients, middle):
    """Against NumPy's roots of the derivative."""
    curve = np.polynomial.Polynomial(coefficients)
    times = np.array([-1.0, middle - 0.9, middle, 1.0])
    points = [number for t in times for number in (t, curve(t))]
    critical = curve.deriv().trim(1e-9).roots()
    inside = critical[np.isreal(critical)].real
    inside = inside[(inside > -1.0) & (inside < 1.0)]
    expected = max(curve(np.concatenate([inside, [-1.0, 1.0]])))
    assert highest_of_cubic(*points) == pytest.approx(expected, rel=1e-9, abs=1e-9)


#: Stages of the Radau method, as parts of a step.
NODES = (0.4 - 0.1 * math.sqrt(6.0), 0.4 + 0.1 * math.sqrt(6.0), 1.0)


def peaks_of(times, power, *, nodes=NODES, before=None):
    """Peaks at the inner raceway and at the cage of a power, by orbit, of steps between these times.

    Parameters
    ----------
    power : callable
        Power at a time.
    nodes : tuple of float, optional
        Stages of a step, as parts of it.
    before : callable, optional
        Power before the start of a step, if it is another one.
    """
    rows = np.zeros((len(times) - 1, 1), STEP)
    for row, (start, end) in zip(rows[:, 0], itertools.pairwise(times), strict=True):
        row["start"], row["end"], row["stages"] = start, end, len(nodes)
        row["power_before"][[0, 2]] = (before or power)(start)
        for k, node in enumerate(nodes):
            row["time"][k] = start + node * (end - start)
            row["weight"][k] = (end - start) / len(nodes)
            row["power"][k, [0, 2]] = power(row["time"][k])
    totals = new_totals(np.array([0.0, 50.0, 60.0]), 1.0)
    book(rows, 0, totals, np.zeros(len(rows), END), np.zeros(len(rows), CONTACTS))
    return totals.peak_power[:, [0, 2]]


def test_error_of_a_smooth_peak_is_of_fourth_order():
    errors = [
        max(
            abs(
                peaks_of(np.arange(first, 5.0, step), lambda t: math.exp(math.sin(t)))[0, 0]
                - math.e
            )
            for first in np.arange(0.13, 0.53, 0.05)
        )
        for step in (0.4, 0.2, 0.1)
    ]
    assert errors[0] < 2e-3 * math.e
    assert errors[2] < errors[0] / 4**3.5


@pytest.mark.parametrize("nodes", [NODES, (0.0, 0.5, 1.0), (0.3, 1.0), (1.0,)])
def test_a_kink_at_the_end_of_a_step_is_the_peak(nodes):
    def power(t):
        return math.exp(t - 1.0) if t < 1.0 else math.exp(-20.0 * (t - 1.0))

    assert peaks_of([0.6, 1.0, 1.1], power, nodes=nodes)[0].tolist() == [1.0, 1.0]


def test_a_jump_of_the_cages_power_between_steps_is_no_rise():
    """The cubic through the power before the jump is a tenth too high, at a raceway, where there is none."""
    raceway, cage = peaks_of([1.0, 2.0], lambda t: 1.0 - 0.01 * t, before=lambda t: 0.5)[0]
    assert cage == pytest.approx(1.0 - 0.01 * (1.0 + NODES[0]), rel=1e-12)
    assert raceway > 1.01 * cage
    # Power that is highest at the start of a step, after a jump, counts as well.
    assert peaks_of([1.0, 2.0], lambda t: 1.0 - 0.01 * t, before=lambda t: 3.0)[0, 1] == 3.0


def test_a_kink_inside_a_step_adds_a_tenth_at_most():
    kinked = peaks_of([0.0, 1.0, 2.0], lambda t: max(0.0, 1.0 - 20.0 * abs(t - NODES[1])))[0, 0]
    assert 1.0 <= kinked <= HIGHEST_RISE


def test_samples_of_a_step_are_the_peak_themselves():
    """The end of a film is a cusp among them, over which a parabola would rise."""
    rows = np.zeros((2, 1), STEP)
    samples, step = rows[:, 0]
    samples["stages"], step["stages"], step["sampled"] = 3, 3, True
    samples["time"], samples["power"][:, 0] = (0.40, 0.45, 0.50), (1.6, 2.0, 1.99)
    step["time"], step["power"][:, 0] = (0.155, 0.645, 1.0), (1.8, 1.9, 1.7)
    samples["end"], step["end"], step["weight"] = 0.50, 1.0, 1.0 / 3.0
    samples["power_before"] = step["power_before"] = 1.5
    totals = new_totals(np.array([0.0, 50.0]), 1.0)
    book(rows, 0, totals, np.zeros(2, END), np.zeros(2, CONTACTS))
    assert totals.peak_power[0, 0] == 2.0


def test_outside_all_orbits_powers_count_for_the_rest_of_the_window():
    assert peaks_of([70.0, 71.0, 72.0], lambda t: 5.0)[:, 0].tolist() == [0.0, 0.0, 5.0]
    assert [orbit_at(EDGES, time, -1) for time in (0.4, 0.5, 1.9, 2.0, 14.5, 14.6)] == [
        -1,
        0,
        0,
        1,
        2,
        -1,
    ]


# --- Details ---------------------------------------------------------------------------------------------------------


def sampled(walked, cuts=(), edges=EDGES):
    model, roller, motion, steps = walked
    sampler = ContactSampler(
        Wanted(edges, 0.4, np.zeros(0), True),
        roller,
        model.laws,
        contacts_of(model.laws),
        motion,
        ANGLE,
    )
    for part in np.split(steps, cuts):
        sampler.add(part[:, None].copy(), 0)
    sampler.finish()
    return sampler


def looked(*arguments, **keywords):
    return sampled(*arguments, **keywords).details


@pytest.fixture(scope="module")
def details(walked):
    return looked(walked)


def test_energies_of_stations_and_places_add_up_to_the_energy(walked, details):
    energy = booked(walked[3]).energy[:2]
    np.testing.assert_allclose(details.station_energy.sum(axis=1), energy, rtol=1e-9)
    np.testing.assert_allclose(details.surface_energy.sum(axis=(1, 2, 3, 4)), energy, rtol=1e-9)
    np.testing.assert_allclose(
        details.surface_energy.sum(axis=(1, 3, 4)), details.station_energy, rtol=1e-9
    )
    assert (details.station_energy >= 0.0).all() and (details.surface_density >= 0.0).all()
    # The outer raceway is loaded at the bottom; flooded rollers slide without load too.
    by_sector = details.surface_energy[1].sum(axis=(1, 2, 3))
    assert by_sector[45:63].sum() > 0.8 * by_sector.sum()


def test_looks_do_not_depend_on_where_buffers_end(walked, details):
    for name, other in looked(walked, [3, 50, 51, 200])._asdict().items():
        if name not in ("memory", "maps"):
            np.testing.assert_allclose(other, getattr(details, name), rtol=1e-12, err_msg=name)


def test_fewer_looks_than_steps_are_nearly_as_good(walked, details, monkeypatch):
    """Against samples at every step: extremes low by little, and little energy at other stations."""
    assert details.memory["count"][0] < 0.8 * np.count_nonzero(walked[3]["weight"][:, 0])
    model, roller, motion, steps = walked
    sampler = ContactSampler(
        Wanted(EDGES, 0.4, np.zeros(0), True, spacing=0.0),
        roller,
        model.laws,
        contacts_of(model.laws),
        motion,
        ANGLE,
    )
    for row in steps:
        sampler.add(np.array([[row]]), 0)
    sampler.finish()
    every = sampler.details
    assert every.memory["count"][0] == np.count_nonzero(
        (steps["weight"][:, 0] > 0.0) & (steps["start"] >= EDGES[0])
    )
    moved = np.abs(details.station_energy - every.station_energy).sum() / every.station_energy.sum()
    assert moved < 0.01
    for k in range(3):
        np.testing.assert_allclose(details.extreme[:, :2, k], every.extreme[:, :2, k], rtol=0.1)
    assert (details.extreme[:, :2, :3] <= every.extreme[:, :2, :3] * (1 + 1e-9)).all()
    assert (details.extreme[:, :2, 3] >= every.extreme[:, :2, 3] * (1 - 1e-9)).all()


def test_films_at_looks_are_those_of_the_law(walked, monkeypatch):
    """Samples look films and shares of asperities up in tables; the laws give them without."""
    taken = []
    begin_samples = sampling._begin_samples

    def begin_and_keep(samples, *others):
        columns = begin_samples(samples, *others)
        taken.append(samples.copy())
        return columns

    monkeypatch.setattr(sampling, "_begin_samples", begin_and_keep)
    looked(walked)
    samples = np.concatenate(taken)
    at_samples = np.zeros(samples.size, CONTACTS)
    contacts_at(samples["at"], at_samples)
    for i, (law, load, entrainment) in enumerate(loaded_contacts(at_samples, walked[0].laws)):
        loaded = load > 0.0
        state = load[loaded], entrainment[loaded]
        film = law.film_thickness(*state)
        np.testing.assert_allclose(samples["film"][loaded, i], film, rtol=1e-4)
        share = law.asperity_share(*state, film)
        np.testing.assert_allclose(samples["share"][loaded, i], share, atol=1e-3)


@jit
def spread_once(maps, interface, way, mean_time, spent, before, after):
    spread(maps, interface, way, mean_time, spent, before, after)


def test_energy_between_two_looks_lies_as_at_both_of_them():
    """In parts that the mean time of the energy gives; with one look only, a fast change would lie at wrong stations."""
    details = new_details(EDGES)
    maps = details.maps
    before, after = maps["along"][0, 2:4]
    before["positive"][3], after["positive"][20] = 2.0, 5.0
    before["first"], before["behind"] = 3, 4
    after["first"], after["behind"] = 20, 21
    spent = (0.3 * 8.0 / 2.0, 0.7 * 8.0 / 5.0, 0.0, 0.0, 0.0, 0.0)
    spread_once(maps[0], 1, (0.5, 0.5), 0.7, spent, before, after)
    stations = details.station_energy[1]
    assert stations[3] == pytest.approx(2.4) and stations[20] == pytest.approx(5.6)


def test_extremes(details):
    flash, density, ratio, film = np.moveaxis(details.extreme, -1, 0)
    assert (
        (flash[:, :2] > 0.0).all()
        and (density[:, :2] > 1e3).all()
        and ((ratio > 0.0) & (ratio < 3.0)).all()
    )
    assert ((film[:, :2] > 0.01) & (film[:, :2] < 100.0)).all()


def test_the_quadrature_is_checked_for_all_rollers_of_a_row_at_once(walked, monkeypatch):
    """Each roller's energy is ∫τ v dA of its own samples, by the finer rule one at a time."""
    monkeypatch.setattr(sampling, "_FINE", 50)
    model = walked[0]
    contacts = contacts_of(model.laws)
    parts = [sampled(walked, edges=edges).checked for edges in (EDGES, EDGES + 1.0)]
    parts.insert(1, parts[0][:0])
    energies = quadrature_energies(model.laws, contacts, parts)
    fine, off = np.moveaxis(energies, -1, 0)
    assert (fine[[0, 2]] > 0.0).all() and (off < 5e-3 * fine)[[0, 2]].all()
    assert not fine[1].any() and not off[1].any()
    for k, samples in enumerate(parts):
        for i, name in enumerate(RACEWAYS):
            one_by_one = 0.0
            for sample in samples:
                state = sample["at"]
                if state[f"{name}_load"] > 0.0:
                    one_by_one += (sample["time"] - sample["since"]) * fine_power(
                        contacts[i].patch,
                        getattr(model.laws, name).fluid,
                        state[f"{name}_load"],
                        sample["film"][i],
                        state[f"{name}_speed"],
                        state[f"{name}_slip"],
                    )
            assert fine[k, i] == pytest.approx(one_by_one, rel=1e-12)


def by_brute_force(start, end, energy, growth=0.0):
    """Energy of each sector from a hundred thousand equal pieces of the way."""
    parts = (np.arange(100_000) + 0.5) / 100_000
    weights = energy * (1.0 + growth * (2.0 * parts - 1.0)) / parts.size
    return np.bincount(
        np.floor(start + (end - start) * parts).astype(int) % SECTORS, weights, minlength=SECTORS
    )


@pytest.mark.parametrize("interface", [0, 1])
@pytest.mark.parametrize("mean_time", [0.5, 0.61, 0.4])
@pytest.mark.parametrize(
    ("start", "end"), [(-17.2, -16.1), (4.6, 41.3), (35.0, 29.7), (0.0, 208.0), (11.4, 11.4)]
)
def test_energy_lies_where_the_roller_passes(interface, start, end, mean_time):
    details, energy = new_details(EDGES), 8.0
    before, after = details.maps["along"][0, :2]
    after["negative"][3], after["positive"][10], after["regime"] = 2.0, 6.0, 1
    after["first"], after["behind"] = 3, 11
    spent = (0.0, energy / 8.0, 0.0, 0.0, 0.0, 0.0)
    spread_once(details.maps[0], interface, (start, end), mean_time, spent, before, after)
    surface = details.surface_energy
    expected = by_brute_force(start, end, energy, 3.0 * (2.0 * mean_time - 1.0))
    np.testing.assert_allclose(surface.sum(axis=(0, 2, 3, 4)), expected, atol=2e-3)
    assert surface.sum() == pytest.approx(energy, rel=1e-12) and surface[1 - interface].sum() == 0.0
    # A quarter of it where slip is negative, the rest where it is positive, all in the film regime of the powers.
    assert surface[interface, :, 3, 0, 1].sum() == pytest.approx(0.25 * energy)
    assert surface[interface, :, 10, 1, 1].sum() == pytest.approx(0.75 * energy)


def test_no_power_along_the_roller_takes_no_energy(walked):
    model, roller, motion, steps = walked
    idle = steps[np.argmax(steps["start"] >= EDGES[0])].copy()
    idle["inner_load"] = idle["outer_load"] = 0.0
    details = looked((model, roller, motion, np.array([idle])))
    assert details.surface_energy.sum() == 0.0 == details.station_energy.sum()


def test_what_makes_a_look_due(walked):
    """After a change of power or a way; thresholds pin the numbers that choose samples."""
    _, roller, _, steps = walked
    held = steps[np.argmax(steps["elastic_load"][:, 2])]

    def count(change, turn=0.0, spacing=1.0, length=0.1):
        rows = np.zeros((2, 1), STEP)
        rows[:, 0] = held
        radius = float(roller.body[0]["outer_radius"])
        rows["start"][:, 0], rows["end"][:, 0] = (
            [1.1 - length, 1.1],
            [1.1, 1.1 + max(turn * radius / 0.4, 1e-3)],
        )
        for name in ("inner_slip", "outer_slip", "outer_speed", "inner_load", "outer_load"):
            rows[name] = {"slip": 1e-3, "peed": -0.4, "load": 1e4}[name[-4:]]
        rows["power"] = 10.0
        for name, value in change.items():
            rows[name.split()[0]][1, 0][(..., int(name[-1])) if " " in name else ...] = value
        details = new_details(EDGES)
        orbits = EDGES, details.entries, np.zeros((EDGES.size - 1, PEAKS), PEAK)
        return choose(rows, 0, orbits, details.memory, radius, spacing, np.zeros(2, SAMPLE))

    assert count({}) == 1
    for name, few, many in (
        ("power 0", 10.2, 10.4),
        ("power 0", 9.4, 9.2),
        ("power 1", 10.2, 10.4),
        ("power 1", 9.4, 9.2),
    ):
        assert count({name: few}) == 1 and count({name: many}) == 2, (name, few, many)
    assert count({"power 2": 0.0}) == 1 and count({"outer_slip": 1e-2}) == 1
    assert count({}, turn=0.14) == 1 and count({}, turn=0.16) == 2
    # A roller that turns back passes the same sectors once more.
    assert count({"outer_speed": 0.4}) == 2
    # After eight times the step before: a step of 1 ms.
    assert count({}, length=0.13e-3) == 1 and count({}, length=0.12e-3) == 2
    # Closer samples where they are asked for.
    assert count({}, turn=0.14, spacing=0.5) == 2 and count({"power 0": 9.4}, spacing=0.5) == 2


def test_an_entry_is_sampled_more_closely_and_to_its_end(walked):
    """Its power is compared with the highest since it began, and the step that ends it belongs to it."""
    _, roller, _, steps = walked
    held = steps[np.argmax(steps["elastic_load"][:, 2])]
    rows = np.zeros((6, 1), STEP)
    rows[:, 0] = held
    edges = 1.0 + 1e-4 * np.arange(7)
    rows["start"][:, 0], rows["end"][:, 0] = edges[:-1], edges[1:]
    rows["outer_speed"], rows["inner_load"], rows["outer_load"] = -0.4, 1e4, 1e4
    rows["elastic_load"][:, 0] = np.array([0.0, 1e4, 1e4, 1e4, 1e4, 1e4])[:, None]
    # A hundredth of the power before, which alone would not ask for a sample.
    powers = np.array([1000.0, 10.0, 10.2, 10.6, 10.7, 10.7])
    rows["power"] = 0.0
    rows["power"][:, 0, :, 0] = powers[:, None]
    rows["outer_slip"] = 0.1
    rows["outer_slip"][5] = 1e-3
    details = new_details(EDGES)
    samples = np.zeros(6, SAMPLE)
    orbits = EDGES, details.entries, np.zeros((EDGES.size - 1, PEAKS), PEAK)
    radius = float(roller.body[0]["outer_radius"])
    number = choose(rows, 0, orbits, details.memory, radius, 1.0, samples)
    assert samples["time"][:number] == pytest.approx(edges[[1, 2, 4, 6]])
    assert samples["entry"][:number].tolist() == [0, 1, 1, 1]


def test_peaks_are_the_highest_states_of_their_orbits(walked):
    """Each is a sample without energies, once where several values are highest at one time."""
    _, roller, _, steps = walked
    inside = steps[(steps["weight"][:, 0] > 0.0) & (steps["start"] >= EDGES[0])]
    details = new_details(EDGES)
    peaks = np.zeros((EDGES.size - 1, PEAKS), PEAK)
    orbits = EDGES, details.entries, peaks
    radius = float(roller.body[0]["outer_radius"])
    room = np.zeros(inside.size, SAMPLE)
    choose(inside[:, None], 0, orbits, details.memory, radius, 1.0, room)
    last = inside["stages"] - 1
    at_end = np.arange(inside.size)
    middle = 0.5 * (inside["start"] + inside["end"])
    power = inside["power"][at_end, last]
    for orbit in range(EDGES.size - 1):
        of_orbit = (EDGES[orbit] <= middle) & (middle < EDGES[orbit + 1])
        for i in range(3):
            assert peaks[orbit, i]["value"] == power[of_orbit, i].max()
            assert peaks[orbit, i]["at"]["power"][i] == power[of_orbit, i].max()
            assert peaks[orbit, i]["time"] == inside["end"][of_orbit][power[of_orbit, i].argmax()]
    samples = samples_of_peaks(peaks)
    assert (
        np.unique(samples["time"]).size
        == samples.size
        == np.unique(peaks["time"][peaks["value"] > 0.0]).size
    )
    assert not samples["energy"].any() and (samples["since"] == samples["time"]).all()


# --- Traces ----------------------------------------------------------------------------------------------------------


def test_traces_are_the_states_at_their_times(walked):
    model, roller, motion, steps = walked
    times = np.array([0.0, 2.0, LATE, 16.0])
    row = Row(model, roller, motion, Wanted(EDGES, 0.4, times, False))
    for cuts in ((), (1, 30, 31)):
        measures = RollerMeasures(row, ANGLE)
        for part in np.split(steps, cuts):
            measures.add(part[:, None].copy(), 0)
        measures.finish()
        traces = measures.traces()
        speed = (
            np.interp(times, motion.time, motion.shaft_speed)
            * model.orbit_ratio
            * model.outer_radius
        )
        np.testing.assert_allclose(traces["spin_pure"], -speed / model.radius, rtol=1e-12)
        for k, time in enumerate(times[1:], start=1):
            at = steps[(np.abs(steps["end"] - time) < 1e-12) & (steps["weight"][:, 0] > 0.0)][0]
            assert (
                traces["slip"][k] == at["outer_slip"][2]
                and traces["roller_load"][k] == at["elastic_load"][2]
            )
            np.testing.assert_array_equal(traces["power"][k], at["power"][2])
            skew = -at["skew_power"][2] / (at["outer_speed"][2] * np.array([1.0, -1.0]))
            skew /= [model.laws.inner.shape.spin_ratio, model.laws.outer.shape.spin_ratio]
            np.testing.assert_allclose(traces["skew_moment"][k], skew, rtol=1e-12)
        assert measures.details is None and measures.end_slip == steps["outer_slip"][-1, 2]
    # Where an integration ended early there is none.
    measures = RollerMeasures(row, ANGLE)
    measures.add(steps[steps["end"] < 4.0][:, None].copy(), 0)
    assert np.isnan(measures.traces()["slip"]).tolist() == [False, False, True, True]
