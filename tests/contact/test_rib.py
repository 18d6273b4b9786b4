"""Rib contact: Hertz, film and friction against independent values and quadrature; torque exact."""

import math

import numpy as np
import pytest
from scipy.integrate import dblquad

from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.contact.mechanisms import Laws
from macroslip.contact.rib import chittenden_thickness, film_friction, rib_contact, rib_state
from macroslip.contact.traction import prepare_fluid
from macroslip.lubricant import Lubricant
from macroslip.ring.tapered import tapered_balance, tapered_ring

MAIN = TaperedBearing.read("tdo-main-bearing")
SMALL = TaperedBearing.read("32216-pair")
OIL = Lubricant.read("vg460-pao").at(308.15)
SPEED = 12.0 * 2.0 * math.pi / 60.0


def test_ellipse_and_pressure_are_those_of_an_independent_program():
    contact = rib_contact(MAIN, OIL)
    state = rib_state(contact, 17.9e3, 0.238, 0.0417)
    assert state.pressure / 1e6 == pytest.approx(260.0, rel=0.005)
    assert (state.half_along * 1e3, state.half_across * 1e3) == pytest.approx((10.5, 3.1), rel=0.02)
    assert contact.hertz.stiffness == pytest.approx(2.233e11, rel=1e-3)
    small = rib_contact(SMALL, OIL)
    assert small.hertz.stiffness == pytest.approx(1.153e11, rel=1e-3)
    assert rib_state(small, 102.0, 1.0, 1.0).pressure / 1e6 == pytest.approx(110.5, rel=1e-3)


def test_on_a_circle_the_film_is_that_of_hamrock_and_dowson():
    """H = 2.69 U^0.67 G^0.53 W^−0.067 (1 − 0.61 e^−0.73) for a circle (Hamrock and Dowson 1977)."""
    radius, modulus, load, speed = 0.02, 230.8e9, 50.0, 1.0
    film = chittenden_thickness(load, speed, radius, radius, modulus, OIL)
    groups = OIL.viscosity * speed / (modulus * radius), OIL.pressure_viscosity * modulus
    circle = 2.69 * groups[0] ** 0.67 * groups[1] ** 0.53
    circle *= (load / (modulus * radius**2)) ** -0.067 * (1.0 - 0.61 * math.exp(-0.73)) * radius
    assert film == pytest.approx(circle, rel=0.05)


def test_film_friction_is_the_integral_of_the_shear_stress_over_the_ellipse():
    laws = Laws.physical()
    contact = rib_contact(MAIN, OIL)
    load, film, sliding = 17.9e3, 2.6e-6, 0.0417
    fluid = prepare_fluid(laws, contact.lubricant)
    root = load ** (1.0 / 3.0)
    p0 = contact.hertz.pressure * root
    across = contact.hertz.semi_axis_across * root
    along = contact.hertz.semi_axis_along * root

    def stress(y, x):
        pressure = p0 * math.sqrt(max(0.0, 1.0 - (x / along) ** 2 - (y / across) ** 2))
        log_eta = math.log(fluid.viscosity) + fluid.exponent * (
            (1.0 + pressure / fluid.reference_pressure) ** fluid.index - 1.0
        )
        # Shear heats this film by nothing that counts: 8k/β is ten thousand times τ v.
        ratio = math.exp(log_eta) * sliding / film / fluid.characteristic
        return fluid.characteristic * math.asinh(ratio)

    def width(x):
        return across * math.sqrt(max(0.0, 1.0 - (x / along) ** 2))

    quarter = dblquad(stress, 0.0, along, 0.0, width, epsrel=1e-6)[0]
    assert film_friction(contact, np.array(load), film, sliding, laws) == pytest.approx(
        4.0 * quarter, rel=5e-3
    )


def test_the_ribs_torque_is_friction_times_height_times_thrust():
    """M = µ h_f F_a/cos(ε − β), exact: thrust alone, and any friction coefficient."""
    bearing = MAIN.replace(preload=-0.1e-3)
    row = tapered_geometry(bearing)
    thrust = 400e3
    ring = tapered_ring(bearing)
    balance = tapered_balance(ring, np.zeros(1), np.array([[0.0, 0.0, thrust]]), np.zeros((1, 2)))
    state = rib_state(
        rib_contact(bearing, OIL),
        balance.rib_force[0],
        row.rib_entrainment_speed(SPEED),
        row.rib_sliding_speed(SPEED),
    )
    friction = state.friction_coefficient[0]
    lean = math.cos(row.rib_angle - row.half_cone_angle)
    expected = friction * row.rib_contact_height * thrust / lean
    assert state.power.sum() / SPEED == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize(("temperature", "ratio"), [(35.0, 11.0), (50.0, 6.2)])
def test_film_over_roughness_at_the_main_bearing_s_rib(temperature, ratio):
    oil = Lubricant.read("vg460-pao").at(273.15 + temperature)
    row = tapered_geometry(MAIN)
    speeds = row.rib_entrainment_speed(SPEED), row.rib_sliding_speed(SPEED)
    state = rib_state(rib_contact(MAIN, oil), 17.9e3, *speeds)
    assert state.film_ratio == pytest.approx(ratio, rel=0.05)
    starved = rib_contact(MAIN.replace(rib_oil_supply=0.1), oil)
    assert (
        rib_state(starved, 17.9e3, *speeds).friction_coefficient > 10 * state.friction_coefficient
    )


def test_a_rib_without_load_dissipates_nothing():
    state = rib_state(rib_contact(MAIN, OIL), np.array([0.0, 1e3]), 0.2, 0.04)
    assert (state.power[0], state.pressure[0], state.friction_coefficient[0]) == (0.0, 0.0, 0.0)
    assert state.power[1] > 0.0
