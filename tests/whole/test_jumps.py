"""Shaft speeds that change within a sample: gripped rollers leave the straight part of their traction curves at once."""

from __future__ import annotations

import math

import numpy as np
import pytest

from macroslip import BearingLoads, Case, simulate
from macroslip.case.parts import Window
from macroslip.contact.mechanisms import Laws
from macroslip.ring.orbit import Motion
from macroslip.whole.cage import Cage
from macroslip.whole.sdirk import pure_rolling
from tests.whole.conftest import gather

pytestmark = pytest.mark.slow


def test_a_sawtooth_of_speed_keeps_the_energy_of_its_rows():
    """A light load turns with 1.3 rad/s, and the shaft falls from 14.3 to 2.4 r/min within 20 ms.

    The reference evaluates every traction in every iteration, in steps of 0.5 ms: 2.1994 J in the heavier row, a lowest
    spin of 0.2389 of that in pure rolling and a peak of 12.93 W. Steps of 10 ms that do so agree to 2e-4.
    """
    time = np.linspace(0.0, 7.08, 355)
    falls = time > 4.69
    speed = 2.3983112428 + 2.551394915 * (time - np.where(falls, 4.70, 0.0))
    force = np.column_stack(
        [
            5121.47519732 * np.cos(1.3 * time),
            5121.47519732 * np.sin(1.3 * time),
            np.full(time.size, -6145.77023678),
        ]
    )
    case = Case(
        loads=BearingLoads(time, speed * math.pi / 30.0, force, "sawtooth"),
        laws=Laws.paper(),
        dynamics="whole-bearing",
        gravity=False,
        drag=False,
        contact_details=False,
        window=Window(start=3.54, end=7.06),
    )
    result = simulate(case)
    assert result.energy.sum(["roller", "interface"]).max().item() == pytest.approx(
        2.1994, rel=1e-3
    )
    assert result.min_spin_ratio.min().item() == pytest.approx(0.2389, rel=1e-3)
    assert result.window_peak_power.max().item() == pytest.approx(12.93, rel=1e-2)


def test_stops_a_rounding_apart_end_a_step_each(run):
    cage = Cage(weight=False)
    known = run(cage, (0.0, 0.0, 8e-4), 1.0, 0.1, rollers=3)
    time = np.linspace(0.0, 0.1, 3)
    motion = Motion(time, np.ones(3), time, np.tile([0.0, 0.0, 8e-4], (3, 1)))
    stops = np.array([0.0, np.nextafter(0.1, 0.0), 0.1])
    measures = gather(
        known.bearing, known.assembly, motion, pure_rolling(known.bearing, cage), stops
    )
    assert measures.status == 0
    assert np.isfinite(measures.books.stocks).all()
    assert measures.energy().sum() == pytest.approx(known.energy().sum(), rel=1e-4)
