"""Small studies: one roller a row, constant or varying loads of a few seconds in tables of their own."""

import json
import sqlite3
import subprocess
import sys
import time
from contextlib import closing
from pathlib import Path

import numpy as np
import pytest

from macroslip.storage.files import DATABASE
from macroslip.study.result_files import case_path, checksum
from macroslip.study.run import run_study

#: Runs a study from a file of its arguments, and writes a line for every run that is reported done.
SCRIPT = """
import json, sys
from macroslip import run_study
from macroslip.study.study_file import study_of

if __name__ == "__main__":
    content, folder, directory, options = json.loads(sys.argv[1])
    report = lambda progress: print(progress.done, progress.failed, flush=True)
    run_study(study_of(content, folder), directory, progress=report, **options)
"""


def _write_loads(path, seconds=1.0, force=-300.0, step=0.05):
    """A table of main-bearing loads that turn a little about the downward direction."""
    time_s = np.arange(round(seconds / step) + 1) * step
    lines = [
        f"{t:.6g},2.1,{20.0 * np.sin(t):.6g},{force + 10.0 * np.cos(3.0 * t):.6g},80"
        for t in time_s
    ]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("time_s,shaft_speed_rad_s,F_X0_kN,F_Y0_kN,F_Z0_kN\n" + "\n".join(lines) + "\n")


@pytest.fixture
def load_files(tmp_path):
    """Two wind speeds with two seeds each."""
    for speed in (12, 14):
        for seed in (1, 2):
            _write_loads(
                tmp_path / "runs" / f"{speed}mps_seed{seed}.csv", force=-200.0 - 5.0 * speed - seed
            )
    return tmp_path


@pytest.fixture
def content():
    """A study of those files as plain data: four runs."""
    return {
        "case": {"laws": {"model": "paper"}, "rollers": [0]},
        "loads": {"files": "runs/{wind_speed:g}mps_seed{seed:d}.csv", "kind": "main-bearing"},
    }


@pytest.fixture
def long_content():
    """A study of forty runs that take some ten milliseconds each."""
    values = [round(4.0 + 0.1 * number, 1) for number in range(40)]
    return {
        "case": {"laws": {"model": "paper"}, "rollers": [0, 7], "loads": {"end": "40 s"}},
        "loads": {"bundled": ["14B"]},
        "variations": {"grid": {"drivetrain.tilt": {"values": values, "unit": "deg"}}},
    }


@pytest.fixture
def begin(tmp_path):
    """Start a study in a process of its own."""
    started = []

    def start(content, directory, folder=tmp_path, **options):
        given = json.dumps([content, str(folder), str(directory), options])
        process = subprocess.Popen(
            [sys.executable, "-c", SCRIPT, given],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        started.append(process)
        return process

    yield start
    for process in started:
        process.kill()
        process.communicate()


@pytest.fixture
def counted(monkeypatch):
    """Counts the simulations of this process."""
    from macroslip.result import simulate as module

    calls, original = [], module.simulate

    def simulate(case, **options):
        calls.append(case)
        return original(case, **options)

    monkeypatch.setattr(module, "simulate", simulate)
    return calls


def _rows(directory, query):
    """Rows of the database of a folder, as anybody may ask for them; nothing without one."""
    if not (Path(directory) / DATABASE).exists():
        return []
    with closing(sqlite3.connect(Path(directory) / DATABASE)) as database:
        return database.execute(query).fetchall()


def _done(directory):
    """Keys of the results that are recorded; each is shown to be on the disk as it was stored."""
    details = dict(_rows(directory, "SELECT key, detail FROM results"))
    for key, detail in details.items():
        assert checksum(case_path(Path(directory), key).read_bytes()) == detail
    return set(details)


def _identities(directory):
    """What changes if a result is written again: its place on the disk."""
    return {
        path.name: (path.stat().st_ino, path.stat().st_mtime_ns)
        for path in Path(directory).glob("cases/*/*.nc")
    }


def _wait_for(condition, seconds=120.0):
    """Wait until a condition holds."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "waited too long"
        time.sleep(0.01)


def _resumed(study, directory, counted_calls, **options):
    """Resume, and give how many runs were simulated."""
    before = len(counted_calls)
    ended = run_study(study, directory, resume=True, **options)
    return ended, len(counted_calls) - before


def _fixture(function):
    """A helper, to be asked for by its name without the underscore."""
    return pytest.fixture(name=function.__name__.removeprefix("_"))(lambda: function)


write_loads, rows, done, identities = map(_fixture, (_write_loads, _rows, _done, _identities))
wait_for, resumed = map(_fixture, (_wait_for, _resumed))
