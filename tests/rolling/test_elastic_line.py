"""The rolling resistance of a line contact against full solutions of film and elasticity."""

import math

import numpy as np
import pytest

from macroslip.film.moes import moes
from macroslip.rolling.elastic_line import RIGID, InletFilm, WholeFilm, line_rolling, log_elastic
from macroslip.rolling.martin import FLOW, SHEAR

pytestmark = pytest.mark.slow

GRID = [
    (0.1, 13.4),
    (0.6, 4.0),
    (0.6, 13.4),
    (1.5, 7.0),
    (3.0, 2.0),
    (6.0, 10.0),
    (11.0, 4.0),
    (11.0, 13.4),
    (32.0, 13.4),
]


@pytest.fixture(scope="module")
def solutions(line_contact):
    return {(m, material): line_contact.climb(m, [material], 350)[0] for m, material in GRID}


@pytest.mark.parametrize("place", GRID)
def test_whole_film_is_within_four_percent(solutions, place):
    # 3 % of the fit and 1 % of this grid.
    assert line_rolling(WholeFilm(), *place) == pytest.approx(solutions[place].rolling, rel=0.04)


@pytest.mark.parametrize("place", GRID)
def test_moment_of_pressure_is_the_work_of_shear(solutions, place):
    # −½ ∫ p x/R dx = ½ ∫ h dp/dx dx: elastic deformation is symmetric. It is the energy balance 2 F_R u as well.
    assert solutions[place].rolling == pytest.approx(solutions[place].rolling_by_shear, rel=3e-3)


@pytest.mark.parametrize("place", GRID)
def test_film_is_that_of_moes(solutions, place):
    assert solutions[place].film == pytest.approx(moes(*place), rel=0.06)


def test_rigid_limit_is_martins(line_contact):
    solution = line_contact.solve_line(0.003, 0.0, 600)
    assert solution.rolling == pytest.approx(RIGID * math.sqrt(0.003), rel=2e-3)
    assert solution.film * 0.003 == pytest.approx(3.0, rel=2e-3)
    assert solution.gap_integral == pytest.approx(SHEAR * math.sqrt(2.0 * FLOW / solution.film), rel=3e-3)


def test_grid_error_is_of_second_order(line_contact):
    forces = [line_contact.solve_line(0.3, 0.0, nodes).rolling for nodes in (150, 300, 600)]
    ratio = (forces[1] - forces[0]) / (forces[2] - forces[1])
    assert 2.5 < ratio < 7.0
    # By Richardson's extrapolation what is left of the error is a third of the last change.
    assert abs(forces[2] - forces[1]) / 3.0 < 1e-3 * forces[2]


def test_exit_resists_beside_the_inlet(solutions):
    """The published inlet is the inlet's share of a full solution; the constriction adds a third to a half."""
    solution = solutions[11.0, 13.4]
    scale = math.sqrt(8.0 * 11.0 / math.pi) * 11.0 / math.pi
    middle = 0.5 * (solution.gap[1:] + solution.gap[:-1])
    place = 0.5 * (solution.place[1:] + solution.place[:-1])
    work = 0.5 * scale * (middle - solution.film * math.pi / 44.0) * np.diff(solution.pressure)
    inlet, outlet = work[place < -0.9].sum(), work[place > 0.6].sum()
    assert inlet == pytest.approx(line_rolling(InletFilm(), 11.0, 13.4), rel=0.03)
    assert 0.3 < outlet / inlet < 0.5
    assert inlet + outlet == pytest.approx(solution.rolling, rel=0.02)


@pytest.mark.parametrize("law", [InletFilm(), WholeFilm()])
@pytest.mark.parametrize("place", [(-1.0, 0.0), (0.5, 1.0), (3.0, 2.6), (3.0, -8.0)])
def test_derivatives(law, place):
    step = 1e-5
    _, by_load, by_material = log_elastic(law, *place)
    up, down = log_elastic(law, place[0] + step, place[1])[0], log_elastic(law, place[0] - step, place[1])[0]
    assert by_load == pytest.approx((up - down) / (2.0 * step), abs=1e-8)
    up, down = log_elastic(law, place[0], place[1] + step)[0], log_elastic(law, place[0], place[1] - step)[0]
    assert by_material == pytest.approx((up - down) / (2.0 * step), abs=1e-8)
