"""Heat of a main bearing from synthetic years whose heat is known."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from macroslip import InputError
from macroslip.scada import Scada
from macroslip.scada.heat import bearing_heat
from macroslip.scada.heat_index import first_flag
from macroslip.scada.heat_models import FRICTION, RISE, SPEED
from macroslip.scada.synthetic import (
    SyntheticYear,
    base_turbine_friction,
    synthetic_year,
    write_record,
)

pytestmark = pytest.mark.slow

DESCRIPTION = """\
turbine: synthetic
files: [record.csv]
time: {{column: time, zone: {zone}}}
columns:
  wind_speed: {{column: wind_mps, unit: m/s}}
  rotor_speed: {{column: rotor_rpm, unit: r/min}}
  power: {{column: power_kW, unit: kW}}
  bearing_temperature: {{column: bearing_degC, unit: {unit}}}
  nacelle_temperature: {{column: nacelle_degC, unit: {unit}}}
  ambient_temperature: {{column: ambient_degC, unit: {unit}}}
rated: {{rotor_speed: 17.1 r/min, power: 1500 kW}}
{more}
"""
#: A rotor that turns 20.463/17.1 times as fast as its column tells.
_RATIO = {
    "rotor_speed: {column: rotor_rpm, unit: r/min}": (
        "generator_speed: {column: rotor_rpm, unit: r/min, ratio: 0.835655}"
    )
}
FIRST_HALF = "reference: [2024-01-01, 2024-07-18]"


def read(folder, record, more="", unit="degC", zone="UTC") -> Scada:
    """A record with its description, read as a user's."""
    if isinstance(record, pd.DataFrame) and "time" in record:
        record.to_csv(folder / "record.csv", index=False)
    else:
        write_record(record, folder / "record.csv")
    path = folder / "scada.yaml"
    path.write_text(DESCRIPTION.format(more=more, unit=unit, zone=zone))
    return Scada.read(path)


@pytest.fixture(scope="module")
def friction():
    return base_turbine_friction()


@pytest.fixture(scope="module")
def sound(friction):
    """A year of a sound bearing."""
    return synthetic_year(SyntheticYear(), friction)


@pytest.fixture(scope="module")
def heat_of_sound(sound, friction, tmp_path_factory):
    folder = tmp_path_factory.mktemp("sound")
    return bearing_heat(read(folder, sound, FIRST_HALF), friction)


def only(friction, supply):
    """The table with one supply."""
    entries = friction.entries[friction.entries["supply"] == supply]
    return replace(friction, entries=entries.reset_index(drop=True))


def days_of(heat, model=FRICTION):
    index = heat.index
    return index[(index["model"] == model) & (index["period"] == "day")].reset_index(drop=True)


def test_a_sound_year_gives_what_it_was_made_with(heat_of_sound):
    truth = SyntheticYear()
    fit = heat_of_sound.chosen
    assert fit.model.supply == truth.supply
    assert fit.values["capacity"] == pytest.approx(truth.capacity, rel=0.05)
    assert fit.values["seal_torque"] == pytest.approx(truth.seal_torque, abs=25.0)
    loss = fit.values["to_nacelle"] + fit.values["to_ambient"]
    assert loss == pytest.approx(truth.to_nacelle + truth.to_ambient, rel=0.03)
    assert fit.values["drift"] == pytest.approx(0.0, abs=0.05)
    # Noise of 0.2 K at both ends of two hours is all that is left, but for the steps of the sensors.
    assert fit.residual == pytest.approx(0.2 * np.sqrt(2.0) / 2.0, rel=0.07)
    assert heat_of_sound.marks == ()


def test_its_index_stays_at_one_without_a_flag(heat_of_sound):
    days = days_of(heat_of_sound)
    assert first_flag(days) is None
    months = heat_of_sound.index.query("period == 'month' and model == @FRICTION")
    assert np.abs(months["r"] - 1.0).max() < 0.04


