"""A shaft that stands still: a parked turbine, and one that stops and stays."""

import numpy as np
import pytest

from macroslip import BearingLoads, Case, Laws, Window, simulate
from macroslip.imposed.status import Status

pytestmark = pytest.mark.slow

models = pytest.mark.parametrize("laws", [Laws.paper(), Laws.physical()], ids=["paper", "physical"])
FORCE = [20e3, -300e3, 60e3]


def stopping(end):
    time = np.arange(0.0, end + 0.025, 0.05)
    speed = np.clip(2.1 * (1.5 - time), 0.0, 2.1)
    return BearingLoads(time, speed, np.tile(FORCE, (time.size, 1)), "stopping")


@models
def test_nothing_is_spent_where_nothing_moves(laws):
    found = simulate(Case(loads=BearingLoads.constant(FORCE, 0.0, 5.0), laws=laws))
    assert (found.status == Status.COMPLETED).all()
    for name in ("energy", "rolling_energy", "asperity_energy", "end_slip"):
        assert name not in found or float(abs(found[name]).max()) == 0.0
    assert found.min_spin_ratio.isnull().all()


@models
@pytest.mark.parametrize("end", [20.0, 130.0], ids=["by laws", "by tables"])
def test_after_a_stop_energy_stays_as_it_is(laws, end):
    short, long = (
        simulate(Case(loads=stopping(last), laws=laws, rollers=[0, 7, 14], window=Window(start=0.0)))
        for last in (10.0, end)
    )
    assert (long.status == Status.COMPLETED).all() and (short.energy.sum("interface") > 0.0).all()
    np.testing.assert_allclose(long.energy.sum("interface"), short.energy.sum("interface"), rtol=1e-3)
    assert float(abs(long.end_slip).max()) < 1e-3


@models
@pytest.mark.parametrize("loads", [BearingLoads.constant(FORCE, 0.0, 2.0), stopping(3.0)], ids=["parked", "stopping"])
def test_the_whole_bearing_stands_still_too(laws, loads):
    found = simulate(Case(loads=loads, laws=laws, dynamics="whole-bearing", window=Window(start=0.0)))
    assert (found.status == Status.COMPLETED).all()
    assert np.isfinite(found.energy).all() and np.isfinite(found.end_slip).all()
    # Rollers and cage fall into their places, and the books of energy close.
    spent = found.energy.sum() + found.pocket_loss[-1]
    assert float(abs(found.energy_residual[-1])) < 5e-3 * float(spent)
