"""Traction by values: rheology, heat balance, chords and their table, Crook's closed form, each against references."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp
from scipy.optimize import minimize_scalar

from macroslip.bearing import Bearing
from macroslip.compiled import jit
from macroslip.contact.chords import (
    FIRST_SLICE,
    MOST_SLICES,
    SLICES,
    chord_stress_at,
    chord_stresses,
    film_node,
    write_film,
)
from macroslip.contact.closed_form import (
    barus_crook_traction,
    patch_integral,
    prepare_barus_crook,
)
from macroslip.contact.laws import prepare
from macroslip.contact.mechanisms import Laws
from macroslip.contact.traction import (
    EYRING,
    HIGHEST_PRESSURE,
    LIMITING_SHEAR,
    NEWTONIAN,
    RHEOLOGIES,
    Fluid,
    characteristic_slip,
    characteristic_stress,
    chord_stress,
    chord_table,
    heated_shear,
    limited_stress,
    log_viscosity,
    prepare_fluid,
)
from macroslip.errors import InputError
from macroslip.lubricant import Lubricant

OIL = Lubricant.read("vg460-pao")
FULL = Laws.physical()
LIMITED = FULL.but(rheology="limiting-shear")
#: Laws, and the errors promised of the table: everywhere without skids, at the 99th percentile with skids, and at worst.
CHOICES = {
    "physical": (FULL, 1e-4, 1e-4, 1e-3),
    "limiting shear": (LIMITED, 1e-3, 2e-4, 1e-2),
    "cool": (LIMITED.but(heating=False), 1e-4, 1e-4, 1e-4),
    "newtonian": (FULL.but(rheology="newtonian"), 1e-4, 1e-4, 2e-4),
    "barus": (FULL.but(rheology="newtonian", viscosity="barus"), 5e-4, 5e-4, 5e-4),
    "cool newtonian": (FULL.but(rheology="newtonian", heating=False), 2e-6, 2e-6, 2e-6),
    "barus, limiting shear": (LIMITED.but(viscosity="barus"), 1e-2, 5e-3, 5e-2),
}
choices = pytest.mark.parametrize("name", CHOICES)
rheologies = pytest.mark.parametrize("rheology", RHEOLOGIES.values(), ids=RHEOLOGIES)
bounded = pytest.mark.parametrize("rheology", [LIMITING_SHEAR, EYRING])
any_rheology = st.sampled_from(sorted(RHEOLOGIES.values()))
LIMIT = 4.2e7
VISCOSITY, BETA, CONDUCTIVITY, FILM = 0.7, 0.05, 0.13, 1.3e-6


def crook_reduction(heating):
    """Factor by which heat lowers the stress of a Newtonian film between cool walls (doi:10.1098/rsta.1961.0014)."""
    root = np.sqrt(heating)
    return np.arcsinh(root) / (root * np.sqrt(1.0 + heating))


def decades(low, high):
    return st.floats(low, high).map(lambda x: 10.0**x)


def fluid(name):
    return prepare_fluid(CHOICES[name][0], OIL)


# --- Rheology


def shear_rate_times_viscosity(rheology, stress, characteristic):
    """The laws as printed: equivalent Newtonian stress τ* of a stress τ."""
    if rheology == LIMITING_SHEAR:
        return -characteristic * mpmath.log1p(-mpmath.mpf(stress) / characteristic)
    return characteristic * mpmath.sinh(mpmath.mpf(stress) / characteristic)


@bounded
@pytest.mark.parametrize("ratio", [1e-12, 1e-6, 1e-2, 0.3, 1.0, 5.0, 20.0])
def test_is_the_inverse_of_the_published_law(rheology, ratio):
    characteristic = 3.3e6
    stress = float(limited_stress(rheology, ratio * characteristic, characteristic))
    with mpmath.workdps(40):
        back = shear_rate_times_viscosity(rheology, stress, characteristic)
    # Close to the limit a rounded stress says little of the rate behind it.
    rounding = (
        4e-16 * math.exp(ratio) / ratio if rheology == LIMITING_SHEAR else 4e-16 * (1.0 + ratio)
    )
    assert float(back) == pytest.approx(ratio * characteristic, rel=4e-16 + rounding, abs=0.0)


@given(any_rheology, decades(-12, 12), decades(-12, 12))
def test_bounds(rheology, ratio, characteristic):
    viscous = ratio * characteristic
    stress, more = limited_stress(rheology, viscous * np.array([1.0, 1.01]), characteristic)
    assert 0.0 < stress <= viscous * (1.0 + 1e-15)
    assert rheology != LIMITING_SHEAR or stress <= characteristic
    assert more >= stress * (1.0 - 1e-15)


@bounded
def test_slow_shear_is_newtonian_and_fast_shear_limited(rheology):
    assert limited_stress(rheology, 1e-3, 1e7) == pytest.approx(1e-3, rel=1e-9)
    fast = 1e3 if rheology == LIMITING_SHEAR else 1e3 * math.log(2e9)
    assert limited_stress(rheology, 1e12, 1e3) == pytest.approx(fast, rel=1e-12)
    assert limited_stress(NEWTONIAN, 1e12, 1.0) == 1e12


# --- Heat balance


def stress_of_rate(rheology, equivalent):
    """τ over the characteristic stress from τ* = η γ̇ over it, as published."""
    if rheology == LIMITING_SHEAR:
        return -np.expm1(-equivalent)
    return np.arcsinh(equivalent) if rheology == EYRING else equivalent


def shoot_rate(top):
    """Scaled half thickness and wall gradient of θ'' = −exp θ from θ = `top`, θ' = 0 in the middle to θ = 0 at the wall."""

    def wall(_, state):
        return state[0]

    wall.terminal = True
    span = (0.0, 2.0 * math.sqrt(2.0 * top) + 3.0)
    step = 0.1 * min(math.sqrt(top), 1.0)
    solution = solve_ivp(
        lambda _, s: [s[1], -math.exp(s[0])],
        span,
        [top, 0.0],
        events=wall,
        method="DOP853",
        rtol=3e-14,
        atol=1e-17,
        max_step=step,
    )
    half, slope = solution.t[-1], solution.y[1, -1]
    return half - solution.y[0, -1] / slope, -slope


