"""A whole study in this process: what it stores, what it computes again, and what it does about bad cases."""

import dataclasses
import json

import numpy as np
import pytest

from macroslip import (
    BearingLoads,
    Case,
    InputError,
    Laws,
    MacroslipError,
    Radau,
    Window,
    open_study,
    run_study,
    simulate,
)
from macroslip.storage import tables
from macroslip.study.progress import Progress
from macroslip.study.reader import stored_results
from macroslip.study.study_file import study_of
from macroslip.study.work import ALWAYS_KEPT, case_key

pytestmark = pytest.mark.slow


def test_results_are_those_of_simulate(tmp_path, load_files, content):
    ended = run_study(study_of(content, load_files), tmp_path / "out")
    assert (ended.progress.computed, ended.progress.failed, ended.failures) == (4, 0, [])
    study = open_study(tmp_path / "out")
    for case in range(4):
        loads = BearingLoads.read(load_files / str(study.loads.values[case]))
        expected = simulate(Case(loads=loads, laws=Laws.paper(), rollers=[0]))
        of_case = study.isel(case=case)
        for name in ("energy", "min_spin_ratio", "status", "end_slip", "steps"):
            np.testing.assert_array_equal(of_case[name].values, expected[name].values.astype(float))
        np.testing.assert_allclose(
            of_case.energy_mean, expected.energy.sum("interface").mean("roller"), rtol=1e-14
        )


def test_several_runs_at_once_store_the_same(tmp_path, load_files, content):
    study = study_of(content, load_files)
    for name, threads in (("one", 1), ("many", 6)):
        ended = run_study(study, tmp_path / name, threads=threads)
        assert (ended.progress.computed, ended.progress.failed) == (4, 0)
    stored = [
        {path.name: path.read_bytes() for path in (tmp_path / name).glob("cases/*/*.nc")}
        for name in ("one", "many")
    ]
    assert len(stored[0]) == 4 and stored[0] == stored[1]
    assert "1 at once with 1 threads each" in (tmp_path / "one" / "log.txt").read_text()
    assert "4 at once with 1 threads each" in (tmp_path / "many" / "log.txt").read_text()


@pytest.fixture
def same_content(load_files, content):
    """Eight runs of one key: four copies of a load file, at the tilt of the base case and without one."""
    for path in (load_files / "runs").iterdir():
        _copy = (load_files / "runs" / "12mps_seed1.csv").read_bytes()
        path.write_bytes(_copy)
    return content | {"models": {"base": {}, "said again": {"drivetrain.tilt": "5 deg"}}}


@pytest.mark.parametrize("options", [{"threads": 8}, {"threads": 1}, {"workers": 2}])
def test_runs_of_one_key_are_computed_once(
    tmp_path, load_files, same_content, options, done, rows, wait_for
):
    out = tmp_path / "out"
    ended = run_study(study_of(same_content, load_files), out, **options)
    assert (ended.progress.computed, ended.progress.unchanged, ended.progress.failed) == (1, 7, 0)
    assert len(done(out)) == 1  # compares the checksum
    assert rows(out, "SELECT count(*), count(DISTINCT run), count(DISTINCT key) FROM runs") == [
        (8, 8, 1)
    ]
    assert (open_study(out).outcome == "completed").all()
    assert open_study(out).energy.notnull().all()
    assert not list(out.rglob("*.part"))


def test_runs_of_one_key_that_fails_have_each_its_reason(
    tmp_path, load_files, same_content, monkeypatch
):
    def broken(case, **options):
        raise ZeroDivisionError("a fault of the program")

    monkeypatch.setattr("macroslip.result.simulate.simulate", broken)
    out = tmp_path / "out"
    ended = run_study(study_of(same_content, load_files), out, threads=4)
    assert ended.progress.failed == 8
    assert all("ZeroDivisionError" in reason for reason in open_study(out).reason.values)
    assert not list(out.rglob("*.part"))


def test_equal_inputs_give_equal_bytes(tmp_path, monkeypatch, load_files, content):
    """Whether the tables of contacts are made, found on the disk or remembered."""
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "cache"))
    physical = content | {"case": {"rollers": [0], "loads": {"end": "0.4 s"}}}
    study = study_of(physical, load_files)
    runs = []
    for name in ("cold", "warm", "remembered"):
        if name != "remembered":
            monkeypatch.setattr(tables, "_in_memory", tables.LRUCache(1e9, getsizeof=tables._size))
        run_study(study, tmp_path / name, threads=1)
        runs.append(
            {path.name: path.read_bytes() for path in (tmp_path / name).glob("cases/*/*.nc")}
        )
    assert list((tmp_path / "cache").rglob("*.cache"))
    assert len(runs[0]) == 4 and runs[0] == runs[1] == runs[2]
    attributes = next(stored_results(tmp_path / "cold"))[1].attrs
    assert not [name for name in attributes if "time" in name or "second" in name]


