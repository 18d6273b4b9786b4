"""The reproduction of the paper in one call: what is computed, judged, drawn and written."""

from __future__ import annotations

import importlib.util
import time
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import macroslip
from macroslip.errors import MacroslipError
from macroslip.files import published_together
from macroslip.integrate.ahead import compile_ahead
from macroslip.reproduction.figure_files import figures, save_figures
from macroslip.reproduction.headline import failure_line, numerical_line, statement_lines
from macroslip.reproduction.model_run import (
    MODEL_STAGES,
    MODELS,
    PAPER,
    ModelRun,
    StageReport,
    compute_model,
    failures,
    stage_label,
    statements,
    varying_load,
)
from macroslip.reproduction.page_process import page_written
from macroslip.reproduction.single_roller import largest_peak, static_load
from macroslip.reproduction.solver_experiments import nonlinear_tolerance, step_size
from macroslip.reproduction.stability import compare_stability
from macroslip.reproduction.studies import FOLDER
from macroslip.reproduction.summary import (
    CONVENTIONS,
    as_json,
    failed_by_case,
    of_model,
    plain,
    plotted,
    told_statements,
)
from macroslip.result.stored import to_netcdf

if TYPE_CHECKING:
    import xarray as xr

SUMMARY, STUDY, REPORT = "summary.json", "study.nc", "report.html"


def stages() -> dict[str, float]:
    """Labels of the stages in their order, and what each takes of the time, in proportion, as measured once."""
    shares: dict[str, float] = {}
    for name in MODELS:
        of_one = {stage_label(stage, name): share[name != PAPER] for stage, share in MODEL_STAGES.items()}
        shares |= {label: share for label, share in of_one.items() if share}
    return shares | {"experiments": 7.0, "figures": 8.0, "report": 7.0}


def reproduce(directory: Path, *, threads: int | None = None, progress: StageReport | None = None) -> dict[str, Any]:
    """Reproduce the paper's study and figures with converged solutions, and judge its statements.

    Its studies are computed as any study is: a run that was stopped goes on where it ended, and what an earlier run into
    the same folder computed is used again as long as its inputs and this program are the same.

    Parameters
    ----------
    directory : Path
        Folder for `report.html`, `summary.json`, `study.nc`, the figures (PNG and SVG) and, under `studies`, the
        results of the studies. Files of an earlier run are overwritten, all at the end; others stay.
    threads : int, optional
        Threads over rollers; the number of usable processors by default.
    progress : callable, optional
        Called as progress(stage, done, total) with the stages of `compute_model`, "experiments", "figures", "report".

    Returns
    -------
    dict
        What `summary.json` holds: `headline`, `statements`, `failed_rollers`, `conventions`, `figures` with every
        plotted number and its units, `seconds` by stage, and the studies whose results were there and are `reused`.
        NaN is None.

    Raises
    ------
    MacroslipError
        If matplotlib or jinja2 is not installed; nothing is computed then.
    InputError
        If `directory` is a file.
    """
    for name in ("matplotlib", "jinja2"):
        if importlib.util.find_spec(name) is None:
            raise MacroslipError(f"figures need {name}, which is not installed: pip install 'macroslip[figures]'")
    clock, seconds = time.perf_counter(), {}

    def report(stage: str, done: int, total: int) -> None:
        nonlocal clock
        if done == total:
            seconds[stage] = round(seconds.get(stage, 0.0) + time.perf_counter() - clock, 2)
            clock = time.perf_counter()
        if progress:
            progress(stage, done, total)

    directory = Path(directory)
    compile_ahead(physical=True)
    reused: list[str] = []
    with published_together(directory, SUMMARY) as folder:
        runs = {name: compute_model(name, directory / FOLDER, threads, report, reused) for name in MODELS}
        experiments = _experiments(runs[PAPER], threads, report)
        judged = {name: statements(run, experiments if name == PAPER else {}) for name, run in runs.items()}
        for name, run in runs.items():
            # In memory first: the HDF5 library may bring the whole process down when the disk is full.
            (folder / f"{of_model('study', name)}.nc").write_bytes(to_netcdf(run.study))
        failed = _failed(runs, experiments)
        total = sum(run.study.status.size for run in runs.values())
        headline = [
            failure_line(failed, total),
            *statement_lines(judged),
            numerical_line(experiments["nonlinear_tolerance"], experiments["step_size"]),
        ]
        by_case = {
            of_model(case, name): count
            for name, run in runs.items()
            for case, count in failed_by_case(run.study).items()
        }
        summary = plain(
            {
                "program": f"macroslip {macroslip.__version__}",
                "headline": headline,
                "statements": told_statements(judged),
                "failed_rollers": failed | {"study_by_case": by_case, "study_total": total},
                "conventions": CONVENTIONS,
                "seconds": seconds,
                "reused": reused,
                "figures": plotted(runs, experiments),
                "study": {name: run.study.to_dict(data="list") for name, run in runs.items()},
            }
        )
        with page_written(folder / REPORT, runs, experiments, judged, summary):
            save_figures(figures(runs, experiments), folder, report)
        report("report", 1, 1)
        summary["seconds"] = dict(seconds)
        (folder / SUMMARY).write_text(as_json(summary), encoding="utf-8")
    return summary


def _experiments(run: ModelRun, threads: int | None, report: StageReport) -> dict[str, xr.Dataset]:
    """What the numerical method does, under the paper's model."""
    varying, result = varying_load(), run.profile["result"]
    _, orbit = largest_peak(result, "upwind")
    # Two orbits before the largest peak and one after it.
    start = max(float(result.orbit_start[orbit]) - 14.0, float(varying.time[0]))
    end = min(float(result.orbit_end[orbit]) + 7.0, float(varying.time[-1]))
    jobs = {
        "A1": lambda: compare_stability(static_load(varying, thrust=False, duration=4.0)),
        "nonlinear_tolerance": lambda: nonlinear_tolerance(varying, threads=threads),
        "step_size": lambda: step_size(varying, start=start, end=end, threads=threads),
    }
    found = {}
    for done, (name, job) in enumerate(jobs.items(), start=1):
        found[name] = job()
        report("experiments", done, len(jobs))
    return found


def _failed(runs: Mapping[str, ModelRun], experiments: Mapping[str, xr.Dataset]) -> dict[str, int]:
    """Failed integrations by place, all models together. Explicit Euler may fail in A1: it is there to show that."""
    counts = [failures(run) for run in runs.values()]
    stability = experiments["A1"].attrs
    beside = [int(stability[f"status_{name}"] != 0) for name in ("backward", "converged")]
    for name in ("nonlinear_tolerance", "step_size"):
        beside += [int(experiments[name][one].sum()) for one in experiments[name].data_vars if one.startswith("failed")]
    return {place: sum(count[place] for count in counts) for place in counts[0]} | {"experiments": sum(beside)}
