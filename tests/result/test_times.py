"""Times that differ by rounding alone are one time: ends of orbits, windows, traces and samples."""

from __future__ import annotations

import math

import numpy as np
import pytest

from macroslip import BearingLoads, Case, simulate
from macroslip.bearing.geometry import orbit_ratio
from macroslip.case.case import IMPOSED_ORBIT, WHOLE_BEARING
from macroslip.case.parts import Traces, Window
from macroslip.result.prepared import prepare
from macroslip.ring.orbit import merged_times

#: Shaft speed [rad/s] whose second orbit ends one rounding before the loads do.
SPEED = 20.464905 * math.pi / 30.0


def two_orbits(bearing, **choices) -> Case:
    seconds = 4.0 * math.pi / (orbit_ratio(bearing) * SPEED)
    loads = BearingLoads.constant([0.0, -343476.48, 0.0], SPEED, seconds)
    return Case(loads=loads, bearing=bearing, **choices)


def test_times_within_some_roundings_of_an_anchor_become_it():
    anchors = np.array([0.0, 0.3, 600.0])
    times = merged_times(np.array([-1e-17, 0.1 + 0.2, 0.3001, 600.0 + 1e-12, 601.0]), anchors)
    assert times.tolist() == [0.0, 0.3, 0.3001, 600.0, 601.0]


def test_an_orbit_that_ends_with_the_loads_ends_at_their_last_sample(bearing):
    case = two_orbits(bearing)
    ready = prepare(case)
    assert ready.edges.size == 2
    assert ready.edges[-1] == ready.end == case.loads.time[-1]


@pytest.mark.parametrize("direction", [-np.inf, np.inf])
def test_a_window_that_ends_a_rounding_off_the_last_sample_ends_there(bearing, direction):
    last = two_orbits(bearing).loads.time[-1]
    window = Window(start=0.0, end=float(np.nextafter(last, direction)))
    ready = prepare(two_orbits(bearing, window=window))
    # Both orbits count, the second one's end being that of the window.
    assert ready.edges.size == 3
    assert ready.edges[-1] == ready.end == last


def test_a_window_and_traces_may_end_one_sample_after_the_loads(bearing):
    """A record of 600 s at 20 Hz ends at 599.95 s."""
    whole = two_orbits(bearing)
    last = whole.loads.time[-1]
    step = whole.loads.time[1] - whole.loads.time[0]
    window = Window(start=0.0, end=float(last + step))
    traces = Traces(step=0.5, end=float(last + step))
    ready = prepare(two_orbits(bearing, window=window, traces=traces))
    assert ready.edges[-1] == ready.end == last
    assert ready.trace_time[-1] <= last
    for late in (Window(end=float(last + 1.1 * step)), Window(start=float(last + 0.5 * step))):
        with pytest.raises(ValueError, match="the window runs from"):
            two_orbits(bearing, window=late)


def test_a_window_of_some_roundings_is_refused(bearing):
    last = two_orbits(bearing).loads.time[-1]
    with pytest.raises(ValueError, match="the window runs from"):
        two_orbits(bearing, window=Window(start=float(np.nextafter(last, 0.0))))


def test_traces_take_over_the_times_of_samples_and_edges(bearing):
    time = np.linspace(0.0, 1.2, 13)
    loads = BearingLoads(time, np.full(13, SPEED), np.tile([0.0, -3e5, 0.0], (13, 1)), "steady")
    window = Window(start=0.3, end=1.0999999999999999)
    ready = prepare(Case(loads=loads, bearing=bearing, window=window, traces=Traces(step=0.1)))
    assert np.isin(ready.trace_time, time).all()
    assert ready.edges[0] in time
    assert ready.trace_time[-1] == ready.end == time[11]


@pytest.mark.slow
@pytest.mark.parametrize("dynamics", [IMPOSED_ORBIT, WHOLE_BEARING])
def test_both_engines_complete_when_the_last_orbit_ends_with_the_loads(bearing, dynamics):
    rollers = "all" if dynamics == WHOLE_BEARING else [0]
    result = simulate(two_orbits(bearing, dynamics=dynamics, rollers=rollers))
    assert (result.status == 0).all()
    assert bool(np.isfinite(result.energy).all())
    # The load is steady, and the window is one whole orbit.
    assert result.orbit_end[-1].item() == result.attrs["window_end"]
    assert result.energy.sum().item() == pytest.approx(result.orbit_energy.sum().item(), rel=1e-12)
