"""A contact with two components of slip: against integrals of its own, limits in closed form, energies and mirrors."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import dblquad

from macroslip import Bearing, Laws, Lubricant
from macroslip.bearing import geometry
from macroslip.contact.hertz import elliptical_contact
from macroslip.contact.laws import prepare
from macroslip.contact.skewed import constant_friction, resultants, skewed_contact
from macroslip.contact.table import tractions

BEARING, OIL = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
LAWS = Laws.physical().but(rolling="none", asperities="none")
SPEED, LOADS = -0.39594, np.array([2e4, 3.5e4, 5e4])
sides = pytest.mark.parametrize("ring", ["inner", "outer"])


def contact(ring, sign=1, shear=None, laws=LAWS):
    return skewed_contact(getattr(prepare(laws, BEARING, OIL, sign), ring), BEARING, sign, shear)


@sides
@pytest.mark.parametrize(
    "laws", [LAWS, LAWS.but(rheology="limiting-shear"), LAWS.but(asperities="film-ratio")]
)
@pytest.mark.parametrize("slip", [-2e-3, 1e-3])
def test_a_straight_roller_has_the_tractions_without_skew(ring, laws, slip):
    skewed = contact(ring, laws=laws)
    forces = resultants(skewed, LOADS, SPEED, slip, 0.0, 0.0, 0.0)
    pull, lag, skew, _ = tractions(skewed.laws, LOADS, np.full(3, SPEED), np.full(3, slip))
    # Net forces and moments are differences of what films of .04 Q pull either way. Their stress is tabulated to 1e-3 in places,
    # and spin within the contact's width is new here.
    friction, reach = 0.04 * LOADS, skewed.laws.interface.hertz.semi_axis_across * np.cbrt(LOADS)
    assert (np.abs(forces.turning - (pull - lag)) < 5e-4 * friction).all()
    assert (np.abs(-skewed.side * forces.moment - skew) < 5e-4 * friction * reach).all()
    assert forces.axial == pytest.approx(0.0, abs=1e-9)
    assert forces.pressure_moment == pytest.approx(0.0, abs=1e-9)


@sides
def test_forces_and_moments_are_those_of_an_integral_of_their_own(ring):
    """Vectors of traction, arms and speeds in the roller's frame, for a straight wall of stress in proportion to pressure."""
    skewed, load, slip, skew = contact(ring, shear=constant_friction(0.05)), 5e4, 1e-3, 4e-3
    hertz, root = skewed.laws.interface.hertz, 5e4 ** (1 / 3)
    a, b, p0 = (x * root for x in (hertz.semi_axis_across, hertz.semi_axis_along, hertz.pressure))
    k, r = skewed.side, skewed.roller_radius
    ring_rate, spin = k * SPEED / skewed.raceway_radius, (SPEED - slip) / r
    axis = np.array(
        [
            math.sin(BEARING.contact_angle) * 0.0,
            math.sin(BEARING.contact_angle),
            math.cos(BEARING.contact_angle),
        ]
    )
    contour = 0.5 * (1.0 / skewed.roller_contour + skewed.along)
    centre = (
        np.array([0.0, math.cos(BEARING.contact_angle), -math.sin(BEARING.contact_angle)])
        * BEARING.pitch_radius
    )
    turn = skew * (1.0 + skewed.turn)

    def point(zeta, x):
        """Point from the roller's centre; x is counted from the turned long axis."""
        return np.array([x + turn * zeta, k * (r - 0.5 * contour * zeta * zeta), zeta])

    def traction(zeta, x):
        at = point(zeta, x)
        relative = ring_rate * np.cross(axis, centre + at) - spin * np.cross([skew, 0.0, 1.0], at)
        tangent = np.array([relative[0], 0.0, relative[2]])
        pressure = p0 * math.sqrt(max(1.0 - (zeta / a) ** 2 - (x / b) ** 2, 0.0))
        return 0.05 * pressure * tangent / np.hypot(*tangent[[0, 2]]), at, tangent

    def integral(value):
        return dblquad(
            lambda t, zeta: value(zeta, b * math.sqrt(1 - (zeta / a) ** 2) * math.sin(t))
            * b * math.sqrt(1 - (zeta / a) ** 2) * math.cos(t),
            -a, a, -math.pi / 2, math.pi / 2, epsabs=0.02, epsrel=1e-3,
        )[0]  # fmt: skip

    forces = resultants(skewed, load, SPEED, slip, skew, 0.0, 0.0)
    assert forces.axial == pytest.approx(integral(lambda z, x: traction(z, x)[0][2]), rel=3e-3)

    def moment(z, x):
        force, at, _ = traction(z, x)
        return np.cross(at, force)[1]

    assert forces.moment == pytest.approx(integral(moment), rel=3e-3)

    def power(z, x):
        force, _, tangent = traction(z, x)
        return force @ tangent

    assert forces.power == pytest.approx(integral(power), rel=3e-3)


