"""Walther's line, Roelands' index, density and Eyring stress over temperature, against definitions in high precision."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import brentq

from macroslip.errors import InputError
from macroslip.lubricant import Lubricant
from macroslip.lubricant.base_oil import BASE_OILS
from macroslip.lubricant.temperature import (
    ROELANDS_PRESSURE,
    WaltherLine,
    density_at,
    eyring_stress,
    gold,
    mean_pressure_viscosity,
    pressure_viscosity_at,
    roelands_index,
    walther_coefficient,
    walther_line_through,
    walther_line_with_slope,
    walther_viscosity,
)
from macroslip.lubricant.viscosity import roelands

SHIFT = mpmath.mpf("0.7")


def exact(first, second):
    """Kinematic viscosity [mm2/s] over temperature [K] through two points, as ASTM D341 defines it, in 40 digits."""
    (t1, n1), (t2, n2) = first, second

    def ordinate(viscosity):
        return mpmath.log10(mpmath.log10(mpmath.mpf(viscosity) + SHIFT))

    slope = (ordinate(n1) - ordinate(n2)) / (mpmath.log10(mpmath.mpf(t2)) - mpmath.log10(mpmath.mpf(t1)))

    def viscosity(temperature):
        return 10 ** (10 ** (ordinate(n1) - slope * (mpmath.log10(temperature) - mpmath.log10(mpmath.mpf(t1))))) - SHIFT

    return viscosity


@pytest.mark.parametrize("grade", [(32.0, 5.4), (320.0, 24.0), (460.0, 46.0), (680.0, 74.0)])
@pytest.mark.parametrize("temperature", [258.15, 293.15, 308.15, 323.15, 393.15])
def test_line_and_its_slope_in_high_precision(grade, temperature):
    line = walther_line_through(313.15, grade[0] * 1e-6, 373.15, grade[1] * 1e-6)
    with mpmath.workdps(40):
        viscosity = exact((313.15, grade[0]), (373.15, grade[1]))
        at = mpmath.mpf(temperature)
        expected, fall = float(viscosity(at)), float(-mpmath.diff(viscosity, at) / viscosity(at))
    assert walther_viscosity(line, temperature) == pytest.approx(expected * 1e-6, rel=1e-11)
    assert walther_coefficient(line, temperature) == pytest.approx(fall, rel=1e-11)


@given(st.floats(260.0, 380.0), st.floats(2e-6, 1e-2), st.floats(0.02, 0.1))
def test_a_line_with_a_slope_has_it_and_passes_through_the_point(temperature, viscosity, coefficient):
    line = walther_line_with_slope(temperature, viscosity, coefficient)
    assert walther_viscosity(line, temperature) == pytest.approx(viscosity, rel=1e-10)
    assert walther_coefficient(line, temperature) == pytest.approx(coefficient, rel=1e-10)
    # The same line as through two of its own points.
    other = temperature + 20.0
    twin = walther_line_through(temperature, viscosity, other, walther_viscosity(line, other))
    assert twin == pytest.approx(line, rel=1e-7)


def test_an_oil_between_its_two_viscosities_as_published():
    # SKF LGEM 2, LGHB 2: no third value is published. ISO VG 460 of viscosity index 95 has about 31 mm2/s at 100 degC and
    # loses half of its viscosity within 10 to 13 K around 40 degC.
    line = walther_line_through(313.15, 460e-6, 373.15, 30.5e-6)
    assert 0.45 < walther_viscosity(line, 323.15) / 460e-6 < 0.58


def test_what_is_no_line_is_refused():
    with pytest.raises(
        InputError, match="the viscosity is 24 mm2/s at 313.15 K and 320 mm2/s at 373.15 K. Allowed: a vis"
    ):
        walther_line_through(313.15, 24e-6, 373.15, 320e-6)
    with pytest.raises(InputError, match="falls with temperature"):
        walther_line_through(313.15, 24e-6, 373.15, 24e-6)
    with pytest.raises(InputError, match="Walther's line has no viscosity of 0.2 mm2/s. Allowed: above 0.3 mm2/s"):
        walther_line_through(313.15, 24e-6, 373.15, 0.2e-6)
    for coefficient in (0.0, -0.01, float("nan")):
        with pytest.raises(InputError, match="falls by .* Allowed: a positive number"):
            walther_line_with_slope(313.15, 24e-6, coefficient)


def test_a_steeper_line_falls_faster():
    flat, steep = WaltherLine(9.0, 3.4), WaltherLine(9.5, 3.6)
    assert walther_coefficient(steep, 313.15) > walther_coefficient(flat, 313.15)


def test_density_falls_by_065_a_kelvin():
    assert density_at(860.0, 288.15, 288.15) == 860.0
    assert density_at(860.0, 288.15, 298.15) == pytest.approx(853.5, rel=1e-14)
    there = density_at(860.0, 288.15, 350.0)
    assert density_at(there, 350.0, 288.15) == pytest.approx(860.0, rel=1e-14)


@given(st.floats(1e-3, 100.0), st.floats(5e-9, 4e-8))
def test_index_and_coefficient_are_inverse(viscosity, coefficient):
    index = roelands_index(viscosity, coefficient)
    assert pressure_viscosity_at(index, viscosity) == pytest.approx(coefficient, rel=1e-14)


@pytest.mark.parametrize(("celsius", "at_1_gpa"), [(20.0, 3.8e5), (35.0, 5.6e4), (50.0, 8.3e3)])
def test_viscosity_at_1_gpa_over_temperature(celsius, at_1_gpa):
    # Worked out by hand from 0.54 Pa s, 21 1/GPa and 0.056 1/K at 35 degC, with the viscosity an exponential.
    viscosity = 0.54 * math.exp(-0.056 * (celsius - 35.0))
    coefficient = pressure_viscosity_at(roelands_index(0.54, 21e-9), viscosity)
    assert roelands(viscosity, coefficient, 1e9) == pytest.approx(at_1_gpa, rel=0.01)


def test_with_the_coefficient_kept_a_loaded_film_would_hardly_thin():
    cold, warm = (0.54 * math.exp(-0.056 * change) for change in (-15.0, 15.0))
    index = roelands_index(0.54, 21e-9)
    constant = [roelands(eta, pressure_viscosity_at(index, eta), 1e9) for eta in (cold, warm)]
    kept = [roelands(eta, 21e-9, 1e9) for eta in (cold, warm)]
    assert kept[0] / kept[1] < 2.0
    assert constant[0] / constant[1] > 40.0


@given(st.floats(1e-2, 10.0), st.floats(1e-8, 3e-8), st.floats(1e6, 3e9))
def test_mean_coefficient_gives_the_viscosity_back(viscosity, coefficient, pressure):
    mean = mean_pressure_viscosity(viscosity, coefficient, pressure)
    with mpmath.workdps(30):
        constant = mpmath.log(viscosity) + mpmath.mpf("9.67")
        index = mpmath.mpf(coefficient) * mpmath.mpf(ROELANDS_PRESSURE) / constant
        exact = constant * ((1 + mpmath.mpf(pressure) / mpmath.mpf(ROELANDS_PRESSURE)) ** index - 1) / pressure
    assert mean == pytest.approx(float(exact), rel=1e-11)


def test_mean_coefficient_starts_at_the_slope():
    assert mean_pressure_viscosity(0.54, 21e-9, 1.0) == pytest.approx(21e-9, rel=1e-8)


def test_ratio_of_two_temperatures_does_not_depend_on_pressure():
    index = roelands_index(0.54, 21e-9)
    cold, warm = ((eta, pressure_viscosity_at(index, eta)) for eta in (0.54, 0.25))
    ratios = [mean_pressure_viscosity(*cold, p) / mean_pressure_viscosity(*warm, p) for p in (1e7, 5e8, 1.5e9)]
    assert ratios == pytest.approx([cold[1] / warm[1]] * 3, rel=1e-13)


def test_a_viscosity_too_low_is_refused():
    with pytest.raises(InputError, match="Roelands' law has no viscosity of 5e-05 Pa s"):
        pressure_viscosity_at(0.5, 5e-5)


def test_gold_is_a_power_law_in_mm2_per_second():
    nu = np.array([10e-6, 100e-6, 1000e-6])
    slope = np.diff(np.log([gold(value, 7.382, 0.1335) for value in nu])) / np.log(10.0)
    assert slope == pytest.approx([0.1335, 0.1335], rel=1e-12)
    assert gold(1e-6, 7.382, 0.1335) == pytest.approx(7.382e-9, rel=1e-14)


def test_families_are_ordered_as_their_friction():
    # Mineral oils have the largest coefficients, polyglycols the smallest.
    alpha = {name: gold(320e-6, oil.gold_factor, oil.gold_exponent) for name, oil in BASE_OILS.items()}
    assert alpha["mineral"] > alpha["pao-mineral"] > alpha["pao"] > alpha["ester"] > alpha["polyglycol"]
    assert all(10e-9 < value < 25e-9 for value in alpha.values())


def test_ranges_hold_their_means():
    for oil in BASE_OILS.values():
        low, mean, high = oil.limiting_shear
        assert 0.02 < low <= mean <= high < 0.07


def test_eyring_stress_rises_with_temperature_as_published():
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
