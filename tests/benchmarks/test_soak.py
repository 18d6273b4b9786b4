"""The soak: a minute of it, and that it sees what is wrong."""

import json

import pytest

from benchmarks.soak import Found, Sample, content, growth, looked_through, soak, table
from macroslip import run_study
from macroslip.study.journal import decode, encode
from macroslip.study.study_file import study_of

SAMPLES = [
    Sample(float(t), 200_000_000 + 100_000 * t, 300_000_000, 400_000_000, 10 * t, t // 60) for t in range(0, 600, 10)
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
    journal = done / "out" / "journal.jsonl"
    lines = journal.read_bytes().splitlines(keepends=True)
    journal.write_bytes(lines[0] + lines[0])
    assert looked_through(done, done / "out", 3, 0) == (
        2, ["3 records were seen, 2 are left", "1 runs were computed more than once"],
    )  # fmt: skip
    failed = encode(decode(lines[1]) | {"outcome": "failed", "reason": "why"})
    journal.write_bytes(lines[0][:-5] + b"\n" + failed)
    assert looked_through(done, done / "out", 2, 0)[1] == [
        "1 lines of the journal are damaged", "2 records were seen, 1 are left",
        "1 runs failed: why",
    ]  # fmt: skip


def test_a_result_that_differs_is_seen(done):
    (result, _) = sorted((done / "out").glob("cases/*/*.nc"))
    result.write_bytes(result.read_bytes()[:-8] + b"\0" * 8)
    assert "results do not have their checksum" in looked_through(done, done / "out", 2, 0)[1][0]


def test_growth_and_table():
    assert growth(SAMPLES, "study") == 0.0 and growth(SAMPLES, "scheduler") == 30_000_000.0
    lines = list(table(Found(SAMPLES, 9, 5900, ["something"]), parts=2))
    assert len(lines) == 1 + 3 + 2 and lines[-1] == "something"


@pytest.mark.deep
@pytest.mark.timeout(400)
def test_a_minute(tmp_path):
    found = soak(tmp_path, 60.0, 15.0, 10)
    assert found.problems == [] and found.kills >= 3 and found.recorded > 50
    for process in ("scheduler", "study", "worker"):
        assert growth(found.samples, process) < 50e6
