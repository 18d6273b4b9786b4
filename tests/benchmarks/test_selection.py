"""Which run counts: the cheapest that is accurate in both quantities. On made-up numbers."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from benchmarks.comparison import Entry, _euler_entry, spread
from benchmarks.outcome import ASKED, Measurement, Reference, Solution, cheapest, errors
from benchmarks.rivals import RIVALS
from benchmarks.scan import scan
from benchmarks.work_precision import least_cost

REFERENCE = Reference(1.0, np.array([-0.2, -1e-5]), np.array([0.4, 0.4]))


def outcome(energy, spin, seconds):
    return Measurement({}, energy, spin, seconds, 10.0)


def test_the_cheapest_accurate_run_counts():
    runs = [
        outcome(1e-6, 1e-6, 3.0),
        outcome(9e-5, 9e-5, 2.0),
        outcome(1e-6, 2e-4, 1.0),
        outcome(2e-4, 0.0, 0.5),
    ]
    assert cheapest(runs) == (runs[1], True)


def test_without_an_accurate_run_the_most_accurate_counts_and_is_marked():
    runs = [outcome(1e-3, 0.0, 1.0), outcome(2e-4, 3e-4, 5.0), outcome(math.inf, 0.0, 0.1)]
    assert cheapest(runs) == (runs[1], False)
    with pytest.raises(ValueError, match="nothing"):
        cheapest([])


def test_errors_look_at_coasts_only_and_at_failures():
    # The second mark grips: an error of 1 % of the raceway speed there says nothing about a coast.
    energy, spin = errors(
        Solution(np.array([0.5, 0.25, 0.25001]), np.array([-0.2004, 4e-3]), 1.0), REFERENCE
    )
    assert energy == pytest.approx(1e-5) and spin == pytest.approx(1e-3)
    assert errors(Solution(np.full(3, np.nan), np.zeros(2), 1.0), REFERENCE)[0] == math.inf
    assert errors(Solution(np.ones(3), np.full(2, np.nan), 1.0), REFERENCE)[1] == math.inf


def fake(log):
    """A method whose error is its rtol, whose evaluations grow as rtol and atol fall."""

    def solve(rtol, atol, most_evaluations=math.inf):
        log.append((rtol, atol))
        evaluations = 1.0 / (rtol * atol) ** 0.5
        energy = (
            np.array([1.0 + rtol, 0.0, 0.0])
            if evaluations <= most_evaluations
            else np.full(3, np.nan)
        )
        return Solution(energy, REFERENCE.slip, evaluations)

    return solve


SETTINGS = [{"rtol": rtol, "atol": atol} for rtol in (1e-3, 5e-5, 1e-6) for atol in (1e-6, 1e-8)]


def test_a_scan_tries_all_and_puts_an_accurate_run_first():
    log = []
    measurements = scan(fake(log), SETTINGS, REFERENCE, budget=math.inf, prune=False)
    assert {(setting["rtol"], setting["atol"]) for setting in SETTINGS} <= set(log)
    assert len(measurements) == len(SETTINGS)
    assert measurements[0].setting["rtol"] <= ASKED


def test_pruning_leaves_out_what_is_dearer_for_certain():
    log = []
    measurements = scan(fake(log), SETTINGS, REFERENCE, budget=math.inf, prune=True)
    assert (5e-5, 1e-6) in log and (5e-5, 1e-8) not in log
    # 1e-6 needs more evaluations than the run already found, and is given up.
    assert [
        measurement.error for measurement in measurements if measurement.setting["rtol"] == 1e-6
    ] == [
        math.inf,
        math.inf,
    ]
    assert measurements[0].setting == {"rtol": 5e-5, "atol": 1e-6}


def test_a_spent_budget_ends_the_scan():
    log = []
    scan(fake(log), SETTINGS, REFERENCE, budget=0.0, prune=False)
    assert len(set(log)) == 1


def first_order(step, tolerance):
    return Solution(np.array([1.0 + 0.2 * step, 0.0, 0.0]), REFERENCE.slip, 1.0 / step)


@pytest.mark.parametrize(("budget", "extrapolated"), [(math.inf, False), (0.0, True)])
def test_backward_euler_gets_the_step_that_is_just_short_enough(budget, extrapolated):
    tried = [Measurement({"step": 1e-2, "tolerance": 1e-13}, 2e-3, 0.0, 1.0, 100.0)]
    entry = _euler_entry(first_order, tried, REFERENCE, budget)
    assert (entry.reached, entry.extrapolated) == (True, extrapolated)
    assert entry.best.setting["step"] == pytest.approx(4.5e-4)
    assert entry.best.error == pytest.approx(0.9 * ASKED)
    if extrapolated:
        assert entry.best.seconds == pytest.approx(1e-2 / 4.5e-4)


def test_spread_ignores_what_was_not_reached():
    assert spread([math.nan, 4.0, 2.0]) == {"median": 3.0, "min": 2.0, "max": 4.0}
    assert math.isnan(spread([math.nan])["median"])


def test_the_diagram_shows_the_least_cost_at_every_error():
    history = SimpleNamespace(start=0.0, end=10.0, marks=np.ones(1))
    still = SimpleNamespace(start=0.0, end=10.0, marks=np.empty(0))
    runs = [outcome(5e-3, 5e-3, 1.0), outcome(5e-5, 5e-5, 4.0)]
    entries = [
        Entry(runs[1], True, runs, False, 1.0),
        Entry(runs[1], True, [outcome(5e-5, 0.0, 9.0)], False, 1.0),
    ]
    energy = least_cost(entries, [history, still], "energy_error")
    assert [cost for _, cost in energy] == pytest.approx([0.3, 0.6])
    assert least_cost(entries, [history, still], "spin_error")[-1] == (
        pytest.approx(1e-4),
        pytest.approx(0.4),
    )


def test_every_rival_has_settings_and_a_target():
    for rival in RIVALS:
        for edges in (False, True):
            for quick in (False, True):
                settings = list(rival.settings(edges, quick))
                assert settings and len({str(setting) for setting in settings}) == len(settings)
        assert rival.target >= 5.0
