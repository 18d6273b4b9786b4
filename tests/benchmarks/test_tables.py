"""Where the cost of a roller by tables lies."""

import numpy as np
import pytest

from benchmarks.histories import histories_of
from benchmarks.tables import CLASSES, cost_by_class, intervals_by_class


def test_costs_are_those_of_which_evaluations_were_made():
    intervals = np.random.default_rng(4).integers(0, 12_000, (21, 3))
    found = cost_by_class(intervals, intervals @ np.array([40.0, 40.0, 2.2]))
    assert found == pytest.approx({"firm": 2.2, "other": 40.0}, rel=1e-8)


def test_every_interval_has_a_class_and_load_decides_it():
    downwind, upwind = histories_of("14B", 100.0, 110.0, [0])
    for history in (downwind, upwind):
        assert intervals_by_class(history).sum() == history.motion.time.size - 1
    firm = list(CLASSES).index("firm")
    assert intervals_by_class(downwind)[firm] > 10 * intervals_by_class(upwind)[firm]
