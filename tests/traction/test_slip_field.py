"""Slip over a contact against rigid-body kinematics in space, and the lines of pure rolling in it."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from macroslip.bearing import Bearing, geometry
from macroslip.lubricant import Lubricant
from macroslip.mechanisms import Laws
from macroslip.roller.contact_force import slip_field
from macroslip.roller.model import roller_model
from macroslip.traction.slip_field import SlipField, graded_rule, rolling_lines, slip_at

BEARING, OIL = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
RADIUS, PITCH, ALPHA = 0.035, 0.3727, math.radians(11.2)
ROLLER_CONTOUR, RACEWAY_CONTOUR = 0.98 * 0.4149, 0.4149
RATED = 20.463 * 2 * math.pi / 60
rows = pytest.mark.parametrize("sign", [1, -1], ids=["downwind", "upwind"])
speeds = pytest.mark.parametrize("speed", [RATED, -RATED], ids=["ahead", "back"])


@pytest.fixture(scope="module")
def models():
    return {sign: roller_model(BEARING, OIL, sign, tilt=0.0, laws=Laws.physical()) for sign in (1, -1)}


def contact_point(sign, place, ring, station):
    """Place of the contact at a station in the bearing frame, and the roller's axis, for a roller at angle `place`."""
    axial = np.array([0.0, 0.0, 1.0])
    outward = np.array([math.cos(place), math.sin(place), 0.0])
    tilt = sign * ALPHA
    # Primed axes: turned by the contact angle about x = y × z.
    normal = math.cos(tilt) * outward + math.sin(tilt) * axial
    axis = -math.sin(tilt) * outward + math.cos(tilt) * axial
    drop = 0.5 * station**2 * 0.5 * (1 / ROLLER_CONTOUR + 1 / RACEWAY_CONTOUR)
    side = 1.0 if ring == "outer" else -1.0
    return PITCH * outward + station * axis + side * (RADIUS - drop) * normal, axis, outward


def relative_velocity(sign, ring, station, shaft_speed, spin, place=0.7):
    """Velocity of the ring's surface relative to the roller's, along the roller's own surface motion for ω > 0 [m/s].

    In the frame that orbits with the roller its axis is at rest and it turns with ω about it; the rings turn about Z0.
    """
    orbital = shaft_speed * geometry.inner_contact_radius(BEARING) / (2 * PITCH)
    point, axis, outward = contact_point(sign, place, ring, station)
    of_ring = (shaft_speed if ring == "inner" else 0.0) - orbital
    ring_velocity = np.cross([0.0, 0.0, of_ring], point)
    roller_velocity = np.cross(spin * axis, point - PITCH * outward)
    tangential = np.cross(outward, [0.0, 0.0, 1.0])
    difference = ring_velocity - roller_velocity
    # Both surfaces move along x only.
    assert np.abs(difference - (difference @ tangential) * tangential).max() < 1e-15
    direction = np.cross(axis, point - PITCH * outward) @ tangential
    return float(difference @ tangential) * math.copysign(1.0, direction)


@rows
@speeds
@pytest.mark.parametrize("ring", ["inner", "outer"])
@pytest.mark.parametrize("skid", [0.0, 0.004, -0.2])
def test_slip_is_that_of_rigid_bodies(models, sign, speed, ring, skid):
    orbital = speed * geometry.inner_contact_radius(BEARING) / (2 * PITCH)
    ring_speed = -orbital * geometry.outer_contact_radius(BEARING)
    # Δu = u2 − u1 with u1 = ω r.
    spin = (ring_speed - skid) / RADIUS
    shape = getattr(models[sign], ring).shape
    field = slip_field(shape, skid, ring_speed)
    for station in np.linspace(-0.053, 0.053, 9):
        exact = relative_velocity(sign, ring, station, speed, spin)
        assert slip_at(field, shape.contour_radius, station) == pytest.approx(exact, abs=1e-14), station
    # The terms by themselves, with the sign of ζ that goes with the axis z'.
    of_ring = speed - orbital if ring == "inner" else -orbital
    bracket = spin - of_ring * math.cos(ALPHA)
    assert field.curvature_rate == pytest.approx(bracket, rel=1e-12)
    past = of_ring if ring == "inner" else -of_ring
    assert field.spin_rate == pytest.approx(-past * sign * math.sin(ALPHA), rel=1e-12)


@rows
@pytest.mark.parametrize("ring", ["inner", "outer"])
def test_reversal_and_the_other_row_are_mirror_images(models, sign, ring):
    shape, other = (getattr(models[s], ring).shape for s in (sign, -sign))
    field = slip_field(shape, 0.003, -0.39)
    back = slip_field(shape, -0.003, 0.39)
    mirror = slip_field(other, 0.003, -0.39)
    for station in (-0.05, -0.01, 0.02, 0.04):
        here = slip_at(field, shape.contour_radius, station)
        assert slip_at(back, shape.contour_radius, station) == pytest.approx(-here, rel=1e-14)
        assert slip_at(mirror, shape.contour_radius, -station) == pytest.approx(here, rel=1e-14)


def test_field_changes_with_slip_as_it_says(models):
    for shape in (models[1].inner.shape, models[1].outer.shape):
        low, high = (slip_field(shape, slip, -0.39) for slip in (0.001, 0.002))
        assert (high.curvature_rate - low.curvature_rate) / 0.001 == pytest.approx(low.curvature_slope, rel=1e-9)
        assert low.curvature_slope == pytest.approx(-1 / RADIUS, rel=1e-12)
        assert high.spin_rate == low.spin_rate


