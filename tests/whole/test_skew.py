"""Skew in the whole bearing: rests under the force that its pockets exert, and what ends of spars that hold rollers add."""

from __future__ import annotations

import numpy as np
import pytest

from macroslip import BearingLoads, Case, InputError, Laws, Traces, simulate
from macroslip.bearing.geometry import roller_radius
from macroslip.compiled import jit
from macroslip.contact.laws import prepare
from macroslip.contact.rolling import rigid_pocket_contact
from macroslip.measures.skew import SkewMeasures, _power_of_ends
from macroslip.measures.totals import END
from macroslip.result.prepared import prepare as prepare_case
from macroslip.result.skew import skewing
from macroslip.result.variables import VARIABLES
from macroslip.roller.model import with_tables
from macroslip.roller.skew import equilibrium, raceways, skew_stop
from macroslip.whole.cage import Cage
from tests.quick import COARSE
from tests.variables import check_variables
from tests.whole.conftest import losses_of_closed_books

pytestmark = pytest.mark.slow

SKEWED = Laws.physical().but(skew="quasi-static")
#: Below 16 kN a roller, so that tables are small.
LOADS = BearingLoads.constant([0.0, -60e3, 40e3], 2.143, 10.0)
RACEWAYS = {"interface": ["inner", "outer"]}


def case(laws=SKEWED, **changes):
    given = {
        "dynamics": "whole-bearing",
        "traces": Traces(step=0.1),
        "contact_details": False,
        "rating": False,
        "integrator": COARSE,
    }
    return Case(loads=LOADS, laws=laws, **given | changes)


@pytest.fixture(scope="module")
def straight():
    return simulate(case(Laws.physical()))


@pytest.fixture(scope="module")
def skewed():
    return simulate(case())


def pressed(result, least=2e3):
    """States of the downwind row's rollers under more than `least` [N], one after another."""
    names = ["roller_load", "skew_angle", "axial_force", "stop_force", "cage_force", "spin_pure"]
    states = result[names].sel(row="downwind").stack(state=("roller", "time"))
    return states.isel(state=np.flatnonzero(states.roller_load.values > least))


def test_without_play_all_but_the_friction_of_the_ends_is_that_of_straight_rollers(straight):
    result = simulate(case(cage=Cage(skew_play=0.0)))
    for name in straight.data_vars:
        # Rollers that are held straight have the moment of the ends beside, and friction at the cage.
        if name in ("skew_moment", "start_angle"):
            continue
        mine, other = result[name], straight[name]
        if "interface" in mine.dims:
            mine, other = mine.sel(RACEWAYS), other.sel(RACEWAYS)
        np.testing.assert_array_equal(mine, other, err_msg=str(name))
    assert (result.skew_energy == 0.0).all() and float(result.stop_force.max()) > 1.0
    check_variables(result, VARIABLES)
    added = (result.energy - straight.energy).sel(interface="cage").values
    assert added == pytest.approx(result.stop_energy.values, rel=1e-9, abs=1e-10)
    assert (added[0] > 0.0).all()


def test_what_skew_adds_stands_beside_closed_books():
    """Books are those of the equations of motion; raceways and ends of spars add to them what the result says."""
    result = simulate(case(traces=None))
    lost = losses_of_closed_books(result)
    spent = (result.energy + result.rolling_energy).sum(("row", "roller"))
    beside = float(
        result.mechanism_energy.sel(RACEWAYS).sel(mechanism="contact angle").sum()
        + result.skew_energy.sum()
    )
    assert float(spent.sel(RACEWAYS).sum()) - beside == pytest.approx(
        lost["raceway_loss"], rel=1e-6
    )
    ends = float(result.stop_energy.sum())
    assert float(spent.sel(interface="cage")) - ends == pytest.approx(
        lost["friction_loss"], rel=1e-6
    )
    assert 0.05 * lost["friction_loss"] < ends < lost["friction_loss"]
    assert float(result.skew_energy.sum()) > 0.1 * float(
        result.energy.sel(RACEWAYS | {"row": "downwind"}).sum()
    )


