"""The paper's study in one call: what is computed, judged, drawn and written."""

from __future__ import annotations

import json
import math
import re
import threading
import time
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

import macroslip
from macroslip.report.style import program_style, save
from macroslip.result.stored import to_netcdf
from macroslip.study.reader import stored_results
from macroslip.study.study_file import study_of
from macroslip.torque import TorqueHistory, computed_torque, torque_histories
from paper import figures as draw
from paper import studies
from paper.experiments import STATIC_LOADS, experiments, turns, varying_load
from paper.page import page
from paper.publish import published_together
from paper.studies import DETAILED_CASE, MODELS, PAPER
from paper.uncertainty import uncertainty, uncertainty_summary
from paper.verdicts import Statement, statements

SUMMARY, REPORT, STUDIES = "summary.json", "report.html", "studies"
Report = Callable[[str, int, int], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelRun:
    """What was computed under one model; `parts` and `uncertainty` only of contacts with microslip."""

    study: xr.Dataset
    numbers: xr.Dataset
    turns: dict[str, dict[str, xr.Dataset]]
    detail_failed: int
    torque: xr.Dataset
    parts: xr.Dataset | None = None
    uncertainty: xr.Dataset | None = None

    @property
    def failures(self) -> dict[str, int]:
        """Failed integrations by place."""
        return {
            "study": int((self.study.status != 0).sum()),
            "single_rollers": sum(
                turn.status != 0 for group in self.turns.values() for turn in group.values()
            ),
            "detailed_case": self.detail_failed,
            "uncertainty": self.uncertainty.attrs["failed"] if self.uncertainty is not None else 0,
        }


def of_model(name: str, model: str) -> str:
    """Name of a figure or file of one model; those of the paper's have no ending."""
    return name if model == PAPER else f"{name}_{model}"


def compute_model(
    name: str,
    directory: Path,
    threads: int | None,
    report: Report,
    reused: list[str],
    *,
    sampled: bool,
) -> ModelRun:
    """Compute one model; studies go on from what is there of them.

    `reused` takes the names of studies that were whole. Where it is `sampled`, the sample over estimated values is
    computed too, of contacts with microslip.
    """
    laws = MODELS[name]
    contacts = {}

    def results(prefix: str, stage: str, *, may_fail: bool = False) -> Path:
        study, folder = study_of(studies.content(prefix, name)), directory / f"{prefix}_{name}"
        progress = partial(report, f"{stage} ({name})")
        if not studies.compute(
            study, folder, may_fail=may_fail, threads=threads, progress=progress
        ):
            reused.append(folder.name)
        return folder

    study = studies.paper_study(results("study", "study"))
    _, detail = next(stored_results(results("detail", "one case in detail")))
    traced = turns(detail, laws, threads, partial(report, f"single rollers ({name})"))
    if laws.microslip:
        contacts["parts"] = studies.dissipation(study)
    if laws.microslip and sampled:
        sample = uncertainty(results("uncertainty", "uncertainty", may_fail=True))
        contacts["uncertainty"] = uncertainty_summary(sample)
    return ModelRun(
        study=study,
        numbers=studies.paper_numbers(study),
        turns=traced,
        detail_failed=int((detail.status != 0).sum()),
        torque=computed_torque(detail),
        **contacts,
    )


def bearing_torques(runs: Mapping[str, ModelRun]) -> dict[str, TorqueHistory]:
    """Friction torque of the bearing in the detailed case under every model, and by handbooks."""
    case = macroslip.Case(loads=macroslip.HubLoads.bundled(DETAILED_CASE))
    computed = {name: run.torque for name, run in runs.items()}
    return torque_histories(computed, varying_load(), case.bearing, case.lubricant)


def experiment_figures(made: Mapping[str, xr.Dataset]) -> dict[str, Callable[[], Figure]]:
    """How the figures of the experiments are drawn, by file name."""
    return {
        "figure_A1": partial(draw.stability_figure, made["A1"]),
        "nonlinear_tolerance": partial(
            draw.nonlinear_tolerance_figure, made["nonlinear_tolerance"]
        ),
        "step_size": partial(draw.step_size_figure, made["step_size"]),
    }


def model_figures(name: str, run: ModelRun) -> dict[str, Callable[[], Figure]]:
    """How the figures of a model are drawn, by file name."""
    static = {f"{title} load": run.turns["static"][f"{title}, downwind"] for title in STATIC_LOADS}
    figures = {
        "figure_3a": partial(draw.turns_figure, static),
        "figure_3b": partial(draw.turns_figure, run.turns["typical"]),
        "figure_3b_peak": partial(draw.turns_figure, run.turns["peak"]),
        "figure_4a": partial(draw.energy_figure, run.numbers),
        "figure_4b": partial(draw.ratio_figure, run.numbers, "energy_ratio"),
        "figure_5a": partial(draw.peak_power_figure, run.numbers),
        "figure_5b": partial(draw.ratio_figure, run.numbers, "peak_power_ratio"),
    }
    if run.parts is not None:
        figures["mechanisms"] = partial(draw.mechanisms_figure, run.parts)
    if run.uncertainty is not None:
        figures["uncertainty"] = partial(draw.uncertainty_figure, run.uncertainty)
    return {of_model(title, name): figure for title, figure in figures.items()}


def joint_figures(
    runs: Mapping[str, ModelRun], torques: Mapping[str, TorqueHistory]
) -> dict[str, Callable[[], Figure]]:
    """How the figures of all models together are drawn, by file name."""
    return {
        "friction_torque": partial(draw.torque_figure, torques, *draw.TORQUE_WINDOW),
        "figures_4_5_models": partial(
            draw.models_figure, {name: run.numbers for name, run in runs.items()}
        ),
    }


def draw_all(jobs: Mapping[str, Callable[[], Figure]], folder: Path, report: Report) -> None:
    """Draw figures into a folder."""
    for done, (name, figure) in enumerate(jobs.items(), start=1):
        with program_style():
            save(figure(), folder, name)
        report("figures", done, len(jobs))


def failed_integrations(
    runs: Mapping[str, ModelRun], made: Mapping[str, xr.Dataset]
) -> dict[str, int]:
    """Failed integrations by place, all models together. Explicit Euler may fail in A1: it is there to show that."""
    counts = [run.failures for run in runs.values()]
    beside = sum(made["A1"].attrs[f"status_{name}"] != 0 for name in ("backward", "converged"))
    for name in ("nonlinear_tolerance", "step_size"):
        beside += sum(
            int(counted.sum())
            for key, counted in made[name].data_vars.items()
            if str(key).startswith("failed")
        )
    return {stage: sum(count[stage] for count in counts) for stage in counts[0]} | {
        "experiments": beside
    }


def headline(
    judged: Mapping[str, Mapping[str, Statement]], failed: Mapping[str, int], total: int
) -> list[str]:
    """What failed, and each statement with what every model gives, a line each."""
    counts = ", ".join(
        f"{count} in {stage.replace('_', ' ')}" for stage, count in failed.items() if count
    )
    lines = [
        f"{f'FAILED INTEGRATIONS: {counts}' if counts else 'No integration failed, explicit Euler in A1 not counted'} (the study has {total} rollers)."
    ]
    for subject, first in next(iter(judged.values())).items():
        by_model = "; ".join(
            f"{model}: {statements[subject].verdict} ({statements[subject].summary})"
            for model, statements in judged.items()
        )
        lines.append(f"Paper: {first.paper}. {by_model}.")
    return lines


def told(judged: Mapping[str, Mapping[str, Statement]]) -> list[dict[str, Any]]:
    """Statements as plain data: what the paper states, each with what every model gives."""
    return [
        {
            "paper": first.paper,
            "models": {
                model: {
                    "verdict": statements[subject].verdict,
                    "found": statements[subject].summary,
                    "because": statements[subject].because,
                    "numbers": statements[subject].numbers,
                }
                for model, statements in judged.items()
            },
        }
        for subject, first in next(iter(judged.values())).items()
    ]


def plotted(runs: Mapping[str, ModelRun], made: Mapping[str, xr.Dataset]) -> dict[str, Any]:
    """Every plotted number, by figure, as plain data with units; of the torque the means."""
    numbers: dict[str, Any] = {}
    for model, run in runs.items():
        of_run: dict[str, Any] = {
            name: {title: turn.to_dict(data="list") for title, turn in run.turns[group].items()}
            for name, group in (("3a", "static"), ("3b", "typical"), ("3b_peak", "peak"))
        }
        for name, shown in (
            ("4a", "energy$|energy_(?!ratio)|both"),
            ("5a", "peak_power_(mean|std)"),
        ):
            of_run[name] = run.numbers[
                [variable for variable in run.numbers if re.match(shown, str(variable))]
            ].to_dict(data="list")
        for name, shown in (("4b", "energy_ratio"), ("5b", "peak_power_ratio")):
            of_run[name] = run.numbers[[shown]].to_dict(data="list")
        torque = run.torque.mean("time", keep_attrs=True)
        tables = {
            "friction_torque": torque,
            "mechanisms": run.parts,
            "uncertainty": run.uncertainty,
        }
        of_run |= {
            name: table.to_dict(data="list") for name, table in tables.items() if table is not None
        }
        numbers |= {of_model(name, model): value for name, value in of_run.items()}
    return numbers | {name: experiment.to_dict(data="list") for name, experiment in made.items()}


def plain(value: Any) -> Any:
    """Lists, dicts, text and numbers only; NaN and infinity, which JSON lacks, become None."""
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple, np.ndarray)):
        return [plain(item) for item in value]
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and not math.isfinite(value) else value


