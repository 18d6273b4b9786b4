"""Everything the reproduction computes under one model: study, single rollers, one case in detail, sensitivity."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

from macroslip.bearing.geometry import ROWS
from macroslip.case.case import Case
from macroslip.loads import Drivetrain, HubLoads, main_bearing_load
from macroslip.machine import usable_processors
from macroslip.mechanisms import Laws
from macroslip.reproduction import verdicts
from macroslip.reproduction.dissipation import explained, knows_mechanisms
from macroslip.reproduction.paper_numbers import paper_numbers
from macroslip.reproduction.paper_study import paper_study
from macroslip.reproduction.sensitivity import sensitivity
from macroslip.reproduction.single_roller import inflexion_angle, peak_turn, static_turn, typical_turn
from macroslip.reproduction.statement import Statement, not_computed
from macroslip.reproduction.studies import base_case, computed, reproduction_study
from macroslip.reproduction.uncertainty import uncertainty
from macroslip.reproduction.uncertainty_summary import uncertainty_summary, with_uncertainty
from macroslip.result.orbit_profile import orbit_profile
from macroslip.study.reader import stored_results
from macroslip.study.study import Study
from macroslip.torque import TorqueHistory, computed_torque, torque_histories

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.loads import BearingLoads


#: Mechanisms of the models by name. A roller under `physical` takes about three times as long as under `paper`.
MODELS: Mapping[str, Laws] = MappingProxyType({"paper": Laws.paper(), "physical": Laws.physical()})
#: The model of the paper, under which the numerical experiments are computed.
PAPER = "paper"
#: The case shown in detail, whose means are the static load.
DETAILED_CASE = "14B"
STATIC_LOADS = {"downward": False, "downward and thrust": True}
#: Part of the detailed case whose friction torque is drawn [s].
TORQUE_WINDOW = (300.0, 360.0)

#: What is computed under each model, in its order, and what that takes of the time under `paper` and others, in
#: proportion.
MODEL_STAGES = {
    "study": (28.0, 85.0),
    "one case in detail": (5.0, 20.0),
    "single rollers": (2.0, 15.0),
    "sensitivity": (7.0, 15.0),
    "uncertainty": (0.0, 145.0),
}

StageReport = Callable[[str, int, int], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelRun:
    """What was computed under one model.

    Parameters
    ----------
    study : xarray.Dataset
        From `paper_study`.
    numbers : xarray.Dataset
        From `paper_numbers`.
    turns : dict
        Traced turns by figure ("static", "typical", "peak") and title.
    profile : dict
        From `orbit_profile`: the detailed case; and "torque", from `computed_torque`.
    sensitivity : xarray.Dataset
        From `sensitivity`.
    uncertainty : xarray.Dataset or None
        From `uncertainty_summary`; None under the paper's model.
    """

    study: xr.Dataset
    numbers: xr.Dataset
    turns: dict[str, dict[str, xr.Dataset]]
    profile: dict[str, xr.Dataset]
    sensitivity: xr.Dataset
    uncertainty: xr.Dataset | None = None


def stage_label(stage: str, model: str) -> str:
    """Label of one of `MODEL_STAGES` under a model; that of the paper goes without saying."""
    return stage if model == PAPER else f"{stage} ({model})"


def compute_model(
    name: str, directory: Path, threads: int | None, report: StageReport, reused: list[str] | None = None
) -> ModelRun:
    """Compute one model; studies go on from what is there of them.

    Parameters
    ----------
    name : str
        One of `MODELS`.
    directory : Path
        Folder with a folder for the results of every study.
    threads : int or None
    report : callable
        Called as report(label, done, total) with the labels of `MODEL_STAGES`.
    reused : list of str, optional
        Takes the names of studies whose results were all there.
    """
    laws = MODELS[name]

    def of(stage: str) -> Callable[[int, int], None]:
        return lambda done, total: report(stage_label(stage, name), done, total)

    def results_of(prefix: str, stage: str, *, may_fail: bool = False) -> tuple[Study, Path]:
        title = f"{prefix}_{name}"
        study, folder = reproduction_study(title), directory / title
        if not computed(study, folder, may_fail=may_fail, threads=threads, progress=of(stage)) and reused is not None:
            reused.append(title)
        return study, folder

    study = paper_study(results_of("study", "study")[1])
    _, traced = next(stored_results(results_of("detail", "one case in detail")[1]))
    profile = orbit_profile(traced) | {"torque": computed_torque(traced)}
    of("one case in detail")(1, 1)
    turns = _turns(profile["result"], laws, threads, of("single rollers"))
    varied, folder = results_of("sensitivity", "sensitivity", may_fail=True)
    table = sensitivity(folder, base_case(varied))
    ranges = None
    if laws.microslip:
        ranges = uncertainty_summary(uncertainty(results_of("uncertainty", "uncertainty", may_fail=True)[1]))
    return ModelRun(
        study=study, numbers=paper_numbers(study), turns=turns, profile=profile, sensitivity=table, uncertainty=ranges
    )


def varying_load() -> BearingLoads:
    """Load on the main bearing in the detailed case."""
    return main_bearing_load(HubLoads.bundled(DETAILED_CASE), Drivetrain())


def bearing_torques(runs: Mapping[str, ModelRun]) -> dict[str, TorqueHistory]:
    """Friction torque of the bearing in the detailed case under every model, and by handbooks."""
    case = Case(loads=HubLoads.bundled(DETAILED_CASE))
    computed = {name: run.profile["torque"] for name, run in runs.items()}
    return torque_histories(computed, varying_load(), case.bearing, case.lubricant)


def _turns(
    result: xr.Dataset, laws: Laws, threads: int | None, report: Callable[[int, int], None]
) -> dict[str, dict[str, xr.Dataset]]:
    """Traced turns by figure and column; the static ones of both rows under "static"."""
    varying = varying_load()
    jobs = {
        ("static", f"{name}, {row}"): partial(static_turn, varying, row, thrust=thrust, laws=laws)
        for name, thrust in STATIC_LOADS.items()
        for row in ROWS
    }
    for name, trace in (("typical", typical_turn), ("peak", peak_turn)):
        jobs |= {(name, f"{row} row"): partial(trace, varying, result, row, laws) for row in ROWS}
    with ThreadPoolExecutor(threads or usable_processors()) as pool:
        futures = {place: pool.submit(job) for place, job in jobs.items()}
        for done, _ in enumerate(as_completed(futures.values()), start=1):
            report(done, len(jobs))
        turns: dict[str, dict[str, xr.Dataset]] = {}
        for (figure, column), future in futures.items():
            turns.setdefault(figure, {})[column] = future.result()
        return turns


def statements(run: ModelRun, experiments: Mapping[str, xr.Dataset]) -> dict[str, Statement]:
    """The paper's statements, judged by what was computed under one model.

    Parameters
    ----------
    run : ModelRun
    experiments : mapping
        "A1", "nonlinear_tolerance" and "step_size", as far as they were computed under this model.

    Returns
    -------
    dict of str to Statement
        By subject, the same eight for every model; where one needs what was not computed, "not computed".
    """
    static = run.turns["static"]
    energies = {name: {row: static[f"{name}, {row}"].attrs["energy_J"] for row in ROWS} for name in STATIC_LOADS}
    thrust = energies["downward and thrust"]["downwind"]
    downward = static["downward, downwind"]
    found = {
        "energy": verdicts.energy_over_wind_speed(run.numbers, run.study),
        "rows": verdicts.energy_between_rows(run.numbers, thrust),
        "peaks": verdicts.peak_power_over_wind_speed(run.numbers),
        "peak ratio": verdicts.peak_power_between_rows(run.numbers, experiments.get("step_size")),
        "unloaded": verdicts.unloaded_roller(downward, inflexion_angle(downward)),
        "static": verdicts.varying_over_static(
            run.numbers, DETAILED_CASE, energies, experiments.get("nonlinear_tolerance")
        ),
        "cage": verdicts.cage_dominates(run.study),
        "Euler": verdicts.euler_stability(experiments["A1"]) if "A1" in experiments else not_computed(verdicts.EULER),
    }
    if knows_mechanisms(run.study):
        found = explained(found, run.study, run.numbers)
    return with_uncertainty(found, run.uncertainty) if run.uncertainty is not None else found


def failures(run: ModelRun) -> dict[str, int]:
    """Failed integrations of a model by place."""
    return {
        "study": int((run.study.status != 0).sum()),
        "single_rollers": sum(turn.attrs["status"] != 0 for group in run.turns.values() for turn in group.values()),
        "detailed_case": int((run.profile["result"].status != 0).sum()),
        "sensitivity": int(run.sensitivity.failed.sum()),
        "uncertainty": run.uncertainty.attrs["failed"] if run.uncertainty is not None else 0,
    }
