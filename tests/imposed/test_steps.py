"""Single steps: the classical conditions, order, stability, errors they tell, and where they must end."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.integrate import quad

from macroslip import Laws
from macroslip.imposed.control import (
    EMBEDDED,
    crossing,
    embedded_slip_error,
    first_cusp,
    held_energy_error,
    missed_way,
)
from macroslip.imposed.held import held_update
from macroslip.imposed.radau import (
    MATRIX,
    NODES,
    SIMPSON,
    WEIGHTS,
    collocation,
    newton_update,
    residuals,
)
from macroslip.imposed.root import is_continuous, left_by_curvature, surely_rising
from macroslip.imposed.state import WORK, path_of
from macroslip.imposed.tuning import AT_END, HOT_CHANGE, UNHEATED
from macroslip.imposed.zones import EDGE, FREE
from macroslip.ring.orbit import interval_of
from tests.one_roller import RING_SPEED, a_station, forces_of, limits_of, models, motion_of, rollers
from tests.quick import COARSE

PLACES = np.array([0.0, *NODES])


def step(force, slope, start, time, h):
    """One step of dv/dt = −F(t, v) with the module's own residuals and Newton update, and mobility 1."""
    z = [0.0, 0.0, 0.0]
    for _ in range(50):
        at = [(time + c * h, start + dz) for c, dz in zip(NODES, z, strict=True)]
        rest = residuals(1 / h, *z, *(float(force(*point)) for point in at))
        update = newton_update(1 / h, *(float(slope(*point)) for point in at), rest)
        z = [a + b for a, b in zip(z, update, strict=True)]
        if max(map(abs, update)) < 1e-15:
            break
    return z


def test_weights_satisfy_the_order_conditions():
    c, b = np.array(NODES), np.array(WEIGHTS)
    for power in range(5):
        assert b @ c**power == pytest.approx(1 / (power + 1), rel=1e-14)
    assert b @ c**5 != pytest.approx(1 / 6, rel=1e-4)
    for power in (1, 2, 3):
        assert MATRIX @ c ** (power - 1) == pytest.approx(c**power / power, rel=1e-13)


def test_embedded_rule_is_of_third_order_and_no_more():
    for power in range(3):
        assert abs(np.dot(EMBEDDED, PLACES**power)) < 1e-14
    assert abs(np.dot(EMBEDDED, PLACES**3)) > 1e-3


def test_order_five_on_a_nonlinear_equation():
    # dv/dt = −v² − sin t + cos² t has the solution cos t.
    errors = []
    for steps in (4, 8, 16):
        v, h = 1.0, 1.0 / steps
        for n in range(steps):
            v += step(
                lambda t, v: v * v + math.sin(t) - math.cos(t) ** 2,
                lambda t, v: 2.0 * v,
                v,
                n * h,
                h,
            )[2]
        errors.append(abs(v - math.cos(1.0)))
    assert np.all(np.log2(np.array(errors[:-1]) / errors[1:]) > 4.7), errors


def test_stiff_limit_forgets_the_start_and_follows_the_balance():
    z = step(lambda t, v: 1e12 * (v - 0.1 * math.cos(t)), lambda t, v: 1e12, 0.3, 0.0, 0.1)
    assert 0.3 + z[2] == pytest.approx(0.1 * math.cos(0.1), abs=1e-11)


@pytest.mark.parametrize("z", [-0.1, -1.0, -10.0, -1e3])
def test_stability_functions(z):
    """Of three stages (Hairer and Wanner, table IV.5.6), and of a held step."""
    amplification = 1.0 + step(lambda t, v: -z * v, lambda t, v: -z, 1.0, 0.0, 1.0)[2]
    exact = (1 + 2 * z / 5 + z * z / 20) / (1 - 3 * z / 5 + 3 * z * z / 20 - z**3 / 60)
    assert amplification == pytest.approx(exact, rel=1e-10, abs=1e-13)
    held = 1.0 + held_update(1.0, -z, -z, -z, -z)[1]
    assert held == pytest.approx((1.0 + z / 4.0) / (1.0 - 0.75 * z + 0.25 * z * z), rel=1e-11)


