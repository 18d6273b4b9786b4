"""The reproduction: numbers of the study, turns, experiments, verdicts and what is written."""

import contextlib
import importlib.util
import json
import shutil
from functools import partial
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from macroslip import Case, Drivetrain, HubLoads, Laws, MacroslipError, Window, main_bearing_load, simulate
from macroslip.errors import InputError
from macroslip.files import published_together
from macroslip.reproduction import headline, model_run, single_roller, verdicts
from macroslip.reproduction import reproduce as module
from macroslip.reproduction.paper_numbers import paper_numbers
from macroslip.reproduction.single_roller import inflexion_angle, static_load, static_turn, trace_turn
from macroslip.reproduction.solver_experiments import nonlinear_tolerance, step_size
from macroslip.reproduction.stability import compare_stability
from macroslip.reproduction.statement import AGREES, DIFFERS, NOT_COMPUTED, PARTLY, UNKNOWN
from macroslip.reproduction.studies import FOLDER, computed

pytestmark = pytest.mark.slow

SMALL = {"rollers": [0, 14], "window": Window(end=30.0)}
#: Studies of the reproduction, made small.
SHORT = {"rollers": [0, 14], "window": {"end": "30 s"}}
STUDIES = {
    "study": {"bundled": ["12C", "14A", "14B"], **SHORT},
    "detail": {"window": {"end": "30 s"}},
    "sensitivity": {"points": 4, **SHORT},
    "uncertainty": {"bundled": ["12B", "24B"], "points": 3, "loads": {"end": "14 s"}},
}


@pytest.fixture(scope="module")
def varying():
    return main_bearing_load(HubLoads.bundled("14B"), Drivetrain())


@pytest.fixture(scope="module")
def downward(varying):
    return static_turn(varying, "downwind", thrust=False)


@pytest.fixture(scope="module")
def experiments(varying):
    return {
        "A1": compare_stability(static_load(varying, thrust=False, duration=3.5)),
        "nonlinear_tolerance": nonlinear_tolerance(varying.window(0.0, 26.0), tolerances=(1e-12, 1e-6)),
        "step_size": step_size(varying, start=360.0, end=375.0, steps=(1e-2, 3e-3), rollers=(0,)),
    }


def with_failed_roller(study):
    failed = study.copy(deep=True)
    failed.energy.loc[{"case": "14B", "row": "upwind", "roller": 14}] = np.nan
    failed.peak_power_mean.loc[{"case": "14B", "row": "upwind"}] = np.nan
    failed.status.loc[{"case": "14B", "row": "upwind", "roller": 14}] = 3
    return failed


def test_study_holds_what_the_simulation_gives(study):
    result = simulate(Case(loads=HubLoads.bundled("14A"), **SMALL))
    one = study.sel(case="14A")
    np.testing.assert_array_equal(one.energy, result.energy)
    samples = result.peak_power.max("interface").values.reshape(2, -1)
    np.testing.assert_allclose(one.peak_power_mean, samples.mean(axis=1), rtol=1e-14)
    np.testing.assert_allclose(one.peak_power_std, samples.std(axis=1), rtol=1e-12)
    assert int(one.orbits) == result.sizes["orbit"]
    assert study.wind_speed.values.tolist() == [12.0, 14.0, 14.0]
    assert all(variable.attrs["units"] for variable in study.data_vars.values())


def test_numbers_are_normalised_by_the_reference_case(study):
    numbers = paper_numbers(study)
    assert (numbers.energy_normalised.sel(case="12C") == 1.0).all()
    assert numbers.both_rows_normalised.sel(case="12C") == 1.0
    assert (numbers.peak_power_mean_normalised.sel(case="14A") == 1.0).all()
    total = study.energy.sum("interface").mean("roller")
    np.testing.assert_allclose(numbers.energy, total, rtol=1e-15)
    np.testing.assert_allclose(numbers.energy_ratio, total.sel(row="downwind") / total.sel(row="upwind"), rtol=1e-15)
    assert (numbers.energy_min <= numbers.energy).all()
    assert (numbers.energy <= numbers.energy_max).all()


