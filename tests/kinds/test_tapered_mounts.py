"""Two bearings on one shaft, and what no mount and no bearing carries."""

import math

import numpy as np
import pytest

from macroslip import Bearing, Case
from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.errors import InputError
from macroslip.kinds.tapered.history import TaperedMount, TaperedState, tapered_history
from macroslip.kinds.tapered.of_case import tapered_ring_motion
from macroslip.loads import Drivetrain, support_loads
from macroslip.loads.history import HubLoads
from macroslip.loads.moment_bearing import shaft_load
from macroslip.lubricant import Lubricant
from macroslip.ring.tapered import strip_loads, tapered_balance, tapered_ring, two_bearings

MAIN = TaperedBearing.read("tdo-main-bearing")
SMALL = TaperedBearing.read("32216-pair")
OIL = Lubricant.read("vg460-pao").at(308.15)


def constant(force, moment=(0.0, 0.0, 0.0), speed=1.2566):
    """Hub loads fx, fy, fz and mx, my, mz of two samples."""
    return HubLoads.constant(force, moment, speed, 1.0, step=1.0)


def test_two_single_rows_carry_and_thrust_against_each_other():
    """A pair of 32216 in O arrangement, 120 mm apart, under 10 kN across and 3 kN along the shaft."""
    mount = TaperedMount(0.0, front_to_rear=0.12, rows_each=1)
    sine = math.sin(tapered_geometry(SMALL).outer_angle)
    for thrust, induced in ((0.0, (1691.0, 1691.0)), (3e3, (4543.0, 1543.0))):
        # The hub lies in the middle of the pair: its moment about the front bearing is undone.
        loads = constant([thrust, 0.0, -10e3], [0.0, 0.06 * 10e3, 0.0])
        history = tapered_history(SMALL.replace(row_offset=0.03), OIL, loads, mount)
        if thrust == 0.0:
            assert float(history.outer_load.max()) == pytest.approx(1425.6, rel=0.02)
        carried = history.outer_load.isel(time=0).sum("roller").values * sine
        assert carried == pytest.approx(induced, rel=0.02)
        assert list(history.row.values) == ["downwind", "upwind"]


def test_all_rows_of_two_bearings_balance_force_and_moment():
    """Equilibrium of a rigid shaft on four rows, by the loads of all strips of the outer rings."""
    bearing = MAIN.replace(preload=-0.05e-3)
    ring = two_bearings(tapered_ring(bearing), 2.0)
    force = np.array([[50e3, -2300e3, 700e3]])
    moment = np.array([[-2700e3, 200e3]])
    balance = tapered_balance(ring, np.array([0.4]), force, moment)
    row = tapered_geometry(bearing)
    _, outer = strip_loads(ring, balance, np.array([0.4]), 0)
    phi = ring.angle + ring.orbit_ratio * 0.4
    places = bearing.roller_length * ((np.arange(41) + 0.5) / 41 - 0.5)
    along = (row.apex_distance + places) / math.cos(row.half_cone_angle)
    radius = along * math.sin(row.outer_angle)
    apex = ring.axial_position + ring.sign * row.apex_distance * math.cos(row.axis_angle)
    height = apex[:, None] - ring.sign[:, None] * along * math.cos(row.outer_angle)
    radial = outer * math.cos(row.outer_angle)
    axial = outer * math.sin(row.outer_angle) * ring.sign[:, None]
    across = radial.sum(axis=1)
    assert (across * np.cos(phi)).sum() == pytest.approx(force[0, 0], abs=30.0)
    assert (across * np.sin(phi)).sum() == pytest.approx(force[0, 1], rel=1e-5)
    assert axial.sum() == pytest.approx(force[0, 2], rel=1e-5)
    # About X0: Y F_Z − Z F_Y, about Y0: Z F_X − X F_Z.
    turning = (radius * axial - height * radial).sum(axis=1)
    assert (turning * np.sin(phi)).sum() == pytest.approx(moment[0, 0], rel=1e-4)
    assert -(turning * np.cos(phi)).sum() == pytest.approx(moment[0, 1], rel=1e-3)


def test_far_apart_two_bearings_share_a_force_between_them_by_the_lever():
    """A moment of 0.5 F d about the middle of two bearings d apart loads the rear one alone."""
    distance, load = 20.0, 500e3
    bearing = MAIN.replace(preload=0.0)
    ring = two_bearings(tapered_ring(bearing), distance)
    moment = -load * distance / 4.0
    balance = tapered_balance(
        ring, np.zeros(1), np.array([[0.0, -load, 0.0]]), np.array([[moment, 0.0]])
    )
    across = balance.outer_load[0] * math.cos(bearing.outer_angle) * np.sin(ring.angle)
    front, rear = across.reshape(2, -1).sum(axis=1)
    # Each bearing takes a little of the moment as a moment.
    assert sorted([front / -load, rear / -load]) == pytest.approx([0.25, 0.75], abs=0.01)


