"""The opening of the reproduction's report: verdicts, the largest difference, what numerics do, what failed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from macroslip.report import orbit_figures
from macroslip.report.bearing_figures import mark_level
from macroslip.report.page import Opening
from macroslip.report.pictures import OPENING_HEIGHT, OPENING_WIDTH, picture
from macroslip.reproduction import mechanism_figures, solver_figures
from macroslip.reproduction import wind_speed_figures as winds
from macroslip.reproduction.headline import failure_line, tolerance_line
from macroslip.reproduction.statement import AGREES, DIFFERS, PARTLY, Statement

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
    sentences = (
        " ".join(_verdicts(name, of_model, several=len(judged) > 1) for name, of_model in judged.items()),
        f"The paper: {first['rows'].paper}; converged: {first['rows'].found}.",
        f"The paper: {first['static'].paper}; converged: {first['static'].found}.",
        tolerance_line(experiments["nonlinear_tolerance"]),
        f"{failure_line(places, failed['study_total'])} That the paper's turbine used this bearing is not known, nor "
        "how its equations were solved.",
    )
    return Opening(sentences, _pictures(runs, experiments))


def _verdicts(name: str, statements: Mapping[str, Statement], *, several: bool) -> str:
    counts = {
        verdict: sum(one.verdict == verdict for one in statements.values()) for verdict in (AGREES, PARTLY, DIFFERS)
    }
    others = len(statements) - sum(counts.values())
    words = (
        f"f the paper's {len(statements)} statements {counts[AGREES]} agree with a converged solution, "
        f"{counts[PARTLY]} agree in part, {counts[DIFFERS]} differ"
        f"{f', {others} not computed or not to be judged' if others else ''}."
    )
    return f"Under the model {name}, o{words}" if several else f"O{words}"


def _pictures(runs: Mapping[str, ModelRun], experiments: Mapping[str, xr.Dataset]):
    run = next(iter(runs.values()))
    numbers = {name: one.numbers for name, one in runs.items()}

    def energy(axes):
        if len(runs) == 1:
            return winds.plot_energy(axes, run.numbers, None)
        return mechanism_figures.plot_models(
            axes, numbers, "both_rows_normalised", "energy, both rows, over that in 12C [–]"
        )

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
