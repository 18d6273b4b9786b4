"""Faults on purpose: what was reported done is done and readable, and only the rest is computed again."""

import errno
import itertools
import os
import shutil
import sqlite3
import subprocess
from contextlib import closing

import numpy as np
import pytest

from macroslip import InputError, MacroslipError, open_study, run_study
from macroslip.storage import files
from macroslip.study.study_file import study_of

pytestmark = pytest.mark.slow


def complete(out, count):
    """All results are there, sound and finite."""
    study = open_study(out)
    assert study.sizes["case"] == count and (study.outcome == "completed").all()
    assert study.energy.notnull().all()
    assert not list(out.rglob("*.part"))


# Of two runs at once both may be entered in the journal by one flush: up to two flushes fewer.
@pytest.mark.parametrize(
    ("threads", "failing"),
    [(1, number) for number in range(1, 7)] + [(2, number) for number in range(1, 7)],
)
def test_a_disk_that_is_full_at_any_moment(
    tmp_path, load_files, content, counted, monkeypatch, threads, failing, done, identities, resumed
):
    """Every flush of a file fails once (one before, one a run, one at the end); a run then goes on."""
    study, out, numbers = study_of(content, load_files), tmp_path / "out", itertools.count(1)
    real = files.flush

    def flush(descriptor):
        if next(numbers) == failing:
            raise OSError(errno.ENOSPC, "No space left on device")
        real(descriptor)

    monkeypatch.setattr(files, "flush", flush)
    reported = []
    with pytest.raises(MacroslipError, match="No space left on device.*--resume"):
        run_study(
            study, out, threads=threads, progress=lambda progress: reported.append(progress.done)
        )
    assert not list(out.rglob("*.part"))
    keys = done(out)
    assert len(keys) >= max(reported, default=0)
    before = identities(out)
    _ended, simulated = resumed(study, out, counted)
    assert simulated == 4 - len(keys)
    after = identities(out)
    assert all(after[f"{key}.nc"] == before[f"{key}.nc"] for key in keys)
    complete(out, 4)


#: The first is the system's, the other SQLite's.
FULL = "(No space left on device|database or disk is full).*--resume"


@pytest.fixture
def small_disk(tmp_path):
    """A file system of 400 kB."""
    disk = tmp_path / "disk"
    disk.mkdir()
    command = ["mount", "-t", "tmpfs", "-o", "size=400k", "tmpfs", str(disk)]
    if (
        shutil.which("mount") is None
        or subprocess.run(command, capture_output=True).returncode != 0
    ):
        pytest.skip(
            "a file system may not be mounted here; test_a_disk_that_is_full_at_any_moment stands in for it"
        )
    yield disk
    subprocess.run(["umount", "-l", str(disk)], check=True)


def test_a_disk_that_is_really_full(small_disk, tmp_path, long_content, counted, done, resumed):
    study, out = study_of(long_content, tmp_path), small_disk / "out"
    reported = []
    with pytest.raises(MacroslipError, match=FULL):
        run_study(study, out, progress=lambda progress: reported.append(progress.done))
    keys = done(out)
    assert 0 < max(reported) <= len(keys) < 40
    with pytest.raises(MacroslipError, match=FULL):
        run_study(study, out, resume=True)
    assert done(out) >= keys
    keys = done(out)
    subprocess.run(["mount", "-o", "remount,size=20m", str(small_disk)], check=True)
    ended, simulated = resumed(study, out, counted)
    assert (simulated, ended.progress.unchanged) == (40 - len(keys), len(keys))
    complete(out, 40)


@pytest.mark.parametrize("damage", ["flip a bit", "cut", "empty", "remove", "replace"])
def test_a_damaged_result_is_found_and_computed_again(
    tmp_path, load_files, content, counted, damage, identities, resumed
):
    study, out = study_of(content, load_files), tmp_path / "out"
    run_study(study, out)
    before = identities(out)
    expected = open_study(out).energy.values
    path = sorted(out.glob("cases/*/*.nc"))[1]
    whole = path.read_bytes()
    if damage == "remove":
        path.unlink()
    else:
        flipped = bytes([whole[-40] ^ 1])
        other = sorted(out.glob("cases/*/*.nc"))[0].read_bytes()
        path.write_bytes(
            {
                "flip a bit": whole[:-40] + flipped + whole[-39:],
                "cut": whole[:-1],
                "empty": b"",
                "replace": other,
            }[damage]
        )
    with pytest.raises(InputError, match="damaged|cannot be read"):
        open_study(out).energy.load()
    ended, simulated = resumed(study, out, counted)
    assert (simulated, ended.progress.computed, ended.progress.unchanged) == (1, 1, 3)
    after = identities(out)
    assert all(after[name] == before[name] for name in before if name != path.name)
    np.testing.assert_array_equal(open_study(out).energy.values, expected)
    log = (out / "log.txt").read_text()
    assert "damaged" in log


