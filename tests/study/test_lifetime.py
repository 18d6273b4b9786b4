"""Aggregation against sums by hand."""

import math

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st

from macroslip import InputError
from macroslip.constants import YEAR
from macroslip.study.aggregation import Aggregation, aggregation_in_use
from macroslip.study.lifetime import LIFETIME, PERCENTILES, lifetime_energy, percentiles, worst
from macroslip.study.loads_list import Load
from macroslip.study.summary import ROW_VARIABLES
from macroslip.study.weights import BinProbabilities, Weibull, Weighting, binned
from tests.variables import check_variables

SPEEDS = [12.0, 12.4, 11.6, 14.0, 14.0, 12.0, 14.0]
CLEARANCES = [0.0] * 5 + [0.2] * 2


def study(energy=(600.0, 1200.0, 1800.0, 60.0, 60.0, 6.0, 6.0)):
    """Seven runs: three at 12 m/s and two at 14 m/s with one clearance, one each with another; 600 s each."""
    both = np.column_stack([energy, np.multiply(2.0, energy)])
    labels = {
        name: ("case", ["x"] * 7, {"units": "1"}) for name in ("bearing", "lubricant", "model")
    }
    labels["wind_speed"] = ("case", SPEEDS, {"units": "m/s"})
    labels["bearing.diametral_clearance"] = ("case", CLEARANCES, {"units": "mm"})
    labels["seed"] = ("case", [1, 2, 3, 1, 2, 1, 1], {"units": "1"})
    data = {
        name: (("case", "row"), both.copy(), {"units": variable.units})
        for name, variable in ROW_VARIABLES.items()
    }
    return xr.Dataset(
        data | {"window_length": ("case", [600.0] * 7)}, labels | {"row": ["downwind", "upwind"]}
    )


def test_lifetime_energy_is_the_weighted_sum():
    life = lifetime_energy(
        study(), Aggregation(BinProbabilities({12.0: 0.5, 14.0: 0.25}), years=2.0)
    )
    first, second = life.isel(group=0), life.isel(group=1)
    assert float(first["bearing.diametral_clearance"]) == 0.0
    seconds = 2.0 * YEAR
    expected = seconds * (0.5 * 2.0 + 0.25 * 0.1)  # means of 1, 2, 3 W and of 0.1, 0.1 W
    np.testing.assert_allclose(first.lifetime_energy, [expected, 2.0 * expected], rtol=1e-14)
    np.testing.assert_allclose(
        second.lifetime_energy, seconds * 0.75 * np.array([0.01, 0.02]), rtol=1e-14
    )
    assert float(life.covered) == 0.75 and life.runs.values.tolist() == [[3, 2], [1, 1]]


@pytest.mark.slow
@given(st.floats(3.0, 15.0), st.floats(1.0, 4.0), st.floats(0.25, 4.0))
def test_weibull_bins_cover_all_speeds(scale, shape, width):
    centres = np.arange(0, int(600 / width)) * width
    assert sum(Weibull(scale, shape).probability(c, width) for c in centres) == pytest.approx(
        1.0, abs=1e-9
    )


def test_a_run_without_a_result_is_left_out_and_reported():
    broken = study((600.0, np.nan, 1800.0, 60.0, 60.0, 6.0, np.nan))
    life = lifetime_energy(broken, Aggregation(BinProbabilities({12.0: 0.5, 14.0: 0.25})))
    assert life.left_out.values.tolist() == [[1, 0], [0, 1]]
    assert float(life.power.isel(group=0).sel(bin=12.0, row="downwind")) == 2.0
    # A bin without any run gives no number, unless it has no weight.
    assert np.isnan(life.lifetime_energy.isel(group=1)).all()
    without = lifetime_energy(broken, Aggregation(BinProbabilities({12.0: 0.5, 14.0: 0.0})))
    assert np.isfinite(without.lifetime_energy).all()


def test_percentiles_over_seeds():
    check_variables(percentiles(study()), PERCENTILES)
    shares = BinProbabilities({12.0: 0.5, 14.0: 0.5})
    check_variables(lifetime_energy(study(), Aggregation(shares)), LIFETIME)
    spread = (
        percentiles(study(), quantiles=(0.0, 0.5, 1.0)).isel(group=0).sel(bin=12.0, row="downwind")
    )
    assert spread.power.values.tolist() == [1.0, 2.0, 3.0]
    assert (
        spread.peak_power_max.values.tolist() == [600.0, 1200.0, 1800.0] and float(spread.runs) == 3
    )


