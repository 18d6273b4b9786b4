"""A moment-carrying front main bearing: equilibrium, an elastic solution, and the seats of a 5 MW turbine."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip import HubLoads
from macroslip.errors import InputError
from macroslip.loads import Drivetrain, front_moment, main_bearing_load, support_loads

component = st.floats(-1e6, 1e6)
vector = st.tuples(component, component, component)
mounts = st.builds(
    lambda h, b, tilt, mass, part, share, locating: Drivetrain(
        mount="four-point",
        hub_to_bearing=h,
        front_to_rear=b,
        locating=locating,
        bearing="rear",
        front="moment-carrying",
        front_moment_share=share,
        tilt=tilt,
        shaft_mass=mass,
        shaft_mass_station=part * (h + b),
    ),
    st.floats(0.0, 5.0),
    st.floats(0.5, 5.0),
    st.floats(-0.2, 0.2),
    st.floats(0.0, 2e5),
    st.floats(0.0, 1.5),
    st.floats(0.0, 0.99),
    st.sampled_from(["front", "rear"]),
)
#: The published rear seat behind a pair of tapered roller bearings, shaft and generator on the shaft.
REAR = {
    "mount": "four-point",
    "hub_to_bearing": 0.65,
    "front_to_rear": 2.0,
    "locating": "front",
    "bearing": "rear",
    "front": "moment-carrying",
    "shaft_mass": 159.5e3,
    "shaft_mass_station": 1.5,
}
THREE_POINT = Drivetrain(
    hub_to_bearing=1.912, bearing_to_gearbox=3.107, shaft_mass=16.5e3, shaft_mass_station=2.0
)
#: Steady loads at rated wind [N], [N m]: force and moment at the hub.
RATED = ([780.6e3, -7.3e3, -1081.7e3], [3903e3, 977e3, 578e3])
#: By wind [m/s]: mean y, z [kN], mean, standard deviation and largest radial load [kN], share of the
#: time below 186 kN [%], of the rear bearing; mean radial and mean axial load of the front [kN].
SEATS = {
    4: (2, -197, 306, 156, 847, 25.7, 2445, 346),
    6: (-3, -387, 635, 299, 1845, 6.1, 2288, 468),
    8: (162, -499, 735, 365, 2127, 4.4, 2188, 614),
    10: (309, -749, 1016, 472, 2610, 1.9, 1999, 784),
    12: (308, -778, 1154, 554, 3170, 1.5, 2020, 810),
    14: (186, -917, 1157, 549, 3260, 1.8, 1848, 702),
    16: (239, -1128, 1455, 681, 3957, 0.8, 1763, 627),
    18: (222, -1149, 1464, 681, 3912, 1.2, 1722, 578),
    20: (97, -1330, 1544, 658, 4260, 0.8, 1521, 545),
    22: (124, -1403, 1719, 733, 4283, 0.6, 1567, 519),
    24: (44, -1495, 1756, 795, 4452, 0.7, 1500, 504),
}
#: By wind [m/s], three-point mount: mean y, z, mean, standard deviation, smallest and largest radial
#: load, mean and standard deviation of the axial load, mean radial load of the gearbox support [kN].
ONE_BEARING = {
    4: (-2, -1967, 1971, 124, 1553, 2332, 224, 31, 744),
    6: (-2, -1844, 1866, 249, 949, 2645, 346, 68, 675),
    8: (-110, -1776, 1802, 291, 924, 2914, 492, 106, 629),
    10: (-208, -1621, 1673, 335, 509, 3216, 662, 93, 594),
    12: (-209, -1602, 1678, 421, 362, 3118, 688, 107, 676),
    14: (-139, -1509, 1569, 389, 175, 2997, 579, 112, 572),
    16: (-181, -1373, 1487, 479, 50, 3300, 505, 101, 659),
    18: (-174, -1356, 1460, 508, 22, 3317, 455, 86, 661),
    20: (-104, -1232, 1328, 453, 21, 2948, 423, 68, 586),
    22: (-127, -1183, 1327, 542, 11, 3394, 396, 63, 715),
    24: (-84, -1118, 1269, 528, 12, 3762, 381, 62, 701),
}


def _applied(force, moment, mount, about):
    """Sum of forces [N] and of moments [N m] of rotor and shaft about a point of the shaft, axes x, y, z."""
    weight = mount.shaft_mass * 9.81
    shaft = weight * np.array([math.sin(mount.tilt), 0.0, -math.cos(mount.tilt)])
    turned = (
        np.array(moment)
        + np.cross([-about, 0.0, 0.0], force)
        + np.cross([mount.shaft_mass_station - about, 0.0, 0.0], shaft)
    )
    return np.array(force) + shaft, turned


@given(vector, vector, mounts)
def test_loads_of_both_bearings_and_the_moment_hold_the_shaft(force, moment, mount):
    hub = HubLoads.constant(force, moment, 2.0, 1.0)
    supports = support_loads(hub, mount)
    # (X0, Y0, Z0) = (y, z, x)
    front, rear = (supports[name][0][[2, 0, 1]] for name in ("front", "rear"))
    held = front_moment(hub, mount)[0][[2, 0, 1]]
    total, turned = _applied(force, moment, mount, mount.hub_to_bearing)
    assert front + rear == pytest.approx(total, rel=1e-11, abs=1e-5)
    reaction = held + np.cross([mount.front_to_rear, 0.0, 0.0], rear)
    # The gearbox takes the torque.
    assert reaction[1:] == pytest.approx(turned[1:], rel=1e-10, abs=1e-4)


@given(vector, vector, mounts)
def test_loads_are_those_of_a_stiff_shaft_on_springs(force, moment, mount):
    """Displacement and tilt of the shaft from a stiffness matrix, with a front stiff across the shaft."""
    b, share = mount.front_to_rear, mount.front_moment_share
    rear_stiffness = 3e9
    tilting = share / (1.0 - share) * rear_stiffness * b**2
    stiff = 1e7 * max(rear_stiffness, tilting / b**2)
    matrix = np.array(
        [
            [stiff + rear_stiffness, rear_stiffness * b],
            [rear_stiffness * b, rear_stiffness * b**2 + tilting],
        ]
    )
    total, turned = _applied(force, moment, mount, mount.hub_to_bearing)
    rear = support_loads(HubLoads.constant(force, moment, 2.0, 1.0), mount)["rear"][0]
    # Across the shaft along y and z: a force at +x turns about z in the sense of +y, about −y of +z.
    for loads, load in (((total[1], turned[2]), rear[0]), ((total[2], -turned[1]), rear[1])):
        shift, tilt = np.linalg.solve(matrix, loads)
        assert load == pytest.approx(rear_stiffness * (shift + b * tilt), rel=1e-5, abs=5.0)


def test_without_a_share_it_is_the_mount_of_two_self_aligning_bearings():
    plain = {key: value for key, value in REAR.items() if key != "front"}
    hub = HubLoads.bundled("nrel5-12B").window(0.0, 30.0)
    for name, load in support_loads(hub, Drivetrain(**plain)).items():
        assert np.array_equal(load, support_loads(hub, Drivetrain(**REAR))[name])
    assert not front_moment(hub, Drivetrain(**plain)).any()


def test_a_share_of_the_moment_leaves_the_thrust_and_relieves_the_rear_bearing():
    hub = HubLoads.constant(*RATED, 1.246, 1.0)
    full = support_loads(hub, Drivetrain(**REAR))
    part = support_loads(hub, Drivetrain(**REAR, front_moment_share=0.25))
    assert part["rear"][0] == pytest.approx(0.75 * full["rear"][0])
    assert part["front"][0, 2] == full["front"][0, 2] and part["rear"][0, 2] == 0.0


def test_rear_bearing_of_the_5_mw_turbine_at_rated_wind():
    supports = support_loads(HubLoads.constant(*RATED, 1.246, 1.0), Drivetrain(**REAR))
    front, rear = supports["front"][0] / 1e3, supports["rear"][0] / 1e3
    assert rear == pytest.approx([291.0, -799.0, 0.0], abs=0.6)
    # Published as means of the radial loads over a revolution, 0.3 % above the radial load of the means.
    assert np.hypot(*rear[:2]) == pytest.approx(853.0, rel=4e-3)
    assert (np.hypot(*front[:2]), front[2]) == pytest.approx((1867.0, 917.0), rel=2e-3)


def test_what_makes_the_load_of_the_rear_bearing_of_the_5_mw_turbine():
    """Rotor weight lifts it, shaft and generator press it down, and it holds half of the tilting moment."""

    def rear(force, moment, mass):
        mount = Drivetrain(**REAR | {"shaft_mass": mass})
        hub = HubLoads.constant(force, moment, 1.246, 1.0)
        return main_bearing_load(hub, mount).force[0, 1] / 1e3

    assert rear([0.0, 0.0, -1074.56e3], [0.0, 0.0, 0.0], 0.0) == pytest.approx(349.2, abs=0.1)
    assert rear([0.0, 0.0, 0.0], [0.0, 0.0, 0.0], 159.5e3) == pytest.approx(-662.5, abs=0.1)
    assert rear([0.0, 0.0, 0.0], [0.0, 977e3, 0.0], 0.0) == pytest.approx(-488.5, abs=0.1)


@pytest.mark.parametrize("wind", SEATS)
def test_rear_bearing_of_the_5_mw_turbine_in_turbulent_wind(wind):
    supports = support_loads(HubLoads.bundled(f"nrel5-{wind}B"), Drivetrain(**REAR))
    rear, front = supports["rear"] / 1e3, supports["front"] / 1e3
    radial = np.hypot(rear[:, 0], rear[:, 1])
    reactions = (
        *rear[:, :2].mean(axis=0), radial.mean(), radial.std(), radial.max(), 100 * (radial < 186).mean(),
        np.hypot(front[:, 0], front[:, 1]).mean(), front[:, 2].mean(),
    )  # fmt: skip
    assert reactions == pytest.approx(SEATS[wind], rel=4e-3, abs=1.0)
    assert not rear[:, 2].any()


@pytest.mark.parametrize("wind", ONE_BEARING)
def test_one_bearing_of_the_5_mw_turbine_in_turbulent_wind(wind):
    supports = support_loads(HubLoads.bundled(f"nrel5-{wind}B"), THREE_POINT)
    load, gearbox = supports["bearing"] / 1e3, supports["gearbox"] / 1e3
    radial = np.hypot(load[:, 0], load[:, 1])
    reactions = (
        *load[:, :2].mean(axis=0), radial.mean(), radial.std(), radial.min(), radial.max(),
        load[:, 2].mean(), load[:, 2].std(), np.hypot(gearbox[:, 0], gearbox[:, 1]).mean(),
    )  # fmt: skip
    # The smallest load is a single sample beside zero, which 20 Hz meets less often than 50 Hz.
    assert reactions == pytest.approx(ONE_BEARING[wind], rel=4e-3, abs=12.0)
    assert reactions[2:4] == pytest.approx(ONE_BEARING[wind][2:4], rel=4e-3, abs=1.0)


def test_one_bearing_of_the_5_mw_turbine_at_rated_wind():
    load = main_bearing_load(HubLoads.constant(*RATED, 1.246, 1.0), THREE_POINT).force[0] / 1e3
    assert (np.hypot(*load[:2]), load[2]) == pytest.approx((1602.0, 795.0), abs=0.6)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"bearing": "front"}, ["moment-carrying, and it is to be simulated", "bearing: rear"]),
        ({"front": "self-aligning", "front_moment_share": 0.1}, ["front_moment_share is given"]),
        ({"front_moment_share": 1.0}, ["front_moment_share: it is 1.0", "0 to below 1"]),
        ({"front": "stiff"}, ["'stiff' does not exist. Allowed: self-aligning, moment-carrying"]),
    ],
)
def test_fronts_that_cannot_be(changes, words):
    with pytest.raises(InputError) as caught:
        Drivetrain(**REAR | changes)
    for word in ["drivetrain", *words]:
        assert word in str(caught.value)


def test_a_three_point_mount_has_no_front():
    with pytest.raises(InputError, match="three-point, which has no front"):
        Drivetrain(front="moment-carrying")
