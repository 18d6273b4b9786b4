"""The command from end to end, on stretches short enough for a test and with rivals that are always there."""

import json
import sys

import pytest
from typer.testing import CliRunner

from benchmarks import histories as room
from benchmarks import rivals, run
from benchmarks.__main__ import app


@pytest.fixture
def short(monkeypatch):
    """One case of 2 s, three settings a rival; no library that may be missing."""
    names = {"scipy_bdf", rivals.EULER, "lsoda"}
    few = [
        rival._replace(
            settings=lambda edges, quick, whole=rival.settings: list(whole(edges, quick))[:3]
        )
        for rival in rivals.RIVALS
        if rival.key in names
    ]
    few = [
        solver._replace(load=lambda: None) if solver.key == "lsoda" else solver for solver in few
    ]
    monkeypatch.setattr("benchmarks.comparison.RIVALS", tuple(few))
    monkeypatch.setattr(room, "QUICK", (("24A",), 100.0, 2.0))
    monkeypatch.setattr(
        run,
        "long_histories",
        lambda quick, **laws: room.histories_of("24A", 100.0, 102.0, [0], **laws),
    )
    monkeypatch.setattr(
        run,
        "verify",
        lambda histories, references: {
            "method": "none",
            "energy_error": {"a": 0.0},
            "spin_error": {"a": 0.0},
            "agrees": True,
        },
    )
    monkeypatch.setattr(run, "two_threads", lambda quick: None)
    monkeypatch.setattr(run, "linearity", lambda *arguments, quick: {"duration": {"exponent": 1.0}})


def bench(*arguments):
    return CliRunner().invoke(app, [*map(str, arguments)])


def test_it_writes_numbers_and_diagram(short, tmp_path):
    done = bench("--quick", "-o", tmp_path / "out")
    assert done.exit_code == 0, done.output
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [
        "bench.json",
        "work_precision.png",
        "work_precision.svg",
    ]
    text = (tmp_path / "out" / "bench.json").read_text(encoding="utf-8")
    assert str(tmp_path) not in text and "NaN" not in text and "Infinity" not in text
    printed = json.loads(text)
    assert set(printed) == {
        "machine",
        "quick",
        "asked_accuracy",
        "default_tolerance",
        "reference",
        "targets",
        "methods",
        "evaluation",
        "quadrature",
        "real_time",
        "threads",
        "linearity",
        "mechanisms",
    }
    methods = printed["methods"]
    assert list(methods) == ["own", "scipy_bdf", "lsoda", rivals.EULER]
    assert methods["lsoda"]["installed"] is False and "not installed" in done.stdout
    assert [name for name, method in methods.items() if not method["installed"]] == ["lsoda"]
    for method in (methods[name] for name in methods if name != "lsoda"):
        assert len(method["histories"]) == 2
        for entry in method["histories"].values():
            assert (
                entry["seconds"] > 0.0
                and len(entry["runs"]["setting"]) == len(entry["runs"]["seconds"]) >= 1
            )
    own = methods["own"]["histories"].values()
    assert all(
        row["reached"] and max(row["energy_error"], row["spin_error"]) <= printed["asked_accuracy"]
        for row in own
    )
    assert printed["quadrature"]["largest_difference"] < 1e-8
    assert (
        printed["evaluation"]["force_evaluation_ns"] > 0.0
        and printed["evaluation"]["overhead_factor"] > 1.0
    )
    for model in ("paper", "physical"):
        assert printed["real_time"][model]["median"] >= printed["real_time"][model]["slowest"] > 0.0
    assert {"processor", "cores", "python", "numba", "numbalsoda", "scikit-sundae"} <= set(
        printed["machine"]
    )


def test_quiet_says_nothing(monkeypatch, tmp_path):
    """Of measurements that are done at once, one of them of a rival that is not installed: the test before has its line."""
    for name in (
        "two_threads",
        "linearity",
        "real_time",
        "evaluation_times",
        "quadrature_times",
        "mechanism_costs",
    ):
        monkeypatch.setattr(run, name, lambda *arguments, **options: {})
    monkeypatch.setattr(room, "QUICK", (("24A",), 100.0, 100.1))
    missing = [rival._replace(load=lambda: None) for rival in rivals.RIVALS if rival.key == "lsoda"]
    monkeypatch.setattr("benchmarks.comparison.RIVALS", tuple(missing))
    monkeypatch.setattr(run, "verify", lambda histories, references: {"agrees": True})
    done = bench("--quick", "--quiet", "-o", tmp_path / "out")
    assert (done.exit_code, done.stdout) == (0, ""), done.output


def test_without_matplotlib_it_says_what_to_install(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    done = bench("--quick", "-o", tmp_path / "out")
    assert done.exit_code == 2
    assert "pip install 'macroslip[bench,lsoda]'" in done.stderr and "Traceback" not in done.stderr
    assert not (tmp_path / "out").exists()
