"""The opening of the reproduction's report: verdicts, the largest difference, what numerics do, what failed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.report import orbit_figures
from macroslip.report.page import Opening
from macroslip.report.pictures import OPENING_HEIGHT, OPENING_WIDTH, picture
from macroslip.report.wording import three_digits
from macroslip.reproduction import mechanism_figures, solver_figures
from macroslip.reproduction import wind_speed_figures as winds
from macroslip.reproduction.headline import failure_line
from macroslip.reproduction.marks import mark_level
from macroslip.reproduction.statement import AGREES, DIFFERS, PARTLY, UNKNOWN, Statement

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.reproduction.model_run import ModelRun


def reproduction_opening(
    runs: Mapping[str, ModelRun],
    experiments: Mapping[str, xr.Dataset],
    judged: Mapping[str, Mapping[str, Statement]],
    summary: Mapping[str, Any],
) -> Opening:
    """The opening of `macroslip.reproduction.reproduction_page.reproduction_page`, with the same parameters."""
    first = next(iter(judged.values()))
    failed = summary["failed_rollers"]
    places = {place: count for place, count in failed.items() if place not in ("study_by_case", "study_total")}
    failures = failure_line(places, failed["study_total"])
    unknown = "That the paper's turbine used this bearing is not known, nor how its equations were solved."
    sentences = (
        f"{failures} {_verdicts(judged)}" if any(places.values()) else _verdicts(judged),
        f"The paper: {first['rows'].paper}; converged: {first['rows'].found}.",
        f"The paper: {first['static'].paper}; converged: {first['static'].found.partition(';')[0]}.",
        _early_stop(experiments["nonlinear_tolerance"]),
        unknown if any(places.values()) else f"{failures} {unknown}",
    )
    return Opening(sentences, _pictures(runs, experiments))


def _verdicts(judged: Mapping[str, Mapping[str, Statement]]) -> str:
    """How many of the paper's statements hold under each model."""
    total = len(next(iter(judged.values())))
    words = []
    for name, statements in judged.items():
        verdicts = [one.verdict for one in statements.values()]
        agree, partly, differ = (verdicts.count(one) for one in (AGREES, PARTLY, DIFFERS))
        others = total - agree - partly - differ
        words.append(
            f"Model {name}: {agree} hold, {partly} in part, {differ} not{f', {others} cannot be judged' if others else ''}."
        )
    return f"The paper's {total} statements, beside converged solutions. {' '.join(words)}"


def _early_stop(experiment: xr.Dataset) -> str:
    """What an iteration that stops early does to the energy of a gripped roller."""
    one = experiment.sel(row="downwind")
    if not np.isfinite(one.ratio.values).all():
        return f"What an iteration that stops early does is {UNKNOWN}: an integration failed."
    worst = one.isel(stopping_tolerance=int(np.argmax(one.ratio.values)))
    return (
        "Large energies can come from the numerical method: with backward Euler, an iteration on spin that stops at a "
        f"relative change of {float(worst.stopping_tolerance):.0e} gives {three_digits(float(worst.ratio))} times the static "
        f"energy, a converged one {float(one.ratio_converged):.3g} times."
    )


def _pictures(runs: Mapping[str, ModelRun], experiments: Mapping[str, xr.Dataset]):
    run = next(iter(runs.values()))
    numbers = {name: one.numbers for name, one in runs.items()}

    def energy(axes):
        if len(runs) == 1:
            return winds.plot_energy(axes, run.numbers, None)
        return mechanism_figures.plot_models(axes, numbers, "both_rows_normalised", "energy / that in 12C [–]")

    def ratio(axes):
        winds.plot_energy_ratio(axes, run.numbers)
        axes.set_yscale("log")
        return mark_level(axes, 5.0, 20.0, "paper: about 10")

    jobs = [
        (energy, "Energy of both rows over mean wind speed"),
        (ratio, "Ratio of energies of the rows over wind speed"),
        (
            lambda axes: solver_figures.plot_cage_energy(axes, experiments["nonlinear_tolerance"]),
            "Cage energy per orbit against the tolerance at which the iteration stops",
        ),
    ]
    if run.turns:
        title, turn = next(iter(run.turns["static"].items()))
        jobs.insert(0, (lambda axes: orbit_figures.plot_spin(axes, turn, title), f"Spin speed over a turn, {title}"))
    return tuple(
        picture(plot, words, width=OPENING_WIDTH, height=OPENING_HEIGHT, legend="above") for plot, words in jobs
    )
