"""Asperities: their share of the load in 40 digits, and their friction against dense integration over the contact."""

import math

import mpmath
import numba
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from macroslip.contact.asperities import REFERENCES, asperity_patch, asperity_share, film_ratio_share, load_ratio
from macroslip.contact.film import masjedi_khonsari_moes

RATED_SURFACE_SPEED = 0.39594  # Ω r~_out at 20.463 rpm [m/s]
RADIUS, CONTOUR, HALF_LENGTH = 0.035, 0.41, 0.053
ACROSS, FRICTION, FULL_SLIP = 9e-4, 0.1, 1e-4
log_loads, log_speeds = st.floats(-6.0, 6.0), st.floats(-6.0, 1.0)


def formula(load, speed, material, roughness, hardness):
    """L_a/100 in high precision, exponents as decimals."""
    d = mpmath.mpf
    load, speed, material = d(load), d(speed), d(material)
    inside = 4470 * d(roughness) ** d("6.015") * d(hardness) ** d("1.168") * load ** d("0.485")
    inside *= speed ** d("-3.741") * material ** d("-2.898")
    per_cent = d("0.005") * load ** d("-0.408") * speed ** d("-0.088") * material ** d("0.103") * mpmath.log1p(inside)
    return per_cent / 100


@pytest.mark.parametrize("number", [0, 1, 2], ids=["inner", "outer", "cage"])
@given(log_load=log_loads, log_speed=log_speeds)
@settings(deadline=None, max_examples=60)
def test_load_ratio_is_the_formula(base, number, log_load, log_speed):
    interface, load, speed = base[number], 10.0**log_load, 10.0**log_speed
    d = mpmath.mpf
    radius, modulus, oil = d(interface.rolling_radius), d(interface.modulus), interface.lubricant
    with mpmath.workdps(40):
        w = 3 * d(load) / (4 * d(interface.hertz.semi_axis_across) * mpmath.cbrt(d(load))) / (modulus * radius)
        groups = (
            w, oil.viscosity * d(speed) / (modulus * radius), oil.pressure_viscosity * modulus,
            interface.roughness / radius, interface.hardness / modulus,
        )  # fmt: skip
        expected = float(formula(*groups))
    assert load_ratio(*(float(one) for one in groups)) == pytest.approx(expected, rel=1e-11, abs=1e-300)
    found = asperity_share("masjedi-khonsari", interface, load, speed, 1e-6)
    assert found == pytest.approx(min(1.0, expected), rel=1e-11, abs=1e-300)


@pytest.mark.parametrize("name", REFERENCES)
def test_share_is_one_for_any_load_speed_and_film_and_falls_with_speed(base, name):
    load, speed = np.geomspace(1e-6, 1e6, 41)[:, None], np.geomspace(1e-6, 10.0, 61)
    for interface in base:
        film = masjedi_khonsari_moes(interface, load, speed)
        found = asperity_share(name, interface, load, speed, film)
        assert found.shape == (41, 61) and found.min() >= 0.0 and found.max() <= 1.0
        assert np.diff(found, axis=1).max() <= 0.0
        assert (found.max() > 0.5) == (name != "none")
        smooth = interface._replace(roughness=0.0)
        assert asperity_share(name, smooth, load, speed, film).max() == 0.0


def test_limits_of_the_film_ratio(base):
    def share(film):
        return asperity_share("film-ratio", base[0], 1e4, 0.4, film)

    assert share(math.inf) == 0.0
    assert share(1e-15) == pytest.approx(1.0, abs=1e-7)
    assert film_ratio_share(np.array([0.992, 2.027, 3.08])) == pytest.approx([0.1, 0.01, 0.001], rel=0.01)
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
        asperity_share(name, base[0], 5e4, RATED_SURFACE_SPEED, height) for name in ("masjedi-khonsari", "film-ratio")
    )
    assert by_groups == pytest.approx(1.2e-3, rel=0.05) and by_film == pytest.approx(1.3e-4, rel=0.05)


def patch(load, share, sliding, curvature=0.0, spin=0.0, half_length=HALF_LENGTH, full_slip=FULL_SLIP):
    """`asperity_patch` for a load and slip v(ζ) = sliding + curvature ζ²/(2 R_d) − spin ζ."""
    across = ACROSS * np.cbrt(load)
    scale = 0.75 * FRICTION * share * load / across
    return asperity_patch(
        scale, full_slip, across, np.minimum(across, half_length), sliding, curvature / (2 * CONTOUR), spin
    )


def dense(load, share, sliding, curvature, spin, count=100001):
    """Force, second moment, skew and power by a fine midpoint rule over the stations."""
    across = ACROSS * load ** (1 / 3)
    half = min(across, HALF_LENGTH)
    z = (np.arange(count) + 0.5) / count * 2 * half - half
    slip = sliding + curvature * z**2 / (2 * CONTOUR) - spin * z
    per_length = 0.75 * load / across * (1 - (z / across) ** 2)
    part = FRICTION * share * per_length * np.clip(slip / FULL_SLIP, -1.0, 1.0) * (2 * half / count)
    return part.sum(), (part * z**2).sum(), (part * z).sum(), (part * slip).sum()


def speeds(largest):
    return st.floats(-largest, largest).map(lambda x: round(x, 9))


states = given(
    st.floats(0.0, 5.5).map(lambda x: 10.0**x), st.floats(1e-6, 1.0), st.tuples(speeds(0.05), speeds(30.0), speeds(0.6))
)


