"""Contacts with little load: one film for load, resistance and sliding, and its way into the elastic contact."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from macroslip.film.moes import moes
from macroslip.rolling import martin
from macroslip.rolling.film import light_film
from macroslip.rolling.gap import GapShape
from macroslip.rolling.light_contact import contact_at_gap, light_contact
from macroslip.rolling.resistance import rolling_resistance
from macroslip.rolling.rolling_law import prepare_rolling

pytestmark = pytest.mark.slow

SPEED = 0.396


@pytest.fixture(scope="module")
def laws(contacts):
    return {where: prepare_rolling("whole-film", *contacts[where], heating=False) for where in contacts}


@pytest.mark.parametrize("where", ["inner", "outer", "cage"])
@pytest.mark.parametrize("load", [0.01, 1.0, 10.0])
def test_given_load_and_given_gap_are_one_film(laws, where, load):
    u1, u2 = 0.3, 0.5
    loaded = light_contact(laws[where], load, u1, u2)
    held = contact_at_gap(laws[where], loaded.film / martin.FLOW, u1, u2)
    assert held.load == pytest.approx(load, rel=0.02)
    assert held.rolling.shear == pytest.approx(loaded.rolling.shear, rel=0.01)
    assert held.rolling.by_load == pytest.approx(loaded.rolling.by_load, rel=0.02)
    # The ellipse's own share of the shear is small.
    assert held.sliding == pytest.approx(loaded.sliding, rel=0.03)


def test_energy_balances_at_a_given_gap(laws):
    u1, u2 = 0.1, 0.5
    held = contact_at_gap(laws["inner"], 5e-5, u1, u2)
    on_roller, on_ring = held.rolling.shear + held.sliding, held.rolling.shear - held.sliding
    assert -(on_roller * u1 + on_ring * u2) == pytest.approx(held.rolling.power + held.sliding_power, rel=1e-12)
    assert on_roller + on_ring + held.rolling.push_1 + held.rolling.push_2 == pytest.approx(0.0, abs=1e-13)


def test_inlet_and_ellipse_share_the_shear(laws, contacts):
    # In the elastic contact the part outside is small beside the isoviscous part inside already.
    law, load = laws["inner"], 2e4
    contact = light_contact(law, load, SPEED, SPEED)
    inside = law.viscosity * law.area * load ** (2.0 / 3.0) / contact.film
    assert contact.sliding_slope < 0.5 * inside


@pytest.mark.parametrize("where", ["inner", "cage"])
def test_film_is_the_gaps_where_rigid_and_moes_where_elastic(laws, contacts, where):
    interface = contacts[where][0]
    law, load = laws[where], 1e5
    doubled = 2.0 * law.viscosity * SPEED / (interface.modulus * interface.rolling_radius)
    load_group = 0.75 * load ** (2.0 / 3.0) / interface.hertz.semi_axis_across
    load_group /= interface.modulus * interface.rolling_radius * math.sqrt(doubled)
    material = interface.lubricant.pressure_viscosity * interface.modulus * doubled**0.25
    elastic = interface.rolling_radius * math.sqrt(doubled) * moes(load_group, material)
    assert math.exp(light_film(law, math.log(load), math.log(SPEED))[0]) == pytest.approx(elastic, rel=0.02)


@pytest.mark.parametrize("load", [1e-2, 30.0, 400.0, 2e3, 5e4])
def test_derivatives_of_the_film(laws, load):
    place = math.log(load), math.log(SPEED)
    _, by_load, by_speed = light_film(laws["inner"], *place)
    up, down = (light_film(laws["inner"], place[0] + e, place[1])[0] for e in (1e-5, -1e-5))
    assert by_load == pytest.approx((up - down) / 2e-5, rel=1e-6, abs=1e-8)
    up, down = (light_film(laws["inner"], place[0], place[1] + e)[0] for e in (1e-5, -1e-5))
    assert by_speed == pytest.approx((up - down) / 2e-5, rel=1e-6)


def test_everything_goes_with_fullness_at_a_given_gap(contacts):
    full, tenth = (
        contact_at_gap(prepare_rolling("inlet", *contacts["inner"], fullness=f), 5e-5, 0.2, 0.4) for f in (1.0, 0.1)
    )
    for which in ("load", "sliding", "sliding_power"):
        assert getattr(tenth, which) == pytest.approx(0.1 * getattr(full, which), rel=1e-12)
    assert tenth.rolling.power == pytest.approx(0.1 * full.rolling.power, rel=1e-12)
    # Of a line, h0 at a given load goes with fullness.
    interface, _, radius = contacts["inner"]
    line = GapShape(interface.rolling_radius, 1e9, 1.0)
    films = [
        light_contact(prepare_rolling("inlet", interface, line, radius, fullness=f), 3.0, 0.3, 0.3).film
        for f in (1.0, 0.1)
    ]
    assert films[1] / films[0] == pytest.approx(0.1, rel=0.05)


@pytest.mark.parametrize("where", ["inner", "outer"])
@pytest.mark.parametrize("gap", [1e-6, 2e-5, 1e-4])
def test_free_roller_turns_at_an_eighth_to_a_fifth(laws, where, gap):
    """No load, no cage: the roller's surface speed at which nothing turns it, over pure rolling."""

    def moment(u1):
        held = contact_at_gap(laws[where], gap, u1, SPEED)
        return held.rolling.shear + held.sliding

    ratio = brentq(moment, 1e-6, SPEED) / SPEED
    assert 0.12 < ratio < 0.18
    # A line would turn at (1 − 0.8075)/(1 + 0.8075); flow to the sides takes more of the resistance than of the shear.
    assert ratio > (2.0 - 1.6152) / (2.0 + 1.6152)


def test_blend_with_the_elastic_line_has_no_step(laws):
    loads = np.geomspace(1.0, 1e5, 800)
    for where in ("inner", "cage"):
        found = [light_contact(laws[where], q, 0.3, 0.4) for q in loads]
        films = np.log([c.film for c in found])
        assert (np.diff(films) < 0.0).all()
        assert np.max(-np.diff(films)) < 2.2 * np.log(loads[1] / loads[0])
        powers = [c.rolling.power for c in found]
        assert powers == [rolling_resistance(laws[where], q, 0.3, 0.4).power for q in loads]


def test_a_short_inlet_lets_the_free_roller_turn_faster(contacts):
    def ratio(inlet_film):
        law = prepare_rolling("inlet", *contacts["inner"], inlet_film=inlet_film)

        def moment(u1):
            held = contact_at_gap(law, 2e-5, u1, SPEED)
            return held.rolling.shear + held.sliding

        return brentq(moment, 1e-6, SPEED) / SPEED

    flooded, long, short, least = (ratio(s) for s in (math.inf, 30.0, 10.0, 2.0))
    assert flooded < long < short < least
    assert (flooded, long, short, least) == pytest.approx((0.140, 0.26, 0.375, 0.81), abs=0.02)
