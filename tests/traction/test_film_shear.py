"""The limited, self-heated film against the problem of conduction and shear that it claims to solve exactly."""

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_bvp, solve_ivp
from scipy.optimize import minimize_scalar

from macroslip.traction import heating_number, shear_stress
from macroslip.traction.film_shear import heated_shear
from macroslip.traction.rheology import EYRING, LIMITING_SHEAR, NEWTONIAN, limited_stress

LAWS = {"newtonian": NEWTONIAN, "limiting-shear": LIMITING_SHEAR, "eyring": EYRING}
rheologies = pytest.mark.parametrize("rheology", LAWS.values(), ids=LAWS)
any_rheology = st.sampled_from(list(LAWS.values()))
LIMIT = 4.2e7


def decades(low, high):
    return st.floats(low, high).map(lambda x: 10.0**x)


def stress_of_rate(rheology, equivalent):
    """τ over the characteristic stress from τ* = η γ̇ over it, as published."""
    if rheology == LIMITING_SHEAR:
        return -np.expm1(-equivalent)
    return np.arcsinh(equivalent) if rheology == EYRING else equivalent


def shoot(top):
    """Scaled half thickness and wall gradient of θ'' = −exp θ from θ = `top`, θ' = 0 in the middle to θ = 0 at the wall."""

    def wall(_, state):
        return state[0]

    wall.terminal = True
    span = (0.0, 2.0 * math.sqrt(2.0 * top) + 3.0)
    step = 0.1 * min(math.sqrt(top), 1.0)
    found = solve_ivp(
        lambda _, s: [s[1], -math.exp(s[0])],
        span,
        [top, 0.0],
        events=wall,
        method="DOP853",
        rtol=3e-14,
        atol=1e-17,
        max_step=step,
    )
    half, slope = found.t[-1], found.y[1, -1]
    return half - found.y[0, -1] / slope, -slope


@pytest.mark.parametrize("top", [1e-4, 0.01, 0.3, 1.0, 3.0, 8.0])
@rheologies
def test_stress_solves_the_conduction_problem(rheology, top):
    """k T'' = −τ γ̇ with γ̇ = τ*(τ) exp(β(T − T_wall))/η_s; the rates across the film add up to the slip.

    Over the thickness, 0 to 1, θ = β(T − T_wall) has θ'' = −λ exp θ with λ = 8 (heat τ)(τ*/τ_viscous), and the rates give
    τ_viscous = τ* ∫exp θ.
    """
    half, gradient = shoot(top)
    for equivalent in (1e-4, 0.1, 1.0, 4.0, 12.0):
        stress = stress_of_rate(rheology, equivalent)
        viscous = equivalent * gradient / half
        heat = (2.0 * half) ** 2 * viscous / (8.0 * stress * equivalent)
        found, _, _ = heated_shear(rheology, viscous * LIMIT, LIMIT, heat / LIMIT)
        assert found == pytest.approx(stress * LIMIT, rel=2e-11, abs=0.0)


