"""Rolling resistance and light contacts: Martin, full solutions of the film, finite elements, limits."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve

from macroslip.contact import gap as martin
from macroslip.contact.film import log_moes
from macroslip.contact.gap import GapShape, film_at_gap, film_at_load, prepare_gap, ratios
from macroslip.contact.rolling import (
    RIGID,
    ROLLING,
    _beside,
    contact_at_gap,
    inlet_heating_of_rolling,
    light_contact,
    line_rolling,
    prepare_rolling,
    rigid_pocket_contact,
    starvation_factor,
)
from macroslip.contact.starvation import film_factor
from macroslip.errors import InputError

pytestmark = pytest.mark.slow

SPEED = 0.396
NAMES = ("inlet", "whole-film")
WHERE = pytest.mark.parametrize("where", ["inner", "outer", "cage"])


def line_film(load, material):
    """N of a line contact by Moes, from M and L."""
    return math.exp(log_moes(math.log(3.0 / load), math.log(load), math.log(material)))


@pytest.fixture(scope="module")
def laws(contacts):
    return {
        (name, where): prepare_rolling(name, *contacts[where])
        for name in NAMES
        for where in contacts
    }


def resistance(numbers, load, speed=SPEED):
    return light_contact(numbers, load, speed)[1]


def beside_ellipse(numbers, load):
    """Resistance of the film beside the ellipse of an elastic contact."""
    smallest = light_contact(numbers, load, SPEED)[2] / martin.FLOW
    return float(_beside(numbers, math.log(load), math.log(SPEED), math.log(smallest)))


# --- Martin's line


def slope(t, end):
    return (t * t - end * end) / (1.0 + t * t) ** 3


def starved(inlet):
    """Factors on load, rolling force and shear at a given h0; the film begins where the gap is S times the flow's."""

    def exit_of(start):
        return brentq(lambda e: quad(slope, start, e, args=(e,), epsabs=1e-14)[0], 1e-6, 0.9)

    start = -brentq(lambda s: 1.0 + s * s - inlet * (1.0 + exit_of(-s) ** 2), 0.1, 1e3)
    end = exit_of(start)
    load = -24.0 * quad(lambda t: t * slope(t, end), start, end, epsabs=1e-13)[0] / martin.LOAD
    rolling = (
        6.0
        * math.sqrt(2.0)
        * quad(lambda t: (1.0 + t * t) * slope(t, end), start, end, epsabs=1e-13)[0]
    )
    shear = quad(lambda t: 1.0 / (1.0 + t * t), start, end)[0] / martin.SHEAR
    return load, rolling / martin.ROLLING_AT_GAP, shear


def test_martins_constants_solve_reynolds_equation():
    def integral(function, end):
        return quad(function, -math.inf, end, epsabs=1e-13, epsrel=1e-13)[0]

    end = brentq(lambda e: integral(lambda t: slope(t, e), e), 0.2, 0.9, xtol=1e-14)
    assert end == pytest.approx(martin.EXIT, abs=1e-10)
    # w h0/(η u R) = 24 ∫ p̂ dt with p̂' = slope, by parts; F_R √h0/(η u √R) = 6 √2 ∫ (1 + t²) slope dt.
    assert -24.0 * integral(lambda t: t * slope(t, end), end) == pytest.approx(
        martin.LOAD, rel=1e-9
    )
    rolling = 6.0 * math.sqrt(2.0) * integral(lambda t: (1.0 + t * t) * slope(t, end), end)
    assert rolling == pytest.approx(martin.ROLLING_AT_GAP, rel=1e-9)
    assert integral(lambda t: 1.0 / (1.0 + t * t), end) == pytest.approx(martin.SHEAR, rel=1e-12)
    assert pytest.approx((4.895, 2.0796, 2.0144), abs=5e-5) == (martin.LOAD, ROLLING, martin.SHEAR)
    # No moment on a free roller: −F_R + η Δu ∫dx/h = 0 at a slip of 1.6 times the mean speed.
    assert martin.ROLLING_AT_GAP / (martin.SHEAR * math.sqrt(2.0)) == pytest.approx(1.615, abs=5e-4)


