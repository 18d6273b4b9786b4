"""Forces of a pocket against the laws that they come from."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

from macroslip.whole.pocket import (
    Pocket,
    elastic_energy,
    pocket_force,
    squeeze_coefficient,
    squeeze_resistance,
)
from macroslip.whole.stage import excess_approach

DRY = Pocket(half_gap=2.5e-4, stiffness=4.2e11, damping=50.0, film=0.0, least_film=9e-7)
FILM = DRY._replace(damping=0.0, film=squeeze_coefficient(0.54, 0.106, 0.035))
SHORT = FILM._replace(oil_gap=1e-4)


def test_squeeze_film_is_the_integral_of_reynolds_pressure():
    viscosity, length, radius, gap, speed = 0.54, 0.106, 0.035, 3e-5, 0.01
    load, _ = quad(
        lambda x: 6.0 * viscosity * speed * radius / (gap + x * x / (2.0 * radius)) ** 2,
        -0.05,
        0.05,
        points=[0],
        limit=500,
    )
    assert squeeze_coefficient(viscosity, length, radius) * speed / gap**1.5 == pytest.approx(
        length * load, rel=1e-3
    )


@pytest.mark.parametrize("over", [1.05, 2.0, 5.0, 100.0])
def test_squeeze_film_of_a_gap_that_is_full_in_part_is_that_integral_over_the_oil(over):
    radius, film = 0.035, SHORT.oil_gap / over
    reach = math.sqrt(2.0 * radius * (SHORT.oil_gap - film))

    def pressure(x):
        return 6.0 * 0.54 * radius * ((film + x * x / (2.0 * radius)) ** -2 - SHORT.oil_gap**-2)

    resistance, by_film = squeeze_resistance(SHORT, film)
    assert resistance == pytest.approx(
        0.106 * quad(pressure, -reach, reach, limit=200)[0], rel=1e-9
    )
    step = 1e-5 * film
    above, below = (squeeze_resistance(SHORT, film + change)[0] for change in (step, -step))
    assert by_film == pytest.approx((above - below) / (2.0 * step), rel=1e-6)


def test_squeeze_film_ends_where_the_oil_ends_and_is_whole_where_oil_reaches_far():
    factor = [
        squeeze_resistance(SHORT, film)[0] / squeeze_resistance(FILM, film)[0]
        for film in (1e-9, 0.9999e-4)
    ]
    assert factor[0] == pytest.approx(1.0, abs=1e-7) and 0.0 < factor[1] < 2e-6
    assert squeeze_resistance(SHORT, SHORT.oil_gap) == squeeze_resistance(SHORT, 2e-4) == (0.0, 0.0)
    assert squeeze_resistance(FILM._replace(oil_gap=1.0), 2e-4) == squeeze_resistance(FILM, 2e-4)


@pytest.mark.parametrize("pocket", [DRY, FILM, SHORT])
@pytest.mark.parametrize("offset", [-2.54e-4, -2.4e-4, 0.0, 1e-4, 2.499e-4, 2.51e-4])
@pytest.mark.parametrize("speed", [-3e-3, 2e-3])
def test_derivatives(pocket, offset, speed):
    _, by_offset, by_speed = pocket_force(pocket, offset, speed)
    step = 1e-11
    slope = (
        pocket_force(pocket, offset + step, speed)[0]
        - pocket_force(pocket, offset - step, speed)[0]
    ) / (2 * step)
    assert by_offset == pytest.approx(slope, rel=1e-4, abs=1e-3)
    slope = (
        pocket_force(pocket, offset, speed + 1e-7)[0]
        - pocket_force(pocket, offset, speed - 1e-7)[0]
    ) / 2e-7
    assert by_speed == pytest.approx(slope, rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("pocket", [DRY, FILM, SHORT])
def test_a_spar_never_pulls_and_sides_mirror(pocket):
    for offset in np.linspace(-2.6e-4, 2.6e-4, 53):
        for speed in (-0.5, -1e-3, 1e-3, 0.5):
            push = pocket_force(pocket, offset, speed)[0]
            assert push == -pocket_force(pocket, -offset, -speed)[0]
            if abs(offset) > pocket.half_gap:
                assert push * offset <= 0.0
            elif pocket.film:
                assert push * speed <= 0.0
            else:
                assert push == 0.0


@pytest.mark.parametrize("speed", [1e-3, 0.02, 0.1, 0.6])
@pytest.mark.parametrize("mass", [0.5, 3.2])
def test_restitution_is_what_an_impact_gives_back(speed, mass):
    """A body that runs into a fixed spar leaves with e v0, whatever its mass: D v0 (1 + e) = ln[(1 + D v0)/(1 − e D v0)]."""
    ratio = DRY.damping * speed
    wanted = ratio - math.log1p(ratio)
    restitution = (
        -math.expm1(-brentq(lambda s: s + math.expm1(-s) - wanted, 0.0, wanted + 1.0, xtol=1e-14))
        / ratio
    )
    duration = 30.0 * (mass**2 / (DRY.stiffness**2 * speed)) ** 0.2

    def rate(_, y):
        return [y[1], pocket_force(DRY, y[0], y[1])[0] / mass]

    def leaves(_, y):
        return y[0] - DRY.half_gap + 1e-15

    leaves.terminal, leaves.direction = True, -1
    solution = solve_ivp(
        rate,
        (0.0, duration),
        [DRY.half_gap, speed],
        events=leaves,
        rtol=1e-10,
        atol=[1e-16, 1e-12],
        method="DOP853",
    )
    assert -solution.y[1, -1] / speed == pytest.approx(restitution, rel=1e-5)


def test_elastic_energy_is_the_work_of_the_slow_push():
    depth = 3e-6
    work, _ = quad(lambda x: -pocket_force(DRY, x, 0.0)[0], DRY.half_gap, DRY.half_gap + depth)
    assert elastic_energy(DRY, DRY.half_gap + depth) == pytest.approx(work, rel=1e-6)
    assert elastic_energy(DRY, 0.0) == 0.0


@pytest.mark.parametrize("side", [-1.0, 1.0])
@pytest.mark.parametrize("load", [0.02, 0.2, 0.6])
def test_newton_finds_a_light_approach_to_a_spar(side, load):
    """Friction like a root of the push of a film that is squeezed, under a load: the solution is next to no speed.

    By itself Newton's method goes to and fro about it for ever.
    """
    power = 0.3

    def iterate(bounded):
        speed = side
        block = SimpleNamespace(approach=math.inf)
        for iteration in range(60):
            closing = max(side * speed, 0.0)
            push = -side * closing
            friction = closing**power
            excess = friction + 0.01 * side * speed - load
            if abs(excess) < 1e-9:
                return iteration, side * speed
            slope = power * closing ** (power - 1.0) if closing else 0.0
            change = -side * excess / (slope + 0.01)
            at = SimpleNamespace(push=push, pocket_speed=speed)
            speed += change - (excess_approach(at, block, change) if bounded else 0.0)
        return iteration, math.nan

    iterations, found = iterate(bounded=True)
    exact = brentq(lambda x: x**power + 0.01 * x - load, 0.0, 1.0, xtol=1e-300, rtol=1e-14)
    assert found == pytest.approx(exact, rel=1e-6)
    assert iterations < 40
    assert math.isnan(iterate(bounded=False)[1])
