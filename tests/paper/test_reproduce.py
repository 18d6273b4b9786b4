"""The reproduction in small: what is written, a failed roller on the page, and what a failure in the middle leaves."""

import html
import json
import re
import shutil
from functools import partial
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest
import xarray as xr

from macroslip.errors import InputError
from paper import experiments, reproduce, studies
from paper.publish import published_together
from paper.verdicts import NOT_COMPUTED, UNKNOWN

pytestmark = pytest.mark.slow

#: Studies of the paper, made small.
SHORT = {"rollers": [0, 14], "window": {"end": "30 s"}}
STUDIES = {
    "study": {"bundled": ["12C", "14A", "14B"], **SHORT},
    "detail": {"window": {"end": "30 s"}},
    "uncertainty": {"bundled": ["12B", "24B"], "points": 3, "loads": {"end": "14 s"}},
}


def few_turns(result, laws, threads, report):
    """One turn in the place of all, traced at samples 18 times as far apart as others are."""
    with patch.object(experiments, "_FINE", 2):
        turn = experiments.static_turn(
            experiments.varying_load(), "downwind", thrust=False, laws=laws
        )
    report(1, 1)
    rows = ("downwind", "upwind")
    static = {f"{name}, {row}": turn for name in experiments.STATIC_LOADS for row in rows}
    return {"static": static} | {
        figure: {f"{row} row": turn for row in rows} for figure in ("typical", "peak")
    }


def few_experiments(result, threads, report):
    varying = experiments.varying_load()
    report(1, 1)
    return {
        "A1": experiments.compare_stability(
            experiments.static_load(varying, thrust=False, duration=3.5)
        ),
        "nonlinear_tolerance": experiments.nonlinear_tolerance(
            varying.window(0.0, 26.0), tolerances=(1e-12, 1e-6)
        ),
        "step_size": experiments.step_size(
            varying, start=360.0, end=375.0, steps=(1e-2, 3e-3), rollers=(0,)
        ),
    }


@pytest.fixture(scope="module")
def quick(small):
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(
            studies, "content", lambda stage, model: small(stage, model, **STUDIES[stage])
        )
        patched.setattr(reproduce, "turns", few_turns)
        patched.setattr(reproduce, "experiments", few_experiments)
        yield partial(reproduce.reproduce, sampled=True)


@pytest.fixture(scope="module")
def written(quick, tmp_path_factory):
    target = tmp_path_factory.mktemp("reproduction") / "results"
    target.mkdir()
    (target / "notes.txt").write_text("mine")
    (target / "summary.json").write_text("old")
    calls = []
    return target, quick(target, threads=1, progress=lambda *call: calls.append(call)), calls


def test_everything_is_written(written, study):
    target, summary, calls = written
    assert json.loads((target / "summary.json").read_text()) == summary
    assert (target / "notes.txt").read_text() == "mine"
    assert [path.name for path in target.parent.iterdir()] == ["results"]
    for name in ("3a", "3b", "3b_peak", "4a", "4b", "5a", "5b"):
        for model in ("", "_physical"):
            assert (target / f"figure_{name}{model}.png").is_file()
            assert (target / f"figure_{name}{model}.svg").is_file()
            assert f"{name}{model}" in summary["figures"]
    for name in (
        "figure_A1",
        "mechanisms_physical",
        "uncertainty_physical",
        "figures_4_5_models",
        "friction_torque",
    ):
        assert (target / f"{name}.png").is_file()
    with xr.open_dataset(target / "study.nc", engine="h5netcdf") as stored:
        np.testing.assert_array_equal(stored.energy, study.energy)
    plotted = summary["figures"]["4b"]["data_vars"]["energy_ratio"]
    assert plotted["data"] == studies.paper_numbers(study).energy_ratio.values.tolist()
    assert plotted["attrs"]["units"] == "1"
    assert set(summary["figures"]["5b"]["data_vars"]) == {"peak_power_ratio"}
    torque = summary["figures"]["friction_torque_physical"]["data_vars"]["torque"]
    assert 1.0 < torque["data"] < 1e3
    assert torque["attrs"]["units"] == "N m"
    assert summary["figures"]["uncertainty_physical"]["attrs"] == {
        "completed": 2,
        "failed": 0,
        "refused": 0,
    }
    assert len(summary["headline"]) == 9
    euler = summary["statements"][-1]["models"]
    assert euler["physical"]["verdict"] == NOT_COMPUTED
    assert summary["failed_rollers"]["study"] == 0
    assert calls[-1] == ("report", 1, 1)
    assert list(dict.fromkeys(label for label, _, _ in calls)) == list(summary["seconds"])
    assert summary["reused"] == []


def test_the_page_has_every_section_number_and_figure_and_needs_no_network(written):
    target, summary, _ = written
    page = html.unescape((target / "report.html").read_text(encoding="utf-8"))
    assert len(page) < 8e6
    links = set(re.findall(r'href="#([^"]+)"', page))
    assert {
        "answer",
        "figures-physical",
        "mechanisms",
        "uncertainty",
        "torque",
        "provenance",
    } <= links
    assert links <= set(re.findall(r'id="([^"]+)"', page))
    assert page.count("<img") == len(list(target.glob("*.svg")))
    assert not re.search(r'(src|href)="(?!data:|#)', page)
    for statement in summary["statements"]:
        assert statement["paper"] in page
        assert statement["models"]["paper"]["verdict"] in page
    for words in (
        "@software{macroslip",
        "bundled case 14a",
        "Samples completed: 2",
        "Why, model paper: a roller gripped all round",
    ):
        assert words.lower() in page.lower(), words