def test_numbers_need_the_reference_cases(study):
    with pytest.raises(InputError, match="12C"):
        paper_numbers(study.sel(case=["14A", "14B"]))


def test_a_failed_roller_is_seen_and_never_averaged_over(study):
    failed = with_failed_roller(study)
    numbers = paper_numbers(failed)
    assert np.isnan(numbers.energy.sel(case="14B", row="upwind"))
    assert np.isfinite(numbers.energy.sel(case="14B", row="downwind"))
    assert verdicts.energy_between_rows(numbers).verdict == UNKNOWN
    assert verdicts.energy_over_wind_speed(numbers, failed).verdict == UNKNOWN
    assert verdicts.peak_power_between_rows(numbers).verdict == UNKNOWN
    assert "FAILED INTEGRATIONS: 1 in study" in headline.failure_line({"study": 1, "experiments": 0}, 12)


def test_energy_verdicts_follow_the_numbers(study):
    numbers = paper_numbers(study)
    ten = numbers.assign(energy_ratio=xr.full_like(numbers.energy_ratio, 9.0))
    assert verdicts.energy_between_rows(ten).verdict == AGREES
    assert verdicts.energy_between_rows(numbers).verdict == DIFFERS

    speeds = np.arange(12.0, 25.0, 2.0)
    case = {"wind_speed": ("case", speeds), "row": ["downwind", "upwind"]}
    falling = xr.Dataset({"both_rows_normalised": ("case", 1.0 / speeds)}, case)
    rising = xr.Dataset({"both_rows_normalised": ("case", speeds)}, case)
    orbits = xr.Dataset({"orbits": ("case", speeds), "orbit_energy": (("case", "row"), np.ones((7, 2)))}, case)
    assert verdicts.energy_over_wind_speed(falling, orbits).verdict == AGREES
    found = verdicts.energy_over_wind_speed(rising, orbits)
    assert found.verdict == DIFFERS
    assert "24 and 22 m/s" in found.found
    assert "0.0 % downwind and 0.0 % upwind, the number of orbits by 100.0 %" in found.because


def test_reasons_are_given_only_where_the_numbers_bear_them_out(study):
    numbers = paper_numbers(study)
    per_orbit = float(numbers.orbit_energy.sel(row="downwind").mean())
    assert "gripped all round" in verdicts.energy_between_rows(numbers, per_orbit).because
    assert verdicts.energy_between_rows(numbers, 2.0 * per_orbit).because == ""
    assert verdicts.energy_between_rows(numbers).because == ""
    assert verdicts.peak_power_between_rows(numbers).because == ""


def test_dominance_verdict_follows_the_numbers(study):
    assert verdicts.cage_dominates(study).verdict == AGREES
    swapped = study.assign(energy=study.energy.isel(interface=[2, 1, 0]).assign_coords(interface=study.interface))
    found = verdicts.cage_dominates(swapped)
    assert found.verdict == DIFFERS
    assert "downwind the inner interface takes most" in found.because
    assert verdicts.cage_dominates(with_failed_roller(study)).verdict == UNKNOWN


def test_peak_power_verdicts_follow_the_numbers():
    speeds = np.arange(12.0, 25.0, 2.0)

    def numbers(mean, std, ratio):
        def two(values):
            return (("case", "row"), np.column_stack([values, values]))

        return xr.Dataset(
            {"peak_power_mean": two(mean), "peak_power_std": two(std), "peak_power_ratio": ("case", ratio)},
            {"wind_speed": ("case", speeds), "row": ["downwind", "upwind"]},
        )

    level = np.array([1.0, 1.2, 0.9, 1.1, 1.0, 1.05, 0.95])
    agreeing = numbers(level, level, 50.0 / speeds)
    assert verdicts.peak_power_over_wind_speed(agreeing).verdict == AGREES
    assert verdicts.peak_power_between_rows(agreeing).verdict == AGREES
    rising = numbers(speeds, speeds, 5.0 * speeds / 24.0)
    assert verdicts.peak_power_over_wind_speed(rising).verdict == PARTLY
    assert verdicts.peak_power_between_rows(rising).verdict == PARTLY
    contrary = numbers(speeds, 0.01 * speeds, speeds)
    assert verdicts.peak_power_over_wind_speed(contrary).verdict == DIFFERS
    assert verdicts.peak_power_between_rows(contrary).verdict == DIFFERS


