"""Ring balance of tapered bearings: any finite load, and the limits of a cylinder and of rotations."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.optimize import root
from scipy.spatial.transform import Rotation

from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.contact.line import logarithmic_profile, palmgren_coefficient, strip_places
from macroslip.ring.tapered import strip_loads, tapered_balance, tapered_ring

MAIN = TaperedBearing.read("tdo-main-bearing")
SMALL = TaperedBearing.read("32216-pair")
L1 = ((50e3, -1300e3, 700e3), (-700e3, 200e3))


def solve(bearing, force, moment, angle=0.0):
    ring = tapered_ring(bearing)
    arrays = (np.atleast_2d(np.asarray(part, dtype=float)) for part in (force, moment))
    return ring, tapered_balance(ring, np.array([angle]), *arrays)


def carried_by_the_outer_ring(ring, balance, bearing, angle):
    """Force and moment of the loads of all outer strips about the bearing's middle."""
    row = tapered_geometry(bearing)
    _, outer = strip_loads(ring, balance, np.array([angle]), 0)
    places = strip_places(bearing.roller_length, outer.shape[1])
    along = (row.apex_distance + places) / math.cos(row.half_cone_angle)
    sine, cosine = math.sin(row.outer_angle), math.cos(row.outer_angle)
    apex = ring.axial_position + ring.sign * row.apex_distance * math.cos(row.axis_angle)
    height = apex[:, None] - ring.sign[:, None] * along * cosine
    phi = ring.angle + ring.orbit_ratio * angle
    outwards = np.stack([np.cos(phi), np.sin(phi), np.zeros_like(phi)], axis=1)
    axial = np.array([0.0, 0.0, 1.0])
    normal = cosine * outwards + sine * ring.sign[:, None] * axial
    point = (along * sine)[None, :, None] * outwards[:, None] + height[:, :, None] * axial
    force = outer[:, :, None] * normal[:, None]
    return force.sum(axis=(0, 1)), np.cross(point, force).sum(axis=(0, 1))


direction = st.tuples(*[st.floats(-1.0, 1.0)] * 3)


@settings(max_examples=25, deadline=None)
@given(
    bearing=st.sampled_from([MAIN, SMALL]),
    arrangement=st.sampled_from(["O", "X"]),
    preload=st.floats(-1e-3, 2e-4),
    magnitude=st.floats(-3.0, 0.0),
    along=direction,
    about=direction,
    angle=st.floats(0.0, 6.0),
)
@example(MAIN, "O", -1e-3, -3.0, (0.0, -1.0, 0.0), (0.0, 0.0, 0.0), 0.0)  # a roller or two carry
@example(MAIN, "O", 2e-4, 0.0, (0.0, 0.0, 1.0), (0.0, 0.0, 0.0), 0.0)  # all of a row do
@example(SMALL, "X", -1e-3, -2.0, (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), 0.3)  # moment alone
def test_every_finite_load_is_balanced_by_the_rollers(
    bearing, arrangement, preload, magnitude, along, about, angle
):
    """From loads that one roller of a row carries to the static rating, with play and preload."""
    bearing = bearing.replace(arrangement=arrangement, preload=preload)
    largest = 16e6 if bearing.name == MAIN.name else 0.3e6
    force = largest * 10.0**magnitude * np.array(along)
    moment = largest * 10.0**magnitude * bearing.pitch_radius * np.array(about[:2])
    ring, balance = solve(bearing, force, moment, angle)
    size = np.linalg.norm(force) + np.linalg.norm(moment) / bearing.pitch_radius
    assert balance.unbalanced[0] <= 1e-7 * size + 1e-4
    assert np.isfinite(balance.displacement).all()
    held, turned = carried_by_the_outer_ring(ring, balance, bearing, angle)
    assert held == pytest.approx(force, abs=3e-5 * size + 0.02)
    assert turned[:2] == pytest.approx(moment, abs=(3e-5 * size + 0.02) * bearing.pitch_radius)


def test_the_lowest_rollers_carry_a_light_load_with_much_play():
    """One of the row that has a roller below the shaft, two of the row half a pitch beside it."""
    _, balance = solve(MAIN.replace(preload=-1e-3), (0.0, -200.0, 0.0), (0.0, 0.0))
    loads = balance.outer_load[0].reshape(2, -1)
    carried = loads > 1e-3 * loads.max()
    assert carried.sum(axis=1).tolist() == [1, 2]
    assert loads[0].argmax() == 0  # at -90 degrees
    assert loads[1][carried[1]] == pytest.approx(loads[1].max(), rel=1e-3)
    assert loads[1].sum() == pytest.approx(loads[0].sum(), rel=0.05)


