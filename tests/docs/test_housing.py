"""The table of the page on the housing's shape is that of its runs."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import pytest

DOCS = Path(__file__).parents[2] / "docs"
COLUMNS = {
    "energy of downwind raceways": "energy",
    "largest power": "peak",
    "least film in an orbit": "film",
    "e_a": "pressure_slip",
    "deepest wear a second": "wear",
    "life, ISO/TS 16281": "life",
}


@pytest.fixture(scope="module")
def table():
    return pd.read_csv(DOCS / "housing.csv")


@pytest.mark.parametrize("row", COLUMNS)
def test_ranges_over_a_round_raceway(table, row):
    name = COLUMNS[row]
    round_ones = table[table.amplitude == 0.0].set_index("case")[name]
    ratio = table[name] / table.case.map(round_ones)
    waves = table[table.amplitude > 0.0].groupby(["waves", "amplitude"]).groups
    cells = [f"{ratio[rows].min():.2f} to {ratio[rows].max():.2f}" for rows in waves.values()]
    assert f"| {row} | {' | '.join(cells)} |" in (DOCS / "housing.md").read_text(encoding="utf-8")


def test_every_shape_was_computed_under_both_loads(table):
    assert table.groupby(["waves", "amplitude", "angle"]).size().eq(2).all()
    assert len(table) == 44