def test_tables_are_tidy(heat_of_sound):
    fit = heat_of_sound.fit
    assert not fit.duplicated(["model", "supply", "parameter"]).any()
    assert np.isfinite(fit[["value", "error", "residual"]]).all(axis=None)
    assert set(fit["unit"]) == {"K/h", "J/K", "N m", "1/h"}
    index = heat_of_sound.index
    assert set(index["model"]) == {FRICTION, SPEED, RISE}
    assert not index.duplicated(["model", "period", "start"]).any()


@pytest.mark.parametrize("seed", [2, 3])
def test_a_step_of_35_per_cent_is_found_within_days(seed, friction, tmp_path):
    truth = SyntheticYear(seed=seed, more_friction=1.35, more_from=200)
    record = synthetic_year(truth, friction)
    heat = bearing_heat(read(tmp_path, record, FIRST_HALF), only(friction, "skf"))
    days = days_of(heat)
    day = (days["start"] - pd.Timestamp("2024-01-01")).dt.days
    weight = days["windows"]
    before = np.average(days["r"][day < 200], weights=weight[day < 200])
    after = np.average(days["r"][day > 200], weights=weight[day > 200])
    assert before == pytest.approx(1.0, abs=0.02)
    # All but the heat of the seals grows.
    turning = record[(record["rotor_speed"] > 0.6) & (record.index >= "2024-07-20")]
    seals = (truth.seal_torque * turning["rotor_speed"]).sum()
    of_friction = friction.power(
        "skf", turning["wind_speed"], turning["rotor_speed"], turning["bearing_temperature"]
    ).sum()
    assert after == pytest.approx(1.0 + 0.35 * of_friction / (of_friction + seals), abs=0.02)
    assert after == pytest.approx(1.30, abs=0.05)
    flag = first_flag(days)
    assert flag is not None
    assert 203 <= (flag - pd.Timestamp("2024-01-01")).days <= 208


@pytest.mark.deep
@pytest.mark.parametrize("seed", [4, 5, 6, 7])
def test_other_sound_years_have_no_flag(seed, friction, tmp_path):
    record = synthetic_year(SyntheticYear(seed=seed), friction)
    heat = bearing_heat(read(tmp_path, record, FIRST_HALF), only(friction, "skf"))
    assert first_flag(days_of(heat)) is None


@pytest.mark.parametrize("seal_torque", [60.0, 30.0])
def test_a_flooded_bearing_read_as_skf_has_a_negative_torque_of_seals(
    seal_torque, friction, tmp_path
):
    truth = SyntheticYear(supply="flooded", seal_torque=seal_torque, seed=8)
    heat = bearing_heat(read(tmp_path, synthetic_year(truth, friction)), friction)
    assert heat.chosen.model.supply == "flooded"
    assert heat.chosen.values["capacity"] == pytest.approx(truth.capacity, rel=0.08)
    assert heat.chosen.values["seal_torque"] == pytest.approx(seal_torque, abs=15.0)
    assert heat.marks == ()
    lines = heat.fit[(heat.fit["model"] == FRICTION) & (heat.fit["supply"] == "skf")]
    assert lines.set_index("parameter").loc["seal_torque", "value"] < 0.0
    assert lines["mark"].str.contains("torque of the seals is .* below 0").all()
    # Where skf is all there is, the page has the mark.
    alone = bearing_heat(read(tmp_path, synthetic_year(truth, friction)), only(friction, "skf"))
    assert any("below 0" in mark for mark in alone.marks)


def test_capacity_and_seals_go_with_the_level_of_friction_and_nothing_else_does(
    heat_of_sound, sound, friction, tmp_path
):
    # P/C and M_s/C stand in the balance, so that no record can tell the level.
    higher = replace(
        friction, entries=friction.entries.assign(torque=1.3 * friction.entries.torque)
    )
    heat = bearing_heat(read(tmp_path, sound, FIRST_HALF), higher)
    columns = ["model", "supply", "parameter"]
    values = heat.fit.set_index(columns)["value"] / heat_of_sound.fit.set_index(columns)["value"]
    in_proportion = values.index.get_level_values("parameter").isin(["capacity", "seal_torque"])
    assert values[in_proportion].to_numpy() == pytest.approx(1.3, rel=1e-9)
    assert values[~in_proportion].to_numpy() == pytest.approx(1.0, rel=1e-6)
    assert heat.chosen.residual == pytest.approx(heat_of_sound.chosen.residual, rel=1e-12)
    assert heat.index["r"].to_numpy() == pytest.approx(
        heat_of_sound.index["r"].to_numpy(), rel=1e-9
    )