def test_spar_and_ends_carry_what_the_contacts_leave(skewed):
    """By the contacts themselves, without the table, at rests on the way and at the stop."""
    states, bearing = pressed(skewed), case().bearing
    load, skew = states.roller_load.values, states.skew_angle.values
    laws, stop = (
        prepare(SKEWED, bearing, case().oil, 1),
        skew_stop(bearing, "conforming-pocket", 0.5e-3),
    )
    speed = states.spin_pure.values * roller_radius(bearing)
    exact = equilibrium(raceways(laws, bearing, 1), laws, load, speed, skew)
    arm = np.minimum(stop.effective_radius * np.abs(skew), 0.5 * stop.arm)
    borne = np.sign(skew) * (
        np.abs(states.cage_force.values) * arm + states.stop_force.values * stop.arm
    )
    reach = laws.inner.interface.hertz.semi_axis_across * np.cbrt(load)
    assert (np.abs(exact.moment - borne) < 2e-3 * 0.04 * load * reach).all()
    held = states.stop_force.values > 0.0
    assert 0.02 < held.mean() < 0.98
    assert np.abs(skew[held]) == pytest.approx(stop.largest, rel=1e-9) and np.abs(
        skew
    ).max() <= stop.largest * (1 + 1e-12)


def test_under_the_forces_of_an_imposed_orbit_rests_are_those_of_an_imposed_orbit():
    """And so is the ring's motion, which feels the force of rollers there."""
    whole, imposed = case(), case(dynamics="imposed-orbit")
    ready, other = prepare_case(whole), prepare_case(imposed)
    scale = np.abs(other.motion.displacement).max()
    np.testing.assert_allclose(
        ready.motion.displacement, other.motion.displacement, atol=1e-4 * scale
    )
    states = pressed(simulate(imposed), 100.0)
    raw = np.zeros(states.sizes["state"], END)
    raw["elastic_load"], raw["cage_load"] = states.roller_load, states.cage_force
    raw["outer_speed"] = states.spin_pure.values * roller_radius(whole.bearing)
    roller = with_tables(ready.models, ready.box)[0]["downwind"]
    skews = skewing(whole, ready.model.laws, ready.box)["downwind"]
    traces = SkewMeasures(skews, roller, 0.0).traces(raw)
    for name, size in (("skew_angle", 2e-5), ("axial_force", 1.0), ("stop_force", 0.02)):
        np.testing.assert_allclose(traces[name], states[name], atol=size, err_msg=name)


def test_spars_that_press_less_leave_rollers_to_their_stops(skewed):
    """A coupled orbit's rollers give way; on both orbits the force on the ring is downwind."""
    imposed = simulate(case(dynamics="imposed-orbit"))
    assert (pressed(skewed).stop_force > 0.0).mean() > (pressed(imposed).stop_force > 0.0).mean()
    assert float(skewed.frictional_thrust[0]) > float(imposed.frictional_thrust[0]) > 0.0


def test_without_guidance_nothing_rubs():
    result = simulate(case(cage=Cage(guidance="none", alignment="none")))
    assert (result.status == 0).all()
    assert (result.stop_energy == 0.0).all() and not (result.stop_force > 0.0).any()
    assert float(np.abs(result.skew_angle).max()) == pytest.approx(0.06, rel=1e-9)


@jit
def ends(body, tables, stop, push, speed):
    return _power_of_ends((body[0], tables), stop, push, speed)


@pytest.mark.parametrize(("stop", "push"), [(0.5, 0.0), (8.0, 3.0), (12.0, -40.0)])
def test_friction_of_the_ends_is_that_of_the_cage_s_law(stop, push):
    """The law itself, at three loads, without tables; at 35 °C a film of viscous oil is nearly all of it.

    Tables end at 0.1 mN.
    """
    ready, speed = prepare_case(case()), 0.4
    roller = with_tables(ready.models, ready.box)[0]["downwind"]
    law = ready.model.laws.cage
    loads = np.maximum([stop + abs(push), stop, abs(push)], 1e-4)
    drag, _ = rigid_pocket_contact(law.rolling, loads, 0.5 * speed, 0.25e-3)
    expected = float(np.array([1.0, 1.0, -1.0]) @ drag) * speed**2
    for sign in (1.0, -1.0):
        power, rough = ends(roller.body, roller.tables.ctypes.data, stop, push, sign * speed)
        assert power == pytest.approx(expected, rel=0.02) and rough == 0.0
    assert ends(roller.body, roller.tables.ctypes.data, 0.0, push, speed) == (0.0, 0.0)


@pytest.mark.parametrize(
    ("changes", "part"),
    [
        ({"laws": Laws.physical(), "cage": Cage(skew_play=5e-3)}, "held straight"),
        ({"cage": Cage(gap=0.09)}, "pockets would overlap"),
    ],
)
def test_input_that_does_not_go_with_it_is_refused(changes, part):
    with pytest.raises(InputError, match=part):
        case(**changes)
