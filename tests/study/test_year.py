"""A year: weights of wind speeds and events against sums by hand, and what weights are refused."""

import json

import numpy as np
import pytest
import xarray as xr
from scipy.stats import weibull_min

from macroslip import InputError, open_study, run_study
from macroslip.constants import YEAR
from macroslip.scada.bins import bin_centres
from macroslip.study.aggregation import Aggregation, aggregation_in_use
from macroslip.study.lifetime import lifetime_energy
from macroslip.study.loads_list import Load
from macroslip.study.study_file import study_of
from macroslip.study.weights import (
    IEC_CLASSES,
    BinProbabilities,
    Rate,
    Weibull,
    Year,
    binned,
    stored_weighting,
)
from macroslip.study.year import EXPONENTS, LIVES, YEAR_VARIABLES, coverage, year
from tests.variables import check_variables

HOUR = 3600.0


def study(energy=(600.0, 1200.0, 300.0, 50.0), life=(2e4, 2e4, 1e4, np.inf)):
    """Two runs at 12 m/s, one start of 100 s and idling of 200 s."""
    count = len(energy)
    labels = {name: ("case", ["x"] * count) for name in ("bearing", "lubricant", "model")}
    labels["wind_speed"] = ("case", [12.0, 12.4, 8.0, 6.0], {"units": "m/s"})
    labels["event"] = ("case", np.array(["", "", "start-8", "idle-6"], dtype=object))
    both = np.column_stack([energy, np.multiply(2.0, energy)])
    data = {
        name: (("case", "row"), both, {"units": "J"}) for name in ("energy_mean", "peak_power_max")
    }
    data |= {name: ("case", list(life)) for name in LIVES}
    data |= {f"damage_equivalent_load_{m}": ("case", [3e5, 3e5, 4e5, 0.0]) for m in EXPONENTS}
    return xr.Dataset(
        data | {"window_length": ("case", [600.0, 600.0, 100.0, 200.0])},
        labels | {"row": ["downwind", "upwind"]},
    )


YEARLY = Year(
    BinProbabilities({12.0: 0.5}), {"start-8": Rate(300.0), "idle-6": Rate(400.0, in_hours=True)}
)


@pytest.mark.slow
def test_all_rollers_of_events_are_computed(tmp_path):
    """What a start or stop does falls on few places, so two rollers would tell several times too much or too little."""
    case = {"rollers": [0, 14], "laws": {"model": "paper"}, "loads": {"end": "1 s"}}
    study = study_of({"case": case, "loads": {"bundled": ["8B", "idle-6"]}})
    rollers = {run.load.name: study.case_of(run)[0].rollers for run in study.runs()}
    assert rollers == {"8B": (0, 14), "idle-6": "all"}
    run_study(study, tmp_path / "out")
    status = open_study(tmp_path / "out").status
    computed = status.sel(row="downwind").count("roller").to_series()
    assert computed.tolist() == [2, 28]


def test_events_take_their_time_and_wind_speeds_the_rest():
    annual = year(study(), Aggregation(YEARLY))
    check_variables(annual, YEAR_VARIABLES)
    starts, idle = 300.0 * 100.0, 400.0 * HOUR
    windy = 0.5 * (YEAR - starts - idle)
    np.testing.assert_allclose(annual.hours * HOUR, [windy, starts, idle], rtol=1e-12)
    assert annual.event.values.tolist() == ["", "start-8", "idle-6"]
    # 1.5 W in the mean of two runs; 300 starts of 300 J each; 0.25 W.
    np.testing.assert_allclose(
        annual.energy.isel(group=0).sel(row="downwind"),
        [1.5 * windy, 300.0 * 300.0, 0.25 * idle],
        rtol=1e-12,
    )
    np.testing.assert_allclose(
        annual.per_hour.isel(group=0).sel(row="upwind"), 2.0 * HOUR * np.array([1.5, 3.0, 0.25])
    )
    life = lifetime_energy(study(), Aggregation(YEARLY, years=2.0))
    np.testing.assert_allclose(life.lifetime_energy, 2.0 * annual.total, rtol=1e-12)
    # 8.33 h of starts, 400 h of idling, and half of the 8357.7 h that are left of 8766 h.
    expected = "The cases cover 52 % of a year: 4179 h of wind speeds and 408 h of events, whose supervisor is assumed."
    assert coverage(annual) == expected


