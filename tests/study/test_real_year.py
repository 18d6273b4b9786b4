"""A year at measured winds and temperatures: against sums by hand and against `aggregate`."""

import numpy as np
import pandas as pd
import pytest
from scipy.optimize import brentq

from macroslip import InputError
from macroslip.constants import YEAR, ZERO_CELSIUS
from macroslip.input.fields import IN_FILE
from macroslip.input.section import form_from
from macroslip.input.units import POWER, RECORDED_TEMPERATURE, SPEED, WIND_SPEED
from macroslip.report.comparison import compare_designs
from macroslip.scada.bins import JointShares, histogram, nearest_bins
from macroslip.scada.description import (
    Clock,
    Columns,
    MeasuredColumn,
    Rated,
    ScadaDescription,
)
from macroslip.scada.reader import Scada
from macroslip.study.aggregation import Aggregation
from macroslip.study.exceedance import exceedance
from macroslip.study.over_temperature import RunsOverTemperature, interpolated, weighted_study
from macroslip.study.real_year import real_year
from macroslip.study.temperature_shares import TemperatureShares
from macroslip.study.weights import (
    BinProbabilities,
    Rate,
    Weibull,
    Weighting,
    Year,
    stored_weighting,
)
from macroslip.study.year import designs, year
from tests.study.made_up_study import SECONDS, made_up_study, power, wear_rate

EVENTS = {"start-8": "200 per year", "idle-6": "400 h per year"}
WEIGHTS = {"width": 4.0, "wind": {"weibull": "IEC II"}, "events": EVENTS}


def turbine(wind, celsius, turning=None, load_by="wind", oil_offset=0.0):
    """A record of a turbine, made in memory."""
    wind = np.asarray(wind, dtype=float)
    turning = np.ones(wind.size, dtype=bool) if turning is None else np.asarray(turning)
    description = ScadaDescription(
        turbine="made up",
        files=["none.csv"],
        time=Clock(column="t"),
        columns=Columns(
            wind_speed=MeasuredColumn("w", "m/s", WIND_SPEED),
            rotor_speed=MeasuredColumn("n", "rad/s", SPEED),
            power=MeasuredColumn("p", "W", POWER),
            bearing_temperature=MeasuredColumn("b", "K", RECORDED_TEMPERATURE),
        ),
        rated=Rated(rotor_speed=1.8, power=1.5e6),
        load_by=load_by,
        oil_offset=oil_offset,
    )
    index = pd.date_range("2023-01-01", periods=wind.size, freq="10min", tz="UTC", name="time")
    data = pd.DataFrame(
        {
            "wind_speed": wind,
            "rotor_speed": np.where(turning, 1.5, 0.0),
            "power": np.where(turning, 1.5e6 * np.clip(wind / 12.0, 0.0, 1.0) ** 3, 0.0),
            "bearing_temperature": np.asarray(celsius) + ZERO_CELSIUS,
            "nacelle_temperature": np.nan,
            "ambient_temperature": np.nan,
            "status": "",
            "filter": pd.Categorical([""] * wind.size, ["", "range"]),
            "jump": False,
        },
        index=index,
    )
    counts = pd.DataFrame({"month": ["2023-01"], "filter": ["kept"], "rows": [wind.size]})
    return Scada(description, data, counts, 600.0)


def months(rows=9000, seed=2):
    random = np.random.default_rng(seed)
    return random.choice([4.0, 8.0, 12.0], rows), random.uniform(12.0, 38.0, rows)


def test_one_temperature_gives_the_year_of_aggregate():
    wind, _ = months()
    turning = np.arange(9000) % 5 > 0
    real = real_year(turbine(wind, np.full(9000, 35.0), turning), made_up_study(weights=WEIGHTS))
    study = made_up_study(weights=WEIGHTS)
    at_35 = study.isel(case=np.flatnonzero(study["lubricant.at"].values == 35.0))
    share = {speed: float((wind[turning] == speed).sum() / 9000) for speed in (4.0, 8.0, 12.0)}
    events = {name: Rate.written(text) for name, text in EVENTS.items()}
    weights = Year(BinProbabilities(share), events)
    expected = designs(year(at_35, Aggregation(weights, 1.0, width=4.0)))[0].iloc[0]
    for line in real.table.to_dict("records"):
        for name in ("real", "at_mean", "fixed"):
            assert line[name] == pytest.approx(expected[line["quantity"]], rel=1e-9), line