@pytest.mark.parametrize(("viscous", "heat"), [(0.5, 0.3), (3.0, 1.0), (20.0, 0.05), (100.0, 1.0), (3.0, 10.0)])
@rheologies
def test_stress_agrees_with_a_solver_of_boundary_value_problems(rheology, viscous, heat):
    """Temperature, its gradient and velocity over the film, the equivalent stress being the unknown parameter."""

    def rhs(z, y, p, heat):
        equivalent = np.exp(p[0])
        rate = equivalent / viscous * np.exp(y[0])
        return np.array([y[1], -8.0 * heat * stress_of_rate(rheology, equivalent) * rate, rate])

    def walls(left, right, p):
        return np.array([left[0], right[0], left[2], right[2] - 1.0])

    z = np.linspace(0.0, 1.0, 51)
    profile, unknown = np.array([0.0 * z, 0.0 * z, z]), [math.log(viscous)]
    # The heat is brought in by and by, so that each solution is close to the last.
    for part in [1e-3, *np.linspace(0.1, 1.0, 10)]:
        now = part**2 * heat
        found = solve_bvp(lambda *x, now=now: rhs(*x, now), walls, z, profile, p=unknown, tol=1e-6, max_nodes=5000)
        assert found.success
        z, profile, unknown = found.x, found.y, found.p
    stress = float(stress_of_rate(rheology, math.exp(found.p[0])))
    assert heated_shear(rheology, viscous * LIMIT, LIMIT, heat / LIMIT)[0] == pytest.approx(stress * LIMIT, rel=1e-6)
    # The middle of the film is (2/β) ln cosh c above the walls, with c tanh c = heat τ.
    power = heat * stress
    c = np.interp(power, (grid := np.linspace(0.0, 40.0, 400001)) * np.tanh(grid), grid)
    assert found.sol(0.5)[0] == pytest.approx(2.0 * math.log(math.cosh(c)), rel=1e-6)


@given(any_rheology, decades(-6, 14), decades(3, 9), decades(-14, 0))
@settings(deadline=None)
def test_one_solution_for_every_slip(rheology, viscous, limit, heat):
    """All c tried: what leaves by conduction and what shear puts in are equal once only, at the stress found."""
    c = np.logspace(-9.0, 2.5, 3000)
    thinned = viscous * 4.0 * c * np.exp(-2.0 * c) / -np.expm1(-4.0 * c)
    rest = c * np.tanh(c) - heat * limit * stress_of_rate(rheology, thinned / limit)
    places = np.flatnonzero(np.diff(np.sign(rest)))
    stress, by_viscosity, feedback = heated_shear(rheology, viscous, limit, heat)
    assert places.size <= 1
    # The c on either side of the solution, which lies below the first of them for a film that hardly heats.
    number = 0 if rest[0] >= 0.0 else c.size if places.size == 0 else places[0] + 1
    low, high = (0.0, *c)[number], (*c, math.inf)[number]
    assert low * math.tanh(low) * (1 - 1e-9) <= heat * stress <= high * math.tanh(high) * (1 + 1e-9)
    assert 0.0 <= by_viscosity <= 1.0 + 1e-12 and feedback >= 0.0


@given(any_rheology, decades(-4, 16), decades(3, 10), decades(-16, 2))
@settings(deadline=None, max_examples=60)
def test_stress_changes_steadily_with_slip(rheology, viscous, limit, heat):
    """|d ln τ/d ln Δu| never exceeds one, so a change of branch could not hide."""
    factor = 10.0 ** np.linspace(-4.0, 4.0, 401)
    stress = np.array([heated_shear(rheology, viscous * s, limit, heat * s)[0] for s in factor])
    assert np.all(np.abs(np.diff(np.log(stress))) <= np.log(factor[1] / factor[0]) * (1.0 + 1e-6))


@given(any_rheology, decades(-300, 40), decades(-3, 12), st.one_of(st.just(0.0), decades(-40, 20)))
@example(LIMITING_SHEAR, 1e300, 1.0, 1e3)
@settings(deadline=None, max_examples=300)
def test_no_stress_exceeds_what_the_law_allows(rheology, viscous, limit, heat):
    stress, _by_viscosity, feedback = heated_shear(rheology, viscous, limit, heat)
    assert stress >= 0.0 and math.isfinite(stress) and math.isfinite(feedback)
    cool, _ = limited_stress(rheology, viscous, limit)
    assert stress <= cool * (1.0 + 1e-15)
    if rheology == LIMITING_SHEAR:
        assert stress <= limit