@pytest.mark.parametrize("top", [1e-4, 0.01, 0.3, 1.0, 3.0, 8.0])
@rheologies
def test_limited_stress_solves_the_conduction_problem(rheology, top):
    """k T'' = −τ γ̇ with γ̇ = τ*(τ) exp(β(T − T_wall))/η_s; the rates across the film add up to the slip.

    Over the thickness, 0 to 1, θ = β(T − T_wall) has θ'' = −λ exp θ with λ = 8 (heat τ)(τ*/τ_viscous), and the rates give
    τ_viscous = τ* ∫exp θ.
    """
    half, gradient = shoot_rate(top)
    for equivalent in (1e-4, 0.1, 1.0, 4.0, 12.0):
        stress = stress_of_rate(rheology, equivalent)
        viscous = equivalent * gradient / half
        heat = (2.0 * half) ** 2 * viscous / (8.0 * stress * equivalent)
        shear = heated_shear(rheology, viscous * LIMIT, LIMIT, heat / LIMIT)
        assert shear == pytest.approx(stress * LIMIT, rel=2e-11, abs=0.0)


@given(any_rheology, decades(-6, 14), decades(3, 9), decades(-14, 0))
@settings(deadline=None)
def test_one_solution_for_every_slip(rheology, viscous, limit, heat):
    """All c tried: what leaves by conduction and what shear puts in are equal once only, at the stress found."""
    c = np.logspace(-9.0, 2.5, 3000)
    thinned = viscous * 4.0 * c * np.exp(-2.0 * c) / -np.expm1(-4.0 * c)
    rest = c * np.tanh(c) - heat * limit * stress_of_rate(rheology, thinned / limit)
    places = np.flatnonzero(np.diff(np.sign(rest)))
    stress = heated_shear(rheology, viscous, limit, heat)
    assert places.size <= 1
    # The c on either side of the solution, which lies below the first of them for a film that hardly heats.
    number = 0 if rest[0] >= 0.0 else c.size if places.size == 0 else places[0] + 1
    low, high = (0.0, *c)[number], (*c, math.inf)[number]
    assert low * math.tanh(low) * (1 - 1e-9) <= heat * stress <= high * math.tanh(high) * (1 + 1e-9)


@given(any_rheology, decades(-4, 16), decades(3, 10), decades(-16, 2))
@settings(deadline=None, max_examples=60)
def test_stress_changes_steadily_with_slip(rheology, viscous, limit, heat):
    """|d ln τ/d ln Δu| never exceeds one, so a change of branch could not hide."""
    factor = 10.0 ** np.linspace(-4.0, 4.0, 401)
    stress = heated_shear(rheology, viscous * factor, limit, heat * factor)
    assert np.all(np.abs(np.diff(np.log(stress))) <= np.log(factor[1] / factor[0]) * (1.0 + 1e-6))