def test_a_year_of_two_halves_is_their_mean():
    wind, celsius = months()
    study = made_up_study(weights=WEIGHTS)
    halves = [slice(0, 4500), slice(4500, 9000)]
    # Events other than standing are at the mean temperature, which is no mean of years.
    study = study.isel(case=np.flatnonzero(study["event"].values == ""))
    study.attrs["study"] = (
        made_up_study(weights=WEIGHTS | {"events": {}})
        .attrs["study"]
        .replace('"events": {}', '"field": "wind_speed"')
    )
    whole, *parts = [
        real_year(turbine(wind[part], celsius[part]), study, allow_short=True)
        for part in (slice(None), *halves)
    ]
    for quantity in ("energy", "wear", "entries"):
        values = [part.table.set_index("quantity").loc[quantity, "real"] for part in parts]
        expected = whole.table.set_index("quantity").loc[quantity, "real"]
        assert np.mean(values) == pytest.approx(expected, rel=1e-9)


def test_a_year_is_the_sum_over_bins_that_a_loop_makes():
    wind, celsius = months()
    turning = np.arange(9000) % 5 > 0
    study = made_up_study(weights=WEIGHTS)
    computed = real_year(turbine(wind, celsius, turning), study)
    binned = np.floor(celsius / 2.5 + 0.5) * 2.5
    events = 200.0 * SECONDS / YEAR + 400.0 * 3600.0 / YEAR
    wear = energy = 0.0
    numbers = {4.0: [0], 8.0: [1, 2], 12.0: [3]}
    for speed, runs in numbers.items():
        for at in np.unique(binned):
            share = (1.0 - events) * np.mean(turning & (wind == speed) & (binned == at))
            wear += YEAR * share * np.mean([wear_rate(speed, at, n) for n in runs])
            energy += 1.3 * YEAR * share * np.mean([power(speed, at, n) for n in runs])
    mean = celsius[turning].mean()
    wear += 200.0 * SECONDS * wear_rate(8.0, mean, 4)
    energy += 1.3 * 200.0 * SECONDS * power(8.0, mean, 4)
    for at in np.unique(binned[~turning]):
        seconds = 400.0 * 3600.0 * np.mean(binned[~turning] == at)
        wear += seconds * wear_rate(6.0, at, 5)
        energy += 1.3 * seconds * power(6.0, at, 5)
    real = computed.table.set_index("quantity")["real"]
    # Both are exponential in temperature, which PCHIP of the logarithm reproduces.
    assert real["wear"] == pytest.approx(wear, rel=1e-9)
    assert real["energy"] == pytest.approx(energy, rel=1e-9)


def test_five_kelvin_change_wear_by_what_the_rates_say():
    wind, celsius = months()
    real = real_year(turbine(wind, celsius.clip(16.0, 34.0)), made_up_study(weights=WEIGHTS))
    wear = real.table.set_index("quantity").loc["wear"]
    assert wear["oil_warmer"] / wear["real"] == pytest.approx(np.exp(0.158 * 5.0), rel=1e-9)
    assert wear["real"] / wear["oil_cooler"] == pytest.approx(np.exp(0.158 * 5.0), rel=1e-9)
    offset = real_year(
        turbine(wind, celsius.clip(16.0, 34.0), oil_offset=5.0), made_up_study(weights=WEIGHTS)
    )
    assert offset.table.set_index("quantity").loc["wear", "real"] == pytest.approx(
        wear["oil_warmer"], rel=1e-9
    )


def test_bins_add_up_to_the_year():
    wind, celsius = months()
    turning = np.arange(9000) % 5 > 0
    study = made_up_study(weights={**WEIGHTS, "events": {"start-8": "0 per year"}})
    computed = real_year(turbine(wind, celsius, turning), study)
    real = computed.table.set_index("quantity")["real"]
    assert computed.bins["share"].sum() == pytest.approx(1.0, rel=1e-12)
    assert computed.bins["hours [h]"].sum() == pytest.approx(8766.0, rel=1e-12)
    assert computed.bins["energy [J]"].sum() == pytest.approx(real["energy"], rel=1e-9)
    assert computed.bins["wear [m]"].sum() == pytest.approx(real["wear"], rel=1e-9)


