"""Geometry and kinematics of tapered rollers against vectors, closed forms and published pages."""

import math

import numpy as np
import pytest

from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.errors import InputError

MAIN = TaperedBearing.read("tdo-main-bearing")
SMALL = TaperedBearing.read("32216-pair")
BEARINGS = pytest.mark.parametrize("bearing", [MAIN, SMALL], ids=lambda bearing: bearing.name)


class Vectors:
    """Rigid bodies of a row with s = +1, apex at the origin of (R, Z), in the plane φ = 0.

    The apex lies downwind of the roller: a point at distance d from it along a line of half-angle a
    has R = d sin a and Z = −d cos a. Axes are X0 = radial, Y0 and Z0.
    """

    def __init__(self, bearing):
        self.row = tapered_geometry(bearing)
        self.ring_speed = 1.7
        speed = self.ring_speed
        row = self.row
        self.orbit = np.array([0.0, 0.0, row.orbit_ratio * speed])
        # The roller's axis points from its large to its small end, to the apex.
        axis = np.array([-math.sin(row.axis_angle), 0.0, math.cos(row.axis_angle)])
        self.roller = self.orbit - row.spin_ratio * speed * axis
        self.ring = np.array([0.0, 0.0, speed])

    def on_line(self, angle, distance):
        """A point at a distance from the apex on a line of contact."""
        return distance * np.array([math.sin(angle), 0.0, -math.cos(angle)])

    def rib_point(self):
        """The rib contact, from the roller's axis and the sphere."""
        row = self.row
        along = row.apex_distance + row.rib_station
        middle = self.on_line(row.axis_angle, along)
        inwards = np.array([-math.cos(row.axis_angle), 0.0, -math.sin(row.axis_angle)])
        return middle + row.rib_radius_on_roller * inwards


@BEARINGS
def test_nothing_slides_anywhere_on_the_lines_of_contact(bearing):
    """All bodies turn about axes through the apex, so velocities there are ω × place."""
    bodies = Vectors(bearing)
    for distance in np.linspace(0.7, 1.3, 7) * bodies.row.apex_distance:
        inner = bodies.on_line(bodies.row.inner_angle, distance)
        outer = bodies.on_line(bodies.row.outer_angle, distance)
        scale = np.linalg.norm(np.cross(bodies.ring, inner))
        assert np.cross(bodies.roller - bodies.ring, inner) == pytest.approx(0.0, abs=1e-12 * scale)
        assert np.cross(bodies.roller, outer) == pytest.approx(0.0, abs=1e-12 * scale)


@BEARINGS
def test_the_turning_rate_about_the_inner_line_is_that_of_the_relative_angular_velocity(bearing):
    bodies = Vectors(bearing)
    speed = bodies.ring_speed
    inner = np.linalg.norm(bodies.roller - bodies.ring)
    assert inner == pytest.approx(bodies.row.inner_rolling_ratio * speed, rel=1e-12)


@BEARINGS
def test_the_rib_slides_with_the_turning_rate_times_its_height_above_the_line(bearing):
    bodies = Vectors(bearing)
    contact = bodies.rib_point()
    sliding = np.cross(bodies.roller - bodies.ring, contact)
    expected = bodies.row.rib_sliding_speed(bodies.ring_speed)
    assert np.linalg.norm(sliding) == pytest.approx(expected, rel=1e-10)
    line = bodies.on_line(bodies.row.inner_angle, 1.0)
    height = np.linalg.norm(np.cross(contact, line))
    assert height == pytest.approx(bearing.rib_contact_height, rel=1e-10)
    relative = [
        np.linalg.norm(np.cross(body - bodies.orbit, contact))
        for body in (bodies.roller, bodies.ring)
    ]
    assert np.mean(relative) == pytest.approx(
        bodies.row.rib_entrainment_speed(bodies.ring_speed), rel=1e-10
    )


