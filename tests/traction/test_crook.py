"""Crook's self-heated film against the boundary-value problem of conduction that it solves."""

import math

import mpmath
import numpy as np
import pytest
from scipy.integrate import solve_bvp, solve_ivp

from macroslip.mechanisms import Laws
from macroslip.roller.contacts import references
from macroslip.traction import heating_number, shear_stress, shear_stress_slope
from macroslip.traction import traction_law as traction_law
from macroslip.traction.crook import thermal_reduction

VISCOSITY, BETA, CONDUCTIVITY, FILM = 0.7, 0.05, 0.13, 1.3e-6
OIL = (VISCOSITY, BETA, CONDUCTIVITY)


def slip_at(heating):
    return math.sqrt(8.0 * CONDUCTIVITY * heating / (BETA * VISCOSITY))


def shoot(mid_rise):
    """Slip and shear stress of a film whose middle is `mid_rise` [K] above the walls, from k T'' = −τ²/η(T).

    With θ = β(T − T_wall) and the coordinate scaled so that θ'' = −exp θ, shooting from the middle, where θ' = 0, to
    θ = 0 gives the half thickness; the scaled slip across that half is ∫ exp θ = −θ'.
    """

    def rhs(_, state):
        return [state[1], -math.exp(state[0])]

    def wall(_, state):
        return state[0]

    wall.terminal = True
    top = BETA * mid_rise
    span = (0.0, 2.0 * math.sqrt(2.0 * top) + 3.0)
    accuracy = {"method": "DOP853", "rtol": 3e-14, "atol": 1e-17}
    found = solve_ivp(rhs, span, [top, 0.0], events=wall, max_step=0.1 * min(math.sqrt(top), 1.0), **accuracy)
    half, slope = found.t[-1], found.y[1, -1]
    half -= found.y[0, -1] / slope
    # half = (h/2) √(β/(k η)) τ; slip = (τ h/η) ∫ exp θ over the film.
    stress = 2.0 * half / FILM * math.sqrt(CONDUCTIVITY * VISCOSITY / BETA)
    return stress * FILM / VISCOSITY * -slope / half, stress


@pytest.mark.parametrize("heating", 10.0 ** np.arange(-4.0, 4.5, 0.5))
def test_stress_solves_the_conduction_problem(heating):
    slip, stress = shoot(math.log1p(heating) / BETA)
    assert shear_stress(*OIL, FILM, slip) == pytest.approx(stress, rel=1e-10, abs=0.0)
    # The middle of the film is ln(1 + B)/β above the walls.
    assert heating_number(*OIL, slip) == pytest.approx(heating, rel=1e-9, abs=0.0)


@pytest.mark.parametrize("heating", [1e-2, 1.0, 2.2767, 50.0])
def test_stress_agrees_with_a_solver_of_boundary_value_problems(heating):
    # Unknowns temperature, its gradient and velocity over the film z in [0, 1]; τ is the parameter.
    slip = slip_at(heating)
    scale = VISCOSITY * slip / FILM

    def rhs(z, y, p):
        fluidity = p[0] * np.exp(y[0])
        return np.array([y[1], -8.0 * heating * p[0] * fluidity, fluidity])

    def walls(left, right, p):
        return np.array([left[0], right[0], left[2], right[2] - 1.0])

    z = np.linspace(0.0, 1.0, 101)
    rise = math.log1p(heating) * 4.0 * z * (1.0 - z)
    found = solve_bvp(rhs, walls, z, np.array([rise, 0.0 * z, z]), p=[1.0 / (1.0 + heating)], tol=1e-9, max_nodes=20000)
    assert found.success
    assert shear_stress(*OIL, FILM, slip) == pytest.approx(found.p[0] * scale, rel=1e-8, abs=0.0)


def test_heating_number_by_hand():
    assert heating_number(0.54, 0.056, 0.125, -10.0) == pytest.approx(0.056 * 0.54 * 100 / 1.0, rel=1e-15, abs=0.0)


