"""`scada init`: columns of common exports, units, and a description that reads."""

import pandas as pd
import pytest

from macroslip import InputError
from macroslip.scada import Scada
from macroslip.scada.columns import recognized, unit_of
from macroslip.scada.draft import draft
from tests.scada.conftest import record

EXPORTS = {
    "La Haute Borne": (
        "Wind_turbine_name,Date_time,Ba_avg,P_avg,P_min,Ws_avg,Ws_std,Rs_avg,Rbt_avg,Yt_avg,Ot_avg",
        ("Ws_avg", "Rs_avg", "P_avg", "Rbt_avg", "Yt_avg", "Ot_avg"),
    ),
    "Senvion": (
        "# Date and time,Wind speed (m/s),Wind speed. Maximum (m/s),Power (kW),Rotor speed (RPM),"
        "Front bearing temperature (°C),Rear bearing temperature (°C),Rotor bearing temp (°C),"
        "Nacelle temperature (°C),Nacelle ambient temperature (°C),Generator RPM (RPM)",
        ("Wind speed (m/s)", "Rotor speed (RPM)", "Power (kW)", "Rotor bearing temp (°C)",
         "Nacelle temperature (°C)", "Nacelle ambient temperature (°C)"),
    ),
    "Siemens": (
        "TimeStamp,StationId,wtc_AcWindSp_mean,wtc_AcWindSp_max,wtc_MainSRpm_mean,wtc_ActPower_mean,"
        "wtc_MainBTmp_mean,wtc_NacelTmp_mean,wtc_AmbieTmp_mean",
        ("wtc_AcWindSp_mean", "wtc_MainSRpm_mean", "wtc_ActPower_mean", "wtc_MainBTmp_mean",
         "wtc_NacelTmp_mean", "wtc_AmbieTmp_mean"),
    ),
    "Vestas": (
        "Turbine_ID,Timestamp,Gen_RPM_Avg,Gen_Bear_Temp_Avg,Amb_WindSpeed_Avg,Rtr_RPM_Avg,"
        "Grd_Prod_Pwr_Avg,Nac_Temp_Avg,Amb_Temp_Avg",
        ("Amb_WindSpeed_Avg", "Rtr_RPM_Avg", "Grd_Prod_Pwr_Avg", None, "Nac_Temp_Avg",
         "Amb_Temp_Avg"),
    ),
    "Enercon": (
        "DateTime,Time,WEC: ava. windspeed,WEC: max. windspeed,WEC: ava. Rotation,WEC: ava. Power,"
        "Front bearing temp.,Rear bearing temp.,Nacelle temp.,Ambient temp.",
        ("WEC: ava. windspeed", "WEC: ava. Rotation", "WEC: ava. Power", "Front bearing temp.",
         "Nacelle temp.", "Ambient temp."),
    ),
}  # fmt: skip
QUANTITIES = ("wind_speed", "rotor_speed", "power")
QUANTITIES += ("bearing_temperature", "nacelle_temperature", "ambient_temperature")


@pytest.mark.parametrize("maker", EXPORTS)
def test_columns_of_common_exports_are_recognized(maker):
    names, expected = EXPORTS[maker]
    columns = recognized(name.removeprefix("# ") for name in names.split(","))
    assert tuple(columns.get(quantity) for quantity in QUANTITIES) == expected
    assert "time" in columns


@pytest.mark.parametrize(
    ("name", "unit"),
    [("Rotor speed (RPM)", "r/min"), ("Temp [°C]", "degC"), ("power_kW", "kW"), ("Ws_avg", "")],
)
def test_units_stand_in_names(name, unit):
    assert unit_of(name) == unit


def test_the_draft_of_an_export_reads(tmp_path):
    table = record().assign(time=record()["time"].dt.strftime("%Y-%m-%d %H:%M:%S"))
    names = {
        "time": "# Date and time",
        "wind": "Wind speed (m/s)",
        "rotor": "Rotor speed (RPM)",
        "power": "Power (kW)",
        "bearing": "Rotor bearing temp (°C)",
        "nacelle": "Nacelle temperature (°C)",
    }
    export = table.drop(columns="ambient").rename(columns=names)
    text = "# This file was exported\n#\n" + export.to_csv(index=False)
    (tmp_path / "export.csv").write_text(text)
    written, told = draft(tmp_path / "export.csv", tmp_path)
    assert "air outside: not recognized" in told
    (tmp_path / "scada.yaml").write_text(written)
    scada = Scada.read(tmp_path / "scada.yaml")
    assert scada.hours == 168.0
    assert scada.description.rated.power == pytest.approx(1.5e6, rel=1e-3)
    assert scada.data["ambient_temperature"].isna().all()


