"""A tapered bearing over hub loads: power against torque, grip, temperature and what fails."""

import numpy as np
import pytest

from macroslip.bearing.tapered import TaperedBearing
from macroslip.errors import InputError
from macroslip.loads.history import HubLoads
from macroslip.lubricant import Lubricant
from macroslip.result.tapered import VARIABLES, TaperedMount, TaperedState, tapered_history, warmed

MAIN = TaperedBearing.read("tdo-main-bearing")
OIL = Lubricant.read("vg460-pao").at(308.15)
LOADS = HubLoads.bundled("14B").window(100.0, 102.0)
MOUNT = TaperedMount(1.26, 1e8, 2.2)


@pytest.fixture(scope="module")
def history():
    return tapered_history(MAIN, OIL, LOADS, MOUNT)


def test_every_variable_has_a_unit_and_a_name(history):
    assert set(history.data_vars) == set(VARIABLES)
    assert all({"units", "long_name"} <= set(history[name].attrs) for name in history)
    assert history.failed == 0


def test_energy_of_the_window_is_torque_times_angle(history):
    power = (history.rolling_power + history.rib_power).sum("row")
    energy = np.trapezoid(power, LOADS.time)
    turned = np.trapezoid(history.friction_torque * LOADS.shaft_speed, LOADS.time)
    assert energy == pytest.approx(float(turned), rel=1e-12)


def test_rows_carry_the_thrust_between_them(history):
    sine = np.sin(MAIN.outer_angle)
    thrust = history.outer_load.sum("roller") * sine
    net = thrust.sel(row="downwind") - thrust.sel(row="upwind")
    assert net.values == pytest.approx(LOADS.force[:, 0], rel=1e-4)


def test_grip_is_counted_from_the_loads(history):
    counted = (history.outer_load < history.grip_load).sum("roller")
    assert np.array_equal(counted, history.below_grip)


def test_a_warmer_inner_ring_grips_more_rollers_and_presses_them_harder():
    cold = tapered_history(MAIN, OIL, LOADS, MOUNT, TaperedState(temperature_difference=-10.0))
    warm = tapered_history(MAIN, OIL, LOADS, MOUNT, TaperedState(temperature_difference=10.0))
    assert cold.preload < 0.0001 < warm.preload
    assert float(warm.preload_change) == pytest.approx(15.14e-5, rel=1e-3)
    assert warm.below_grip.sum() < cold.below_grip.sum()
    assert warm.friction_torque.mean() > cold.friction_torque.mean()


def test_a_shaft_at_rest_has_no_torque_and_no_grip():
    still = HubLoads(
        np.array([0.0, 1.0]), np.zeros(2), LOADS.force[:2], LOADS.moment[:2], "at rest"
    )
    history = tapered_history(MAIN, OIL, still, MOUNT)
    assert np.isnan(history.friction_torque).all()
    assert np.isnan(history.grip_load)
    assert history.outer_load.sum() > 0.0


def test_a_temperature_difference_beyond_the_range_of_preload_is_refused():
    with pytest.raises(InputError, match="preload"):
        warmed(MAIN, 1000.0)


def test_a_negative_length_is_refused():
    with pytest.raises(InputError, match="hub_to_bearing"):
        TaperedMount(-1.0)