@pytest.mark.parametrize("heating", [0.0, 1e-300, 1e-12, 0.9e-8, 1.1e-8, 1e-3, 1.0, 1e6, 1e12])
def test_thermal_reduction_in_high_precision(heating):
    with mpmath.workdps(40):
        b = mpmath.mpf(heating)
        exact = mpmath.asinh(mpmath.sqrt(b)) / mpmath.sqrt(b * (1 + b)) if heating else mpmath.mpf(1)
    assert thermal_reduction(heating) == pytest.approx(float(exact), rel=1e-15, abs=0.0)


def test_cold_film_is_newtonian():
    assert shear_stress(*OIL, FILM, 1e-9) == pytest.approx(VISCOSITY * 1e-9 / FILM, rel=1e-14, abs=0.0)
    assert shear_stress_slope(*OIL, FILM, 0.0) == pytest.approx(VISCOSITY / FILM, rel=1e-15, abs=0.0)


def test_stress_is_odd_and_its_slope_even():
    slip = np.array([1e-12, 1e-3, 1.0, 30.0])
    assert np.array_equal(shear_stress(*OIL, FILM, -slip), -shear_stress(*OIL, FILM, slip))
    assert np.array_equal(shear_stress_slope(*OIL, FILM, -slip), shear_stress_slope(*OIL, FILM, slip))
    assert np.all(shear_stress(*OIL, FILM, slip) > 0.0)
    assert shear_stress(*OIL, FILM, 0.0) == 0.0


@pytest.mark.parametrize("heating", [1e-6, 1e-2, 0.5, 2.0, 3.0, 100.0, 1e4])
def test_slope_is_the_derivative(heating):
    def stress(slip):
        b = mpmath.mpf(BETA) * VISCOSITY * slip**2 / (8 * mpmath.mpf(CONDUCTIVITY))
        return mpmath.mpf(VISCOSITY) * mpmath.asinh(mpmath.sqrt(b)) / mpmath.sqrt(b * (1 + b)) * slip / FILM

    slip = slip_at(heating)
    with mpmath.workdps(40):
        exact = float(mpmath.diff(stress, mpmath.mpf(slip)))
    assert shear_stress_slope(*OIL, FILM, slip) == pytest.approx(exact, rel=1e-13, abs=0.0)


def test_stress_peaks_at_the_known_heating():
    # √(1+B) = √B asinh √B.
    peak = mpmath.findroot(lambda b: mpmath.sqrt(1 + b) - mpmath.sqrt(b) * mpmath.asinh(mpmath.sqrt(b)), 2.0)
    assert float(peak) == pytest.approx(2.2767, abs=5e-5)
    slip = slip_at(float(peak))
    assert abs(shear_stress_slope(*OIL, FILM, slip)) < 1e-14 * VISCOSITY / FILM
    assert shear_stress_slope(*OIL, FILM, 0.999 * slip) > 0.0 > shear_stress_slope(*OIL, FILM, 1.001 * slip)
    around = shear_stress(*OIL, FILM, slip * np.linspace(0.5, 2.0, 301))
    assert around.max() <= shear_stress(*OIL, FILM, slip)


def test_functions_broadcast():
    slip, film = np.array([0.1, 1.0]), np.array([[1e-6], [2e-6], [4e-6]])
    table = shear_stress(VISCOSITY, BETA, CONDUCTIVITY, film, slip)
    assert table.shape == (3, 2)
    assert table * film == pytest.approx(np.broadcast_to(table[0] * 1e-6, (3, 2)), rel=1e-14, abs=0.0)
    assert np.ndim(shear_stress(*OIL, FILM, 1.0)) == 0


def test_unknown_law_is_told_with_the_choices():
    with pytest.raises(ValueError, match="^laws.traction: there is no traction law 'coulomb'. Allowed: .*mechanisms"):
        traction_law.prepare("coulomb", None)


def test_crook_is_cited_where_shear_heats_the_film():
    cited = "10.1098/rsta.1961.0014"
    assert any(cited in one for one in references(Laws.paper()))
    assert not any(cited in one for one in references(Laws.paper().but(heating=False)))
