"""The sample over uncertain values: from real runs, with every sample accounted for."""

from dataclasses import replace

import numpy as np
import pytest

from macroslip import HubLoads, MacroslipError, simulate
from macroslip.result.heat_balance import bearing_friction_power
from macroslip.study.settings import template
from macroslip.study.study_file import study_of
from paper.studies import compute
from paper.uncertainty import (
    drivers,
    quantities,
    robust,
    strongest,
    uncertainty,
    uncertainty_summary,
)
from paper.values import VALUES, sample_places

pytestmark = pytest.mark.slow

SHORT = {"loads": {"end": "14 s"}}


def sampled(made, directory):
    compute(study_of(made), directory, may_fail=True)
    return uncertainty(directory)


@pytest.fixture(scope="module")
def made(small):
    return small("uncertainty", "physical", bundled=["12B", "24B"], points=5, **SHORT)


@pytest.fixture(scope="module")
def sample(made, tmp_path_factory):
    return sampled(made, tmp_path_factory.mktemp("uncertainty") / "out")


def case_of(made, point, name):
    """The case of a point of the sample under bundled loads."""
    study = study_of(made)
    records = {
        noun: next(iter(getattr(study, f"{noun}s").values())) for noun in ("bearing", "lubricant")
    }
    case, _ = template(study.case, list(study.variations[point]), records)
    return replace(case, loads=HubLoads.bundled(name).window(None, 14.0))


def test_every_sample_is_a_run_of_its_own(made, sample):
    assert (sample.outcome == 0).all()
    assert sample.sizes["sample"] == 5
    for k in (0, 3):
        result = simulate(case_of(made, k, "24B"))
        point = sample.sel(case="24B").isel(sample=k)
        np.testing.assert_allclose(
            point.orbit_energy, result.orbit_energy.mean(("roller", "orbit")), rtol=1e-12
        )
        peak = result.peak_power.max("interface").mean(("roller", "orbit"))
        np.testing.assert_allclose(point.peak_power, peak, rtol=1e-12)
        assert float(point.window_energy) == pytest.approx(float(result.energy.sum()), rel=1e-12)


def test_the_torque_is_work_over_angle(sample):
    # An orbit takes 2.2 turns of the shaft in this bearing: (r~_in + r~_out)/r~_in.
    turns = (0.338367 + 0.407033) / 0.338367
    work = 28 * sample.orbit_energy.sel(sample=0).sum(("row", "interface"))
    np.testing.assert_allclose(sample.torque.sel(sample=0), work / (2.0 * np.pi * turns), rtol=1e-5)


def test_the_friction_power_has_rolling_and_drag_in_it(made, sample):
    case = case_of(made, 0, "12B")
    power = bearing_friction_power(simulate(case))
    assert float(sample.friction_power.sel(sample=0, case="12B")) == pytest.approx(power, rel=1e-12)
    sliding = sample.torque.sel(sample=0, case="12B") * case.loads.shaft_speed.mean()
    assert power > 2.0 * float(sliding)  # the inlets take most


def test_a_refused_sample_is_counted_with_its_reason(made, tmp_path):
    content = dict(made)
    refused = {"bearing.osculation_inner": 0.999, "bearing.osculation_outer": 0.999}
    points = [*content["variations"]["list"][:2], content["variations"]["list"][2] | refused]
    content |= {"loads": {"bundled": ["12B"]}, "variations": {"list": points}}
    with pytest.raises(MacroslipError, match="1 cases of .* failed, case 12B first: .*ends"):
        compute(study_of(content), tmp_path / "out")
    sample = sampled(content, tmp_path / "out")
    assert sample.outcome.values.tolist() == [0, 0, 2]
    assert "beyond the roller's ends" in str(sample.reason.values[2])
    assert np.isnan(sample.orbit_energy[2]).all()
    summary = uncertainty_summary(sample)
    assert summary.attrs == {"completed": 1, "failed": 0, "refused": 1}


def test_a_failed_roller_takes_its_sample_out_and_is_counted(made, tmp_path):
    content = dict(made)
    point = content["variations"]["list"][1] | {"integrator.max_steps": 5}
    content |= {"loads": {"bundled": ["12B"]}, "variations": {"list": [{}, point]}}
    sample = sampled(content, tmp_path / "out")
    assert sample.outcome.values.tolist() == [0, 1]
    assert uncertainty_summary(sample).attrs["failed"] == 1
    assert np.isnan(uncertainty_summary(sample).range).all()


def synthetic(sample, count=64):
    """A sample in which energy downwind follows the first value, and both ratios fall over wind speed."""
    position = np.concatenate([[0.5], sample_places()[:count, 0]])
    energy = np.ones((count + 1, 2, 2, 3))
    energy[:, 0, 0] *= 9.0 + position[:, None]
    peak = np.broadcast_to(np.array([[4.0, 1.0], [3.0, 1.0]]), (count + 1, 2, 2))
    window = np.broadcast_to(np.array([2.0, 1.0]), (count + 1, 2))
    of_case = ("sample", "case")
    new = {
        "orbit_energy": ((*of_case, "row", "interface"), energy),
        "peak_power": ((*of_case, "row"), peak),
        "window_energy": (of_case, window),
        "torque": (of_case, window + position[:, None]),
        "friction_power": (of_case, window),
        "outcome": ("sample", np.zeros(count + 1, dtype=np.int8)),
    }
    kept = sample.drop_dims("sample").drop_vars("sample", errors="ignore")
    return kept.assign(new).assign_coords(sample=np.arange(count + 1)), position


def test_ranges_drivers_and_trends_follow_the_numbers(sample):
    made, position = synthetic(sample)
    numbers = quantities(made)
    name = "energy, downwind / upwind, 12B"
    np.testing.assert_allclose(numbers.result.sel(quantity=name), 9.0 + position)
    # A quantity that does not change has no rank; that is no driver, and it has no number.
    summary = uncertainty_summary(made)
    assert drivers(summary, "energy in 12B / 24B") == []
    assert drivers(summary, name)[0] == (str(VALUES[0].name), pytest.approx(1.0))
    # The one value that moves it has all of its variance, and the fit foretells it.
    assert strongest(summary, name) == [
        (VALUES[0].name, pytest.approx(1.0, abs=0.02), pytest.approx(1.0, abs=0.02))
    ]
    assert float(summary.explained.sel(quantity=name)) > 0.99
    low, middle, high = summary.range.sel(quantity=name).values
    assert low < middle < high
    assert middle == pytest.approx(9.5, abs=0.05)
    shares = dict(
        zip(summary.trend.values.tolist(), summary.trend_share.values.tolist(), strict=True)
    )
    assert shares["energy ratio within a factor of 2 of 10, any case"] == 1.0
    assert shares["ratio of peak powers falls from case to case of 12B, 24B"] == 1.0
    assert shares["cage takes at least half of the energy of both rows, any case"] == 0.0
    words = dict(robust(summary))
    assert words["energy highest in 12B of 12B, 24B"] == "robust"
    assert (
        words["cage takes at least half of the energy of both rows, any case"] == "robustly not so"
    )
    half = made.window_energy.copy()
    half[1:9] = half[1:9, ::-1].values
    assert (
        dict(robust(uncertainty_summary(made.assign(window_energy=half))))[
            "energy highest in 12B of 12B, 24B"
        ]
        == "not robust"
    )
    swapped = made.peak_power.isel(case=[1, 0]).assign_coords(case=made.case)
    contrary = uncertainty_summary(made.assign(peak_power=swapped))
    assert float(contrary.trend_share.sel(trend="ratio of peak powers highest in 12B")) == 0.0
