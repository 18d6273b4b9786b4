"""What a step's energy may be off by, on motions with kinks and on histories that fooled the embedded estimate."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import quad

from macroslip import BearingLoads, Case, Radau, Window, simulate
from macroslip.integrate.energy_control import missed_way
from macroslip.integrate.radau_step import NODES, WEIGHTS
from macroslip.ring.orbit import Motion, shaft_angle

RATIO, RADIUS = 0.45, 0.4


def _missed(time, speed, start, end):
    """`missed_way` of a step from one time to another, and the same by quadrature of the speed alone."""
    motion = Motion(time, speed, shaft_angle(time, speed), np.zeros((time.size, 3)))

    def ring_speed(instant):
        return -RATIO * RADIUS * np.interp(instant, time, speed)

    def interval(instant):
        return int(np.clip(np.searchsorted(time, instant, side="right") - 1, 0, time.size - 2))

    times = [start + node * (end - start) for node in NODES]
    stations = [SimpleNamespace(ring_speed=ring_speed(one)) for one in times]
    path = SimpleNamespace(motion=motion, model=SimpleNamespace(orbit_ratio=RATIO, outer_radius=RADIUS))
    state = SimpleNamespace(time=start, interval=interval(start))
    at1, at2, at3 = stations
    step = SimpleNamespace(length=end - start, times=times, interval=interval(end), at1=at1, at2=at2, at3=at3)
    kinks = [one for one in time if start < one < end]
    exact = quad(ring_speed, start, end, points=kinks or None, epsabs=1e-14)[0]
    found = (end - start) * sum(weight * one.ring_speed for weight, one in zip(WEIGHTS, stations, strict=True))
    return missed_way(path, state, step), found - exact


@pytest.mark.parametrize(("start", "end"), [(0.0, 3.0), (0.2, 1.7), (0.9, 1.1), (2.0, 3.0)])
def test_what_is_missed_of_the_way_is_what_quadrature_of_the_speed_misses(start, end):
    time, speed = np.array([0.0, 1.0, 1.5, 2.0, 3.0]), np.array([0.0, 2.0, 2.0, -1.0, 0.5])
    missed, expected = _missed(time, speed, start, end)
    assert missed == pytest.approx(expected, abs=1e-12)


def test_nothing_is_missed_where_speed_is_linear():
    time = np.linspace(0.0, 3.0, 7)
    assert _missed(time, 1.0 + 0.3 * time, 0.1, 2.9)[0] == pytest.approx(0.0, abs=1e-14)


def _history(speed, force=(0.0, -500e3, 200e3), step=0.05, seconds=20.0):
    time = np.arange(round(seconds / step) + 1) * step
    return BearingLoads(time, speed(time), np.tile(force, (time.size, 1)), "made up")


HISTORIES = {
    "stop and go": (lambda t: 2.0 * np.clip(2.0 * np.sin(2 * np.pi * t / 11.0 + 2.4) + 0.6, 0.0, 1.0), None),
    "starts and stops at once": (lambda t: np.where((t > 3.0) & (t < 12.0), 2.0, 0.0), None),
    "reversal": (lambda t: 2.0 * np.sin(2 * np.pi * t / 13.0), None),
    "runs down in the window": (lambda t: np.clip(2.0 * (17.0 - t), 0.0, 2.0), 15.9),
}


@pytest.mark.parametrize("name", HISTORIES)
def test_energy_at_the_default_tolerance_where_the_shaft_stops_or_turns_back(name):
    speed, start = HISTORIES[name]
    loads, rollers = _history(speed), [0, 5, 11, 16, 22]

    def energy(tolerance):
        case = Case(loads=loads, rollers=rollers, window=Window(start=start), integrator=Radau(tolerance=tolerance))
        return simulate(case).energy.sum("interface")

    exact = energy(1e-8)
    assert float(exact.min()) > 0.0
    assert float(abs(energy(Radau().tolerance) / exact - 1.0).max()) < 3e-4