def test_seeds_scatter_as_the_two_runs_of_a_bin():
    wind = np.full(9000, 8.0)
    real = real_year(turbine(wind, np.full(9000, 35.0)), made_up_study(weights=WEIGHTS))
    runs = np.array([wear_rate(8.0, 35.0, n) for n in (1, 2)])
    events = 200.0 * SECONDS / YEAR + 400.0 * 3600.0 / YEAR
    of_events = 200.0 * SECONDS * wear_rate(8.0, 35.0, 4) / YEAR
    of_events += 400.0 * 3600.0 * wear_rate(6.0, 35.0, 5) / YEAR
    error = (1.0 - events) * runs.std(ddof=1) / np.sqrt(2.0)
    expected = 100.0 * error / ((1.0 - events) * runs.mean() + of_events)
    assert real.table.set_index("quantity").loc["wear", "seeds [%]"] == pytest.approx(expected)


def test_a_distribution_of_the_wind_keeps_the_temperatures():
    wind, celsius = months()
    celsius = np.where(wind == 4.0, 15.0, np.where(wind == 8.0, 25.0, 35.0))
    study = made_up_study(weights=WEIGHTS)
    weibull = Weibull(8.0, 2.0)
    real = real_year(turbine(wind, celsius), study, wind=weibull)
    events = 200.0 * SECONDS / YEAR + 400.0 * 3600.0 / YEAR
    bins = real.bins.groupby("wind_speed [m/s]")["share"].sum()
    for speed in (4.0, 8.0, 12.0):
        expected = (1.0 - events) * weibull.probability(speed, 4.0)
        assert bins[speed] == pytest.approx(expected, rel=1e-12)


def test_designs_are_kept_apart():
    wind, celsius = months()
    study = made_up_study(weights=WEIGHTS, clearances=(0.0, 0.5))
    real = real_year(turbine(wind, celsius), study)
    wear = real.table[real.table["quantity"] == "wear"]
    assert sorted(wear["design"]) == ["diametral clearance 0 mm", "diametral clearance 0.5 mm"]
    assert wear["real"].max() / wear["real"].min() == pytest.approx(1.5, rel=1e-12)


def test_too_few_temperatures_and_temperatures_that_do_not_span_are_refused():
    wind, celsius = months()
    with pytest.raises(InputError, match="3 temperatures of the oil"):
        real_year(turbine(wind, celsius), made_up_study((15.0, 25.0, 35.0)))
    with pytest.raises(InputError, match="are at 25 to 40 degC"):
        real_year(turbine(wind, celsius), made_up_study((25.0, 30.0, 35.0, 40.0)))
    held = real_year(turbine(wind, celsius), made_up_study((15.0, 20.0, 25.0, 35.0)))
    assert any("there the nearest run holds" in note for note in held.notes)


def test_a_short_record_needs_permission():
    wind, celsius = months(1000)
    with pytest.raises(InputError, match="6.94 days.*--allow-short"):
        real_year(turbine(wind, celsius), made_up_study(weights=WEIGHTS))
    assert real_year(turbine(wind, celsius), made_up_study(), allow_short=True).table.size


def test_a_failed_run_is_left_out_and_told():
    wind, celsius = months()
    study = made_up_study(weights=WEIGHTS)
    case = np.flatnonzero((study.loads.values == "8b") & (study["lubricant.at"].values == 45.0))
    study.energy_mean[case] = np.nan
    study.wear_rate[case] = np.nan
    real = real_year(turbine(wind, celsius), study)
    assert real.table.set_index("quantity").loc["wear", "real"] > 0.0
    assert any("left out" in note for note in real.notes)


def test_load_by_power_takes_the_wind_of_the_same_share_of_rated_power():
    wind = np.tile([6.0, 9.0, 20.0], 3000)
    scada = turbine(wind, np.full(9000, 25.0), load_by="power")
    shares = JointShares.of(scada, np.array([4.0, 6.0, 8.0, 10.0, 20.0]), 2.0).wind_shares()
    # 11.2/12 of the wind, since the record's power is that of a turbine rated at 12 m/s.
    assert shares[6.0] == shares[8.0] == shares[20.0] == pytest.approx(1.0 / 3.0)


def test_bins_are_the_nearest_ones():
    values = np.linspace(-1.0, 30.0, 311)
    centres = np.array([4.0, 6.0, 12.0, 14.0])
    middle = np.floor(values / 2.0 + 0.5) * 2.0
    expected = [int(np.argmin(np.abs(centres - wind))) for wind in middle]
    assert nearest_bins(values, centres, 2.0).tolist() == expected


def test_shares_of_the_histogram_add_up_to_one():
    wind, celsius = months()
    table = histogram(turbine(wind, celsius, np.arange(9000) % 3 > 0))
    assert table["share"].sum() == pytest.approx(1.0, rel=1e-12)
    assert table["hours [h]"].sum() == pytest.approx(1500.0, rel=1e-12)
    assert table[table["state"] == "idle"]["share"].sum() == pytest.approx(1.0 / 3.0, rel=1e-12)


