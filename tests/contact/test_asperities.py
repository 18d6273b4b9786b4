"""Asperities: their share of the load in 40 digits, and its limits."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from macroslip.contact.asperities import (
    REFERENCES,
    asperity_share,
    film_ratio_share,
    load_group,
    load_is_in_range,
    load_ratio,
)
from macroslip.contact.film import masjedi_khonsari_moes

RATED_SURFACE_SPEED = 0.39594  # Ω r~_out at 20.463 rpm [m/s]
log_loads, log_speeds = st.floats(-6.0, 6.0), st.floats(-6.0, 1.0)


def formula(load, speed, material, roughness, hardness):
    """L_a/100 in high precision, exponents as decimals."""
    d = mpmath.mpf
    load, speed, material = d(load), d(speed), d(material)
    inside = 4470 * d(roughness) ** d("6.015") * d(hardness) ** d("1.168") * load ** d("0.485")
    inside *= speed ** d("-3.741") * material ** d("-2.898")
    per_cent = (
        d("0.005")
        * load ** d("-0.408")
        * speed ** d("-0.088")
        * material ** d("0.103")
        * mpmath.log1p(inside)
    )
    return per_cent / 100


@pytest.mark.parametrize("number", [0, 1, 2], ids=["inner", "outer", "cage"])
@given(log_load=log_loads, log_speed=log_speeds)
@settings(deadline=None, max_examples=60)
def test_load_ratio_is_the_formula(base, number, log_load, log_speed):
    interface, load, speed = base[number], 10.0**log_load, 10.0**log_speed
    d = mpmath.mpf
    radius, modulus, oil = d(interface.rolling_radius), d(interface.modulus), interface.lubricant
    with mpmath.workdps(40):
        w = (
            3
            * d(load)
            / (4 * d(interface.hertz.semi_axis_across) * mpmath.cbrt(d(load)))
            / (modulus * radius)
        )
        groups = (
            w, oil.viscosity * d(speed) / (modulus * radius), oil.pressure_viscosity * modulus,
            interface.roughness / radius, interface.hardness / modulus,
        )  # fmt: skip
        expected = float(formula(*groups))
    assert load_ratio(*(float(group) for group in groups)) == pytest.approx(
        expected, rel=1e-11, abs=1e-300
    )
    share = asperity_share("masjedi-khonsari", interface, load, speed, 1e-6)
    by_film = float(film_ratio_share(1e-6 / interface.roughness))
    if 4e-5 <= w <= 4.5e-4:
        assert share == pytest.approx(min(1.0, expected), rel=1e-11, abs=1e-300)
    elif w < 2e-5 or w > 5e-4:
        assert share == pytest.approx(min(1.0, expected, by_film), rel=1e-11, abs=1e-300)


@pytest.mark.parametrize(
    ("film_ratio", "speed", "by_film"),
    [(16.5, 0.4, 5e-16), (7.0, 0.15, 2e-7), (3.8, 0.15, 2e-4)],
)
def test_idle_contacts_have_no_more_than_their_film_ratio_gives(base, film_ratio, speed, by_film):
    """W of an idle contact is 1.1e-6, 18 times below the range, where the load ratio hardly knows Λ: it has 8.5e-4 to .4."""
    inner, load = base[0], 30.0
    assert load_group(inner, load) == pytest.approx(1.1e-6, rel=0.01)
    assert not load_is_in_range(inner, load) and load_is_in_range(inner, 5e3)
    share = asperity_share("masjedi-khonsari", inner, load, speed, film_ratio * inner.roughness)
    assert share == pytest.approx(by_film, rel=0.35)
    assert share == asperity_share("film-ratio", inner, load, speed, film_ratio * inner.roughness)


@settings(deadline=None)
@given(log_load=st.floats(-6.0, 6.5), log_speed=log_speeds, log_film=st.floats(-8.0, -4.0))
def test_outside_the_range_of_w_no_more_than_the_film_ratio_gives(
    base, log_load, log_speed, log_film
):
    states = 10.0**log_load, 10.0**log_speed, 10.0**log_film
    for interface in base[:2]:
        by_film, share = (
            asperity_share(law, interface, *states) for law in ("film-ratio", "masjedi-khonsari")
        )
        assert load_is_in_range(interface, states[0]) or share <= by_film


def test_the_share_has_no_step_at_the_ends_of_its_range(base):
    load = np.geomspace(1e2, 1e6, 200_001)
    film = masjedi_khonsari_moes(base[0], load, 0.15)
    share = asperity_share("masjedi-khonsari", base[0], load, 0.15, film)
    # Over a hundredth of the way between two loads it changes by a hundredth.
    far, near = np.abs(share[200:] - share[:-200]).max(), np.abs(share[2:] - share[:-2]).max()
    assert near < 0.011 * far


@pytest.mark.parametrize("name", REFERENCES)
def test_share_is_one_for_any_load_speed_and_film_and_falls_with_speed(base, name):
    load, speed = np.geomspace(1e-6, 1e6, 41)[:, None], np.geomspace(1e-6, 10.0, 61)
    for interface in base:
        film = masjedi_khonsari_moes(interface, load, speed)
        share = asperity_share(name, interface, load, speed, film)
        assert share.shape == (41, 61) and share.min() >= 0.0 and share.max() <= 1.0
        assert np.diff(share, axis=1).max() <= 0.0
        assert (share.max() > 0.5) == (name != "none")
        smooth = interface._replace(roughness=0.0)
        assert asperity_share(name, smooth, load, speed, film).max() == 0.0


def test_limits_of_the_film_ratio(base):
    def share(film):
        return asperity_share("film-ratio", base[0], 1e4, 0.4, film)

    assert share(math.inf) == 0.0
    assert share(1e-15) == pytest.approx(1.0, abs=1e-7)
    assert film_ratio_share(np.array([0.992, 2.027, 3.08])) == pytest.approx(
        [0.1, 0.01, 0.001], rel=0.01
    )
    assert share(2 * base[0].roughness) == pytest.approx(film_ratio_share(2.0), rel=1e-14)


def test_limits_of_the_load_ratio(base):
    def share(interface, load, speed):
        return asperity_share("masjedi-khonsari", interface, load, speed, 1e-6)

    assert share(base[0], 2e4, 1e-3) == 1.0  # far below the lowest speed of its range
    assert share(base[0], 2e4, 10.0) < 1e-7
    assert share(base[2], 32.0, RATED_SURFACE_SPEED / 2) < 1e-5


def test_raceways_at_rated_speed_run_on_a_nearly_full_film(base):
    """Λ of 4: a share of a thousandth by the load ratio and less by Λ."""
    height = masjedi_khonsari_moes(base[0], 5e4, RATED_SURFACE_SPEED)
    by_groups, by_film = (
        asperity_share(name, base[0], 5e4, RATED_SURFACE_SPEED, height)
        for name in ("masjedi-khonsari", "film-ratio")
    )
    assert by_groups == pytest.approx(1.2e-3, rel=0.05) and by_film == pytest.approx(
        1.3e-4, rel=0.05
    )
