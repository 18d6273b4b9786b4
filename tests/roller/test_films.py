"""Oil around a roller: what it carries with play, balance of forces and power, slopes, and how fast a free roller turns."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from macroslip import Bearing, Laws, Lubricant
from macroslip.bearing import geometry
from macroslip.integrate.entries import sealed
from macroslip.ring.orbit import Instant
from macroslip.roller.films import NoFilms, cage_film, raceway_film
from macroslip.roller.forces import INNER, OUTER, Station, net_force
from macroslip.roller.model import roller_model
from macroslip.roller.play import carried, film_load
from macroslip.rolling.light_contact import light_contact, pocket_contact
from tests.by_address import forces_by_address, station_by_address

pytestmark = pytest.mark.slow

BEARING = Bearing.read("skf-240-600-bc")
OIL = Lubricant.read("vg460-pao")
FLOODED = OIL.replace(fullness=1.0, inlet_film=1e6)
RING = -0.41  # [m/s], at rated speed


def model_of(oil=OIL, **changes):
    return roller_model(BEARING, oil, 1, tilt=0.0, laws=Laws.physical().but(**changes))


@pytest.fixture(scope="module")
def model():
    return model_of()


@pytest.fixture(scope="module")
def flooded():
    return model_of(FLOODED)


def at_load(load, tangential=20.0, ring_speed=RING):
    return Station(ring_speed, 1e-5, load, load, load, tangential)


def idle(model, play, body, ring_speed=RING):
    """A roller with play [m] on which a body force [N] presses outward."""
    load = film_load(model.films, 0.0, -play, body, ring_speed)
    return Station(ring_speed, -play, 0.0, load - min(body, 0.0), load + max(body, 0.0), 20.0)


def test_without_rolling_resistance_there_are_no_films():
    model = model_of(rolling="none")
    assert isinstance(model.films, NoFilms)
    assert raceway_film(model.films, INNER, 1e4, 0.01, RING) == (0.0,) * 7
    assert cage_film(model.films, 30.0, RING) == (0.0,) * 5
    assert film_load(model.films, 0.0, -1e-4, 30.0, RING) == 0.0
    assert forces_by_address(sealed(model), at_load(2e4), 1e-3).rolling_power == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("body", [-35.0, 0.0, 4.0, 50.0])
@pytest.mark.parametrize("play", [2e-6, 5e-5, 3e-4])
def test_films_and_approach_fill_the_play(model, play, body):
    films, speed = model.films, 0.5 * abs(RING)

    def excess(log_load):
        q = math.exp(log_load)
        # Film of each raceway from its own function, at a mean speed of half the ring's.
        heights = [
            light_contact(law, q + share, 0.0, 2.0 * speed).film / 1.2257
            for law, share in ((films.inner, max(-body, 0.0)), (films.outer, max(body, 0.0)))
        ]
        return sum(heights) - (q / films.stiffness) ** (2.0 / 3.0) - play

    expected = math.exp(brentq(excess, math.log(1e-6), math.log(1e5), xtol=1e-12))
    assert carried(films, play, body, RING) == pytest.approx(expected, rel=2e-4)


def test_loads_are_continuous_where_play_ends(model):
    def loads(approach):
        load = model.stiffness * max(approach, 0.0) ** 1.5
        return load + film_load(model.films, load, approach, 30.0, RING)

    steps = np.linspace(-3e-6, 2e-5, 400)
    found = np.array([loads(step) for step in steps])
    assert np.all(np.diff(found) > 0.0)
    assert abs(loads(1e-12) - loads(-1e-12)) < 1e-3 * loads(0.0)
    # Far into the load zone nothing is left of it.
    assert loads(6e-5) == pytest.approx(model.stiffness * 6e-5**1.5, rel=1e-12)


def test_films_carry_more_the_less_play_there_is_and_nothing_at_standstill(model):
    found = [carried(model.films, play, 30.0, RING) for play in (1e-6, 1e-5, 1e-4, 1e-3)]
    assert found == sorted(found, reverse=True)
    assert carried(model.films, 1e-4, 30.0, 0.0) == 0.0


@pytest.mark.parametrize("load", [5.0, 300.0, 2e4])
@pytest.mark.parametrize("slip", [-0.3, 0.002])
@pytest.mark.parametrize("raceway", [INNER, OUTER])
def test_forces_of_a_contact_turn_nothing_about_the_bearing(flooded, raceway, load, slip):
    """Torques on roller and ring about the bearing's axis add up to zero: action and reaction of shear and pressure."""
    law = flooded.films.outer if raceway else flooded.films.inner
    found = light_contact(law, load, RING - slip, RING)
    contact = geometry.outer_contact_radius(BEARING) if raceway else geometry.inner_contact_radius(BEARING)
    # Along the ring's motion; the pushes act through the axes of roller and ring.
    on_roller = (found.sliding + found.rolling.shear) * contact + found.rolling.push_1 * BEARING.pitch_radius
    on_ring = (-found.sliding + found.rolling.shear) * contact
    assert abs(on_roller + on_ring) < 1e-9 * abs(found.rolling.shear) * contact
    force = raceway_film(flooded.films, raceway, load, slip, RING)
    assert force.pull == pytest.approx(found.sliding + found.rolling.shear + found.rolling.push_1, rel=1e-12)


