"""Films of inlets that are not full, against the integral of Reynolds' equation in the inlet."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from macroslip import Bearing, BearingLoads, Case, Laws, Lubricant
from macroslip.case.case_file import build_case
from macroslip.contact.gap import starved_martin
from macroslip.contact.laws import prepare
from macroslip.contact.rolling import (
    light_contact,
    replenishment,
    rigid_pocket_contact,
    starvation_factor,
)
from macroslip.contact.starvation import (
    film_factor,
    film_factor_at_gap,
    inlet_at_gap,
    inlet_for_film,
    inlet_for_rolling,
    rigid_rolling_factor,
    shared_gaps,
)
from macroslip.errors import InputError
from macroslip.input.files import Source

LOADS = BearingLoads.constant([0.0, -3.4e5, 1.6e5], 2.14, 10.0)
LOAD, SPEED = 2e4, 0.4


@pytest.mark.parametrize("inlet", [1.2, 2.0, 3.0, 10.0, 100.0])
def test_film_reaches_the_reduced_pressure_with_the_inlet_that_it_has(inlet):
    # Along the way t from the edge, h = h* + t^1.5: film and start of the inlet such that ∫ (h − h*)/h³ dt is the same.
    def pressure(film, first):
        return quad(lambda t: t**1.5 / (film + t**1.5) ** 3, 0.0, first, limit=200)[0]

    film = float(film_factor(inlet))
    full = (
        pressure(1.0, 1.0) + quad(lambda s: s**-3.5 / (1.0 + s**-1.5) ** 3, 0.0, 1.0)[0]
    )  # t = 1/s beyond 1
    assert pressure(film, ((inlet - 1.0) * film) ** (2.0 / 3.0)) == pytest.approx(full, rel=1e-7)


def test_inverses():
    for inlet in (1.5, 3.0, 30.0, 175.0):
        assert inlet_for_film(float(film_factor(inlet))) == pytest.approx(inlet, rel=1e-6)
        assert inlet_for_rolling(starvation_factor(inlet)) == pytest.approx(inlet, rel=1e-9)
        assert inlet_at_gap(inlet * film_factor(inlet) * 1e-6, 1e-6) == pytest.approx(
            inlet, rel=1e-6
        )
        assert rigid_rolling_factor(inlet) == pytest.approx(starved_martin(inlet)[1], rel=1e-5)
    assert inlet_for_film(1.0) == math.inf


@pytest.mark.parametrize("ratio", [0.05, 0.3, 1.0, 3.0, 30.0, 1000.0, 1e6])
def test_film_at_a_gap_beside_a_root_of_the_inlet(ratio):
    inlet = brentq(lambda x: x * film_factor(x) - ratio, 1.0 + 1e-12, 1e8, xtol=1e-14, rtol=1e-15)
    assert film_factor_at_gap(ratio * 1e-6, 1e-6) == pytest.approx(film_factor(inlet), rel=1e-8)


def test_film_far_from_any_gap_is_flooded():
    assert film_factor_at_gap(1.0, 1e-9) == pytest.approx(1.0, abs=1e-9)


def case(supply, **other):
    return Case(loads=LOADS, laws=Laws.physical(), oil_supply=supply, **other)


def contacts(supply, **other):
    supplied = case(supply, **other)
    return prepare(supplied.laws, supplied.bearing, supplied.oil, 1)


def test_flooded_is_a_lubricant_without_a_limit_and_nearly_one_with_a_wide_gap():
    oil, bearing = Lubricant.read("vg460-pao"), Bearing.read("skf-240-600-bc")
    known, wide = (
        prepare(Laws.physical(), bearing, lubricant, 1).inner
        for lubricant in (oil, oil.supplied(0.999))
    )
    laws = contacts("flooded")
    for contact, tolerance in ((known, 0.0), (wide, 0.02)):
        assert laws.inner.film_thickness(LOAD, SPEED) == pytest.approx(
            contact.film_thickness(LOAD, SPEED), rel=tolerance
        )
        expected = np.array(light_contact(contact.rolling, LOAD, SPEED))
        assert np.array(light_contact(laws.inner.rolling, LOAD, SPEED)) == pytest.approx(
            expected, rel=tolerance
        )
    assert math.isinf(laws.inner.oil_gap) and math.isinf(contacts(1.0).inner.oil_gap)


@pytest.mark.parametrize("supply", [0.3, 0.5, 0.7, 0.9])
def test_number_is_film_over_flooded_film_under_the_mean_load(supply):
    supplied = case(supply)
    gap, full = supplied.oil.oil_gap, contacts("flooded").inner
    inlet = inlet_for_film(supply)
    flooded = gap / (inlet * supply)
    # The film law at a load between that of one roller and ten times it: somewhere there is the mean load.
    assert contacts(supply).inner.film_thickness(2.3e4, SPEED) / full.film_thickness(
        2.3e4, SPEED
    ) == pytest.approx(supply, abs=0.02)
    assert 0.5e-6 < flooded < 3e-6


def test_less_oil_makes_thinner_films_less_resistance_and_idle_films_below_the_gap():
    by_supply = [contacts(supply) for supply in ("flooded", 0.9, 0.7, 0.5)]
    films = [float(laws.inner.film_thickness(LOAD, SPEED)) for laws in by_supply]
    rolling = [float(light_contact(laws.inner.rolling, LOAD, SPEED)[1]) for laws in by_supply]
    idle = [
        [float(value) for value in light_contact(laws.inner.rolling, 5.0, 0.2)]
        for laws in by_supply
    ]
    for series in (films, rolling, [state[1] for state in idle], [state[2] for state in idle]):
        assert series == sorted(series, reverse=True)
    for state, law in zip(idle[1:], by_supply[1:], strict=True):
        assert state[2] < law.inner.oil_gap


def test_rolling_without_starved_films_has_full_films_and_less_resistance():
    laws = Laws.physical().but(starvation=False)
    full, short = (
        prepare(laws, changed.bearing, changed.oil, 1).inner
        for changed in (replace(case(supply), laws=laws) for supply in ("flooded", 0.5))
    )
    assert short.film_thickness(LOAD, SPEED) == full.film_thickness(LOAD, SPEED)
    rolling = [float(light_contact(contact.rolling, LOAD, SPEED)[1]) for contact in (short, full)]
    assert rolling[0] < 0.6 * rolling[1]


def test_skf_gives_the_rolling_resistance_its_replenishment_factor():
    supplied = case("skf")
    oil, full = supplied.oil, contacts("flooded").inner
    filled = float(
        replenishment(
            oil.viscosity / oil.density,
            2.14,
            supplied.bearing.bore_diameter,
            supplied.bearing.outside_diameter,
        )
    )
    ratio = (
        light_contact(contacts("skf").inner.rolling, 2.3e4, SPEED)[1]
        / light_contact(full.rolling, 2.3e4, SPEED)[1]
    )
    assert ratio == pytest.approx(filled, abs=0.03)


def test_skf_needs_the_size_of_the_bearing():
    bearing = Bearing.read("skf-240-600-bc").replace(name="mine", bore_diameter=None)
    with pytest.raises(
        InputError,
        match=r"oil_supply: .*mine has no bore_diameter.*give the film over the flooded film as a number",
    ):
        case("skf", bearing=bearing)
    assert case(0.7, bearing=bearing).oil.oil_gap > 0.0


@pytest.mark.parametrize("value", ["full", 0.2, 1.1, True, [0.7]])
def test_other_supplies_are_refused(value):
    data = {"loads": {"bundled": "14B"}, "oil_supply": value}
    with pytest.raises(
        InputError, match="oil_supply: it is .*Allowed: flooded, skf, or film / flooded film"
    ):
        build_case(data, Source(), __import__("pathlib").Path())


def test_yield_stress_of_a_grease_holds_rollers_back():
    plain = Lubricant.read("vg460-pao")
    stiff = plain.replace(grease_yield_stress=300.0)
    here, there = (contacts("flooded", lubricant=grease) for grease in (plain, stiff))
    speed = 0.05
    added = [
        rigid_pocket_contact(law.cage.rolling, 1.0, speed, 2.5e-4)[0] * 2.0 * speed
        for law in (here, there)
    ]
    # A flooded pocket holds the roller on a roller's radius to either side: 2 r l τ_y.
    assert added[1] - added[0] == pytest.approx(0.07 * 0.106 * 300.0, rel=1e-6)
    resistance = [float(light_contact(law.inner.rolling, 5.0, 0.2)[1]) for law in (here, there)]
    assert 0.0 < resistance[1] - resistance[0] <= 0.035 * 0.106 * 300.0
    heavy = [float(light_contact(law.inner.rolling, 3e4, 0.4)[1]) for law in (here, there)]
    assert heavy[0] < heavy[1] < 1.005 * heavy[0]


@pytest.mark.parametrize("film", [1e-7, 1e-6])
def test_two_gaps_of_the_grid_give_the_film_of_those_between(film):
    """Against the film itself, at the thickest film over the gap that is allowed and far from it."""
    for gap in film * np.geomspace(8.0, 2000.0, 300):
        shared = shared_gaps(gap, film, 1.0)
        assert sum(weight for _, weight in shared) == pytest.approx(1.0, abs=1e-12)
        assert shared[0][0] <= gap <= shared[1][0]
        inverse = sum(weight / film_factor(inlet_at_gap(node, film)) for node, weight in shared)
        exact = 1.0 / film_factor(inlet_at_gap(gap, film))
        assert inverse == pytest.approx(exact, rel=5e-5 if gap < 20.0 * film else 2e-5)


@pytest.mark.parametrize("thicker", [10.0, 50.0, 300.0])
def test_two_gaps_of_the_grid_give_the_thicker_films_of_lighter_contacts(thicker):
    film = 1e-6
    light = thicker * film
    for gap in film * np.geomspace(8.0, 2000.0, 300):
        shared = shared_gaps(gap, film, 1.0)
        inverse = sum(weight / film_factor_at_gap(node, light) for node, weight in shared)
        exact = 1.0 / film_factor_at_gap(gap, light)
        assert inverse == pytest.approx(exact, rel=7e-5 if gap < 100.0 * film else 3e-4)


def test_a_finer_table_has_gaps_that_are_nearer():
    for gap, apart in ((2e-5, 0.125), (2e-4, 0.25)):
        (near, _), (far, _) = shared_gaps(gap, 1e-6, 0.5)
        assert math.log(far / near) == pytest.approx(apart / 4.0)


def test_empty_and_flooded_inlets_have_tables_of_their_own():
    assert shared_gaps(7.9e-6, 1e-6, 1.0) == ((7.9e-6, 1.0),)
    assert shared_gaps(math.inf, 1e-6, 1.0) == ((math.inf, 1.0),)


def test_a_raceway_at_another_gap_is_the_one_that_is_prepared_with_it():
    oil = Lubricant.read("vg460-pao")
    bearing = Bearing.read("skf-240-600-bc")
    laws = Laws.physical()
    thick, thin = (prepare(laws, bearing, oil.supplied(gap), 1) for gap in (2e-4, 5e-5))
    moved = thick.outer.at_gap(5e-5)
    assert moved.film_thickness(LOAD, SPEED) == thin.outer.film_thickness(LOAD, SPEED)
    contact = light_contact(moved.rolling, 30.0, SPEED)
    assert contact == pytest.approx(light_contact(thin.outer.rolling, 30.0, SPEED), rel=1e-12)