def test_weights_of_a_study_keep_the_measured_year():
    wind, celsius = months()
    joint = JointShares.of(turbine(wind, celsius), np.array([4.0, 8.0, 12.0]), 4.0)
    weights = {"width": 4.0, "scada": joint.content(), "events": EVENTS}
    study = made_up_study(weights=weights)
    stored = stored_weighting(study)
    means = weighted_study(study)
    aggregation = Aggregation(stored.year, 1.0, stored.field, stored.width)
    weighted = designs(year(means, aggregation))[0].iloc[0]
    expected = real_year(turbine(wind, celsius), made_up_study(weights=WEIGHTS))
    for line in expected.table.to_dict("records"):
        assert weighted[line["quantity"]] == pytest.approx(line["real"], rel=1e-9)


def test_a_measured_year_excludes_other_winds():
    for other in ({"wind": {"weibull": "IEC II"}}, {"scale": 9.0, "shape": 2.0}):
        with pytest.raises(InputError, match="and the measured year scada stand together"):
            form_from(Weighting).read({"scada": "scada.yaml"} | other, IN_FILE)


def test_temperatures_by_wind_weight_the_runs():
    weights = {
        "width": 4.0,
        "wind": {"weibull": {"scale": 9.0, "shape": 2.0}},
        "temperature": {"by_wind": {4: "20 degC", 8: "27.5 degC", 12: "40 degC"}},
    }
    study = made_up_study(weights=weights)
    means = weighted_study(study)
    assert "lubricant.at" not in means.coords
    wear = means.wear_rate.sel(row="downwind").values
    expected = [wear_rate(4.0, 20.0, 0), wear_rate(8.0, 27.5, 1), wear_rate(8.0, 27.5, 2)]
    assert wear[:3] == pytest.approx(expected, rel=1e-9)
    likely = np.array([Weibull(9.0, 2.0).probability(wind, 4.0) for wind in (4.0, 8.0, 12.0)])
    mean = likely @ [20.0, 27.5, 40.0] / likely.sum()
    assert wear[4] == pytest.approx(wear_rate(8.0, mean, 4), rel=1e-9)


def test_a_temperature_outside_the_runs_is_an_error():
    weights = {
        "width": 4.0,
        "wind": {"weibull": "IEC II"},
        "temperature": {"by_wind": {4: "20 degC", 8: "30 degC", 12: "46 degC"}},
    }
    with pytest.raises(InputError, match="20 to 46 degC.*5 to 45 degC"):
        weighted_study(made_up_study(weights=weights))
    weights["temperature"] = {"by_wind": {4: "20 degC", 8: "30 degC"}}
    with pytest.raises(InputError, match="no temperature is given for the bin at 12"):
        weighted_study(made_up_study(weights=weights))


def with_friction(study, factor):
    """Friction power [W] of the bearing in every run, times 1 + the clearance [mm] of its design."""
    labels = zip(study["wind_speed"].values, study["lubricant.at"].values, strict=True)
    powers = np.array([factor * power(wind, celsius, 0) for wind, celsius in labels])
    if "bearing.diametral_clearance" in study.coords:
        powers = powers * (1.0 + study["bearing.diametral_clearance"].values)
    return study.assign(friction_power=("case", powers, {"units": "W"}))


BALANCED = {
    "width": 4.0,
    "wind": {"weibull": {"scale": 9.0, "shape": 2.0}},
    "temperature": {"balance": {"conductance": "20 W/K", "ambient": "10 degC"}},
}


def test_each_bin_of_each_design_has_the_temperature_of_its_balance():
    study = with_friction(made_up_study(weights=BALANCED, clearances=(0.0, 0.5)), 100.0)
    means = weighted_study(study)
    assert means.sizes["case"] == 12
    assert means["case"].values.tolist() == list(range(12))
    winds = (4.0, 8.0, 12.0)
    likely = np.array([Weibull(9.0, 2.0).probability(wind, 4.0) for wind in winds])
    for clearance in (0.0, 0.5):
        own = means.isel(
            case=np.flatnonzero(means["bearing.diametral_clearance"].values == clearance)
        )
        wear = dict(zip(own.loads.values, own.wear_rate.sel(row="downwind").values, strict=True))
        at = {
            wind: brentq(
                lambda t, wind=wind, more=clearance: (
                    100.0 * (1.0 + more) * power(wind, t, 0) - 20.0 * (t - 10.0)
                ),
                5.0,
                45.0,
            )
            for wind in winds
        }
        assert at[4.0] < at[8.0] < at[12.0]
        for name, wind, number in (("4", 4.0, 0), ("8b", 8.0, 2), ("12", 12.0, 3)):
            expected = (1.0 + clearance) * wear_rate(wind, at[wind], number)
            assert wear[name] == pytest.approx(expected, rel=1e-6)
        mean = likely @ list(at.values()) / likely.sum()
        idle = (1.0 + clearance) * wear_rate(6.0, mean, 5)
        assert wear["idle"] == pytest.approx(idle, rel=1e-6)


