"""Asperity load share: the formulas in 40 digits, their limits, and no overflow anywhere."""

import math

import mpmath
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from macroslip.errors import InputError
from macroslip.film import film_law as law
from macroslip.film.asperity_load import (
    AsperityLoad,
    asperity_share,
    film_ratio_share,
    load_ratio,
    names,
    prepare,
    reference,
)

RATED_SURFACE_SPEED = 0.39594  # Ω r~_out at 20.463 rpm [m/s]
KINDS = ["film-ratio", "masjedi-khonsari", "none"]
log_loads, log_speeds, log_films = st.floats(-6.0, 6.0), st.floats(-6.0, 1.0), st.floats(-12.0, 0.0)


def formula(load, speed, material, roughness, hardness):
    """L_a/100 in high precision, exponents as decimals."""
    d = mpmath.mpf
    load, speed, material = d(load), d(speed), d(material)
    inside = 4470 * d(roughness) ** d("6.015") * d(hardness) ** d("1.168") * load ** d("0.485")
    inside *= speed ** d("-3.741") * material ** d("-2.898")
    per_cent = d("0.005") * load ** d("-0.408") * speed ** d("-0.088") * material ** d("0.103") * mpmath.log1p(inside)
    return per_cent / 100


@given(
    st.floats(-12.0, -2.0),
    st.floats(-18.0, -8.0),
    st.floats(2000.0, 9000.0),
    st.floats(-8.0, -3.5),
    st.floats(0.003, 0.05),
)
@settings(deadline=None, max_examples=150)
def test_load_ratio_is_the_formula(log_load, log_speed, material, log_roughness, hardness):
    groups = 10.0**log_load, 10.0**log_speed, material, 10.0**log_roughness, hardness
    with mpmath.workdps(40):
        assert load_ratio(*groups) == pytest.approx(float(formula(*groups)), rel=1e-11, abs=1e-300)


def test_load_ratio_is_a_share_over_its_range_where_films_are_not_far_too_thin():
    for load in (2e-5, 1e-4, 5e-4):
        for speed in (1e-11, 1e-10):
            shares = [load_ratio(load, speed, 4846.0, roughness, 0.02) for roughness in (0.0, 1e-6, 1e-5, 2e-5)]
            assert shares[0] == 0.0 and shares == sorted(shares) and shares[-1] < 1.0


@pytest.mark.parametrize("number", [0, 1, 2], ids=["inner", "outer", "cage"])
@given(log_load=log_loads, log_speed=log_speeds)
@settings(deadline=None, max_examples=60)
def test_prepared_load_ratio_is_the_formula(base, number, log_load, log_speed):
    interface, load, speed = base[number], 10.0**log_load, 10.0**log_speed
    d = mpmath.mpf
    radius, modulus, oil = d(interface.rolling_radius), d(interface.modulus), interface.lubricant
    with mpmath.workdps(40):
        w = 3 * d(load) / (4 * d(interface.hertz.semi_axis_across) * mpmath.cbrt(d(load))) / (modulus * radius)
        expected = formula(
            w, oil.viscosity * d(speed) / (modulus * radius), oil.pressure_viscosity * modulus,
            interface.roughness / radius, interface.hardness / modulus,
        )  # fmt: skip
    found = asperity_share(prepare("masjedi-khonsari", interface), load, speed, 1e-6)
    assert found == pytest.approx(min(1.0, float(expected)), rel=1e-11, abs=1e-300)


@pytest.mark.parametrize("number", [0, 1, 2], ids=["inner", "outer", "cage"])
@pytest.mark.parametrize("kind", KINDS)
@given(log_load=log_loads, log_speed=log_speeds, log_film=log_films)
@settings(deadline=None, max_examples=80)
def test_share_is_one_for_any_load_speed_and_film(base, number, kind, log_load, log_speed, log_film):
    for interface in (base[number], base[number]._replace(roughness=0.0)):
        found = asperity_share(prepare(kind, interface), 10.0**log_load, 10.0**log_speed, 10.0**log_film)
        assert 0.0 <= found <= 1.0
        if interface.roughness == 0.0 or kind == "none":
            assert found == 0.0


@pytest.mark.parametrize("kind", KINDS[:2])
@given(log_load=log_loads, log_speed=st.floats(-6.0, 0.9))
@settings(deadline=None, max_examples=80)
def test_share_falls_with_speed(base, kind, log_load, log_speed):
    share, film = prepare(kind, base[0]), law.prepare("masjedi-khonsari-moes", base[0])

    def at(speed):
        return asperity_share(share, 10.0**log_load, speed, law.film_thickness(film, 10.0**log_load, speed)[0])

    assert at(10.0**log_speed * 1.25) <= at(10.0**log_speed)


def test_limits_of_the_film_ratio(base):
    law_ = prepare("film-ratio", base[0])
    assert asperity_share(law_, 1e4, 0.4, math.inf) == 0.0
    assert asperity_share(law_, 1e4, 0.4, 1e-15) == pytest.approx(1.0, abs=1e-7)
    assert [film_ratio_share(x) for x in (0.992, 2.027, 3.08)] == pytest.approx([0.1, 0.01, 0.001], rel=0.01)
    assert asperity_share(law_, 1e4, 0.4, 2 * base[0].roughness) == film_ratio_share(2.0)


def test_limits_of_the_load_ratio(base):
    law_ = prepare("masjedi-khonsari", base[0])
    assert asperity_share(law_, 2e4, 1e-3, 1e-6) == 1.0  # far below the lowest speed of its range
    assert asperity_share(law_, 2e4, 10.0, 1e-6) < 1e-7
    assert asperity_share(prepare("masjedi-khonsari", base[2]), 32.0, RATED_SURFACE_SPEED / 2, 1e-4) < 1e-5


def test_raceways_at_rated_speed_run_on_a_nearly_full_film(base):
    """Λ of 4: a share of a thousandth by the load ratio and less by Λ."""
    height = law.film_thickness(law.prepare("masjedi-khonsari-moes", base[0]), 5e4, RATED_SURFACE_SPEED)[0]
    by_groups, by_film = (
        asperity_share(prepare(kind, base[0]), 5e4, RATED_SURFACE_SPEED, height)
        for kind in ("masjedi-khonsari", "film-ratio")
    )
    assert by_groups == pytest.approx(1.2e-3, rel=0.05) and by_film == pytest.approx(1.3e-4, rel=0.05)


def test_names_share_one_type_and_an_unknown_one_is_reported(base):
    assert names() == KINDS
    assert {type(prepare(kind, base[0])) for kind in KINDS} == {AsperityLoad}
    assert len({tuple(map(type, prepare(kind, base[0]))) for kind in KINDS}) == 1
    assert "10.1115/1.4005514" in reference("masjedi-khonsari")
    with pytest.raises(
        InputError, match="there is no asperity_load law 'lambda'. Allowed: film-ratio, masjedi-khonsari"
    ):
        prepare("lambda", base[0])
