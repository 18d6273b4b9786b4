"""Reading ten-minute means: clocks, units, filters, files."""

import gzip

import numpy as np
import pandas as pd
import pytest

from macroslip import InputError
from macroslip.scada import Scada, ScadaDescription
from macroslip.scada.filters import run_lengths
from macroslip.scada.reader import QUANTITIES, rows_by_month
from tests.scada.conftest import DESCRIPTION, record

NUMBERS = list(QUANTITIES)


def rows_of(scada: Scada) -> dict[str, int]:
    return rows_by_month(scada.counts).sum().to_dict()


def assert_same(first: Scada, other: Scada) -> None:
    assert first.data.index.equals(other.data.index)
    np.testing.assert_allclose(
        first.data[NUMBERS].to_numpy(), other.data[NUMBERS].to_numpy(), rtol=1e-12
    )
    assert (first.data["filter"] == other.data["filter"]).all()


def test_values_are_in_si_and_in_utc(read):
    scada = read(record())
    row = scada.data.iloc[5]
    table = record().iloc[5]
    assert scada.data.index[5] == pd.Timestamp("2024-03-25 00:50", tz="UTC")
    assert row.bearing_temperature == pytest.approx(table.bearing + 273.15, abs=1e-9)
    assert row.rotor_speed == pytest.approx(table.rotor * np.pi / 30.0, rel=1e-12)
    assert row.power == pytest.approx(1000.0 * table.power, rel=1e-12)
    assert scada.step == 600.0


def test_rows_in_any_order_read_the_same(read):
    shuffled = record().sample(frac=1.0, random_state=1)
    assert_same(read(record()), read(shuffled))


def test_fahrenheit_reads_the_same(read):
    table = record()
    names = ["bearing", "nacelle", "ambient"]
    fahrenheit = table.assign(**{name: table[name] * 1.8 + 32.0 for name in names})
    assert_same(read(table), read(fahrenheit, unit="degF"))


def test_times_of_another_zone_read_the_same(read):
    table = record()
    berlin = table.assign(time=table["time"].dt.tz_convert("Europe/Berlin"))
    assert_same(read(table), read(berlin))


def test_local_times_need_their_zone_and_lose_the_hour_shown_twice(read):
    table = record(rows=288)
    table["time"] = pd.date_range("2024-10-26", periods=288, freq="10min", tz="UTC")
    local = table.assign(time=table["time"].dt.tz_convert("Europe/Paris").dt.tz_localize(None))
    scada = read(local, time=", zone: Europe/Paris", form="%Y-%m-%d %H:%M")
    # From 2:00 to 2:50 the clocks of 27 October show every time twice.
    assert rows_of(scada)["repeated hour"] == 12
    assert len(scada.data) == 276
    whole = read(table)
    assert scada.data.index.isin(whole.data.index).all()


def test_without_a_zone_an_hour_with_two_different_copies_is_dropped(read):
    table = record(rows=288)
    table["time"] = pd.date_range("2024-10-26", periods=288, freq="10min", tz="UTC")
    local = table.assign(time=table["time"].dt.tz_convert("Europe/Paris").dt.tz_localize(None))
    scada = read(local, form="%Y-%m-%d %H:%M")
    assert rows_of(scada)["repeated hour"] == 12
    assert any("taken for UTC" in note for note in scada.notes)


def test_a_stamp_at_the_end_is_moved_to_the_start(read):
    table = record()
    late = table.assign(time=table["time"] + pd.Timedelta(minutes=10))
    assert_same(read(table), read(late, time=", stamp: end"))


def test_the_first_of_duplicates_is_kept(read):
    table = record()
    again = table.iloc[[40]].assign(bearing=99.0)
    scada = read(pd.concat([table, again, table.iloc[[7]]]))
    assert rows_of(scada)["duplicate"] == 2
    assert_same(read(table), scada)


def test_every_hour_is_somewhere(read):
    table = record().drop(index=range(100, 160))
    table.loc[300:310, "bearing"] = np.nan
    table.loc[400:409, "ambient"] = 77.0
    scada = read(pd.concat([table, table.iloc[:5]]))
    rows = rows_of(scada)
    assert rows["absent"] == 60 and rows["missing"] == 11 and rows["range"] == 10
    assert rows["duplicate"] == 5
    in_time = sum(rows[name] for name in rows if name not in ("jump", "duplicate", "no time"))
    assert in_time == 1008
    assert scada.hours == rows["kept"] / 6.0


