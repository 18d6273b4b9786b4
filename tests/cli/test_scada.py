"""`macroslip scada`: from an export to a year."""

import json

import numpy as np
import pandas as pd
import pytest

from tests.scada.conftest import record

pytestmark = pytest.mark.slow


def test_init_then_inspect(folder, macroslip):
    table = record(rows=3000)
    names = {"wind": "Ws_avg", "rotor": "Rs_avg", "power": "P_avg", "bearing": "Rbt_avg"}
    table.rename(columns={**names, "time": "Date_time"}).to_csv("export.csv", index=False)
    done = macroslip("scada", "init", "export.csv")
    assert (done.code, done.err) == (0, "")
    assert "temperature of the main bearing: Rbt_avg" in done.out
    done = macroslip("scada", "inspect", "scada.yaml")
    assert (done.code, done.err) == (0, "")
    assert "3000 rows of 'NAME' from 2024-03-25 to 2024-04-14" in done.out
    done = macroslip("scada", "inspect", "scada.yaml", "--json")
    printed = json.loads(done.out)
    assert sum(line["share"] for line in printed["histogram"]) == pytest.approx(1.0)
    kept = [line["rows"] for line in printed["counts"] if line["filter"] == "kept"]
    assert sum(kept) == 3000


def test_the_year_of_a_study(folder, macroslip):
    seconds = np.arange(41) * 0.05
    for wind in (4, 8, 12):
        loads = pd.DataFrame(
            {"time_s": seconds, "shaft_speed_rad_s": 0.15 * wind, "F_X0_kN": 0.0, "F_Y0_kN": -200.0,
             "F_Z0_kN": 10.0 * wind}
        )  # fmt: skip
        loads.to_csv(f"{wind}mps.csv", index=False)
    table = record(rows=5000)
    table["bearing"] = table["bearing"].clip(10.0, 45.0)
    table.to_csv("export.csv", index=False)
    text = (
        "files: [export.csv]\n"
        "time: {column: time}\n"
        "columns:\n"
        "  wind_speed: {column: wind, unit: m/s}\n"
        "  rotor_speed: {column: rotor, unit: r/min}\n"
        "  power: {column: power, unit: kW}\n"
        "  bearing_temperature: {column: bearing, unit: degC}\n"
        "rated: {rotor_speed: 17 r/min, power: 1500 kW}\n"
    )
    (folder / "scada.yaml").write_text(text)
    study = (
        "case: {rollers: [0], laws: {model: paper}}\n"
        "loads: {files: '{wind_speed:g}mps.csv', kind: main-bearing}\n"
        "variations: {grid: {lubricant.at: {values: [5, 20, 35, 50], unit: degC}}}\n"
        "weights: {width: 4, scada: scada.yaml}\n"
    )
    (folder / "study.yaml").write_text(study)
    done = macroslip("study", "study.yaml", "-o", "study", "--quiet")
    assert (done.code, done.err) == (0, "")
    done = macroslip("scada", "year", "scada.yaml", "--study", "study", "-o", "year")
    assert (done.code, done.err) == (0, "")
    assert "Energy is" in done.out
    of_year = pd.read_csv("year/year.csv").set_index("quantity")
    page = (folder / "year" / "page.html").read_text()
    assert "A real year" in page and "nan" not in page.split("</style>")[1][:3000]
    done = macroslip("aggregate", "study", "-o", "tables", "--quiet")
    assert (done.code, done.err) == (0, "")
    designs = pd.read_csv("tables/designs.csv")
    expected = of_year.loc["energy", "real"]
    assert designs["energy [J/year]"].iloc[0] == pytest.approx(expected, rel=1e-9)
    done = macroslip("scada", "year", "scada.yaml", "--study", "study", "-o", "year")
    assert done.code == 2 and "the file exists" in done.err
