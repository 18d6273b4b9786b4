"""A table of friction from a study, and the heat of a record by it."""

import json
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from typer.testing import CliRunner

from macroslip import BearingLoads, HubLoads, InputError, main_bearing_load, open_study, run_study
from macroslip.cli.commands import app
from macroslip.loads import Drivetrain
from macroslip.scada.synthetic import (
    SyntheticYear,
    base_turbine_friction,
    synthetic_year,
    write_record,
)
from macroslip.study.friction import friction_table
from macroslip.study.heat import heat_fit
from macroslip.study.study_file import study_of
from tests.quick import COARSE
from tools.friction_tables import friction_study

pytestmark = pytest.mark.slow

OIL = {"lubricant.at": {"values": [8, 28, 48], "unit": "degC"}}
END = 60.0
DESCRIPTION = """\
turbine: T1
files: [record.csv]
time: {column: time, zone: UTC}
columns:
  wind_speed: {column: wind_mps, unit: m/s}
  rotor_speed: {column: rotor_rpm, unit: r/min}
  power: {column: power_kW, unit: kW}
  bearing_temperature: {column: bearing_degC, unit: degC}
  nacelle_temperature: {column: nacelle_degC, unit: degC}
  ambient_temperature: {column: ambient_degC, unit: degC}
rated: {rotor_speed: 17.1 r/min, power: 1500 kW}
capacity: {mass: 6 t, range: [4 t, 8 t]}
"""


def content(**changed):
    """A study of a weak and a strong wind."""
    plain = {
        "case": {
            "rollers": [0],
            "laws": {"model": "physical"},
            "integrator": {"tolerance": COARSE.tolerance},
            "loads": {"end": f"{END:g} s"},
        },
        "loads": {"bundled": ["4B", "12B"]},
        "keep": ["energy"],
        "variations": {"grid": OIL},
    }
    return plain | changed


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    folder = tmp_path_factory.mktemp("study") / "out"
    run_study(study_of(content()), folder, threads=1)
    return folder


def test_the_torque_is_friction_power_over_speed(study):
    runs = open_study(study)
    table = friction_table(study)
    assert table.supplies == ("skf",)
    assert table.temperatures.tolist() == [281.15, 301.15, 321.15]
    torque = table.torque(
        "skf", runs.wind_speed.values, runs.shaft_speed_mean.values,
        runs["lubricant.at"].values + 273.15,
    )  # fmt: skip
    expected = runs.friction_power.values / runs.shaft_speed_mean.values
    assert torque == pytest.approx(expected, rel=1e-9)


def test_loads_of_each_wind_are_those_of_the_histories(study):
    loads = friction_table(study).loads.set_index("wind_speed")
    assert loads.index.tolist() == [4.0, 12.0]
    history = main_bearing_load(HubLoads.bundled("12B").window(0.0, END), Drivetrain())
    radial = np.hypot(history.force[:, 0], history.force[:, 1]).mean()
    assert loads.loc[12.0, "radial_load"] == pytest.approx(radial)
    assert loads.loc[12.0, "axial_load"] == pytest.approx(np.abs(history.force[:, 2]).mean())


def test_the_command_writes_tables_and_a_page(study, tmp_path):
    record = synthetic_year(SyntheticYear(days=200), base_turbine_friction())
    write_record(record, tmp_path / "record.csv")
    path = tmp_path / "scada.yaml"
    path.write_text(DESCRIPTION)
    words = ["scada", "heat", str(path), "--study", str(study), "-o", str(tmp_path / "out")]
    done = CliRunner().invoke(app, words)
    assert done.exit_code == 0, done.output
    assert done.stdout.startswith("An index of heat is no alarm")
    assert "nothing in the record shows it" in done.stdout
    assert "one turbine could not tell them apart" in done.stdout
    fit = pd.read_csv(tmp_path / "out" / "fit.csv")
    assert {"SKF torque", "Palmgren torque", "speed", "speed^1.6"} < set(fit["model"])
    index = pd.read_csv(tmp_path / "out" / "index.csv")
    assert set(index["period"]) == {"day", "week", "month"}
    page = (tmp_path / "out" / "page.html").read_text()
    assert "Heat of the main bearing of T1" in page
    assert "no alarm" in page
    opening = page.split("<body")[1]
    assert opening.index("cannot be read off one turbine") < opening.index("Heat capacity")
    assert "http" not in page.split("<body")[1].replace("http://www.w3.org", "")
    told = CliRunner().invoke(app, [*words, "--json"])
    assert json.loads(told.stdout)["fit"]
    # From Python the same numbers.
    again = heat_fit(path, study).fit
    assert again["value"].to_numpy() == pytest.approx(fit["value"].to_numpy(), rel=1e-12)


def small_study(tmp_path, **changed):
    """A study of laws that are quick, of loads that a test chooses."""
    made = content(case={"rollers": [0], "laws": {"model": "paper"}, "loads": {"end": "60 s"}})
    made |= changed
    folder = tmp_path / "study"
    run_study(study_of(made, tmp_path), folder, threads=1)
    return folder


def test_laws_without_rolling_resistance_are_refused(tmp_path):
    folder = small_study(tmp_path, loads={"bundled": ["4B"]})
    with pytest.raises(InputError, match="no rolling resistance"):
        friction_table(folder)


def test_a_study_without_temperatures_is_refused(tmp_path):
    folder = small_study(tmp_path, loads={"bundled": ["4B"]}, variations={})
    with pytest.raises(InputError, match=r"no label lubricant\.at"):
        friction_table(folder)


def test_a_study_of_several_designs_is_refused(tmp_path):
    grid = OIL | {"bearing.diametral_clearance": {"values": [0, 0.2], "unit": "mm"}}
    folder = small_study(tmp_path, loads={"bundled": ["4B"]}, variations={"grid": grid})
    with pytest.raises(InputError, match=r"varies bearing\.diametral_clearance"):
        friction_table(folder)


@pytest.mark.parametrize(
    ("seconds", "swing", "told"),
    [(61.0, 0.0, "the loads of 8mps.csv do not vary"), (10.0, 0.3, "last 10 s")],
)
def test_steady_and_short_loads_are_refused(seconds, swing, told, tmp_path):
    steady = BearingLoads.constant([0.0, -300e3, 100e3], 2.0, seconds)
    force = steady.force * (1.0 + swing * np.sin(steady.time))[:, None]
    loads = replace(steady, force=force)
    table = pd.DataFrame({"time_s": loads.time, "shaft_speed_rad_s": loads.shaft_speed})
    table[["F_X0_N", "F_Y0_N", "F_Z0_N"]] = loads.force
    table.to_csv(tmp_path / "8mps.csv", index=False)
    files = {"files": "{wind_speed:g}mps.csv", "kind": "main-bearing"}
    case = {"rollers": [0], "laws": {"model": "paper"}}
    with pytest.raises(InputError, match=told):
        friction_table(small_study(tmp_path, loads=files, case=case))


def test_the_table_of_the_base_turbine_is_what_its_command_computes(tmp_path):
    folder = tmp_path / "friction"
    study = friction_study(["4B"], ["skf"])
    run_study(study, folder, threads=1)
    runs = open_study(folder)
    torque = runs.friction_power.values / runs.shaft_speed_mean.values
    stored = base_turbine_friction().torque(
        "skf", 4.0, runs.shaft_speed_mean.values, runs["lubricant.at"].values + 273.15
    )
    # Torques are stored to 0.01 N m; the rest is what an integrator may change.
    assert torque == pytest.approx(stored, rel=0.01)
