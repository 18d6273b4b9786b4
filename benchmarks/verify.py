"""The reference judged from outside: another method, pushed to convergence, must give the same numbers."""

from __future__ import annotations

from typing import Any

from benchmarks.histories import History
from benchmarks.outcome import Reference, errors
from benchmarks.quiet import silence
from benchmarks.rivals import scipy_solver

#: Agreement that is asked for, in total energy and in mid-coast spin.
AGREEMENT = 1e-6
_HOW_MANY = 2
_TIGHT = {"rtol": 1e-11, "atol": 1e-13, "stops": True}


def verify(histories: list[History], references: list[Reference]) -> dict[str, Any]:
    """Deviation of a converged rival from the reference on the two histories with most load edges.

    LSODA if it is installed, SciPy's Radau otherwise; both restart where load begins or ends.

    Returns
    -------
    dict
        `method`, `energy_error` and `spin_error` by history, `agrees` (all below `AGREEMENT`).
    """
    try:
        from benchmarks.lsoda import solve

        method, setting = "LSODA (numbalsoda)", _TIGHT
    except ImportError:
        solve = scipy_solver("Radau")
        method, setting = "SciPy solve_ivp, Radau", _TIGHT | {"rtol": 1e-10, "longest_step": 0.05}
    chosen = sorted(zip(histories, references, strict=True), key=lambda pair: -pair[0].edges.size)[
        :_HOW_MANY
    ]
    errors_by_history = {}
    for history, reference in chosen:
        with silence():
            errors_by_history[history.name] = errors(
                solve(history, reference, **setting), reference
            )
    return {
        "method": method,
        "energy_error": {name: pair[0] for name, pair in errors_by_history.items()},
        "spin_error": {name: pair[1] for name, pair in errors_by_history.items()},
        "agrees": all(max(pair) < AGREEMENT for pair in errors_by_history.values()),
    }