def as_json(summary: dict[str, Any]) -> str:
    """Indented, with every list of numbers on one line."""
    text = json.dumps(summary, indent=1, ensure_ascii=False, allow_nan=False)
    return (
        re.sub(r"\[[\s\d.eE+\-,nul]+\]", lambda match: " ".join(match.group().split()), text) + "\n"
    )


class _StoppedError(Exception):
    """The reproduction was ended; what is under way is thrown away."""


class Stages:
    """Wall time of every stage, and whether they are to go on; stages of two models overlap.

    `progress` is called as progress(stage, done, total).
    """

    def __init__(self, progress: Report | None):
        self._progress = progress
        self._guard = threading.Lock()
        self._clocks: dict[int, float] = {}
        self.seconds: dict[str, float] = {}
        self.stop = threading.Event()

    def begin(self) -> None:
        """Let the first stage of this thread begin now."""
        self._clocks[threading.get_ident()] = time.perf_counter()

    def report(self, stage: str, done: int, total: int) -> None:
        """Tell how far a stage of this thread is."""
        if self.stop.is_set():
            raise _StoppedError
        with self._guard:
            self.seconds.setdefault(stage, 0.0)
            if done == total:
                now = time.perf_counter()
                spent = now - self._clocks[threading.get_ident()]
                self.seconds[stage] = round(self.seconds[stage] + spent, 2)
                self._clocks[threading.get_ident()] = now
            if self._progress:
                self._progress(stage, done, total)