def test_a_rotor_faster_than_its_record_makes_the_capacity_too_small(sound, friction, tmp_path):
    # Heat of a rotor of 20.463 r/min beside speeds of one of 17.1: as if speed over rated counted.
    faster = 20.463 / 17.1
    write_record(sound, tmp_path / "record.csv")
    slow = pd.read_csv(tmp_path / "record.csv")
    slow["rotor_rpm"] /= faster
    rated = {"rated: {rotor_speed: 17.1": f"rated: {{rotor_speed: {17.1 / faster:.3f}"}
    heats = {}
    for name, changed in {"as recorded": {}, "ratio given": _RATIO}.items():
        text = DESCRIPTION.format(more="", unit="degC", zone="UTC")
        for old, new in (changed or rated).items():
            text = text.replace(old, new)
        slow.to_csv(tmp_path / "record.csv", index=False)
        (tmp_path / "scada.yaml").write_text(text)
        heats[name] = bearing_heat(Scada.read(tmp_path / "scada.yaml"), friction)
    wrong = heats["as recorded"].chosen
    assert wrong.model.supply == heats["ratio given"].chosen.model.supply == "skf"
    # P = M n with M in proportion to n^e.
    exponent = np.log(3.0e6 / wrong.values["capacity"]) / np.log(faster) - 1.0
    assert 0.3 < exponent < 0.6
    assert wrong.values["seal_torque"] == pytest.approx(
        60.0 * faster * wrong.values["capacity"] / 3.0e6, abs=15.0
    )
    loss = wrong.values["to_nacelle"] + wrong.values["to_ambient"]
    assert loss == pytest.approx(0.1, rel=0.03)
    right = heats["ratio given"].chosen
    assert right.values["capacity"] == pytest.approx(3.0e6, rel=0.05)
    assert right.values["seal_torque"] == pytest.approx(60.0, abs=25.0)


def test_a_step_of_20_per_cent_takes_longer(friction, tmp_path):
    truth = SyntheticYear(seed=2, more_friction=1.2, more_from=200)
    heat = bearing_heat(
        read(tmp_path, synthetic_year(truth, friction), FIRST_HALF), only(friction, "skf")
    )
    flag = first_flag(days_of(heat))
    assert flag is not None
    assert 208 < (flag - pd.Timestamp("2024-01-01")).days <= 230


def test_a_fan_that_follows_the_wind_shifts_the_capacity(friction, tmp_path):
    record = synthetic_year(SyntheticYear(fan=0.03), friction)
    fit = bearing_heat(read(tmp_path, record), only(friction, "skf")).chosen
    assert 1.02 < fit.values["capacity"] / 3.0e6 < 1.12
    loss = fit.values["to_nacelle"] + fit.values["to_ambient"]
    assert 1.05 < loss / 0.1 < 1.3


@pytest.mark.parametrize(("wander", "step"), [(0.15, 1.0), (0.08, 1.35)])
def test_a_sibling_takes_away_what_both_share(wander, step, friction, tmp_path):
    # Weather and a slow change of friction are shared; noise, capacity and the step are not.
    truths = {
        "own": SyntheticYear(seed=9, wander=wander, noise=0.0, more_friction=step),
        "sibling": SyntheticYear(seed=9, wander=wander, noise=0.0, capacity=2.5e6),
    }
    scadas = []
    for seed, (name, truth) in enumerate(truths.items()):
        record = synthetic_year(truth, friction)
        noise = np.random.default_rng(seed).normal(0.0, 0.2, len(record))
        record["bearing_temperature"] += noise
        (tmp_path / name).mkdir()
        scadas.append(read(tmp_path / name, record, FIRST_HALF))
    heat = bearing_heat(scadas[0], only(friction, "skf"), scadas[1])
    days = days_of(heat)
    flag = first_flag(days, "cusum_sibling")
    before = days["start"] < pd.Timestamp("2024-07-19")
    months = heat.index.query("period == 'month' and model == @FRICTION")
    quiet = months["start"] < ("2024-07-01" if step > 1.0 else "2025-01-01")
    assert np.abs(months["r_sibling"][quiet] - 1.0).max() < 0.04
    assert np.abs(months["r"][quiet] - 1.0).max() > 0.035
    assert days["cusum_sibling"][before].max() < 1.0
    if step == 1.0:
        assert flag is None
    else:
        assert flag is not None
        assert 203 <= (flag - pd.Timestamp("2024-01-01")).days <= 208