@sides
def test_power_is_the_sum_of_torques_times_speeds(ring):
    skewed = contact(ring)
    slip, tilt = 8e-4, 3e-5
    forces = resultants(skewed, LOADS, SPEED, slip, 5e-3, skewed.side * 4e-4, tilt)
    ring_rate, spin = (
        skewed.side * SPEED / skewed.raceway_radius,
        (SPEED - slip) / skewed.roller_radius,
    )
    # The ring feels the opposite of the roller.
    delivered = -(forces.ring_torque * ring_rate + forces.turning * skewed.roller_radius * spin)
    assert forces.power == pytest.approx(delivered, rel=1e-10)


@sides
def test_constant_friction_far_askew_is_all_axial(ring):
    """µ Q less what cos² of the direction takes: v is thousandths of w."""
    forces = resultants(
        contact(ring, shear=constant_friction(0.05)), 5e4, SPEED, 0.0, 0.5, 0.0, 0.0
    )
    side = -1 if ring == "inner" else 1
    assert forces.axial == pytest.approx(-side * math.copysign(0.05 * 5e4, SPEED), rel=2e-3)


@sides
def test_moment_of_the_pressure_is_the_slope_of_the_hertz_energy(ring):
    """−∂U/∂ψ at a fixed approach, U = (2/5) K δ^2.5 with the principal curvatures of the turned gap."""
    skewed, load = contact(ring), 5e4
    forces = resultants(skewed, load, SPEED, 0.0, 1e-3, 0.0, 0.0)

    def stiffness(skew):
        own = np.diag([1.0 / skewed.roller_radius, 1.0 / skewed.roller_contour])
        c, s = math.cos(skew), math.sin(skew)
        turned = np.array([[c, s], [-s, c]]) @ own @ np.array([[c, -s], [s, c]])
        lateral, rolling = np.linalg.eigvalsh(turned - np.diag([skewed.across, skewed.along]))
        approach = elliptical_contact(rolling, lateral, skewed.laws.interface.modulus).approach
        return approach**-1.5

    # Where curvatures are nearly those at rest a large step loses no digits.
    step = 0.02
    change = (stiffness(step) - stiffness(0.0)) / (0.5 * step**2)
    delta = (load / stiffness(0.0)) ** (2.0 / 3.0)
    assert forces.pressure_moment == pytest.approx(
        -0.4 * delta**2.5 * change * 1e-3, rel=0.05, abs=1e-6
    )


@sides
def test_rows_and_directions_of_turning_are_mirrored(ring):
    args = (1e-3, 4e-3, 3e-4, 2e-5)
    down = resultants(contact(ring, 1), LOADS, SPEED, *args)
    up = resultants(contact(ring, -1), LOADS, SPEED, args[0], -args[1], -args[2], -args[3])
    back = resultants(contact(ring, 1), LOADS, -SPEED, -args[0], *args[1:])
    assert up.moment == pytest.approx(-down.moment, rel=1e-9)
    assert up.axial == pytest.approx(-down.axial, rel=1e-9)
    assert up.power == pytest.approx(down.power, rel=1e-9)
    assert back.moment == pytest.approx(-down.moment, rel=1e-9)
    assert back.power == pytest.approx(down.power, rel=1e-9)
    assert geometry.AXIAL_SIGNS["upwind"] == -1
