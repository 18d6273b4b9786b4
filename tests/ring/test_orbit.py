"""The imposed motion against direct integration."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from macroslip.ring.orbit import Motion, instant, interval_of, shaft_angle

TIME = np.array([-1.0, 0.0, 0.5, 2.0, 2.1])
SPEED = np.array([2.0, 3.0, -1.0, -1.5, 4.0])
DISPLACEMENT = np.array(
    [[0.0, 1.0, 2.0], [1.0, -1.0, 3.0], [4.0, 0.0, 0.0], [-2.0, 5.0, 1.0], [0.5, 0.25, -1.0]]
)


@pytest.fixture
def motion():
    return Motion(TIME, SPEED, shaft_angle(TIME, SPEED), DISPLACEMENT)


def integral(start, end):
    inside = TIME[(start < TIME) & (end > TIME)]
    points = inside if inside.size else None
    return quad(lambda t: np.interp(t, TIME, SPEED), start, end, points=points, epsabs=1e-13)[0]


def test_angle_is_the_integral_of_speed(motion):
    assert motion.shaft_angle[0] == 0.0
    assert motion.shaft_angle == pytest.approx([integral(TIME[0], t) for t in TIME], abs=1e-12)


@pytest.mark.parametrize("time", [-1.0, -0.37, 0.0, 0.25, 0.375, 0.5, 1.9, 2.0, 2.05, 2.1])
def test_instant_is_linear_with_exact_angle(motion, time):
    now = instant(motion, interval_of(motion, time, 0), time)
    assert now.shaft_speed == pytest.approx(np.interp(time, TIME, SPEED), abs=1e-13)
    assert now.shaft_angle == pytest.approx(integral(TIME[0], time), abs=1e-12)
    assert now[2:] == pytest.approx(
        [np.interp(time, TIME, part) for part in DISPLACEMENT.T], abs=1e-13
    )


@given(st.floats(-1.0, 2.1), st.integers(0, 3))
@settings(deadline=None, max_examples=60)
def test_interval_is_found_from_any_start(time, start):
    motion = Motion(TIME, SPEED, shaft_angle(TIME, SPEED), DISPLACEMENT)
    k = interval_of(motion, time, start)
    expected = min(int(np.searchsorted(TIME, time, side="right")) - 1, TIME.size - 2)
    assert k == expected


def test_interval_outside_the_samples_is_the_nearest(motion):
    assert interval_of(motion, -5.0, 3) == 0
    assert interval_of(motion, 50.0, 0) == TIME.size - 2
