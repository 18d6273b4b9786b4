"""Classes of sample intervals against dense sampling, and the load from which a roller is firmly held."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from macroslip.film.film_law import film_thickness
from macroslip.integrate.entries import sealed
from macroslip.integrate.held_contact import relaxation_rate
from macroslip.integrate.load_zone import (
    EDGE,
    FIRM,
    FREE,
    classify,
    edge_time,
    empty_classes,
    firm_interference,
    interference_at,
)
from macroslip.integrate.tuning import FIRM_RATE, FIRM_RATE_MICROSLIP
from macroslip.mechanisms import Laws
from macroslip.ring.orbit import Motion, shaft_angle
from macroslip.roller.model import interfaces, roller_model

RATIO = 0.4539395888955974  # Ω/Ω_in
RATED_SURFACE_SPEED = 0.39594  # Ω r~_out at 20.463 rpm [m/s]


def motion_of(time, speed, displacement):
    time, speed = np.asarray(time, dtype=float), np.asarray(speed, dtype=float)
    return Motion(time, speed, shaft_angle(time, speed), np.asarray(displacement, dtype=float))


def direct_interference(model, motion, start_angle, time):
    """δ at any times, from interpolated samples and the integrated speed."""
    d = np.column_stack([np.interp(time, motion.time, part) for part in motion.displacement.T])
    k = np.clip(np.searchsorted(motion.time, time, side="right") - 1, 0, motion.time.size - 2)
    since = time - motion.time[k]
    here = np.interp(time, motion.time, motion.shaft_speed)
    turned = motion.shaft_angle[k] + 0.5 * (motion.shaft_speed[k] + here) * since
    angle = start_angle + model.orbit_ratio * turned
    radial = d[:, 0] * np.cos(angle) + d[:, 1] * np.sin(angle) - model.radial_play
    return radial * model.cos_contact_angle + d[:, 2] * model.sin_contact_angle


def classes_of(model, motion, start_angle, firm):
    classes = empty_classes(motion.time.size)
    classify(model, motion, start_angle, firm, classes)
    return classes


def check_classes(model, motion, start_angle, firm):
    classes = classes_of(model, motion, start_angle, firm)
    for k, found in enumerate(classes):
        time = np.linspace(motion.time[k], motion.time[k + 1], 201)
        dense = direct_interference(model, motion, start_angle, time)
        assert found in (FREE, EDGE, FIRM)
        assert found != FREE or dense.max() <= 1e-15
        assert found != FIRM or dense.min() >= firm - 1e-15
    return classes


lengths = st.floats(-4e-4, 4e-4)
samples = st.tuples(st.floats(1e-3, 0.3), st.floats(-3.0, 3.0), lengths, lengths, lengths)


@pytest.mark.parametrize("sign", [1, -1], ids=["downwind", "upwind"])
@given(st.lists(samples, min_size=2, max_size=6), st.floats(-4.0, 4.0), st.sampled_from([0.0, 1e-5, 5e-5]))
@settings(deadline=None, max_examples=150)
def test_no_interval_is_free_or_firm_that_is_not(models, sign, history, start_angle, firm):
    time = np.cumsum([sample[0] for sample in history])
    motion = motion_of(time, [sample[1] for sample in history], [sample[2:] for sample in history])
    check_classes(models[sign], motion, start_angle, firm)


steps = st.floats(-1e-5, 1e-5)


speeds = st.floats(-3.0, 3.0)


@pytest.mark.parametrize("steady", [True, False], ids=["steady", "accelerated"])
@given(st.floats(1e-3, 0.2), speeds, speeds, st.floats(-4.0, 4.0), lengths, lengths, steps, steps)
@settings(deadline=None, max_examples=300)
def test_load_that_comes_and_goes_within_an_interval_is_an_edge(
    models, steady, span, near, far, angle, dx, dy, rise_x, rise_y
):
    # The ring is put along Z0 so that both ends just miss the load that the middle has, or hold firmly while it does
    # not: turning, reversing and accelerating shafts, with and without a ring that follows.
    model, far = models[1], near if steady else far
    ring = np.array([[dx, dy, 0.0], [dx + rise_x, dy + rise_y, 0.0]])
    dense = direct_interference(model, motion_of([0.0, span], [near, far], ring), angle, np.linspace(0.0, span, 401))
    above, below = dense.max() - max(dense[0], dense[-1]), min(dense[0], dense[-1]) - dense.min()
    firm, seen = 1e-5, 1e-13
    ways = (
        (above, -max(dense[0], dense[-1]) - 0.9 * above, FREE),
        (below, firm - min(dense[0], dense[-1]) + 0.9 * below, FIRM),
    )
    for level, forbidden in ((level, forbidden) for excess, level, forbidden in ways if excess > seen):
        ring[:, 2] = level / model.sin_contact_angle
        assert classes_of(model, motion_of([0.0, span], [near, far], ring), angle, firm).tolist() != [forbidden]


@pytest.mark.parametrize(
    ("speeds", "span", "angle", "ring"),
    [
        # The roller swings towards the load and back.
        ([0.5, -0.5], 0.05, -1.0, [[3e-4, 0.0, 0.0], [3e-4, 0.0, 0.0]]),
        # It passes the middle of a narrow load zone.
        ([2.0, 2.0], 0.1, -1.0 * RATIO * 0.1, [[3e-4, 0.0, 0.0], [3e-4, 0.0, 0.0]]),
        # The ring moves across while the roller passes.
        ([0.4, 0.4], 0.05, -0.2 * RATIO * 0.05, [[0.0, 3e-4, 0.0], [0.0, -3e-4, 0.0]]),
    ],
    ids=["reversal", "passage", "moving ring"],
)
def test_load_in_the_middle_only_is_an_edge(models, speeds, span, angle, ring):
    model, ring = models[1], np.array(ring)
    time = np.array([0.0, 0.5 * span, span])
    start, middle, end = direct_interference(model, motion_of(time[::2], speeds, ring), angle, time)
    assert start == pytest.approx(end, abs=1e-12) and middle > start + 1e-7
    # A tenth of the rise reaches into the load.
    ring[:, 2] = (-0.9 * (middle - start) - start) / model.sin_contact_angle
    motion = motion_of(time[::2], speeds, ring)
    assert direct_interference(model, motion, angle, time)[1] > 1e-8
    assert classes_of(model, motion, angle, 1e-5).tolist() == [EDGE]


def test_classes_are_not_needlessly_edge(models):
    # A turn of the bearing under radial load, sampled finely: an edge only where the load begins or ends.
    time = np.arange(0.0, 10.0, 0.005)
    motion = motion_of(time, np.full(time.size, 2.143), [[0.0, -2.5e-4, 0.0]] * time.size)
    firm = 1e-5
    classes = check_classes(models[1], motion, 0.3, firm)
    dense = direct_interference(models[1], motion, 0.3, time)
    ends = np.stack([dense[:-1], dense[1:]])
    assert np.mean(classes == FREE) == pytest.approx(np.mean(ends.max(axis=0) < 0.0), abs=0.002)
    assert np.mean(classes == FIRM) == pytest.approx(np.mean(ends.min(axis=0) > firm), abs=0.002)
    assert np.mean(classes == FREE) > 0.2 < np.mean(classes == FIRM)


def test_standing_ring_without_contact_is_free(models):
    motion = motion_of([0.0, 100.0], [0.0, 0.0], [[0.0, 0.0, 0.0]] * 2)
    assert classes_of(models[1], motion, 0.0, 1e-5).tolist() == [FREE]


@given(samples, samples, st.floats(-4.0, 4.0))
@settings(deadline=None, max_examples=60)
def test_interference_at_is_the_models(models, near, far, angle):
    motion = motion_of([1.0, 1.0 + far[0]], [near[1], far[1]], [near[2:], far[2:]])
    time = 1.0 + far[0] * np.array([0.0, 0.3, 1.0])
    found = [interference_at(models[-1], motion, angle, 0, t) for t in time]
    assert found == pytest.approx(direct_interference(models[-1], motion, angle, time), abs=1e-16)


def test_edge_time_is_where_the_load_begins(models):
    model = models[1]
    motion = motion_of([0.0, 1.5], [2.0, 2.2], [[0.0, -2.5e-4, 1e-5], [1e-5, -2.4e-4, 0.0]])

    crossings = 0
    for start, end in [(0.0, 1.5), (0.1, 1.2)]:
        for angle in np.linspace(-3.1, 3.1, 41):

            def approach(t, angle=angle):
                return direct_interference(model, motion, angle, np.array([t]))[0]

            found = edge_time(model, motion, angle, 0, start, end)
            if approach(start) * approach(end) < 0.0:
                crossings += 1
                assert found == pytest.approx(brentq(approach, start, end, xtol=1e-15), abs=1e-12)
                # The far side is returned: there the sign has changed already.
                assert interference_at(model, motion, angle, 0, found) * approach(start) <= 0.0
            else:
                assert found == end
    assert 10 < crossings < 72


def test_edge_at_the_start_is_not_found_again(models):
    model = models[1]
    motion = motion_of([0.0, 1.0], [2.0, 2.0], [[0.0, -2.5e-4, 0.0]] * 2)
    angle = -3.0
    edge = edge_time(model, motion, angle, 0, 0.0, 1.0)
    assert 0.0 < edge < 1.0
    assert edge_time(model, motion, angle, 0, edge, 1.0) == 1.0


@pytest.mark.parametrize(("load", "seconds"), [(1e3, 3.77e-3), (5e4, 2.25e-11), (1e5, 3.42e-14)])
def test_relaxation_time(models, bearing, lubricant, load, seconds):
    # I/(r² ΣF') with the isothermal patch integral [e^P (P − 1) + 1]/P², written here.
    total = 0.0
    for face, contact in zip(interfaces(bearing, lubricant)[:2], (models[1].inner, models[1].outer), strict=True):
        p = 21e-9 * face.hertz.pressure * load ** (1 / 3)
        area = math.pi * face.hertz.semi_axis_across * face.hertz.semi_axis_along * load ** (2 / 3)
        film, _, _ = film_thickness(contact.film, load, RATED_SURFACE_SPEED)
        total += 2 * area * 0.54 / film * (math.exp(p) * (p - 1) + 1) / p**2
    mass = 7850.0 * math.pi * 0.035**2 * 0.106
    assert relaxation_rate(models[1], load, RATED_SURFACE_SPEED) == pytest.approx(2 / mass * total, rel=1e-11, abs=0.0)
    assert mass / 2 / total == pytest.approx(seconds, rel=0.01, abs=0.0)


@pytest.mark.parametrize("speed", [1e-3, RATED_SURFACE_SPEED, 5.0])
def test_firm_roller_relaxes_at_the_firm_rate(models, speed):
    firm = firm_interference(sealed(models[1]), speed)
    load = models[1].stiffness * firm**1.5
    assert relaxation_rate(models[1], load, speed) == pytest.approx(FIRM_RATE, rel=1e-9, abs=0.0)
    for more in (1.01, 2.0, 30.0):
        assert relaxation_rate(models[1], more * load, speed) > FIRM_RATE
        assert relaxation_rate(models[1], load / more, speed) < FIRM_RATE


def test_with_microslip_a_lower_rate_is_firm(bearing, lubricant):
    model = roller_model(bearing, lubricant, axial_sign=1, tilt=0.0, laws=Laws.physical())
    load = model.stiffness * firm_interference(sealed(model), RATED_SURFACE_SPEED) ** 1.5
    rate = relaxation_rate(model, load, RATED_SURFACE_SPEED)
    assert rate == pytest.approx(FIRM_RATE_MICROSLIP, rel=1e-9, abs=0.0)
    assert relaxation_rate(model, 2.0 * load, RATED_SURFACE_SPEED) > rate


def test_slower_rings_hold_no_less_firmly(models):
    firm = firm_interference(sealed(models[1]), RATED_SURFACE_SPEED)
    load = models[1].stiffness * firm**1.5
    slower = [relaxation_rate(models[1], load, speed) for speed in np.geomspace(1e-6, RATED_SURFACE_SPEED, 40)]
    assert min(slower) >= FIRM_RATE * (1 - 1e-9)


def test_relaxation_rate_is_never_nan(models):
    rates = [relaxation_rate(models[1], load, 0.4) for load in np.geomspace(1e-3, 1e9, 40)]
    assert np.all(np.isfinite(rates)) and np.all(np.diff(rates) > 0.0)
