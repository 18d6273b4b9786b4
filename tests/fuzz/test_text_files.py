"""Case, study, bearing and lubricant files with random damage."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip import Bearing, Lubricant
from macroslip.input.files import parse
from macroslip.study.study_file import read_study
from tests.fuzz.mutations import damaged, misshapen
from tests.fuzz.oracle import app_of, ends_well, examples

TABLE = "time_s,shaft_speed_rpm,F_X0_kN,F_Y0_kN,F_Z0_kN\n0,20,0,-300,80\n1,20,0,-310,80\n2,20,0,-300,80\n"
CASE = """
bearing: skf-240-600-bc
lubricant: vg460-pao
temperature: balance
heat: {conductance: 60 W/K, ambient: 15 degC}
loads: {bearing_file: loads.csv, start: 0 s, end: 2 s}
drivetrain: {tilt: 5 deg, hub_to_bearing: 1.24 m, bearing_to_gearbox: 1.9 m, shaft_mass: 3026 kg, shaft_mass_station: 0.9 m}
forces: {gravity: true, drag: false}
laws: {model: paper, heating: false, rheology: eyring}
integrator: {method: radau, tolerance: 2e-4, max_steps: 1000000}
window: {start: auto, end: 2 s}
rollers: [0, 7, 14]
traces: {step: 10 ms, start: 0.5 s, end: 1.5 s}
"""
CONSTANT = "loads: {main_bearing: {force: [0 N, -300 kN, 80 kN], shaft_speed: 20 rpm, duration: 2 s}}\ndynamics: whole-bearing\n"
STUDY = """
title: mine
case: {laws: {model: paper}, loads: {start: 0 s, end: 2 s}, rollers: [0, 7]}
loads: {files: "runs/{wind_speed:g}mps_seed{seed:d}.csv", kind: main-bearing, units: {wind_speed: m/s}}
bearings: [skf-240-600-bc, skf-230-600-ca]
models: {base: {}, no drag: {forces.drag: false}}
variations:
  grid: {bearing.diametral_clearance: {values: [0.1, 0.2], unit: mm}}
  list: [{drivetrain.tilt: 4 deg}, {drivetrain.tilt: 6 deg, rollers: [1]}]
  sample: {method: sobol, count: 8, seed: 1, ranges: {drivetrain.hub_to_bearing: {low: 1.0, high: 1.5, unit: m}}}
keep: [energy]
cycles: true
"""
RECORDS = {
    "bearing": Bearing.read("skf-240-600-bc").as_yaml(),
    "lubricant": Lubricant.read("vg460-pao").as_yaml(),
}


def _either(*texts):
    """Bytes changed at random, or a changed tree of values, of one of some YAML texts."""
    return st.one_of(
        *(damaged(text.encode()) for text in texts),
        *(misshapen(parse(text, "mine.yaml")[0]) for text in texts),
    )


def _all_runs(path):
    """Read a study, and what its first runs are."""
    study = read_study(path)
    for _, run in zip(range(100), study.runs(), strict=False):
        assert run.labels


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("text")
    (folder / "loads.csv").write_text(TABLE)
    (folder / "runs").mkdir()
    for name in ("12mps_seed1.csv", "14mps_seed2.csv"):
        (folder / "runs" / name).write_text(TABLE)
    return folder


@pytest.mark.slow
@examples(40)
@given(content=_either(CASE, CONSTANT))
def test_case_file(folder, content):
    (folder / "mine.yaml").write_bytes(content)
    ends_well(
        folder,
        folder / "mine.yaml",
        "loads",
        "inspect",
        folder / "loads.csv",
        "--case",
        folder / "mine.yaml",
        "--json",
    )


@pytest.mark.deep
@examples(40)
@given(content=_either(STUDY))
def test_study_file(folder, content):
    (folder / "mine.yaml").write_bytes(content)
    ends_well(folder, folder / "mine.yaml", folder / "mine.yaml", app=app_of(_all_runs))


@pytest.mark.deep
@pytest.mark.parametrize("noun", RECORDS)
@examples(15)
@given(data=st.data())
def test_catalogue_file(folder, noun, data):
    content = data.draw(_either(RECORDS[noun]))
    (folder / "mine.yaml").write_bytes(content)
    ends_well(folder, folder / "mine.yaml", noun, "show", "--yaml", folder / "mine.yaml")


def test_what_is_undamaged_is_accepted(folder):
    for text, arguments in (
        (CASE, ["loads", "inspect", folder / "loads.csv", "--case"]),
        (CONSTANT, ["loads", "inspect", folder / "loads.csv", "--case"]),
        (RECORDS["bearing"], ["bearing", "show"]),
        (RECORDS["lubricant"], ["lubricant", "show"]),
    ):
        (folder / "mine.yaml").write_text(text, encoding="utf-8")
        assert ends_well(folder, folder / "mine.yaml", *arguments, folder / "mine.yaml") == ""
    (folder / "mine.yaml").write_text(STUDY, encoding="utf-8")
    assert (
        ends_well(folder, folder / "mine.yaml", folder / "mine.yaml", app=app_of(_all_runs)) == ""
    )
