"""Rolling resistance, film and traction of tapered rollers' raceways, and the load that grips them."""

import math

import pytest
from scipy.integrate import quad

from macroslip.bearing.geometry import roller_mass
from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.constants import GRAVITY
from macroslip.contact.line import half_width, line_pressure
from macroslip.contact.line_rolling import (
    line_contacts,
    line_film,
    line_traction,
    rolling_resistance,
)
from macroslip.contact.mechanisms import Laws
from macroslip.contact.traction import prepare_fluid
from macroslip.errors import InputError
from macroslip.lubricant import Lubricant
from macroslip.ring.grip import grip_load

MAIN = TaperedBearing.read("tdo-main-bearing")
OIL = Lubricant.read("vg460-pao").at(308.15)
SPEED = 12.0 * 2.0 * math.pi / 60.0
INNER, OUTER = line_contacts(MAIN, OIL)


def test_traction_of_a_line_is_the_integral_of_the_shear_stress_over_its_width():
    laws = Laws.physical()
    fluid = prepare_fluid(laws, OIL)
    load, film, slip = 16.5e3, 8e-7, 2e-3
    width = float(half_width(load / INNER.length, INNER.curvature, INNER.modulus))
    largest = float(line_pressure(load / INNER.length, INNER.curvature, INNER.modulus))

    def stress(x):
        pressure = largest * math.sqrt(1.0 - (x / width) ** 2)
        log_eta = math.log(fluid.viscosity) + fluid.exponent * (
            (1.0 + pressure / fluid.reference_pressure) ** fluid.index - 1.0
        )
        return fluid.characteristic * math.asinh(
            math.exp(log_eta) * slip / film / fluid.characteristic
        )

    force = INNER.length * quad(stress, -width, width, epsrel=1e-8)[0]
    assert line_traction(INNER, load, film, slip, laws) == pytest.approx(force, rel=2e-3)


def test_goksem_and_hargreaves_flooded_is_thirteen_newton_a_contact():
    assert rolling_resistance(INNER, 16.5e3, 0.24, "goksem-hargreaves") == pytest.approx(
        13.0, abs=0.3
    )


@pytest.mark.parametrize(("ratio", "load"), [(0.001, 33e3), (0.01, 16.5e3), (0.05, 9.2e3)])
def test_the_load_of_grip_is_that_of_an_independent_program(ratio, load):
    """Eyring, film times 0.7, and Goksem and Hargreaves' rolling; the law of the film differs."""
    computed = grip_load(
        MAIN, OIL, SPEED, slide_roll_ratio=ratio, film_factor=0.7, rolling="goksem-hargreaves"
    )
    assert computed == pytest.approx(load, rel=0.1)


def test_at_the_load_of_grip_traction_drives_the_roller():
    grip = grip_load(MAIN, OIL, SPEED)
    row = tapered_geometry(MAIN)
    speed = row.surface_speed(SPEED)
    mass = roller_mass(MAIN.density, row.roller_radius, MAIN.roller_length)
    needed = rolling_resistance(INNER, grip, speed) + 0.5 * mass * GRAVITY
    film = line_film(INNER, grip, speed)
    assert line_traction(INNER, grip, film, 0.01 * speed) == pytest.approx(float(needed), rel=1e-4)


def test_curvatures_are_those_of_cones():
    row = tapered_geometry(MAIN)
    assert 1.0 / INNER.curvature < row.roller_radius < 1.0 / OUTER.curvature


def test_an_unknown_law_is_refused_with_those_that_exist():
    with pytest.raises(InputError, match="zhou-hoeprich or goksem-hargreaves"):
        rolling_resistance(INNER, 1e4, 0.2, "other")