@given(any_rheology, decades(-300, 40), decades(-3, 12), st.one_of(st.just(0.0), decades(-40, 20)))
@example(LIMITING_SHEAR, 1e300, 1.0, 1e3)
@settings(deadline=None, max_examples=300)
def test_no_stress_exceeds_what_the_law_allows(rheology, viscous, limit, heat):
    stress = heated_shear(rheology, viscous, limit, heat)
    assert stress >= 0.0 and math.isfinite(stress)
    assert stress <= limited_stress(rheology, viscous, limit) * (1.0 + 1e-15)
    assert rheology != LIMITING_SHEAR or stress <= limit


@pytest.mark.parametrize("slip", 10.0 ** np.arange(-8.0, 2.0))
@rheologies
def test_an_unreachable_limit_gives_crooks_film(rheology, slip):
    beta, conductivity, film = 0.056, 0.125, 6e-7
    viscosity = np.array([0.54, 1e3, 1e7])
    heat, viscous = beta * film * slip / (8.0 * conductivity), viscosity * slip / film
    crook = viscous * crook_reduction(heat * viscous)
    assert heated_shear(rheology, viscous, 1e30, heat) == pytest.approx(crook, rel=2e-10)


@given(any_rheology, decades(-3, 14), decades(3, 9))
@settings(deadline=None)
def test_without_heat_stress_is_that_of_the_rheology(rheology, viscous, limit):
    stress = limited_stress(rheology, viscous, limit)
    assert heated_shear(rheology, viscous, limit, 0.0) == stress
    # Approached in proportion to heat τ; and nothing jumps where heat begins to be solved for.
    less = heated_shear(
        rheology, viscous, limit, np.array([0.999999e-7, 1.000001e-7, 1e-6]) / stress
    )
    assert less == pytest.approx(stress, rel=1e-6)
    # At the limit of stress its fall is below rounding.
    assert np.all(np.diff(less) <= 4.0 * np.finfo(float).eps * stress)
    assert less[1] == pytest.approx(less[0], rel=1e-11)
    assert heated_shear(rheology, 0.0, limit, 1e-9) == 0.0


@pytest.mark.parametrize("viscosity", [1.0, 1e3])
@rheologies
def test_stress_peaks_where_power_reaches_eight_k_over_beta_h(rheology, viscosity):
    """Found by maximizing: τ Δu = 8k/(β h) at the peak whatever the rheology, that is c tanh c = 1."""
    beta, conductivity, film = 0.056, 0.125, 6e-7

    def parts(log_slip):
        slip = math.exp(log_slip)
        return viscosity * slip / film, LIMIT, beta * film * slip / (8.0 * conductivity)

    grid = np.linspace(math.log(1e-6), math.log(1e4), 400)
    best = grid[np.argmax([heated_shear(rheology, *parts(x)) for x in grid])]
    minimum = minimize_scalar(
        lambda x: -math.log(heated_shear(rheology, *parts(x))),
        bounds=(best - 0.05, best + 0.05),
        method="bounded",
        options={"xatol": 1e-9},
    )
    stress = heated_shear(rheology, *parts(minimum.x))
    flat = 1e-3 if rheology == LIMITING_SHEAR else 1e-6
    assert stress * math.exp(minimum.x) == pytest.approx(
        8.0 * conductivity / (beta * film), rel=flat
    )


# --- Crook's film


def crook_stress(slip):
    """Stress of a Newtonian film."""
    heat = BETA * FILM * slip / (8.0 * CONDUCTIVITY)
    return heated_shear(NEWTONIAN, VISCOSITY * slip / FILM, 1.0, heat)


def slip_at(heating):
    return math.sqrt(8.0 * CONDUCTIVITY * heating / (BETA * VISCOSITY))


def test_stress_peaks_at_the_known_heating():
    # √(1+B) = √B asinh √B.
    peak = mpmath.findroot(
        lambda b: mpmath.sqrt(1 + b) - mpmath.sqrt(b) * mpmath.asinh(mpmath.sqrt(b)), 2.0
    )
    assert float(peak) == pytest.approx(2.2767, abs=5e-5)
    slip = slip_at(float(peak))
    around = crook_stress(slip * np.linspace(0.5, 2.0, 301))
    assert around.max() <= crook_stress(slip)


# --- Stress along a chord


def local_stress(oil, pressure, film, slip):
    viscosity = np.exp(log_viscosity(oil, pressure))
    return heated_shear(
        oil.rheology,
        viscosity * slip / film,
        characteristic_stress(oil, pressure),
        oil.heating * film * slip,
    )