def test_units_are_guessed_from_values_and_marked(tmp_path):
    table = record().assign(time=record()["time"].dt.strftime("%d.%m.%Y %H:%M"))
    names = {"time": "Date_time", "wind": "Ws_avg", "rotor": "Rs_avg", "bearing": "Rbt_avg"}
    export = table.rename(columns=names).rename(columns={"power": "P_avg"})
    export["Rbt_avg"] += 273.15
    pd.concat([export.assign(Wind_turbine_name=name) for name in ("A", "B")]).to_csv(
        tmp_path / "export.csv", index=False, sep=";", decimal=","
    )
    written, _ = draft(tmp_path / "export.csv", tmp_path)
    assert "{column: 'Rbt_avg', unit: K}  # the unit is a guess" in written
    assert "rows: {column: 'Wind_turbine_name', equals: 'A'}" in written
    assert "format: '%d.%m.%Y %H:%M'" in written
    (tmp_path / "scada.yaml").write_text(written)
    assert len(Scada.read(tmp_path / "scada.yaml").data) == 1008


@pytest.mark.parametrize(
    "form", ["%d/%m/%Y %H:%M", "%m/%d/%Y %I:%M:%S %p", "%d.%m.%Y %H:%M:%S", "%d-%m-%Y %H:%M"]
)
def test_forms_of_times_are_recognized(form, tmp_path):
    # From 25 March on no month has the number of the day.
    table = record(rows=144)
    export = table.assign(time=table["time"].dt.strftime(form))
    export.rename(columns={"bearing": "Rbt_avg", "wind": "Ws_avg"}).to_csv(
        tmp_path / "export.csv", index=False
    )
    written, _ = draft(tmp_path / "export.csv", tmp_path)
    assert f"format: '{form}', stamp: start, step: 10 min" in written


def test_what_is_needed_and_not_recognized_is_named(tmp_path):
    table = record().assign(time=record()["time"].dt.strftime("%Y-%m-%d %H:%M"))
    export = table.rename(columns={"power": "Leistung", "bearing": "Hauptlager", "wind": "Ws_avg"})
    export.rename(columns={"rotor": "Drehzahl"}).to_csv(tmp_path / "export.csv", index=False)
    written, told = draft(tmp_path / "export.csv", tmp_path)
    assert "# Columns of the file that were not recognized: Drehzahl, Leistung, Haupt" in written
    assert "rotor_speed: {column: NAME OF THE COLUMN, unit: r/min}" in written
    assert "power: {column: NAME OF THE COLUMN, unit: kW}" in written
    assert "rated: {rotor_speed: NUMBER r/min, power: NUMBER kW}" in written
    assert sum("write its column into the file" in line for line in told) == 3


def test_a_workbook_tells_its_sheets(tmp_path):
    table = record().assign(time=record()["time"].dt.strftime("%Y-%m-%d %H:%M"))
    with pd.ExcelWriter(tmp_path / "export.xlsx") as book:
        pd.DataFrame({"about": ["a turbine"]}).to_excel(book, sheet_name="About", index=False)
        table.rename(columns={"bearing": "Rbt_avg"}).to_excel(book, sheet_name="Means", index=False)
    with pytest.raises(InputError, match="--sheet: About, Means"):
        draft(tmp_path / "export.xlsx", tmp_path)
    written, _ = draft(tmp_path / "export.xlsx", tmp_path, "Means")
    assert "sheet: 'Means'" in written


def test_an_export_without_known_names_is_refused(tmp_path):
    pd.DataFrame({"a": [1], "b": [2]}).to_csv(tmp_path / "export.csv", index=False)
    with pytest.raises(InputError, match="no column has a name that is known"):
        draft(tmp_path / "export.csv", tmp_path)