@pytest.mark.parametrize("inlet", [1.2, 2.0, 10.0, 300.0])
def test_starved_line_by_quadrature(inlet):
    assert martin.starved_martin(inlet) == pytest.approx(starved(inlet), rel=1e-6)


def test_starvation_ends_in_the_flooded_contact():
    assert martin.starved_martin(math.inf) == (1.0, 1.0, 1.0)
    assert martin.starved_martin(1e7) == pytest.approx((1.0, 1.0, 1.0), abs=1e-3)
    assert starvation_factor(math.inf) == 1.0


@pytest.mark.parametrize(
    ("inlet", "tolerance"), [(5.0, 0.08), (10.0, 0.06), (30.0, 0.01), (100.0, 0.025)]
)
def test_biboulet_and_houperts_starvation_is_that_of_a_rigid_contact_under_load(inlet, tolerance):
    load, rolling, _ = starved(inlet)
    assert starvation_factor(inlet) == pytest.approx(rolling / math.sqrt(load), rel=tolerance)


# --- The elastic line

GRID = [
    (0.1, 13.4),
    (0.6, 4.0),
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


@pytest.mark.parametrize("moes_numbers", GRID)
def test_whole_film_is_within_four_percent(solutions, moes_numbers):
    # 3 % of the fit and 1 % of this grid.
    assert line_rolling("whole-film", *moes_numbers) == pytest.approx(
        solutions[moes_numbers].rolling, rel=0.04
    )
    # −½ ∫ p x/R dx = ½ ∫ h dp/dx dx: elastic deformation is symmetric. It is the energy balance 2 F_R u as well.
    assert solutions[moes_numbers].rolling == pytest.approx(
        solutions[moes_numbers].rolling_by_shear, rel=3e-3
    )
    assert solutions[moes_numbers].film == pytest.approx(line_film(*moes_numbers), rel=0.06)


def test_rigid_limit_is_martins(line_contact):
    solution = line_contact.solve_line(0.003, 0.0, 600)
    assert solution.rolling == pytest.approx(RIGID * math.sqrt(0.003), rel=2e-3)
    assert solution.film * 0.003 == pytest.approx(3.0, rel=2e-3)
    assert solution.gap_integral == pytest.approx(
        martin.SHEAR * math.sqrt(2.0 * martin.FLOW / solution.film), rel=3e-3
    )
    for name in NAMES:
        assert line_rolling(name, 1e-6, 13.4) == pytest.approx(RIGID * 1e-3, rel=1e-6)


def test_exit_resists_beside_the_inlet(solutions):
    """The published inlet is the inlet's share of a full solution; the constriction adds a third to a half."""
    solution = solutions[11.0, 13.4]
    scale = math.sqrt(8.0 * 11.0 / math.pi) * 11.0 / math.pi
    middle = 0.5 * (solution.gap[1:] + solution.gap[:-1])
    position = 0.5 * (solution.position[1:] + solution.position[:-1])
    work = 0.5 * scale * (middle - solution.film * math.pi / 44.0) * np.diff(solution.pressure)
    inlet, outlet = work[position < -0.9].sum(), work[position > 0.6].sum()
    assert inlet == pytest.approx(line_rolling("inlet", 11.0, 13.4), rel=0.03)
    assert 0.3 < outlet / inlet < 0.5
    assert inlet + outlet == pytest.approx(solution.rolling, rel=0.02)


def test_heating_lowers_the_force_and_vanishes_at_rest():
    assert inlet_heating_of_rolling(0.0) == 1.0
    assert (
        inlet_heating_of_rolling(10.0) < inlet_heating_of_rolling(1.0) == pytest.approx(1.0 / 1.29)
    )


# --- The rigid gap of finite length


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
                        stiffness[a][b]
                        + cubed * (by_x[a] * by_x[b] + aspect**2 * by_z[a] * by_z[b]) * area
                    )
    rows = np.concatenate([corner[a].ravel() for a in range(4) for b in range(4)])
    columns = np.concatenate([corner[b].ravel() for a in range(4) for b in range(4)])
    values = np.concatenate(
        [np.broadcast_to(stiffness[a][b], i.shape).ravel() for a in range(4) for b in range(4)]
    )
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
    coarse, fine = (
        np.array(gap_solution.solve_gap(kappa, aspect, cells)[:3])
        for cells in ((90, 22), (180, 44))
    )
    load, rolling = slices(kappa)
    limits = load, rolling, 2.0 * martin.SHEAR * math.asinh(math.sqrt(kappa)) / math.sqrt(kappa)
    assert ratios(kappa, aspect) == pytest.approx((fine + (fine - coarse) / 3.0) / limits, rel=5e-3)