def test_ratio_to_static_verdict_follows_the_numbers(study):
    numbers = paper_numbers(study)
    energy = float(numbers.orbit_energy.sel(case="14B", row="downwind"))
    found = {
        scale: verdicts.varying_over_static(numbers, "14B", {"downward": {"downwind": energy / scale}})
        for scale in (1.0, 100.0)
    }
    assert found[1.0].verdict == DIFFERS
    assert found[100.0].verdict == AGREES
    assert found[100.0].numbers["downward_downwind"] == pytest.approx(100.0)


def test_a_turn_under_downward_load(downward):
    assert downward.angle.values[0] == pytest.approx(0.0, abs=1e-3)
    assert downward.angle.values[-1] == pytest.approx(360.0, abs=1e-3)
    free = downward.roller_load == 0.0
    assert free.sel(angle=180.0, method="nearest")
    assert not free.sel(angle=0.0, method="nearest")
    assert downward.energy_fraction.values[-1] == 1.0
    assert (np.diff(downward.energy_fraction) >= 0.0).all()
    # The traces' trapezoids and the integrator's own quadrature are two ways to the same energy.
    assert downward.attrs["energy_from_traces_J"] == pytest.approx(downward.attrs["energy_J"], rel=1e-5)
    assert downward.spin_speed.max() <= 1.0001 * downward.spin_speed_pure.max()


def test_a_turn_with_microslip(varying, downward):
    turn = static_turn(varying, "downwind", thrust=False, laws=Laws.physical())
    assert turn.attrs["energy_from_traces_J"] == pytest.approx(turn.attrs["energy_J"], rel=1e-4)
    assert turn.attrs["energy_J"] > 10.0 * downward.attrs["energy_J"]
    np.testing.assert_allclose(turn.roller_load, downward.roller_load, rtol=1e-9)


def test_a_turn_needs_a_whole_turn(varying):
    with pytest.raises(InputError, match="no whole turn"):
        trace_turn(varying, "downwind", 0, 599.9)


def test_unloaded_roller_verdict_follows_the_turn(downward):
    inflexion = inflexion_angle(downward)
    assert verdicts.unloaded_roller(downward, inflexion).verdict == AGREES
    assert verdicts.unloaded_roller(downward, float("nan")).verdict == PARTLY
    gripped = downward.assign_attrs(lowest_spin_ratio=1.0, recovery_time_s=float("nan"))
    assert verdicts.unloaded_roller(gripped, 90.0).verdict == DIFFERS
    failed = downward.assign_attrs(lowest_spin_ratio=float("nan"))
    assert verdicts.unloaded_roller(failed, inflexion).verdict == UNKNOWN


def test_inflexion_is_the_steepest_rise_of_spin():
    angle = np.linspace(0.0, 360.0, 721)
    load = np.where(np.abs(angle - 180.0) < 120.0, 0.0, 1.0)
    spin = 9.0 - 0.02 * angle + np.tanh((angle - 170.0) / 30.0)
    turn = xr.Dataset({"spin_speed": ("angle", spin), "roller_load": ("angle", load)}, {"angle": angle})
    assert inflexion_angle(turn) == pytest.approx(170.0, abs=0.5)
    assert np.isnan(inflexion_angle(turn.assign(spin_speed=("angle", 9.0 - 1e-5 * angle**2))))