@dataclass(frozen=True, slots=True)
class Lane:
    """What the stages of every model need."""

    directory: Path  #: Of the studies
    threads: int | None
    stages: Stages
    reused: list[str]  #: Takes the names of studies that were whole
    sampled: bool

    def model(self, name: str) -> ModelRun:
        """Compute a model."""
        self.stages.begin()
        return compute_model(
            name,
            self.directory,
            self.threads,
            self.stages.report,
            self.reused,
            sampled=self.sampled,
        )

    def experiments(self) -> dict[str, xr.Dataset]:
        """Compute the experiments, from the detailed case of the paper's model."""
        self.stages.begin()
        _, detail = next(stored_results(self.directory / f"detail_{PAPER}"))
        return experiments(detail, self.threads, partial(self.stages.report, "experiments"))


def computed(lane: Lane, folder: Path) -> tuple[dict[str, ModelRun], dict[str, xr.Dataset]]:
    """Compute all models and the experiments, side by side, and draw what is ready meanwhile.

    One model's cases keep a processor busy while tables or results of the other's are made.
    """
    runs: dict[str, ModelRun] = {}
    with ThreadPoolExecutor(len(MODELS) + 1) as pool:
        try:
            jobs = {name: pool.submit(lane.model, name) for name in MODELS}
            runs[PAPER] = jobs[PAPER].result()
            beside = pool.submit(lane.experiments)
            lane.stages.begin()
            draw_all(model_figures(PAPER, runs[PAPER]), folder, lane.stages.report)
            made = beside.result()
            lane.stages.begin()
            draw_all(experiment_figures(made), folder, lane.stages.report)
            runs = {name: job.result() for name, job in jobs.items()}
        except BaseException:
            lane.stages.stop.set()
            raise
    return runs, made