def test_power_lost_is_power_dissipated(gap_solution):
    solution = gap_solution.solve_gap(2.0, 0.3, (80, 20))
    assert solution.dissipation == pytest.approx(solution.rolling, rel=1e-10)


def test_without_side_flow_slices_are_martins():
    # A line: R_y infinite in effect, the film thin against the length.
    radius, length, gap = 0.03, 10.0, 1e-6
    load, rolling, shear = np.exp(
        film_at_gap(prepare_gap(GapShape(radius, 1e12, length)), math.log(gap))
    )
    assert load == pytest.approx(martin.LOAD * radius * length / gap, rel=2e-3)
    assert rolling == pytest.approx(
        martin.ROLLING_AT_GAP * length * math.sqrt(radius / gap), rel=5e-3
    )
    assert shear == pytest.approx(martin.SHEAR * length * math.sqrt(2.0 * radius / gap), rel=2e-3)


@pytest.mark.parametrize("name", ["inner", "cage"])
def test_both_splines_are_one_film(contacts, name):
    gap = prepare_gap(contacts[name][1])
    log_gap = np.log(np.geomspace(1e-6, 1e-3, 13))
    load, rolling, shear = film_at_gap(gap, log_gap)
    assert np.array(film_at_load(gap, load)) == pytest.approx(
        np.array([log_gap, rolling, shear]), abs=2e-4
    )


def test_beyond_its_knots_the_gap_follows_powers(contacts):
    gap = prepare_gap(contacts["inner"][1])
    for places in (np.array([-30.0, -29.0, -28.0]), np.array([2.0, 3.0, 4.0])):
        for values in film_at_gap(gap, places):
            assert np.diff(values, 2) == pytest.approx(0.0, abs=1e-9)


@WHERE
def test_a_gap_lacks_oil_where_its_film_is_thick_and_a_surface_that_ends_lets_no_more_in(
    contacts, where
):
    shape, filled = contacts[where][1], 2e-4
    full, short, spar = (prepare_gap(shape, *inlets) for inlets in ((), (filled,), (math.inf, 7.0)))
    for inlet in (2.0, 10.0, 100.0):
        log_gap = math.log(filled / (inlet * martin.FLOW))
        flooded = np.array(film_at_gap(full, log_gap))
        assert np.exp(film_at_gap(short, log_gap) - flooded) == pytest.approx(
            starved(inlet), rel=2e-3
        )
        assert np.exp(film_at_gap(spar, log_gap) - flooded) == pytest.approx(starved(7.0), rel=2e-3)


# --- Contacts


@pytest.mark.parametrize("name", NAMES)
@WHERE
def test_light_contact_is_the_rigid_gap(laws, name, where):
    numbers = laws[name, where]
    _, rolling, shear = film_at_load(numbers.gap, math.log(0.5 / (numbers.viscosity * SPEED)))
    conductance, resistance, film = light_contact(numbers, 0.5, SPEED)
    assert resistance == pytest.approx(numbers.viscosity * SPEED * math.exp(rolling), rel=1e-3)
    # The ellipse's own share of the shear is small.
    assert conductance == pytest.approx(numbers.viscosity * math.exp(shear), rel=0.03)
    load, _, per_speed = contact_at_gap(numbers, film / martin.FLOW)
    assert load * SPEED == pytest.approx(0.5, rel=0.02)
    assert per_speed * SPEED == pytest.approx(resistance, rel=0.01)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("load", [1e4, 2e4, 5e4, 1e5])
