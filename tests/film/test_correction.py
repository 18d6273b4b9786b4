"""Starvation and inlet heating on any film law, the user's own among them."""

import math
from typing import NamedTuple

import mpmath
import numba
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from macroslip.compiled import jit
from macroslip.errors import InputError
from macroslip.film import film_law as law
from macroslip.film.correction import CorrectedFilm, inlet_heating_factor, prepare_film

log_loads, log_speeds = st.floats(-2.0, 5.0), st.floats(-6.0, 1.0)


class Square(NamedTuple):
    """A user's law: h = scale u²/Q."""

    scale: float


@jit
def square_thickness(law, load, entrainment_speed):
    height = law.scale * entrainment_speed**2 / load
    return height, 2.0 * height / entrainment_speed, -height / load


@jit
def square_in_range(law, load, entrainment_speed):
    return load < 10.0


@pytest.fixture(scope="module", autouse=True)
def square(package_laws):
    law.register(
        "square", Square, reference="a test", prepare=lambda interface: Square(2e-3), thickness=square_thickness,
        in_range=square_in_range, range_notes=lambda interface: ["always"],
    )  # fmt: skip


def test_heating_factor_at_its_ends_and_in_between():
    assert inlet_heating_factor(0.0) == 1.0
    assert inlet_heating_factor(1.0) == pytest.approx(1 / 1.1, rel=1e-15)
    # Halves the film where 0.1 L^0.64 = 1.
    assert inlet_heating_factor(10.0 ** (1 / 0.64)) == pytest.approx(0.5, rel=1e-14)


def test_heating_is_of_the_size_bearing_makers_give(base):
    """1/(1 + 1.84e-9 (n d_m)^1.28 ν^0.64) with n in rpm, d_m in mm and ν in mm²/s has the same powers of u and ν."""
    maker = 1.84e-9 * (20.463 * 735.0) ** 1.28 * 600.0**0.64
    own = 1.0 / inlet_heating_factor(0.54 * 0.056 * 0.39594**2 / 0.125) - 1.0
    assert 0.3 < own / maker < 3.0


def test_nothing_to_correct_gives_the_law_itself(base):
    assert type(prepare_film("masjedi-khonsari", base[0])) is type(law.prepare("masjedi-khonsari", base[0]))
    assert prepare_film("masjedi-khonsari", base[0]) == law.prepare("masjedi-khonsari", base[0])
    assert type(prepare_film("masjedi-khonsari", base[0], starvation=0.7)) is CorrectedFilm


@pytest.mark.parametrize("name", ["masjedi-khonsari", "moes", "masjedi-khonsari-moes", "square"])
@given(log_load=log_loads, log_speed=log_speeds, starvation=st.floats(0.05, 1.0), heating=st.booleans())
@settings(deadline=None, max_examples=40)
def test_factors_and_derivatives_on_every_law(base, name, log_load, log_speed, starvation, heating):
    load, speed = 10.0**log_load, 10.0**log_speed
    plain = law.film_thickness(law.prepare(name, base[0]), load, speed)
    found = law.film_thickness(prepare_film(name, base[0], starvation=starvation, inlet_heating=heating), load, speed)
    d = mpmath.mpf
    with mpmath.workdps(30):

        def factor(u):
            group = d(0.54) * d(0.056) / d(0.125) * u * u
            return starvation / (1 + d("0.1") * group ** d("0.64")) if heating else d(starvation)

        at = factor(d(speed))
        slope = mpmath.diff(factor, d(speed), h=d(speed) * d("1e-10"))
        assert found[0] == pytest.approx(float(at * plain[0]), rel=1e-13, abs=0.0)
        assert found[1] == pytest.approx(float(at * plain[1] + slope * plain[0]), rel=1e-9, abs=0.0)
        assert found[2] == pytest.approx(float(at * plain[2]), rel=1e-13, abs=0.0)
    assert found[0] <= plain[0]


def test_range_is_that_of_the_law_inside(base):
    corrected = prepare_film("square", base[0], starvation=0.5)
    assert law.film_in_range(corrected, 9.0, 1.0) and not law.film_in_range(corrected, 11.0, 1.0)
    assert law.film_range_notes("square", base[:1]) == ["inner: always"]


@pytest.mark.slow
def test_a_kernel_compiles_for_the_wrapper_and_what_it_holds(base):
    @numba.njit
    def kernel(film, load, speed):
        height, by_speed, by_load = law.film_thickness(film, load, speed)
        return height + by_speed + by_load, law.film_in_range(film, load, speed)

    for name in ("square", "masjedi-khonsari-moes"):
        for film in (
            prepare_film(name, base[0]),
            prepare_film(name, base[0], starvation=0.7),
            prepare_film(name, base[0], inlet_heating=True),
        ):
            expected = math.fsum(law.film_thickness(film, 5.0, 0.3)), law.film_in_range(film, 5.0, 0.3)
            assert kernel(film, 5.0, 0.3) == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("starvation", [0.0, -0.1, 1.01, math.nan])
def test_a_starvation_factor_outside_its_range_is_reported(base, starvation):
    with pytest.raises(InputError, match="^starvation: the starvation factor is .* Allowed: a number above 0 and at"):
        prepare_film("moes", base[0], starvation=starvation)