def test_the_worst_come_first():
    worst_runs = worst(
        study((600.0, np.nan, 1800.0, 60.0, 60.0, 6.0, 6.0)), "peak_power_max", count=3
    )
    assert worst_runs.peak_power_max.values.tolist() == [3600.0, 1800.0, 1200.0]
    assert worst_runs.row.values.tolist() == [
        "upwind",
        "downwind",
        "upwind",
    ] and worst_runs.seed.values.tolist() == [3, 3, 1]
    assert worst(study(), "energy_mean", count=1, smallest=True).energy_mean.values.tolist() == [
        6.0
    ]


def test_bins_and_groups():
    bins = binned(study(), "wind_speed", 2.0, by=["seed"])
    assert bins.centres.tolist() == [12.0, 14.0] and bins.bin.tolist() == [0, 0, 0, 1, 1, 0, 1]
    assert len(bins.groups) == 4
    # A parameter that some runs leave to the base case is one value of it.
    some = study().assign_coords(
        {"bearing.diametral_clearance": ("case", [math.nan] * 5 + [0.2] * 2)}
    )
    assert len(binned(some, "wind_speed", 2.0).groups) == 2


def test_runs_that_nothing_weighs_need_no_wind_speed():
    """A study whose load files are labelled by their seed only."""
    calm = study().drop_vars("wind_speed")
    aggregation = aggregation_in_use(calm)
    spread = percentiles(calm, aggregation, [0.5])
    # Five runs of one clearance, of 1, 2, 3, 0.1 and 0.1 W; two of another.
    assert spread.runs.values.tolist() == [[5], [2]]
    np.testing.assert_allclose(spread.power.sel(row="downwind")[:, 0, 0], [1.0, 0.01])
    with pytest.raises(InputError, match=r"no label 'wind_speed'.*--field"):
        lifetime_energy(calm, aggregation_in_use(calm, Weibull(9.0, 2.0)))


def test_a_bin_reaches_half_its_width_to_either_side():
    """10.9 m/s counts as 10, 11.0 and 12.9 as 12, 13.0 as 14: the same for the weights of loads and the bins of results."""
    speeds = [10.9, 11.0, 12.9, 13.0]
    above = [math.exp(-((edge / 9.5) ** 2)) for edge in (9.0, 11.0, 13.0, 15.0)]
    low, middle, high = (above[k] - above[k + 1] for k in range(3))
    expected = np.array([low, 0.5 * middle, 0.5 * middle, high]) / (low + middle + high)
    loads = [Load(str(speed), {"wind_speed": speed}) for speed in speeds]
    np.testing.assert_allclose(Weighting(scale=9.5, shape=2.0).of(loads), expected, rtol=1e-12)
    bins = binned(
        study().isel(case=slice(4)).assign_coords(wind_speed=("case", speeds)), "wind_speed", 2.0
    )
    assert (bins.centres.tolist(), bins.bin.tolist()) == ([10.0, 12.0, 14.0], [0, 1, 1, 2])
    np.testing.assert_allclose(
        bins.probabilities(Weibull(9.5, 2.0)), [low, middle, high], rtol=1e-12
    )


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: binned(study(), "wind", 2.0), "no label 'wind'.* Name .*--field"),
        (lambda: binned(study(), "wind_speed", by=["site"]), "no label 'site'.*--by"),
        (lambda: Aggregation(Weibull(9.0, 2.0), field=None), "no label sorts them"),
        (lambda: binned(study(), "bearing", 2.0), "not a number"),
        (lambda: binned(study(), "wind_speed", 0.0), "width of the bins"),
        (
            lambda: lifetime_energy(study(), Aggregation(BinProbabilities({12.0: 1.0}))),
            "no probability is given for the bin at 14",
        ),
        (
            lambda: lifetime_energy(study(), Aggregation(BinProbabilities({12.0: 1.0, 14.0: 0.5}))),
            "together at most 1",
        ),
        (lambda: lifetime_energy(study(), Aggregation(Weibull(0.0, 2.0))), "scale"),
        (
            lambda: lifetime_energy(study(), Aggregation(Weibull(9.0, 2.0), years=-1.0)),
            "lifetime is -1",
        ),
        (lambda: percentiles(study(), quantiles=[2.0]), "quantiles"),
        (lambda: worst(study(), "nothing"), "no variable 'nothing'"),
        (lambda: worst(study(), count=0), "count is 0"),
    ],
)
def test_what_is_refused(call, message):
    with pytest.raises(InputError, match=message):
        call()
