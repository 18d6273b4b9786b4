"""A tapered bearing over hub loads: power against torque, grip, temperature and what fails."""

import numpy as np
import pytest

from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.contact.line_rolling import line_contacts
from macroslip.errors import InputError
from macroslip.kinds.tapered.history import (
    HISTORY,
    TaperedMount,
    TaperedState,
    tapered_history,
    warmed,
)
from macroslip.loads.history import HubLoads
from macroslip.lubricant import Lubricant
from tests.variables import check_variables

MAIN = TaperedBearing.read("tdo-main-bearing")
OIL = Lubricant.read("vg460-pao").at(308.15)
LOADS = HubLoads.bundled("14B").window(100.0, 102.0)
MOUNT = TaperedMount(1.26, 1e8, 2.2)


@pytest.fixture(scope="module")
def history():
    return tapered_history(MAIN, OIL, LOADS, MOUNT)


def test_every_variable_has_a_unit_and_a_name(history):
    assert set(history.data_vars) == set(HISTORY)
    assert all({"units", "long_name"} <= set(history[name].attrs) for name in history)
    assert history.failed == 0
    check_variables(history, HISTORY)


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


def test_microslip_and_pressure_of_the_hardest_roller_are_those_of_an_independent_program():
    """L1 at 0.2 mm: 34 µm/s in the mean at the inner raceway; 235 kN press it with nearly 1.9 GPa."""
    speed = 12.0 * 2.0 * np.pi / 60.0
    loads = HubLoads.constant([700e3, 50e3, -1300e3], [0.0, -700e3, 200e3], speed, 1.0, step=1.0)
    history = tapered_history(MAIN, OIL, loads, TaperedMount(0.0)).isel(time=0)
    assert float(history.raceway_microslip.max()) == pytest.approx(34e-6, rel=0.05)
    hardest = history.pressure_along.sel(row="downwind")
    assert float(hardest.max()) == pytest.approx(float(history.contact_pressure.max()))
    inner = line_contacts(MAIN, OIL)[0]
    load = (2.0 * np.pi * hardest**2 / (inner.curvature * inner.modulus)).sum()
    load = load * MAIN.roller_length / hardest.size
    assert float(load) == pytest.approx(float(history.inner_load.max()), rel=1e-9)


def test_a_tilted_roller_is_pressed_at_its_edge(history):
    """Straight rollers under preload alone have the profile's share in the outer tenths."""
    calm = HubLoads.constant([0.0] * 3, [0.0] * 3, 1.2566, 1.0, step=1.0)
    straight = tapered_history(MAIN, OIL, calm, TaperedMount(0.0)).isel(time=0)
    turned = HubLoads.constant([0.0] * 3, [0.0, 2e6, 0.0], 1.2566, 1.0, step=1.0)
    tilted = tapered_history(MAIN, OIL, turned, TaperedMount(0.0)).isel(time=0)
    assert straight.edge_share.values == pytest.approx(straight.edge_share.values[0], rel=1e-6)
    # The rib, through the centre of the sphere, moves the load a little from the middle.
    load = straight.pressure_along.isel(row=0) ** 2
    assert abs(float((load * load.station).sum() / load.sum())) < 2e-3
    edges = tilted.edge_pressure / tilted.contact_pressure
    assert edges.max() > (straight.edge_pressure / straight.contact_pressure).max()
    assert tilted.edge_share.max() > 1.5 * straight.edge_share.max()
    assert (history.edge_pressure <= history.contact_pressure).all()


def test_with_play_rollers_float_by_thirteen_times_their_gap():
    """Play p/2 a row along the shaft is a gap p/2 sin α_o, and 1/(2 sin β) times that along a roller."""
    calm = HubLoads.constant([0.0] * 3, [0.0] * 3, 1.2566, 1.0, step=1.0)
    loose = tapered_history(MAIN.replace(preload=-0.2e-3), OIL, calm, TaperedMount(0.0))
    row = tapered_geometry(MAIN)
    gap = 0.1e-3 * np.sin(row.outer_angle)
    expected = gap / (2.0 * np.sin(row.half_cone_angle))
    assert loose.axial_float.values == pytest.approx(expected, rel=0.01)
    assert expected / gap == pytest.approx(13.1, abs=0.1)
    held = tapered_history(MAIN.replace(preload=0.4e-3), OIL, calm, TaperedMount(0.0))
    assert held.axial_float.max() == 0.0


def test_the_law_of_a_strip_changes_loads_by_up_to_a_fifth():
    calm = HubLoads.constant([0.0] * 3, [0.0] * 3, 1.2566, 1.0, step=1.0)
    soft = tapered_history(MAIN, OIL, calm, TaperedMount(0.0))
    stiff = tapered_history(
        MAIN, OIL, calm, TaperedMount(0.0), TaperedState(line_law="plane-strain")
    )
    ratio = float(stiff.outer_load.max() / soft.outer_load.max())
    assert ratio == pytest.approx(1.2, abs=0.05)
    assert float(soft.other_line_law) == pytest.approx(ratio, rel=1e-6)
    assert float(stiff.other_line_law) == pytest.approx(1.0 / ratio, rel=1e-6)


def test_torque_has_its_parts(history):
    parts = history.rolling_torque + history.rib_torque
    assert parts.values == pytest.approx(history.friction_torque.values, rel=1e-12)
    assert (history.least_load.values == history.outer_load.min("roller").values).all()