def test_without_contact_angle_the_rollers_carry_what_those_of_a_cylindrical_bearing_do():
    """Ring and rollers of two cylindrical rows, written anew, under radial load and moment.

    Thrust of cones vanishes with their angle α, but its balance does not: without axial load both
    rows carry the same sum of loads, and the ring moves axially by `shift`/α until they do.
    """
    angle = 5e-5
    keys = [
        "rollers_per_row", "roller_diameter", "roller_length", "pitch_radius", "row_offset",
        "rib_sphere_ratio", "rib_contact_height", "youngs_modulus", "poisson_ratio", "arrangement",
    ]  # fmt: skip
    nearly = SimpleNamespace(
        **{key: getattr(MAIN, key) for key in keys}, outer_angle=angle, preload=0.0
    )
    load, moment = 1.3e6, -120e3
    ring, balance = solve(nearly, (0.0, -load, 0.0), (moment, 0.0))

    places = strip_places(MAIN.roller_length, ring.profile.size)
    profile = logarithmic_profile(places, MAIN.roller_length, MAIN.roller_diameter)
    coefficient = palmgren_coefficient(MAIN.roller_length)
    coefficient *= MAIN.roller_length / ring.profile.size
    phi = ring.angle

    def rollers(sink, tilt, shift):
        """Loads of all strips: half of the approach of the rings is that of one contact."""
        lean = -tilt * np.sin(phi)  # of the ring's section in the plane of a roller
        radial = sink * np.sin(phi) + ring.axial_position * lean + ring.sign * shift
        # ζ counts against s Z0: the large end of a roller lies on the other side of the apex.
        along = -ring.sign[:, None] * places
        half = 0.5 * (radial[:, None] + lean[:, None] * along)
        return coefficient * np.maximum(half - profile, 0.0) ** (10.0 / 9.0), along

    def unbalanced(unknowns):
        strips, along = rollers(*(1e-5 * unknowns))
        force = (strips.sum(axis=1) * np.sin(phi)).sum() + load
        arm = ring.axial_position[:, None] + along
        turned = -((strips * arm).sum(axis=1) * np.sin(phi)).sum() - moment
        thrust = (strips.sum(axis=1) * ring.sign).sum()
        return force / load, turned / abs(moment), thrust / load

    solution = root(unbalanced, [-8.0, -30.0, 0.0], tol=1e-12)
    assert solution.success
    strips, _ = rollers(*(1e-5 * solution.x))
    expected = strips.sum(axis=1)
    assert balance.outer_load[0] == pytest.approx(expected, abs=1e-3 * expected.max())
    assert balance.displacement[0, 1] == pytest.approx(1e-5 * solution.x[0], rel=1e-3)
    assert balance.displacement[0, 3] == pytest.approx(1e-5 * solution.x[1], rel=1e-3)


def test_finite_rotations_change_approaches_by_a_thousandth():
    """Rigid cones moved by the balance's displacements, without linearising anything."""
    ring, balance = solve(MAIN, *L1)
    row = tapered_geometry(MAIN)
    dx, dy, dz, turn_x, turn_y = balance.displacement[0]
    turned = Rotation.from_rotvec([turn_x, turn_y, 0.0])
    moved = np.array([dx, dy, dz])
    places = strip_places(MAIN.roller_length, ring.profile.size)
    eta = np.linspace(-0.01, 0.01, 401)  # round the roller, from its line of contact
    errors, approaches = [], []
    for j in range(0, 68, 5):
        sign, phi = ring.sign[j], ring.angle[j]
        out = np.array([math.cos(phi), math.sin(phi), 0.0])
        side = np.array([-math.sin(phi), math.cos(phi), 0.0])
        axial = np.array([0.0, 0.0, sign])
        axis = math.sin(row.axis_angle) * out - math.cos(row.axis_angle) * axial
        down = -math.cos(row.axis_angle) * out - math.sin(row.axis_angle) * axial
        middle = MAIN.pitch_radius * out + np.array([0.0, 0.0, ring.axial_position[j]])
        # The place on the roller's surface, moved with the roller by a finite tilt.
        radius = row.radius_at(places)[:, None, None]
        round_it = np.cos(eta)[:, None] * down + np.sin(eta)[:, None] * side
        local = places[:, None, None] * axis + radius * round_it
        radial_v, axial_v, tilt_v = balance.roller_motion[0, j]
        # A tilt turns the meridian plane as θY does at φ = 0: from s Z0 to the outside.
        roller_turn = Rotation.from_rotvec(tilt_v * np.cross(axial, out))
        shape = local.shape
        point = roller_turn.apply(local.reshape(-1, 3)).reshape(shape)
        point = point + middle + radial_v * out + axial_v * axial
        # In the ring's own frame its raceway is a cone about Z0; half of the preload moves the row.
        own = turned.inv().apply((point - moved).reshape(-1, 3)).reshape(shape)
        own = own - ring.preload * axial
        height = own[..., 2] - ring.axial_position[j]
        cone = math.sin(row.inner_angle), math.cos(row.inner_angle)
        from_axis = np.hypot(own[..., 0], own[..., 1])
        apex = row.apex_distance * math.cos(row.axis_angle)
        depth = cone[0] * (apex - sign * height) - cone[1] * from_axis
        exact = depth.max(axis=1)
        pressed = strip_loads(ring, balance, np.zeros(1), 0)[0][j]
        linear = (pressed / ring.strip_coefficient) ** (1.0 / ring.strip_exponent)
        loaded = pressed > 0.0
        errors.extend(np.abs(exact - ring.profile - linear)[loaded])
        approaches.extend(linear[loaded])
    assert max(errors) < 1e-3 * max(approaches)


@pytest.mark.parametrize("preload", [2e-4, 0.0, -2e-4, -5e-4])
def test_loose_rollers_do_not_hold_up_the_balance_of_a_history(preload):
    """Steps of a sample from the one before, with up to half of the rollers idle."""
    bearing = MAIN.replace(preload=preload)
    ring = tapered_ring(bearing)
    time = np.arange(80) * 0.05
    wave = 1.0 + 0.3 * np.sin(3.0 * time)
    force = np.outer(wave, L1[0])
    moment = np.outer(np.cos(2.0 * time), L1[1])
    balance = tapered_balance(ring, 1.2566 * time, force, moment)
    size = np.linalg.norm(force, axis=1) + np.linalg.norm(moment, axis=1) / bearing.pitch_radius
    assert (balance.unbalanced <= 1e-7 * size + 1e-4).all()
    assert balance.iterations[1:].mean() < 12.0
