"""What a step's energy may be off by, on motions with kinks and on histories that fooled the embedded estimate."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import quad

from macroslip import Bearing, BearingLoads, Case, Radau, Traces, Window, simulate
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


def _history(shape, force=(0.0, -500e3, 200e3), seconds=20.0):
    time = np.arange(round(seconds / 0.05) + 1) * 0.05
    return BearingLoads(time, shape(time), np.tile(force, (time.size, 1)), "made up")


def _stop_and_go(period, phase, offset, fastest):
    return lambda t: fastest * np.clip(2.0 * np.sin(2 * np.pi * t / period + phase) + offset, 0.0, 1.0)


def _reversal(period, phase, fastest):
    return lambda t: fastest * np.sin(2 * np.pi * t / period + phase)


#: Shaft speeds at which energies were off by 1e-3 to 5e-3 with the embedded estimate alone, and what the window starts at.
SPEEDS = {
    "starts, runs and stops within a step": (_stop_and_go(5.6, 5.9, -0.4, 0.4), None),
    "stops for long": (_stop_and_go(16.2, 3.8, -0.2, 0.6), None),
    "stops in the window": (_stop_and_go(13.0, 0.5, -0.1, 1.4), None),
    "turns back": (_reversal(14.3, 4.1, 1.1), None),
    "turns for a moment in a long rest": (lambda t: 1.5 * ((t < 3.0) | ((t > 11.0) & (t < 11.4))), None),
    "runs down in the window": (lambda t: np.clip(2.0 * (17.0 - t), 0.0, 2.0), 15.9),
}


@pytest.mark.parametrize("name", SPEEDS)
def test_energy_at_the_default_tolerance_where_the_shaft_stops_or_turns_back(name):
    shape, start = SPEEDS[name]

    def energy(tolerance):
        integrator, window = Radau(tolerance=tolerance), Window(start=start)
        case = Case(loads=_history(shape), rollers=[0, 5, 11, 16, 22], window=window, integrator=integrator)
        return simulate(case).energy.sum("interface")

    exact = energy(1e-8)
    assert float(exact.min()) > 0.0
    assert float(abs(energy(Radau().tolerance) / exact - 1.0).max()) < 3e-4


def test_energy_and_peaks_of_rollers_without_weight_and_drag():
    # Only tractions load the cage then, and they jump with the shaft's acceleration. The downwind row is held all round.
    random = np.random.default_rng(3)
    loads = _history(lambda t: 2.0 + np.cumsum(random.normal(0.0, 0.004, t.size)), seconds=28.0)

    def solved(tolerance):
        case = Case(loads=loads, rollers=[0, 9], gravity=False, drag=False, integrator=Radau(tolerance=tolerance))
        return simulate(case).sel(row="downwind")

    found, exact = solved(Radau().tolerance), solved(1e-8)
    assert exact.sizes["orbit"] > 1
    energy, peak = (abs(found[name] / exact[name] - 1.0) for name in ("energy", "peak_power"))
    assert float(energy.sel(interface="cage").max()) < 1e-5
    assert float(peak.sel(interface="cage").max()) < 1e-5


def test_tractions_at_a_trace_are_those_of_the_instant():
    # Speed is linear between samples 0.05 s apart; traces lie between them and further apart than steps are long.
    loads = _history(lambda t: 2.0 + 0.3 * np.sin(1.7 * t) + 0.05 * np.sin(9.0 * t))
    bearing = Bearing.read("skf-240-600-bc")
    result = simulate(Case(loads=loads, bearing=bearing, rollers=[0], traces=Traces(step=0.3331, start=2.013)))
    result = result.sel(row="downwind").isel(roller=0)
    interval = np.searchsorted(loads.time, result.time.values, side="right") - 1
    acceleration = (np.diff(loads.shaft_speed) / np.diff(loads.time))[np.minimum(interval, loads.time.size - 2)]
    spin_by_speed = result.spin_pure.values / np.interp(result.time.values, loads.time, loads.shaft_speed)
    radius = 0.5 * bearing.roller_diameter
    mass = bearing.density * np.pi * radius**2 * bearing.roller_length
    held = result.roller_load.values > 10e3
    assert held.sum() > 20
    needed = 0.5 * mass * radius * spin_by_speed * acceleration
    assert result.traction.sum("interface").values[held] == pytest.approx(needed[held], abs=1e-5)
