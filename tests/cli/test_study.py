"""`macroslip study` and `macroslip aggregate` end to end: files, messages, exit codes."""

import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest

from macroslip import open_study

pytestmark = pytest.mark.slow

DATA = Path(__file__).parents[1] / "data"
STUDY = """
title: two seeds
case: {laws: {model: paper}, rollers: [0], loads: {end: 62 s}}
loads: {files: "runs/{wind_speed:g}mps_seed{seed:d}.outb"}
"""


@pytest.fixture
def study(folder):
    """`study.yaml` with two genuine OpenFAST files, one after the other whole."""
    (folder / "runs").mkdir()
    for seed in (1, 2):
        (folder / "runs" / f"14mps_seed{seed}.outb").write_bytes(
            (DATA / "sample14B.outb").read_bytes()
        )
    (folder / "study.yaml").write_text(STUDY, encoding="utf-8")
    return folder


def test_from_a_study_file_to_tables(study, macroslip):
    done = macroslip("study", "study.yaml", "-o", "out", "--threads", "1")
    assert (done.code, done.err) == (0, "")
    # Both seeds are copies of one file: one input, one result, which the second run finds.
    assert re.fullmatch(
        r"2 runs: 1 computed, 1 unchanged, 0 failed, in .*\nwritten: out\n", done.out
    )
    assert len(list((study / "out").glob("cases/*/*.nc"))) == 1
    assert (open_study(study / "out").outcome == "completed").all()
    done = macroslip("aggregate", "out", "-o", "tables", "--weibull", "9", "2", "--years", "25")
    assert (done.code, done.err) == (0, "")
    assert (
        "energy of a roller in 25 years" in done.out and "written: tables/lifetime.csv" in done.out
    )
    (study / "p.csv").write_text("bin,probability\n14,0.2\n")
    assert (
        macroslip(
            "aggregate", "out", "-o", "tables", "--probabilities", "p.csv", "--format", "parquet"
        ).code
        == 0
    )
    (study / "p.csv").rename(study / "bins.csv")
    done = macroslip("aggregate", "out", "-o", ".", "--probabilities", "bins.csv")
    assert done.code == 2 and "bins.csv: this is a file that the output is made from" in done.err
    assert not (study / "cases.csv").exists()
    assert pq.read_table("tables/bins.parquet")["probability"].to_pylist() == [0.2, 0.2]


def test_of_many_combinations_the_highest_are_shown(folder, macroslip):
    (folder / "study.yaml").write_text(
        "loads: {bundled: [14B]}\ncase: {rollers: [0], loads: {end: 62 s}, laws: {model: paper}}\n"
        "variations: {sample: {count: 15, seed: 1, "
        "ranges: {bearing.diametral_clearance: {low: 0, high: 0.4, unit: mm}}}}\n"
    )
    assert macroslip("study", "study.yaml", "-o", "out").code == 0
    done = macroslip("aggregate", "out", "-o", "tables", "--weibull", "9", "2")
    title, _, *lines, coverage = done.out.split("written:")[0].rstrip().splitlines()
    assert coverage.startswith("The cases cover ") and coverage.endswith(" h of wind speeds.")
    assert (
        title.endswith("; the 20 highest of 30, all of them are in the table lifetime")
        and len(lines) == 20
    )
    energies = pd.read_csv("tables/lifetime.csv")["lifetime_energy [J]"]
    assert len(energies) == 30
    shown = [float(line.split()[-2]) for line in lines]
    np.testing.assert_allclose(shown, sorted(energies, reverse=True)[:20], rtol=1e-3)


def test_dry_run_counts_and_estimates_and_writes_nothing(study, macroslip):
    done = macroslip("study", "study.yaml", "--dry-run", "-o", "out")
    assert done.code == 0 and not (study / "out").exists()
    assert re.search(r"^runs +2 *$", done.out, re.MULTILINE)
    assert (
        re.search(r"^disk +[\d.]+ kB", done.out, re.MULTILINE)
        and "time on one processor" in done.out
    )


def test_the_estimate_of_the_disk_is_right(folder, macroslip):
    (folder / "study.yaml").write_text(
        "loads: {bundled: [14A, 14B, 14C]}\ncase: {laws: {model: paper}, rollers: [0, 5], loads: {end: 300 s}}\n"
    )
    done = macroslip("study", "study.yaml", "--dry-run")
    estimated = float(re.search(r"^disk +([\d.]+) kB", done.out, re.MULTILINE)[1])
    macroslip("study", "study.yaml", "-o", "out")
    actual = (
        sum(path.stat().st_size for path in (folder / "out").rglob("*") if path.is_file()) / 1000.0
    )
    assert estimated == pytest.approx(actual, rel=0.3)