def reproduce(
    directory: Path,
    *,
    threads: int | None = None,
    progress: Report | None = None,
    sampled: bool = False,
) -> dict[str, Any]:
    """Compute, judge and draw the paper's study; return what `summary.json` holds, where NaN is None.

    With `sampled` the sample over values that were estimated is computed too, which takes as long as a model's study.

    Its studies are computed as any study is: a run that was stopped goes on where it ended, and what an earlier run into
    the same folder computed is used again as long as its inputs and the program are the same. All other files are written
    at the end, over those of an earlier run. `progress` is called as progress(stage, done, total).
    """
    stages = Stages(progress)
    report = stages.report
    directory = Path(directory)
    reused: list[str] = []
    with published_together(directory, SUMMARY) as folder:
        lane = Lane(directory / STUDIES, threads, stages, reused, sampled)
        runs, made = computed(lane, folder)
        stages.begin()
        judged = {
            name: statements(
                name,
                run.study,
                run.numbers,
                run.turns["static"],
                made["A1"] if name == PAPER else None,
            )
            for name, run in runs.items()
        }
        for name, run in runs.items():
            # In memory first: the HDF5 library may bring the whole process down when the disk is full.
            (folder / f"{of_model('study', name)}.nc").write_bytes(to_netcdf(run.study))
        failed, total = (
            failed_integrations(runs, made),
            sum(run.study.status.size for run in runs.values()),
        )
        by_case = {}
        for name, run in runs.items():
            counts = (run.study.status != 0).sum(("row", "roller"))
            by_case |= {
                of_model(str(failed_of_case.case.item()), name): int(failed_of_case)
                for failed_of_case in counts
                if failed_of_case
            }
        summary = plain(
            {
                "program": f"macroslip {macroslip.__version__}",
                "headline": headline(judged, failed, total),
                "statements": told(judged),
                "failed_rollers": failed | {"study_by_case": by_case, "study_total": total},
                "conventions": (Path(__file__).parent / "conventions.txt")
                .read_text(encoding="utf-8")
                .splitlines(),
                "seconds": stages.seconds,
                "reused": sorted(reused),
                "figures": plotted(runs, made),
                "study": {name: run.study.to_dict(data="list") for name, run in runs.items()},
            }
        )
        torques = bearing_torques(runs)
        jobs = joint_figures(runs, torques)
        for name, run in runs.items():
            jobs |= model_figures(name, run) if name != PAPER else {}
        draw_all(jobs, folder, report)
        summary["seconds"] = dict(stages.seconds)
        (folder / REPORT).write_text(
            page(folder, runs, made, judged, torques, summary), encoding="utf-8"
        )
        report("report", 1, 1)
        summary["seconds"] = dict(stages.seconds)
        (folder / SUMMARY).write_text(as_json(summary), encoding="utf-8")
    return summary
