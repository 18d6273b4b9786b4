"""Effects of a sample against a function whose effects are known, and designs of a year against sums by hand."""

import json
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from scipy.stats import qmc

from macroslip import BearingLoads, Case, InputError, Laws, compare, simulate
from macroslip.constants import YEAR
from macroslip.result.criteria.friction_energy import REFERENCE_POWER
from macroslip.result.damage import damage
from macroslip.study.aggregation import Aggregation
from macroslip.study.effects import EFFECTS, effects, main_effects, rank_correlations
from macroslip.study.labels import sampled_parameters
from macroslip.study.summary import damage_values
from macroslip.study.weights import BinProbabilities, Rate, Year
from macroslip.study.year import design_names, designs, year
from tests.variables import check_variables

POINTS = qmc.Sobol(2, rng=np.random.default_rng(0)).random(32)


def sample(of, lubricants=("a", "b")):
    """A study of two oils, the second with ten times the power, and a sample of two values; `of` gives the power [W]."""
    places = np.tile(POINTS, (len(lubricants), 1))
    oil = np.repeat(np.arange(len(lubricants)), len(POINTS))
    power = of(*places.T) * 10.0**oil
    count = power.size
    labels = {name: ("case", ["x"] * count) for name in ("bearing", "model")}
    labels |= {"lubricant": ("case", np.array(lubricants)[oil]), "loads": ("case", ["w"] * count)}
    labels |= {
        f"drivetrain.{name}": ("case", places[:, k], {"units": "m"})
        for k, name in enumerate(("first", "second"))
    }
    data = {
        name: (("case", "row"), np.stack([600.0 * power] * 2, axis=1))
        for name in ("energy_mean", "peak_power_max")
    }
    content = {
        "variations": {"sample": {"ranges": {"drivetrain.first": {}, "drivetrain.second": {}}}}
    }
    return xr.Dataset(
        data | {"window_length": ("case", np.full(count, 600.0))},
        labels | {"row": ["downwind", "upwind"]},
        {"study": json.dumps(content)},
    )


def test_effects_of_a_plane_are_its_slopes():
    """P = 10 + 4 x: halves of an even sample of [0, 1] differ by 0.5 in their mean, so by 2 W of 12 W; y does nothing."""
    effect = effects(sample(lambda x, y: 10.0 + 4.0 * x)).sel(quantity="energy")
    assert effect.main_effect.values[0] == pytest.approx(2.0 / 12.0, rel=0.02)
    assert abs(effect.main_effect.values[1]) < 2.0 * effect.main_effect_error.values[1]
    # The second oil has ten times the energy: the ranks are those within each oil.
    assert effect.rank_correlation.values[0] > 0.99 and abs(effect.rank_correlation.values[1]) < 0.2
    assert effect.probability.values[0] < 1e-9 and int(effect.points) == 64
    table = effects(sample(lambda x, y: 10.0 + 4.0 * x, ("a",)))
    middle = table["range"].sel(quantity="energy", quantile=0.5)
    assert (
        float(middle) == pytest.approx(2.0 * 12.0 * YEAR, rel=0.02)
        and table.units.values[0] == "J/year"
    )


def test_a_rank_correlation_sees_what_rises_however_it_bends():
    bent = effects(sample(lambda x, y: np.exp(8.0 * y), ("a",))).sel(quantity="energy")
    assert (
        bent.rank_correlation.values[1] == pytest.approx(1.0) and bent.main_effect.values[1] > 1.0
    )


def test_points_without_a_value_are_left_out_and_what_does_not_change_has_no_effect():
    study = sample(lambda x, y: 10.0 + 4.0 * x, ("a",))
    study["energy_mean"][3] = np.nan
    check_variables(effects(study), EFFECTS)
    assert effects(study).sel(quantity="energy").main_effect.values[0] == pytest.approx(
        2.0 / 12.0, rel=0.1
    )
    ranks, chance = rank_correlations(np.ones((5, 1)), np.arange(5.0))
    assert np.isnan(ranks).all() and np.isnan(chance).all()
    assert np.isnan(main_effects([[1.0], [1.0], [1.0]], [1.0, 2.0, 3.0])).all()


def test_a_study_without_sample_has_no_effects():
    study = sample(lambda x, y: 10.0 + x).assign_attrs(study="{}")
    assert sampled_parameters(study) == []
    with pytest.raises(InputError, match="the study has no sample"):
        effects(study)


def test_designs_are_compared_over_the_points_of_a_sample():
    ranking = compare(sample(lambda x, y: 10.0 + 4.0 * x)).attrs["ranking"]
    assert ranking.startswith("a dissipates least") and "b 900 % more" in ranking


def of_year():
    """Two oils under one wind speed and while parked, where no orbit is complete: no entry is counted then."""
    labels = {name: ("case", ["x"] * 4) for name in ("bearing", "model")}
    labels |= {"lubricant": ("case", ["a", "a", "b", "b"]), "loads": ("case", ["w", "p", "w", "p"])}
    labels["wind_speed"] = ("case", [12.0, 0.0] * 2, {"units": "m/s"})
    labels["event"] = ("case", np.array(["", "parked-12"] * 2, dtype=object))
    by_row = {
        "energy_mean": [[1200.0, 600.0], [0.0, 0.0], [600.0, 600.0], [0.0, 0.0]],
        "peak_power_max": [[30.0, 3.0], [0.0, 0.0], [20.0, 40.0], [0.0, 0.0]],
        "entry_rate": [[1.0, 2.0], [np.nan] * 2, [0.5, 0.5], [np.nan] * 2],
        "mixed_film_time": [[0.1, 0.2], [0.0, 0.0], [0.0, 0.0], [0.0, 0.0]],
        "pressure_slip_rate": [[1e5, 1e4], [0.0, 0.0], [1e4, 2e5], [0.0, 0.0]],
        "wear_rate": [[np.nan] * 2] * 4,
    }
    data = {name: (("case", "row"), values) for name, values in by_row.items()}
    return xr.Dataset(
        data
        | {
            "window_length": ("case", np.full(4, 600.0)),
            "basic_life": ("case", [1e5, np.inf, 2e5, np.inf]),
        },
        labels | {"row": ["downwind", "upwind"]},
    )


