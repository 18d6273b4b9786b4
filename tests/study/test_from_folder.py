"""A study file made from a folder of OpenFAST output."""

import os
from pathlib import Path

import numpy as np
import pytest

from macroslip.errors import InputError
from macroslip.loads import HubLoads
from macroslip.study.from_folder import study_of_folder
from macroslip.study.study_file import read_study

DATA = Path(__file__).parents[1] / "data"


def _output(path, wind=None, start=0.0):
    """Text output with hub loads of a rotor of 263 kN, and a wind of hypot(0.8, 0.6) its speed."""
    columns = {
        "Time (s)": start + 0.1 * np.arange(30), "RotSpeed (rpm)": 20.0, "LSShftFxa (kN)": 164.0,
        "LSShftFys (kN)": -2.0, "LSShftFzs (kN)": -263.0, "LSShftMxa (kN-m)": 726.0,
        "LSSTipMys (kN-m)": 154.0, "LSSTipMzs (kN-m)": 37.0,
    }  # fmt: skip
    if wind is not None:
        columns |= {"Wind1VelX (m/s)": 0.8 * wind, "Wind1VelY (m/s)": -0.6 * wind}
    head = [
        "",
        "Predictions",
        "",
        "",
        "",
        "",
        *("\t".join(words) for words in zip(*(map(str.split, columns)), strict=True)),
    ]
    rows = np.column_stack([np.broadcast_to(values, 30) for values in columns.values()])
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(
        "\n".join([*head, *("\t".join(f"{value:.4f}" for value in row) for row in rows)]) + "\n"
    )


def _labels(folder, study="study.yaml"):
    """Labels of the study that is made, by the name of the file, read as a study."""
    made = study_of_folder(folder, folder.parent / study)
    for path, text in made.texts.items():
        path.write_text(text, encoding="utf-8")
    study_file = read_study(folder.parent / study)
    assert [Path(study_file.path_of(load)).is_file() for load in study_file.loads.loads]
    return {
        Path(load.name).name: dict(load.fields) for load in study_file.loads.loads
    }, made.remarks


@pytest.mark.parametrize(
    ("name", "wind", "seed"),
    [
        ("11.4mps_seed03.out", 11.4, 3),
        ("DLC1.1_U14.0_Seed5.out", 14.0, 5),
        ("ws12/s2/run.out", 12.0, 2),
        ("dlc12_wind_speed=6.5_s1.out", 6.5, 1),
        ("IEA-15-240_wsp8p5_seed-11.out", 8.5, 11),
        ("u 4/10ms_s4.out", 10.0, 4),
    ],
)
def test_wind_and_seed_are_in_the_path(tmp_path, name, wind, seed):
    _output(tmp_path / "runs" / name)
    labels, remarks = _labels(tmp_path / "runs")
    assert labels == {Path(name).name: {"wind_speed": wind, "seed": seed}}
    assert remarks == []


def test_without_a_wind_in_the_name_the_files_mean_counts(tmp_path):
    _output(tmp_path / "runs" / "case_12.out", wind=7.5)
    _output(tmp_path / "runs" / "IEA15_0.out", wind=9.25)
    _output(tmp_path / "runs" / "8mps.out", wind=9.0)
    _output(tmp_path / "runs" / "12mps.out", wind=6.0)
    labels, (remark,) = _labels(tmp_path / "runs")
    winds = {name: label["wind_speed"] for name, label in labels.items()}
    assert winds == {"case_12.out": 7.5, "IEA15_0.out": 9.25, "8mps.out": 8.0, "12mps.out": 6.0}
    assert remark.startswith("12mps.out: its name says 12 m/s, and the file has a mean of 6 m/s")


def test_the_study_holds_the_loads_of_the_files(tmp_path):
    (tmp_path / "runs").mkdir()
    (tmp_path / "runs" / "14mps.outb").write_bytes((DATA / "sample14B.outb").read_bytes())
    (tmp_path / "runs" / "14mps.out").write_text("not read: the binary file of the run is there\n")
    _, remarks = _labels(tmp_path / "runs")
    study = read_study(tmp_path / "study.yaml")
    (load,) = study.loads.loads
    assert remarks == [] and load.fields == {"wind_speed": 14.0}
    assert study.case["loads"] == {"start": "60 s"}
    read = HubLoads.read(study.path_of(load), start=60.0)
    assert np.array_equal(read.force, HubLoads.read(DATA / "sample14B.outb").force)


def test_files_of_other_kinds_are_left_out_and_named(tmp_path):
    _output(tmp_path / "runs" / "8mps.out")
    (tmp_path / "runs" / "8mps.MD.out").write_text("Time\tL1\n(s)\t(N)\n0.0\t1.0\n")
    (tmp_path / "runs" / "cut.outb").write_bytes(b"\x02\x00")
    labels, remarks = _labels(tmp_path / "runs")
    assert list(labels) == ["8mps.out"]
    first, second = sorted(remarks)
    assert first.startswith("8mps.MD.out is left out: of the channels needed, RotSpeed, LSShftFxa")
    assert second.startswith("cut.outb is left out: the file is cut off")


@pytest.mark.skipif(os.name == "nt", reason="names are bytes on Unix")
def test_what_is_no_file_and_names_that_are_no_text(tmp_path):
    _output(tmp_path / "runs" / "8mps.out")
    (tmp_path / "runs" / "folder.outb").mkdir()
    os.mkfifo(tmp_path / "runs" / "pipe.outb")
    (tmp_path / "runs" / "lost.out").symlink_to(tmp_path / "absent")
    content = (tmp_path / "runs" / "8mps.out").read_bytes()
    Path(os.fsdecode(os.fsencode(tmp_path) + b"/runs/\xff9mps.out")).write_bytes(content)
    labels, (remark,) = _labels(tmp_path / "runs")
    assert list(labels) == ["8mps.out"] and "9mps.out is left out: 'utf-8' codec" in remark


def test_folders_with_names_that_mean_something_in_yaml(tmp_path):
    _output(tmp_path / 'runs: #1 "a"' / "8mps.out")
    labels, _ = _labels(tmp_path / 'runs: #1 "a"', study="it's: mine.yaml")
    assert labels == {"8mps.out": {"wind_speed": 8.0}}


@pytest.mark.parametrize(
    ("wind", "name", "words"),
    [
        (None, "case_12.out", "the wind speed of case_12.out is not known"),
        (None, "notes.txt", "no file with hub loads is in the folder"),
    ],
)
def test_folders_of_which_no_study_can_be_made(tmp_path, wind, name, words):
    _output(tmp_path / "runs" / name, wind)
    with pytest.raises(InputError, match=words):
        study_of_folder(tmp_path / "runs", tmp_path / "study.yaml")
    with pytest.raises(InputError, match="no such folder"):
        study_of_folder(tmp_path / "absent", tmp_path / "study.yaml")
