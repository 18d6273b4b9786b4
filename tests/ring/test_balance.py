"""Ring balance against direct sums, the rigid limit and definitions of its own."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.optimize import fsolve, linprog

from macroslip.contact.interface import truncation_load
from macroslip.errors import InputError
from macroslip.loads import BearingLoads, RollerLoads
from macroslip.ring.balance import (
    RingGeometry,
    balance,
    balance_series,
    roller_loads,
)
from macroslip.ring.motion import elastic_loads, largest_load, own_motions, ring_motion
from macroslip.roller.model import ring_geometry, roller_model

COUNT, ALPHA, PLAY, STIFFNESS, RATIO = 28, math.radians(11.2), 1e-4, 9.258e10, 0.4539
PITCH = 2 * math.pi / COUNT
angles = np.concatenate(
    [-np.pi / 2 + PITCH * np.arange(COUNT), -np.pi / 2 + PITCH * (np.arange(COUNT) + 0.5)]
)
signs = np.repeat([1.0, -1.0], COUNT)

directions = st.tuples(*[st.floats(-1.0, 1.0)] * 3).filter(lambda d: np.linalg.norm(d) > 1e-3)
magnitudes = st.floats(-3.0, math.log10(5e6)).map(lambda exponent: 10.0**exponent)
plays = st.sampled_from([1e-4, 5e-4, 0.0, -2e-5, -1e-4])


def ring(play=PLAY, stiffness=STIFFNESS, alpha=ALPHA):
    return RingGeometry(
        np.cos(angles),
        np.sin(angles),
        signs * math.sin(alpha),
        math.cos(alpha),
        play,
        stiffness,
        RATIO,
    )


def normals(shaft_angle=0.0):
    turned = angles + RATIO * shaft_angle
    return np.column_stack(
        [
            np.cos(turned) * math.cos(ALPHA),
            np.sin(turned) * math.cos(ALPHA),
            signs * math.sin(ALPHA),
        ]
    )


def direct_loads(d, shaft_angle=0.0, play=PLAY, stiffness=STIFFNESS):
    approach = normals(shaft_angle) @ d - play * math.cos(ALPHA)
    return stiffness * np.maximum(approach, 0.0) ** 1.5


def balance_of(ring, shaft_angle, force, start=(0.0, 0.0, 0.0)):
    """Displacement and unbalanced force of one sample."""
    angle = np.array([float(shaft_angle)])
    d, unbalanced = balance(ring, angle, np.array([force]), np.array([start], dtype=float))
    return d[0], unbalanced[0]


def loads_of(ring, shaft_angle, d):
    """Roller loads of one sample."""
    return roller_loads(ring, np.array([float(shaft_angle)]), np.asarray(d)[None])[0]


def solve(force, shaft_angle=0.0, start=(0.0, 0.0, 0.0), **geometry):
    """Displacement and roller loads, with what every solution has to satisfy checked on the way."""
    force = np.asarray(force, dtype=float)
    d, unbalanced = balance_of(ring(**geometry), shaft_angle, force, start)
    assert unbalanced <= 1e-10 * np.linalg.norm(force) + 1e-7
    loads = direct_loads(d, shaft_angle, **geometry)
    # Roller loads summed here, independently; rounding of angles and roots leaves a few 1e-12 of the summed loads.
    residual = np.linalg.norm(normals(shaft_angle).T @ loads - force)
    assert residual <= 1.1e-10 * np.linalg.norm(force) + 1e-7 + 1e-10 * loads.sum()
    reported = loads_of(ring(**geometry), shaft_angle, d)
    assert reported == pytest.approx(loads, rel=1e-7, abs=1e-7 * loads.max() + 1e-9)
    return d, loads


@given(directions, magnitudes, st.floats(-1e3, 1e3), plays)
@settings(deadline=None, max_examples=300)
def test_rollers_carry_any_load(direction, magnitude, shaft_angle, play):
    solve(magnitude * np.array(direction) / np.linalg.norm(direction), shaft_angle, play=play)


def test_zero_load_moves_nothing():
    d, loads = solve([0.0, 0.0, 0.0])
    assert not d.any() and not loads.any()


def test_preload_without_load_is_even():
    play = -5e-5
    d, loads = solve([0.0, 0.0, 0.0], start=(1e-5, -2e-5, 3e-5), play=play)
    assert loads == pytest.approx(STIFFNESS * (-play * math.cos(ALPHA)) ** 1.5, rel=1e-6, abs=0.0)
    assert d == pytest.approx(np.zeros(3), abs=1e-11)


def test_rigid_limit_is_a_linear_programme():
    # The ring goes as far down as rollers with play allow: one downwind at the bottom, two upwind half a pitch beside.
    force = np.array([0.0, -1.0, 0.0])
    d, loads = solve(force, stiffness=1e18)
    room = np.full(2 * COUNT, PLAY * math.cos(ALPHA))
    rigid = linprog(-force, A_ub=normals(), b_ub=room, bounds=(None, None)).x
    half = math.cos(PITCH / 2)
    down = 2 * PLAY / (1 + half)
    assert rigid == pytest.approx([0.0, -down, (PLAY - down) / math.tan(ALPHA)], abs=1e-10)
    assert d == pytest.approx(rigid, abs=2e-11)
    bottom = 1.0 / (math.cos(ALPHA) * (1 + half))
    expected = np.zeros(2 * COUNT)
    expected[[0, COUNT, 2 * COUNT - 1]] = bottom, bottom / 2, bottom / 2
    assert loads == pytest.approx(expected, abs=1e-5)


@pytest.mark.parametrize("play", [0.0, PLAY, 4 * PLAY])
def test_a_row_is_loaded_all_round_from_the_ratio_of_sjoevalls_integrals(play):
    """J_a/J_r of point contacts at a load zone of the whole circumference is 5/3; rollers are 28 places of it."""

    def integral(weight):
        return quad(lambda psi: (0.5 + 0.5 * math.cos(psi)) ** 1.5 * weight(psi), 0.0, math.pi)[0]

    limit = math.tan(ALPHA) * integral(lambda _: 1.0) / integral(math.cos)
    assert limit == pytest.approx(5.0 / 3.0 * math.tan(ALPHA), rel=1e-9, abs=0.0)
    for ratio, is_loaded_all_round in ((0.95 * limit, False), (1.05 * limit, True)):
        _, loads = solve([0.0, -3e5, 3e5 * ratio], play=play)
        assert bool((loads[:COUNT] > 0.0).all()) is is_loaded_all_round


@given(directions, magnitudes, directions, st.floats(-6.0, -2.0))
@settings(deadline=None, max_examples=200)
def test_any_start_gives_the_same_loads(direction, magnitude, towards, distance):
    force = magnitude * np.array(direction) / np.linalg.norm(direction)
    _, cold = solve(force)
    _, warm = solve(force, start=10.0**distance * np.array(towards))
    assert warm == pytest.approx(cold, rel=1e-5, abs=1e-6 * magnitude + 1e-5)


def test_series_equals_single_solutions():
    rng = np.random.default_rng(7)
    count = 60
    shaft_angle = np.cumsum(rng.uniform(0.0, 0.3, count))
    force = rng.normal(size=(count, 3)) * 10.0 ** rng.uniform(-2.0, 6.5, (count, 1))
    force[10] = force[30] = 0.0
    displacement, unbalanced = balance_series(ring(), shaft_angle, force)
    size = np.linalg.norm(force, axis=1)
    assert np.all(unbalanced <= 1e-10 * size + 1e-7)
    for k in range(count):
        _, cold = solve(force[k], shaft_angle[k])
        warm = direct_loads(displacement[k], shaft_angle[k])
        assert warm == pytest.approx(cold, rel=1e-5, abs=1e-6 * size[k] + 1e-5)
    largest, sample = largest_load(ring(), shaft_angle, displacement)
    loads = np.array(
        [direct_loads(d, angle) for d, angle in zip(displacement, shaft_angle, strict=True)]
    )
    assert (largest, sample) == (
        pytest.approx(loads.max(), rel=1e-12, abs=0.0),
        loads.max(axis=1).argmax(),
    )


def test_bearing_without_contact_angle_has_no_axial_balance():
    assert not balance_of(ring(alpha=0.0), 0.0, [0.0, 0.0, 1e3])[1] <= 1.0
    assert balance_of(ring(alpha=0.0), 0.0, [0.0, -3e5, 0.0])[1] <= 1e-4


@pytest.fixture(scope="module")
def model(bearing, lubricant):
    return roller_model(bearing, lubricant, 1, tilt=0.0)


def test_ring_geometry_is_the_bearings(bearing, model):
    ring = ring_geometry(bearing, model)
    assert ring.cosine == pytest.approx(np.cos(angles), abs=1e-15)
    assert ring.sine == pytest.approx(np.sin(angles), abs=1e-15)
    assert ring.axial == pytest.approx(signs * math.sin(ALPHA), abs=1e-15)
    assert (ring.cos_contact_angle, ring.radial_play) == pytest.approx(
        (math.cos(ALPHA), 1e-4), rel=1e-14, abs=0.0
    )
    inner, outer = (0.3727 + sign * 0.035 * math.cos(ALPHA) for sign in (-1.0, 1.0))
    assert ring.orbit_ratio == pytest.approx(inner / (inner + outer), rel=1e-14, abs=0.0)
    assert ring.stiffness == pytest.approx(9.26e10, rel=5e-4, abs=0.0)


def history(force, speed=2.0, time=(0.0, 0.01, 0.02)):
    force = np.broadcast_to(np.asarray(force, dtype=float), (len(time), 3))
    return BearingLoads(np.array(time), np.full(len(time), speed), force, "a test")


def test_motion_balances_every_sample_with_rollers_where_they_are(bearing, model, lubricant):
    force = np.array([[0.0, -3e5, 2e5], [1e5, -4e5, 1e5], [1e5, -1e5, -5e4]])
    motion, largest = ring_motion(
        history(force), bearing, ring_geometry(bearing, model), truncation_load(bearing, lubricant)
    )
    assert motion.shaft_angle == pytest.approx([0.0, 0.02, 0.04], rel=1e-14, abs=0.0)
    ring = ring_geometry(bearing, model)
    peak = 0.0
    for k in range(3):
        turned = angles + ring.orbit_ratio * motion.shaft_angle[k]
        n = np.column_stack(
            [np.cos(turned) * math.cos(ALPHA), np.sin(turned) * math.cos(ALPHA), ring.axial]
        )
        loads = loads_of(ring, motion.shaft_angle[k], motion.displacement[k])
        assert n.T @ loads == pytest.approx(force[k], abs=1e-8 * np.linalg.norm(force[k]))
        peak = max(peak, loads.max())
    assert largest == pytest.approx(peak, rel=1e-14, abs=0.0)


def test_truncated_contact_is_an_error_with_time_and_limit(bearing, model, lubricant):
    limit = truncation_load(bearing, lubricant)
    force = [[0.0, -3e5, 0.0], [0.0, -9e6, 0.0], [0.0, -3e5, 0.0]]
    words = rf"a test, t = 0.01 s: a roller carries .* Allowed: .* up to {limit / 1e3:.4g} kN"
    with pytest.raises(InputError, match=words):
        ring_motion(history(force), bearing, ring_geometry(bearing, model), limit)
    assert f"{limit / 1e3:.4g}" == "203.2"


def test_coarse_loads_are_balanced_in_between(bearing, model, lubricant):
    limit = truncation_load(bearing, lubricant)
    speed, end = 2.0, 6.0
    coarse, largest = ring_motion(
        history([0.0, -4e5, 1e5], speed, (0.0, end)), bearing, ring_geometry(bearing, model), limit
    )
    travelled = model.orbit_ratio * speed * np.diff(coarse.time)
    assert travelled.max() <= 0.25 * PITCH * (1 + 1e-9)
    assert travelled.sum() > 8 * PITCH
    assert (coarse.time[0], coarse.time[-1]) == (0.0, end)
    assert coarse.shaft_angle == pytest.approx(speed * coarse.time, rel=1e-13, abs=0.0)
    # The ring moves up and down as rollers pass: with two samples that would be lost.
    assert np.ptp(coarse.displacement[:, 1]) > 1e-7
    finely = history([0.0, -4e5, 1e5], speed, np.linspace(0.0, end, 2001))
    fine, largest_fine = ring_motion(finely, bearing, ring_geometry(bearing, model), limit)
    assert largest == pytest.approx(largest_fine, rel=0.01, abs=0.0)
    middle = np.interp(fine.time, coarse.time, coarse.displacement[:, 1])
    assert np.abs(middle - fine.displacement[:, 1]).max() < 0.2 * np.ptp(fine.displacement[:, 1])


def test_added_samples_keep_the_linear_loads(bearing, model, lubricant):
    # A reversal within the second interval: the path, not the net angle, decides how many samples are needed.
    time, speed = np.array([0.0, 1.0, 1.9]), np.array([4.0, 4.0, -4.0])
    force = np.array([[0.0, -4e5, 1e5], [2e5, -4e5, 0.0], [0.0, -2e5, 2e5]])
    loads = BearingLoads(time, speed, force, "a test")
    motion, _ = ring_motion(
        loads, bearing, ring_geometry(bearing, model), truncation_load(bearing, lubricant)
    )
    assert set(time) <= set(motion.time)
    assert np.all(np.diff(motion.time) > 0.0)
    assert motion.shaft_speed == pytest.approx(np.interp(motion.time, time, speed), abs=1e-12)
    assert motion.shaft_angle[-1] == pytest.approx(4.0, rel=1e-12, abs=0.0)
    fastest = np.maximum(abs(motion.shaft_speed[1:]), abs(motion.shaft_speed[:-1])) * np.diff(
        motion.time
    )
    assert model.orbit_ratio * fastest.max() <= 0.6 * PITCH
    standstill, _ = ring_motion(
        history([0.0, -4e5, 0.0], 0.0, (0.0, 100.0)), bearing, ring_geometry(bearing, model), 1e9
    )
    assert standstill.time.tolist() == [0.0, 100.0]


def oval_loads(geometry, bearing, d, shaft_angle=0.0):
    """Roller loads by the definition, places and waves written out."""
    angle = angles + geometry.orbit_ratio * shaft_angle
    crest = bearing.out_of_round_angle or 0.0
    play = 0.5 * bearing.diametral_clearance
    play = play + (bearing.out_of_round_second or 0.0) * np.cos(2 * (angle - crest))
    play = play + (bearing.out_of_round_third or 0.0) * np.cos(3 * (angle - crest))
    n = np.column_stack(
        [np.cos(angle) * math.cos(ALPHA), np.sin(angle) * math.cos(ALPHA), signs * math.sin(ALPHA)]
    )
    return n, geometry.stiffness * np.maximum(n @ d - play * math.cos(ALPHA), 0.0) ** 1.5


@pytest.mark.parametrize(
    "waves",
    [
        {"second": 2e-5},
        {"second": -4e-5, "angle": 0.7},
        {"second": 1e-5, "third": 3e-5, "angle": -2.0},
    ],
)
def test_ring_out_of_round_is_balanced_by_loads_of_its_own_definition(waves, bearing, lubricant):
    oval = bearing.replace(**{f"out_of_round_{key}": value for key, value in waves.items()})
    ring = ring_geometry(oval, roller_model(oval, lubricant, 1, tilt=0.0))
    force = np.array([2e4, -4e5, 1e5])
    d, unbalanced = balance_of(ring, 3.0, force)
    assert unbalanced <= 1e-4
    n, expected = oval_loads(ring, oval, d, 3.0)
    assert n.T @ expected == pytest.approx(force, abs=1e-3)
    loads = loads_of(ring, 3.0, d)
    assert loads == pytest.approx(expected, rel=1e-9, abs=1e-3)
    # An independent root of the equations of force, from another start.
    root = fsolve(
        lambda x: n.T @ oval_loads(ring, oval, 1e-4 * x, 3.0)[1] / 1e5 - force / 1e5,
        1.1e4 * d,
        xtol=1e-13,
    )
    assert oval_loads(ring, oval, 1e-4 * root, 3.0)[1] == pytest.approx(expected, rel=1e-6, abs=1.0)


def test_given_loads_of_a_balance_are_those_of_the_balance(bearing, model, lubricant):
    time, force = np.linspace(0.0, 2.0, 201), np.array([0.0, -4e5, 1e5])
    ring = ring_geometry(bearing, model)
    balanced, largest = ring_motion(history(force, 2.0, time), bearing, ring, 1e9)
    known = elastic_loads(history(force, 2.0, time), ring, balanced)
    own = RollerLoads(
        balanced.time, balanced.shaft_speed,
        (angles + ring.orbit_ratio * balanced.shaft_angle[:, None]).reshape(-1, 2, COUNT), known.reshape(-1, 2, COUNT), "own",
    )  # fmt: skip
    assert own.resultant(bearing.contact_angle, COUNT).force == pytest.approx(
        np.tile(force, (own.time.size, 1)), abs=1e-2
    )
    motion, again = ring_motion(own, bearing, ring, 1e9)
    assert again == pytest.approx(largest, rel=1e-9, abs=0.0)
    fine = elastic_loads(own, ring, motion)
    at = np.searchsorted(motion.time, own.time)
    assert fine[at] == pytest.approx(known, rel=1e-9, abs=1e-6)
    # What a kernel makes of a roller's own motion: approach from displacement and place.
    for roller in (0, 3, 30):
        roller_motion = own_motions(own, ring, motion)[roller]
        angle = angles[roller] + ring.orbit_ratio * motion.shaft_angle
        radial = (
            roller_motion.displacement[:, 0] * np.cos(angle)
            + roller_motion.displacement[:, 1] * np.sin(angle)
            - ring.radial_play
        )
        load = ring.stiffness * np.maximum(radial * ring.cos_contact_angle, 0.0) ** 1.5
        assert load == pytest.approx(fine[:, roller], rel=1e-7, abs=1e-3)