def test_failures_are_a_table_and_exit_code_3(study, macroslip):
    whole = (study / "runs" / "14mps_seed1.outb").read_bytes()
    (study / "runs" / "14mps_seed1.outb").write_bytes(whole[: len(whole) // 2])
    done = macroslip("study", "study.yaml", "-o", "out")
    assert done.code == 3 and "2 runs: 1 computed, 0 unchanged, 1 failed" in done.out
    assert "runs/14mps_seed1.outb" in done.err and "failed: 1 of 2 runs (failed: 1)" in done.err
    # One run after the other: of two at once, both may be done before the first is looked at.
    done = macroslip("study", "study.yaml", "-o", "out", "--resume", "--strict", "--threads", "1")
    assert done.code == 3 and "1 left" in done.out and "as --strict says" in done.err
    (study / "runs" / "14mps_seed1.outb").write_bytes(whole)
    done = macroslip("study", "study.yaml", "-o", "out", "--resume", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")


def test_names_cannot_steer_the_terminal(study, macroslip):
    (study / "runs" / "14mps_seed1.outb").rename(study / "runs" / "\x1b[31m[b]14mps_seed1.outb")
    (study / "runs" / "\x1b[31m[b]14mps_seed1.outb").write_text("")
    (study / "study.yaml").write_text(
        'loads: {files: "runs/*.outb"}\ncase: {rollers: [0], loads: {end: 62 s}}\n'
    )
    done = macroslip("study", "study.yaml", "-o", "out")
    assert done.code == 3 and "\x1b" not in done.out + done.err and "\\x1b[31m[b]14mps" in done.err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["study", "none.yaml", "-o", "out"], "the study file cannot be read"),
        (["study", "study.yaml"], "there is no folder for the results"),
        (["study", "study.yaml", "-o", "runs"], "the folder holds other things"),
        (
            ["study", "study.yaml", "-o", "out", "--workers", "1", "--scheduler", "x"],
            "given together",
        ),
        (["aggregate", "runs", "-o", "tables"], "there is no study in this folder"),
    ],
)
def test_wrong_use_is_one_paragraph_and_exit_code_2(study, macroslip, arguments, message):
    done = macroslip(*arguments)
    assert done.code == 2 and message in " ".join(done.err.replace("│", " ").split())
    assert "Traceback" not in done.err


@pytest.mark.parametrize("workers", [[], ["--workers", "1"]])
def test_interrupted_and_resumed_as_a_user_does(folder, workers):
    """Ctrl-C in a terminal goes to all processes of the command, its workers included."""
    (folder / "study.yaml").write_text(
        "loads: {bundled: [14B]}\ncase: {laws: {model: paper}, rollers: [0, 7], loads: {end: 300 s}}\n"
        "variations: {sample: {count: 10, seed: 1, ranges: {drivetrain.tilt: {low: 3, high: 7, unit: deg}}}}\n"
    )
    # Where the tests run in the background, interrupts are ignored unless that is undone.
    main = "from signal import *; signal(SIGINT, default_int_handler); from macroslip.cli import main; main()"
    command = [sys.executable, "-c", main, "study", "study.yaml", "-o", "out"]
    process = subprocess.Popen(
        [*command, *workers], stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    log = folder / "out" / "log.txt"
    end = time.monotonic() + 120
    while not log.exists() or ": completed" not in log.read_text():
        assert time.monotonic() < end
        time.sleep(0.01)
    os.killpg(process.pid, signal.SIGINT)
    # Before it a line of each stage that takes a second.
    *stages, last = process.communicate()[1].splitlines()
    assert (
        last
        == "interrupted; what is computed is kept in out. Go on with the same command and --resume."
    )
    assert all(re.search(r" of \d+ done", line) for line in stages), stages
    assert process.returncode == 130
    done = subprocess.run([*command, "--resume"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    computed, unchanged = map(
        int, re.search(r"(\d+) computed, (\d+) unchanged, 0 failed", done.stdout).groups()
    )
    assert computed + unchanged == 10 and unchanged >= 1


def test_a_study_of_a_folder(study, macroslip):
    done = macroslip("study", "new.yaml", "--from-folder", "runs")
    assert (done.code, done.err) == (0, "")
    assert done.out == "2 load files, 14 m/s\nwritten: new.yaml and new-loads.csv\n"
    done = macroslip("study", "new.yaml", "--dry-run")
    assert done.code == 0 and re.search(r"^runs +2 *$", done.out, re.MULTILINE)
    done = macroslip("study", "new.yaml", "--from-folder", "runs")
    assert done.code == 2 and "new.yaml: the file exists" in done.err
    (study / "new.yaml").unlink()
    done = macroslip("study", "new.yaml", "--from-folder", "runs")
    assert done.code == 2 and "new-loads.csv: the file exists" in done.err
    assert macroslip("study", "new.yaml", "--from-folder", "runs", "--force").code == 0