def test_nothing_is_interpolated(read):
    table = record().drop(index=range(100, 160))
    table.loc[300, "bearing"] = np.nan
    scada = read(table)
    assert len(scada.data) == 948
    row = scada.data.loc[record().time[300]]
    assert row[["bearing_temperature", "wind_speed"]].isna().all() and row["filter"] == "missing"


def test_a_stuck_sensor_is_dropped_where_the_rotor_turns_only(read):
    table = record()
    turning = (table.rotor > 5.1).to_numpy()
    run = np.flatnonzero(np.convolve(turning, np.ones(20), "valid") == 20)[0]
    table.loc[run : run + 16, "bearing"] = 21.5
    table.loc[run + 17, "bearing"] = 21.7
    assert rows_of(read(table))["stuck"] == 0
    table.loc[run + 17, "bearing"] = 21.5
    assert rows_of(read(table))["stuck"] == 18
    standing = record().assign(rotor=0.1, power=-3.0, bearing=21.5)
    standing.loc[900:, "rotor"] = 12.0
    standing.loc[900:, "bearing"] += np.arange(108) % 2
    assert rows_of(read(standing))["stuck"] == 0


def test_a_coarse_sensor_may_rest_for_hours(read):
    # Equal values for three hours are normal in steps of a kelvin.
    table = record().assign(rotor=12.0, power=400.0)
    table["power"] += np.arange(1008) % 2
    table["rotor"] += 0.1 * (np.arange(1008) % 2)
    hours = np.arange(1008) // 100
    assert rows_of(read(table.assign(bearing=20.0 + hours % 4)))["stuck"] == 0
    assert rows_of(read(table.assign(bearing=20.0 + 0.1 * (hours % 4))))["stuck"] == 1000
    assert rows_of(read(table.assign(bearing=20.0 + hours // 4)))["stuck"] == 1008


def test_rated_speed_and_power_may_rest(read):
    storm = record().assign(rotor=17.0, power=1500.0)
    assert rows_of(read(storm))["stuck"] == 0
    assert rows_of(read(storm.assign(power=700.0)))["stuck"] == 1008


def test_power_without_rotation_is_a_contradiction(read):
    table = record()
    table.loc[500:503, ["rotor", "power"]] = [1.0, 400.0]
    assert rows_of(read(table))["contradiction"] == 4


def test_a_jump_parts_the_record_and_drops_nothing(read):
    table = record()
    table.loc[600:, "bearing"] += 3.0
    scada = read(table)
    assert scada.data["jump"].to_numpy().nonzero()[0].tolist() == [600]
    assert (scada.data["filter"] == "").all()


def test_run_lengths_are_those_of_a_loop():
    random = np.random.default_rng(5)
    values = random.integers(0, 2, 300).astype(float)
    counted = random.random(300) > 0.1
    breaks = random.random(300) > 0.9
    for k in range(300):
        low = high = k
        while low > 0 and counted[low - 1] and values[low - 1] == values[k] and not breaks[low]:
            low -= 1
        while (
            high < 299
            and counted[high + 1]
            and values[high + 1] == values[k]
            and not breaks[high + 1]
        ):
            high += 1
        expected = high - low + 1 if counted[k] else 0
        assert run_lengths(values, counted, breaks)[k] == expected


@pytest.mark.parametrize("kind", ["csv.gz", "parquet", "xlsx", "semicolons", "windows"])
def test_every_kind_of_file_reads_the_same(read, tmp_path, kind):
    plain = read(record())
    table = record().assign(time=record()["time"].dt.strftime("%Y-%m-%dT%H:%M:%SZ"))
    name = f"other.{kind}"
    if kind == "csv.gz":
        with gzip.open(tmp_path / name, "wt") as file:
            table.to_csv(file, index=False)
    elif kind == "parquet":
        table.to_parquet(tmp_path / name)
    elif kind == "xlsx":
        table.to_excel(tmp_path / name, index=False)
    else:
        name = "other.csv"
        text = table.to_csv(index=False, sep=";", decimal=",")
        if kind == "windows":
            text = f"# Exported at 21 °C, by hand\n\n{text}"
        (tmp_path / name).write_bytes(text.encode("cp1252"))
    path = tmp_path / "other.yaml"
    path.write_text(DESCRIPTION.format(files=name, time="", unit="degC", more=""))
    assert_same(plain, Scada.read(path))


def test_files_of_several_turbines_and_wildcards(read, tmp_path):
    plain = read(record())
    table = record().assign(time=record()["time"].dt.strftime("%Y-%m-%dT%H:%M:%SZ"))
    both = pd.concat([table.assign(name=1), table.assign(name=2, bearing=50.0)])
    both.iloc[:900].to_csv(tmp_path / "part-1.csv", index=False)
    both.iloc[900:].to_csv(tmp_path / "part-2.csv", index=False)
    more = "rows: {column: name, equals: 1}"
    path = tmp_path / "other.yaml"
    path.write_text(DESCRIPTION.format(files='"part-*.csv"', time="", unit="degC", more=more))
    assert_same(plain, Scada.read(path))
    path.write_text(path.read_text().replace("equals: 1", "equals: T3"))
    with pytest.raises(InputError, match="no row of the files is one of the turbine.*1, 2"):
        Scada.read(path)


def test_states_that_are_not_sound_are_dropped(read, tmp_path):
    table = record().assign(state=np.where(np.arange(1008) < 20, 7.0, 3.0))
    read(table)
    path = tmp_path / "scada.yaml"
    status = "  status: {column: state, sound: [3]}\nrated:"
    path.write_text(path.read_text().replace("rated:", status))
    scada = Scada.read(path)
    assert rows_of(scada)["status"] == 20
    assert scada.data["filter"].iloc[19] == "status"


def test_files_without_time_need_the_assumption(tmp_path):
    table = record().drop(columns="time")
    table.to_csv(tmp_path / "record.csv", index=False)
    path = tmp_path / "scada.yaml"
    text = DESCRIPTION.format(files="record.csv", time="", unit="degC", more="")
    path.write_text(text)
    with pytest.raises(InputError, match="there is no column 'time'"):
        Scada.read(path)
    path.write_text(text.replace("{column: time}", "{}"))
    with pytest.raises(InputError, match="assume: consecutive"):
        Scada.read(path)
    path.write_text(text.replace("{column: time}", "{assume: consecutive}"))
    scada = Scada.read(path)
    assert len(scada.data) == 1008
    assert any("follow one another" in note for note in scada.notes)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"bearing": lambda table: table.bearing + 273.15}, r"median 29\d\.\d degC.*in K"),
        ({"bearing": lambda table: table.bearing * 1.8 + 60.0}, "in degF"),
        ({"bearing": lambda table: table.nacelle}, "have the same values"),
        ({"wind": lambda table: table.wind / 25.0}, "scaled to a range of 1"),
        ({"rotor": lambda table: table.rotor * 100.0}, "is it the generator"),
    ],
)
def test_columns_that_are_not_what_they_are_called_are_refused(read, change, message):
    with pytest.raises(InputError, match=message):
        read(record().assign(**change))


def test_coarse_sensors_and_empty_months_are_told(read):
    table = record(rows=4464).assign(bearing=lambda table: table.bearing.round())
    table["bearing"] += np.arange(4464) % 2
    notes = " ".join(read(table.drop(index=range(1300, 3000))).notes)
    assert "steps of 1 K" in notes and "2024-04 (" in notes


def test_all_that_is_wrong_is_told_together(tmp_path):
    path = tmp_path / "scada.yaml"
    text = DESCRIPTION.format(files="record.csv", time=", zone: Europe/Pari", unit="degC", more="")
    path.write_text(text.replace("unit: kW", "unit: hp").replace("17 r/min", "17"))
    with pytest.raises(InputError) as caught:
        ScadaDescription.read(path)
    message = str(caught.value)
    assert "3 problems" in message and "zone" in message
    assert "scada.yaml, line" in message and "does not give its unit" in message