def test_explicit_euler_is_lost_where_the_step_exceeds_the_relaxation_time(experiments):
    stability = experiments["A1"]
    limit, lost = stability.attrs["limit_angle_deg"], stability.attrs["lost_angle_deg"]
    assert stability.attrs["limit_relaxation_time_s"] <= 0.5e-3
    assert limit <= lost < limit + 5.0
    assert stability.deviation_explicit.sel(angle=slice(None, limit)).max() < 0.02
    assert verdicts.euler_stability(stability).verdict == AGREES
    stable = stability.assign_attrs(largest_deviation_explicit=0.01, status_explicit=0)
    assert verdicts.euler_stability(stable).verdict == PARTLY
    overflowed = stability.assign_attrs(largest_deviation_explicit=float("nan"), status_explicit=2)
    assert verdicts.euler_stability(overflowed).verdict == AGREES


def test_a_loose_iteration_adds_energy_only_to_a_gripped_roller_under_varying_load(experiments):
    found = experiments["nonlinear_tolerance"]
    tight, loose = found.sel(stopping_tolerance=1e-12), found.sel(stopping_tolerance=1e-6)
    np.testing.assert_allclose(tight.energy, found.energy_converged, rtol=0.01)
    assert loose.ratio.sel(row="downwind") > 100.0
    assert loose.ratio.sel(row="upwind") < 1.5
    np.testing.assert_allclose(loose.static_energy, tight.static_energy, rtol=1e-3)
    assert "passes 100 times between a relative change of 1e-12" in headline.tolerance_line(found)
    tame = found.assign(ratio=found.ratio.clip(max=2.0))
    assert "is 2 times at a relative change of 1e-06" in headline.tolerance_line(tame)
    failed = found.assign(ratio=found.ratio * np.nan)
    assert UNKNOWN in headline.tolerance_line(failed)


def test_a_coarse_step_misses_the_peak(experiments):
    found = experiments["step_size"]
    assert found.mean_peak_power.sel(row="upwind").max() < found.mean_peak_power_converged.sel(row="upwind")
    np.testing.assert_allclose(found.mean_peak_power_production, found.mean_peak_power_converged, rtol=3e-2)
    assert "10 ms" in headline.step_line(found)


def fewer_turns(result, laws, threads, report):
    """One turn in the place of all, traced at samples 18 times as far apart as others are."""
    from unittest.mock import patch

    with patch.object(single_roller, "_FINE", 2):
        turn = static_turn(model_run.varying_load(), "downwind", thrust=False, laws=laws)
    report(1, 1)
    rows = ("downwind", "upwind")
    static = {f"{name}, {row}": turn for name in model_run.STATIC_LOADS for row in rows}
    return {"static": static} | {figure: {f"{row} row": turn for row in rows} for figure in ("typical", "peak")}


def only(monkeypatch, **models):
    for place in (model_run, module):
        monkeypatch.setattr(place, "MODELS", models)


@pytest.fixture
def quick(monkeypatch, small, experiments):
    """The reproduction under one model, with small studies and short experiments."""
    only(monkeypatch, paper=Laws.paper())
    monkeypatch.setattr(model_run, "reproduction_study", lambda name: small(name, **STUDIES[name.partition("_")[0]]))
    monkeypatch.setattr(module, "_experiments", lambda *arguments: experiments)
    return partial(module.reproduce, threads=1)


@pytest.fixture(scope="module")
def paper_studies(small, tmp_path_factory):
    """Results of the studies under the paper's model, as a run that was stopped leaves them."""
    folder = tmp_path_factory.mktemp("studies")
    for stage in ("study", "detail", "sensitivity"):
        computed(small(f"{stage}_paper", **STUDIES[stage]), folder / f"{stage}_paper", may_fail=True)
    return folder


