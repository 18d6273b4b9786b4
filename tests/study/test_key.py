"""The key of a case: it changes with everything the result depends on, and with nothing else."""

import dataclasses

import pytest

from macroslip import BearingLoads, Case, Radau, Window
from macroslip.study import key as module
from macroslip.study.key import case_key

LOADS = BearingLoads.constant([0.0, -300e3, 10e3], 2.0, 10.0)


@pytest.mark.parametrize(
    "change",
    [
        {"drag": False}, {"rollers": [0]}, {"integrator": Radau(tolerance=1e-5)}, {"window": Window(start=1.0)},
        {"loads": LOADS.window(0.0, 9.0)}, {"loads": BearingLoads.constant([0.0, -300e3, 10.000001e3], 2.0, 10.0)},
        {"bearing": Case(loads=LOADS).bearing.replace(diametral_clearance=1.3e-4)},
    ],
)  # fmt: skip
def test_any_change_of_input_changes_it(change):
    case = Case(loads=LOADS)
    assert case_key(dataclasses.replace(case, **change), {}) != case_key(case, {})


def test_where_the_loads_are_does_not_matter():
    moved = BearingLoads(LOADS.time, LOADS.shaft_speed, LOADS.force, "elsewhere.csv")
    assert case_key(Case(loads=moved), {}) == case_key(Case(loads=LOADS), {})


def test_what_is_stored_beside_matters():
    assert case_key(Case(loads=LOADS), {"cycles": True}) != case_key(Case(loads=LOADS), {"cycles": False})


def test_which_variables_are_stored_matters():
    assert case_key(Case(loads=LOADS), {"keep": ["energy"]}) != case_key(Case(loads=LOADS), {"keep": None})


def test_a_changed_program_and_a_law_of_ones_own_change_it(monkeypatch):
    before = case_key(Case(loads=LOADS), {})
    monkeypatch.setattr("macroslip.compiled._extra_sources", ["def traction(): ..."])
    with_law = case_key(Case(loads=LOADS), {})
    monkeypatch.setattr(module, "fingerprint", lambda *parts: "another program")
    assert len({before, with_law, case_key(Case(loads=LOADS), {})}) == 3
