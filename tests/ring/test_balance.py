"""Ring balance against direct sums, closed forms, symmetries and an independent minimiser of the energy."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import linprog, minimize
from scipy.special import beta

from macroslip.contact.interface import truncation_load
from macroslip.errors import InputError
from macroslip.loads import BearingLoads
from macroslip.ring.balance import (
    RingGeometry,
    _energy_gradient_hessian,
    balance,
    balance_series,
    roller_loads,
)
from macroslip.ring.motion import largest_load, ring_motion
from macroslip.roller.model import ring_geometry, roller_model

COUNT, ALPHA, PLAY, STIFFNESS, RATIO = 28, math.radians(11.2), 1e-4, 9.258e10, 0.4539
PITCH = 2 * math.pi / COUNT
DOWNWIND, UPWIND = slice(0, COUNT), slice(COUNT, 2 * COUNT)
angles = np.concatenate([-np.pi / 2 + PITCH * np.arange(COUNT), -np.pi / 2 + PITCH * (np.arange(COUNT) + 0.5)])
signs = np.repeat([1.0, -1.0], COUNT)

directions = st.tuples(*[st.floats(-1.0, 1.0)] * 3).filter(lambda d: np.linalg.norm(d) > 1e-3)
magnitudes = st.floats(-3.0, math.log10(5e6)).map(lambda exponent: 10.0**exponent)
plays = st.sampled_from([1e-4, 5e-4, 0.0, -2e-5, -1e-4])


def ring(play=PLAY, stiffness=STIFFNESS, alpha=ALPHA):
    return RingGeometry(
        np.cos(angles), np.sin(angles), signs * math.sin(alpha), math.cos(alpha), play, stiffness, RATIO
    )


def normals(shaft_angle=0.0):
    turned = angles + RATIO * shaft_angle
    return np.column_stack(
        [np.cos(turned) * math.cos(ALPHA), np.sin(turned) * math.cos(ALPHA), signs * math.sin(ALPHA)]
    )


def direct_loads(d, shaft_angle=0.0, play=PLAY, stiffness=STIFFNESS):
    approach = normals(shaft_angle) @ d - play * math.cos(ALPHA)
    return stiffness * np.maximum(approach, 0.0) ** 1.5


def solve(force, shaft_angle=0.0, start=(0.0, 0.0, 0.0), **geometry):
    """Displacement and roller loads, with what every solution has to satisfy checked on the way."""
    force, d = np.asarray(force, dtype=float), np.array(start, dtype=float)
    unbalanced = balance(ring(**geometry), shaft_angle, force, d)
    assert unbalanced <= 1e-10 * np.linalg.norm(force) + 1e-7
    loads = direct_loads(d, shaft_angle, **geometry)
    # Roller loads summed here, independently; rounding of angles and roots leaves a few 1e-12 of the summed loads.
    residual = np.linalg.norm(normals(shaft_angle).T @ loads - force)
    assert residual <= 1.1e-10 * np.linalg.norm(force) + 1e-7 + 1e-10 * loads.sum()
    reported = np.empty(2 * COUNT)
    roller_loads(ring(**geometry), shaft_angle, d, reported)
    assert reported == pytest.approx(loads, rel=1e-7, abs=1e-7 * loads.max() + 1e-9)
    return d, loads


@given(directions, magnitudes, st.floats(-1e3, 1e3), plays)
@settings(deadline=None, max_examples=300)
def test_rollers_carry_any_load(direction, magnitude, shaft_angle, play):
    solve(magnitude * np.array(direction) / np.linalg.norm(direction), shaft_angle, play=play)


@given(directions, magnitudes, plays)
@settings(deadline=None, max_examples=100)
def test_mirrored_load_mirrors_the_loads(direction, magnitude, play):
    force = magnitude * np.array(direction) / np.linalg.norm(direction)
    _, here = solve(force, play=play)
    _, there = solve(force * [-1.0, 1.0, 1.0], play=play)
    # φ → π − φ: the roller at the bottom stays downwind, rollers ±½ swap upwind.
    j = np.arange(COUNT)
    mirrored = np.concatenate([there[DOWNWIND][-j % COUNT], there[UPWIND][(-j - 1) % COUNT]])
    assert mirrored == pytest.approx(here, rel=1e-5, abs=1e-6 * magnitude + 1e-6)


@given(directions, magnitudes)
@settings(deadline=None, max_examples=100)
def test_one_pitch_on_every_roller_has_the_load_of_the_next(direction, magnitude):
    force = magnitude * np.array(direction) / np.linalg.norm(direction)
    _, here = solve(force, shaft_angle=3.0)
    _, there = solve(force, shaft_angle=3.0 + PITCH / RATIO)
    shifted = np.concatenate([np.roll(there[DOWNWIND], 1), np.roll(there[UPWIND], 1)])
    assert shifted == pytest.approx(here, rel=1e-5, abs=1e-6 * magnitude + 1e-6)


@pytest.mark.parametrize("force", [1.0, 1e3, 4e5])
@pytest.mark.parametrize(("row", "sign"), [(DOWNWIND, 1.0), (UPWIND, -1.0)])
def test_thrust_loads_one_row_evenly(force, row, sign):
    d, loads = solve([0.0, 0.0, sign * force])
    each = force / (COUNT * math.sin(ALPHA))
    assert loads[row] == pytest.approx(each, rel=1e-7, abs=0.0)
    assert np.count_nonzero(loads) == COUNT
    expected = ((each / STIFFNESS) ** (2 / 3) + PLAY * math.cos(ALPHA)) / math.sin(ALPHA)
    assert d == pytest.approx([0.0, 0.0, sign * expected], abs=1e-7 * expected)


def test_zero_load_moves_nothing():
    d, loads = solve([0.0, 0.0, 0.0])
    assert not d.any() and not loads.any()


def test_preload_without_load_is_even():
    play = -5e-5
    d, loads = solve([0.0, 0.0, 0.0], start=(1e-5, -2e-5, 3e-5), play=play)
    assert loads == pytest.approx(STIFFNESS * (-play * math.cos(ALPHA)) ** 1.5, rel=1e-6, abs=0.0)
    assert d == pytest.approx(np.zeros(3), abs=1e-11)


@pytest.mark.parametrize("roller", [0, 5, 14, 27, 28, 40, 55])
def test_light_load_along_one_normal_loads_one_roller(roller):
    _, loads = solve(0.5 * normals()[roller])
    expected = np.zeros(2 * COUNT)
    expected[roller] = 0.5
    assert loads == pytest.approx(expected, abs=1e-6)


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


def test_light_load_approaches_the_rigid_limit():
    down = 2 * PLAY / (1 + math.cos(PITCH / 2))
    for force, closeness in ((1.0, 2e-3), (1e-3, 2e-5)):
        d, _ = solve([0.0, -force, 0.0])
        assert down < -d[1] < down * (1.0 + closeness)


def test_radial_load_without_play_has_sjovalls_integral():
    # Half the circle loaded, Q ~ cos^1.5: J_r(½) = (1/2π) ∫ cos^2.5 φ dφ = 0.2288 in point contact.
    force = 1e6
    _, loads = solve([0.0, -force, 0.0], play=0.0)
    integral = beta(1.75, 0.5) / (2 * math.pi)
    assert integral == pytest.approx(0.2288, abs=5e-5)
    assert loads.max() == pytest.approx(force / (2 * COUNT * integral * math.cos(ALPHA)), rel=1e-3, abs=0.0)
    assert loads.argmax() == 0


def energy(d, force, play):
    approach = np.maximum(normals() @ d - play * math.cos(ALPHA), 0.0)
    return 0.4 * STIFFNESS * (approach**2.5).sum() - force @ d


def test_gradient_and_hessian_belong_to_the_energy():
    play, force = 1e-5, np.array([2e4, -4e4, 1e4])
    d = np.array([1e-4, -3e-4, 2e-4])
    gradient, hessian, unused, ignored = np.empty(3), np.empty((3, 3)), np.empty(3), np.empty((3, 3))
    found = _energy_gradient_hessian(ring(play), 1.0, 0.0, d, force, gradient, hessian)
    assert found == pytest.approx(energy(d, force, play), rel=1e-12, abs=0.0)
    for i in range(3):
        step = 1e-8 * np.eye(3)[i]
        slope = (energy(d + step, force, play) - energy(d - step, force, play)) / 2e-8
        assert gradient[i] == pytest.approx(slope, rel=1e-5, abs=1.0)
        ahead, behind = unused.copy(), unused.copy()
        _energy_gradient_hessian(ring(play), 1.0, 0.0, d + step, force, ahead, ignored)
        _energy_gradient_hessian(ring(play), 1.0, 0.0, d - step, force, behind, ignored)
        assert hessian[i, i:] == pytest.approx(((ahead - behind) / 2e-8)[i:], rel=1e-4, abs=1e-6 * hessian.max())


@pytest.mark.parametrize("play", [PLAY, 0.0, -5e-5])
@pytest.mark.parametrize("force", [(2e5, -4e5, 1e5), (0.0, -3e5, 0.0), (-1e4, 2e3, -3e5), (1e3, 0.0, 10.0)])
def test_solution_is_the_minimum_of_energy(force, play):
    force = np.array(force)
    d, loads = solve(force, play=play)
    scale = np.linalg.norm(force) * 1e-4
    found = minimize(lambda x: energy(x * 1e-4, force, play) / scale, np.array([0.3, -0.3, 0.5]), method="Nelder-Mead",
                     options={"xatol": 1e-10, "fatol": 1e-15, "maxiter": 4000, "maxfev": 8000})  # fmt: skip
    assert found.fun >= energy(d, force, play) / scale - 1e-13 * abs(found.fun)
    assert direct_loads(found.x * 1e-4, play=play) == pytest.approx(loads, abs=2e-5 * loads.max())


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
    displacement, unbalanced = np.empty((count, 3)), np.empty(count)
    balance_series(ring(), shaft_angle, force, np.zeros(3), displacement, unbalanced)
    size = np.linalg.norm(force, axis=1)
    assert np.all(unbalanced <= 1e-10 * size + 1e-7)
    for k in range(count):
        _, cold = solve(force[k], shaft_angle[k])
        warm = direct_loads(displacement[k], shaft_angle[k])
        assert warm == pytest.approx(cold, rel=1e-5, abs=1e-6 * size[k] + 1e-5)
    largest, sample = largest_load(ring(), shaft_angle, displacement)
    loads = np.array([direct_loads(d, angle) for d, angle in zip(displacement, shaft_angle, strict=True)])
    assert (largest, sample) == (pytest.approx(loads.max(), rel=1e-12, abs=0.0), loads.max(axis=1).argmax())


def test_bearing_without_contact_angle_has_no_axial_balance():
    force, d = np.array([0.0, 0.0, 1e3]), np.zeros(3)
    assert not balance(ring(alpha=0.0), 0.0, force, d) <= 1.0
    force[:] = 0.0, -3e5, 0.0
    assert balance(ring(alpha=0.0), 0.0, force, np.zeros(3)) <= 1e-4


@pytest.fixture(scope="module")
def model(bearing, lubricant):
    return roller_model(bearing, lubricant, 1, tilt=0.0)


def test_ring_geometry_is_the_bearings(bearing, model):
    found = ring_geometry(bearing, model)
    assert found.cosine == pytest.approx(np.cos(angles), abs=1e-15)
    assert found.sine == pytest.approx(np.sin(angles), abs=1e-15)
    assert found.axial == pytest.approx(signs * math.sin(ALPHA), abs=1e-15)
    assert (found.cos_contact_angle, found.radial_play) == pytest.approx((math.cos(ALPHA), 1e-4), rel=1e-14, abs=0.0)
    inner, outer = (0.3727 + sign * 0.035 * math.cos(ALPHA) for sign in (-1.0, 1.0))
    assert found.orbit_ratio == pytest.approx(inner / (inner + outer), rel=1e-14, abs=0.0)
    assert found.stiffness == pytest.approx(9.26e10, rel=5e-4, abs=0.0)


def history(force, speed=2.0, time=(0.0, 0.01, 0.02)):
    force = np.broadcast_to(np.asarray(force, dtype=float), (len(time), 3))
    return BearingLoads(np.array(time), np.full(len(time), speed), force, "a test")


def test_motion_balances_every_sample_with_rollers_where_they_are(bearing, model, lubricant):
    force = np.array([[0.0, -3e5, 2e5], [1e5, -4e5, 1e5], [1e5, -1e5, -5e4]])
    motion, largest = ring_motion(
        history(force), bearing, ring_geometry(bearing, model), truncation_load(bearing, lubricant)
    )
    assert motion.shaft_angle == pytest.approx([0.0, 0.02, 0.04], rel=1e-14, abs=0.0)
    found = ring_geometry(bearing, model)
    loads = np.empty(2 * COUNT)
    peak = 0.0
    for k in range(3):
        turned = angles + found.orbit_ratio * motion.shaft_angle[k]
        n = np.column_stack([np.cos(turned) * math.cos(ALPHA), np.sin(turned) * math.cos(ALPHA), found.axial])
        roller_loads(found, motion.shaft_angle[k], motion.displacement[k], loads)
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
    motion, _ = ring_motion(loads, bearing, ring_geometry(bearing, model), truncation_load(bearing, lubricant))
    assert set(time) <= set(motion.time)
    assert np.all(np.diff(motion.time) > 0.0)
    assert motion.shaft_speed == pytest.approx(np.interp(motion.time, time, speed), abs=1e-12)
    assert motion.shaft_angle[-1] == pytest.approx(4.0, rel=1e-12, abs=0.0)
    fastest = np.maximum(abs(motion.shaft_speed[1:]), abs(motion.shaft_speed[:-1])) * np.diff(motion.time)
    assert model.orbit_ratio * fastest.max() <= 0.6 * PITCH
    standstill, _ = ring_motion(
        history([0.0, -4e5, 0.0], 0.0, (0.0, 100.0)), bearing, ring_geometry(bearing, model), 1e9
    )
    assert standstill.time.tolist() == [0.0, 100.0]