def test_designs_of_a_year_by_hand():
    weights = Year(
        BinProbabilities({12.0: 0.5}), {"parked-12": Rate(87.66, in_hours=True)}
    )  # 1 % of a year
    annual = year(of_year(), Aggregation(weights))
    table, told = designs(annual)
    windy = 0.5 * 0.99 * YEAR
    assert table.lubricant.tolist() == ["b", "a"]  # 2 W and 3 W in both rows
    np.testing.assert_allclose(table.energy, [2.0 * windy, 3.0 * windy], rtol=1e-12)
    np.testing.assert_allclose(table.entries, [1.0 * windy, 3.0 * windy], rtol=1e-12)
    covered = 0.495 + 0.01
    np.testing.assert_allclose(table.mixed_time, [0.0, 0.2 * 0.495 / covered], rtol=1e-12)
    np.testing.assert_allclose(
        table.pressure_slip * REFERENCE_POWER,
        [2e5 * 0.495 / covered, 1e5 * 0.495 / covered],
        rtol=1e-12,
    )
    assert table.peak.tolist() == [40.0, 30.0]
    # Nothing fails while parked, so that only the share with wind counts.
    np.testing.assert_allclose(table.basic_life, np.array([2e5, 1e5]) * covered / 0.495, rtol=1e-12)
    # What is not known is told, and no column of zeros.
    assert "wear" not in table and "entry_slip" not in table
    assert any("wear at k = 1e-17 m²/N" in sentence for sentence in told)
    assert "Entries leave out 87.7 h a year in which no orbit is complete." in told
    assert design_names(annual) == ["a", "b"]


def test_a_value_that_one_model_sets_is_said_by_its_name():
    drag = ("group", ["nan", "False"])
    both = {"model": ("group", ["base", "no drag"]), "forces.drag": drag}
    assert design_names(xr.Dataset(coords=both)) == ["base", "no drag"]
    # Values that part runs of one model are told.
    both["model"] = ("group", ["base", "base"])
    assert design_names(xr.Dataset(coords=both)) == ["", "drag False"]


def test_designs_that_differ_in_their_names_only_are_told():
    same = of_year().assign_coords(key=("case", ["1", "2"] * 2))
    notes = compare(same, by="lubricant").attrs["notes"]
    assert (
        "a and b differ in nothing but their names: they were computed from the same input."
        in notes
    )


def test_a_design_without_results_is_not_ranked():
    gone = of_year()
    gone["energy_mean"][2:] = np.nan
    comparison = compare(gone, by="lubricant")
    assert (
        comparison.attrs["ranking"] == "The designs cannot be ranked: the energy of b is not known."
    )
    assert "2 runs without a result are left out." in comparison.attrs["notes"]


def test_a_sample_of_three_points_tells_nothing():
    assert effects(sample(lambda x, y: 10.0 + x, ("a",)).isel(case=slice(3))).sizes["quantity"] == 0


def test_designs_under_other_loads_are_compared_with_a_note():
    other = of_year().assign_coords(loads=("case", ["w", "p", "v", "p"]))
    notes = compare(other, by="lubricant").attrs["notes"]
    assert "The designs have different loads, so their numbers differ for that reason too." in notes
    assert not any(
        "different loads" in note for note in compare(of_year(), by="lubricant").attrs["notes"]
    )


@pytest.mark.slow
def test_rates_of_a_run_are_those_of_its_damage():
    loads = BearingLoads.constant([0.0, -300e3, 60e3], 2.1, 20.0)
    case = Case(loads=loads, laws=Laws.physical(), rollers=[0, 14], temperature=353.15)
    result = simulate(case)
    values, criteria = damage_values(result), damage(result)
    assert float(values["pressure_slip_rate"].max()) == float(
        criteria.value.sel(criterion="friction_energy_rate")
    )
    # Of the time under load, as the criterion has it, to all time of a roller.
    seconds = 2.0 * (result.attrs["window_end"] - result.attrs["window_start"])
    loaded = result.film_slip_time.sum(["film_class", "slip_class"]) / seconds
    mixed = (criteria.mixed_time.sel(film_ratio=1.0) * loaded).max("raceway")
    np.testing.assert_allclose(values["mixed_film_time"], mixed, rtol=1e-12)
    assert float(values["mixed_film_time"].max()) > 0.01
    # The first micrometre wears at about this rate: its growth follows a profile of slip that is fitted to the maps.
    first = criteria.wear_time.sel(depth=1e-6, wear_coefficient=1e-17).min("surface")
    worn = (values["wear_rate"] * first / 1e-6).sel(row="downwind")
    assert float(worn) == pytest.approx(1.0, abs=0.2)
    # Without details nothing is known, and nothing is zero.
    without = damage_values(simulate(replace(case, contact_details=False)))
    assert without.keys() == values.keys() and all(
        bool(value.isnull().all()) for value in without.values()
    )
