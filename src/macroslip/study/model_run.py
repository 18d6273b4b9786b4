"""Everything the reproduction computes under one model: study, single rollers, one case in detail, sensitivity."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from macroslip.bearing.frames import ROWS
from macroslip.loads import Drivetrain, HubLoads, bundled_cases, main_bearing_load
from macroslip.study import verdicts
from macroslip.study.case import Case, Traces
from macroslip.study.orbit_profile import orbit_profile
from macroslip.study.paper_numbers import paper_numbers
from macroslip.study.paper_study import run_study
from macroslip.study.reuse import Reuse
from macroslip.study.sensitivity import VARIATIONS, sensitivity
from macroslip.study.simulate import simulate
from macroslip.study.single_roller import inflexion_angle, peak_turn, static_turn, typical_turn

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.loads import BearingLoads

#: Models by name, and what a case is given to choose them.
MODELS: Mapping[str, Mapping[str, Any]] = MappingProxyType({"paper": MappingProxyType({})})
#: The model of the paper, under which its single rollers and the numerical experiments are computed.
PAPER = "paper"
#: The case shown in detail, whose means are the static load.
DETAILED_CASE = "14B"
STATIC_LOADS = {"downward": False, "downward and thrust": True}
#: Time between the samples of the traces [s]; that of the loads.
TRACE_STEP = 0.05

#: What is computed under each model, in its order, and what that takes of the time, in proportion.
MODEL_STAGES = {"study": 28.0, "single rollers": 2.0, "one case in detail": 5.0, "sensitivity": 7.0}

Progress = Callable[[str, int, int], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelRun:
    """What was computed under one model.

    Parameters
    ----------
    study : xarray.Dataset
        From `run_study`.
    numbers : xarray.Dataset
        From `paper_numbers`.
    turns : dict
        Traced turns by figure ("static", "typical", "peak") and title; empty where the model has none.
    profile : dict
        From `orbit_profile`: the detailed case.
    sensitivity : xarray.Dataset
        From `sensitivity`.
    """

    study: xr.Dataset
    numbers: xr.Dataset
    turns: dict[str, dict[str, xr.Dataset]]
    profile: dict[str, xr.Dataset]
    sensitivity: xr.Dataset


def stage_label(stage: str, model: str) -> str:
    """Label of one of `MODEL_STAGES` under a model; that of the paper goes without saying."""
    return stage if model == PAPER else f"{stage} ({model})"


def compute_model(name: str, reuse: Reuse, threads: int | None, report: Progress) -> ModelRun:
    """Compute one model, or read what is known of it.

    Parameters
    ----------
    name : str
        One of `MODELS`.
    reuse : Reuse
    threads : int or None
    report : callable
        Called as report(label, done, total) with the labels of `MODEL_STAGES`.
    """
    choices = MODELS[name]

    def told(stage: str) -> Callable[[int, int], None]:
        return lambda done, total: report(stage_label(stage, name), done, total)

    detailed = Case(loads=HubLoads.bundled(DETAILED_CASE), **choices)
    whole = [Case(loads=HubLoads.bundled(one), **choices).as_dict() for one in bundled_cases()]
    study = reuse.part(
        f"study-{name}", whole,
        lambda: {"study": run_study(threads=threads, progress=told("study"), **choices)},
    )["study"]
    told("study")(1, 1)
    turns: dict[str, dict[str, xr.Dataset]] = {}
    if name == PAPER:
        stored = reuse.part("turns", detailed.as_dict(), lambda: _turns(threads, told("single rollers")))
        for title, turn in stored.items():
            group, _, rest = title.partition(": ")
            turns.setdefault(group, {})[rest] = turn
        told("single rollers")(1, 1)
    traced = Case(loads=detailed.loads, traces=Traces(step=TRACE_STEP), **choices)
    profile = reuse.part(
        f"detail-{name}", traced.as_dict(), lambda: orbit_profile(simulate(traced, threads=threads))
    )
    told("one case in detail")(1, 1)
    limits = [[one.name, one.low, one.high] for one in VARIATIONS]
    table = reuse.part(
        f"sensitivity-{name}", [detailed.as_dict(), limits],
        lambda: {"table": sensitivity(detailed, threads=threads, progress=told("sensitivity"))},
    )["table"]
    told("sensitivity")(1, 1)
    return ModelRun(
        study=study, numbers=paper_numbers(study), turns=turns, profile=profile, sensitivity=table
    )


def varying_load() -> BearingLoads:
    """Load on the main bearing in the detailed case."""
    return main_bearing_load(HubLoads.bundled(DETAILED_CASE), Drivetrain())


def _turns(threads: int | None, report: Callable[[int, int], None]) -> dict[str, xr.Dataset]:
    """Traced turns by "figure: column"; the static ones of both rows under "static"."""
    varying = varying_load()
    result = simulate(Case(loads=varying), threads=threads)
    jobs = [(f"static: {name}, {row}", static_turn, (varying, row), {"thrust": thrust})
            for name, thrust in STATIC_LOADS.items() for row in ROWS]
    jobs += [(f"typical: {row} row", typical_turn, (varying, result, row), {}) for row in ROWS]
    jobs += [(f"peak: {row} row", peak_turn, (varying, result, row), {}) for row in ROWS]
    found = {}
    for done, (title, trace, arguments, options) in enumerate(jobs, start=1):
        found[title] = trace(*arguments, **options)
        report(done, len(jobs))
    return found


def statements(run: ModelRun, experiments: Mapping[str, xr.Dataset]) -> list[verdicts.Statement]:
    """The paper's statements, judged by what was computed under one model.

    Parameters
    ----------
    run : ModelRun
    experiments : mapping
        "A1", "nonlinear_tolerance" and "step_size", as far as they were computed under this model.

    Returns
    -------
    list of Statement
        Eight, in the same order for every model; where a statement needs what the model lacks, "not computed".
    """
    static = run.turns.get("static", {})
    energies = {
        name: {row: static[f"{name}, {row}"].attrs["energy_J"] for row in ROWS} for name in STATIC_LOADS if static
    }
    thrust = energies.get("downward and thrust", {}).get("downwind", float("nan"))
    downward = static.get("downward, downwind")
    found = [
        verdicts.energy_over_wind_speed(run.numbers, run.study),
        verdicts.energy_between_rows(run.numbers, thrust),
        verdicts.peak_power_over_wind_speed(run.numbers),
        verdicts.peak_power_between_rows(run.numbers, experiments.get("step_size")),
    ]
    if downward is None:
        found += [verdicts.not_computed(verdicts.UNLOADED), verdicts.not_computed(verdicts.VARYING)]
    else:
        found.append(verdicts.unloaded_roller(downward, inflexion_angle(downward)))
        found.append(
            verdicts.varying_over_static(run.numbers, DETAILED_CASE, energies, experiments.get("nonlinear_tolerance"))
        )
    found.append(verdicts.cage_dominates(run.study))
    if "A1" in experiments:
        return [*found, verdicts.euler_stability(experiments["A1"])]
    return [*found, verdicts.not_computed(verdicts.EULER)]


def failures(run: ModelRun) -> dict[str, int]:
    """Failed integrations of a model by place."""
    return {
        "study": int((run.study.status != 0).sum()),
        "single_rollers": sum(turn.attrs["status"] != 0 for group in run.turns.values() for turn in group.values()),
        "detailed_case": int((run.profile["result"].status != 0).sum()),
        "sensitivity": int(run.sensitivity.failed.sum()),
    }