def test_all_that_is_written_is_documented(written):
    target, summary, _ = written
    docs = Path(__file__).parents[2] / "docs"
    documented = "".join(
        (docs / name).read_text(encoding="utf-8") for name in ("published-study.md", "results.md")
    )
    figures = {path.stem.removesuffix("_physical") for path in target.glob("*.png")}
    with xr.open_dataset(target / "study_physical.nc", engine="h5netcdf") as stored:
        names = [*summary, *stored.data_vars, *(name.removeprefix("figure_") for name in figures)]
    assert [
        name
        for name in names
        if f"`{name}`" not in documented and f"`figure_{name}`" not in documented
    ] == []


def test_without_the_sample_nothing_of_it_is_written(quick, written, monkeypatch, tmp_path):
    target = tmp_path / "results"
    shutil.copytree(written[0] / "studies", target / "studies")
    monkeypatch.setattr(reproduce, "save", lambda *arguments: None)
    summary = quick(target, sampled=False)
    assert not [name for name in summary["figures"] if name.startswith("uncertainty")]
    assert "uncertainty_physical" not in summary["reused"] and len(summary["reused"]) == 4
    assert 'href="#uncertainty"' not in (target / "report.html").read_text(encoding="utf-8")


def test_a_failed_roller_is_seen_on_the_page_and_never_averaged_over(
    quick, written, study, monkeypatch, tmp_path
):
    shutil.copytree(written[0] / "studies", tmp_path / "results" / "studies")
    failed = study.copy(deep=True)
    failed.energy.loc[{"case": "14B", "row": "upwind", "roller": 14}] = np.nan
    failed.orbit_energy.loc[{"case": "14B", "row": "upwind"}] = np.nan
    failed.peak_power_mean.loc[{"case": "14B", "row": "upwind"}] = np.nan
    failed.status.loc[{"case": "14B", "row": "upwind", "roller": 14}] = 3
    read = studies.paper_study
    monkeypatch.setattr(
        studies, "paper_study", lambda path: failed if path.name == "study_paper" else read(path)
    )
    monkeypatch.setattr(reproduce, "save", lambda *arguments: None)
    summary = quick(tmp_path / "results")
    assert "uncertainty_physical" in summary["reused"] and len(summary["reused"]) == 5
    assert summary["headline"][0].startswith("FAILED INTEGRATIONS: 1 in study")
    assert summary["failed_rollers"]["study_by_case"] == {"14B": 1}
    assert summary["figures"]["4b"]["data_vars"]["energy_ratio"]["data"][2] is None
    verdicts = [statement["models"]["paper"]["verdict"] for statement in summary["statements"]]
    assert verdicts[:4] == [UNKNOWN] * 4 and verdicts[5:7] == [UNKNOWN] * 2
    page = (tmp_path / "results" / "report.html").read_text(encoding="utf-8")
    assert '<p class="failed">FAILED INTEGRATIONS: 1 in study' in page
    assert f'<span class="cannot-be-judged">{UNKNOWN}</span>' in page


def test_a_failure_in_the_middle_leaves_nothing_that_looks_finished(
    quick, written, monkeypatch, tmp_path
):
    target = tmp_path / "results"
    shutil.copytree(written[0] / "studies", target / "studies")
    (target / "summary.json").write_text("old")

    def broken(*arguments):
        raise RuntimeError("out of paper")

    monkeypatch.setattr(reproduce, "save", broken)
    with pytest.raises(RuntimeError, match="out of paper"):
        quick(target)
    # What was computed stays, for the next run to go on from.
    left = sorted(
        str(path.relative_to(tmp_path)) for path in [*tmp_path.iterdir(), *target.iterdir()]
    )
    assert left == ["results", "results/studies", "results/summary.json"]


def test_files_of_a_broken_move_lack_their_last(monkeypatch, tmp_path):
    target = tmp_path / "results"
    target.mkdir()
    (target / "last").write_text("old")
    replace = Path.replace

    def broken(path, other):
        if path.name == "b":
            raise OSError("disk full")
        return replace(path, other)

    monkeypatch.setattr(Path, "replace", broken)
    with pytest.raises(OSError, match="disk full"), published_together(target, "last") as folder:
        for name in ("a", "b", "last"):
            (folder / name).write_text("new")
    assert [path.name for path in target.iterdir()] == ["a"]
    assert [path.name for path in tmp_path.iterdir()] == ["results"]


def test_a_file_in_the_way_is_refused_before_computing(monkeypatch, tmp_path):
    monkeypatch.setattr(studies, "compute", lambda *arguments, **options: pytest.fail("computed"))
    (tmp_path / "results").write_text("")
    with pytest.raises(InputError, match="not a folder"):
        reproduce.reproduce(tmp_path / "results")