def change(out, command):
    with closing(sqlite3.connect(out / "study.sqlite")) as database, database:
        database.execute(command)


def test_a_damaged_row_is_found_and_only_its_run_computed_again(
    tmp_path, load_files, content, counted, resumed
):
    study, out = study_of(content, load_files), tmp_path / "out"
    run_study(study, out)
    change(
        out, "UPDATE results SET energy_mean_upwind = energy_mean_upwind * 1.001 WHERE rowid = 2"
    )
    opened = open_study(out)
    assert sorted(opened.outcome.values) == ["completed"] * 3 + [
        "missing"
    ] and "damaged" in "".join(opened.reason.values)
    ended, simulated = resumed(study, out, counted)
    assert (simulated, ended.progress.unchanged) == (1, 3)
    assert "1 rows of the database are damaged" in (out / "log.txt").read_text()
    change(out, "UPDATE runs SET labels = replace(labels, '12.0', '14.0')")
    with pytest.raises(InputError, match=r"study.sqlite: the list of runs is damaged.*--resume"):
        open_study(out)
    assert resumed(study, out, counted)[1] == 0
    complete(out, 4)


@pytest.mark.parametrize("damage", ["cut", "zeros", "no database"])
def test_a_damaged_database_is_named(tmp_path, load_files, content, counted, resumed, damage):
    study, out = study_of(content, load_files), tmp_path / "out"
    run_study(study, out)
    path = out / "study.sqlite"
    whole = path.read_bytes()
    half = len(whole) // 2
    path.write_bytes(
        {
            "cut": whole[:half],
            "zeros": whole[:4096] + bytes(len(whole) - 4096),
            "no database": b"text" * 2000,
        }[damage]
    )
    for act in (lambda: open_study(out), lambda: run_study(study, out, resume=True)):
        with pytest.raises(InputError, match=r"study\.sqlite: .*damaged"):
            act()
    path.unlink()  # as the message says
    assert resumed(study, out, counted)[1] == 4
    complete(out, 4)


def test_without_its_database_a_study_is_computed_again_and_says_so(
    tmp_path, load_files, content, counted, resumed
):
    study, out = study_of(content, load_files), tmp_path / "out"
    run_study(study, out)
    (out / "study.sqlite").unlink()
    message = "the database is not there.*--resume: then all runs are computed again"
    with pytest.raises(InputError, match=message):
        open_study(out)
    assert resumed(study, out, counted)[1] == 4
    assert "the database is not there; all runs are computed again" in (out / "log.txt").read_text()
    complete(out, 4)


@pytest.mark.parametrize("act", ["remove", "replace", "move the folder"])
def test_a_database_that_goes_while_the_study_runs_stops_it(
    tmp_path, long_content, counted, resumed, act
):
    """Once a batch is recorded the file is looked at: nothing is reported done that nobody will find."""
    study, out = study_of(long_content, tmp_path), tmp_path / "out"
    reported = []

    def report(progress):
        reported.append(progress.done)
        if progress.done == 3:
            path = out / "study.sqlite"
            if act == "move the folder":
                out.rename(tmp_path / "elsewhere")
                return
            path.rename(tmp_path / "aside")
            if act == "replace":
                path.write_bytes((tmp_path / "aside").read_bytes())

    with pytest.raises(
        MacroslipError, match=r"study\.sqlite: .*(removed|replaced|stored).*--resume"
    ):
        run_study(study, out, threads=1, progress=report)
    assert max(reported) == 3 and len(counted) <= 4


@pytest.mark.parametrize("command", ["DELETE FROM runs", "DROP TABLE runs"])
def test_a_study_without_runs_is_named(tmp_path, load_files, content, counted, resumed, command):
    study, out = study_of(content, load_files), tmp_path / "out"
    run_study(study, out)
    change(out, command)
    with pytest.raises(InputError, match="(list of runs is empty|has no runs yet).*--resume"):
        open_study(out)
    assert resumed(study, out, counted)[1] == 0  # results are kept by their keys
    complete(out, 4)