def test_a_held_step_forgets_its_start_and_solves_its_equations():
    assert max(abs(1.0 + update) for update in held_update(1.0, 1e9, 1e9, 1e9, 1e9)) < 1e-8
    scale, d2, d3 = 3.0, 7.0, 11.0
    matrix = np.array([[d2, scale], [-4.0 * scale, 3.0 * scale + d3]])
    for rest in ([1.0, -2.0], [0.3, 5.0]):
        np.testing.assert_allclose(
            matrix @ held_update(scale, d2, d3, *rest), -np.array(rest), rtol=1e-14
        )


def test_slip_error_is_of_fourth_order_in_the_step():
    estimates = []
    for h in (0.2, 0.1):
        z = step(lambda t, v: v * v - math.exp(t), lambda t, v: 2 * v, 1.0, 0.0, h)
        estimates.append(abs(embedded_slip_error(1 / h, 2.0, 0.0, *z)))
    assert math.log2(estimates[0] / estimates[1]) == pytest.approx(4.0, abs=0.4)


@pytest.mark.parametrize("growth", [0.05, 0.2, 0.5])
def test_energy_error_of_a_held_step_is_on_the_safe_side(growth):
    power = [math.exp(growth * t) for t in (0.0, 0.5, 1.0)]
    energy = float(np.dot(SIMPSON, power))
    error = abs(energy - math.expm1(growth) / growth)
    assert 40.0 * error < held_energy_error(energy, 1.0, power[0], power[2]) < 160.0 * error
    assert held_energy_error(0.0, 1.0, 0.0, 0.0) == math.inf


def test_collocation_reproduces_cubics_and_their_rate():
    z = [c**3 - 2 * c for c in NODES]
    for part in (0.0, 0.3, 0.83, 1.0, 1.4):
        assert collocation(part, *z) == pytest.approx(
            (part**3 - 2 * part, 3 * part**2 - 2), abs=1e-12
        )


# --- Where a step must end -------------------------------------------------------------------------------------------


@given(
    root=st.floats(0.03, 0.97),
    far=st.floats(1.2, 5.0),
    near=st.floats(-5.0, -0.2),
    sign=st.sampled_from([-1, 1]),
)
def test_the_only_root_of_a_cubic_inside_the_step_is_found(root, far, near, sign):
    values = sign * (PLACES - root) * (PLACES - far) * (PLACES - near)
    assert crossing(*values) == pytest.approx(root, abs=1e-9)
    assert crossing(*(1e-12 * values)) == pytest.approx(root, abs=1e-9)


def test_of_several_roots_the_first_is_found_and_one_at_an_end_is_none():
    assert crossing(*((PLACES - 0.1) * (PLACES - 0.4) * (PLACES - 0.8))) == pytest.approx(
        0.1, abs=1e-9
    )
    for root in (0.0, 0.3 * AT_END, 1.0 - 0.3 * AT_END, 1.0):
        assert crossing(*(PLACES - root)) == 1.0
    assert crossing(*(PLACES + 1.0)) == 1.0 == crossing(*(-1.0 - PLACES))


def a_step(motion, roller, start, end, slip=0.0):
    """Record of work of a step with its stations' ring speeds, and the way of the roller."""
    work = np.zeros(1, WORK)[0]
    body = roller.body[0]
    ratio = float(body["orbit_ratio"] * body["outer_radius"])
    times = [start + node * (end - start) for node in NODES]
    now, attempt = work["now"], work["attempt"]
    now["time"], attempt["length"], attempt["times"], now["slip"] = (
        start,
        end - start,
        times,
        slip,
    )
    now["interval"], attempt["end_interval"] = (interval_of(motion, t, 0) for t in (start, end))
    now["at"]["ring_speed"] = -ratio * np.interp(start, motion.time, motion.shaft_speed)
    attempt["at"]["ring_speed"] = -ratio * np.interp(times, motion.time, motion.shaft_speed)
    return work, path_of(roller, motion, 0.0, limits_of(roller, motion, 2e-4)[0])


@pytest.fixture(scope="module")
def roller():
    return rollers(models(Laws.paper()))["downwind"]


