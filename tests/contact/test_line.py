"""Line contact: Hertz against its pressure's integral, plane strain against a half-space's depth."""

import numpy as np
import pytest
from scipy.integrate import quad

from macroslip.contact.line import (
    half_width,
    line_pressure,
    logarithmic_profile,
    palmgren_coefficient,
    plane_strain_approach,
    plane_strain_law,
)

MODULUS = 2.0 * 210e9 / (2.0 * (1.0 - 0.3**2))


@pytest.mark.parametrize("load", [1e4, 2e5, 3e6])
def test_the_pressure_carries_the_load(load):
    width = half_width(load, 33.0, MODULUS)
    largest = line_pressure(load, 33.0, MODULUS)
    carried, _ = quad(lambda x: largest * np.sqrt(1.0 - (x / width) ** 2), -width, width)
    assert carried == pytest.approx(load, rel=1e-6)


def test_the_surface_of_a_half_space_fits_the_roller_under_this_pressure():
    """Slopes under a strip of pressure (Johnson 2.2): u' = −2/(π E*) PV∫ p(s)/(x − s) ds = −κ x."""
    load, curvature = 1e6, 33.0
    width = half_width(load, curvature, MODULUS)
    largest = line_pressure(load, curvature, MODULUS)
    position = 0.4 * width
    # PV of √(1 − s²)/(x − s) by subtracting its value at x, whose own integral is a logarithm.
    at = np.sqrt(1.0 - 0.4**2)
    smooth, _ = quad(lambda s: (np.sqrt(1.0 - s * s) - at) / (0.4 - s), -1.0, 1.0, points=[0.4])
    principal = smooth + at * np.log((1.0 + 0.4) / (1.0 - 0.4))
    slope = 2.0 / (np.pi * MODULUS / 2.0) * largest * principal
    assert slope == pytest.approx(curvature * position, rel=1e-6)


def test_palmgren_has_his_formula_in_newtons_and_millimetres():
    approach_mm = 3.84e-5 * 100e3**0.9 / 107.0**0.8
    load = palmgren_coefficient(0.107) * (approach_mm * 1e-3) ** (10.0 / 9.0) * 0.107
    assert load == pytest.approx(100e3, rel=1e-12)


def test_plane_strain_grows_by_the_strain_below_the_ring_s_surface():
    """A ring of twice the thickness adds the strain of the fan of forces between both depths."""
    load, width = 1e6, 5e-4
    thin, thick = (plane_strain_approach(load, width, 0.03, t, 230.8e9) for t in (0.03, 0.06))
    # σ_z = −2q/(π z) under a line load; ε_z = (1 − ν²) σ_z/E far below the contact, less what σ_x adds.
    added, _ = quad(lambda z: 2.0 * load / (np.pi * z) / 230.8e9, 0.03, 0.06)
    assert thick - thin == pytest.approx(added, rel=1e-9)


def test_the_power_law_of_plane_strain_keeps_its_stated_error():
    coefficient, exponent = plane_strain_law(0.031, 0.036, 230.8e9)
    load = np.geomspace(1e4, 3e6, 200)
    width = half_width(load, 1.0 / 0.031, 230.8e9)
    approach = plane_strain_approach(load, width, 0.031, 0.036, 230.8e9)
    assert coefficient * approach**exponent == pytest.approx(load, rel=0.03)


def test_the_profile_is_even_and_drops_without_bound_at_the_ends():
    places = np.array([-0.05, 0.0, 0.05])
    drop = logarithmic_profile(places, 0.107, 0.062)
    assert drop[0] == drop[2] > drop[1] == 0.0
    assert logarithmic_profile(0.107 / 2 * (1 - 1e-9), 0.107, 0.062) > 4e-4
