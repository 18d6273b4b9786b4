"""Cost in proportion to the rollers, nothing that drifts, and an end when one is asked for."""

from __future__ import annotations

import math
import threading
import time

import numpy as np
import pytest

from macroslip.integrate.status import INTERRUPTED
from macroslip.mechanisms import Laws
from macroslip.ring.orbit import Motion, shaft_angle
from macroslip.whole_bearing.books import momentum_residual
from macroslip.whole_bearing.cage import Cage
from macroslip.whole_bearing.ledger import FLOWS
from macroslip.whole_bearing.model import whole_bearing
from macroslip.whole_bearing.run import Times, pure_rolling, run_whole_bearing

SPEED = 2.143


def test_work_grows_in_proportion_to_the_rollers(run):
    """Every iteration passes each roller once, and where rollers do alike their number changes no iteration.

    Pure thrust without weight, a shaft that speeds up and slows down: a pass for each roller then is all that grows.
    """
    iterations = {}
    for rollers in (7, 14, 28):
        shaft = ([0.0, 0.25, 0.5], [2.0, 2.5, 1.5])
        _, record, _ = run(
            Cage(weight=False, mass=50.0 * rollers / 28), (0.0, 0.0, 8e-4), shaft, 0.5, rollers=rollers, rests=False,
            gravity=False, tolerance=2e-5,
        )  # fmt: skip
        iterations[rollers] = record.count[3]
        # At most both raceways of every roller are evaluated in a pass.
        assert record.count[2] <= 2.1 * rollers * 2 * record.count[3]
    counts = np.array(list(iterations.values()), dtype=float)
    assert counts == pytest.approx(counts[0], rel=0.1)


def test_nothing_drifts(run):
    """Over 150 orbits the torque that Newton's method leaves unbalanced stays far below any other, without growing.

    Orbits after the first cost the same energy, and the cage stays where the rollers hold it.
    """
    orbit = 2.0 * math.pi / (SPEED * 0.45397)
    status, record, _ = run(Cage(weight=False), (0.0, -1.05e-4, 0.0), SPEED, 150.0 * orbit, rollers=3, outputs=7)
    assert status == 0
    passed = np.abs(np.diff(record.flows[:, FLOWS.index("inner_impulse")]))
    assert (np.abs(np.diff(momentum_residual(record))) < 1e-6 * passed).all()
    spent = np.diff(record.flows[:, FLOWS.index("friction_loss")] + record.flows[:, FLOWS.index("raceway_loss")])
    assert spent[2:] == pytest.approx(spent[1], rel=2e-3)
    # The cage stays within its gap of the rollers that carry it.
    assert np.abs(np.diff(record.cage_trace[1:, 0, 1])).max() < 2.0 * np.abs(record.cage_trace[1, 0, 1]) + 1e-3


def test_an_interrupt_ends_the_integration_within_two_seconds(bearing, lubricant):
    cage = Cage()
    prepared = whole_bearing(bearing, lubricant, cage, tilt=0.0, laws=Laws.paper())
    moments = np.linspace(0.0, 1e5, 1001)
    shaft = np.full(moments.size, SPEED)
    motion = Motion(moments, shaft, shaft_angle(moments, shaft), np.tile([0.0, -2e-4, 0.0], (moments.size, 1)))
    interrupt = np.zeros(1, dtype=np.int8)

    def ask():
        interrupt[0] = 1

    timer = threading.Timer(0.5, ask)
    short = Times(np.array([0.0, 0.01]), np.array([0.0]), 0.01)
    run_whole_bearing(prepared, motion, pure_rolling(prepared, cage), short, tolerance=2e-4)  # compiles
    began = time.monotonic()
    timer.start()
    long = Times(np.array([0.0, 1e5]), np.array([0.0]), 1e5)
    status, record = run_whole_bearing(prepared, motion, pure_rolling(prepared, cage), long, interrupt=interrupt)
    assert status == INTERRUPTED
    assert record.end[0] < 1e5
    assert time.monotonic() - began < 2.5