@pytest.mark.parametrize("load", [5.0, 300.0, 2e4])
@pytest.mark.parametrize("slip", [-0.3, 0.002, 0.3])
def test_what_the_surfaces_lose_is_sliding_and_rolling_power(model, load, slip):
    u1, u2 = RING - slip, RING
    for law in (model.films.inner, model.films.outer):
        found = light_contact(law, load, u1, u2)
        lost = -(found.sliding + found.rolling.shear) * u1 - (-found.sliding + found.rolling.shear) * u2
        assert lost == pytest.approx(found.sliding_power + found.rolling.power, rel=1e-9)
        # 2 F_R u_e, and the pressure's sideways push on both bodies is 2 F_R.
        assert found.rolling.power == pytest.approx(2.0 * abs(found.rolling.shear) * 0.5 * abs(u1 + u2), rel=1e-12)
        assert found.rolling.push_1 + found.rolling.push_2 == pytest.approx(-2.0 * found.rolling.shear, rel=1e-12)
    found = pocket_contact(model.films.cage, min(load, 50.0), u1, 0.0, model.films.pocket_gap)
    lost = -(found.sliding + found.rolling.shear) * u1
    assert lost == pytest.approx(found.sliding_power + found.rolling.power, rel=1e-9)


@pytest.mark.parametrize("load", [2.0, 40.0, 700.0, 2e4])
@pytest.mark.parametrize("slip", [-0.35, -0.05, 0.002])
def test_slope_of_all_forces_is_their_derivative(load, slip):
    # The paper's traction, whose slopes are exact; those of microslip are of a spline.
    model = roller_model(BEARING, OIL, 1, tilt=0.0, laws=Laws.paper().but(rolling="whole-film"))
    at, roller = at_load(load), sealed(model)
    change = 1e-6 * max(abs(slip), 1e-3)
    ahead, behind = (forces_by_address(roller, at, one) for one in (slip + change, slip - change))
    here = forces_by_address(roller, at, slip)
    assert here.slope == pytest.approx((net_force(ahead) - net_force(behind)) / (2.0 * change), rel=2e-4)
    assert here.cage_load_slope == pytest.approx((ahead.cage_load - behind.cage_load) / (2.0 * change), rel=2e-4)


@pytest.mark.parametrize("load", [0.0, 0.3, 10.0, 100.0])
def test_slopes_of_the_pocket(model, load):
    def force(load, surface):
        found = pocket_contact(model.films.cage, load, surface, 0.0, model.films.pocket_gap)
        return found.sliding + found.rolling.shear

    found = cage_film(model.films, load, -0.3)
    assert found.slope == pytest.approx(-(force(load, -0.3 + 1e-6) - force(load, -0.3 - 1e-6)) / 2e-6, rel=1e-5)
    step = 1e-4 * load
    assert found.by_load * step == pytest.approx(
        0.5 * (force(load + step, -0.3) - force(load - step, -0.3)), rel=1e-4, abs=1e-12
    )


def test_a_light_roller_floats_in_the_middle_of_its_pocket(model):
    films = model.films
    assert pocket_contact(films.cage, 0.0, RING, 0.0, films.pocket_gap).film == pytest.approx(
        1.2257 * films.pocket_gap, rel=1e-3
    )
    assert 0.2 < abs(cage_film(films, 30.0, RING).sliding) < 2.0


def free_spin(model, play, body):
    """ω/ω_pure of a roller without load."""
    at, roller = idle(model, play, body), sealed(model)
    slip = brentq(lambda slip: net_force(forces_by_address(roller, at, slip)), 1.5 * RING, -0.5 * RING, xtol=1e-12)
    return (RING - slip) / RING


@pytest.mark.parametrize("play", [5e-5, 1e-4, 3e-4])
def test_a_flooded_free_roller_turns_at_a_fifth_of_pure_rolling(flooded, play):
    # With its cage's oil it is slower still; of the raceways alone it is the 0.12 to 0.18 of a free contact.
    assert 0.05 < free_spin(flooded, play, 30.0) < 0.25


def test_starved_inlets_let_a_free_roller_turn_faster(flooded):
    starved = model_of(FLOODED.replace(inlet_film=5.0))
    assert free_spin(starved, 1e-4, 30.0) > 1.5 * free_spin(flooded, 1e-4, 30.0)


def test_rolling_resistance_leaves_a_gripped_roller_in_its_balance(model):
    """Traction of both raceways makes up for what the oil of both inlets and of the pocket takes."""
    at, roller = at_load(2e4), sealed(model)
    slip = brentq(lambda slip: net_force(forces_by_address(roller, at, slip)), -0.05, 0.05, xtol=1e-16)
    forces = forces_by_address(roller, at, slip)
    assert forces.resistance > 0.0  # against a motion along −x
    assert forces.inner + forces.outer + forces.cage == pytest.approx(-forces.resistance, rel=1e-6)
    assert all(power > 0.0 for power in forces.rolling_power)


def test_station_shares_the_play_of_an_idle_roller(model):
    now = Instant(2.14, 0.0, 0.0, 0.0, 0.0)  # ring in the middle: half the clearance is play all round
    top, bottom = (station_by_address(sealed(model), angle, now) for angle in (math.pi / 2, -math.pi / 2))
    for at in (top, bottom):
        assert at.elastic_load == 0.0
        assert min(at.inner_load, at.outer_load) > 0.0
    assert bottom.outer_load > bottom.inner_load
    assert top.inner_load > top.outer_load