def test_a_second_bearing_far_from_the_load_leaves_the_rows_their_names():
    mount = TaperedMount(1.0, front_to_rear=2.0)
    history = tapered_history(MAIN, OIL, constant([700e3, 50e3, -1300e3]), mount)
    assert list(history.row.values) == [
        "front downwind", "front upwind", "rear downwind", "rear upwind",
    ]  # fmt: skip
    thrust = history.outer_load.isel(time=0).sum("roller").values * math.sin(MAIN.outer_angle)
    assert thrust @ [1.0, -1.0, 1.0, -1.0] == pytest.approx(700e3, rel=1e-5)
    front, rear = thrust[:2].sum(), thrust[2:].sum()
    assert front > rear  # the rotor's weight hangs ahead of the front bearing


def test_a_gearbox_beside_two_bearings_is_refused():
    with pytest.raises(InputError, match="two bearings and a support of the gearbox"):
        TaperedMount(1.0, support_stiffness=1e8, front_to_rear=2.0)


def test_a_single_row_alone_is_refused():
    with pytest.raises(InputError, match="carries thrust one way only"):
        TaperedMount(1.0, rows_each=1)


def test_a_preload_beyond_the_static_rating_is_refused():
    loads = constant([0.0, 0.0, -1e3])
    with pytest.raises(
        InputError, match=r"preload.*alone presses every roller.*static load rating"
    ):
        tapered_history(SMALL.replace(preload=1.2e-3), OIL, loads, TaperedMount(0.0))
    pressed = SMALL.replace(preload=0.8e-3)
    tapered_history(pressed, OIL, loads, TaperedMount(0.0))
    warm = TaperedState(temperature_difference=100.0)
    with pytest.raises(InputError, match="temperature difference"):
        tapered_history(pressed, OIL, loads, TaperedMount(0.0), warm)


def test_moments_on_rows_whose_load_centres_meet_are_refused():
    """In X arrangement the load centres meet where the row offset is that of the load centre."""
    centre = tapered_geometry(MAIN).load_centre
    meeting = MAIN.replace(arrangement="X", row_offset=centre)
    loads = constant([0.0, 0.0, -1e6])
    with pytest.raises(InputError, match=r"0 mm apart in X arrangement, which carries no moment"):
        tapered_history(meeting, OIL, loads, TaperedMount(2.0))
    tapered_history(MAIN, OIL, loads, TaperedMount(2.0))


def test_an_unknown_line_law_is_refused():
    with pytest.raises(InputError, match="palmgren or plane-strain"):
        TaperedState(line_law="half-space")


PAIR = {"mount": "two-bearings", "hub_to_bearing": 0.0, "front_to_rear": 0.12, "tilt": 0.0}


def test_a_case_of_two_bearings_is_balanced_as_a_pair_on_one_shaft():
    """Of the file the row counts, and the mount has the distance of both."""
    loads = constant([3e3, 0.0, -10e3], [0.0, 0.06 * 10e3, 0.0])
    pair = Case(
        bearing=SMALL.replace(row_offset=0.03),
        lubricant=Lubricant.read("vg460-pao"),
        temperature=308.15,
        loads=loads,
        drivetrain=Drivetrain(**PAIR),
        oil_supply="flooded",
    )
    outer = tapered_ring_motion(pair).balance.outer_load
    induced = outer[0].reshape(2, -1).sum(axis=1) * math.sin(SMALL.outer_angle)
    assert induced == pytest.approx((4543.0, 1543.0), rel=0.02)


def test_force_and_moment_on_two_bearings_are_those_of_rotor_and_shaft_about_their_middle():
    """A free body: moments of all forces about the middle between both bearings vanish."""
    shaft = Drivetrain(
        mount="two-bearings", hub_to_bearing=1.1, front_to_rear=1.6, tilt=0.0, shaft_mass=2e4,
        shaft_mass_station=2.4,
    )  # fmt: skip
    loads = constant([700e3, 50e3, -1300e3], [0.0, -700e3, 200e3])
    force, moment = shaft_load(loads, shaft)
    weight = 2e4 * 9.81
    assert force.force[0] == pytest.approx([50e3, -1300e3 - weight, 700e3], rel=1e-3)
    # About X0 (horizontal): Z of the hub is −1.9 m, of the weight 2.4 − 1.9 m.
    assert moment[0, 0] == pytest.approx(-700e3 + 1.9 * -1300e3 + 0.5 * weight, rel=1e-3)
    assert moment[0, 1] == pytest.approx(200e3 - 1.9 * 50e3)


@pytest.mark.parametrize(
    ("change", "reported"),
    [
        ({"front_to_rear": None}, "two-bearings, and front_to_rear is missing"),
        ({"locating": "rear"}, "the mount is two-bearings, which has no locating"),
        ({"bearing_to_gearbox": 3.0}, "two-bearings, on which bearing_to_gearbox does not count"),
    ],
)
def test_keys_of_other_mounts_are_refused(change, reported):
    with pytest.raises(InputError) as caught:
        Drivetrain(**PAIR | change)
    assert reported in str(caught.value)


def test_bearings_without_moments_are_refused_on_a_mount_of_two_that_carry_them():
    loads = constant([700e3, 0.0, -1300e3])
    with pytest.raises(InputError, match="the mount is two-bearings"):
        support_loads(loads, Drivetrain(**PAIR))
    with pytest.raises(InputError, match="carries no moment, and drivetrain.mount is two-bearings"):
        Case(
            bearing=Bearing.read("skf-240-600-bc"),
            lubricant=Lubricant.read("vg460-pao"),
            temperature=308.15,
            loads=loads,
            drivetrain=Drivetrain(**PAIR),
        )
