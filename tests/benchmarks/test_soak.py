"""The soak: a minute of it, and that it sees what is wrong."""

import json
import sqlite3
from contextlib import closing

import pytest

from benchmarks.soak import Found, Sample, content, growth, looked_through, soak, table
from macroslip import run_study
from macroslip.study.study_file import study_of

SAMPLES = [
    Sample(float(t), 200_000_000 + 100_000 * t, 300_000_000, 400_000_000, 10 * t, t // 60)
    for t in range(0, 600, 10)
]


@pytest.fixture
def done(tmp_path):
    """The folder of a study of two runs, as a soak leaves it."""
    small = content(1) | {"loads": {"bundled": ["14B"]}}
    (tmp_path / "study.yaml").write_text(json.dumps(small))
    run_study(study_of(small), tmp_path / "out", threads=1)
    return tmp_path


def test_what_is_well_and_what_is_lost(done):
    assert looked_through(done, done / "out", 2, 2) == (2, [])
    with closing(sqlite3.connect(done / "out" / "study.sqlite")) as database, database:
        database.execute("UPDATE runs SET outcome = 'failed' WHERE \"case\" = 0")
        database.execute('DELETE FROM results WHERE key = (SELECT key FROM runs WHERE "case" = 1)')
    assert looked_through(done, done / "out", 3, 0) == (
        2, ["3 records were seen, 2 are left", "1 runs have lost their result", "1 runs failed"],
    )  # fmt: skip


def test_a_result_that_differs_is_seen(done):
    (result, _) = sorted((done / "out").glob("cases/*/*.nc"))
    content = result.read_bytes()
    result.write_bytes(content[:-8] + bytes(255 - byte for byte in content[-8:]))
    assert "results do not have their checksum" in looked_through(done, done / "out", 2, 0)[1][0]


def test_growth_and_table():
    assert growth(SAMPLES, "study") == 0.0 and growth(SAMPLES, "scheduler") == 30_000_000.0
    lines = list(table(Found(SAMPLES, 9, 5900, ["something"]), parts=2))
    assert len(lines) == 1 + 3 + 2 and lines[-1] == "something"


@pytest.mark.deep
@pytest.mark.timeout(400)
def test_a_minute(tmp_path):
    outcome = soak(tmp_path, 60.0, 15.0, 10)
    assert outcome.problems == [] and outcome.kills >= 3 and outcome.recorded > 50
    for process in ("scheduler", "study", "worker"):
        assert growth(outcome.samples, process) < 50e6
