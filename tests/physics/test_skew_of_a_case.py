"""Skew over a case: nothing without play, books of its energy, its signs, and input that is refused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from macroslip import BearingLoads, Case, InputError, Laws, RollerLoads, Traces, simulate
from macroslip.case.parts import Radau
from macroslip.result.prepared import prepare
from macroslip.result.skew import thrust_on_ring
from macroslip.ring.motion import elastic_loads
from macroslip.roller.model import ring_geometry
from macroslip.roller.skew import skew_stop
from macroslip.whole.cage import Cage
from tests.quick import COARSE

SKEWED = Laws.physical().but(skew="quasi-static")
#: Below 16 kN a roller, so that tables are small.
LOADS = BearingLoads.constant([0.0, -60e3, 40e3], 2.143, 10.0)
RACEWAYS = {"interface": ["inner", "outer"]}


def case(laws=SKEWED, **cage):
    traces = Traces(step=0.1)
    return Case(
        loads=LOADS,
        rollers=[0],
        laws=laws,
        cage=Cage(**cage),
        traces=traces,
        contact_details=False,
        integrator=COARSE,
    )


def assert_nothing_but_ends_adds(skewed, straight):
    """A pocket without play holds rollers straight, and friction of its ends alone is added, at the cage."""
    assert np.array_equal(skewed.slip, straight.slip) and np.array_equal(
        skewed.cage_force, straight.cage_force
    )
    for name in ("energy", "orbit_energy", "peak_power", "power"):
        assert np.array_equal(skewed[name].sel(RACEWAYS), straight[name].sel(RACEWAYS)), name
    assert (skewed.skew_energy == 0.0).all()
    added = (skewed.energy - straight.energy).sel(interface="cage")
    assert (added.sel(row="downwind") > 0.0).all()
    assert added.values == pytest.approx(skewed.stop_energy.values, rel=1e-9, abs=1e-12)


@pytest.fixture(scope="module")
def straight():
    return simulate(case(Laws.physical()), threads=1)


@pytest.mark.slow
def test_without_play_nothing_changes(straight):
    result = simulate(case(skew_play=0.0), threads=1)
    assert_nothing_but_ends_adds(result, straight)
    assert (result.skew_residual == 0.0).all()
    assert (result.stop_force.sel(row="downwind", roller=0) > 0.0).all()


@pytest.mark.slow
def test_energy_is_that_of_a_straight_roller_and_of_skew():
    """Under given loads, which skew does not change; in both rows."""
    places = np.radians(np.tile(np.arange(0.0, 360.0, 45.0), (2, 2, 1)))
    loads = RollerLoads(
        np.array([0.0, 10.0]), np.full(2, 2.143), places, np.full(places.shape, 9e3), "even"
    )
    straight, skewed = (
        simulate(replace(case(laws, **cage), loads=loads), threads=1)
        for laws, cage in ((Laws.physical(), {}), (SKEWED, {"alignment": "none"}))
    )
    added = skewed.energy - straight.energy
    assert added.sel(RACEWAYS).values == pytest.approx(skewed.skew_energy.values, rel=1e-9)
    assert added.sel(interface="cage").values == pytest.approx(skewed.stop_energy.values, rel=1e-9)
    assert (skewed.skew_energy > 0.0).all() and (skewed.stop_energy > 0.0).all()
    # The shaft turns forward: rollers turn the unfavourable way, and push the ring as the thrust that their row carries does.
    stop = skew_stop(Case(loads=loads).bearing, "conforming-pocket", 0.5e-3)
    for row, sign in (("downwind", 1.0), ("upwind", -1.0)):
        roller = skewed.sel(row=row, roller=0)
        assert roller.skew_angle.values == pytest.approx(
            np.full(roller.time.size, sign * stop.largest), rel=1e-9
        )
        assert (sign * roller.axial_force > 0.0).all()
        assert sign * roller.frictional_thrust > 0.0
        assert roller.stop_force.values == pytest.approx(
            np.abs(roller.skew_moment.sum("raceway")).values / stop.arm, rel=1e-9
        )


@pytest.mark.slow
def test_the_ring_feels_the_force_that_a_result_shows():
    """By the ring's balance, which takes rollers as gripped, and by the rollers' own integration."""
    every = replace(case(), rollers="all", traces=None)
    result, ready = simulate(every), prepare(every)
    model = ready.model
    on_ring = thrust_on_ring(
        every, model, ring_geometry(every.bearing, model), ready.motion, ready.box
    )
    inside = ready.motion.time >= result.window_start
    mean = np.trapezoid(on_ring[inside, 2], ready.motion.time[inside]) / (
        result.window_end - result.window_start
    )
    assert float(result.frictional_thrust.sum()) == pytest.approx(mean, rel=0.02)
    # Rollers carry the load and this force.
    loads = elastic_loads(every.ring_loads, ring_geometry(every.bearing, model), ready.motion)
    carried = (loads * ring_geometry(every.bearing, model).axial).sum(axis=1)
    assert carried == pytest.approx(40e3 + on_ring[:, 2], rel=1e-3)


@pytest.mark.parametrize(
    ("laws", "cage", "part"),
    [
        (
            SKEWED,
            {"guidance": "guide-ring"},
            "guidance is guide-ring, and its skew_play is not given",
        ),
        (SKEWED, {"mass": 40.0}, "imposed orbits do not use it"),
        (Laws.physical(), {"skew_play": 5e-3}, "held straight"),
        (Laws.physical(), {"gap": 2e-4}, "imposed orbits do not use it"),
        (SKEWED, {"gap": 0.09}, "pockets would overlap"),
    ],
)
def test_cages_that_do_not_go_with_the_laws_are_refused(laws, cage, part):
    with pytest.raises(InputError, match=part):
        case(laws, **cage)


def test_laws_with_one_slip_all_over_have_no_skew():
    with pytest.raises(InputError, match=r"Choose model: physical"):
        Laws.paper().but(skew="quasi-static")


@pytest.mark.slow
def test_energy_is_that_at_a_tight_tolerance_where_rollers_leave_their_spars():
    """What skew adds jumps there; with steps of a tenth of an orbit energies were off by 7e-4, the cage's by 6e-3."""
    time = np.arange(0.0, 20.001, 0.05)
    speed = 11.0 * np.pi / 30.0 * (0.3 + 0.7 * (time / 3.0 % 1.0))
    loads = BearingLoads(time, speed, np.tile([0.0, -200e3, 40e3], (time.size, 1)), "sawtooth")
    rough = Case(loads=loads, laws=SKEWED, rollers=[0, 7, 14], contact_details=False)
    result = simulate(rough, threads=1)
    exact = simulate(replace(rough, integrator=Radau(tolerance=1e-5)), threads=1)
    total = exact.energy.sum("interface")
    assert float(abs(result.energy.sum("interface") / total - 1.0).max()) < 2.5e-4
    assert float(abs(result.energy / exact.energy - 1.0).max()) < 2e-3
