"""Sensitivity by real runs: what is changed, what is not, and what a refused value leads to."""

import dataclasses

import numpy as np
import pytest

from macroslip import Case, HubLoads, InputError, Laws, simulate
from macroslip.film import film_law as film_law
from macroslip.reproduction.sensitivity import (
    LIMITING_SHEAR,
    STARVED,
    VARIATIONS,
    Variation,
    film_factor,
    sensitivity,
    variations_of,
    with_film_factor,
    with_inlet_temperature,
)
from macroslip.roller.contacts import prepare_contact
from macroslip.roller.model import interfaces

BY_NAME = {one.name: one for one in VARIATIONS}


@pytest.fixture(scope="module")
def case():
    return Case(loads=HubLoads.bundled("14B").window(0.0, 20.0), rollers=[0, 14])


@pytest.fixture(scope="module")
def table(case):
    calls = []
    found = sensitivity(case, progress=lambda *call: calls.append(call))
    assert calls == [(k, 10) for k in range(1, 11)]
    return found


def energy(case):
    return simulate(case).energy.sum("interface").mean("roller").values


def test_every_bar_is_a_run_of_its_own(case, table):
    np.testing.assert_array_equal(table.energy.sel(variation="osculation", level="base"), energy(case))
    own = dataclasses.replace(case, bearing=case.bearing.replace(diametral_clearance=4e-4))
    np.testing.assert_array_equal(table.energy.sel(variation="diametral clearance", level="high"), energy(own))
    far = dataclasses.replace(case, drivetrain=dataclasses.replace(case.drivetrain, bearing_to_gearbox=1.8))
    np.testing.assert_array_equal(table.energy.sel(variation="bearing to gearbox", level="low"), energy(far))
    assert table.value.sel(variation="inlet temperature").values.tolist() == pytest.approx([20.0, 35.0, 60.0])
    assert (table.failed == 0).all()


def test_a_colder_oil_and_a_thinner_film_cost_energy(table):
    temperature, film = (table.energy.sel(variation=name) for name in ("inlet temperature", "film factor"))
    assert (temperature.sel(level="low") > temperature.sel(level="base")).all()
    assert (temperature.sel(level="high") < temperature.sel(level="base")).all()
    assert (film.sel(level="low") > film.sel(level="base")).all()
    assert (film.sel(level="high") == film.sel(level="base")).all()


def test_temperature_changes_viscosity_by_the_oils_own_law(case):
    warm = with_inlet_temperature(case, case.lubricant.inlet_temperature + 10.0)
    assert warm.lubricant.viscosity == pytest.approx(0.54 * np.exp(-0.56))
    assert warm.lubricant.pressure_viscosity == case.lubricant.pressure_viscosity
    assert warm.bearing == case.bearing


def films(case):
    found = interfaces(case.bearing, case.lubricant)
    return [prepare_contact(case.laws, case.bearing, case.lubricant, one, 1).film for one in found]


def test_the_film_is_thinner_by_the_factor_and_in_nothing_else(case):
    thin = with_film_factor(case, STARVED)
    assert (film_factor(case), film_factor(thin)) == (1.0, STARVED)
    for laws in zip(films(case), films(thin), strict=True):
        for load, speed in ((10.0, 0.4), (5e4, 0.4), (5e4, 1e-3)):
            full, starved = (film_law.film_thickness(law, load, speed) for law in laws)
            np.testing.assert_allclose(starved, STARVED * np.array(full), rtol=1e-12)
            assert film_law.film_in_range(laws[0], load, speed) == film_law.film_in_range(laws[1], load, speed)


def test_limiting_shear_is_varied_where_it_acts(case):
    physical = dataclasses.replace(case, laws=Laws.physical(), rollers=(0,))
    assert variations_of(case) == VARIATIONS
    assert variations_of(physical)[-1] is LIMITING_SHEAR
    assert film_factor(physical) == physical.lubricant.starvation
    table = sensitivity(physical, [LIMITING_SHEAR])
    downwind = table.energy.sel(row="downwind", variation="limiting shear")
    assert (np.diff(downwind.sel(level=["low", "base", "high"])) > 0.0).all()


def clearance(low, high):
    return dataclasses.replace(BY_NAME["diametral clearance"], low=low, high=high)


def test_a_refused_value_is_halved_and_said(case):
    table = sensitivity(case, [clearance(0.2, 8.0)])
    # 8 mm is beyond what a bearing may have; 4.1 mm is not.
    assert table.value.values.tolist() == [[0.2, 0.2, pytest.approx(4.1)]]
    assert str(table.refused.values[0]).startswith("8 mm is refused: diametral_clearance is")
    assert (table.energy.sel(level="low") == table.energy.sel(level="base")).all()


def test_osculation_beyond_the_rollers_ends_is_refused_and_said():
    loads = HubLoads.bundled("14B").window(0.0, 16.0)  # holds a roller load of 110 kN
    table = sensitivity(Case(loads=loads, rollers=[0]), [BY_NAME["osculation"]])
    assert table.value.values.tolist() == [[0.97, 0.98, pytest.approx(0.985)]]
    assert "contact ellipse would reach beyond the roller's ends" in str(table.refused.values[0])


def test_what_is_refused_all_the_way_is_an_error(case):
    with pytest.raises(InputError, match="diametral_clearance"):
        sensitivity(case, [clearance(-100.0, 0.2)])


def test_a_variation_of_ones_own(case):
    density = Variation(
        name="roller density",
        unit="kg/m3",
        low=7000.0,
        high=8000.0,
        base=lambda case: case.bearing.density,
        apply=lambda case, value: dataclasses.replace(case, bearing=case.bearing.replace(density=value)),
    )
    table = sensitivity(case, [density])
    assert (table.energy.sel(level="low") < table.energy.sel(level="high")).all()
