"""Behaviour of the production integrator on whole histories."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from macroslip import BearingLoads, Case, Drivetrain, HubLoads, Laws, Radau, Traces, Window, main_bearing_load, simulate
from macroslip.imposed.status import Status

pytestmark = pytest.mark.slow

TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9)


def run(loads, tolerance=1e-6, rollers=(3,), **settings_):
    return simulate(Case(loads=loads, rollers=list(rollers), integrator=Radau(tolerance=tolerance), **settings_))


@pytest.fixture(scope="module")
def reference(turbulent):
    return run(turbulent, 1e-10, traces=Traces(step=1.0))


@pytest.mark.parametrize("tolerance", TOLERANCES)
def test_every_tolerance_gives_the_answer_it_promises(turbulent, reference, tolerance):
    found = run(turbulent, tolerance, traces=Traces(step=1.0))
    assert (found.status == Status.COMPLETED).all()
    energy, exact = found.energy.sum("interface"), reference.energy.sum("interface")
    assert float(abs(energy / exact - 1).max()) < max(0.3 * tolerance, 3e-9)
    coasting = abs(reference.slip) > 1e-3
    assert coasting.any()
    spin_error = (abs(found.spin - reference.spin) / abs(reference.spin)).where(coasting)
    # A coast remembers; the errors of its steps add up.
    assert float(spin_error.max()) < max(tolerance, 3e-9)


def test_default_tolerance_keeps_its_promises(turbulent, reference):
    found = simulate(Case(loads=turbulent, rollers=[3], traces=Traces(step=1.0)))
    assert float(abs(found.energy.sum("interface") / reference.energy.sum("interface") - 1).max()) < 1e-3
    coasting = abs(reference.slip) > 1e-3
    assert float((abs(found.spin / reference.spin - 1)).where(coasting).max()) < 1e-4
    peak, exact = found.peak_power.max("interface"), reference.peak_power.max("interface")
    assert float(abs(peak / exact - 1).max()) < 1e-2


@pytest.mark.parametrize("laws", [Laws.paper(), Laws.physical()], ids=lambda laws: laws.name)
@pytest.mark.parametrize("step", [0.05, 0.02, 1.0 / 3.0])
def test_traces_belong_to_their_times(laws, step):
    """Also where a time of the traces and a sample of the loads differ by rounding only."""
    loads = main_bearing_load(HubLoads.bundled("22A").window(None, 60.0), Drivetrain())
    found = simulate(Case(loads=loads, laws=laws, rollers=[8], traces=Traces(step=step))).isel(roller=0)
    speed = np.interp(found.time.values, loads.time, loads.shaft_speed)
    for row in ("downwind", "upwind"):
        pure = found.spin_pure.sel(row=row).values
        np.testing.assert_allclose(pure / speed, pure[0] / speed[0], rtol=1e-12)


def test_threads_and_repetition_change_no_bit(turbulent):
    one = simulate(Case(loads=turbulent, rollers=[0, 9, 20]), threads=1)
    many = simulate(Case(loads=turbulent, rollers=[0, 9, 20]), threads=3)
    for name in one.data_vars:
        assert np.array_equal(one[name], many[name], equal_nan=True), name


def test_a_short_load_in_the_middle_of_a_coast_is_not_passed_over():
    time = np.linspace(0.0, 8.0, 161)
    force = np.zeros((161, 3))
    force[:, 1] = -100.0
    pulse = (time > 4.02) & (time < 4.12)
    assert pulse.sum() == 2
    force[pulse] = [0.0, 300e3, 0.0]
    for tolerance in (1e-2, 1e-4, 1e-8):
        found = run(
            BearingLoads(time, np.full(161, 2.143), force, "pulse"),
            tolerance,
            rollers=range(0, 28, 4),
            traces=Traces(step=0.5),
            window=Window(start=0.0),
        ).sel(row="downwind")
        # Rollers near the top are gripped by the pulse: their slip, built up for seconds, is gone just after it.
        before, after = abs(found.slip.sel(time=4.0)), abs(found.slip.sel(time=4.5, method="nearest"))
        angle = found.start_angle + 0.45394 * 2.143 * 4.07
        top = np.sin(angle) > 0.8
        assert top.any()
        assert (before.where(top, drop=True) > 0.05).all()
        assert (after.where(top, drop=True) < 0.5 * before.where(top, drop=True)).all()


def test_standstill_reversal_and_their_mirror_image():
    time = np.linspace(0.0, 20.0, 401)
    speed = 2.1 * np.cos(2 * np.pi * time / 20.0)
    force = np.tile([30e3, -343e3, 20e3], (401, 1))
    mirrored = force * [-1.0, 1.0, 1.0]
    window = Window(start=0.0)
    ahead = run(BearingLoads(time, speed, force, "reversing"), 1e-7, rollers=[0], window=window)
    back = run(BearingLoads(time, -speed, mirrored, "mirror image"), 1e-7, rollers=[0], window=window)
    assert (ahead.status == 0).all()
    # Roller 0 of the downwind row starts at the bottom, on the mirror's own plane.
    assert back.energy.sel(row="downwind").values == pytest.approx(ahead.energy.sel(row="downwind").values, rel=1e-5)
    rest = run(BearingLoads.constant([0.0, -343e3, 0.0], 0.0, 2.0), rollers=[0])
    assert (rest.status == 0).all() and float(abs(rest.energy).max()) == 0.0


@given(
    force=st.tuples(*[st.floats(-4.5e5, 4.5e5)] * 3),
    speed=st.floats(-3.0, 3.0),
    late_speed=st.floats(-3.0, 3.0),
    tolerance=st.sampled_from(TOLERANCES[:6]),
)
@settings(max_examples=40, deadline=None)
def test_any_load_and_speed_completes_within_the_exact_bounds(force, speed, late_speed, tolerance):
    time = np.linspace(0.0, 6.0, 121)
    loads = BearingLoads(time, np.linspace(speed, late_speed, 121), np.tile(force, (121, 1)), "any")
    found = run(loads, tolerance, rollers=[0, 13], window=Window(start=0.0))
    assert (found.status == Status.COMPLETED).all()
    assert np.isfinite(found.energy).all() and (found.energy >= 0.0).all()
    assert (found.unbalanced_force < 1e-4).all()
    # Cage power is at most traction of 60 N on the cage at the fastest surface; energy cannot exceed it.
    fastest = max(abs(speed), abs(late_speed)) * 0.45394 * 0.407
    assert float(found.energy.sel(interface="cage").max()) <= 5.0 * fastest * 6.0 + 1e-12


def test_a_roller_that_fails_says_so_and_stops_nobody_else(turbulent):
    found = simulate(Case(loads=turbulent, rollers=[3], integrator=Radau(max_steps=40)))
    assert (found.status == Status.TOO_MANY_STEPS).all()
    assert found.energy.isnull().all() and found.peak_power.isnull().all() and found.min_spin_ratio.isnull().all()
    assert (found.end_time > turbulent.time[0]).all() and (found.end_time < turbulent.time[-1]).all()
    assert np.isfinite(found.end_slip).all()


def test_cost_grows_linearly_with_duration():
    loads = HubLoads.bundled("16B")
    evaluations = [
        float(simulate(Case(loads=loads.window(0.0, end), rollers=[5])).force_evaluations.sum())
        for end in (100.0, 200.0, 400.0)
    ]
    assert evaluations[1] / evaluations[0] == pytest.approx(2.0, rel=0.4)
    assert evaluations[2] / evaluations[1] == pytest.approx(2.0, rel=0.4)


@pytest.mark.parametrize("period", [6.0, 8.0, 10.0, 13.0])
@pytest.mark.parametrize("thrust", [0.0, 100e3, -60e3])
def test_shaft_reversal_with_microslip_gives_power_and_energy_of_a_tight_tolerance(period, thrust):
    """A gripped roller's slip passes zero with the shaft's speed; nothing may be made of the ratio of the two there."""
    time = np.linspace(0.0, 20.0, 1001)
    speed = 20.0 * 2.0 * np.pi / 60.0 * np.sin(2.0 * np.pi * time / period)
    loads = BearingLoads(time, speed, np.tile([0.0, -300e3, thrust], (time.size, 1)), "reversing")
    default, coarse, tight = (
        run(loads, tolerance, rollers=[7], laws=Laws.physical(), window=Window(start=0.0))
        for tolerance in (2e-4, 2e-5, 1e-7)
    )
    for found in (default, coarse, tight):
        assert (found.status == Status.COMPLETED).all()
    for found in (default, coarse):
        energy, exact = found.energy.sum("interface"), tight.energy.sum("interface")
        assert float(abs(energy / exact - 1).max()) < 1e-3
        peak, highest = found.peak_power.max("interface"), tight.peak_power.max("interface")
        assert peak.size and float(abs(peak / highest - 1).max()) < 0.02
        # Both spins pass zero at a reversal; their ratio is taken where it means something.
        assert (abs(found.min_spin_ratio) < 10.0).all()


def test_start_from_standstill_with_microslip():
    """No energy has been spent yet to which that of the first steps could be compared."""
    time = np.linspace(0.0, 8.0, 161)
    speed = np.clip((time - 1.0) / 3.0, 0.0, 1.0)
    loads = BearingLoads(time, speed, np.tile([0.0, -300e3, 60e3], (time.size, 1)), "starting")
    tightest, *others = (
        run(loads, tolerance, rollers=[0, 14], laws=Laws.physical(), window=Window(start=0.0))
        for tolerance in (1e-8, 1e-6, 2e-4)
    )
    assert (tightest.status == Status.COMPLETED).all()
    # A step may be off by ten tolerances of its energy, or of what the mean power since the start spends in its time,
    # whichever is more. The energies E of the steps add up to that of the history, those of the mean power to the
    # integral of E(t)/t, which is 1.1 times as much here.
    exact = tightest.energy.sum("interface")
    for found, tolerance in zip(others, (1e-6, 2e-4), strict=True):
        assert (found.status == Status.COMPLETED).all()
        np.testing.assert_allclose(found.energy.sum("interface"), exact, rtol=min(21.0 * (tolerance + 1e-8), 1e-3))


def test_spin_ratio_of_a_shaft_at_rest_is_not_a_number():
    rest = run(BearingLoads.constant([0.0, -343e3, 0.0], 0.0, 2.0), rollers=[0], window=Window(start=0.0))
    assert rest.min_spin_ratio.isnull().all()
