"""The production integrator on a history of the comparison, in the same terms as its rivals."""

from __future__ import annotations

import numpy as np

from benchmarks.histories import History
from benchmarks.outcome import Reference, Solution
from macroslip.imposed.run import Outcome, Problem, steps_of
from macroslip.imposed.status import COMPLETED
from macroslip.measures.roller import RollerMeasures, Row, Wanted

#: Tolerance of the reference.
REFERENCE_TOLERANCE = 1e-9


def integrate(
    history: History, tolerance: float, trace_time: np.ndarray, *, details: bool = False
) -> tuple[Outcome, RollerMeasures]:
    """Integrate and measure the whole history, as `simulate` does; a step ends at each trace time [s]."""
    limits = history.limits.copy()
    limits["tolerance"] = tolerance
    problem = Problem(
        history.roller,
        history.motion,
        limits,
        np.unique(np.concatenate([trace_time, [history.end]])),
    )
    return run(history, problem, trace_time, details=details)


def run(
    history: History, problem: Problem, trace_time: np.ndarray, *, details: bool = False
) -> tuple[Outcome, RollerMeasures]:
    """Outcome and measures of a history by the integrator and the bounds of `problem`."""
    edges = np.array([history.start, history.end])
    wanted = Wanted(edges, float(history.limits["speed_scale"][0]), trace_time, details)
    measures = RollerMeasures(
        Row(history.model, history.roller, history.motion, wanted), history.start_angle
    )
    outcome = Outcome()
    for steps in steps_of(problem, history.start_angle, outcome):
        measures.add(steps, 0)
    measures.finish()
    return outcome, measures


def solve(history: History, tolerance: float) -> Solution:
    """The history at a tolerance; energies are NaN if a roller failed."""
    outcome, measures = integrate(history, tolerance, history.marks)
    energy = measures.totals.energy if outcome.status == COMPLETED else np.full(3, np.nan)
    return Solution(energy, measures.traces()["slip"], float(outcome.evaluations))


def reference(history: History, tolerance: float = REFERENCE_TOLERANCE) -> Reference:
    """The history at a tight tolerance; its energy is NaN if the roller failed."""
    outcome, measures = integrate(history, tolerance, history.marks)
    energy = float(measures.totals.energy.sum()) if outcome.status == COMPLETED else float("nan")
    traces = measures.traces()
    return Reference(energy, traces["slip"], traces["spin_pure"] * history.model.radius)