def adaptive(oil, pressure, film, slip):
    """∫ τ(p cos θ) cos θ dθ over a quarter turn, the pressure's decades apart."""
    places = [
        math.acos(min(1.0, p / pressure))
        for p in (1e-4 * pressure, 1e-2 * pressure, 0.1 * pressure, 0.5 * pressure)
    ]
    force, error = quad(
        lambda t: local_stress(oil, pressure * math.cos(t), film, slip) * math.cos(t),
        0.0,
        0.5 * math.pi,
        points=places,
        limit=500,
        epsabs=0.0,
        epsrel=1e-9,
    )
    assert error < 1e-7 * force
    return force


@choices
def test_against_adaptive_integration(name):
    oil, laws = fluid(name), CHOICES[name][0]
    rng = np.random.default_rng(7)
    for highest, promised in ((1e9, 6e-4), (2e9, 1e-2 if laws.viscosity == "barus" else 1e-4)):
        for _ in range(12):
            pressure = 10.0 ** rng.uniform(4.0, math.log10(highest))
            film, slip = 10.0 ** rng.uniform(-7.0, -5.0), 10.0 ** rng.uniform(-10.0, -0.3)
            assert chord_stress(oil, pressure, film, slip) == pytest.approx(
                adaptive(oil, pressure, film, slip), rel=promised
            ), (pressure, film, slip)


def test_fully_limited_chord_by_hand():
    """Where shear is at its limit all along, q = γ p1 ∫cos²θ dθ = γ p1 π/4."""
    oil = fluid("cool")
    assert chord_stress(oil, 2e9, 3e-7, 2.0) == pytest.approx(0.042 * 2e9 * math.pi / 4, rel=2e-3)
    assert chord_stress(oil, 2e9, 3e-7, 2.0) < 0.042 * 2e9 * math.pi / 4


def test_light_chord_is_isoviscous():
    """Far below the pressures that thicken oil, q = η0 Δu/h ∫cos θ dθ = η0 Δu/h."""
    for name in CHOICES:
        oil = fluid(name)
        assert chord_stress(oil, 1e3, 1e-3, 1e-7) == pytest.approx(
            0.54 * 1e-7 / 1e-3, rel=4e-3 if oil.rheology == 1 else 1e-4
        )


@pytest.mark.parametrize("film", [2e-7, 1e-6])
@pytest.mark.parametrize("slip", [1e-12, 1e-6, 1e-3, 0.3])
def test_newtonian_barus_chord_is_crooks(film, slip):
    oil = fluid("barus")

    def crook(viscosity):
        return viscosity * slip / film * crook_reduction(0.056 * viscosity * slip**2)

    with np.errstate(all="raise"):
        exact, _ = quad(
            lambda t: math.cos(t) * crook(0.54 * math.exp(18.9 * math.cos(t))),
            0.0,
            0.5 * math.pi,
            epsabs=0.0,
            epsrel=1e-11,
            limit=300,
        )
    assert chord_stress(oil, 0.9e9, film, slip) == pytest.approx(exact, rel=2e-5)


def test_cool_newtonian_chord_in_closed_form():
    """Without heating, ∫exp(P cos θ) cos θ dθ = π/2 (I1(P) + L_{-1}(P)), with the modified Struve function L."""
    oil = Fluid(NEWTONIAN, 0.54, 2.1, 1.0, 1e8, 1.0, 0.0)
    for exponent in (0.01, 1.0, 8.0, 21.0):
        exact = float(mpmath.pi / 2 * (mpmath.besseli(1, exponent) + mpmath.struvel(-1, exponent)))
        mean_stress = chord_stress(oil, exponent / 21.0 * 1e9, 1e-6, 1e-3) / (0.54 * 1e-3 / 1e-6)
        assert mean_stress == pytest.approx(exact, rel=1e-9 if exponent < 10 else 1e-4)


@choices
def test_viscosity_under_pressure(name):
    pressure = np.array([1e3, 1e7, 5e8, 2e9])
    if CHOICES[name][0].viscosity == "barus":
        exact = math.log(0.54) + 21e-9 * pressure
    else:
        index = 21e-9 * 1.96e8 / (math.log(0.54) + 9.67)
        exact = math.log(0.54) + (math.log(0.54) + 9.67) * ((1 + pressure / 1.96e8) ** index - 1)
    assert log_viscosity(fluid(name), pressure) == pytest.approx(exact, rel=1e-12)


def test_viscosity_beyond_all_numbers_is_refused():
    with pytest.raises(InputError, match="lubricant, pressure_viscosity: viscosity rises to 1e"):
        prepare_fluid(FULL, OIL.replace(viscosity=0.01, pressure_viscosity=1e-7))