def test_everything_is_written_says_the_same_and_is_used_again(quick, study, monkeypatch, tmp_path):
    target = tmp_path / "results"
    target.mkdir()
    (target / "notes.txt").write_text("mine")
    (target / "summary.json").write_text("old")
    calls = []
    summary = quick(target, progress=lambda *call: calls.append(call))
    assert json.loads((target / "summary.json").read_text()) == summary
    assert (target / "notes.txt").read_text() == "mine"
    assert [path.name for path in tmp_path.iterdir()] == ["results"]
    for name in ("3a", "3b", "3b_peak", "4a", "4b", "5a", "5b", "A1"):
        assert (target / f"figure_{name}.png").is_file()
        assert (target / f"figure_{name}.svg").is_file()
        assert name in summary["figures"]
    with xr.open_dataset(target / "study.nc", engine="h5netcdf") as stored:
        np.testing.assert_array_equal(stored.energy, study.energy)
        assert stored.energy.attrs["units"] == "J"
    plotted = summary["figures"]["4b"]["data_vars"]["energy_ratio"]
    assert plotted["data"] == paper_numbers(study).energy_ratio.values.tolist()
    assert plotted["attrs"]["units"] == "1"
    assert len(summary["headline"]) == 10
    assert [
        one["models"]["paper"]["found"] in line
        for one, line in zip(summary["statements"], summary["headline"][1:9], strict=True)
    ] == [True] * 8
    assert summary["failed_rollers"]["study"] == 0
    assert calls[-1] == ("report", 1, 1)
    assert {label for label, _, _ in calls} <= set(module.stages())
    assert summary["reused"] == []
    page = (target / "report.html").read_text(encoding="utf-8")
    assert (target / "report.html").stat().st_size < 8e6
    assert all(one["models"]["paper"]["verdict"] in page for one in summary["statements"])

    # What is drawn follows from what was read, and was drawn above.
    monkeypatch.setattr(module, "save_figures", lambda *arguments: None)
    monkeypatch.setattr(module, "page_written", lambda *arguments: contextlib.nullcontext())
    again = quick(target)
    assert again["reused"] == ["study_paper", "detail_paper", "sensitivity_paper"]
    changing = ("seconds", "reused")
    assert {key: one for key, one in again.items() if key not in changing} == {
        key: one for key, one in summary.items() if key not in changing
    }


def test_the_physical_model_gets_its_own_column_sections_and_files(quick, paper_studies, monkeypatch, tmp_path):
    shutil.copytree(paper_studies, tmp_path / "results" / FOLDER)
    monkeypatch.setattr(model_run, "_turns", fewer_turns)
    only(monkeypatch, paper=Laws.paper(), physical=Laws.physical())
    save = module.save_figures

    def of_the_physical_model(figures, *rest):
        """Those of the paper's model are drawn in the test above."""
        save({name: one for name, one in figures.items() if f"{name}_physical" not in figures}, *rest)

    monkeypatch.setattr(module, "save_figures", of_the_physical_model)
    calls = []
    summary = quick(tmp_path / "results", progress=lambda *call: calls.append(call))
    assert len(summary["headline"]) == 10
    assert {label for label, _, _ in calls} == set(module.stages()) - {"experiments"}
    first, rows, *_, euler = (one["models"] for one in summary["statements"])
    assert "microslip" in first["physical"]["because"]
    assert "microslip" not in first["paper"]["because"]
    assert "anywhere in their ranges" in rows["physical"]["found"]
    assert "anywhere in their ranges" not in rows["paper"]["found"]
    assert euler["physical"]["verdict"] == NOT_COMPUTED
    assert "paper: " in summary["headline"][1] and "; physical: " in summary["headline"][1]
    for name in (
        "study_physical.nc",
        "figure_4a_physical.svg",
        "sensitivity_physical.png",
        "figure_3a_physical.svg",
        "mechanisms_physical.png",
        "uncertainty_physical.svg",
        "figures_4_5_models.png",
        "friction_torque.svg",
    ):
        assert (tmp_path / "results" / name).is_file()
    documented = (Path(__file__).parents[2] / "docs" / "results.md").read_text(encoding="utf-8")
    figures = {path.stem.removesuffix("_physical") for path in (tmp_path / "results").glob("*.png")}
    with xr.open_dataset(tmp_path / "results" / "study_physical.nc", engine="h5netcdf") as stored:
        names = [*summary, *stored.data_vars, *(name.removeprefix("figure_") for name in figures)]
    assert [name for name in names if f"`{name}`" not in documented and f"`figure_{name}`" not in documented] == []
    torque = summary["figures"]["friction_torque_physical"]["data_vars"]["torque"]
    assert 1.0 < torque["data"] < 1e3
    assert torque["attrs"]["units"] == "N m"
    assert summary["figures"]["uncertainty_physical"]["attrs"] == {"completed": 2, "failed": 0, "refused": 0}
    page = (tmp_path / "results" / "report.html").read_text(encoding="utf-8")
    for words in (
        "Under <em>physical</em>",
        'id="films-physical"',
        "Figure 4a: energy over mean wind speed (model physical)",
        "case 14B, model physical",
        "Figure 3a: constant load and speed (model physical)",
        'id="mechanisms"',
        'id="uncertainty"',
        'id="torque"',
        "2 of 2 samples completed",
    ):
        assert words in page


