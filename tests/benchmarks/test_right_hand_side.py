"""What the rivals integrate: the package's own forces, and a Jacobian that is their derivative."""

import numpy as np
import pytest

from benchmarks.right_hand_side import evaluations, jacobian, pack, rates
from macroslip.mechanics.spin import CONDITIONS, write_conditions
from macroslip.ring.orbit import instant
from tests.one_roller import forces_of


def states(history, count=40):
    """Random times, and slips of every size and sign."""
    random = np.random.default_rng(5)
    times = random.uniform(history.start, history.end, count)
    slips = random.choice([-1.0, 1.0], count) * 10.0 ** random.uniform(-9.0, -0.5, count)
    return zip(times, slips, strict=True)


def rate_at(time, slip, data):
    rate = np.empty(4)
    rates(time, np.array([slip, 0.0, 0.0, 0.0]), rate, data)
    return rate


def met(history, time):
    """Station of the roller at a time [s] within the interval of its sample."""
    motion, conditions = history.motion, np.zeros(1, CONDITIONS)
    k = int(np.searchsorted(motion.time, time, side="right")) - 1
    write_conditions(
        history.roller.body[0],
        history.roller.tables.ctypes.data,
        history.start_angle,
        instant(motion, k, time),
        conditions[0],
    )
    return conditions[0]


def test_rates_are_those_of_the_package(histories):
    for history in histories:
        data = pack(history, energy_unit=0.5)
        motion = history.motion
        for time, slip in states(history):
            k = int(np.searchsorted(motion.time, time, side="right")) - 1
            at = met(history, time)
            forces = forces_of(history.roller, at, slip)
            eps = 1e-3 * (motion.time[k + 1] - motion.time[k])
            inside = min(max(time, motion.time[k] + eps), motion.time[k + 1] - eps)
            before, after = (
                float(met(history, inside + side)["ring_speed"]) for side in (-eps, eps)
            )
            acceleration = (after - before) / (2.0 * eps)
            inner, outer, cage = (float(forces[name]) for name in ("inner", "outer", "cage"))
            rate = rate_at(time, slip, data)
            expected = acceleration - history.model.mobility * (inner + outer + cage)
            assert rate[0] == pytest.approx(expected, rel=1e-9, abs=1e-8)
            powers = np.array([inner * slip, outer * slip, cage * (float(at["ring_speed"]) - slip)])
            np.testing.assert_allclose(rate[1:], np.abs(powers) / 0.5, rtol=1e-13)


def test_jacobian_is_the_difference_quotient(histories):
    for history in histories:
        data = pack(history, energy_unit=2.0)
        for time, slip in states(history):
            matrix = np.zeros((4, 4))
            jacobian(time, np.array([slip, 0.0, 0.0, 0.0]), matrix, data)
            change = 1e-5 * abs(slip)
            quotient = (rate_at(time, slip + change, data) - rate_at(time, slip - change, data)) / (
                2.0 * change
            )
            # Round-off of the rates themselves limits the quotient.
            noise = 1e-13 * np.abs(rate_at(time, slip, data)) / change
            assert np.all(
                np.abs(matrix[:, 0] - quotient) <= 1e-5 * np.abs(quotient) + 10.0 * noise + 1e-9
            )
            assert not matrix[:, 1:].any()


def test_evaluations_are_counted(histories):
    data = pack(histories[0])
    for _ in range(3):
        rate_at(histories[0].start, 0.01, data)
    assert evaluations(data) == 3.0