@pytest.mark.parametrize(("start", "end"), [(0.0, 3.0), (0.2, 1.7), (0.9, 1.1), (2.0, 3.0)])
def test_what_is_missed_of_the_way_is_what_quadrature_of_the_speed_misses(roller, start, end):
    motion = motion_of([0.0, 1.0, 1.5, 2.0, 3.0], [0.0, 2.0, 2.0, -1.0, 0.5], (0.0, 0.0, 0.0))
    work, path = a_step(motion, roller, start, end)
    ratio = -float(roller.body[0]["orbit_ratio"] * roller.body[0]["outer_radius"])
    kinks = [instant for instant in motion.time if start < instant < end]
    exact = (
        ratio
        * quad(np.interp, start, end, (motion.time, motion.shaft_speed), points=kinks or None)[0]
    )
    travelled = (end - start) * float(np.dot(WEIGHTS, work["attempt"]["at"]["ring_speed"]))
    assert missed_way(path, work["now"], work["attempt"]) == pytest.approx(
        travelled - exact, abs=1e-9
    )
    linear = motion_of([0.0, 1.0, 3.0], [1.0, 1.3, 1.9], (0.0, 0.0, 0.0))
    work, path = a_step(linear, roller, 0.1, 2.9)
    assert missed_way(path, work["now"], work["attempt"]) == pytest.approx(0.0, abs=1e-14)


def test_steps_end_where_friction_has_a_cusp(roller):
    """Where the cage's load, the shaft's speed, or the load of a free roller passes through zero."""
    motion = motion_of([0.0, 1.0], [1.0, 1.0], (0.0, 0.0, 0.0))

    def part(zone=EDGE, **values):
        work, _ = a_step(motion, roller, 0.0, 1.0)
        now, attempt = work["now"], work["attempt"]
        now["at"]["tangential"], attempt["at"]["tangential"] = 1.0, 1.0
        now["forces"]["cage_load"] = 1.0
        for name, line in values.items():
            now["at"][name], attempt["at"][name] = line[0], line[1:]
        return first_cusp(now, zone, attempt)

    falling = 0.6 - PLACES
    assert part() == 1.0
    assert part(tangential=falling + 0.4) == 1.0
    work, _ = a_step(motion, roller, 0.0, 1.0)
    now, attempt = work["now"], work["attempt"]
    now["at"]["tangential"], attempt["at"]["tangential"] = (0.6 - PLACES[0], 0.6 - PLACES[1:])
    now["forces"]["cage_load"] = 0.6 - 0.25
    # The traction at the start, −0.25 N, is taken along.
    assert first_cusp(now, EDGE, attempt) == pytest.approx(0.35, abs=1e-9)
    assert part(ring_speed=falling) == pytest.approx(0.6, abs=1e-9)
    assert part(outer_load=falling) == 1.0
    assert part(FREE, outer_load=falling) == pytest.approx(0.6, abs=1e-9)


# --- Roots -----------------------------------------------------------------------------------------------------------


def judged(roller, slip, stage_slips, slopes=(1.0, 1.0, 1.0), cold=0.0, load=4e4):
    motion = motion_of([0.0, 1.0], [2.1, 2.1], (0.0, 0.0, 0.0))
    work, path = a_step(motion, roller, 0.0, 1e-3, slip)
    at = a_station(load)
    now, attempt = work["now"], work["attempt"]
    now["at"], attempt["at"], attempt["scale"], attempt["slip"] = (at, at, 100.0, stage_slips)
    attempt["forces"]["slope"] = slopes
    path.limits["cold_slip"] = cold
    return bool(is_continuous(path, now, attempt))


@pytest.mark.parametrize("laws", [Laws.paper(), Laws.physical()], ids=lambda laws: laws.name)
@pytest.mark.parametrize("load", [1e3, 4e4, 1e5])
def test_traction_rises_up_to_the_bound(laws, load):
    made = rollers(models(laws), tolerance=COARSE.tolerance)["downwind"]
    bound = surely_rising(made.body[0], made.tables, load, load, 0.4)
    assert 0.0 < bound < math.inf
    pulls = np.array(
        [forces_of(made, a_station(load), slip)["inner"] for slip in np.linspace(0.0, bound, 60)]
    )
    assert (np.maximum.accumulate(pulls) - pulls).max() < 5e-3 * pulls.max()
    both = surely_rising(made.body[0], made.tables, 1e3, 1e5, 0.4)
    alone = [
        surely_rising(made.body[0], made.tables, bound_load, bound_load, 0.4)
        for bound_load in (1e3, 1e5)
    ]
    assert min(alone) <= both <= max(alone)
    if laws.name == "paper":
        assert (
            forces_of(made, a_station(load), 100 * bound)["inner"]
            < forces_of(made, a_station(load), 10 * bound)["inner"]
        )


