"""Exact limits and bounds of the slip equation that no numerical method may miss."""

from __future__ import annotations

import math

import numpy as np
import pytest

from macroslip import (
    BearingLoads,
    Case,
    Drivetrain,
    HubLoads,
    Laws,
    Radau,
    Traces,
    Window,
    main_bearing_load,
    simulate,
)
from macroslip.bearing import geometry

pytestmark = pytest.mark.slow

ORBIT_RATIO = 0.4539395888955974


@pytest.fixture(scope="module")
def gusty():
    loads = main_bearing_load(HubLoads.bundled("12A").window(30.0, 70.0), Drivetrain())
    case = Case(
        loads=loads,
        laws=Laws.paper(),
        rollers=[0, 11, 19],
        traces=Traces(step=0.01, start=30.005),
        integrator=Radau(tolerance=1e-7),
    )
    return loads, simulate(case)


def test_without_weight_and_load_spin_hardly_follows_the_shaft():
    """Centrifugal force, 1 N, is all that presses the roller on a raceway: it lags behind pure rolling all the time."""
    time = np.linspace(0.0, 4.0, 81)
    loads = BearingLoads(time, 2.0 + 0.1 * time, np.zeros((81, 3)), "spin-up")
    case = Case(
        loads=loads,
        laws=Laws.paper(),
        gravity=False,
        drag=False,
        rollers=[0],
        traces=Traces(step=0.25),
        window=Window(start=0.0),
    )
    result = simulate(case).isel(roller=0)
    change = abs(result.spin - result.spin.isel(time=0))
    wanted = abs(result.spin_pure - result.spin_pure.isel(time=0))
    assert (change <= wanted + 1e-12).all()
    assert float((change / wanted).isel(time=-1).max()) < 0.2
    assert (result.traction.sel(interface="inner") == 0.0).all()


def test_traction_balances_inertia_and_cage_friction(gusty):
    """F_i + F_o = I_z' ω̇/r − F_c; a gripped roller's ω̇ is that of pure rolling."""
    loads, result = gusty
    gripped = (result.roller_load > 20e3) & (abs(result.slip) < 1e-7)
    assert int(gripped.sum()) > 1000
    total = result.traction.sel(interface="inner") + result.traction.sel(interface="outer")
    mass = geometry.roller_mass(7850.0, 0.035, 0.106)
    sample = np.clip(
        np.searchsorted(loads.time, result.time.values, side="left") - 1, 0, loads.time.size - 2
    )
    acceleration = np.diff(loads.shaft_speed)[sample] / np.diff(loads.time)[sample]
    spin_rate = -ORBIT_RATIO * acceleration * 0.4070334304372217 / 0.035
    needed = 0.5 * mass * 0.035 * spin_rate - result.traction.sel(interface="cage")
    assert float(abs(total - needed).where(gripped).max()) < 1e-6


def test_gripped_rollers_carry_only_weight_and_drag_at_the_cage(gusty):
    _, result = gusty
    gripped = (result.roller_load > 5e3) & (abs(result.slip) < 1e-4)
    total = result.traction.sel(interface="inner") + result.traction.sel(interface="outer")
    difference = result.traction.sel(interface="inner") - result.traction.sel(interface="outer")
    assert (abs(difference) <= abs(total) + 1e-9).where(gripped, True).all()
    assert float(abs(result.cage_force).where(gripped).max()) < 32.2


def test_rollers_of_a_row_take_turns_under_a_steady_load():
    """Under constant load each roller repeats what the one ahead did a pitch earlier."""
    pitch = 2 * math.pi / 28 / (ORBIT_RATIO * 2.143)
    loads = BearingLoads.constant([0.0, -343e3, 50e3], 2.143, 26.0, step=pitch / 4)
    case = Case(
        loads=loads,
        laws=Laws.paper(),
        rollers=[0, 1],
        integrator=Radau(tolerance=1e-8),
        traces=Traces(step=pitch / 4),
        window=Window(start=0.0),
    )
    result = simulate(case)
    first, second = result.spin.isel(roller=0).values, result.spin.isel(roller=1).values
    settled = result.time.values > 14.0
    settled[-8:] = False
    ahead = np.flatnonzero(settled)
    assert first[:, ahead + 4] == pytest.approx(second[:, ahead], rel=2e-4)
