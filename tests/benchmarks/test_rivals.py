"""Every rival that is installed, pushed hard, converges to the production integrator's answer."""

import importlib

import numpy as np
import pytest

from benchmarks import own
from benchmarks.histories import load_edges
from benchmarks.outcome import errors
from benchmarks.quiet import silence
from macroslip.mechanics.spin import CONDITIONS, write_conditions
from macroslip.ring.orbit import instant

TIGHT = {
    "lsoda": {"stops": True, "rtol": 1e-10, "atol": 1e-12},
    "cvode": {"stops": "restart", "rtol": 1e-9, "atol": 1e-11, "longest_step": 0.02},
    "cvode_compiled": {"stops": "restart", "rtol": 1e-9, "atol": 1e-11, "longest_step": 0.02},
    "euler": {"step": 2e-4, "tolerance": 1e-13},
    "scipy_solvers": {
        "method": "BDF",
        "stops": True,
        "rtol": 1e-8,
        "atol": 1e-9,
        "longest_step": 0.05,
    },
}
NEEDS = {"lsoda": "numbalsoda", "cvode": "sksundae", "cvode_compiled": "sksundae"}


@pytest.mark.parametrize("name", TIGHT)
def test_a_rival_converges_to_the_same_answer(name, histories):
    if name in NEEDS:
        pytest.importorskip(NEEDS[name], reason=f"the rival {NEEDS[name]} is not installed")
    room = importlib.import_module(f"benchmarks.{name}")
    if name == "cvode_compiled" and not room.available():
        pytest.skip("this scikit-sundae brings no shared libraries that can be called")
    allowed = 1e-2 if name == "euler" else 1e-4
    for history in histories:
        reference = own.reference(history)
        with silence():
            solution = room.solve(history, reference, **TIGHT[name])
        assert max(errors(solution, reference)) < allowed
        assert solution.evaluations > 0


def test_load_edges_are_where_load_begins_and_ends(histories):
    history = histories[0]
    edges = load_edges(history.roller, history.motion, history.start_angle)
    assert edges.size > 0

    def load(time):
        interval, conditions = int((history.motion.time <= time).sum()) - 1, np.zeros(1, CONDITIONS)
        now = instant(history.motion, interval, time)
        write_conditions(
            history.roller.body[0],
            history.roller.tables.ctypes.data,
            history.start_angle,
            now,
            conditions[0],
        )
        return float(conditions["elastic_load"][0])

    for edge in edges:
        assert (load(edge - 1e-7) > 0.0) != (load(edge + 1e-7) > 0.0)
    assert all(load(mark) == 0.0 for mark in history.marks) and history.marks.size > 0