@BEARINGS
def test_the_rib_contact_lies_on_the_sphere_of_the_large_end(bearing):
    row = tapered_geometry(bearing)
    along = row.apex_distance + row.rib_station - row.sphere_distance
    assert math.hypot(along, row.rib_radius_on_roller) == pytest.approx(
        row.sphere_radius, rel=1e-12
    )
    assert row.sphere_distance + row.sphere_radius == pytest.approx(
        row.apex_distance + row.roller_length / 2.0, rel=1e-12
    )


def test_the_main_bearing_has_the_numbers_of_an_independent_program():
    row = tapered_geometry(MAIN)
    speed = 12.0 * 2.0 * math.pi / 60.0
    assert math.degrees(row.half_cone_angle) == pytest.approx(2.1857, abs=1e-4)
    assert math.degrees(row.rib_angle) == pytest.approx(2.182, abs=1e-3)
    assert row.rib_radius == pytest.approx(0.38435, abs=1e-5)
    places = np.array([-0.5, 0.0, 0.5]) * MAIN.roller_length
    assert row.surface_speed(speed, places) == pytest.approx([0.22424, 0.24005, 0.25586], abs=1e-5)
    assert row.rib_sliding_speed(speed) == pytest.approx(0.04171, abs=1e-5)
    assert row.inner_rolling_ratio * speed == pytest.approx(8.3428, abs=1e-4)
    assert row.spin_ratio * speed == pytest.approx(7.7437, abs=1e-4)


def test_the_small_bearing_has_its_load_centre_where_the_maker_says():
    """The catalogue has a = 30 mm; the roller's middle is 14.5 mm from the face it counts from."""
    row = tapered_geometry(SMALL)
    assert row.load_centre == pytest.approx(0.0155, abs=1e-4)
    assert row.orbit_ratio == pytest.approx(0.423837, abs=1e-6)
    assert row.rib_sliding_speed(2000.0 * 2.0 * math.pi / 60.0) == pytest.approx(0.9248, abs=1e-4)


def test_a_warmer_inner_ring_takes_up_play_by_the_growth_to_the_apex():
    row = tapered_geometry(MAIN)
    for arrangement, expected in (("O", 15.1e-6), ("X", 19.2e-6)):
        change = row.preload_per_kelvin(12e-6, MAIN.row_offset, arrangement)
        assert change == pytest.approx(expected, abs=0.05e-6)
    to_apex = row.apex_distance * math.cos(row.axis_angle)
    assert row.preload_per_kelvin(12e-6, to_apex, "O") == pytest.approx(0.0, abs=1e-18)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"rollers_per_row": 60}, "do not fit"),
        ({"row_offset": 0.02}, "overlap"),
        ({"roller_length": 0.4}, "times roller_diameter"),
        ({"rib_contact_height": 0.06}, "above the middle"),
        ({"inner_angle": math.radians(27.0)}, "share no apex.*asks for 0.454284 rad"),
    ],
)
def test_what_cannot_be_built_is_refused_with_the_key(change, words):
    with pytest.raises(InputError, match=words):
        MAIN.replace(**change)


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("osculation: 0.97", "line 2: .*has no osculation: its rollers touch along lines.*Remove"),
        ("osculation_outer: 0.97", "line 2: .*has no osculation_outer: .*preload in place of"),
        ("diametral_clearance: 0.1 mm", "line 2: .*has no diametral_clearance"),
        (
            "skew: 3 mrad",
            "line 2: skew is no property of a tapered.*rib.*not computed.*Remove skew",
        ),
    ],
)
def test_keys_that_other_kinds_have_are_refused_in_a_sentence(tmp_path, line, words):
    path = tmp_path / "own.yaml"
    path.write_text(f"kind: tapered\n{line}\n", encoding="utf-8")
    with pytest.raises(InputError, match=words):
        TaperedBearing.read(path)


def test_the_angle_of_the_inner_raceway_may_be_written_where_it_shares_the_apex():
    inner = tapered_geometry(MAIN).inner_angle
    assert MAIN.replace(inner_angle=inner).inner_angle == inner
