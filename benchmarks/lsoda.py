"""LSODA (numbalsoda), wholly compiled: solver, right-hand side and the loop over the pieces of a history.

It takes one absolute tolerance for all unknowns, so energy is measured in a unit that makes its tolerance right. It
takes no Jacobian, no longest step and no time it must not pass: between stops it runs past the end of a piece and comes
back by interpolation.
"""

from __future__ import annotations

import functools

import numba
import numpy as np
from numbalsoda import lsoda, lsoda_sig

from benchmarks.histories import History
from benchmarks.outcome import Reference, Solution
from benchmarks.right_hand_side import c_rates, evaluations, pack

_MOST_STEPS = 10_000_000


@functools.cache
def _address(length: int) -> int:
    return c_rates(lsoda_sig, length).address


@numba.njit(nogil=True)
def _pieces(address, bounds, marks, data, rtol, atol, slip):
    """Integrate piece by piece, each a fresh start of the solver; fill `slip` at the marks and return y at the end."""
    state = np.zeros(4)
    for k in range(bounds.size - 1):
        low = np.searchsorted(marks, bounds[k], side="right")
        high = np.searchsorted(marks, bounds[k + 1], side="left")
        times = np.concatenate((bounds[k : k + 1], marks[low:high], bounds[k + 1 : k + 2]))
        states, success = lsoda(address, state, times, data, rtol, atol, _MOST_STEPS)
        if not success:
            state[:] = np.nan
            break
        slip[low:high] = states[1:-1, 0]
        state = states[-1].copy()
    return state


def solve(
    history: History, reference: Reference, stops: bool, rtol: float, atol: float
) -> Solution:
    """The history by LSODA.

    Parameters
    ----------
    history : History
    reference : Reference
        Gives the size of the energy to which `rtol` refers.
    stops : bool
        Whether the solver starts afresh where load begins or ends.
    rtol : float
        Relative tolerance of all unknowns.
    atol : float
        Absolute tolerance of slip [m/s].
    """
    energy_unit = rtol * reference.energy / atol
    data = pack(history, energy_unit)
    bounds = np.concatenate([[history.start], history.edges if stops else [], [history.end]])
    slip = np.full(history.marks.size, np.nan)
    end = _pieces(_address(data.size), bounds, history.marks, data, rtol, atol, slip)
    return Solution(end[1:] * energy_unit, slip, evaluations(data))
