"""Statics of the shaft against an independent solution of the whole free body, and its exact limits."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip.errors import InputError
from macroslip.loads import Drivetrain, HubLoads, main_bearing_load, support_loads

component = st.floats(-1e6, 1e6)
vector = st.tuples(component, component, component)
drivetrains = st.builds(
    lambda h, g, tilt, mass, part: Drivetrain(
        hub_to_bearing=h,
        bearing_to_gearbox=g,
        tilt=tilt,
        shaft_mass=mass,
        shaft_mass_station=part * (h + g),
    ),
    st.floats(0.0, 5.0),
    st.floats(0.5, 5.0),
    st.floats(-0.2, 0.2),
    st.floats(0.0, 2e4),
    st.floats(0.0, 1.0),
)
four_points = st.builds(
    lambda base, part, locating: replace(
        base,
        mount="four-point",
        front_to_rear=base.bearing_to_gearbox,
        bearing_to_gearbox=2.2,
        locating=locating,
        bearing="front",
        shaft_mass_station=part * (base.hub_to_bearing + base.bearing_to_gearbox),
    ),
    drivetrains,
    st.floats(0.0, 1.5),
    st.sampled_from(["front", "rear"]),
)


def _load(force, moment, drivetrain):
    return main_bearing_load(HubLoads.constant(force, moment, 2.0, 1.0), drivetrain).force[0]


def _solve_free_body(force, moment, drivetrain):
    """Forces of both supports on the shaft, from its 6 x 6 equilibrium about the hub with the gearbox's torque."""
    h = drivetrain.hub_to_bearing
    a = h + (drivetrain.front_to_rear or drivetrain.bearing_to_gearbox)
    w = (
        drivetrain.shaft_mass
        * 9.81
        * np.array([math.sin(drivetrain.tilt), 0, -math.cos(drivetrain.tilt)])
    )
    thrust_at = a if drivetrain.locating == "rear" else h
    matrix = np.zeros((6, 6))
    for i, (x, axis) in enumerate([(thrust_at, 0), (h, 1), (h, 2), (a, 1), (a, 2)]):
        matrix[:3, i], matrix[3:, i] = np.eye(3)[axis], np.cross([x, 0, 0], np.eye(3)[axis])
    matrix[3, 5] = 1.0
    applied = np.concatenate(
        [np.add(force, w), moment + np.cross([drivetrain.shaft_mass_station, 0, 0], w)]
    )
    r = np.linalg.solve(matrix, -applied)
    first, second = np.array([0.0, r[1], r[2]]), np.array([0.0, r[3], r[4]])
    (second if thrust_at == a else first)[0] = r[0]
    return first, second


@given(vector, vector, drivetrains | four_points)
def test_loads_equal_the_free_body_solution(force, moment, drivetrain):
    first, second = _solve_free_body(force, moment, drivetrain)
    supports = support_loads(HubLoads.constant(force, moment, 2.0, 1.0), drivetrain)
    for reaction, load in zip((first, second), supports.values(), strict=True):
        expected = -reaction[
            [1, 2, 0]
        ]  # (X0, Y0, Z0) = (y, z, x), and the load on the ring opposes its reaction
        assert load[0] == pytest.approx(expected, rel=1e-11, abs=1e-5)
    assert _load(force, moment, drivetrain) == pytest.approx(-first[[1, 2, 0]], rel=1e-11, abs=1e-5)


@given(
    st.floats(-1e5, 1e5),
    st.floats(-1e5, 1e5),
    st.floats(0.1, 5.0),
    st.floats(0.5, 5.0),
    st.floats(0.05, 1.0),
)
def test_a_moment_and_its_couple_give_the_same_reaction(my, mz, h, g, part):
    """A couple: a force at the hub and its opposite at x = d, which is the hub of a shaft shorter by d."""
    d = part * h
    force = np.array([0, -mz / d, my / d])  # about any point, the couple has the moment (0, my, mz)
    couple = _load(force, [0, 0, 0], Drivetrain(hub_to_bearing=h, bearing_to_gearbox=g)) + _load(
        -force, [0, 0, 0], Drivetrain(hub_to_bearing=h - d, bearing_to_gearbox=g)
    )
    moment = _load([0, 0, 0], [0, my, mz], Drivetrain(hub_to_bearing=h, bearing_to_gearbox=g))
    assert couple == pytest.approx(
        moment, rel=1e-9, abs=1e-9 * np.abs(force).max() * (h + g) / g + 1e-9
    )


@given(vector, vector, drivetrains)
def test_mirror_symmetry(force, moment, drivetrain):
    """Mirrored in the vertical plane of the shaft: y of a force changes sign, and x and z of a moment."""
    plain = _load(force, moment, drivetrain)
    mirrored = _load(np.multiply(force, [1, -1, 1]), np.multiply(moment, [-1, 1, -1]), drivetrain)
    assert mirrored == pytest.approx(plain * [-1, 1, 1], rel=1e-12, abs=1e-6)


@given(st.floats(0.0, 5.0), st.floats(0.5, 5.0), st.floats(-0.3, 0.3), st.floats(1.0, 2e4))
def test_mass_at_the_bearing_is_carried_there(h, g, tilt, mass):
    drivetrain = Drivetrain(
        hub_to_bearing=h, bearing_to_gearbox=g, tilt=tilt, shaft_mass=mass, shaft_mass_station=h
    )
    load = _load([0, 0, 0], [0, 0, 0], drivetrain)
    assert load == pytest.approx(
        [0, -mass * 9.81 * math.cos(tilt), mass * 9.81 * math.sin(tilt)], rel=1e-12, abs=1e-9
    )


