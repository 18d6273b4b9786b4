"""SciPy's implicit solvers, Radau and BDF: compiled right-hand side and Jacobian, called back through Python."""

from __future__ import annotations

import itertools

import numpy as np
from scipy.integrate import solve_ivp

from benchmarks.histories import History
from benchmarks.outcome import Reference, Solution
from benchmarks.right_hand_side import evaluations, jacobian, pack, rates


class _TooDearError(Exception):
    """The run needs more force evaluations than it may."""


def solve(
    history: History,
    reference: Reference,
    method: str,
    stops: bool,
    rtol: float,
    atol: float,
    longest_step: float,
    most_evaluations: float = float("inf"),
) -> Solution:
    """The history by `scipy.integrate.solve_ivp`.

    Parameters
    ----------
    history : History
    reference : Reference
        Gives the size of the energy to which `rtol` refers.
    method : str
        "Radau" or "BDF".
    stops : bool
        Whether the solver starts afresh where load begins or ends.
    rtol : float
        Relative tolerance of all unknowns.
    atol : float
        Absolute tolerance of slip [m/s].
    longest_step : float
        [s].
    most_evaluations : float
        The run is given up, and counts as failed, when it has used so many.
    """
    data = pack(history)

    def rate(time, state):
        if evaluations(data) > most_evaluations:
            raise _TooDearError
        derivative = np.empty(4)
        rates(time, state, derivative, data)
        return derivative

    def slopes(time, state):
        matrix = np.zeros((4, 4))
        jacobian(time, state, matrix, data)
        return matrix

    enough = rtol * reference.energy
    options = {
        "method": method,
        "jac": slopes,
        "rtol": rtol,
        "atol": [atol, enough, enough, enough],
        "max_step": longest_step,
    }
    slip = np.full(history.marks.size, np.nan)
    state = np.zeros(4)
    bounds = np.concatenate([[history.start], history.edges if stops else [], [history.end]])
    for low, high in itertools.pairwise(bounds):
        inside = (history.marks > low) & (history.marks < high)
        try:
            solution = solve_ivp(
                rate, (low, high), state, t_eval=[*history.marks[inside], high], **options
            )
        except _TooDearError:
            return Solution(np.full(3, np.nan), slip, evaluations(data))
        if not solution.success:
            return Solution(np.full(3, np.nan), slip, evaluations(data))
        slip[inside] = solution.y[0, :-1]
        state = solution.y[:, -1]
    return Solution(state[1:], slip, evaluations(data))
