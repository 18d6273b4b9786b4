"""Turns of single rollers, and the Euler methods against converged references."""

import numpy as np
import pytest
import xarray as xr

from macroslip import Drivetrain, HubLoads, InputError, Laws, main_bearing_load
from paper.experiments import (
    compare_stability,
    inflexion_angle,
    nonlinear_tolerance,
    static_load,
    static_turn,
    step_size,
    trace_turn,
)

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def varying():
    return main_bearing_load(HubLoads.bundled("14B"), Drivetrain())


@pytest.fixture(scope="module")
def downward(varying):
    return static_turn(varying, "downwind", thrust=False)


def test_a_turn_under_downward_load(downward):
    assert downward.angle.values[0] == pytest.approx(0.0, abs=1e-3)
    assert downward.angle.values[-1] == pytest.approx(360.0, abs=1e-3)
    free = downward.roller_load == 0.0
    assert free.sel(angle=180.0, method="nearest")
    assert not free.sel(angle=0.0, method="nearest")
    assert downward.energy_fraction.values[-1] == 1.0
    assert (np.diff(downward.energy_fraction) >= 0.0).all()
    # The traces' trapezoids and the integrator's own quadrature are two ways to the same energy.
    assert downward.attrs["energy_from_traces_J"] == pytest.approx(
        downward.attrs["energy_J"], rel=1e-5
    )
    assert downward.spin_speed.max() <= 1.0001 * downward.spin_speed_pure.max()


def test_a_turn_with_microslip(varying, downward):
    turn = static_turn(varying, "downwind", thrust=False, laws=Laws.physical())
    assert turn.attrs["energy_from_traces_J"] == pytest.approx(turn.attrs["energy_J"], rel=1e-4)
    assert turn.attrs["energy_J"] > 10.0 * downward.attrs["energy_J"]
    np.testing.assert_allclose(turn.roller_load, downward.roller_load, rtol=1e-9)


def test_a_turn_needs_a_whole_turn(varying):
    with pytest.raises(InputError, match="no whole turn"):
        trace_turn(varying, "downwind", 0, 599.9)


def test_inflexion_is_the_steepest_rise_of_spin():
    angle = np.linspace(0.0, 360.0, 721)
    load = np.where(np.abs(angle - 180.0) < 120.0, 0.0, 1.0)
    spin = 9.0 - 0.02 * angle + np.tanh((angle - 170.0) / 30.0)
    turn = xr.Dataset(
        {"spin_speed": ("angle", spin), "roller_load": ("angle", load)}, {"angle": angle}
    )
    assert inflexion_angle(turn) == pytest.approx(170.0, abs=0.5)
    assert np.isnan(inflexion_angle(turn.assign(spin_speed=("angle", 9.0 - 1e-5 * angle**2))))


def test_explicit_euler_is_lost_where_the_step_exceeds_the_relaxation_time(varying):
    stability = compare_stability(static_load(varying, thrust=False, duration=3.5))
    limit, lost = stability.attrs["limit_angle_deg"], stability.attrs["lost_angle_deg"]
    assert stability.attrs["limit_relaxation_time_s"] <= 0.5e-3
    assert limit <= lost < limit + 5.0
    assert stability.deviation_explicit.sel(angle=slice(None, limit)).max() < 0.02
    assert stability.attrs["largest_deviation_backward"] < 0.01


def test_a_loose_iteration_adds_energy_only_to_a_gripped_roller_under_varying_load(varying):
    experiment = nonlinear_tolerance(varying.window(0.0, 26.0), tolerances=(1e-12, 1e-6))
    tight, loose = experiment.sel(stopping_tolerance=1e-12), experiment.sel(stopping_tolerance=1e-6)
    np.testing.assert_allclose(tight.energy, experiment.energy_converged, rtol=0.01)
    assert loose.ratio.sel(row="downwind") > 100.0
    assert loose.ratio.sel(row="upwind") < 1.5
    np.testing.assert_allclose(loose.static_energy, tight.static_energy, rtol=1e-3)


def test_a_coarse_step_misses_the_peak(varying):
    experiment = step_size(varying, start=360.0, end=375.0, steps=(1e-2, 3e-3), rollers=(0,))
    assert experiment.mean_peak_power.sel(
        row="upwind"
    ).max() < experiment.mean_peak_power_converged.sel(row="upwind")
