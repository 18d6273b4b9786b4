"""The computed torque balances dissipated power, and the handbooks stand beside it at the same times."""

import numpy as np
import pytest

from macroslip import (
    BearingLoads,
    Case,
    Drivetrain,
    HubLoads,
    InputError,
    Laws,
    Traces,
    main_bearing_load,
    simulate,
)
from macroslip.torque import computed_torque, skf_torque, torque_histories
from macroslip.torque.computed import TORQUE
from tests.variables import check_variables

pytestmark = pytest.mark.slow

SPEED = 2.143


@pytest.fixture(scope="module", params=["paper", "physical"])
def result(request):
    loads = HubLoads.bundled("14B").window(0.0, 16.0)
    return simulate(
        Case(loads=loads, traces=Traces(step=0.02, start=0.005), laws=Laws.named(request.param))
    )


def constant(force, speed=SPEED, laws=Laws.paper(), **options):
    loads = BearingLoads.constant(force, speed, 8.0)
    return simulate(Case(loads=loads, traces=Traces(step=0.05), laws=laws, **options))


def test_torque_times_speed_is_what_is_dissipated(result):
    torque = computed_torque(result)
    loads = main_bearing_load(HubLoads.bundled("14B"), Drivetrain())
    np.testing.assert_allclose(
        torque.shaft_speed, np.interp(torque.time, loads.time, loads.shaft_speed), rtol=1e-9
    )
    power = (result.power + result.rolling_power).sum(("row", "roller", "interface"))
    np.testing.assert_allclose(
        (torque.torque - torque.drag_torque) * torque.shaft_speed, power, rtol=1e-9
    )
    inside = torque.time >= result.attrs["window_start"]
    work = np.trapezoid((power.values)[inside], torque.time.values[inside])
    assert work == pytest.approx(float(result.energy.sum() + result.rolling_energy.sum()), rel=0.02)


def test_parts_add_up_and_have_units(result):
    torque = computed_torque(result)
    check_variables(torque, TORQUE)
    parts = (torque.contact_torque + torque.rolling_torque).sum(
        ("row", "interface")
    ) + torque.drag_torque
    np.testing.assert_allclose(parts, torque.torque, rtol=1e-12)
    assert (torque.contact_torque >= 0.0).all()
    assert (torque.rolling_torque >= 0.0).all()
    assert bool((torque.rolling_torque > 0.0).any()) == (result.attrs["model"] == "physical")
    assert {name: variable.attrs["units"] for name, variable in torque.data_vars.items()} == {
        "shaft_speed": "rad/s",
        "torque": "N m",
        "contact_torque": "N m",
        "rolling_torque": "N m",
        "ring_torque": "N m",
        "drag_torque": "N m",
    }


def test_microslip_is_felt_downwind_and_the_cage_under_the_papers_model():
    force = [0.0, -300e3, 100e3]
    physical = Laws.physical()
    mean = [
        computed_torque(constant(force, laws=laws))
        .contact_torque.sel(time=slice(4.0, None))
        .mean("time")
        for laws in (physical.but(rolling="none"), physical, Laws.paper())
    ]
    raceways = [torque.sel(row="downwind", interface=["inner", "outer"]).sum() for torque in mean]
    cage = [torque.sel(interface="cage").sum() for torque in mean]
    assert raceways[0] > 100.0 * cage[0]
    # With rolling resistance the inclined pressure pushes the rollers against the cage, whose orbit is imposed.
    assert 100.0 * cage[1] > raceways[1] > cage[1]
    assert cage[2] > raceways[2]


def test_drag_is_that_of_the_rollers_at_their_speed():
    torque = computed_torque(constant([0.0, -300e3, 100e3]))
    # Half of C_D times density times fill factor, the area 2 r l, and (Ω r~)² at Ω = Ω_in r~_in/(r~_in + r~_out).
    speed = SPEED * 0.338367 / (0.338367 + 0.407033) * 0.3727
    force = 0.5 * 1.0 * 900.0 * 0.7 * (2.0 * 0.035 * 0.106) * speed**2
    np.testing.assert_allclose(torque.drag_torque, 56 * force * speed / SPEED, rtol=1e-5)
    assert (computed_torque(constant([0.0, -300e3, 100e3], drag=False)).drag_torque == 0.0).all()


def test_torque_is_against_the_rotation_either_way():
    force = [0.0, -300e3, 100e3]
    forward, back = (computed_torque(constant(force, speed)) for speed in (SPEED, -SPEED))
    assert (back.shaft_speed < 0.0).all()
    # The load is symmetrical about the vertical, and so are the rollers.
    np.testing.assert_allclose(back.torque[40:], forward.torque[40:], rtol=0.02)


def test_a_shaft_at_rest_has_no_torque_to_speak_of():
    assert np.isnan(computed_torque(constant([0.0, -300e3, 0.0], 0.0)).torque).all()


def test_a_failed_roller_leaves_no_number(result):
    broken = result.copy(deep=True)
    for name in ("power", "spin_pure"):
        broken[name][0, 0, 100:] = np.nan
    torque = computed_torque(broken)
    assert np.isfinite(torque.torque[:100]).all()
    assert np.isnan(torque.torque[100:]).all()


def test_what_is_needed_is_said():
    loads = BearingLoads.constant([0.0, -300e3, 0.0], SPEED, 2.0)
    with pytest.raises(InputError, match="has no traces"):
        computed_torque(simulate(Case(loads=loads, laws=Laws.paper())))
    with pytest.raises(InputError, match="27 rollers of each row are missing"):
        computed_torque(
            simulate(Case(loads=loads, laws=Laws.paper(), rollers=[0], traces=Traces(step=0.5)))
        )
    one_row = simulate(Case(loads=loads, laws=Laws.paper(), traces=Traces(step=0.5))).sel(
        row=["upwind"]
    )
    with pytest.raises(InputError, match="a row is missing"):
        computed_torque(one_row)


def test_handbooks_are_told_of_the_same_times(result):
    case = Case(loads=HubLoads.bundled("14B"), laws=Laws.paper())
    loads = main_bearing_load(case.loads, case.drivetrain)
    computed = computed_torque(result)
    histories = torque_histories({"one": computed}, loads, case.bearing, case.lubricant)
    assert list(histories) == ["model one", "SKF, sliding", "SKF, all", "Palmgren, all"]
    np.testing.assert_array_equal(histories["model one"].torque, computed.torque)
    assert histories["SKF, all"].time[-1] <= float(computed.time[-1])
    k = 100
    radial = np.hypot(*loads.force[k, :2])
    skf = skf_torque(case.bearing, case.lubricant, radial, loads.force[k, 2], loads.shaft_speed[k])
    assert histories["SKF, all"].time[k - 1] == loads.time[k]
    assert histories["SKF, sliding"].torque[k - 1] == pytest.approx(float(skf.sliding), rel=1e-12)
