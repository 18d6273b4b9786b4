"""Radii, curvatures, speeds, inertia and frames: identities that hold exactly."""

import math

import numpy as np
import pytest
from scipy.integrate import tplquad

from macroslip.bearing import Bearing, geometry
from macroslip.bearing.geometry import initial_angles, roller_mass, spin_inertia
from macroslip.errors import InputError


@pytest.fixture(scope="module")
def base():
    return Bearing.read("skf-240-600-bc")


def test_contacts_lie_a_roller_radius_along_the_normal(base):
    r_in, r_out = geometry.inner_contact_radius(base), geometry.outer_contact_radius(base)
    assert r_in + r_out == pytest.approx(2 * base.pitch_radius, rel=1e-15)
    assert r_out - r_in == pytest.approx(
        base.roller_diameter * math.cos(math.radians(11.2)), rel=1e-14
    )


def test_outer_contact_lies_on_the_sphere(base):
    # The outer contact's distance from the bearing centre, from its radial and axial parts, is the sphere radius.
    radial = geometry.outer_contact_radius(base)
    axial = base.row_offset + geometry.roller_radius(base) * math.sin(base.contact_angle)
    assert math.hypot(radial, axial) == pytest.approx(base.outer_raceway_radius, rel=1e-3)


def test_rolling_curvatures_are_those_of_the_raceways_normal_sections(base):
    # The normal curvature of a surface of revolution across its axis is cos(alpha)/distance from the axis (Meusnier).
    alpha, r = base.contact_angle, geometry.roller_radius(base)
    inner = 1 / r + 1 / (geometry.inner_contact_radius(base) / math.cos(alpha))
    outer = 1 / r - 1 / (geometry.outer_contact_radius(base) / math.cos(alpha))
    assert geometry.inner_curvatures(base).rolling == pytest.approx(inner, rel=1e-14)
    assert geometry.outer_curvatures(base).rolling == pytest.approx(outer, rel=1e-14)
    # A sphere curves alike in all directions: 1/R_o.
    assert geometry.outer_curvatures(base).rolling == pytest.approx(
        1 / r - 1 / base.outer_raceway_radius, rel=1e-4
    )


def test_one_roller_contour_fits_both_raceways(base):
    other = base.replace(osculation_inner=0.97, osculation_outer=0.985)
    contour = geometry.roller_contour_radius(other)
    raceway = geometry.inner_raceway_contour_radius(other)
    assert contour / other.outer_raceway_radius == pytest.approx(0.985, rel=1e-14)
    assert contour / raceway == pytest.approx(0.97, rel=1e-14)
    assert geometry.outer_curvatures(other).lateral == pytest.approx(
        1 / contour - 1 / 0.4149, rel=1e-12
    )
    assert geometry.inner_curvatures(other).lateral == pytest.approx(
        1 / contour - 1 / raceway, rel=1e-12
    )


def test_cage_conforms_alike_in_both_directions(base):
    other = base.replace(osculation_outer=0.985)
    rolling, lateral = geometry.cage_curvatures(other)
    r, contour = geometry.roller_radius(other), geometry.roller_contour_radius(other)
    assert rolling == pytest.approx(1 / r - 1 / (r / 0.985), rel=1e-12)
    assert rolling * r == pytest.approx(lateral * contour, rel=1e-12)
    assert lateral == geometry.outer_curvatures(other).lateral


def test_pure_rolling_has_no_slip_at_either_raceway(base):
    r_in, r_out, r = (
        geometry.inner_contact_radius(base),
        geometry.outer_contact_radius(base),
        base.roller_diameter / 2,
    )
    orbit = geometry.orbit_ratio(base)
    spin = -orbit * r_out / r  # without slip at the outer raceway, which is at rest
    assert 0 < orbit < 0.5
    assert abs(-(1.0 - orbit) * r_in - spin * r) <= 1e-15


def test_inertia_is_that_of_a_solid_cylinder():
    density, r, length = 7850.0, 0.035, 0.106

    def moment(weight):
        # Cylindrical coordinates: axial position z, angle, radius.
        return density * tplquad(lambda rho, angle, z: weight(rho * math.cos(angle), rho * math.sin(angle), z) * rho,
                                 -length / 2, length / 2, 0, 2 * math.pi, 0, r)[0]  # fmt: skip

    mass = roller_mass(density, r, length)
    assert mass == pytest.approx(moment(lambda x, y, z: 1.0), rel=1e-9)
    assert spin_inertia(mass, r) == pytest.approx(moment(lambda x, y, z: x * x + y * y), rel=1e-9)


def test_rows_start_at_the_bottom_half_a_pitch_apart():
    down, up = initial_angles("downwind", 28), initial_angles("upwind", 28)
    assert down.shape == up.shape == (28,)
    assert down[0] == pytest.approx(-np.pi / 2)
    np.testing.assert_allclose(np.diff(down), 2 * np.pi / 28, rtol=1e-12)
    np.testing.assert_allclose(up - down, np.pi / 28, rtol=1e-12)
    assert down[-1] == pytest.approx(1.5 * np.pi - 2 * np.pi / 28)
    with pytest.raises(InputError, match="there is no row 'front'. Allowed: downwind or upwind."):
        initial_angles("front", 28)
