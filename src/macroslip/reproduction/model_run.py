"""Everything the reproduction computes under one model: study, single rollers, one case in detail, sensitivity."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import asdict, dataclass
from functools import partial
from types import MappingProxyType
from typing import TYPE_CHECKING

from macroslip.bearing.frames import ROWS
from macroslip.case.case import Case, Traces, Window
from macroslip.loads import Drivetrain, HubLoads, bundled_cases, main_bearing_load
from macroslip.mechanisms import Laws
from macroslip.reproduction import verdicts
from macroslip.reproduction.dissipation import explained, knows_mechanisms
from macroslip.reproduction.paper_numbers import paper_numbers
from macroslip.reproduction.paper_study import run_study
from macroslip.reproduction.reuse import Reuse
from macroslip.reproduction.sensitivity import sensitivity, variations_of
from macroslip.reproduction.single_roller import inflexion_angle, peak_turn, static_turn, typical_turn
from macroslip.reproduction.uncertain_values import VALUES
from macroslip.reproduction.uncertainty import CASES, END, ROLLERS, SAMPLES, SEED, uncertainty
from macroslip.reproduction.uncertainty_summary import uncertainty_summary, with_uncertainty
from macroslip.result.orbit_profile import orbit_profile
from macroslip.result.simulate import simulate, usable_processors
from macroslip.torque import TorqueHistory, computed_torque, torque_histories

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.loads import BearingLoads


@dataclass(frozen=True, slots=True, kw_only=True)
class Model:
    """A model of the reproduction, and how much of the work it gets.

    Parameters
    ----------
    laws : Laws
    rollers : "all" or tuple of int
        Rollers of each row in the study and the sensitivity.
    sensitivity_end : float, optional
        End of the sensitivity's window [s]; None: the end of the loads.
    """

    laws: Laws
    rollers: str | tuple[int, ...] = "all"
    sensitivity_end: float | None = None


#: Models by name. A roller under `physical` takes about ten times as long as under `paper`.
MODELS: Mapping[str, Model] = MappingProxyType(
    {
        "paper": Model(laws=Laws.paper()),
        "physical": Model(laws=Laws.physical(), rollers=tuple(range(0, 28, 4)), sensitivity_end=200.0),
    }
)
#: The model of the paper, under which the numerical experiments are computed.
PAPER = "paper"
#: The case shown in detail, whose means are the static load.
DETAILED_CASE = "14B"
STATIC_LOADS = {"downward": False, "downward and thrust": True}
#: Part of the detailed case whose friction torque is drawn [s].
TORQUE_WINDOW = (300.0, 360.0)
#: Time between the samples of the traces [s]; that of the loads.
TRACE_STEP = 0.05

#: What is computed under each model, in its order, and what that takes of the time under `paper` and others, in
#: proportion.
MODEL_STAGES = {
    "study": (28.0, 75.0),
    "one case in detail": (5.0, 20.0),
    "single rollers": (2.0, 15.0),
    "sensitivity": (7.0, 15.0),
    "uncertainty": (0.0, 70.0),
}

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
        Traced turns by figure ("static", "typical", "peak") and title.
    profile : dict
        From `orbit_profile`: the detailed case; and "torque", from `computed_torque`.
    sensitivity : xarray.Dataset
        From `sensitivity`.
    uncertainty : xarray.Dataset or None
        From `uncertainty`; None under the paper's model.
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
    model = MODELS[name]
    laws = model.laws

    def told(stage: str) -> Callable[[int, int], None]:
        return lambda done, total: report(stage_label(stage, name), done, total)

    loads = HubLoads.bundled(DETAILED_CASE)
    whole = [Case(loads=HubLoads.bundled(one), laws=laws, rollers=model.rollers).as_dict() for one in bundled_cases()]
    study = reuse.part(
        f"study-{name}",
        whole,
        lambda: {"study": run_study(rollers=model.rollers, laws=laws, threads=threads, progress=told("study"))},
    )["study"]
    told("study")(1, 1)
    traced = Case(loads=loads, traces=Traces(step=TRACE_STEP), laws=laws)
    profile = reuse.part(f"detail-{name}", traced.as_dict(), lambda: _detail(simulate(traced, threads=threads)))
    told("one case in detail")(1, 1)
    stored = reuse.part(
        f"turns-{name}", traced.as_dict(), lambda: _turns(profile["result"], laws, threads, told("single rollers"))
    )
    turns: dict[str, dict[str, xr.Dataset]] = {}
    for title, turn in stored.items():
        group, _, rest = title.partition(": ")
        turns.setdefault(group, {})[rest] = turn
    told("single rollers")(1, 1)
    varied = Case(loads=loads, laws=laws, rollers=model.rollers, window=Window(end=model.sensitivity_end))
    variations = variations_of(varied)
    limits = [[one.name, one.low, one.high] for one in variations]
    table = reuse.part(
        f"sensitivity-{name}",
        [varied.as_dict(), limits],
        lambda: {"table": sensitivity(varied, variations, threads=threads, progress=told("sensitivity"))},
    )["table"]
    told("sensitivity")(1, 1)
    sample = None
    if laws.microslip:
        sample = reuse.part(
            f"uncertainty-{name}",
            [
                [Case(loads=HubLoads.bundled(one), laws=laws).as_dict() for one in CASES],
                ROLLERS,
                END,
                SAMPLES,
                SEED,
                [asdict(one) for one in VALUES],
            ],
            lambda: {"sample": uncertainty(laws, threads=threads, progress=told("uncertainty"))},
        )["sample"]
        told("uncertainty")(1, 1)
    return ModelRun(
        study=study, numbers=paper_numbers(study), turns=turns, profile=profile, sensitivity=table, uncertainty=sample
    )


def varying_load() -> BearingLoads:
    """Load on the main bearing in the detailed case."""
    return main_bearing_load(HubLoads.bundled(DETAILED_CASE), Drivetrain())


def bearing_torques(runs: Mapping[str, ModelRun]) -> dict[str, TorqueHistory]:
    """Friction torque of the bearing in the detailed case under every model, and by handbooks."""
    case = Case(loads=HubLoads.bundled(DETAILED_CASE))
    computed = {name: run.profile["torque"] for name, run in runs.items()}
    return torque_histories(computed, varying_load(), case.bearing, case.lubricant)


def _detail(result: xr.Dataset) -> dict[str, xr.Dataset]:
    return orbit_profile(result) | {"torque": computed_torque(result)}


def _turns(
    result: xr.Dataset, laws: Laws, threads: int | None, report: Callable[[int, int], None]
) -> dict[str, xr.Dataset]:
    """Traced turns by "figure: column"; the static ones of both rows under "static"."""
    varying = varying_load()
    jobs = {
        f"static: {name}, {row}": partial(static_turn, varying, row, thrust=thrust, laws=laws)
        for name, thrust in STATIC_LOADS.items()
        for row in ROWS
    }
    for name, trace in (("typical", typical_turn), ("peak", peak_turn)):
        jobs |= {f"{name}: {row} row": partial(trace, varying, result, row, laws) for row in ROWS}
    with ThreadPoolExecutor(threads or usable_processors()) as pool:
        futures = {title: pool.submit(job) for title, job in jobs.items()}
        for done, _ in enumerate(as_completed(futures.values()), start=1):
            report(done, len(jobs))
        return {title: future.result() for title, future in futures.items()}


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
        Eight, in the same order for every model; where a statement needs what was not computed, "not computed".
    """
    static = run.turns["static"]
    energies = {name: {row: static[f"{name}, {row}"].attrs["energy_J"] for row in ROWS} for name in STATIC_LOADS}
    thrust = energies["downward and thrust"]["downwind"]
    downward = static["downward, downwind"]
    found = [
        verdicts.energy_over_wind_speed(run.numbers, run.study),
        verdicts.energy_between_rows(run.numbers, thrust),
        verdicts.peak_power_over_wind_speed(run.numbers),
        verdicts.peak_power_between_rows(run.numbers, experiments.get("step_size")),
    ]
    found.append(verdicts.unloaded_roller(downward, inflexion_angle(downward)))
    found.append(
        verdicts.varying_over_static(run.numbers, DETAILED_CASE, energies, experiments.get("nonlinear_tolerance"))
    )
    found.append(verdicts.cage_dominates(run.study))
    if "A1" in experiments:
        found.append(verdicts.euler_stability(experiments["A1"]))
    else:
        found.append(verdicts.not_computed(verdicts.EULER))
    if knows_mechanisms(run.study):
        found = explained(found, run.study, run.numbers)
    return with_uncertainty(found, uncertainty_summary(run.uncertainty)) if run.uncertainty is not None else found


def failures(run: ModelRun) -> dict[str, int]:
    """Failed integrations of a model by place."""
    return {
        "study": int((run.study.status != 0).sum()),
        "single_rollers": sum(turn.attrs["status"] != 0 for group in run.turns.values() for turn in group.values()),
        "detailed_case": int((run.profile["result"].status != 0).sum()),
        "sensitivity": int(run.sensitivity.failed.sum()),
        "uncertainty": int((run.uncertainty.outcome == 1).sum()) if run.uncertainty is not None else 0,
    }
