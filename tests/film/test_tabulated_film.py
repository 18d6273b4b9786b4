"""Film laws given as functions of arrays: their tables against the formulas, and what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip import BearingLoads, Case, InputError, Laws, simulate
from macroslip.film import film_law
from macroslip.film.tabulated_film import register_function, tabulated_film
from macroslip.roller.model import interfaces


def dowson_higginson(interface, load, speed):
    """H = 2.65 U^0.7 G^0.54 W^-0.13 of the equivalent line contact."""
    radius, modulus, oil = interface.rolling_radius, interface.modulus, interface.lubricant
    width = interface.hertz.semi_axis_across * load ** (1.0 / 3.0)
    group = 0.75 * load / width / (modulus * radius)
    speed_group = oil.viscosity * speed / (modulus * radius)
    return 2.65 * radius * speed_group**0.7 * (oil.pressure_viscosity * modulus) ** 0.54 * group**-0.13


def bent(interface, load, speed):
    """A film whose logarithm is no plane: a sum of powers."""
    return 1e-6 * speed**0.7 * load**-0.05 + 2e-7 * speed**0.3 + 1e-9 / (1.0 + (load / 300.0) ** 0.5)


@pytest.fixture(scope="module")
def inner(bearing, lubricant):
    return interfaces(bearing, lubricant)[0]


@pytest.fixture(scope="module", params=[dowson_higginson, bent])
def law(request, inner):
    return request.param, tabulated_film("tried", request.param, inner)


@pytest.fixture(scope="module")
def powers(inner):
    return tabulated_film("tried", dowson_higginson, inner)


@given(load=st.floats(-4.0, 8.0).map(lambda x: 10.0**x), speed=st.floats(-7.0, 3.0).map(lambda x: 10.0**x))
def test_powers_are_exact_inside_and_outside_of_the_table(inner, powers, load, speed):
    film, by_speed, by_load = film_law.film_thickness(powers, load, speed)
    assert film == pytest.approx(dowson_higginson(inner, load, speed), rel=1e-9)
    assert by_speed == pytest.approx(0.7 * film / speed, rel=1e-7)
    assert by_load == pytest.approx(-0.13 * 2.0 / 3.0 * film / load, rel=1e-6)


@given(load=st.floats(-2.0, 6.0).map(lambda x: 10.0**x), speed=st.floats(-5.0, 1.0).map(lambda x: 10.0**x))
def test_values_and_derivatives(law, inner, load, speed):
    function, table = law
    film, by_speed, by_load = film_law.film_thickness(table, load, speed)
    assert film == pytest.approx(function(inner, load, speed), rel=1e-6)
    for derivative, at in (
        (by_speed, lambda part: (load, speed * part)),
        (by_load, lambda part: (load * part, speed)),
    ):
        step = 1e-4
        ends = [function(inner, *at(1.0 + sign * step)) for sign in (1.0, -1.0)]
        place = speed if derivative is by_speed else load
        assert derivative == pytest.approx(
            (ends[0] - ends[1]) / (2.0 * step * place), rel=1e-3, abs=1e-6 * film / place
        )


@pytest.mark.parametrize(
    ("function", "words"),
    [
        (lambda interface, load, speed: 1e-6, "returns one of shape ()"),
        (lambda interface, load, speed: 1e-6 - 1e-9 * load, "a positive number"),
        (lambda interface, load, speed: np.where(load > 500.0, 1e-6, 2e-6), "without jumps"),
        (lambda interface, load, speed: np.full(load.shape, math.nan), "the film is nan m"),
    ],
)
def test_refused(inner, function, words):
    with pytest.raises(InputError) as caught:
        tabulated_film("mine", function, inner)
    assert words in str(caught.value) and "film law mine, inner" in str(caught.value)


def test_a_case_with_a_function():
    """Against the same formula of the package: the paper's own film law as a function."""
    mine, theirs = "as-a-function", "masjedi-khonsari"

    def as_a_function(interface, load, speed):
        law = film_law.prepare(theirs, interface)
        one = np.vectorize(lambda load, speed: film_law.film_thickness(law, load, speed)[0])
        return one(load, speed)

    register_function(mine, as_a_function, reference="none")
    try:
        loads = BearingLoads.constant([0.0, -300e3, 100e3], 1.5, 20.0)
        found, expected = (simulate(Case(loads=loads, laws=Laws(film=name), rollers=[3])) for name in (mine, theirs))
    finally:
        film_law.remove(mine)
    np.testing.assert_allclose(found.energy, expected.energy, rtol=1e-4)
