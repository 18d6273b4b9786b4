"""SUNDIALS CVODE through scikit-sundae: compiled right-hand side and analytic Jacobian, called back through Python."""

from __future__ import annotations

import numpy as np
from sksundae.cvode import CVODE

from benchmarks.histories import History
from benchmarks.outcome import Reference, Solution
from benchmarks.right_hand_side import evaluations, jacobian, pack, rates

_MOST_STEPS, _MOST_RESTARTS = 10_000_000, 10_000


def solve(
    history: History,
    reference: Reference,
    stops: str,
    rtol: float,
    atol: float,
    longest_step: float = 0.0,
) -> Solution:
    """The history by CVODE's BDF with its dense linear solver.

    Parameters
    ----------
    history : History
    reference : Reference
        Gives the size of the energy to which `rtol` refers.
    stops : str
        Where load begins or ends: "none", "stop" there, or "restart" there at order 1.
    rtol : float
        Relative tolerance of all unknowns.
    atol : float
        Absolute tolerance of slip [m/s].
    longest_step : float
        [s]; 0 for none.

    Notes
    -----
    Where power jumps, at a load sample, CVODE may give up after seven failed error tests, a number that scikit-sundae
    cannot change. It is then started afresh from where it stands.
    """
    data = pack(history)
    enough = rtol * reference.energy

    def rate(time, state, derivative):
        rates(time, state, derivative, data)

    def slopes(time, state, rate, matrix):
        jacobian(time, state, matrix, data)

    solver = CVODE(
        rate,
        jacfn=slopes,
        rtol=rtol,
        atol=[atol, enough, enough, enough],
        max_num_steps=_MOST_STEPS,
        max_step=longest_step,
    )
    slip = np.full(history.marks.size, np.nan)
    state = np.zeros(4)
    solver.init_step(history.start, state)
    restarts = _MOST_RESTARTS
    marked = 0
    edges = history.edges if stops != "none" else []
    for end in (*edges, history.end):
        inside = history.marks[marked:][history.marks[marked:] < end]
        for time in (*inside, end):
            step = solver.step(time, tstop=end)
            while not step.success and restarts > 0:
                restarts -= 1
                solver.init_step(step.t, step.y)
                step = solver.step(time, tstop=end)
            if not step.success:
                return Solution(np.full(3, np.nan), slip, evaluations(data))
            if time != end:
                slip[marked] = step.y[0]
                marked += 1
        state = step.y
        if stops == "restart" and end != history.end:
            solver.init_step(end, state)
    return Solution(state[1:], slip, evaluations(data))
