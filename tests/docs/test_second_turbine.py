"""Rules of the page on a second turbine, on measures that are known."""

import importlib
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

DOCS = Path(__file__).parents[2] / "docs"


@pytest.fixture(scope="module")
def rules():
    sys.path.insert(0, str(DOCS))
    try:
        return importlib.import_module("second_turbine_conclusions")
    finally:
        sys.path.remove(str(DOCS))


def _seat(rules, measures):
    """A seat whose measures over the wind are given by row and quantity."""
    lines = [
        (row, quantity, wind, "physical", rules.AS_IT_IS, value)
        for (row, quantity), values in measures.items()
        for wind, value in zip(rules.WINDS.tolist(), values, strict=True)
    ]
    columns = ["row", "quantity", "wind", "model", "variant", "value"]
    return rules.Seat(pd.DataFrame(lines, columns=columns))


def _conclusion(rules, words):
    return next(conclusion for conclusion in rules.CONCLUSIONS if words in conclusion.statement)


def test_shares_of_a_year_are_those_of_a_rayleigh_distribution(rules):
    rng = np.random.default_rng(1)
    wind = rng.rayleigh(8.5 / np.sqrt(np.pi / 2.0), 400_000)
    edges = np.arange(3.0, 26.0, 2.0)
    counted = np.histogram(wind, edges)[0] / wind.size
    assert rules.rayleigh_shares(8.5) == pytest.approx(counted, abs=2e-3)
    # 4 to 10 m/s is the wind from 3 to 11 m/s.
    constant = rules.below_rated(np.ones(rules.WINDS.size))
    assert constant == pytest.approx(counted[:4].sum() / counted.sum(), abs=3e-3)


def test_a_row_is_idle_where_its_rollers_are_hardly_pressed(rules):
    idle = _conclusion(rules, "the upwind row is idle")
    rare = [0.3, 0.2, *[0.05] * 9]
    assert idle.holds(_seat(rules, {("upwind", "pressed"): rare}))
    assert not idle.holds(_seat(rules, {("upwind", "pressed"): [0.3] * 11}))


def test_what_is_not_there_cannot_be_asked(rules):
    seat = _seat(rules, {("upwind", "pressed"): [0.3] * 11})
    text = rules.table_text((_conclusion(rules, "nearly the same"),), {"mine": seat})
    assert text.splitlines()[-1].endswith("| cannot be asked |")


def test_friction_and_the_share_of_the_cage(rules):
    parts = {
        ("downwind", f"energy {interface}"): [1.0] * 11 for interface in ("inner", "outer", "cage")
    }
    seat = _seat(rules, parts)
    assert seat.friction("downwind") == pytest.approx([3.0] * 11)
    assert seat.cage_share("downwind") == pytest.approx([1.0 / 3.0] * 11)
    assert _conclusion(rules, "the cage has a quarter").holds(seat)


def test_the_page_has_every_conclusion(rules):
    page = (DOCS / "second-turbine.md").read_text(encoding="utf-8")
    for conclusion in rules.CONCLUSIONS:
        assert f"| {conclusion.page} | {conclusion.statement} |" in page
    held = [
        line.split("|")[4].count("**holds**") for line in page.splitlines() if line.count("|") == 6
    ]
    assert f"Of {len(rules.CONCLUSIONS)} conclusions {sum(held)} hold at `nrel5`" in page
