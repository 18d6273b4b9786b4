"""Eyring stress from limiting shear."""

import math

import pytest
from scipy.optimize import brentq

from macroslip.lubricant import Lubricant
from macroslip.lubricant.temperature import eyring_stress, mean_pressure_viscosity


def test_it_rises_with_temperature_as_published():
    # Arana, Larranaga and Ulacia (2019): PAO at 1 GPa, 6.9, 7.8 and 8.7 MPa at 40, 60 and 80 degC. VG 460 stands for it.
    oil = Lubricant.read("vg460-pao")
    found = []
    for celsius in (40.0, 60.0, 80.0):
        warm = oil.at(273.15 + celsius)
        mean = mean_pressure_viscosity(warm.viscosity, warm.pressure_viscosity, 1e9)
        found.append(eyring_stress(0.035, mean))
    assert found == pytest.approx([6.9e6, 7.8e6, 8.7e6], rel=0.12)
    assert found[2] / found[0] == pytest.approx(8.7 / 6.9, rel=0.02)


def test_a_sheared_film_of_a_loaded_contact_comes_near_the_limiting_stress():
    # The stress 2 gamma/alpha makes the Eyring stress gamma p at a shear rate found here, which has to be a usual one.
    gamma, pressure = 0.042, 1e9
    alpha = mean_pressure_viscosity(0.54, 21e-9, pressure)
    stress, viscosity = eyring_stress(gamma, alpha), 0.54 * math.exp(alpha * pressure)
    rate = brentq(lambda rate: stress * math.asinh(viscosity * rate / stress) - gamma * pressure, 1.0, 1e8)
    assert 1e3 < rate < 1e6
