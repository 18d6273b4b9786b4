"""The paper's method on a history of the comparison: backward Euler on the spin with a fixed step, wholly compiled."""

from __future__ import annotations

import numpy as np

from benchmarks import own
from benchmarks.histories import History
from benchmarks.outcome import Reference, Solution
from macroslip.imposed.run import Problem, fixed_step
from macroslip.imposed.status import COMPLETED


def solve(history: History, reference: Reference, step: float, tolerance: float) -> Solution:
    """The history by backward Euler.

    Parameters
    ----------
    history : History
    reference : Reference
        Not used.
    step : float
        [s].
    tolerance : float
        Relative change of spin at which the nonlinear iteration stops.

    Notes
    -----
    Slip at a mark is interpolated between the two steps around it, so that the method is not blamed for its grid.
    """
    lower = np.floor((history.marks - history.start) / step)
    # Asked for a little early, a step's state is found whatever rounding does to its time.
    times = history.start + step * (np.stack([lower, lower + 1.0], axis=1).ravel() - 0.01)
    times, back = np.unique(times, return_inverse=True)
    rule = fixed_step(
        history.roller, history.motion, step=step, end=history.end, tolerance=tolerance
    )
    rule["largest_slip"] = np.inf
    outcome, measures = own.run(history, Problem(history.roller, history.motion, rule), times)
    around = measures.traces()["slip"][back].reshape(-1, 2)
    share = (history.marks - history.start) / step - lower
    slip = around[:, 0] + share * (around[:, 1] - around[:, 0])
    energy = measures.totals.energy if outcome.status == COMPLETED else np.full(3, np.nan)
    return Solution(energy, slip, float(outcome.evaluations))