def test_characteristic_slip_is_where_the_law_turns():
    eta = math.log(1e3)
    limited = Fluid(LIMITING_SHEAR, 0.54, 2.1, 1.0, 1e8, 0.04, 0.05)
    assert characteristic_slip(limited, eta, 1e9, 1e-6) * 1e3 / 1e-6 == pytest.approx(
        0.04 * 1e9, rel=1e-12
    )
    eyring = limited._replace(rheology=EYRING, characteristic=3e6)
    assert characteristic_slip(eyring, eta, 1e9, 1e-6) * 1e3 / 1e-6 == pytest.approx(3e6, rel=1e-12)
    newtonian = limited._replace(rheology=NEWTONIAN, characteristic=1.0)
    # Crook's heating number, β η v²/(8k), is one there.
    assert 0.05 * 1e3 * characteristic_slip(newtonian, eta, 1e9, 1e-6) ** 2 == pytest.approx(
        1.0, rel=1e-12
    )


# --- The table

_t, _WEIGHTS = np.polynomial.legendre.leggauss(400)
_t = 0.5 * (_t + 1.0)
_COSINES = np.cos(0.5 * np.pi * _t * _t * (3.0 - 2.0 * _t))
_WEIGHTS = 0.25 * np.pi * _WEIGHTS * 6.0 * _t * (1.0 - _t) * _COSINES


@jit
def looked_up(chords, pressures, films, slips):
    stresses = np.empty(pressures.size)
    for n in range(stresses.size):
        stresses[n] = chord_stress_at(chords, film_node(chords, films[n]), pressures[n], slips[n])
    return stresses


def interpolated_stress(table, *states):
    """The compiled look-up at arrays of pressure, film and slip."""
    return looked_up(
        table, *(state.copy() for state in np.broadcast_arrays(*map(np.atleast_1d, states)))
    )


def exact(oil, pressure, film, slip):
    """The chord's integral by 400 nodes crowded at both ends."""
    return local_stress(oil, pressure[:, None] * _COSINES, film[:, None], slip[:, None]) @ _WEIGHTS


@choices
def test_error_over_the_region_of_use(name):
    _, everywhere, most, worst = CHOICES[name]
    table = chord_table(fluid(name))
    rng = np.random.default_rng(3)
    errors = {}
    for fastest in (0.05, 0.4):
        states = 10.0 ** rng.uniform(
            [4.0, -7.0, -12.0], [math.log10(2e9), math.log10(2e-6), math.log10(fastest)], (2000, 3)
        )
        errors[fastest] = np.abs(
            interpolated_stress(table, *states.T) / exact(table.fluid, *states.T) - 1.0
        )
    assert errors[0.05].max() < everywhere
    assert np.quantile(errors[0.4], 0.99) < most
    assert errors[0.4].max() < worst


@pytest.mark.parametrize("name", ["physical", "limiting shear", "cool", "newtonian"])
def test_light_and_thick_films_of_the_cage(name):
    table = chord_table(fluid(name))
    rng = np.random.default_rng(5)
    states = 10.0 ** rng.uniform([3.0, -6.0, -9.0], [7.5, -3.4, math.log10(0.6)], (3000, 3))
    assert interpolated_stress(table, *states.T) == pytest.approx(
        exact(table.fluid, *states.T), rel=1e-3
    )


@pytest.mark.parametrize("name", ["physical", "limiting shear", "newtonian"])
def test_a_chord_is_good_up_to_the_slip_of_a_shaft_that_turns_round(name):
    table = chord_table(fluid(name))
    rng = np.random.default_rng(5)
    pressure, film = 10.0 ** rng.uniform(3.0, 7.0, 500), 10.0 ** rng.uniform(-7.0, -4.5, 500)
    slip = rng.uniform(1.0, 5.0, 500)
    stress = interpolated_stress(table, pressure, film, slip)
    assert stress == pytest.approx(chord_stress(table.fluid, pressure, film, slip), rel=1e-3)


@choices
def test_slow_slip_is_in_proportion(name):
    table = chord_table(fluid(name))
    pressure, film = np.array([1e5, 1e8, 1.5e9]), np.array([1e-5, 1e-6, 3e-7])
    slow, slower = (interpolated_stress(table, pressure, film, slip) for slip in (1e-25, 1e-30))
    assert slower == pytest.approx(1e-5 * slow, rel=1e-3)
    assert slow == pytest.approx(exact(table.fluid, pressure, film, np.full(3, 1e-25)), rel=5e-4)


@jit
def looked_up_together(chords, film, slices, count):
    behind = FIRST_SLICE + count
    write_film(film_node(chords, film), slices, FIRST_SLICE, behind)
    chord_stresses(chords, slices, behind)