def test_contact_without_microslip_slips_alike():
    model = roller_model(BEARING, OIL, 1, tilt=0.0, laws=Laws.physical().but(microslip=False))
    for shape in (model.inner.shape, model.outer.shape, model.cage.shape):
        field = slip_field(shape, 0.02, -0.39)
        assert [slip_at(field, shape.contour_radius, z) for z in (-0.05, 0.0, 0.05)] == [0.02] * 3


HALF, CONTOUR = 0.03, 0.41


def speeds_up_to(largest):
    return st.floats(-largest, largest).map(lambda x: round(x, 12))


fields = st.builds(
    SlipField, speeds_up_to(0.05), speeds_up_to(30.0), speeds_up_to(0.6), st.sampled_from([0.0, -1 / RADIUS])
)


@given(fields)
@settings(max_examples=200, deadline=None)
def test_lines_are_the_places_where_slip_changes_sign(field):
    lines = rolling_lines(field, CONTOUR, HALF)
    assert -HALF <= lines.first <= lines.second <= HALF
    grid = np.linspace(-HALF, HALF, 20001)
    slip = slip_at.py_func(field, CONTOUR, grid)
    scale = abs(field.sliding) + abs(field.curvature_rate) * HALF**2 / (2 * CONTOUR) + abs(field.spin_rate) * HALF
    turns = grid[np.flatnonzero(np.diff(np.sign(slip)) != 0)]
    # Every change of sign has its line, and every line within the contact is a zero or slip's extremum.
    for turn in turns:
        near = min((lines.first, lines.second), key=lambda line: abs(line - turn))
        assert abs(near - turn) <= 2.1 * (grid[1] - grid[0])
    for line in (lines.first, lines.second):
        if abs(line) < HALF:
            value = slip_at(field, CONTOUR, line)
            slope = field.curvature_rate * line / CONTOUR - field.spin_rate
            assert abs(value) <= 1e-12 * scale or (
                lines.first == lines.second and abs(slope) <= 1e-9 * (1 + abs(slope))
            )
    # Between the ends and the lines slip keeps its sign.
    for left, right in ((-HALF, lines.first), (lines.first, lines.second), (lines.second, HALF)):
        if right - left > 1e-6:
            inside = slip_at.py_func(field, CONTOUR, np.linspace(left + 1e-9, right - 1e-9, 50))
            assert inside.min() >= -1e-9 * scale or inside.max() <= 1e-9 * scale


def test_lines_move_steadily_as_they_enter_merge_and_vanish():
    """From sliding far behind to far ahead the lines come in from the ends, meet, and stay together."""
    slides = np.linspace(-0.02, 0.02, 8001)
    for spin in (0.0, 0.05, 0.25, -0.25, 2.0):
        for curvature in (-12.0, 12.0, -1e-6):
            found = np.array([rolling_lines(SlipField(v, curvature, spin, 0.0), CONTOUR, HALF)[:2] for v in slides])
            steps = np.abs(np.diff(found, axis=0))
            # Near merging a line goes with the root of the distance from it.
            bound = 1.001 * math.sqrt(8.0 * CONTOUR / max(abs(curvature), 1e-3) * (slides[1] - slides[0]))
            if abs(curvature) > 1e-3:
                assert steps.max() <= bound, (spin, curvature)
            assert found.min() >= -HALF and found.max() <= HALF


@given(fields)
@settings(max_examples=300, deadline=None)
def test_movement_of_lines_is_their_difference(field):
    step = 1e-7

    def moved(change):
        return rolling_lines(
            field._replace(
                sliding=field.sliding + change, curvature_rate=field.curvature_rate + field.curvature_slope * change
            ),
            CONTOUR,
            HALF,
        )

    lines, ahead, behind = moved(0.0), moved(step), moved(-step)
    # Lines about to merge, or at the ends, have one-sided derivatives only; one at infinity may change sides; where slip
    # has no zero the division at its extremum has no bearing on the integral.
    bend = 0.5 * field.curvature_rate / CONTOUR
    assume(abs(bend) > 1e-3 and lines.first < lines.second)
    assume(
        abs(field.spin_rate**2 - 4.0 * bend * field.sliding)
        > 1e-3 * (abs(field.spin_rate) + abs(bend) * HALF) ** 2 + 1e-5
    )
    for name in ("first", "second"):
        here = getattr(lines, name)
        if min(abs(abs(getattr(x, name)) - HALF) for x in (lines, ahead, behind)) < 1e-5 and abs(here) < HALF:
            continue
        difference = (getattr(ahead, name) - getattr(behind, name)) / (2.0 * step)
        assert getattr(lines, f"{name}_by_slip") == pytest.approx(difference, rel=1e-3, abs=1e-4)


@pytest.mark.parametrize("nodes", [10, 40])
def test_rule_integrates_over_the_unit_interval(nodes):
    m, weights = graded_rule(nodes)
    assert np.all((m > 0) & (m < 1)) and np.all(weights > 0)
    for power in range(6):
        assert weights @ m**power == pytest.approx(1.0 / (power + 1), rel=1e-13)
    # Graded: the root at the end of an ellipse is nearly smooth.
    assert weights @ np.sqrt(m * (1.0 - m)) == pytest.approx(math.pi / 8, rel=1e-3 if nodes == 10 else 1e-6)
