"""Bearings, ring motions and an independent solution for the whole bearing."""

from __future__ import annotations

import math

import numpy as np
import pytest

from macroslip.mechanisms import Laws
from macroslip.ring.orbit import Motion, shaft_angle
from macroslip.whole_bearing.model import whole_bearing
from macroslip.whole_bearing.run import Times, pure_rolling, run_whole_bearing


@pytest.fixture(scope="session")
def run(bearing, lubricant):
    """Simulate with a fixed or given ring motion; returns status, record and the prepared bearing."""

    def simulate(
        cage,
        displacement,
        speed,
        span,
        *,
        rollers=28,
        tolerance=2e-4,
        start=None,
        change=None,
        outputs=11,
        rests=True,
        laws=None,
        **choices,
    ):
        prepared = whole_bearing(
            bearing.replace(rollers_per_row=rollers),
            lubricant,
            cage,
            tilt=math.radians(5.0),
            laws=laws or Laws.paper(),
            **choices,
        )
        if change:
            prepared = change(prepared)
        time = np.linspace(0.0, span, 201)
        shaft = np.full(time.size, speed) if np.isscalar(speed) else np.interp(time, *speed)
        motion = Motion(time, shaft, shaft_angle(time, shaft), np.tile(np.asarray(displacement, float), (time.size, 1)))
        begin = pure_rolling(prepared, cage)
        if start:
            begin = start(begin)
        within = Times(np.array([0.0, span]), np.linspace(0.0, span, outputs), span)
        status, record = run_whole_bearing(prepared, motion, begin, within, tolerance=tolerance, rests=rests)
        return status, record, prepared

    return simulate
