"""What accepted steps leave in the record, against sums and integrals made here."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest

from macroslip.integrate.booking import Peaks, book, step_powers
from macroslip.integrate.path import Path, state_at, step_from
from macroslip.integrate.peak import start_peak
from macroslip.integrate.record import new_record
from macroslip.integrate.stages import solve_stages
from macroslip.ring.orbit import Motion, shaft_angle
from macroslip.roller.model import roller_model

EDGES = np.array([0.0, 0.1, 0.3])


@pytest.fixture(scope="module")
def path(bearing, lubricant):
    """A roller without load on its way up, leaning on the cage, coasting with a slip of 0.05 m/s."""
    model = roller_model(bearing, lubricant, 1, tilt=0.0)
    time = np.linspace(0.0, 1.0, 11)
    speed = np.full(11, 2.0)
    motion = Motion(time, speed, shaft_angle(time, speed), np.tile([0.0, -1e-4, 0.0], (11, 1)))
    return Path(model, motion, 0.9, SimpleNamespace(tolerance=1e-8, speed_scale=0.4))


def walk(path, lengths):
    """Book steps of these lengths one after the other; the record, and the powers at all stages by step."""
    record = new_record(EDGES, np.empty(0), 0.4)
    state = state_at(path, 0.0, 0, 0.05)
    peaks = Peaks(np.empty((2, 4)), -1, 0.0)
    start_peak(peaks.samples, 0.0, *state.powers)
    spent = []
    for length in lengths:
        step = step_from(path, state, length)
        stages = solve_stages(path, state, step, (state.slip,) * 3, False, math.inf)
        assert stages.converged
        found = step_powers(path.model, step, stages)
        peaks = book(record, path, state, step, stages, found, peaks, False)
        spent.append((found.inner_energy, found.outer_energy, found.cage_energy))
        powers = found.inner[2], found.outer[2], found.cage[2]
        state = type(state)(step.times[2], step.interval, stages.v3, step.at3, stages.f3, powers)
    return record, np.array(spent), state


def test_energy_is_the_sum_of_the_steps_and_goes_to_the_orbit_of_their_middle(path):
    record, spent, _ = walk(path, [0.02] * 15)
    np.testing.assert_allclose(record.energy, spent.sum(axis=0), rtol=1e-13)
    np.testing.assert_allclose(record.orbit_energy, [spent[:5].sum(axis=0), spent[5:].sum(axis=0)], rtol=1e-13)
    assert spent.sum() > 0.0


def test_energy_converges_with_the_fifth_order_of_the_method(path):
    """On a smooth coast: the rule's weights belong to its stages."""
    energies = [walk(path, [0.3 / n] * n)[0].energy.sum() for n in (3, 6, 48)]
    coarse, fine = (abs(energy / energies[2] - 1.0) for energy in energies[:2])
    assert coarse < 1e-4
    assert fine < coarse / 8.0 or fine < 1e-11


def test_peak_of_each_orbit_is_the_largest_power_in_it(path):
    record, _, _ = walk(path, [0.02] * 15)
    fine = []
    for steps in range(1, 61):
        _, _, state = walk(path, [0.005] * steps)
        fine.append((0.005 * steps, state.powers))
    start = state_at(path, 0.0, 0, 0.05).powers
    first = np.max([start, *(powers for end, powers in fine if end <= EDGES[1])], axis=0)
    second = np.max([powers for end, powers in fine if end >= EDGES[1] - 1e-9], axis=0)
    np.testing.assert_allclose(record.peak_power, [first, second], rtol=1e-3)
    assert (record.peak_power.max(axis=1) > 0.0).all()


def test_time_with_load_and_spin_ratio(path):
    record, _, end = walk(path, [0.02] * 15)
    assert record.loaded_time.max() == pytest.approx(0.3)
    ratio = (end.at.ring_speed - end.slip) / end.at.ring_speed
    first = (state_at(path, 0.0, 0, 0.05).at.ring_speed - 0.05) / end.at.ring_speed
    assert min(ratio, first) - 1e-3 <= record.spin_ratio[0] <= max(ratio, first) + 1e-3
