"""Sensitivity by real runs: what is changed, what is not, and what a refused value leads to."""

import dataclasses

import numpy as np
import pytest

from macroslip import simulate
from macroslip.reproduction.sensitivity import VARIATIONS, sensitivity
from macroslip.reproduction.studies import base_case, computed, reproduction_study

pytestmark = pytest.mark.slow

SHORT = {"rollers": [0, 14], "loads": {"end": "16 s"}}  # holds a roller load of 110 kN


@pytest.fixture(scope="module")
def made(small):
    return small("sensitivity_paper", **SHORT)


@pytest.fixture(scope="module")
def table(made, tmp_path_factory):
    directory = tmp_path_factory.mktemp("sensitivity") / "out"
    computed(made, directory, may_fail=True)
    return sensitivity(directory, base_case(made))


def energy(case):
    return simulate(case).energy.sum("interface").mean("roller").values


def test_every_bar_is_a_run_of_its_own(made, table):
    case = base_case(made)
    np.testing.assert_array_equal(table.energy.sel(variation="osculation", level="base"), energy(case))
    own = dataclasses.replace(case, bearing=case.bearing.replace(diametral_clearance=4e-4))
    np.testing.assert_array_equal(table.energy.sel(variation="diametral clearance", level="high"), energy(own))
    far = dataclasses.replace(case, drivetrain=dataclasses.replace(case.drivetrain, bearing_to_gearbox=1.8))
    np.testing.assert_array_equal(table.energy.sel(variation="bearing to gearbox", level="low"), energy(far))
    warm = dataclasses.replace(case, lubricant=case.lubricant.at("60 degC"))
    np.testing.assert_array_equal(table.energy.sel(variation="inlet temperature", level="high"), energy(warm))
    assert (table.failed == 0).all()


def test_base_values_are_those_of_the_case_and_lie_between(table):
    values = {str(name): table.value.sel(variation=name).values.tolist() for name in table.variation.values}
    assert values["diametral clearance"] == pytest.approx([0.0, 0.2, 0.4])
    assert values["inlet temperature"] == pytest.approx([20.0, 35.0, 60.0])
    assert values["bearing to gearbox"] == pytest.approx([1.8, 2.2, 2.6])
    assert values["film factor"] == [0.7, 1.0, 1.0]
    assert "Eyring stress" not in values


def test_a_colder_oil_and_a_thinner_film_cost_energy(table):
    temperature, film = (table.energy.sel(variation=name) for name in ("inlet temperature", "film factor"))
    assert (temperature.sel(level="low") > temperature.sel(level="base")).all()
    assert (temperature.sel(level="high") < temperature.sel(level="base")).all()
    assert (film.sel(level="low") > film.sel(level="base")).all()
    assert (film.sel(level="high") == film.sel(level="base")).all()


def test_a_refused_value_is_named_and_the_one_before_it_is_the_limit(table):
    osculation = table.sel(variation="osculation")
    assert osculation.value.values.tolist() == [0.97, 0.98, 0.985]
    assert str(osculation.refused.values).startswith("0.99 is refused: ")
    assert "contact ellipse would reach beyond the roller's ends" in str(osculation.refused.values)
    assert not any(table.refused.drop_sel(variation="osculation").values)


def test_eyring_stress_is_varied_where_it_acts(small, tmp_path):
    made = small("sensitivity_physical", **SHORT | {"rollers": [0], "window": {}})
    computed(made, tmp_path / "out", may_fail=True)
    downwind = sensitivity(tmp_path / "out", base_case(made)).energy.sel(row="downwind", variation="Eyring stress")
    assert (np.diff(downwind.sel(level=["low", "base", "high"])) > 0.0).all()


@pytest.mark.parametrize("model", ["paper", "physical"])
def test_every_point_changes_one_value_with_what_follows_from_it(model):
    together = {
        "bearing.osculation_inner": "bearing.osculation_outer",
        "laws.starvation": "lubricant.starvation",
    }
    base, *points = reproduction_study(f"sensitivity_{model}").variations
    assert base == []
    for point in points:
        keys = {together.get(one.key, one.key) for one in point}
        assert len(keys) == 1
        assert keys <= {one.key for one in VARIATIONS}


@pytest.mark.parametrize("model", ["paper", "physical"])
def test_osculation_is_that_of_both_raceways(model):
    points = [{one.key: one.value for one in point} for point in reproduction_study(f"sensitivity_{model}").variations]
    pairs = [
        (point["bearing.osculation_inner"], point["bearing.osculation_outer"])
        for point in points
        if "bearing.osculation_inner" in point
    ]
    assert len(pairs) >= 2
    assert all(inner == outer for inner, outer in pairs)