def test_lives_accumulate_by_damage_and_loads_by_their_power():
    annual = year(study(), Aggregation(YEARLY))
    share = annual.hours.values / annual.hours.values.sum()
    np.testing.assert_allclose(
        1.0 / annual.basic_life.item(), share[0] / 2e4 + share[1] / 1e4, rtol=1e-12
    )
    expected = (share[0] * 3e5**4 + share[1] * 4e5**4) ** 0.25
    np.testing.assert_allclose(annual.damage_equivalent_load_4.item(), expected, rtol=1e-12)
    # A life that is not known is not passed over.
    assert np.isnan(
        year(study(life=(2e4, 2e4, np.nan, np.inf)), Aggregation(YEARLY)).basic_life.item()
    )


def test_scatter_is_that_of_runs_in_a_bin():
    annual = year(study().isel(case=slice(2)), Aggregation(BinProbabilities({12.0: 1.0})))
    # 1 and 2 W: s = 0.707 W, over the root of two, in 1.5 W.
    np.testing.assert_allclose(annual.scatter, 0.5 / 1.5, rtol=1e-12)
    assert np.isnan(
        year(study().isel(case=[0, 2, 3]), Aggregation(BinProbabilities({12.0: 1.0}))).scatter
    ).all()


def test_an_event_without_a_result_makes_the_year_unknown_only_if_it_counts():
    gone = study(energy=(600.0, 1200.0, np.nan, 50.0))
    gone["window_length"][2] = np.nan
    assert np.isnan(year(gone, Aggregation(YEARLY)).total).all()
    assert np.isfinite(
        year(gone, Aggregation(Year(YEARLY.wind, {"idle-6": Rate(1.0)}))).total
    ).all()


def test_bins_hold_what_their_probability_says():
    """Drawn wind speeds fall into the bin around a centre as often as the probability of that centre; half a bin off fails."""
    weibull = Weibull(9.5, 2.0)
    drawn = weibull_min(2.0, scale=9.5).rvs(200_000, random_state=1)
    for width in (1.0, 2.0):
        centres, counts = np.unique(bin_centres(drawn, width), return_counts=True)
        for centre, count in zip(centres, counts, strict=True):
            probability = weibull.probability(centre, width)
            assert count / drawn.size == pytest.approx(
                probability, abs=5.0 * np.sqrt(probability / drawn.size) + 1e-5
            )
    # The weighted mean speed is the distribution's, 8.42 m/s.
    fine = np.arange(0.0, 60.0, 0.5)
    mean = sum(weibull.probability(wind, 0.5) * wind for wind in fine)
    assert mean == pytest.approx(weibull_min(2.0, scale=9.5).mean(), abs=0.005)


@pytest.mark.parametrize(("name", "mean"), [("IEC I", 10.0), ("IEC II", 8.5), ("IEC III", 7.5)])
def test_classes_have_the_mean_wind_speed_of_the_standard(name, mean):
    weibull = IEC_CLASSES[name]
    assert weibull_min(weibull.shape, scale=weibull.scale).mean() == pytest.approx(mean, rel=1e-12)


WEIGHTS = {
    "wind": {"weibull": "IEC II"},
    "events": {"start-8": "300 per year", "idle-6": "400 h per year"},
}


def of_file(weights, bundled=("8B", "12B", "start-8", "idle-6")):
    return study_of({"loads": {"bundled": list(bundled)}, "weights": weights})


def test_weights_of_a_study_file():
    known = of_file(WEIGHTS).weights
    assert known.year == Year(
        IEC_CLASSES["IEC II"], {"start-8": Rate(300.0), "idle-6": Rate(400.0, True)}
    )
    flat = of_file({"scale": 9.5, "shape": 2.0}).weights
    assert flat.year == of_file({"wind": {"weibull": {"scale": 9.5, "shape": 2.0}}}).weights.year


