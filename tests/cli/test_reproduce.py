"""`macroslip reproduce`: what it passes on and prints. What it computes is tested with the study."""

import pytest


@pytest.fixture
def study(monkeypatch):
    """Stand in for the study, which takes too long here."""
    calls = []
    summary = {
        "headline": [f"line {n}" for n in range(14)],
        "failed_rollers": {"study": 0, "single_rollers": 0, "detailed_case": 0, "sensitivity": 0, "experiments": 0},
        "reused": [],
    }

    def reproduce(directory, *, threads=None, progress=None):
        calls.append((directory.name, threads, progress))
        return summary

    monkeypatch.setattr("macroslip.reproduction.reproduce.reproduce", reproduce)
    return calls, summary


def test_it_ends_with_at_most_ten_lines_and_the_place(study, folder, macroslip):
    calls, _ = study
    done = macroslip("reproduce", "-o", "results", "--threads", 2)
    assert (done.code, done.err) == (0, "")
    written = "written: results; the report: results/report.html"
    assert done.out.splitlines() == [*(f"line {n}" for n in range(10)), written]
    assert calls == [("results", 2, None)]


def test_it_says_what_it_used_again(study, folder, macroslip):
    study[1]["reused"] = ["study-paper", "turns"]
    done = macroslip("reproduce", "-o", "results")
    assert "used again from the last run, whose inputs are the same: study-paper, turns" in done.out


def test_quiet_says_nothing(study, folder, macroslip):
    done = macroslip("reproduce", "-o", "results", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")


def test_failed_rollers_give_exit_code_3(study, folder, macroslip):
    study[1]["failed_rollers"]["study"] = 2
    done = macroslip("reproduce", "-o", "results")
    assert done.code == 3
    assert done.err == "failed: some rollers did not reach the end; results/summary.json says how many in which case.\n"