def test_heavy_contact_is_its_slices_and_the_film_beside_them(contacts, name, load):
    interface, shape, roller_radius = contacts["inner"]
    numbers = prepare_rolling(name, interface, shape, roller_radius, heating=False)
    radius, modulus, oil = interface.rolling_radius, interface.modulus, interface.lubricant
    across = interface.hertz.semi_axis_across * load ** (1.0 / 3.0)
    doubled = 2.0 * oil.viscosity * SPEED / (modulus * radius)
    middle = 0.75 * load / across / (modulus * radius) / math.sqrt(doubled)
    material = oil.pressure_viscosity * modulus * doubled**0.25
    whole = (
        2.0
        * quad(lambda z: line_rolling(name, middle * (1.0 - z * z), material), 0.0, 1.0, limit=200)[
            0
        ]
    )
    inside = across * modulus * radius * doubled**0.75 * whole
    assert resistance(numbers, load) == pytest.approx(
        inside + beside_ellipse(numbers, load), rel=0.03
    )


def test_beside_the_ellipse_every_slice_is_martins(laws, contacts):
    numbers, (interface, shape, _) = laws["inlet", "outer"], contacts["outer"]
    load = 2e4
    across = interface.hertz.semi_axis_across * load ** (1.0 / 3.0)
    lowest = float(light_contact(numbers, load, SPEED)[2]) / martin.FLOW

    def per_length(z):
        gap = lowest + (z * z - across * across) / (2.0 * shape.lateral_radius)
        return (
            martin.ROLLING_AT_GAP
            * numbers.viscosity
            * SPEED
            * math.sqrt(shape.rolling_radius / gap)
        )

    expected = 2.0 * quad(per_length, across, 0.5 * shape.length)[0]
    assert beside_ellipse(numbers, load) == pytest.approx(expected, rel=1e-8)
    longer = (0.5 * shape.length / interface.hertz.semi_axis_across) ** 3
    assert beside_ellipse(numbers, 1.01 * longer) == 0.0


@pytest.mark.parametrize("name", NAMES)
@WHERE
def test_force_rises_with_load_and_speed_and_film_falls_without_a_step(laws, name, where):
    loads = np.geomspace(0.01, 1e5, 1500)
    conductance, force, film = light_contact(laws[name, where], loads, SPEED)
    assert (
        (np.diff(force) > 0.0).all() and (np.diff(film) < 0.0).all() and (conductance > 0.0).all()
    )
    step = np.log(loads[1] / loads[0])
    assert np.diff(np.log(force)).max() < 0.75 * step and np.diff(np.log(film)).min() > -2.2 * step
    assert (np.diff(resistance(laws[name, where], 1e3, np.geomspace(0.01, 3.0, 300))) > 0.0).all()


def test_film_is_the_gaps_where_rigid_and_moes_where_elastic(laws, contacts):
    for where in ("inner", "cage"):
        interface, numbers, load = contacts[where][0], laws["whole-film", where], 1e5
        doubled = 2.0 * numbers.viscosity * SPEED / (interface.modulus * interface.rolling_radius)
        group = 0.75 * load ** (2.0 / 3.0) / interface.hertz.semi_axis_across
        group /= interface.modulus * interface.rolling_radius * math.sqrt(doubled)
        material = interface.lubricant.pressure_viscosity * interface.modulus * doubled**0.25
        elastic = interface.rolling_radius * math.sqrt(doubled) * line_film(group, material)
        assert light_contact(numbers, load, SPEED)[2] == pytest.approx(elastic, rel=0.02)


def test_inlet_and_ellipse_share_the_shear(laws):
    # In the elastic contact the part outside is small beside the isoviscous part inside already.
    numbers, load = laws["whole-film", "inner"], 2e4
    conductance, _, film = light_contact(numbers, load, SPEED)
    assert conductance < 0.5 * numbers.viscosity * numbers.area * load ** (2.0 / 3.0) / film


