"""Slip over a contact against rigid-body kinematics in space, and the lines of pure rolling in it."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from macroslip.bearing import Bearing, geometry
from macroslip.laws import Laws
from macroslip.lubricant import Lubricant
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
    assert field.spin_rate == pytest.approx(-of_ring * sign * math.sin(ALPHA), rel=1e-12) if ring == "inner" else True
    if ring == "outer":
        assert field.spin_rate == pytest.approx(-orbital * sign * math.sin(ALPHA), rel=1e-12)
        assert field.curvature_rate == pytest.approx(spin + orbital * math.cos(ALPHA), rel=1e-12)