@choices
def test_chords_looked_up_together_are_those_looked_up_alone(name):
    """To the last bit, however many there are: the processor takes several at once, and a rest."""
    table = chord_table(fluid(name))
    rng = np.random.default_rng(17)
    slices = np.zeros(1, SLICES)
    for count in range(MOST_SLICES - FIRST_SLICE + 1):
        taken = slice(FIRST_SLICE, FIRST_SLICE + count)
        film = 10.0 ** rng.uniform(-8.0, -4.0)
        pressure, slip = 10.0 ** rng.uniform([1.0, -32.0], [9.8, 0.5], (count, 2)).T
        slices["pressure"][0, taken], slices["speed"][0, taken] = pressure, slip
        slices["stress"] = -1.0
        looked_up_together(table, film, slices[0], count)
        alone = interpolated_stress(table, pressure, film, slip) if count else []
        np.testing.assert_array_equal(slices["stress"][0, taken], alone)
        assert (slices["stress"][0, taken.stop :] == -1.0).all()


def test_a_chord_whose_state_is_no_number_has_no_stress_and_its_neighbours_have():
    table = chord_table(fluid("physical"))
    slices = np.zeros(1, SLICES)
    taken = slice(FIRST_SLICE, FIRST_SLICE + 9)
    slices["pressure"][0, taken] = [math.nan] * 3 + [1e8] * 6
    slices["speed"][0, taken] = [1e-3] * 6 + [math.nan] * 3
    looked_up_together(table, 1e-6, slices[0], 9)
    alone = interpolated_stress(table, 1e8, 1e-6, 1e-3)[0]
    expected = [math.nan] * 3 + [alone] * 3 + [math.nan] * 3
    np.testing.assert_array_equal(slices["stress"][0, taken], expected)
    looked_up_together(table, math.nan, slices[0], 9)
    assert np.isnan(slices["stress"][0, taken]).all()


def test_limit_holds_in_the_table_too():
    table = chord_table(fluid("limiting shear"))
    rng = np.random.default_rng(11)
    pressure, film, slip = 10.0 ** rng.uniform([2.0, -8.0, -14.0], [9.6, -3.4, 1.0], (3000, 3)).T
    stress = interpolated_stress(table, pressure, film, slip)
    assert np.all(
        stress <= 0.042 * np.minimum(pressure, HIGHEST_PRESSURE) * math.pi / 4 * (1.0 + 1e-12)
    )


def test_outside_the_table_nothing_jumps():
    table = chord_table(fluid("physical"))
    at, above = interpolated_stress(table, np.array([1.0, 2.0]) * HIGHEST_PRESSURE, 5e-7, 1e-3)
    assert above == at
    for edge in (2e-8, 4e-4):
        inside, outside = interpolated_stress(
            table, 1e8, edge * (1.0 + np.array([-1e-9, 1e-9])), 1e-9
        )
        assert inside == pytest.approx(outside, rel=1e-8)
    # A film beyond the table is still sheared by its own thickness.
    assert interpolated_stress(table, 1e6, 4e-3, 1e-6) == pytest.approx(
        chord_stress(table.fluid, 1e6, 4e-3, 1e-6), rel=1e-3
    )


def test_one_table_serves_equal_fluids():
    assert chord_table(fluid("physical")) is chord_table(
        prepare_fluid(Laws.physical(), Lubricant.read("vg460-pao"))
    )
    assert not chord_table(fluid("physical")).coefficients.flags.writeable


# --- The whole contact


NODES, WEIGHTS = np.polynomial.legendre.leggauss(120)
# Over a quarter of the ellipse, taken twice in either direction.
ANGLES, ANGLE_WEIGHTS = 0.25 * np.pi * (1.0 + NODES), 0.5 * np.pi * WEIGHTS


def stress_integral(interface, load, film, slip, *, heated=True):
    """∬ τ dx dy over the ellipse at the Hertz pressure, Barus viscosity and Crook's stress, all written here.

    x = b sin θ, y = a cos θ sin ψ makes dx dy = a b cos² θ cos ψ and the pressure p0 cos θ cos ψ: smooth everywhere.
    """
    hertz, oil = interface.hertz, interface.lubricant
    size = load ** (1 / 3)
    cosine = np.cos(ANGLES)
    pressure = hertz.pressure * size * np.outer(cosine, cosine)
    area = hertz.semi_axis_across * hertz.semi_axis_along * size**2 * np.outer(cosine**2, cosine)
    viscosity = oil.viscosity * np.exp(oil.pressure_viscosity * pressure)
    root = (
        np.sqrt(oil.temperature_viscosity * viscosity / (8 * oil.thermal_conductivity))
        * slip
        * heated
    )
    reduction = np.where(root < 1e-3, 1 - root**2 * (2 / 3 - 8 / 15 * root**2), 0.0)
    hot = np.maximum(root, 1e-3)
    reduction = np.where(root < 1e-3, reduction, np.arcsinh(hot) / (hot * np.sqrt(1 + hot**2)))
    return np.einsum(
        "i,j,ij->", ANGLE_WEIGHTS, ANGLE_WEIGHTS, viscosity * reduction * slip / film * area
    )