def test_mass_at_the_gearbox_leaves_only_its_axial_part_and_at_the_hub_acts_as_rotor_weight():
    weight = 4000 * 9.81
    base = Drivetrain(shaft_mass=4000.0, shaft_mass_station=1.26 + 2.2)
    assert _load([0, 0, 0], [0, 0, 0], base) == pytest.approx(
        [0, 0, weight * math.sin(base.tilt)], abs=1e-6
    )
    rotor = [weight * math.sin(base.tilt), 0, -weight * math.cos(base.tilt)]
    assert _load([0, 0, 0], [0, 0, 0], replace(base, shaft_mass_station=0.0)) == pytest.approx(
        _load(rotor, [0, 0, 0], Drivetrain())
    )


def test_signs_of_the_main_terms():
    assert _load([1e5, 0, 0], [0, 0, 0], Drivetrain()) == pytest.approx([0, 0, 1e5])  # thrust
    assert _load([0, 0, -1e5], [0, 0, 0], Drivetrain()) == pytest.approx(
        [0, -1e5 * 3.46 / 2.2, 0]
    )  # overhung weight
    assert _load([0, 0, 0], [0, 2.2e5, 0], Drivetrain()) == pytest.approx(
        [0, 1e5, 0]
    )  # thrust on the upper half lifts


def test_torque_does_not_load_the_bearing_and_the_record_is_kept():
    loads = HubLoads.bundled("12C").window(10.0, 20.0)
    bearing = main_bearing_load(loads, Drivetrain())
    other = HubLoads(loads.time, loads.shaft_speed, loads.force, loads.moment * [5, 1, 1], "x")
    assert np.array_equal(main_bearing_load(other, Drivetrain()).force, bearing.force)
    assert np.array_equal(bearing.time, loads.time) and np.array_equal(
        bearing.shaft_speed, loads.shaft_speed
    )
    assert bearing.source == "main bearing under bundled case 12C"


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"hub_to_bearing": 1260.0}, ["hub_to_bearing: it is 1260.0", "0 to 20 m", "metres"]),
        ({"hub_to_bearing": -1.0}, ["0 to 20 m", "rotors downwind of the tower are not modelled"]),
        ({"bearing_to_gearbox": 0.0}, ["bearing_to_gearbox: it is 0.0", "above 0"]),
        ({"tilt": 5.0}, ["tilt: it is 5.0", "radians"]),
        ({"shaft_mass": -1.0}, ["shaft_mass: it is -1.0", "0 to 1e6 kg"]),
        ({"shaft_mass_station": 4.0}, ["shaft_mass_station: it is 4.0", "0 to 3.46 m"]),
        ({"tilt": math.nan}, ["tilt: it is nan", "finite"]),
        ({"shaft_mass": "12"}, ["shaft_mass: it is '12'", "finite"]),
        ({"mount": "four-point"}, ["front_to_rear and locating and bearing are missing"]),
        ({"mount": "four-point", "front_to_rear": 1.5, "bearing": "rear"}, ["locating is missing"]),
        ({"front_to_rear": 1.5}, ["three-point, which has no front_to_rear"]),
        (
            {
                "mount": "four-point",
                "front_to_rear": 1.5,
                "bearing": "rear",
                "locating": "rear",
                "bearing_to_gearbox": 2,
            },
            ["four-point, on which bearing_to_gearbox does not count"],
        ),
        ({"mount": "two-point"}, ["'two-point' does not exist. Allowed: three-point, four-point"]),
        (
            {"mount": "four-point", "front_to_rear": 1.5, "bearing": "rear", "locating": "middle"},
            ["'middle' does not exist. Allowed: front, rear"],
        ),
    ],
)
def test_bad_drivetrain(changes, words):
    with pytest.raises(InputError) as caught:
        Drivetrain(**changes)
    for word in ["drivetrain", *words]:
        assert word in str(caught.value)


@given(vector, vector, four_points)
def test_the_bearing_that_is_simulated_is_the_one_asked_for(force, moment, drivetrain):
    loads = HubLoads.constant(force, moment, 2.0, 1.0)
    both = support_loads(loads, drivetrain)
    for name in ("front", "rear"):
        single = main_bearing_load(loads, replace(drivetrain, bearing=name))
        assert np.array_equal(single.force, both[name])
        assert single.source == f"{name} main bearing under constant load"


@given(vector, vector, st.floats(0.0, 3.0), st.floats(0.5, 5.0))
def test_the_front_bearing_with_the_rear_one_in_the_place_of_the_gearbox(force, moment, h, b):
    """Whatever holds the shaft across at the second place, the first support feels the same."""
    three = _load(force, moment, Drivetrain(hub_to_bearing=h, bearing_to_gearbox=b))
    two = Drivetrain(
        mount="four-point", hub_to_bearing=h, front_to_rear=b, locating="front", bearing="front"
    )
    assert np.array_equal(_load(force, moment, two), three)


def test_the_supports_of_a_three_point_mount():
    both = support_loads(HubLoads.constant([1e5, 0, -1e5], [0, 0, 0], 2.0, 1.0), Drivetrain())
    assert both["gearbox"][0] == pytest.approx([0, 1e5 * 1.26 / 2.2, 0])
    assert both["bearing"][0] == pytest.approx([0, -1e5 * 3.46 / 2.2, 1e5])