def test_the_weights_of_the_file_are_used_by_all_and_an_option_replaces_the_wind():
    stored = xr.Dataset(attrs={"study": json.dumps({"weights": WEIGHTS | {"width": 1.0}})})
    assert stored_weighting(stored).year == of_file(WEIGHTS).weights.year
    assert aggregation_in_use(stored) == Aggregation(of_file(WEIGHTS).weights.year, width=1.0)
    used = aggregation_in_use(stored, Weibull(9.0, 2.0)).weights
    assert used.wind == Weibull(9.0, 2.0) and used.events["start-8"] == Rate(300.0)
    windy = xr.Dataset(coords={"wind_speed": ("case", [8.0])})
    assert aggregation_in_use(windy) == Aggregation()


def test_the_balance_of_heat_counts_events_by_their_hours():
    loads = [
        Load("a", {"wind_speed": 12.0}),
        Load("idle-6", {"wind_speed": 6.0, "event": "idle-6"}),
    ]
    loads.append(Load("start-8", {"wind_speed": 8.0, "event": "start-8"}))
    given = of_file(WEIGHTS).weights
    windy = (1.0 - 400.0 * HOUR / YEAR) * IEC_CLASSES["IEC II"].probability(12.0, 2.0)
    expected = np.array([windy, 400.0 * HOUR / YEAR, 0.0])
    np.testing.assert_allclose(given.of(loads), expected / expected.sum(), rtol=1e-12)


@pytest.mark.parametrize(
    ("weights", "message"),
    [
        ({"scale": 0.001, "shape": 2.0}, "the wind speeds from 8 to 12 have no probability at all"),
        (
            {"scale": 1e-300, "shape": 2.0},
            "the wind speeds from 8 to 12 have no probability at all",
        ),
        ({"scale": 9.5}, "the distribution of the wind speeds is not given"),
        ({"scale": 9.5, "shape": 2.0, "wind": {"weibull": "IEC I"}}, "given twice"),
        ({"wind": {"weibull": "IEC IV"}}, "IEC I, IEC II, IEC III"),
        (
            {"wind": {"weibull": "IEC I"}, "events": {"start-8": "often"}},
            "such as '300 per year' or '400 h per year'",
        ),
        (
            {"wind": {"weibull": "IEC I"}, "events": {"stop-14": "3 per year"}},
            "the event 'stop-14'.*start-8, idle-6",
        ),
        (
            {"wind": {"weibull": "IEC I"}, "events": {"idle-6": "9000 h per year"}},
            "take 9000 hours of a year",
        ),
        # A record of 199.95 s, a hundred million times.
        (
            {"wind": {"weibull": "IEC I"}, "events": {"start-8": "1e8 per year"}},
            r"the events take 5\.55417e\+06 hours of a year.*up to 8766 hours",
        ),
    ],
)
def test_weights_that_are_refused(weights, message):
    with pytest.raises(InputError, match=message):
        of_file(weights)


def test_an_event_of_a_file_takes_the_length_of_its_record(tmp_path, write_loads):
    """A record of 100 s, of which the case takes 40 s: 788,940 of them fill a year of 31,557,600 s."""
    write_loads(tmp_path / "8_.csv", seconds=100.0)
    write_loads(tmp_path / "8_start.csv", seconds=100.0)

    def study(rate):
        return study_of(
            {
                "case": {"loads": {"start": "50 s"}, "window": {"start": "55 s", "end": "95 s"}},
                "loads": {"files": "{wind_speed:g}_*.csv", "kind": "main-bearing"},
            }
            | {"loads": {"table": "list.csv", "kind": "main-bearing"}}
            | {"weights": {"wind": {"weibull": "IEC I"}, "events": {"start": rate}}},
            tmp_path,
        )

    (tmp_path / "list.csv").write_text(
        "file,wind_speed,event\n8_.csv,8.0,\n8_start.csv,8.0,start\n"
    )
    assert len(study("788939 per year")) == 2
    with pytest.raises(InputError, match="the events take 8766.01 hours of a year"):
        study("788941 per year")


def test_weights_that_underflow_are_refused_where_results_are_weighted():
    with pytest.raises(
        InputError, match="the wind speeds from 12 to 12 have no probability at all"
    ):
        lifetime_energy(study(), Aggregation(Weibull(0.001, 2.0)))


def test_events_are_in_no_bin_of_wind_speeds():
    bins = binned(study(), "wind_speed", 2.0)
    np.testing.assert_array_equal(bins.centres, [12.0, np.nan, np.nan])
    assert bins.bin.tolist() == [0, 0, 1, 2]