def test_failed_rollers_head_the_summary(quick, paper_studies, study, monkeypatch, tmp_path):
    shutil.copytree(paper_studies, tmp_path / "results" / FOLDER)
    monkeypatch.setattr(model_run, "_turns", fewer_turns)
    monkeypatch.setattr(model_run, "paper_study", lambda directory: with_failed_roller(study))
    monkeypatch.setattr(module, "save_figures", lambda *arguments: None)
    summary = quick(tmp_path / "results")
    assert summary["reused"] == ["study_paper", "detail_paper", "sensitivity_paper"]
    assert summary["headline"][0].startswith("FAILED INTEGRATIONS: 1 in study")
    assert summary["failed_rollers"]["study_by_case"] == {"14B": 1}
    assert summary["figures"]["4b"]["data_vars"]["energy_ratio"]["data"][2] is None
    page = (tmp_path / "results" / "report.html").read_text(encoding="utf-8")
    assert "FAILED INTEGRATIONS: 1 in study" in page


@pytest.mark.parametrize("exists", [False, True])
def test_a_failure_in_the_middle_leaves_nothing_that_looks_finished(
    quick, paper_studies, monkeypatch, tmp_path, exists
):
    from macroslip.reproduction import paper_figures

    monkeypatch.setattr(model_run, "_turns", fewer_turns)
    target = tmp_path / "results"
    if exists:
        shutil.copytree(paper_studies, target / FOLDER)
        (target / "summary.json").write_text("old")

    def broken(turns):
        raise RuntimeError("out of paper")

    monkeypatch.setattr(paper_figures, "turns_figure", broken)
    with pytest.raises(RuntimeError, match="out of paper"):
        quick(target)
    left = sorted(str(path.relative_to(tmp_path)) for path in [*tmp_path.iterdir(), *target.iterdir()])
    # What was computed stays, for the next run to go on from.
    assert left == ["results", "results/studies", *(["results/summary.json"] if exists else [])]


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
    monkeypatch.setattr(model_run, "computed", lambda *arguments, **options: pytest.fail("computed"))
    (tmp_path / "results").write_text("")
    with pytest.raises(InputError, match="not a folder"):
        module.reproduce(tmp_path / "results")


def test_missing_matplotlib_is_told_before_computing(monkeypatch, tmp_path):
    find = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None if name == "matplotlib" else find(name))
    monkeypatch.setattr(model_run, "computed", lambda *arguments, **options: pytest.fail("computed"))
    with pytest.raises(MacroslipError, match=r"pip install 'macroslip\[figures\]'"):
        module.reproduce(tmp_path / "results")
    assert not (tmp_path / "results").exists()
