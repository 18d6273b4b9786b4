"""Events: computed from their first sample, with peaks where no orbit is complete."""

import numpy as np
import pytest

from macroslip import BearingLoads, Case, HubLoads, Laws, Traces, simulate
from macroslip.bearing.geometry import orbit_ratio
from tests.quick import COARSE


def _swing(bearing, *, event, turns=0.3, duration=20.0):
    """Loads that turn the shaft by `turns` orbits and stop, from standstill to standstill."""
    time = np.linspace(0.0, duration, 401)
    mean = turns * 2.0 * np.pi / orbit_ratio(bearing) / duration
    speed = mean * (1.0 - np.cos(2.0 * np.pi * time / duration))
    force = np.tile([0.0, -300e3, 100e3], (time.size, 1))
    return BearingLoads(time, speed, force, "a swing", event)


def test_an_event_is_computed_from_its_first_sample(bearing):
    loads = [_swing(bearing, event=event, turns=2.2) for event in (True, False)]
    event, other = (simulate(Case(loads=load, rollers=[0], integrator=COARSE)) for load in loads)
    assert event.attrs["window_start"] == 0.0 and event.sizes["orbit"] == 2
    assert other.attrs["window_start"] == pytest.approx(event.orbit_end[0].item(), abs=1e-9)
    assert other.sizes["orbit"] == 1
    # The second orbit is the same in both; the first one is in the event alone.
    np.testing.assert_allclose(
        other.orbit_energy.isel(orbit=0), event.orbit_energy.isel(orbit=1), rtol=1e-3
    )
    assert (event.energy.sum("interface") > 1.2 * other.energy.sum("interface")).all()


def test_a_given_window_holds_for_an_event_too(bearing):
    from macroslip import Window

    loads = _swing(bearing, event=True, turns=2.2)
    case = Case(loads=loads, rollers=[0], window=Window(start=8.0), integrator=COARSE)
    assert simulate(case).attrs["window_start"] == 8.0


def test_peaks_of_a_window_without_a_complete_orbit_are_those_of_the_traces(bearing):
    loads = _swing(bearing, event=True)
    traces = Traces(step=0.002)
    result = simulate(Case(loads=loads, rollers=[0, 9], traces=traces, integrator=COARSE))
    assert result.sizes["orbit"] == 0 and (result.status == 0).all()
    traced = result.power.max("time")
    peak = result.window_peak_power
    assert (peak >= traced * (1.0 - 1e-9)).all()
    np.testing.assert_allclose(peak.max(), traced.max(), rtol=0.03)
    # Rollers pass 0.3 of the orbit, each from its own place on; in places that none passes there is no power.
    places = result.peak_power_by_position
    for row in ("downwind", "upwind"):
        starts = result.start_angle.sel(row=row).values
        way = np.mod(result.position.values[:, None] - starts, 2.0 * np.pi) / (2.0 * np.pi)
        near, far = 3.0 / 72.0, 0.3 + 3.0 / 72.0
        outside = ((way > far) & (way < 1.0 - near)).all(axis=1)
        assert outside.sum() > 20
        assert (places.sel(row=row).values[:, outside] == 0.0).all()
    assert (places.max("position") <= peak.max("roller") * (1.0 + 1e-9)).all()
    np.testing.assert_allclose(places.max(), peak.max(), rtol=0.03)


def test_the_rest_after_the_last_orbit_counts_for_the_peak_of_the_window(bearing):
    """All slip power lies in the last, incomplete orbit: the shaft creeps, and at the end it is sped up."""
    time = np.linspace(0.0, 40.0, 801)
    turn = 2.0 * np.pi / orbit_ratio(bearing)
    speed = np.where(time < 38.0, 1.05 * turn / 38.0, 1.05 * turn / 38.0 + (time - 38.0) * 2.0)
    force = np.tile([0.0, -300e3, 100e3], (time.size, 1))
    loads = BearingLoads(time, speed, force, "late", True)
    result = simulate(Case(loads=loads, rollers=[0], integrator=COARSE))
    assert result.sizes["orbit"] >= 1
    inside = result.orbit_end[-1].item()
    assert inside < 40.0
    assert result.window_peak_power.max() > 1.5 * result.peak_power.isel(orbit=0).max()


@pytest.mark.parametrize("name", ["idle-6", "parked-12", "estop-20"])
@pytest.mark.parametrize("laws", [Laws.paper(), Laws.physical()], ids=["paper", "physical"])
def test_a_slice_of_bundled_events(name, laws):
    loads = HubLoads.bundled(name)
    result = simulate(Case(loads=loads.window(30.0, 50.0), rollers=[0, 14], laws=laws))
    assert (result.status == 0).all() and result.attrs["window_start"] == 30.0
    assert bool(np.isfinite(result.window_peak_power).all())
    assert "its supervisor is assumed" in result.attrs["title"]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["start-8", "idle-25", "stop-24"])
def test_a_slice_of_bundled_events_under_the_physical_model(name):
    loads = HubLoads.bundled(name).window(38.0, 48.0)
    result = simulate(Case(loads=loads, rollers=[0], laws=Laws.physical(), integrator=COARSE))
    assert (result.status == 0).all() and bool((result.window_peak_power >= 0.0).all())


@pytest.mark.slow
def test_a_slice_of_an_emergency_stop_of_the_whole_bearing():
    case = Case(
        loads=HubLoads.bundled("estop-20").window(46.0, 49.0),
        dynamics="whole-bearing",
        rollers=[0, 14],
        integrator=COARSE,
    )
    result = simulate(case)
    assert (result.status == 0).all() and bool((result.window_peak_power > 0.0).any())