def test_only_the_root_continuous_with_the_past_is_taken(roller):
    bound = surely_rising(roller.body[0], roller.tables, 4e4, 4e4, 0.4)
    assert judged(roller, 0.0, (0.3 * bound, 0.5 * bound, 0.8 * bound))
    assert judged(roller, 1.0, (0.1, 0.2, 0.3), cold=2.0)
    # Above the bound only a small change is.
    assert judged(roller, 0.30, (0.29, 0.28, 0.30 * (1.0 - HOT_CHANGE) + 0.01))
    assert not judged(roller, 0.30, (0.29, 0.28, 0.30 * (1.0 - HOT_CHANGE) - 0.01))
    assert not judged(roller, 0.0, (0.1, 0.2, 0.3))
    assert judged(roller, 0.30, (0.30, 0.30, 0.30 - 1e-7))
    # Traction that falls faster than the step allows is never accepted.
    for which in range(3):
        slopes = [1.0, 1.0, 1.0]
        slopes[which] = -51.0
        assert not judged(roller, 0.0, (0.0, 0.0, 0.0), slopes, cold=1.0)
        slopes[which] = -49.0
        assert judged(roller, 0.0, (0.0, 0.0, 0.0), slopes, cold=1.0)


#: Laws of the paper's kind: as published, and without heating.
CLOSED_FORMS = {"paper": Laws.paper(), "cool": Laws.paper().but(heating=False)}
#: Forces that change the spin.
SPINNING = ("inner", "outer", "cage", "resistance")


@pytest.fixture(scope="module")
def closed_forms():
    return {
        name: rollers(models(laws), tolerance=COARSE.tolerance)["downwind"]
        for name, laws in CLOSED_FORMS.items()
    }


def corrected(made, at, slip, change):
    """Bound of what a correction of all stages leaves, and what it leaves of the net force."""
    attempt = np.zeros(1, WORK)[0]["attempt"]
    before, after = forces_of(made, at, slip), forces_of(made, at, slip + change)
    parts = [[forces[name] for name in SPINNING] for forces in (before, after)]
    for stage in range(3):
        attempt["at"][stage] = at
        attempt["forces"][stage] = before
        attempt["slip"][stage] = slip
    left_by_curvature(made.body[0], made.tables, attempt, (change, change, change))
    bound = float(attempt["left"].max())
    left = abs(sum(parts[1]) - sum(parts[0]) - before["slope"] * change)
    return bound, left, np.abs(parts).sum(axis=1).max()


@pytest.mark.parametrize("name", CLOSED_FORMS)
@given(
    st.floats(1.0, 5.0),
    st.floats(-1.5, 1.5),
    st.floats(-1.5, 1.5),
    st.floats(-2.0, -0.4),
    st.integers(-1000, 1000),
)
def test_what_a_correction_leaves_is_within_its_bound(
    closed_forms, name, log_load, before, after, log_speed, tangential
):
    made = closed_forms[name]
    load = 10.0**log_load
    at = a_station(load, 30.0, 0.1 * tangential, -(10.0**log_speed))
    speed = abs(float(at["ring_speed"]))
    largest = min(surely_rising(made.body[0], made.tables, load, load + 30.0, speed), speed)
    slip = UNHEATED * before * largest
    bound, left, forces = corrected(made, at, slip, UNHEATED * after * largest - slip)
    # A film without heating has stresses beyond floating point far from where it grips.
    assume(np.isfinite(forces))
    assert bound == math.inf or left <= bound + 1e-12 * forces
    if max(abs(before), abs(after)) > 1.0:
        assert bound == math.inf


def test_a_gripped_roller_needs_no_second_correction(roller):
    # The cage pushes with 25 N, and no slip of a gripped roller changes that: the bound is far below what is asked.
    at = a_station(8e4)
    peak = surely_rising(roller.body[0], roller.tables, 8e4, 8e4, abs(RING_SPEED))
    bound, left, forces = corrected(roller, at, 0.0, 1e-9 * peak)
    assert left <= bound < 1e-5 * forces
    # Where the cage's load passes zero its friction has a cusp.
    at["tangential"] = 0.0
    assert corrected(roller, at, 0.0, 1e-9)[0] == math.inf