@states
@settings(deadline=None, max_examples=40)
def test_against_dense_integration(load, share, slip):
    found, expected = patch(load, share, *slip), dense(load, share, *slip)
    largest, across = FRICTION * share * load, ACROSS * load ** (1 / 3)
    assert found[0] == pytest.approx(expected[0], abs=1e-6 * largest)
    assert found[1] == pytest.approx(expected[1], abs=1e-6 * largest * across**2)
    assert found[2] == pytest.approx(expected[2], abs=1e-6 * largest * across)
    assert found[3] == pytest.approx(expected[3], rel=1e-5, abs=1e-12 * largest)


@states
@settings(deadline=None, max_examples=200)
def test_bounds_and_power(load, share, slip):
    force, second, skew, power = patch(load, share, *slip)
    half = min(ACROSS * load ** (1 / 3), HALF_LENGTH)
    largest = FRICTION * share * load * (1 + 1e-12)
    assert abs(force) <= largest and abs(second) <= largest * half**2 and abs(skew) <= largest * half
    assert power >= 0.0
    # ∫τ v dA = Δu F + κ/(2 R_d) ∫τ ζ² dA − s ∫τ ζ dA.
    parts = slip[0] * force, slip[1] / (2 * CONTOUR) * second, -slip[2] * skew
    assert power == pytest.approx(sum(parts), rel=1e-9, abs=1e-12 * sum(map(abs, parts)))


def test_by_hand():
    # Sliding all over: µ_b times the load asperities carry; the whole load is in the ellipse, ∫p ζ² dA = a²/5 · Q.
    across = ACROSS * 1e4 ** (1 / 3)
    force, second, skew, power = patch(1e4, 0.25, -0.2)
    assert (force, power) == pytest.approx((-250.0, 50.0), rel=1e-12)
    assert second == pytest.approx(-250.0 * across**2 / 5, rel=1e-12) and skew == pytest.approx(0.0, abs=1e-9)
    # Half of the full slip, half of the force.
    assert patch(1e4, 0.25, 5e-5)[0] == pytest.approx(125.0, rel=1e-12)
    assert patch(1e4, 0.25, 0.0) == pytest.approx((0.0, 0.0, 0.0, 0.0), abs=1e-200)
    assert patch(1e4, 0.0, 0.2, -12.0, 0.2) == (0.0, 0.0, 0.0, 0.0)


def test_friction_along_the_roller_by_hand():
    """Spin alone turns: both halves pull against each other, and ∫|ζ| p dA = 3a/8 · Q; slip that rises along the roller
    has ∫ζ² p dA = a²/5 · Q where asperities still stick."""
    across = ACROSS * 1e4 ** (1 / 3)
    force, second, skew, power = patch(1e4, 1.0, 0.0, 0.0, 0.4, full_slip=1e-12)
    assert skew == pytest.approx(-0.1 * 1e4 * 0.375 * across, rel=1e-6)
    assert power == pytest.approx(0.4 * 0.1 * 1e4 * 0.375 * across, rel=1e-6)
    assert (force, second) == pytest.approx((0.0, 0.0), abs=1e-6)
    spin = 0.5 * FULL_SLIP / across
    _, _, skew, power = patch(1e4, 1.0, 0.0, 0.0, spin)
    assert skew == pytest.approx(-0.1 * 1e4 * spin / FULL_SLIP * across**2 / 5, rel=1e-12)
    assert power == pytest.approx(-skew * spin, rel=1e-12)
    # Curvature alone drives one way at all stations: ∫ζ² p dA, and ∫ζ⁴ p dA = 3a⁴/35 · Q.
    bend = 0.5 * FULL_SLIP / across**2
    force, second, skew, power = patch(1e4, 1.0, 0.0, 2 * CONTOUR * bend)
    assert force == pytest.approx(0.1 * 1e4 * bend / FULL_SLIP * across**2 / 5, rel=1e-12)
    assert second == pytest.approx(0.1 * 1e4 * bend / FULL_SLIP * across**4 * 3 / 35, rel=1e-12)
    assert power == pytest.approx(second * bend, rel=1e-12) and skew == pytest.approx(0.0, abs=1e-12)


def test_contact_ends_with_the_roller():
    x = HALF_LENGTH / (ACROSS * 100.0)
    assert patch(1e6, 1.0, 0.1)[0] == pytest.approx(0.1 * 1e6 * 0.5 * (3 * x - x**3), rel=1e-12)


def test_arrays_and_compiled_numbers_agree():
    rng = np.random.default_rng(3)
    load, share = 10.0 ** rng.uniform(0.0, 5.5, 200), rng.uniform(0.0, 1.0, 200)
    slips = [rng.uniform(-one, one, 200) * (rng.random(200) > 0.2) for one in (0.01, 30.0, 0.6)]
    with np.errstate(all="raise", under="ignore"):
        found = np.transpose(patch(load, share, *slips))
    compiled = numba.njit(error_model="numpy")(asperity_patch)
    for k, row in enumerate(found):
        across = ACROSS * np.cbrt(load[k])
        arguments = 0.75 * FRICTION * share[k] * load[k] / across, FULL_SLIP, across, min(across, HALF_LENGTH)
        expected = compiled(*arguments, slips[0][k], slips[1][k] / (2 * CONTOUR), slips[2][k])
        assert row == pytest.approx(expected, rel=1e-12, abs=1e-12 * arguments[0])