@pytest.mark.parametrize("slip", 10.0 ** np.arange(-8.0, 2.0))
@pytest.mark.parametrize("rheology", [NEWTONIAN, LIMITING_SHEAR, EYRING])
def test_an_unreachable_limit_gives_crooks_film(rheology, slip):
    beta, conductivity, film = 0.056, 0.125, 6e-7
    for viscosity in (0.54, 1e3, 1e7):
        crook = shear_stress(viscosity, beta, conductivity, film, slip)
        heat = beta * film * slip / (8.0 * conductivity)
        viscous = viscosity * slip / film
        assert heating_number(viscosity, beta, conductivity, slip) == pytest.approx(heat * viscous, rel=1e-14)
        assert heated_shear(rheology, viscous, 1e30, heat)[0] == pytest.approx(crook, rel=2e-10)


@given(any_rheology, decades(-3, 14), decades(3, 9))
@settings(deadline=None)
def test_without_heat_stress_is_that_of_the_rheology(rheology, viscous, limit):
    stress, elasticity = limited_stress(rheology, viscous, limit)
    assert heated_shear(rheology, viscous, limit, 0.0) == pytest.approx((stress, elasticity, 0.0), rel=1e-15)
    # Approached in proportion to heat τ.
    little = heated_shear(rheology, viscous, limit, 1e-6 / stress)
    assert (little[0] == pytest.approx(stress, rel=1e-6) and little[0] < stress) or elasticity < 1e-9
    assert heated_shear(rheology, 0.0, limit, 1e-9) == (0.0, 1.0, 0.0)


@given(any_rheology, decades(2, 12), decades(4, 9), decades(-13, -4))
@example(LIMITING_SHEAR, 4.2e7, 4.2e7, 1e-9 / 2.65e7)
@example(EYRING, 1e6, 3e6, 1.0000001e-9 / 9.8e5)
@example(NEWTONIAN, 1e6, 3e6, 1e-14)
@settings(deadline=None, max_examples=200)
def test_logarithmic_derivatives_are_differences_of_the_stress(rheology, viscous, limit, heat):
    step = 1e-4

    def log_stress(by_slip, by_film, by_viscosity, by_limit):
        """ln τ with slip, film, viscosity and characteristic stress changed by these logarithms."""
        changed = viscous * math.exp(by_slip + by_viscosity - by_film), limit * math.exp(by_limit)
        return math.log(heated_shear(rheology, *changed, heat * math.exp(by_slip + by_film))[0])

    def difference(place):
        ahead, behind = ([sign * step if k == place else 0.0 for k in range(4)] for sign in (1, -1))
        return (log_stress(*ahead) - log_stress(*behind)) / (2.0 * step)

    _, g, f = heated_shear(rheology, viscous, limit, heat)
    found = [difference(place) for place in range(4)]
    assert found == pytest.approx([g * (1 - f), -g * (1 + f), g, 1 - g * (1 + f)], rel=2e-6, abs=2e-7)


@pytest.mark.parametrize("viscosity", [1.0, 30.0, 1e3])
@rheologies
def test_stress_peaks_where_power_reaches_eight_k_over_beta_h(rheology, viscosity):
    """Found by maximizing: τ Δu = 8k/(β h) at the peak whatever the rheology, that is c tanh c = 1."""
    beta, conductivity, film = 0.056, 0.125, 6e-7

    def parts(log_slip):
        slip = math.exp(log_slip)
        return viscosity * slip / film, LIMIT, beta * film * slip / (8.0 * conductivity)

    grid = np.linspace(math.log(1e-6), math.log(1e4), 2000)
    best = grid[np.argmax([heated_shear(rheology, *parts(x))[0] for x in grid])]
    found = minimize_scalar(
        lambda x: -math.log(heated_shear(rheology, *parts(x))[0]),
        bounds=(best - 0.05, best + 0.05),
        method="bounded",
        options={"xatol": 1e-9},
    )
    stress, _, feedback = heated_shear(rheology, *parts(found.x))
    flat = 1e-3 if rheology == LIMITING_SHEAR else 1e-6
    assert stress * math.exp(found.x) == pytest.approx(8.0 * conductivity / (beta * film), rel=flat)
    assert feedback == pytest.approx(1.0, rel=10 * flat)
