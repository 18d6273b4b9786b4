"""What is known of every run: from the journal line by line, and from the summary, which has to say the same."""

import numpy as np
import pytest

from macroslip import open_study, run_study
from macroslip.study import recorded as module
from macroslip.study.journal import Journal
from macroslip.study.recorded import NUMBERS, TEXTS, journal_state, of_journal, recorded
from macroslip.study.study_file import study_of
from macroslip.study.summary import CASE_VARIABLES, ROW_VARIABLES

NAMES = [f"{number:032x}" for number in range(4)]
KEYS = [f"{number:064x}" for number in range(4)]


def result(run, key, energy=1.0, sizes=2):
    values = {name: [energy, 2.0 * energy] for name in ROW_VARIABLES} | dict.fromkeys(CASE_VARIABLES, 3.0 * energy)
    layout = {"sizes": {"roller": sizes}, "variables": "0" * 16}
    return {
        "run": NAMES[run], "key": KEYS[key], "outcome": "completed", "reason": "", "detail": KEYS[key][::-1],
        "layout": layout, "values": values,
    }  # fmt: skip


def found_of(tmp_path, lines, runs=NAMES):
    log = Journal(tmp_path / "journal")
    log.append(lines)
    log.close()
    return of_journal(tmp_path / "journal", runs)


def failure(run, key=""):
    return {"run": NAMES[run], "key": key, "outcome": "failed", "reason": f"why {run}"}


def test_later_lines_take_precedence(tmp_path):
    lines = [result(0, 0), failure(1), result(1, 1, 5.0), result(2, 2), failure(2, KEYS[2]), result(0, 3, 7.0)]
    found = found_of(tmp_path, lines)
    assert list(found.texts["outcome"]) == ["completed", "completed", "failed", "missing"]
    assert list(found.texts["key"]) == [KEYS[3], KEYS[1], KEYS[2], ""]
    assert list(found.texts["reason"]) == ["", "", "why 2", ""]
    np.testing.assert_array_equal(found.numbers["energy_mean_upwind"], [14.0, 10.0, np.nan, np.nan])
    np.testing.assert_array_equal(found.numbers["friction_power"], [21.0, 15.0, np.nan, np.nan])
    assert list(found.stored) == [True, True, False, False]


def test_a_run_may_have_the_result_of_another(tmp_path):
    found = found_of(tmp_path, [result(0, 0), {"run": NAMES[3], "key": KEYS[0]}, {"run": NAMES[2], "key": KEYS[2]}])
    assert list(found.texts["outcome"]) == ["completed", "missing", "missing", "completed"]
    assert found.numbers["energy_min_downwind"][3] == 1.0


def test_layouts_are_told_apart(tmp_path):
    found = found_of(tmp_path, [result(0, 0), result(1, 1, sizes=5), result(3, 3)])
    layouts, kinds = found.layouts()
    assert [one["sizes"]["roller"] for one in layouts] == [2, 5] and list(kinds) == [0, 1, -1, 0]


def test_more_lines_than_a_block_and_none(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "_BLOCK", 2)
    found = found_of(tmp_path, [result(run, run, 1.0 + run) for run in range(4)])
    np.testing.assert_array_equal(found.numbers["orbits"], [3.0, 6.0, 9.0, 12.0])
    nothing = of_journal(tmp_path / "none", NAMES)
    assert list(nothing.texts["outcome"]) == ["missing"] * 4 and not nothing.stored.any()
    assert of_journal(tmp_path / "none", []).texts["key"].size == 0


@pytest.fixture
def study(tmp_path, load_files, content):
    """A study with a failed run, and its folder."""
    (load_files / "runs" / "12mps_seed2.csv").write_text("")
    run_study(study_of(content, load_files), tmp_path / "out")
    return tmp_path / "out"


def names(study):
    return list(open_study(study).run.values)


def same(one, other):
    for name in TEXTS:
        assert list(one.texts[name]) == list(other.texts[name])
    for name in NUMBERS:
        np.testing.assert_array_equal(one.numbers[name], other.numbers[name])


def test_the_summary_says_what_the_journal_says(study, monkeypatch):
    runs = names(study)
    expected = of_journal(study / "journal.jsonl", runs)
    assert sorted(set(expected.texts["outcome"])) == ["completed", "failed"]
    monkeypatch.setattr(module, "of_journal", None)  # not asked
    same(recorded(study, runs), expected)


@pytest.mark.parametrize(
    "change", ["journal grows", "journal changes", "journal gone", "summary gone", "summary damaged", "runs"]
)
def test_a_summary_that_is_not_of_this_journal_is_not_taken(study, change, monkeypatch):
    runs, journal, summary = names(study), study / "journal.jsonl", study / "summary.parquet"
    content = journal.read_bytes()
    if change == "journal grows":
        log = Journal(journal)
        log.append([failure(0)])
        log.close()
    elif change == "journal changes":
        journal.write_bytes(content[:-1] + b" ")
    elif change == "journal gone":
        journal.unlink()
    elif change == "summary gone":
        summary.unlink()
    elif change == "summary damaged":
        damaged = bytearray(summary.read_bytes())
        for place in range(100, len(damaged) // 2, 40):  # pages; names and metadata are behind them
            damaged[place] ^= 1
        summary.write_bytes(damaged)
    else:
        runs = runs[::-1]
    asked = []
    original = module.of_journal
    monkeypatch.setattr(module, "of_journal", lambda *given: asked.append(given) or original(*given))
    same(recorded(study, runs), original(journal, runs))
    assert len(asked) == 1


def test_the_state_of_a_journal(tmp_path):
    path = tmp_path / "journal"
    states = {journal_state(path)}
    for content in (b"", b"a" * 10_000, b"a" * 9_999 + b"b", b"a" * 10_001):
        path.write_bytes(content)
        states.add(journal_state(path))
    assert len(states) == 5
