"""One temperature for the loads of a study: the heat of their mean power is lost at it; weights, groups and refusals."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest

from macroslip import Bearing, HubLoads, simulate
from macroslip.errors import InputError
from macroslip.study.reader import open_study
from macroslip.study.run import run_study
from macroslip.study.store import BALANCE_RUNS
from macroslip.study.study_file import study_of
from tests.quick import COARSE

CONDUCTANCE, AMBIENT = 60.0, 288.15
WEIGHTS = {"field": "wind_speed", "width": 2.0, "scale": 9.5, "shape": 2.0}


def made(**more):
    """Two load cases of the package under the physical model, nine seconds each; orbits of 6.5 s."""
    content = {
        "case": {
            "laws": {"model": "physical"},
            "rollers": [0],
            "rating": False,
            "integrator": {"tolerance": COARSE.tolerance},
            "loads": {"end": "9 s"},
            "temperature": "balance",
            "heat": {"conductance": "60 W/K", "ambient": "15 degC"},
        },
        "loads": {"bundled": ["12B", "24B"]},
    }
    return json.loads(json.dumps(content | more))


def lost(temperature):
    return CONDUCTANCE * (np.asarray(temperature) - AMBIENT)


@pytest.fixture(scope="module")
def directory(tmp_path_factory):
    folder = tmp_path_factory.mktemp("balance") / "out"
    ended = run_study(study_of(made(weights=WEIGHTS)), folder, threads=1)
    assert not ended.failures
    return folder


def test_the_mean_power_of_all_loads_is_what_is_lost_at_one_temperature(directory):
    study = open_study(directory)
    assert np.unique(study.temperature).size == 1
    weights = np.array(
        [
            np.exp(-(((v - 1.0) / 9.5) ** 2)) - np.exp(-(((v + 1.0) / 9.5) ** 2))
            for v in (12.0, 24.0)
        ]
    )
    mean = float((study.friction_power * weights).sum() / weights.sum())
    assert mean == pytest.approx(float(lost(study.temperature[0])), abs=0.3 * CONDUCTANCE)
    # No load history is at its own balance: 12B heats more than the mean, 24B less.
    assert study.friction_power[0] > lost(study.temperature[0]) > study.friction_power[1]
    assert study.temperature.attrs["units"] == "K"


def test_every_result_was_computed_at_that_temperature(directory):
    study = open_study(directory)
    np.testing.assert_array_equal(study.inlet_temperature, study.temperature)
    assert (study.outcome == "completed").all()
    # The way there: the surroundings' temperature, 30 K above, and ever closer, each for both load histories.
    log = (directory / BALANCE_RUNS / "log.txt").read_text()
    on_the_way = [float(number) for number in re.findall(r"temperature ([\d.]+): completed", log)]
    assert {AMBIENT, AMBIENT + 30.0} <= set(on_the_way) and len(on_the_way) == 2 * len(
        set(on_the_way)
    ) >= 6
    assert min(abs(temperature - float(study.temperature[0])) for temperature in on_the_way) < 0.2


def test_going_on_computes_nothing_again(directory):
    again = run_study(study_of(made(weights=WEIGHTS)), directory, threads=1, resume=True)
    assert (again.progress.computed, again.progress.unchanged) == (0, 2)


def test_oils_have_a_temperature_each(tmp_path):
    """A thinner oil makes less heat; half the conductance a warmer bearing."""
    content = made(
        variations={
            "list": [{}, {"lubricant.viscosity": "0.2 Pa s"}, {"heat.conductance": "30 W/K"}]
        }
    )
    content["case"]["laws"] = {"model": "paper"}
    content["case"]["loads"] = {"end": "7 s"}
    run_study(study_of(content), tmp_path / "out", threads=1)
    study = open_study(tmp_path / "out")
    by_point = study.temperature.values.reshape(2, 3)
    np.testing.assert_array_equal(by_point[0], by_point[1])
    power = study.friction_power.values.reshape(2, 3).mean(axis=0)
    conductance = np.array([60.0, 60.0, 30.0])
    np.testing.assert_allclose(power, conductance * (by_point[0] - AMBIENT), atol=0.3 * 60.0)
    assert by_point[0, 2] > by_point[0, 0]


def test_varied_temperatures_and_unknown_fields_are_refused():
    with pytest.raises(InputError, match="it is varied"):
        study_of(made(variations={"list": [{"temperature": "40 degC"}]}))
    with pytest.raises(InputError, match="no number as 'gust'"):
        study_of(made(weights=WEIGHTS | {"field": "gust"}))


def test_a_bearing_that_cannot_lose_its_heat_has_no_balance(tmp_path):
    content = made()
    content["case"]["heat"]["conductance"] = "0.5 W/K"
    content["case"]["loads"] = {"end": "7 s"}
    with pytest.raises(InputError, match="no heat balance"):
        run_study(study_of(content), tmp_path / "out", threads=1)


def test_warmer_inner_rings_take_clearance_in_a_study_too(tmp_path):
    content = made()
    content["case"]["heat"] |= {
        "inner_mass": "4000 kg",
        "outer_mass": "3000 kg",
        "ring_conductance": "100 W/K",
    }
    assert not run_study(study_of(content), tmp_path / "out", threads=1).failures
    study = open_study(tmp_path / "out")
    at = float(study.temperature[0])
    case = case_at(content, at)
    # Half of the power goes from ring to ring; 11.9e-6 per kelvin over the pitch diameter. The bearing's clearance is warm,
    # with its oil at 35 degC.
    loss = 11.9e-6 * 0.7454 * 0.5 * case.heat.to_oil * (at - 308.15) / 100.0
    left = Bearing.read("skf-240-600-bc").diametral_clearance - loss
    assert 0.0 < left == pytest.approx(case.bearing.diametral_clearance, rel=1e-6)
    result = simulate(replace(case, loads=HubLoads.bundled("12B").window(0.0, 9.0)))
    energy = result.energy.mean("roller").sel(row="downwind").values
    np.testing.assert_allclose(study.energy_mean.sel(row="downwind")[0], energy.sum(), rtol=1e-6)


def case_at(content, temperature):
    """The case of a study's first run at the temperature of its balance."""
    study = study_of(content)
    first = next(study.runs())
    known = replace(study, heat=None, temperatures={first.group: temperature})
    return known.case_of(next(known.runs()))[0]