def test_order_of_rows_units_and_zone_change_nothing(sound, friction, tmp_path):
    folders = [tmp_path / name for name in ("as it is", "shuffled", "changed")]
    for folder in folders:
        folder.mkdir()
    table = only(friction, "skf")
    first = bearing_heat(read(folders[0], sound), table)
    text = pd.read_csv(folders[0] / "record.csv")
    mixed = text.sample(frac=1.0, random_state=3)
    shuffled = bearing_heat(read(folders[1], mixed), table)
    other = text.copy()
    for name in ("bearing_degC", "nacelle_degC", "ambient_degC"):
        other[name] = [f"{1.8 * value + 32.0:.2f}" for value in text[name]]
    utc = pd.to_datetime(text["time"]).dt.tz_localize("UTC")
    other["time"] = utc.dt.tz_convert("Etc/GMT-5").dt.strftime("%Y-%m-%d %H:%M")
    changed = bearing_heat(read(folders[2], other, unit="degF", zone="Etc/GMT-5"), table)
    for heat in (shuffled, changed):
        assert heat.fit["value"].to_numpy() == pytest.approx(
            first.fit["value"].to_numpy(), rel=1e-9
        )
        assert heat.index["r"].to_numpy() == pytest.approx(first.index["r"].to_numpy(), rel=1e-10)


def test_an_oil_offset_shifts_the_friction(sound, friction, tmp_path):
    # Friction of oil that is 5 K warmer is 15 % less, and so is the capacity that it seems to warm.
    table = only(friction, "skf")
    warm = bearing_heat(read(tmp_path, sound, "oil_offset: 5 K"), table).chosen
    plain = bearing_heat(read(tmp_path, sound), table).chosen
    assert 0.8 < warm.values["capacity"] / plain.values["capacity"] < 0.92


def test_a_change_within_the_reference_is_marked(friction, tmp_path):
    record = synthetic_year(SyntheticYear(seed=2, more_friction=1.35, more_from=183), friction)
    heat = bearing_heat(read(tmp_path, record), only(friction, "skf"))
    assert any("second half of the reference" in mark for mark in heat.marks)


def test_steps_of_one_kelvin_are_told(friction, tmp_path):
    record = synthetic_year(SyntheticYear(resolution=1.0), friction)
    heat = bearing_heat(read(tmp_path, record), only(friction, "skf"))
    assert sum("steps of 1 K" in note for note in heat.notes) == 1
    assert heat.chosen.values["capacity"] == pytest.approx(3.0e6, rel=0.04)
    assert heat.chosen.values["seal_torque"] == pytest.approx(60.0, abs=20.0)


def test_what_cannot_support_a_fit_is_refused(sound, friction, tmp_path):
    def refused(record, more, told):
        with pytest.raises(InputError, match=told):
            bearing_heat(read(tmp_path, record, more), only(friction, "skf"))

    refused(sound, "reference: [2024-01-01, 2024-01-10]", "windows of two hours")
    refused(sound[sound["rotor_speed"] > 0.6], "", "at standstill or idling")
    warm = sound[sound["bearing_temperature"].between(293.0, 299.0)]
    refused(warm, "", "the effect of temperature cannot be fitted")
    cold = sound.copy()
    cold[[name for name in sound if "temperature" in name]] -= 12.0
    refused(cold, "", "the study at 5 to 50 degC")
