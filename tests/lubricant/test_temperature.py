"""Walther's line, Roelands' index, density and Eyring stress over temperature, against definitions in high precision."""

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip.errors import InputError
from macroslip.lubricant import Lubricant
from macroslip.lubricant.base_oil import BASE_OILS
from macroslip.lubricant.temperature import (
    ROELANDS_PRESSURE,
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

SHIFT = mpmath.mpf("0.7")


def exact(first, second):
    """Kinematic viscosity [mm2/s] over temperature [K] through two points, as ASTM D341 defines it, in 40 digits."""
    (t1, n1), (t2, n2) = first, second

    def ordinate(viscosity):
        return mpmath.log10(mpmath.log10(mpmath.mpf(viscosity) + SHIFT))

    slope = (ordinate(n1) - ordinate(n2)) / (
        mpmath.log10(mpmath.mpf(t2)) - mpmath.log10(mpmath.mpf(t1))
    )

    def viscosity(temperature):
        return (
            10
            ** (
                10
                ** (
                    ordinate(n1)
                    - slope * (mpmath.log10(temperature) - mpmath.log10(mpmath.mpf(t1)))
                )
            )
            - SHIFT
        )

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
def test_a_line_with_a_slope_has_it_and_passes_through_the_point(
    temperature, viscosity, coefficient
):
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
        InputError,
        match="the viscosity is 24 mm2/s at 313.15 K and 320 mm2/s at 373.15 K. Allowed: a vis",
    ):
        walther_line_through(313.15, 24e-6, 373.15, 320e-6)
    with pytest.raises(InputError, match="falls with temperature"):
        walther_line_through(313.15, 24e-6, 373.15, 24e-6)
    with pytest.raises(
        InputError, match="Walther's line has no viscosity of 0.2 mm2/s. Allowed: above 0.3 mm2/s"
    ):
        walther_line_through(313.15, 24e-6, 373.15, 0.2e-6)
    for coefficient in (0.0, -0.01, float("nan")):
        with pytest.raises(InputError, match="falls by .* Allowed: a positive number"):
            walther_line_with_slope(313.15, 24e-6, coefficient)


@given(st.floats(1e-3, 100.0), st.floats(5e-9, 4e-8))
def test_index_and_coefficient_are_inverse(viscosity, coefficient):
    index = roelands_index(viscosity, coefficient)
    assert pressure_viscosity_at(index, viscosity) == pytest.approx(coefficient, rel=1e-14)


@given(st.floats(1e-2, 10.0), st.floats(1e-8, 3e-8), st.floats(1e6, 3e9))
def test_mean_coefficient_gives_the_viscosity_back(viscosity, coefficient, pressure):
    mean = mean_pressure_viscosity(viscosity, coefficient, pressure)
    with mpmath.workdps(30):
        constant = mpmath.log(viscosity) + mpmath.mpf("9.67")
        index = mpmath.mpf(coefficient) * mpmath.mpf(ROELANDS_PRESSURE) / constant
        exact = (
            constant
            * ((1 + mpmath.mpf(pressure) / mpmath.mpf(ROELANDS_PRESSURE)) ** index - 1)
            / pressure
        )
    assert mean == pytest.approx(float(exact), rel=1e-11)


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
    alpha = {
        name: gold(320e-6, oil.gold_factor, oil.gold_exponent) for name, oil in BASE_OILS.items()
    }
    assert (
        alpha["mineral"]
        > alpha["pao-mineral"]
        > alpha["pao"]
        > alpha["ester"]
        > alpha["polyglycol"]
    )
    assert all(10e-9 < value < 25e-9 for value in alpha.values())


def test_ranges_hold_their_means():
    for oil in BASE_OILS.values():
        low, mean, high = oil.limiting_shear
        assert 0.02 < low <= mean <= high < 0.07


def test_eyring_stress_rises_with_temperature_as_published():
    # Arana, Larranaga and Ulacia (2019): PAO at 1 GPa, 6.9, 7.8 and 8.7 MPa at 40, 60 and 80 degC. VG 460 stands for it.
    oil = Lubricant.read("vg460-pao")
    stresses = []
    for celsius in (40.0, 60.0, 80.0):
        warm = oil.at(273.15 + celsius)
        mean = mean_pressure_viscosity(warm.viscosity, warm.pressure_viscosity, 1e9)
        stresses.append(eyring_stress(0.035, mean))
    assert stresses == pytest.approx([6.9e6, 7.8e6, 8.7e6], rel=0.12)
    assert stresses[2] / stresses[0] == pytest.approx(8.7 / 6.9, rel=0.02)
