"""Pressure-viscosity coefficient with a constant Roelands index."""

import math

import mpmath
import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip.errors import InputError
from macroslip.lubricant.temperature import (
    ROELANDS_PRESSURE,
    mean_pressure_viscosity,
    pressure_viscosity_at,
    roelands_index,
)
from macroslip.lubricant.viscosity import roelands


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
