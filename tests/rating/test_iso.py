"""Equations of the standards: their own marks, the load integrals behind their constants, and their limits."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from macroslip.bearing.load_ratings import geometry_factor
from macroslip.rating import iso
from macroslip.rating.iso import (
    LAMINAE,
    REDUCTION,
    damage_series,
    life_modification,
    reference_life,
    ring_ratings,
)


def test_static_equivalent_load():
    assert iso.static_equivalent_load(300e3, 0.0, 2.2) == 300e3
    assert (
        iso.static_equivalent_load(0.0, 100e3, 2.2)
        == iso.static_equivalent_load(0.0, -100e3, 2.2)
        == pytest.approx(220e3)
    )
    np.testing.assert_allclose(
        iso.static_equivalent_load([1.0, 2.0], [-3.0, 4.0], 2.0), [7.0, 10.0]
    )


def test_static_safety():
    assert iso.static_safety(16300e3, 4075e3) == pytest.approx(4.0)
    assert math.isinf(iso.static_safety(16300e3, 0.0))


def test_equivalent_load_is_continuous_with_the_standards_factors():
    # e = 1.5 tan, Y1 = 0.45 cot, Y2 = 0.67 cot: at Fa = e Fr both branches give 1.675 Fr.
    alpha = math.radians(11.31)
    factors = 1.5 * math.tan(alpha), 0.45 / math.tan(alpha), 0.67 / math.tan(alpha)
    below, above = iso.dynamic_equivalent_load(
        1.0, factors[0] * np.array([1 - 1e-12, 1 + 1e-12]), *factors
    )
    assert below == pytest.approx(1 + 1.5 * 0.45, rel=1e-9)
    assert above == pytest.approx(below, rel=1e-9)
    assert iso.dynamic_equivalent_load(1.0, 0.0, *factors) == 1.0
    assert iso.dynamic_equivalent_load(0.0, -1.0, *factors) == pytest.approx(factors[2])


def test_basic_life():
    assert iso.basic_life(8502e3, 8502e3) == 1e6
    assert iso.basic_life(2.0, 1.0) == pytest.approx(1e6 * 2 ** (10 / 3))
    assert math.isinf(iso.basic_life(1.0, 0.0))


@given(st.lists(st.tuples(st.floats(1e3, 1e6), st.floats(1e-3, 1e3)), min_size=1, max_size=10))
def test_mean_load_has_the_life_of_palmgren_and_miner(parts):
    load, turns = np.array(parts).T
    mean = iso.mean_equivalent_load(load, turns)
    assert turns.sum() / iso.basic_life(1e6, mean) == pytest.approx(
        np.sum(turns / iso.basic_life(1e6, load)), rel=1e-9
    )
    assert load.min() * (1 - 1e-12) <= mean <= load.max() * (1 + 1e-12)


def test_mean_load_of_a_shaft_that_stands():
    assert math.isnan(iso.mean_equivalent_load([1.0, 2.0], [0.0, 0.0]))


def test_reference_viscosity():
    at = 2 * math.pi / 60
    # Both branches of the standard meet near 1000 rpm: 45000 n^-0.83 and 4500 n^-0.5.
    assert iso.reference_viscosity(999.999 * at, 0.1) == pytest.approx(
        iso.reference_viscosity(1000.001 * at, 0.1), rel=0.03
    )
    assert iso.reference_viscosity(-20 * at, 0.7454) == iso.reference_viscosity(20 * at, 0.7454)
    # Written out: 45000 20^-0.83 100^-0.5 and 4500 2500^-0.5 100^-0.5.
    assert iso.reference_viscosity(20 * at, 0.1) * 1e6 == pytest.approx(
        4500 * math.exp(-0.83 * math.log(20)), rel=1e-12
    )
    assert iso.reference_viscosity(2500 * at, 0.1) * 1e6 == pytest.approx(9.0, rel=1e-12)


def test_modification_factor_has_the_limits_of_the_standards_figure():
    # Without fatigue limit or cleanliness all curves begin at 0.1; the one for the thinnest film stays there.
    for kappa in (0.1, 0.3, 0.5, 1.0, 2.0, 4.0):
        assert life_modification(kappa, 1.0, 0.0) == pytest.approx(0.1, rel=1e-12)
        assert life_modification(kappa, 1.0, 1e6) == (50.0 if kappa > 0.1 else 0.1)
    # Each curve has a pole where (1.5859 - A/kappa^B)(e_C C_u/P)^0.4 is 1; near it the factor is at its ceiling.
    pole = (1.0 / (1.5859 - 1.2348)) ** 2.5
    assert life_modification(1.0, 1.0, pole * 0.999) == 50.0
    assert life_modification(1.0, 1.0, 0.05 * pole) < 50.0
    # The branches meet at kappa 0.4 and 1.
    ratio = np.array([0.05, 0.2, 1.0])
    for kappa in (0.4, 1.0):
        below, above = (life_modification(kappa + side * 1e-9, 0.6, ratio) for side in (-1, 1))
        np.testing.assert_allclose(below, above, rtol=2e-3)
    assert np.array_equal(life_modification(7.0, 0.6, ratio), life_modification(4.0, 0.6, ratio))
    assert (
        np.isnan(life_modification(0.09, 1.0, ratio)).all()
        and np.isnan(life_modification(math.nan, 1.0, ratio)).all()
    )


@given(st.floats(0.1, 4.0), st.floats(0.01, 1.0), st.floats(1e-3, 5.0))
def test_cleaner_thicker_and_lighter_is_never_worse(kappa, contamination, ratio):
    factor = life_modification(kappa, contamination, ratio)
    assert 0.1 <= factor <= 50.0
    # The standard's branches meet but for rounding of their coefficients.
    assert life_modification(min(4.0, 1.1 * kappa), contamination, ratio) >= factor * (1 - 2e-3)
    assert life_modification(kappa, min(1.0, 1.1 * contamination), ratio) >= factor
    assert life_modification(kappa, contamination, 1.1 * ratio) >= factor


def lamina_loads(load, semi_axis, length):
    """Load per length on the laminae from the middle to one end, times the length: Hertz' parabola, integrated."""
    count = LAMINAE // 2
    edges = np.linspace(0.0, 0.5 * length, count + 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        relative = np.minimum(edges / np.where(load > 0.0, semi_axis, np.inf)[..., None], 1.0)
    reached = 1.5 * relative - 0.5 * relative**3
    share, total = np.diff(reached, axis=-1), reached[..., -1:]
    return (
        load[..., None]
        * np.divide(share, total, out=np.full_like(share, 1 / count), where=total > 0.0)
        * count
    )


def ring_damage(load, rating, *, stationary):
    """The standard's sums over rollers and laminae, array by array."""
    exponent = 4.5 if stationary else 4.0
    return np.mean(np.mean((load / rating) ** exponent, axis=-2) ** (4.5 / exponent), axis=-1)


def load_integral(power):
    """Mean over the circumference of cos^(1.1 power) in the loaded half."""
    return quad(lambda angle: math.cos(angle) ** (1.1 * power), -math.pi / 2, math.pi / 2)[0] / (
        2 * math.pi
    )


def test_the_standards_constants_are_load_integrals():
    radial = quad(lambda angle: math.cos(angle) ** 2.1, -math.pi / 2, math.pi / 2)[0] / (
        2 * math.pi
    )
    inner, outer = load_integral(4.0) ** (1 / 4), load_integral(4.5) ** (1 / 4.5)
    # The standard's come from tables of these integrals with four digits and an exponent between 1.08 and 10/9.
    assert radial / inner == pytest.approx(0.378, rel=4e-3)
    assert radial / outer == pytest.approx(0.364, rel=4e-3)
    assert outer / inner == pytest.approx(1.038, rel=4e-3)


@pytest.mark.parametrize("gamma", [0.05, 0.09, 0.15])
@pytest.mark.parametrize("rows", [1, 2])
def test_a_bearing_loaded_over_half_its_circumference_lives_as_iso_281_has_it(gamma, rows):
    # Load C on zero clearance: a million revolutions, whatever the number of rows and the ratio of diameters.
    count, alpha, rating = 720, 0.2, 8e6
    angle = 2 * np.pi * (np.arange(count) + 0.5) / count
    shape = np.maximum(np.cos(angle), 0.0) ** 1.1
    load = shape * rating / rows / (math.cos(alpha) * np.sum(shape * np.cos(angle)))
    inner, outer = ring_ratings(rating, rows, count, alpha, gamma)
    damages = [
        ring_damage(load[:, None], inner, stationary=False),
        ring_damage(load[:, None], outer, stationary=True),
    ]
    life = reference_life(np.repeat(damages, rows))
    assert life == pytest.approx(1e6, rel=0.02)
    # Twice the load: the exponent of the reference life is 4.
    doubled = [ring_damage(2 * load[:, None], inner, stationary=False),
               ring_damage(2 * load[:, None], outer, stationary=True)]  # fmt: skip
    assert reference_life(np.repeat(doubled, rows)) == pytest.approx(life / 16, rel=1e-12)


def test_ring_ratings_give_back_the_geometry_factor():
    # Lundberg and Palmgren: Q_ci/Q_ce is ((1 - gamma)/(1 + gamma))^(143/108), and the inner ring is the weaker one.
    for gamma in (0.02, 0.1, 0.3):
        inner, outer = ring_ratings(1.0, 1, 1, 0.0, gamma)
        assert inner / outer == pytest.approx(((1 - gamma) / (1 + gamma)) ** (143 / 108), rel=2e-3)
        # 207.9 lambda nu gamma^(2/9) (1 - gamma)^(29/27)/(1 + gamma)^(1/4) is the inner ring's own rating.
        own = 207.9 * REDUCTION * gamma ** (2 / 9) * (1 - gamma) ** (29 / 27) / (1 + gamma) ** 0.25
        assert inner * geometry_factor(gamma) * 0.378 == pytest.approx(own, rel=2e-3)


def test_laminae_carry_the_load_of_a_hertz_ellipse():
    length, axis, load = 0.1, 0.03, 5e4
    loads = lamina_loads(np.array([load]), np.array([axis]), length)[0]
    edges = np.linspace(0, length / 2, LAMINAE // 2 + 1)
    for k, (start, end) in enumerate(itertools.pairwise(edges)):

        def per_length(x):
            return 0.75 * load / axis * max(0.0, 1 - (x / axis) ** 2)

        carried = quad(per_length, start, end, points=[axis] if start < axis < end else None)[0]
        assert loads[k] == pytest.approx(carried / (end - start) * length, rel=1e-9, abs=1e-6)
    # Cut off at the ends, what is left carries all; no load, no lamina load.
    for semi_axis in (0.03, 0.06, 10.0):
        assert lamina_loads(
            np.array([load]), np.array([semi_axis]), length
        ).mean() == pytest.approx(load, rel=1e-12)
    np.testing.assert_allclose(
        lamina_loads(np.array([load]), np.array([10.0]), length)[0], load, rtol=1e-4
    )
    assert not lamina_loads(np.array([0.0]), np.array([0.0]), length).any()


def test_uneven_load_lives_shorter():
    # The whole roller in contact: mean of (1.5 (1 - x^2))^4.5 over x is 2.3955 (Beta function), so the ring's damage is.
    load = np.full(28, 1e5)
    even = ring_damage(load[:, None], 5e5, stationary=True)
    laminae = lamina_loads(load, np.full(28, 0.05), 0.1)
    exact = 1.5**4.5 * math.gamma(0.5) * math.gamma(5.5) / (2 * math.gamma(6.0))
    assert ring_damage(laminae, 5e5, stationary=True) / even == pytest.approx(exact, rel=3e-3)


def test_rings_together_live_shorter_than_the_weakest():
    damages = np.array([[1.0, 0.5], [0.0, 0.25]])
    lives = reference_life(damages, axis=())
    assert np.isinf(lives[1, 0]) and reference_life(damages) < lives.min()
    # Weibull's product law with slope 9/8: L^(-9/8) add up.
    assert np.sum((lives / 1e6) ** (-9 / 8)) == pytest.approx(
        (reference_life(damages) / 1e6) ** (-9 / 8)
    )


@pytest.mark.parametrize("stationary", [False, True])
def test_the_damage_of_a_series_is_that_of_its_samples(stationary):
    rng = np.random.default_rng(7)
    load = np.maximum(rng.normal(40e3, 40e3, (28, 50)), 0.0)
    load[:, 7] = 0.0
    length, semi_axis, rating = 0.106, 1.6e-3, 514e3
    assert semi_axis * np.cbrt(load.max()) > 0.5 * length  # some ellipses reach beyond the ends
    per_sample = load.T
    laminae = lamina_loads(per_sample, semi_axis * np.cbrt(per_sample), length)
    damages = damage_series(load, semi_axis, length, rating, stationary)
    np.testing.assert_allclose(
        damages[0], ring_damage(laminae, rating / REDUCTION, stationary=stationary), rtol=1e-12
    )
    np.testing.assert_allclose(
        damages[1], ring_damage(per_sample[..., None], rating, stationary=stationary), rtol=1e-12
    )