def test_a_database_of_another_study_gives_it_no_results(
    tmp_path, load_files, content, counted, resumed
):
    """Results are asked for by keys that hold all of a case's input."""
    first = study_of(content, load_files)
    changed = {"case": content.get("case", {}) | {"forces": {"drag": False}}}
    other = study_of(content | changed, load_files)
    for study, name in ((first, "one"), (other, "other")):
        run_study(study, tmp_path / name)
    expected = open_study(tmp_path / "one").energy.values
    (tmp_path / "one" / "study.sqlite").write_bytes(
        (tmp_path / "other" / "study.sqlite").read_bytes()
    )
    with pytest.raises(InputError):
        open_study(tmp_path / "one").energy.load()
    assert resumed(first, tmp_path / "one", counted)[1] == 4
    np.testing.assert_array_equal(open_study(tmp_path / "one").energy.values, expected)


def test_what_only_the_power_cut_knows(tmp_path, load_files, content, counted, rows, resumed):
    """A result with half of its content and no row in the database was never reported, and is computed again."""
    study, out = study_of(content, load_files), tmp_path / "out"
    run_study(study, out)
    ((last,),) = rows(out, "SELECT key FROM results WHERE rowid = (SELECT max(rowid) FROM results)")
    change(out, f"DELETE FROM results WHERE key = '{last}'")
    result = out / "cases" / last[:2] / f"{last}.nc"
    result.write_bytes(result.read_bytes()[:1000])
    (result.parent / f".{last}.nc.0123.part").write_bytes(b"half")
    ended, simulated = resumed(study, out, counted)
    assert (simulated, ended.progress.unchanged) == (1, 3)
    complete(out, 4)


@pytest.mark.parametrize("missing", ["summary.parquet", "manifest.json", "log.txt", "lock"])
def test_what_can_be_made_again_is(tmp_path, load_files, content, counted, missing, resumed):
    study, out = study_of(content, load_files), tmp_path / "out"
    run_study(study, out)
    (out / missing).unlink()
    _, simulated = resumed(study, out, counted)
    assert simulated == 0 and (out / missing).exists()
    complete(out, 4)


def test_the_clock_does_not_matter(
    tmp_path, load_files, content, counted, monkeypatch, resumed, write_loads
):
    import time

    study, out = study_of(content, load_files), tmp_path / "out"
    run_study(study, out)
    for number, path in enumerate([*out.rglob("*"), *load_files.rglob("*.csv")]):
        os.utime(path, (0, 0) if number % 2 else (4e9, 4e9))
    monkeypatch.setattr(time, "time", lambda: -1e9)
    monkeypatch.setattr(time, "gmtime", lambda *_: time.struct_time((1970, 1, 1, 0, 0, 0, 3, 1, 0)))
    ended, simulated = resumed(study, out, counted)
    assert (simulated, ended.progress.unchanged) == (0, 4)
    # A file that has changed is noticed, though its size and its time have not.
    path = load_files / "runs" / "12mps_seed1.csv"
    stat, text = path.stat(), path.read_text()
    write_loads(path, force=-263.0)
    assert path.read_text() != text and path.stat().st_size == stat.st_size
    os.utime(path, ns=(stat.st_atime_ns, stat.st_mtime_ns))
    ended, simulated = resumed(study, out, counted)
    assert (simulated, ended.progress.unchanged) == (1, 3)


def test_interrupted_by_hand(tmp_path, load_files, content, counted, resumed):
    study, out = study_of(content, load_files), tmp_path / "out"

    def interrupt(progress):
        if progress.done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_study(study, out, progress=interrupt)
    assert "broken off after 2 of 4" in (out / "log.txt").read_text()
    assert resumed(study, out, counted)[1] == 2
    complete(out, 4)


def test_the_lock_ends_with_its_process(tmp_path, load_files, content, begin, long_content):
    process = begin(long_content, tmp_path / "out")
    process.stdout.readline()
    process.kill()
    process.wait()
    assert (
        str(process.pid) in (tmp_path / "out" / "lock").read_text()
    )  # what it left behind holds nothing
    assert (
        run_study(study_of(content, load_files), tmp_path / "out", resume=True).progress.computed
        == 4
    )
