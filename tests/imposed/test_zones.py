"""Classes of sample intervals against dense sampling, and the load from which a roller is firmly held."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from macroslip import Laws
from macroslip.imposed.tuning import FIRM_RATE, FIRM_RATE_MICROSLIP
from macroslip.imposed.zones import (
    EDGE,
    FIRM,
    FREE,
    classify,
    edge_time,
    firm_approach,
    relaxation_rate,
)
from tests.one_roller import models, motion_of, rollers
from tests.quick import COARSE

RATED_SURFACE_SPEED = 0.39594


@pytest.fixture(scope="module")
def paper():
    return models(Laws.paper())


@pytest.fixture(scope="module")
def made(paper):
    return rollers(paper, load=3e5, speeds=(-0.4, 5.0))


def direct(model, motion, start_angle, time):
    """δ at any times, from interpolated samples and the integrated speed."""
    d = np.column_stack([np.interp(time, motion.time, part) for part in motion.displacement.T])
    k = np.clip(np.searchsorted(motion.time, time, side="right") - 1, 0, motion.time.size - 2)
    here = np.interp(time, motion.time, motion.shaft_speed)
    turned = motion.shaft_angle[k] + 0.5 * (motion.shaft_speed[k] + here) * (time - motion.time[k])
    angle = start_angle + model.orbit_ratio * turned
    radial = d[:, 0] * np.cos(angle) + d[:, 1] * np.sin(angle) - model.radial_play
    return radial * model.cos_contact_angle + d[:, 2] * model.sin_contact_angle


def classes_of(roller, motion, start_angle, firm):
    classes = np.full(motion.time.size - 1, 9, dtype=np.int8)
    classify(roller.body[0], motion, float(start_angle), float(firm), classes)
    return classes


lengths = st.floats(-4e-4, 4e-4)
samples = st.tuples(st.floats(1e-3, 0.3), st.floats(-3.0, 3.0), lengths, lengths, lengths)


@pytest.mark.parametrize("row", ["downwind", "upwind"])
@given(
    st.lists(samples, min_size=2, max_size=6),
    st.floats(-4.0, 4.0),
    st.sampled_from([0.0, 1e-5, 5e-5]),
)
@settings(max_examples=150)
def test_no_interval_is_free_or_firm_that_is_not(paper, made, row, history, start_angle, firm):
    time = np.cumsum([sample[0] for sample in history])
    motion = motion_of(time, [sample[1] for sample in history], [sample[2:] for sample in history])
    for k, zone in enumerate(classes_of(made[row], motion, start_angle, firm)):
        dense = direct(paper[row], motion, start_angle, np.linspace(time[k], time[k + 1], 201))
        assert zone in (FREE, EDGE, FIRM)
        assert zone != FREE or dense.max() <= 1e-15
        assert zone != FIRM or dense.min() >= firm - 1e-15


speeds, rises = st.floats(-3.0, 3.0), st.floats(-1e-5, 1e-5)


@pytest.mark.parametrize("steady", [True, False], ids=["steady", "accelerated"])
@given(st.floats(1e-3, 0.2), speeds, speeds, st.floats(-4.0, 4.0), lengths, lengths, rises, rises)
@settings(max_examples=200)
def test_load_that_comes_and_goes_within_an_interval_is_an_edge(
    paper, made, steady, span, near, far, angle, dx, dy, rise_x, rise_y
):
    # The ring is put along Z0 so that both ends just miss the load that the middle has, or hold firmly while it does
    # not: turning, reversing and accelerating shafts, with and without a ring that follows.
    model, far = paper["downwind"], near if steady else far
    ring = np.array([[dx, dy, 0.0], [dx + rise_x, dy + rise_y, 0.0]])
    dense = direct(
        model, motion_of([0.0, span], [near, far], ring), angle, np.linspace(0.0, span, 401)
    )
    above, below = dense.max() - max(dense[0], dense[-1]), min(dense[0], dense[-1]) - dense.min()
    firm = 1e-5
    ways = (
        (above, -max(dense[0], dense[-1]) - 0.9 * above, FREE),
        (below, firm - min(dense[0], dense[-1]) + 0.9 * below, FIRM),
    )
    for level, forbidden in (
        (level, forbidden) for excess, level, forbidden in ways if excess > 1e-13
    ):
        ring[:, 2] = level / model.sin_contact_angle
        motion = motion_of([0.0, span], [near, far], ring)
        assert classes_of(made["downwind"], motion, angle, firm).tolist() != [forbidden]


def test_classes_are_not_needlessly_edge(paper, made):
    # A turn of the bearing under radial load, sampled finely: an edge only where the load begins or ends.
    motion, firm = motion_of(np.arange(0.0, 10.0, 0.005), 2.143, (0.0, -2.5e-4, 0.0)), 1e-5
    classes = classes_of(made["downwind"], motion, 0.3, firm)
    dense = direct(paper["downwind"], motion, 0.3, motion.time)
    ends = np.stack([dense[:-1], dense[1:]])
    assert np.mean(classes == FREE) == pytest.approx(np.mean(ends.max(axis=0) < 0.0), abs=0.002)
    assert np.mean(classes == FIRM) == pytest.approx(np.mean(ends.min(axis=0) > firm), abs=0.002)
    assert np.mean(classes == FREE) > 0.2 < np.mean(classes == FIRM)
    still = motion_of([0.0, 100.0], 0.0, (0.0, 0.0, 0.0))
    assert classes_of(made["downwind"], still, 0.0, 1e-5).tolist() == [FREE]


def test_edge_time_is_where_the_load_begins(paper, made):
    model, body = paper["downwind"], made["downwind"].body[0]
    motion = motion_of([0.0, 1.5], [2.0, 2.2], [[0.0, -2.5e-4, 1e-5], [1e-5, -2.4e-4, 0.0]])
    crossings = 0
    for start, end in [(0.0, 1.5), (0.1, 1.2)]:
        for angle in np.linspace(-3.1, 3.1, 41):

            def approach(t, angle=angle):
                return direct(model, motion, angle, np.array([t]))[0]

            time = edge_time(body, motion, float(angle), 0, start, end)
            if approach(start) * approach(end) < 0.0:
                crossings += 1
                assert time == pytest.approx(brentq(approach, start, end, xtol=1e-15), abs=1e-12)
                # The far side is returned: there the sign has changed, and the edge is not found again.
                assert edge_time(body, motion, float(angle), 0, time, end) == end
            else:
                assert time == end
    assert 10 < crossings < 72


@pytest.mark.parametrize(("load", "seconds"), [(1e3, 3.77e-3), (5e4, 2.25e-11), (1e5, 3.42e-14)])
def test_relaxation_time_by_hand(paper, made, load, seconds):
    # I/(r² ΣF') with the isothermal patch integral [e^P (P − 1) + 1]/P², written here.
    total = 0.0
    for law in paper["downwind"].laws[:2]:
        hertz = law.interface.hertz
        p = 21e-9 * hertz.pressure * load ** (1 / 3)
        area = math.pi * hertz.semi_axis_across * hertz.semi_axis_along * load ** (2 / 3)
        film = float(law.film_thickness(load, RATED_SURFACE_SPEED))
        total += 2 * area * 0.54 / film * (math.exp(p) * (p - 1) + 1) / p**2
    mass = 7850.0 * math.pi * 0.035**2 * 0.106
    roller = made["downwind"]
    assert relaxation_rate(
        roller.body[0], roller.tables.ctypes.data, load, RATED_SURFACE_SPEED
    ) == pytest.approx(2 / mass * total, rel=1e-6)
    assert mass / 2 / total == pytest.approx(seconds, rel=0.01, abs=0.0)


@pytest.mark.parametrize(
    ("laws", "rate"), [(Laws.paper(), FIRM_RATE), (Laws.physical(), FIRM_RATE_MICROSLIP)]
)
def test_a_firm_roller_relaxes_at_the_firm_rate(laws, rate):
    roller = rollers(models(laws), tolerance=COARSE.tolerance)["downwind"]
    body, tables = roller.body[0], roller.tables.ctypes.data

    def at(load, speed=RATED_SURFACE_SPEED):
        return relaxation_rate(body, tables, float(load), float(speed))

    load = float(body["stiffness"]) * firm_approach(body, tables, RATED_SURFACE_SPEED) ** 1.5
    assert at(load) == pytest.approx(rate, rel=1e-9)
    for more in (1.05, 2.0, 5.0):
        assert at(more * load) > rate > at(load / more)
    # Slower rings hold no less firmly.
    assert min(at(load, speed) for speed in np.geomspace(0.05, RATED_SURFACE_SPEED, 20)) >= rate * (
        1 - 1e-3
    )
    rates = [at(slip) for slip in np.geomspace(1e-3, 1e5, 40)]
    assert np.all(np.isfinite(rates)) and np.all(np.diff(rates) > 0.0)