@pytest.mark.parametrize("heated", [True, False])
@pytest.mark.parametrize("number", [0, 1, 2], ids=["inner", "outer", "cage"])
def test_closed_form_is_the_integral_of_the_stress(base, number, heated):
    law = prepare_barus_crook(base[number], heated=heated)
    for load in (0.1, 30.0, 1e3, 2e4, 1e5, 2e5):
        for slip in (1e-13, 1e-8, 1e-4, 0.03, 1.0, 20.0):
            force = stress_integral(base[number], load, 1.2e-6, slip, heated=heated)
            ahead, behind = barus_crook_traction(law, load, 1.2e-6, np.array([slip, -slip]))
            assert ahead == pytest.approx(force, rel=1e-11, abs=0.0) and behind == -ahead
    assert barus_crook_traction(law, 1e4, 1e-6, 0.0) == 0.0


def contact(name, number):
    return prepare(CHOICES[name][0], Bearing.read("skf-240-600-bc"), OIL, 1)[number]


def test_force_is_bounded_by_limiting_shear_and_vanishes_with_slip():
    load, film = (
        np.array([1e-9, 3.0, 2e5, 1e7])[:, None, None],
        np.array([1e-12, 1e-7, 1e-2])[:, None],
    )
    force = contact("limiting shear", 0).uniform_traction(
        load, film, np.array([0.0, 1e-300, 1e-12, 10.0, 1e6])
    )
    assert np.all(np.abs(force) <= 0.042 * load * (1 + 1e-4)) and np.all(force[..., 0] == 0.0)


def test_light_load_is_isoviscous():
    """F → η0 Δu/h times the area of the ellipse."""
    for name in ("physical", "newtonian", "barus"):
        law = contact(name, 0)
        hertz = law.interface.hertz
        for load in (1e-9, 1e-6):
            area = math.pi * hertz.semi_axis_across * hertz.semi_axis_along * load ** (2 / 3)
            assert law.uniform_traction(load, 1e-4, 1e-3) == pytest.approx(
                0.54 * area * 1e-3 / 1e-4, rel=0.02
            )


# --- The closed patch integral

# Where the code changes its formula, and neighbours at both sides.
COOL_LOG, SMALL_P, MEDIUM_P, LARGE_U = 0.5 * math.log(0.02), 0.4, 1.2, 1.1
EDGES_P = [
    0.0,
    1e-300,
    1e-12,
    1e-6,
    1e-3,
    0.05,
    0.999,
    1.001,
    2.0,
    3.3,
    5.0,
    10.0,
    20.0,
    31.0,
    45.0,
    60.0,
] + [edge * side for edge in (SMALL_P, MEDIUM_P, 0.5, 1.0) for side in (1 - 1e-9, 1.0, 1 + 1e-9)]
PANEL_NODES, PANEL_WEIGHTS = np.polynomial.legendre.leggauss(40)
PANELS = 24


def quadrature(p, log_q0):
    """Φ and its derivatives by ln q0 and by P: ∫₀¹ s e^{Ps} g(B0 e^{Ps}) ds by Gauss panels, complex steps for slopes.

    The integrand is positive and analytic within π/2 of the real axis of ln q, and panels are at most 1.25 wide there,
    so that the sum is exact to rounding.
    """
    p, log_q0 = np.broadcast_arrays(np.asarray(p, dtype=complex), np.asarray(log_q0, dtype=complex))
    s = ((np.arange(PANELS)[:, None] + 0.5 + 0.5 * PANEL_NODES) / PANELS).ravel()
    weights = np.tile(0.5 * PANEL_WEIGHTS / PANELS, PANELS)

    def integral(p, log_q0):
        q = np.exp(log_q0[..., None] + 0.5 * p[..., None] * s)
        # For tiny q the complex arcsinh of some libraries loses the imaginary part.
        ratio = np.where(abs(q) < 1e-3, 1 - q**2 * (2 / 3 - 8 / 15 * q**2), 0)
        ratio = np.where(
            abs(q) < 1e-3, ratio, np.log(q + np.sqrt(1 + q**2)) / (q * np.sqrt(1 + q**2))
        )
        return (weights * s * np.exp(p[..., None] * s) * ratio).sum(axis=-1)

    tiny = 1e-30
    by_slip = integral(p, log_q0 + 1j * tiny)
    return by_slip.real, by_slip.imag / tiny, integral(p + 1j * tiny, log_q0).imag / tiny