def test_only_what_is_to_be_kept_is_stored(tmp_path, load_files, content):
    run_study(study_of(content, load_files), tmp_path / "all")
    run_study(study_of(content | {"keep": ["energy"]}, load_files), tmp_path / "some")
    whole, some = open_study(tmp_path / "all"), open_study(tmp_path / "some")
    of_results = {name for name, variable in some.data_vars.items() if "roller" in variable.dims}
    assert of_results == {"energy", *ALWAYS_KEPT} and "orbit_energy" in whole
    np.testing.assert_array_equal(some.energy, whole.energy)
    np.testing.assert_array_equal(some.peak_power_mean, whole.peak_power_mean)


def test_results_one_by_one_are_whole(tmp_path, load_files, content):
    bad = content | {"models": {"base": {}, "refused": {"bearing.osculation_outer": 1.5}}}
    run_study(study_of(bad, load_files), tmp_path / "out")
    study = open_study(tmp_path / "out")
    results = dict(stored_results(tmp_path / "out"))
    assert (
        sorted(results) == np.flatnonzero(study.outcome.values == "completed").tolist()
        and len(results) == 4
    )
    for number, result in results.items():
        np.testing.assert_array_equal(result.energy, study.energy.isel(case=number))
        assert json.loads(result.attrs["input"])["rollers"] == [0]


def test_the_torque_of_the_contacts_is_their_power_over_the_speed(tmp_path):
    study = study_of(
        {
            "case": {"laws": {"model": "paper"}, "rollers": [0, 14], "loads": {"end": "30 s"}},
            "loads": {"bundled": ["14B"]},
        }
    )
    run_study(study, tmp_path / "out")
    of_case = open_study(tmp_path / "out").isel(case=0)
    # Two rollers stand for 28 of each row; whole orbits take a whole part of the shaft's angle.
    work = 14 * float(of_case.orbit_energy.sum())
    seconds = float(of_case.orbit_end[-1] - of_case.orbit_start[0])
    assert float(of_case.contact_torque) == pytest.approx(
        work / seconds / float(of_case.shaft_speed_mean), rel=0.05
    )


def test_unchanged_runs_are_never_computed_again(
    tmp_path, load_files, content, counted, identities, rows, resumed
):
    study, out = study_of(content, load_files), tmp_path / "out"
    run_study(study, out)
    before = identities(out)
    ended, simulated = resumed(study, out, counted)
    assert (ended.progress.unchanged, ended.progress.computed, simulated) == (4, 0, 0)
    assert identities(out) == before and rows(out, "SELECT count(*) FROM results") == [(4,)]


def test_a_moved_or_renamed_load_file_is_not_computed_again(
    tmp_path, load_files, content, counted, resumed
):
    out = tmp_path / "out"
    run_study(study_of(content, load_files), out)
    (load_files / "runs").rename(load_files / "moved")
    (load_files / "moved" / "12mps_seed1.csv").rename(load_files / "moved" / "12mps_seed7.csv")
    moved = content | {
        "loads": content["loads"] | {"files": "moved/{wind_speed:g}mps_seed{seed:d}.csv"}
    }
    ended, simulated = resumed(study_of(moved, load_files), out, counted)
    assert (ended.progress.unchanged, simulated) == (4, 0)
    study = open_study(out)
    assert list(study.seed.values) == [2, 7, 1, 2] and (study.outcome == "completed").all()
    assert study.energy.notnull().all()


def test_changed_inputs_are_computed_again_and_only_they(
    tmp_path, load_files, content, counted, identities, resumed, write_loads
):
    out = tmp_path / "out"
    run_study(study_of(content, load_files), out)
    before = identities(out)
    old = open_study(out).energy_mean.values
    write_loads(load_files / "runs" / "14mps_seed1.csv", force=-350.0)
    ended, simulated = resumed(study_of(content, load_files), out, counted)
    assert (ended.progress.unchanged, ended.progress.computed, simulated) == (3, 1, 1)
    assert before.items() <= identities(out).items()
    new = open_study(out).energy_mean.values
    assert (new[2] != old[2]).any() and (np.delete(new, 2, 0) == np.delete(old, 2, 0)).all()
    assert (
        "14mps_seed1.csv" in (out / "log.txt").read_text()
        and "has changed since" in (out / "log.txt").read_text()
    )


