"""Cost in proportion to the rollers, and nothing that drifts."""

from __future__ import annotations

import math

import numpy as np
import pytest

from macroslip import Cage

SPEED = 2.143


def test_work_grows_in_proportion_to_the_rollers(run):
    """Every iteration passes each roller once, and where rollers do alike their number changes no iteration.

    Pure thrust without weight, a shaft that speeds up and slows down: a pass for each roller then is all that grows.
    """
    iterations = {}
    for rollers in (7, 14, 28):
        shaft = ([0.0, 0.25, 0.5], [2.0, 2.5, 1.5])
        result = run(
            Cage(weight=False, mass=50.0 * rollers / 28), (0.0, 0.0, 8e-4), shaft, 0.5, rollers=rollers, extrapolates=False,
            gravity=False, tolerance=2e-5,
        )  # fmt: skip
        iterations[rollers] = int(result.memory["iterations"])
        # At most both raceways of every roller are evaluated in a pass.
        assert result.memory["evaluations"] <= 2.1 * rollers * 2 * result.memory["iterations"]
    counts = np.array(list(iterations.values()), dtype=float)
    assert counts == pytest.approx(counts[0], rel=0.1)


def test_nothing_drifts(run):
    """Over 150 orbits the torque that Newton's method leaves unbalanced stays far below any other, without growing.

    Orbits after the first cost the same energy, and the cage stays where the rollers hold it.
    """
    orbit = 2.0 * math.pi / (SPEED * 0.45397)
    result = run(
        Cage(weight=False), (0.0, -1.05e-4, 0.0), SPEED, 150.0 * orbit, rollers=3, outputs=7
    )
    assert result.status == 0
    passed = np.abs(np.diff(result.flow("inner_impulse")))
    assert (np.abs(np.diff(result.books.momentum_residual())) < 1e-6 * passed).all()
    spent = np.diff(result.flow("friction_loss") + result.flow("raceway_loss"))
    assert spent[2:] == pytest.approx(spent[1], rel=2e-3)
    # The cage stays within its gap of the rollers that carry it.
    lag = result.whole["cages"][result.at_outputs(), 0, 1]
    assert np.abs(np.diff(lag[1:])).max() < 2.0 * np.abs(lag[1]) + 1e-3


def test_kinks_of_the_shaft_speed_cost_gripped_rollers_no_cascade_of_steps(run):
    """At each of twenty jumps of acceleration fewer than two steps are rejected.

    Where slips were guessed by their rates, which jump there, it took three: a slip that is guessed beyond the peak of
    traction does not come back.
    """
    time = np.linspace(0.0, 1.0, 21)
    speed = 2.0 + 0.02 * (np.arange(time.size) % 2)
    result = run(Cage(mass=25.0), (0.0, -1.5e-4, 0.0), (time, speed), 1.0, rollers=14)
    assert result.status == 0
    assert result.memory["rejections"] < 2 * (time.size - 1)
