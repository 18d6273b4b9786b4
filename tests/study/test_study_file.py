"""Study files: what they make, and what they are refused for."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip import InputError, read_study
from macroslip.case.case_file import read_case
from macroslip.study.loads_list import Load
from macroslip.study.study_file import study_of


def write(folder, text):
    (folder / "study.yaml").write_text(text, encoding="utf-8")
    return folder / "study.yaml"


FULL = """
title: everything at once
case:
  rollers: [0]
  loads: {start: 0.1 s}
loads:
  files: runs/{wind_speed:g}mps_seed{seed:d}.csv
  kind: main-bearing
  units: {seed: "1"}
bearings: [skf-240-600-bc, own.yaml]
lubricants: vg460-pao
models:
  base: {}
  no drag: {forces.drag: false}
variations:
  grid:
    bearing.diametral_clearance: {values: [0.1, 0.2, 0.3], unit: mm}
  list:
    - {drivetrain.tilt: 4 deg}
    - {drivetrain.tilt: 5 deg, window.start: 0.5 s}
  sample: {method: sobol, count: 4, seed: 3, ranges: {integrator.tolerance: {low: 1e-5, high: 1e-3, scale: log}}}
"""


def test_runs_are_every_combination(load_files):
    from ruamel.yaml import YAML

    from macroslip import Bearing

    with (load_files / "own.yaml").open("w") as file:
        YAML(typ="safe").dump(Bearing.read("skf-240-600-bc").replace(name="own").as_dict(), file)
    study = read_study(write(load_files, FULL))
    runs = list(study.runs())
    assert len(study) == len(runs) == 4 * 2 * 1 * 2 * 3 * 2 * 4
    assert len({run.name for run in runs}) == len(runs)
    # Runs on the same loads follow each other.
    loads = [run.load.name for run in runs]
    assert len([1 for a, b in itertools.pairwise(loads) if a != b]) == 3
    labels = runs[-1].labels
    assert (labels["wind_speed"], labels["seed"], labels["bearing"], labels["model"]) == (
        14.0,
        2,
        "own.yaml",
        "no drag",
    )
    assert (labels["bearing.diametral_clearance"], labels["window.start"], labels["forces.drag"]) == (0.3, 0.5, False)
    assert study.labels["bearing.diametral_clearance"][0] == "mm" and study.labels["wind_speed"][0] == "m/s"
    assert study.bearings["own.yaml"].name == "own"


@given(loads=st.integers(1, 200), settings=st.integers(1, 3))
def test_any_stretch_of_the_mixed_runs_is_a_sample_of_the_whole(loads, settings):
    """Every quarter of them has a mean rank near the middle, whose error is that of even points: of order 1/N."""
    tilts = [4.0 + 0.1 * number for number in range(settings)]
    study = study_of({"loads": {"bundled": ["14B"]}, "variations": {"grid": {"drivetrain.tilt": {
        "values": tilts, "unit": "deg"}}}})  # fmt: skip
    listed = replace(study.loads, loads=[Load(str(number), {}) for number in range(loads)])
    study = replace(study, loads=listed)
    ranks = [int(run.load.name) for run in study.mixed_runs()]
    assert sorted(run.name for run in study.mixed_runs()) == sorted(run.name for run in study.runs())
    # Those with the same loads follow each other.
    assert all(len(set(ranks[start : start + settings])) == 1 for start in range(0, len(ranks), settings))
    quarter = max(loads // 4, 1)
    means = np.convolve(ranks[::settings], np.full(quarter, 1.0 / quarter), mode="valid")
    # In their own order the first quarter would be 3/8 off.
    assert max(abs(means - (loads - 1) / 2.0)) / loads <= 2.0 / quarter


def test_names_of_runs_do_not_depend_on_the_order_or_on_fields(load_files, content):
    before = {run.name for run in study_of(content, load_files).runs()}
    renamed = content | {
        "loads": {"files": ["runs/14mps_seed{s:d}.csv", "runs/12mps_seed{s:d}.csv"], "kind": "main-bearing"}
    }
    assert {run.name for run in study_of(renamed, load_files).runs()} == before


def test_a_table_gives_files_and_fields(load_files):
    (load_files / "list.csv").write_text(
        "file,wind_speed,site,night\nruns/12mps_seed1.csv,12.5,north,true\nruns/14mps_seed2.csv,14,south,false\n"
    )
    study = read_study(write(load_files, "loads: {table: list.csv, kind: main-bearing, units: {wind_speed: m/s}}\n"))
    assert [run.labels["wind_speed"] for run in study.runs()] == [12.5, 14.0]
    assert next(study.runs()).load.fields == {"wind_speed": 12.5, "site": "north", "night": True}


@pytest.mark.parametrize(
    ("text", "messages"),
    [
        ("loads: {bundled: all}\nvariation: {}\n", ["line 2", "Did you mean 'variations'"]),
        ("case: {rollers: [0]}\n", ["'loads' is missing"]),
        ("loads: {bundled: 99Z}\n", ["line 1", "no bundled case '99Z'"]),
        (
            "loads: {bundled: all, files: x.csv}\n",
            ["bundled and files stand together|files and bundled stand together"],
        ),
        ("loads: {files: 'nothing{seed:d}.csv'}\n", ["no file fits the pattern", "Relative paths start at"]),
        ("loads: {files: '{load}.csv'}\n", ["no file fits|a field is called 'load'"]),
        ("loads: {bundled: all}\ncase:\n  loads:\n    bundled: 14B\n", ["line 4", "'bundled' cannot stand here"]),
        ("loads: {bundled: all}\ncase:\n  drivetrain:\n    tilt: 50 deg\n", ["line 4", "drivetrain.tilt", "50 deg"]),
        ("loads: {bundled: all}\ncase:\n  rolers: all\n", ["line 3", "Did you mean 'rollers'"]),
        ("loads: {bundled: all}\nbearings: [skf-240-600]\n", ["bearings", "skf-240-600"]),
        ("loads: {bundled: all}\nbearings: [a, a]\n", ["different texts"]),
        (
            "loads: {bundled: all}\nmodels:\n  new: {laws.film: unheard-of}\n",
            ["line 3", "models.new.laws.film", "unheard-of"],
        ),
        ("loads: {bundled: all}\nvariations:\n  grid:\n    drivetrain.tilt: [1, 2]\n", ["line 4", "values"]),
        (
            "loads: {bundled: all}\nvariations:\n  grid:\n    drivetrain.tilt: {values: [1, 1], unit: deg}\n",
            ["stands twice"],
        ),
        ("loads: {bundled: all}\nvariations:\n  grid: {drivetrain.tilt: {values: [1], unit: deg, to: 3}}\n", ["'to'"]),
        (
            "loads: {bundled: all}\nvariations:\n  list:\n"
            "  - {drivetrain.tilt: 1 deg}\n  - {drivetrain.tilt: 0.1 rad}\n",
            ["one unit"],
        ),
        (
            "loads: {bundled: all}\nvariations:\n  grid: {drivetrain.tilt: {values: [1], unit: deg}}\n"
            "  list:\n  - {drivetrain.tilt: 1 deg}\n",
            ["drivetrain.tilt is varied in grid and|drivetrain.tilt is varied in list and", "one place"],
        ),
        (
            "loads: {bundled: all}\nvariations:\n  sample: {method: sobol, count: 5, seed: 1, ranges: "
            "{drivetrain.tilt: {low: 1, high: 2, unit: deg}}}\n",
            ["power of 2"],
        ),
        ("loads: {bundled: all}\nvariations:\n  sample: {count: 5, seed: 1}\n", ["ranges' is missing"]),
        ("loads: {bundled: all, units: {size: m}}\n", ["units names size"]),
        (
            "loads: {bundled: all}\nkeep: [energy, enrgy]\n",
            ["line 2", "keep", "'enrgy'", "a list of variables", "orbit_energy"],
        ),
        ("loads: [1]\n", ["it is \\[1\\]"]),
        ("- 1\n", ["a mapping"]),
    ],
)
def test_mistakes_are_reported_with_their_place(tmp_path, text, messages):
    with pytest.raises(InputError) as caught:
        read_study(write(tmp_path, text))
    for message in messages:
        assert caught.match(message)
    assert str(tmp_path) in str(caught.value)


def test_a_case_file_is_reported_from_a_study(tmp_path):
    with pytest.raises(InputError, match=r"the keys bearing, laws are those of a case\. .*macroslip run; .*key case"):
        read_study(write(tmp_path, "bearing: skf-240-600-bc\nloads: {bundled: 14B}\nlaws: {model: paper}\n"))
    with pytest.raises(InputError, match="this is a study file, not a case file. Run it by macroslip study"):
        read_case(write(tmp_path, "case: {rollers: [0]}\nloads: {bundled: [14B]}\n"))


def test_all_problems_are_reported_together(tmp_path):
    text = "loads: {bundled: 99Z}\ncase: {rollers: some}\nvariations: {grid: {forces.drg: {values: [true]}}}\n"
    with pytest.raises(InputError, match="3 problems"):
        read_study(write(tmp_path, text))


@pytest.mark.parametrize(
    "text", ["loads: !!python/object/apply:os.system ['touch made']\n", "loads: {files: !include x}\n"]
)
def test_a_study_file_is_data(tmp_path, monkeypatch, text):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError):
        read_study(write(tmp_path, text))
    assert not (tmp_path / "made").exists()


def test_files_whose_fields_cannot_be_read_are_reported(load_files, content):
    (load_files / "runs" / "12mps_seedX.csv").touch()
    study = study_of(content, load_files)
    assert len(study) == 4 and "1 files" in study.loads.remarks[0] and "12mps_seedX.csv" in study.loads.remarks[0]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("loads: {files: .}\n", ["line 1", "'.' is a folder", "runs/*.outb"]),
        ('loads: {files: "a\\0{seed:d}.csv"}\n', ["loads.files", "zero byte"]),
        ("loads: {files: 's{seed:d}.csv'}\n", ["the field seed of s99999999999999999999.csv", "9007199254740992"]),
        ("loads: {bundled: 14B}\nvariations:\n  sample: {count: 1e18, seed: 1, ranges: {drivetrain.tilt: {low: 1, high: "
         "2, unit: deg}}}\n", ["variations.sample.count: it is 1e+18. Allowed: a whole number, 1 to 1e7."]),
        ("loads: {bundled: 14B}\nvariations:\n  sample: {count: 4, seed: 1, ranges: {drivetrain.tilt: {low: a, hgh: 2}}}\n",
         ["2 problems", "Did you mean 'high'?", "ranges.drivetrain.tilt.low: it is 'a'. Allowed: a number without unit."]),
    ],
)  # fmt: skip
def test_hostile_values_are_refused_in_one_paragraph(tmp_path, text, words):
    (tmp_path / "s99999999999999999999.csv").touch()
    with pytest.raises(InputError) as caught:
        read_study(write(tmp_path, text))
    message = str(caught.value)
    assert "\n" not in message and [word for word in words if word not in message] == []
