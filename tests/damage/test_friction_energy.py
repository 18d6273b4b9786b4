"""The FE8 test against its closed form, and that it does not depend on its rollers."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from macroslip.damage.friction_energy import ThrustTest, friction_power, pass_work


def test_even_load_is_geometry_alone():
    test = ThrustTest()
    distance, power = test.power()
    # w Z |v|/(2π r), whatever the number of rollers and their length.
    expected = (
        test.force
        / test.roller_length
        * 0.5
        * test.speed
        * np.abs(distance)
        / (2.0 * math.pi * (test.pitch_radius + distance))
    )
    np.testing.assert_allclose(power, expected, rtol=1e-12)
    np.testing.assert_allclose(replace(test, rollers=19).power()[1], power, rtol=1e-12)
    assert np.argmin(power) in (power.size // 2 - 1, power.size // 2)


def test_its_power_and_what_it_accumulates_in_20_hours():
    """Published evaluations of this test: 3.8 to 5.6 W/mm² by pressure profile, 2.7 to 4.1e11 J/m² in 20 h."""
    low, high = ThrustTest().range()
    assert low == pytest.approx(3.8e6, rel=0.05) and high == pytest.approx(5.6e6, rel=0.01)
    assert low * ThrustTest().duration == pytest.approx(2.7e11, rel=0.05)
    assert high * ThrustTest().duration == pytest.approx(4.1e11, rel=0.02)


@pytest.mark.parametrize(
    "change", [{"rollers": 19}, {"roller_diameter": 10e-3}, {"roller_length": 10.5e-3}]
)
def test_the_logarithmic_profile_hardly_depends_on_the_roller(change):
    assert replace(ThrustTest(), **change).range()[0] == pytest.approx(
        ThrustTest().range()[0], rel=0.06
    )


def test_load_is_conserved_by_the_profile():
    test = ThrustTest()
    distance, power = test.power("logarithmic", slices=400)
    load = (
        power
        / (test.rollers * 0.25 * test.speed / math.pi)
        * (test.pitch_radius + distance)
        / np.abs(distance)
    )
    assert (load * test.roller_length / 400).sum() * test.rollers == pytest.approx(
        test.force, rel=1e-9
    )


def test_a_pass_does_not_depend_on_the_sign_of_slip():
    assert pass_work(1e6, -1e-3, 0.4) == pass_work(1e6, 1e-3, 0.4) == pytest.approx(2500.0)
    assert friction_power(2500.0, 4.0) == 1e4
