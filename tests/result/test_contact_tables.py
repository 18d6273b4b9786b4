"""Whole runs by tables against whole runs by the laws, and when which of them is used."""

from dataclasses import replace

import numpy as np
import pytest

from macroslip import BearingLoads, Case, HubLoads, Laws, Radau, simulate
from macroslip.imposed.status import Status

CASE = Case(loads=HubLoads.bundled("14B").window(30.0, 151.0), laws=Laws.physical(), rollers=[7])


@pytest.fixture(scope="module")
def looked_up():
    return simulate(CASE)


@pytest.fixture(scope="module")
def by_laws():
    return _by_laws(CASE)


def _by_laws(case):
    """The case with its contacts by the laws themselves."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("macroslip.result.evaluation.needs_tables", lambda model: False)
        return simulate(case)


def test_a_long_history_is_looked_up_and_tells_the_errors_of_its_tables(looked_up, by_laws):
    found = looked_up.attrs
    assert found["contact_evaluation"] == "tables"
    assert 0.0 < found["table_error_typical"] <= 1e-5 < found["table_error_worst"] <= 1.5e-4
    assert 0.9 < found["table_share"] <= 1.0 and found["table_size"] > 1e6 and found["table_build_time"] > 0.0
    assert by_laws.attrs["contact_evaluation"] == "laws: they need no table" and "table_size" not in by_laws.attrs


def test_results_are_those_of_the_laws(looked_up, by_laws):
    assert (looked_up.status == Status.COMPLETED).all() and (by_laws.status == Status.COMPLETED).all()
    for name, most in (("energy", 5e-5), ("orbit_energy", 2e-4), ("rolling_energy", 5e-5)):
        total = looked_up[name].sum("interface") / by_laws[name].sum("interface") - 1.0
        assert float(abs(total).max()) < most, name
    peak = looked_up.peak_power.max("interface") / by_laws.peak_power.max("interface") - 1.0
    assert float(abs(peak).max()) < 2e-3
    for name in ("mechanism_energy", "asperity_energy", "station_energy"):
        scale = float(by_laws[name].sel(row="downwind").max())
        assert float(abs(looked_up[name] - by_laws[name]).sel(row="downwind").max()) < 2e-4 * scale, name
    # Spin is good to 1e-4 of pure rolling at the default tolerance in either run, whose steps are not the same.
    np.testing.assert_allclose(looked_up.min_spin_ratio, by_laws.min_spin_ratio, rtol=0.0, atol=2e-4)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"laws": Laws.paper()}, "laws: they need no table"),
        ({"integrator": Radau(tolerance=1e-5)}, "laws: the tolerance is below 2e-05"),
        ({"loads": HubLoads.bundled("14B").window(30.0, 45.0)}, "laws: the history is shorter than 120 s"),
        ({"loads": BearingLoads.constant([0.0, -3e5, 0.0], 0.0, 121.0)}, "laws: the shaft stands still"),
    ],
)
def test_when_laws_are_asked(changes, words):
    assert simulate(replace(CASE, **changes)).attrs["contact_evaluation"] == words


def test_a_shaft_that_turns_round():
    """Through standstill, where no table reaches, and back."""
    time = np.array([0.0, 60.0, 120.0])
    loads = BearingLoads(time, np.array([1.5, -1.5, -1.0]), np.tile([0.0, -2e5, 1e5], (3, 1)), "made")
    case = Case(loads=loads, laws=Laws.physical(), rollers=[0])
    found, expected = simulate(case), _by_laws(case)
    assert found.attrs["contact_evaluation"] == "tables"
    assert (found.status == Status.COMPLETED).all() and (expected.status == Status.COMPLETED).all()
    total = found.energy.sum("interface") / expected.energy.sum("interface") - 1.0
    assert float(abs(total).max()) < 1e-4