def test_a_study_may_grow_and_shrink(tmp_path, load_files, content, counted, resumed):
    out = tmp_path / "out"
    run_study(study_of(content, load_files), out)
    grown = content | {
        "variations": {"grid": {"drivetrain.tilt": {"values": [5, 6], "unit": "deg"}}}
    }
    # 5 deg is what the base case has: the same input, so the same results.
    ended, simulated = resumed(study_of(grown, load_files), out, counted)
    assert (ended.progress.unchanged, ended.progress.computed, simulated) == (4, 4, 4)
    assert open_study(out).sizes["case"] == 8
    ended, simulated = resumed(study_of(content, load_files), out, counted)
    assert (simulated, open_study(out).sizes["case"]) == (0, 4)


def test_a_changed_program_computes_all_again(
    tmp_path, load_files, content, counted, monkeypatch, resumed
):
    out = tmp_path / "out"
    run_study(study_of(content, load_files), out)
    monkeypatch.setattr("macroslip.study.work.fingerprint", lambda: "another program")
    assert resumed(study_of(content, load_files), out, counted)[1] == 4


def bad_files(folder, write_loads):
    """One file of each kind that cannot be used, beside the good ones."""
    write_loads(folder / "runs" / "16mps_seed1.csv", force=-40e3)  # more than the bearing carries
    good = (folder / "runs" / "12mps_seed1.csv").read_text()
    (folder / "runs" / "16mps_seed2.csv").write_text(
        good[: good.rindex(",", 0, len(good) // 2)]
    )  # cut off
    (folder / "runs" / "16mps_seed3.csv").write_text(good.replace(",80\n", ",nan\n", 1))
    (folder / "runs" / "16mps_seed4.csv").write_text("")
    (folder / "runs" / "16mps_seed5.csv").write_bytes(b"\x00\xff" * 300)


def test_bad_cases_are_recorded_and_the_others_computed(
    tmp_path, load_files, content, counted, resumed, write_loads
):
    bad_files(load_files, write_loads)
    out = tmp_path / "out"
    ended = run_study(study_of(content, load_files), out)
    assert (ended.progress.computed, ended.progress.failed) == (4, 5)
    study = open_study(out)
    assert list(study.outcome.values) == ["completed"] * 4 + ["failed"] * 5
    for reason, words in zip(
        study.reason.values[4:],
        ("a roller carries", "not readable|column", "nan", "empty", "read|column"),
        strict=True,
    ):
        assert any(word in reason.lower() for word in words.split("|")), reason
    assert (
        study.energy.isel(case=slice(4, None)).isnull().all()
        and study.energy_mean[4:].isnull().all()
    )
    assert [labels["seed"] for labels, _, _ in ended.failures] == [1, 2, 3, 4, 5]
    # They are tried again, and one that is mended is computed.
    write_loads(load_files / "runs" / "16mps_seed4.csv")
    ended, _ = resumed(study_of(content, load_files), out, counted)
    assert (ended.progress.unchanged, ended.progress.computed, ended.progress.failed) == (4, 1, 4)
    assert open_study(out).outcome.values[7] == "completed"


def test_strict_stops_at_the_first(tmp_path, load_files, content):
    # Of four loads the third is taken second: they are mixed.
    (load_files / "runs" / "14mps_seed1.csv").write_text("")
    ended = run_study(study_of(content, load_files), tmp_path / "out", strict=True, threads=1)
    assert (ended.stopped, ended.progress.done, ended.progress.failed) == (True, 2, 1)
    assert list(open_study(tmp_path / "out").outcome.values) == [
        "completed",
        "missing",
        "failed",
        "missing",
    ]


def test_failed_rollers_are_a_result_and_a_failure(tmp_path, load_files, content, counted, resumed):
    few = content | {
        "case": {"laws": {"model": "paper"}, "rollers": [0], "integrator": {"max_steps": 3}}
    }
    ended = run_study(study_of(few, load_files), tmp_path / "out")
    assert (ended.progress.computed, ended.progress.failed) == (0, 4)
    study = open_study(tmp_path / "out")
    assert (
        (study.outcome == "rollers failed").all()
        and (study.failed_rollers == 1).all()
        and (study.status == 3).all()
    )
    assert study.energy_mean.isnull().all() and "2 of 2 rollers failed" in study.reason.values[0]
    # The same input fails in the same way: it is not tried again.
    ended, simulated = resumed(study_of(few, load_files), tmp_path / "out", counted)
    assert simulated == 0


def test_a_setting_out_of_range_fails_its_runs_only(tmp_path, load_files, content):
    wide = content | {
        "variations": {"grid": {"drivetrain.tilt": {"values": [5, 50], "unit": "deg"}}}
    }
    ended = run_study(study_of(wide, load_files), tmp_path / "out")
    assert (ended.progress.computed, ended.progress.failed) == (4, 4)
    assert all(
        labels["drivetrain.tilt"] == 50 and "tilt" in reason for labels, _, reason in ended.failures
    )


def test_an_internal_error_is_recorded_with_its_traceback(
    tmp_path, load_files, content, monkeypatch
):
    def broken(case, **options):
        raise ZeroDivisionError("a fault of the program")

    monkeypatch.setattr("macroslip.result.simulate.simulate", broken)
    ended = run_study(study_of(content, load_files), tmp_path / "out")
    assert ended.progress.failed == 4 and "internal error" in ended.failures[0][2]
    log = (tmp_path / "out" / "log.txt").read_text()
    assert "Traceback" in log and "raise ZeroDivisionError" in log


def test_folders_that_are_refused(tmp_path, load_files, content):
    study = study_of(content, load_files)
    run_study(study, tmp_path / "out")
    with pytest.raises(InputError, match="holds a study already.*--resume"):
        run_study(study, tmp_path / "out")
    with pytest.raises(InputError, match="holds other things"):
        run_study(study, load_files)
    with pytest.raises(InputError, match="not a folder"):
        run_study(study, load_files / "runs" / "12mps_seed1.csv")
    manifest = tmp_path / "out" / "manifest.json"
    whole = manifest.read_text()
    manifest.write_text(whole[: len(whole) // 2])
    with pytest.raises(InputError, match=r"manifest\.json: the manifest cannot be read"):
        open_study(tmp_path / "out")
    manifest.write_text(whole.replace('"labels": {', '"tables": {'))
    with pytest.raises(InputError, match="out: it is damaged"):
        open_study(tmp_path / "out")
    manifest.write_text(whole.replace('"format": 4', '"format": 99'))
    with pytest.raises(InputError, match="format 99"):
        open_study(tmp_path / "out")
    with pytest.raises(InputError, match="no study in this folder"):
        open_study(load_files)


def test_a_second_process_is_refused(tmp_path, begin, long_content, load_files, content):
    process = begin(long_content, tmp_path / "out")
    process.stdout.readline()
    with pytest.raises(
        InputError, match=f"another process is at work in this folder .process {process.pid} on"
    ):
        run_study(study_of(content, load_files), tmp_path / "out", resume=True)
    # Looking at it is allowed meanwhile.
    assert set(open_study(tmp_path / "out").outcome.values) >= {"completed"}


def test_traces_and_cycles_come_on_request(tmp_path, load_files, content):
    wanted = content | {
        "cycles": True,
        "case": {"laws": {"model": "paper"}, "rollers": [0], "traces": {"step": "0.1 s"}},
    }
    run_study(study_of(wanted, load_files), tmp_path / "out")
    study = open_study(tmp_path / "out")
    assert study.spin.dims == ("case", "row", "roller", "sample") and study.time.dims == (
        "case",
        "sample",
    )
    np.testing.assert_allclose(study.time.isel(case=3), np.arange(11) / 10, atol=1e-12)
    assert study.load_cycles.sum() > 0
    plain = run_study(study_of(content, load_files), tmp_path / "plain")
    assert plain.progress.computed == 4 and not {"spin", "load_cycles"} & set(
        open_study(tmp_path / "plain").variables
    )


def test_the_summary_is_a_parquet_table_with_units(tmp_path, load_files, content):
    import pyarrow.parquet as pq

    (load_files / "runs" / "12mps_seed2.csv").write_text("")
    run_study(study_of(content, load_files), tmp_path / "out")
    table = pq.read_table(tmp_path / "out" / "summary.parquet")
    study = open_study(tmp_path / "out")
    assert table["outcome"].to_pylist() == list(study.outcome.values)
    np.testing.assert_array_equal(
        table["energy_mean_upwind"].to_numpy(), study.energy_mean.sel(row="upwind")
    )
    assert table.schema.field("energy_mean_upwind").metadata == {b"units": b"J"}
    assert table["wind_speed"].to_pylist() == [12.0, 12.0, 14.0, 14.0]


def test_a_parameter_of_numbers_and_words_is_text_in_the_summary(tmp_path, load_files, content):
    import pyarrow.parquet as pq

    varied = content | {"variations": {"grid": {"oil_supply": {"values": [0.5, "flooded"]}}}}
    run_study(study_of(varied, load_files), tmp_path / "out")
    table = pq.read_table(tmp_path / "out" / "summary.parquet")
    assert table["oil_supply"].to_pylist() == [*["0.5", "flooded"] * 4]


def test_every_name_of_a_file_is_data(tmp_path, content, write_loads):
    """Names with escapes, markup and ways out of the folder are labels, and nothing else."""
    for name in (
        "12mps_seed1.csv",
        "[red]x\x1b[2J_12mps_seed2.csv",
        "$(touch made) 12mps_seed3.csv",
    ):
        write_loads(tmp_path / "runs" / name)
    (tmp_path / "runs" / name).write_text("")
    for number, pattern in enumerate(
        ("runs/*seed{seed:d}.csv", f"../{tmp_path.name}/runs/{{a}}_seed{{seed:d}}.csv")
    ):
        out = tmp_path / f"out{number}"
        run_study(
            study_of(content | {"loads": {"files": pattern, "kind": "main-bearing"}}, tmp_path), out
        )
        assert b"\x1b" not in (out / "log.txt").read_bytes()
        assert all(path.resolve().is_relative_to(out) for path in out.rglob("*"))
        names = {"manifest.json", "study.sqlite", "summary.parquet", "log.txt", "cases", "lock"}
        assert {path.name for path in out.iterdir()} == names
        assert all(set(path.stem) <= set("0123456789abcdef") for path in out.glob("cases/*/*"))
    assert not (tmp_path / "made").exists()


def test_a_manifest_of_another_study_stops_the_workers(tmp_path, load_files, content):
    from macroslip.study.work import StoreError, work

    out = tmp_path / "out"
    run_study(study_of(content, load_files), out)
    with pytest.raises(StoreError, match="another one was begun there"):
        work({"directory": str(out), "setup": "0" * 64, "run": "0" * 32})


def test_a_worker_of_another_version_stops_the_study(tmp_path, load_files, content, monkeypatch):
    monkeypatch.setattr("macroslip.study.work.program", lambda: "older")
    with pytest.raises(MacroslipError, match="another version of macroslip"):
        run_study(study_of(content, load_files), tmp_path / "out")


LOADS = BearingLoads.constant([0.0, -300e3, 10e3], 2.0, 10.0)


@pytest.mark.parametrize(
    "change",
    [
        {"drag": False}, {"rollers": [0]}, {"integrator": Radau(tolerance=1e-5)}, {"window": Window(start=1.0)},
        {"loads": LOADS.window(0.0, 9.0)}, {"loads": BearingLoads.constant([0.0, -300e3, 10.000001e3], 2.0, 10.0)},
        {"bearing": Case(loads=LOADS, laws=Laws.paper()).bearing.replace(diametral_clearance=1.3e-4)},
    ],
)  # fmt: skip
def test_any_change_of_input_changes_the_key_and_the_place_of_the_loads_does_not(
    change, monkeypatch
):
    case = Case(loads=LOADS, laws=Laws.paper())
    assert (
        case_key(dataclasses.replace(case, **change), {})
        != case_key(case, {})
        != case_key(case, {"keep": ["energy"]})
    )
    moved = BearingLoads(LOADS.time, LOADS.shaft_speed, LOADS.force, "elsewhere.csv")
    assert case_key(Case(loads=moved, laws=Laws.paper()), {}) == case_key(case, {})
    before = case_key(case, {})
    monkeypatch.setattr("macroslip.study.work.own_laws", lambda: ["def traction(): ..."])
    assert case_key(case, {}) != before


def test_rate_and_time_left(monkeypatch):
    """Runs that were there already tell nothing of the rest, and failures count as work."""
    now = 1000.0
    monkeypatch.setattr("macroslip.study.progress.time.monotonic", lambda: now)
    progress = Progress(10**6, started=now)
    progress.unchanged = 20
    now += 8.0
    assert (progress.done, progress.rate) == (20, 0.0)
    assert progress.line.endswith("0 a second, - left")
    progress.failed = 4
    assert progress.rate == 0.5 and progress.line.endswith("0.5 a second, 23 d 3 h left")
    progress.computed = 10**6 - 24
    assert progress.line.endswith("nothing left")
