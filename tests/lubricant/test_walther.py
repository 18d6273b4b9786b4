"""Walther's line against its definition in high precision."""

import mpmath
import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip.errors import InputError
from macroslip.lubricant.temperature import (
    WaltherLine,
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
