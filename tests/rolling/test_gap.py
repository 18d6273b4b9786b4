"""The table of a rigid gap against another discretisation, exact limits and its own solver's order and energy."""

import math

import numpy as np
import pytest
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve

from macroslip.errors import InputError
from macroslip.rolling import martin
from macroslip.rolling.gap import GapShape, film_at_gap, film_at_load, prepare_gap, ratios

pytestmark = pytest.mark.slow


def finite_elements(kappa, aspect, nodes=(120, 28)):
    """Load and rolling integrals by bilinear elements and Gauss points on X = c tan θ, with projected Newton steps."""
    wide = math.sqrt(1.0 + kappa)
    scale = 1.5 * math.sqrt(wide)
    theta = np.linspace(math.atan(-2000.0 / scale), math.atan(1.0 * wide / scale), nodes[0] + 1)
    x = scale * np.tan(theta)
    s = np.linspace(0.0, 1.0, nodes[1] + 1)
    z = np.sin(0.5 * math.pi * s) if kappa < 4.0 else s**1.3
    count = (nodes[0] + 1) * (nodes[1] + 1)
    dx, dz = np.diff(x)[:, None], np.diff(z)[None, :]
    i, j = np.meshgrid(np.arange(nodes[0]), np.arange(nodes[1]), indexing="ij")
    corner = [(i + a) * (nodes[1] + 1) + j + b for a, b in ((0, 0), (1, 0), (0, 1), (1, 1))]
    stiffness = [[0.0] * 4 for _ in range(4)]
    source, mass = [0.0] * 4, [0.0] * 4
    points, weights = np.polynomial.legendre.leggauss(4)
    for u, wu in zip(0.5 + 0.5 * points, 0.5 * weights, strict=True):
        for v, wv in zip(0.5 + 0.5 * points, 0.5 * weights, strict=True):
            place_x, place_z = x[:-1, None] + u * dx, z[None, :-1] + v * dz
            cubed = (1.0 + place_x**2 + kappa * place_z**2) ** 3
            shape = [(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v]
            by_x = [-(1 - v) / dx, (1 - v) / dx, -v / dx, v / dx]
            by_z = [-(1 - u) / dz, -u / dz, (1 - u) / dz, u / dz]
            area = wu * wv * dx * dz
            for a in range(4):
                source[a] = source[a] + 2.0 * place_x * shape[a] * area
                mass[a] = mass[a] + shape[a] * area
                for b in range(4):
                    stiffness[a][b] = (
                        stiffness[a][b] + cubed * (by_x[a] * by_x[b] + aspect**2 * by_z[a] * by_z[b]) * area
                    )
    rows = np.concatenate([corner[a].ravel() for a in range(4) for b in range(4)])
    columns = np.concatenate([corner[b].ravel() for a in range(4) for b in range(4)])
    values = np.concatenate([np.broadcast_to(stiffness[a][b], i.shape).ravel() for a in range(4) for b in range(4)])
    matrix = coo_matrix((values, (rows, columns)), shape=(count, count)).tocsr()
    right, area = np.zeros(count), np.zeros(count)
    for a in range(4):
        np.add.at(right, corner[a].ravel(), source[a].ravel())
        np.add.at(area, corner[a].ravel(), np.broadcast_to(mass[a], i.shape).ravel())
    free = np.ones((nodes[0] + 1, nodes[1] + 1), bool)
    free[0], free[-1], free[:, -1] = False, False, False
    free = free.ravel()
    active = free & np.repeat(x < 0.5 * wide, nodes[1] + 1)
    for _ in range(60):
        inside = np.flatnonzero(active)
        pressure = np.zeros(count)
        pressure[inside] = spsolve(matrix[inside][:, inside].tocsc(), -right[inside])
        residual = matrix @ pressure + right
        settled = np.where(active, pressure > 0.0, residual < -1e-12) & free
        if np.array_equal(settled, active):
            break
        active = settled
    else:
        raise AssertionError("the reference does not settle")
    return 2.0 * float(area @ pressure), -2.0 * float(right @ pressure)


def slices(kappa):
    root = math.sqrt(kappa)
    return (
        martin.LOAD / 12.0 * math.atan(root) / root,
        martin.ROLLING_AT_GAP * math.sqrt(2.0) / 6.0 * math.asinh(root) / root,
    )


@pytest.mark.parametrize(("kappa", "aspect"), [(0.7, 0.05), (3.0, 0.3), (40.0, 0.06), (1e-4, 0.8)])
def test_table_is_confirmed_by_finite_elements(kappa, aspect):
    expected = np.array(finite_elements(kappa, aspect)) / slices(kappa)
    assert ratios(kappa, aspect)[:2] == pytest.approx(expected, rel=0.015)


@pytest.mark.parametrize(("kappa", "aspect"), [(0.5, 0.033), (17.0, 0.21)])
def test_between_its_places_the_table_is_the_solution(gap_solution, kappa, aspect):
    coarse, fine = (np.array(gap_solution.solve_gap(kappa, aspect, cells)[:3]) for cells in ((90, 22), (180, 44)))
    load, rolling = slices(kappa)
    limits = load, rolling, 2.0 * martin.SHEAR * math.asinh(math.sqrt(kappa)) / math.sqrt(kappa)
    assert ratios(kappa, aspect) == pytest.approx((fine + (fine - coarse) / 3.0) / limits, rel=5e-3)


def test_solver_converges_with_second_order(gap_solution):
    first, second, third = (
        gap_solution.solve_gap(1.0, 0.2, cells).rolling for cells in ((60, 15), (120, 30), (240, 60))
    )
    assert 2.5 < (second - first) / (third - second) < 6.0


def test_power_lost_is_power_dissipated(gap_solution):
    solution = gap_solution.solve_gap(2.0, 0.3, (80, 20))
    assert solution.dissipation == pytest.approx(solution.rolling, rel=1e-10)


def test_without_side_flow_slices_are_martins():
    # A line: R_y infinite in effect, the film thin against the length.
    radius, length, gap = 0.03, 10.0, 1e-6
    film = prepare_gap(GapShape(radius, 1e12, length))
    load, _, rolling, _, shear, _ = film_at_gap(film, math.log(gap))
    assert math.exp(load) == pytest.approx(martin.LOAD * radius * length / gap, rel=2e-3)
    assert math.exp(rolling) == pytest.approx(martin.ROLLING_AT_GAP * length * math.sqrt(radius / gap), rel=5e-3)
    assert math.exp(shear) == pytest.approx(martin.SHEAR * length * math.sqrt(2.0 * radius / gap), rel=2e-3)


@pytest.mark.parametrize("name", ["inner", "cage"])
def test_both_splines_are_one_film(contacts, name):
    _, shape, _ = contacts[name]
    film = prepare_gap(shape)
    for gap in np.geomspace(1e-6, 1e-3, 13):
        load, load_slope, rolling, rolling_slope, shear, _ = film_at_gap(film, math.log(gap))
        again, slope, same_rolling, same_slope, same_shear, _ = film_at_load(film, load)
        assert (again, same_rolling, same_shear) == pytest.approx((math.log(gap), rolling, shear), abs=2e-4)
        assert slope == pytest.approx(1.0 / load_slope, rel=5e-3)
        assert same_slope == pytest.approx(rolling_slope / load_slope, rel=5e-3)


@pytest.mark.parametrize("place", [-30.0, -11.3, -8.0, 5.0])
def test_derivatives_within_and_beyond_the_table(contacts, place):
    film = prepare_gap(contacts["inner"][1])
    values = film_at_gap(film, place)
    up, down = film_at_gap(film, place + 1e-5), film_at_gap(film, place - 1e-5)
    for which in (0, 2, 4):
        assert values[which + 1] == pytest.approx((up[which] - down[which]) / 2e-5, rel=1e-6)


@pytest.mark.parametrize("fullness", [0.0, -0.1, 1.5, math.nan])
def test_fullness_out_of_range_is_refused(contacts, fullness):
    with pytest.raises(InputError, match="fullness"):
        prepare_gap(contacts["inner"][1], fullness)