def check(p, log_q0, rel=2e-13, slope_rel=1e-12):
    p, log_q0 = np.broadcast_arrays(p, log_q0)
    value, by_slip, by_exponent = quadrature(p, log_q0)
    interpolated = np.transpose(
        [patch_integral(*state) for state in zip(p.ravel(), np.exp(log_q0).ravel(), strict=True)]
    )
    assert interpolated[0] == pytest.approx(value.ravel(), rel=rel, abs=0.0)
    assert np.all(abs(interpolated[1] - by_slip.ravel()) <= slope_rel * value.ravel())
    assert np.all(abs(interpolated[2] - by_exponent.ravel()) <= slope_rel * value.ravel())


def test_value_and_slopes_over_the_whole_range():
    # B0 from 1e-40 to 1e10, that is ln q0 from −46 to 11.5.
    p, log_q0 = np.meshgrid(EDGES_P, 0.5 * math.log(10.0) * np.linspace(-40.0, 10.0, 51))
    check(p.ravel(), log_q0.ravel())


@pytest.mark.parametrize("side", [-1e-6, -1e-12, 0.0, 1e-12, 1e-6, 1e-3, 0.1, 1.0])
def test_both_sides_of_the_changes_of_formula(side):
    p = np.array(EDGES_P)
    # q1 = q0 e^{P/2} at the end of the series for little heating; u1 and u0 at the end of the power series of M.
    check(p, COOL_LOG - 0.5 * p + side)
    check(p, math.log(math.sinh(LARGE_U)) - 0.5 * p + side)
    check(p, np.full(p.size, math.log(math.sinh(LARGE_U))) + side)


def polylogarithms(p, q0):
    """Φ in the closed form with dilogarithm and trilogarithm, which cancels and so needs many digits."""
    u0, u1 = mpmath.asinh(q0), mpmath.asinh(q0 * mpmath.exp(p / 2))

    def j(u):
        decay = mpmath.exp(-2 * u)
        parts = u * mpmath.polylog(2, decay) / 2 + mpmath.polylog(3, decay) / 4
        return u**3 / 3 - mpmath.ln2 * u**2 / 2 + parts

    bracket = j(u1) - j(u0) - mpmath.log(q0) * (u1**2 - u0**2) / 2
    return bracket * (2 / p) ** 2 / q0**2


@pytest.mark.parametrize("p", [0.2, 0.3, 1.1, 1.3, 5.0, 20.0, 60.0])
@pytest.mark.parametrize("q0", [1e-15, 1e-4, 0.03, 0.7, 20.0, 1e5])
def test_agrees_with_the_polylogarithm_form_and_its_derivatives(p, q0):
    with mpmath.workdps(60):
        p, q0 = mpmath.mpf(p), mpmath.mpf(q0)
        exact = polylogarithms(p, q0)
        step = mpmath.mpf(10) ** -12
        by_slip = (polylogarithms(p, q0 * (1 + step)) - polylogarithms(p, q0 * (1 - step))) / (
            2 * step
        )
        by_exponent = (polylogarithms(p + step, q0) - polylogarithms(p - step, q0)) / (2 * step)
        exact, by_slip, by_exponent = float(exact), float(by_slip), float(by_exponent)
    integral = patch_integral(float(p), float(q0))
    assert integral[0] == pytest.approx(exact, rel=1e-12, abs=0.0)
    assert integral[1:] == pytest.approx((by_slip, by_exponent), abs=1e-11 * exact)


@pytest.mark.parametrize("p", [0.0, 1e-9, 0.1, 0.4, 0.999999, 1.0, 1.2, 5.0, 60.0, 350.0])
def test_cold_patch_is_the_linear_limit(p):
    with mpmath.workdps(40):
        x = mpmath.mpf(p)
        series = (
            mpmath.nsum(lambda k: x**k / (mpmath.factorial(k) * (k + 2)), [0, mpmath.inf])
            if p < 0.01
            else None
        )
        value = series if p < 0.01 else (mpmath.exp(x) * (x - 1) + 1) / x**2
        # ∫ s² e^{xs} ds
        slope = (mpmath.exp(x) - 2 * value) / x if p > 1e-12 else mpmath.mpf(1) / 3
        value, slope = float(value), float(slope)
    integral = patch_integral(p, 0.0)
    assert integral == pytest.approx((value, 0.0, slope), rel=2e-14, abs=0.0)


def test_cold_patch_stays_a_number_beyond_the_range():
    # e^{2P} is beyond floating point here, though the value is not.
    assert all(math.isfinite(part) for part in patch_integral(650.0, 0.0))
