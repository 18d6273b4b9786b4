"""Moes' film against Reynolds' equation: exact rigid limits, full elastic solutions, and the formula in 30 digits."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.optimize import brentq

from macroslip.film import film_law as law
from macroslip.film.moes import log_moes, moes

pytestmark = pytest.mark.slow

powers = {"log_load": st.floats(-6.0, 4.0), "log_material": st.floats(-3.0, 2.0)}


def formula(load, material):
    """N in high precision, coefficients as decimals."""
    d = mpmath.mpf
    load, material = d(load), d(material)
    rigid, elastic = 3 / load, d("2.621") * load ** d("-0.2")
    stiff, heavy = d("1.287") * material ** (d(2) / 3), d("1.311") * load ** d("-0.125") * material ** d("0.75")
    s = (7 + 8 * mpmath.exp(-2 * elastic / rigid)) / 5
    isoviscous = (rigid ** (d(7) / 3) + elastic ** (d(7) / 3)) ** (3 * s / 7)
    return (isoviscous + (stiff ** d("-3.5") + heavy ** d("-3.5")) ** (-2 * s / 7)) ** (1 / s)


def rigid_solution():
    """Martin's exact solution: N M of the isoviscous and N L^(−2/3) of the piezoviscous limit, N the volume-flow film.

    In X = √(2 H0) t, H = H0 (1 + t²), Reynolds' equation is P' = 6 √2 H0^(−3/2) (t² − t1²)/(1 + t²)³, with t1 such
    that the pressure is 0 where its slope is. With Barus' law the same holds for (1 − e^(−L P))/L, whose largest value
    is 1/L where the pressure becomes infinite.
    """

    def slope(t, end):
        return (t * t - end * end) / (1.0 + t * t) ** 3

    end = brentq(lambda end: quad(slope, -math.inf, end, args=(end,), epsabs=1e-13)[0], 0.2, 0.9, xtol=1e-13)
    # ∫ P dX, with P by parts.
    area = -quad(lambda t: t * slope(t, end), -math.inf, end, epsabs=1e-13)[0]
    smallest_iso = 12.0 * area
    peak = 6.0 * math.sqrt(2.0) * -quad(slope, -end, end, args=(end,), epsabs=1e-13)[0]
    return (1.0 + end * end) * smallest_iso, (1.0 + end * end) * peak ** (2.0 / 3.0), smallest_iso


def test_rigid_limits_are_exact():
    isoviscous, piezoviscous, smallest = rigid_solution()
    assert smallest == pytest.approx(2.448, abs=1e-3)  # Martin: w = 4.896 η0 u_e R/h_min
    assert (isoviscous, piezoviscous) == pytest.approx((3.0, 1.287), rel=1.5e-3, abs=0.0)
    assert moes(1e-5, 1e-3) * 1e-5 == pytest.approx(isoviscous, rel=1.5e-3, abs=0.0)


@pytest.mark.parametrize(
    ("load", "material", "expected"),
    [
        (1e8, 1e-9, 2.621 * 1e8**-0.2),
        (1e10, 1e4, 1.311 * 1e10**-0.125 * 1e4**0.75),
        (1e-3, 1e9, 1.287 * 1e9 ** (2 / 3)),
        (1e-6, 1.0, 3e6),
    ],
)
def test_each_asymptote_is_reached(load, material, expected):
    assert moes(load, material) == pytest.approx(expected, rel=0.01, abs=0.0)


def test_numerical_solution_reproduces_martin(numerical_film):
    isoviscous, _, smallest = rigid_solution()
    found = numerical_film(0.1, 0.0, rigid=True, cells=120)
    assert (found[0] * 0.1, found[1] * 0.1) == pytest.approx((smallest, isoviscous), rel=3e-3, abs=0.0)


@pytest.mark.parametrize(
    ("load", "material"),
    [(0.05, 15), (0.2, 0), (0.2, 8), (0.5, 15), (1, 0), (1, 8), (2, 4), (5, 0), (5, 4), (20, 0), (20, 4)],
)
def test_blend_is_near_the_full_solution(numerical_film, load, material):
    _, flow = numerical_film(load, material, cells=120)
    assert moes(load, material) == pytest.approx(flow, rel=0.055, abs=0.0)


@given(**powers)
@settings(deadline=None, max_examples=150)
def test_logarithmic_form_and_its_derivatives(log_load, log_material):
    load, material = 10.0**log_load, 10.0**log_material
    found, by_load, by_material = log_moes(math.log(load), math.log(material))
    with mpmath.workdps(40):
        exact = mpmath.log(formula(load, material))
        assert math.exp(found) == pytest.approx(float(mpmath.exp(exact)), rel=1e-12, abs=0.0)
        assert moes(load, material) == pytest.approx(float(mpmath.exp(exact)), rel=1e-12, abs=0.0)
        step = mpmath.mpf("1e-12")

        def slope(function):
            return float((mpmath.log(function(1 + step)) - mpmath.log(function(1 - step))) / (2 * step))

        assert by_load == pytest.approx(slope(lambda f: formula(load * f, material)), rel=1e-10, abs=1e-10)
        assert by_material == pytest.approx(slope(lambda f: formula(load, material * f)), rel=1e-10, abs=1e-10)


@given(**powers)
@settings(deadline=None, max_examples=100)
def test_film_shrinks_with_load_and_grows_with_viscosity_under_pressure(log_load, log_material):
    _, by_load, by_material = log_moes(log_load * math.log(10.0), log_material * math.log(10.0))
    assert -1.001 <= by_load < -0.02 and 0.0 <= by_material <= 0.75


def test_extreme_arguments_stay_finite():
    for log_load in (-700.0, -50.0, 0.0, 50.0, 700.0):
        for log_material in (-700.0, -50.0, 0.0, 50.0, 700.0):
            assert np.isfinite(log_moes(log_load, log_material)).all()


@pytest.mark.parametrize("number", [0, 1, 2], ids=["inner", "outer", "cage"])
@given(log_load=st.floats(-3.0, 5.5), log_speed=st.floats(-6.0, 1.0))
@settings(deadline=None, max_examples=40)
def test_prepared_law_is_the_formula(base, number, log_load, log_speed):
    interface, load, speed = base[number], 10.0**log_load, 10.0**log_speed
    height, by_speed, by_load = law.film_thickness(law.prepare("moes", interface), load, speed)
    d = mpmath.mpf

    def exact(load, speed):
        radius, modulus, oil = d(interface.rolling_radius), d(interface.modulus), interface.lubricant
        w = 3 * d(load) / (4 * d(interface.hertz.semi_axis_across) * mpmath.cbrt(d(load))) / (modulus * radius)
        doubled = 2 * d(oil.viscosity) * d(speed) / (modulus * radius)
        m, el = w / mpmath.sqrt(doubled), d(oil.pressure_viscosity) * modulus * mpmath.root(doubled, 4)
        return radius * mpmath.sqrt(doubled) * formula(m, el)

    with mpmath.workdps(40):
        assert height == pytest.approx(float(exact(load, speed)), rel=1e-12, abs=0.0)
        slope = mpmath.diff(lambda u: exact(load, u), d(speed), h=d(speed) * d("1e-13"))
        assert by_speed == pytest.approx(float(slope), rel=1e-9, abs=0.0)
        slope = mpmath.diff(lambda q: exact(q, speed), d(load), h=d(load) * d("1e-13"))
        assert by_load == pytest.approx(float(slope), rel=1e-8, abs=1e-12 * height / load)


def test_range_is_where_numerical_solutions_were_compared(base):
    prepared = law.prepare("moes", base[0])
    assert law.film_in_range(prepared, 1e-3, 0.4) and law.film_in_range(prepared, 3e4, 0.4)
    assert not law.film_in_range(prepared, 1e5, 0.4)  # M = 32
    assert not law.film_in_range(prepared, 1e3, 1.0)  # L = 16.9
