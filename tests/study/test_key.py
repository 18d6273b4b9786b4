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


def test_a_changed_program_and_a_law_of_ones_own_change_it(monkeypatch):
    before = case_key(Case(loads=LOADS), {})
    monkeypatch.setattr("macroslip.compiled._extra_sources", ["def traction(): ..."])
    with_law = case_key(Case(loads=LOADS), {})
    monkeypatch.setattr(module, "_sources", lambda: "another program")
    assert len({before, with_law, case_key(Case(loads=LOADS), {})}) == 3


def test_every_source_that_results_depend_on_enters(tmp_path, monkeypatch):
    import shutil
    from pathlib import Path

    import macroslip

    copy = tmp_path / "macroslip"
    shutil.copytree(Path(macroslip.__file__).parent, copy, ignore=shutil.ignore_patterns("__pycache__", "*.parquet"))
    monkeypatch.setattr(macroslip, "__file__", str(copy / "__init__.py"))

    def sources():
        return module._sources.__wrapped__()

    before = sources()
    for name, counts in (
        ("result/simulate.py", True),
        ("roller/forces.py", True),
        ("loads/openfast.py", True),
        ("study/summary.py", True),
        ("study/run.py", False),
        ("cli/run.py", False),
    ):
        path = copy / name
        text = path.read_text()
        path.write_text(text + "\n# changed\n")
        assert (sources() != before) == counts, name
        path.write_text(text)
