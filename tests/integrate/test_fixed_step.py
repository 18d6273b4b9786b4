"""The paper's two Euler methods: order, stability limit, and what a loose nonlinear tolerance does."""

from __future__ import annotations

import numpy as np
import pytest

from macroslip import BackwardEuler, BearingLoads, Case, ExplicitEuler, HubLoads, Radau, Window, simulate
from macroslip.imposed.status import Status

pytestmark = pytest.mark.slow


def run(loads, integrator, roller=3, **settings):
    return simulate(Case(loads=loads, rollers=[roller], integrator=integrator, **settings)).isel(roller=0)


@pytest.fixture(scope="module")
def coasting():
    """Hardly any load: nothing is stiff, so both methods work."""
    return BearingLoads.constant([0.0, -1.0, 0.0], 2.143, 10.0)


@pytest.mark.parametrize("method", [ExplicitEuler, BackwardEuler])
def test_first_order_where_nothing_is_stiff(coasting, method):
    window = Window(start=0.0)
    exact = run(coasting, Radau(tolerance=1e-10), window=window).sel(row="upwind")
    errors = []
    for step in (8e-3, 4e-3, 2e-3):
        found = run(coasting, method(step=step), window=window).sel(row="upwind")
        errors.append([float(found.energy.sum() - exact.energy.sum()), float(found.end_slip - exact.end_slip)])
    orders = np.log2(np.abs(np.array(errors[:-1]) / errors[1:]))
    assert orders == pytest.approx(1.0, abs=0.2)


def test_explicit_euler_is_unstable_in_the_load_zone_and_backward_euler_is_not():
    loads = BearingLoads.constant([0.0, -343e3, 0.0], 2.143, 9.0)
    # Roller 14 starts at the top, unloaded, and meets the load zone after two to three seconds.
    explicit = run(loads, ExplicitEuler(step=1e-3), roller=14).sel(row="downwind")
    backward = run(loads, BackwardEuler(step=1e-3), roller=14).sel(row="downwind")
    exact = run(loads, Radau(tolerance=1e-8), roller=14).sel(row="downwind")
    assert backward.status == Status.COMPLETED
    assert float(backward.energy.sum()) == pytest.approx(float(exact.energy.sum()), rel=2e-2)
    # Unstable does not mean infinite: traction falls with slip. It still is a failure, and shown as one.
    assert explicit.status == Status.IMPOSSIBLE_SLIP
    assert explicit.energy.isnull().all()
    assert 2.0 < float(explicit.end_time) < 3.0


def test_stopping_the_iteration_early_leaves_spurious_force_and_energy():
    loads = HubLoads.bundled("14B").window(0.0, 20.0)
    exact = run(loads, Radau(tolerance=1e-8)).sel(row="downwind")
    found = {t: run(loads, BackwardEuler(step=5e-3, tolerance=t)).sel(row="downwind") for t in (1e-15, 1e-7, 1e-5)}
    cage = {t: float(d.energy.sel(interface="cage")) for t, d in found.items()}
    assert cage[1e-15] == pytest.approx(float(exact.energy.sel(interface="cage")), rel=1e-2)
    assert float(found[1e-15].unbalanced_force) < 0.1
    assert float(found[1e-5].unbalanced_force) > 1.0
    assert cage[1e-5] > 1.05 * cage[1e-15]