def test_a_balance_outside_the_runs_or_beside_temperatures_is_an_error():
    hot = with_friction(made_up_study(weights=BALANCED), 1e4)
    with pytest.raises(InputError, match="the bin at 4 lies above the temperatures of the runs, 5"):
        weighted_study(hot)
    failed = with_friction(made_up_study(weights=BALANCED), np.nan)
    with pytest.raises(InputError, match="a run of the bin at 4 has no friction power"):
        weighted_study(failed)
    both = BALANCED["temperature"] | {"by_wind": {4: "20 degC"}}
    for given, said in ((both, "are given twice"), ({}, "is not given")):
        with pytest.raises(InputError, match=said):
            form_from(Weighting).read(BALANCED | {"temperature": given}, IN_FILE)


def test_series_interpolate_logarithms_where_they_can():
    temperatures = np.array([5.0, 20.0, 35.0, 50.0])
    rates = np.exp(0.1 * temperatures)
    at = np.array([27.5])
    assert interpolated(temperatures, rates, at, by_factors=True) == pytest.approx(np.exp(2.75))
    linear = interpolated(temperatures, rates, at, by_factors=False)
    assert linear == pytest.approx(0.5 * (rates[1] + rates[2]))
    with_zero = np.array([0.0, 1.0, 2.0, 4.0])
    assert interpolated(temperatures, with_zero, at, by_factors=True) == pytest.approx(1.5)
    assert np.isnan(interpolated(temperatures, rates * np.nan, at, by_factors=True)).all()


def test_extremes_and_lives_are_no_means():
    study = made_up_study().assign(
        basic_life=("case", np.tile([1e5, 2e5, 4e5, 8e5, 16e5], 6)),
        lowest_spin_ratio=(("case", "row"), np.tile([[0.5], [0.4], [0.3], [0.2], [0.1]], (6, 2))),
    )
    half = np.array([0.5, 0.5])
    shares = TemperatureShares(
        np.array([15.0, 35.0]) + ZERO_CELSIUS,
        {4.0: half, 8.0: half, 12.0: half},
        half,
        half,
        half,
        True,
    )
    means = RunsOverTemperature.of(study).mean(shares, "wind_speed", 4.0)
    assert means.basic_life.values == pytest.approx(2.0 / (1.0 / 2e5 + 1.0 / 8e5), rel=1e-9)
    assert means.lowest_spin_ratio.values == pytest.approx(0.2)
    assert means.peak_power_max.values[0, 0] == pytest.approx(3.0 * power(4.0, 15.0, 0))


def test_exceedance_of_mixed_temperatures_is_refused_with_its_reason():
    wind, celsius = months()
    joint = JointShares.of(turbine(wind, celsius), np.array([4.0, 8.0, 12.0]), 4.0)
    weights = {"width": 4.0, "scada": joint.content(), "events": EVENTS}
    study = weighted_study(made_up_study(weights=weights))
    stored = stored_weighting(made_up_study(weights=weights))
    with pytest.raises(InputError, match="combine several oil temperatures"):
        exceedance(study, Aggregation(stored.year, 1.0, stored.field, stored.width))


def test_two_designs_are_compared_on_a_measured_year():
    wind, celsius = months()
    joint = JointShares.of(turbine(wind, celsius), np.array([4.0, 8.0, 12.0]), 4.0)
    weights = {"width": 4.0, "scada": joint.content(), "events": EVENTS}
    study = made_up_study(weights=weights, clearances=(0.0, 0.5))
    comparison = compare_designs(study)
    wear = comparison[comparison["quantity"].str.startswith("wear")]
    assert wear["difference [%]"].iloc[1] == pytest.approx(50.0, rel=1e-9)
    expected = real_year(turbine(wind, celsius), study).table
    real = expected[expected["quantity"] == "wear"]["real"].to_numpy()
    assert wear["value"].to_numpy() == pytest.approx(real, rel=1e-9)