def test_factors_of_the_inlet(contacts):
    def law(**options):
        return prepare_rolling("inlet", *contacts["inner"], **options)

    full = law(heating=False)
    # Full from ten times the film on, which is thinner by what it lacks.
    short = law(
        heating=False, oil_gap=10.0 * film_factor(10.0) * light_contact(full, 5e4, SPEED)[2]
    )
    beside = beside_ellipse(full, 5e4)
    flooded = resistance(full, 5e4) - beside
    less = resistance(short, 5e4) - starved(10.0)[1] * beside
    assert less / flooded == pytest.approx(starvation_factor(10.0), rel=0.02)
    heated = resistance(law(), 5e4) - beside
    oil = contacts["inner"][0].lubricant
    loading = oil.viscosity * oil.temperature_viscosity / oil.thermal_conductivity * SPEED**2
    assert heated / flooded == pytest.approx(inlet_heating_of_rolling(loading), rel=0.01)


def free_ratio(numbers, gap, speed=SPEED):
    """No load, no cage: the roller's surface speed at which nothing turns it, over pure rolling."""
    _, conductance, per_speed = contact_at_gap(numbers, gap)
    # −F_R + conductance Δu = 0 with Δu = u2 − u1 and the mean of both.
    return (
        brentq(lambda u1: -per_speed * 0.5 * (u1 + speed) + conductance * (speed - u1), 1e-6, speed)
        / speed
    )


@pytest.mark.parametrize("where", ["inner", "outer"])
@pytest.mark.parametrize("gap", [1e-6, 2e-5, 1e-4])
def test_free_roller_turns_at_an_eighth_to_a_fifth(laws, where, gap):
    ratio = free_ratio(laws["whole-film", where], gap)
    assert 0.12 < ratio < 0.18
    # A line would turn at (1 − 0.8075)/(1 + 0.8075); flow to the sides takes more of the resistance than of the shear.
    assert ratio > (2.0 - 1.6152) / (2.0 + 1.6152)


def test_a_short_inlet_lets_the_free_roller_turn_faster(contacts):
    gaps = [inlet * martin.FLOW * 2e-5 for inlet in (math.inf, 30, 10, 2)]
    ratios = [
        free_ratio(prepare_rolling("inlet", *contacts["inner"], oil_gap=gap), 2e-5) for gap in gaps
    ]
    assert ratios == pytest.approx((0.140, 0.26, 0.375, 0.81), abs=0.02)


def test_a_roller_in_its_pocket_floats_without_load_and_is_the_rigid_contact_under_load(laws):
    numbers, widest = laws["whole-film", "cage"], 0.25e-3
    floating = rigid_pocket_contact(numbers, 0.0, 0.2, widest)
    assert floating == pytest.approx(contact_at_gap(numbers, widest)[1:], rel=1e-12)
    loads = np.geomspace(1e-3, 1e3, 200)
    conductance, per_speed = rigid_pocket_contact(numbers, loads, 0.2, widest)
    assert (np.diff(conductance) > 0.0).all() and conductance[0] > floating[0]
    log_group = math.log(1e3 / (numbers.viscosity * 0.2))
    free = np.exp(film_at_load(numbers.gap, log_group)[0])
    assert (conductance[-1], per_speed[-1]) == pytest.approx(
        contact_at_gap(numbers, free)[1:], rel=1e-3
    )


def test_none_is_nothing_and_unknown_names_are_refused(contacts):
    assert prepare_rolling("none", *contacts["inner"]) is None
    with pytest.raises(InputError, match="no rolling law 'some'"):
        prepare_rolling("some", *contacts["inner"])


def test_pushes_go_with_curvature(laws, contacts):
    for where, larger in (("inner", 0.0), ("outer", 1.0)):
        numbers, (_, shape, roller_radius) = laws["inlet", where], contacts[where]
        assert numbers.share_1 == pytest.approx(shape.rolling_radius / roller_radius)
        # The outer raceway is concave: the push on the ring is against the motion.
        assert (numbers.share_1 > 1.0) == bool(larger)
