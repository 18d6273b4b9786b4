"""The tables of the page on axial load are those of its runs."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import pytest

DOCS = Path(__file__).parents[2] / "docs"
RATIOS = [0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5]
YEAR = 365.25 * 86400.0
#: Lines of the page: guidance, temperature [°C], row, quantity, factor to its unit, and format.
LINES = {
    "mean load of a roller, downwind [kN]": ("straight", 35.0, "downwind", "mean_load", 1e-3, ".1f"),
    "the same, upwind [kN]": ("straight", 35.0, "upwind", "mean_load", 1e-3, ".1f"),
    "time under load, downwind [%]": ("straight", 35.0, "downwind", "loaded_share", 100.0, ".0f"),
    "lowest spin over rolling, downwind [%]": (
        "straight", 35.0, "downwind", "least_spin_ratio", 100.0, ".0f",
    ),
    "the same, upwind [%]": ("straight", 35.0, "upwind", "least_spin_ratio", 100.0, ".0f"),
    "slide-roll ratio at entry, downwind": (
        "straight", 35.0, "downwind", "entry_slip", 1.0, ".2f",
    ),
    "power of a roller's raceways, downwind [W]": (
        "straight", 35.0, "downwind", "power", 1.0, ".1f",
    ),
    "least Λ at 35 °C, downwind": ("straight", 35.0, "downwind", "film_ratio", 1.0, ".2f"),
    "least Λ at 60 °C, downwind": ("straight", 60.0, "downwind", "film_ratio", 1.0, ".2f"),
    "years to 10 µm at 60 °C, k = 1e-17 m²/N": (
        "straight", 60.0, "downwind", "wear_time", 1.0 / YEAR, ".1f",
    ),
    "mean skew, a pressing spar straightens [mrad]": (
        "pressing spar", 35.0, "downwind", "mean_skew", 1e3, ".1f",
    ),
    "mean skew, stop only [mrad]": ("stop only", 35.0, "downwind", "mean_skew", 1e3, ".1f"),
    "mean skew, stop only, Kellström's friction [mrad]": (
        "stop only, Kellström", 35.0, "downwind", "mean_skew", 1e3, ".1f",
    ),
    "straight [% of the loaded time]": (
        "straight", 60.0, "downwind", "slower_share", 100.0, ".0f",
    ),
    "stop only [% of the loaded time]": (
        "stop only", 60.0, "downwind", "slower_share", 100.0, ".0f",
    ),
}  # fmt: skip


@pytest.fixture(scope="module")
def runs():
    return pd.read_csv(DOCS / "axial-load.csv")


@pytest.fixture(scope="module")
def page():
    return (DOCS / "axial-load.md").read_text(encoding="utf-8")


def series(runs, guidance, celsius, row, quantity):
    lines = runs[(runs.guidance == guidance) & (runs.celsius == celsius) & (runs.row == row)]
    return lines.set_index("ratio")[quantity].loc[RATIOS]


def line(name, values, form):
    cells = ["–" if value != value else f"{value:{form}}" for value in values]
    return f"| {name} | {' | '.join(cells)} |"


@pytest.mark.parametrize("name", LINES)
def test_a_line_of_the_page_is_that_of_its_runs(runs, page, name):
    *where, factor, form = LINES[name]
    assert line(name, factor * series(runs, *where), form) in page


@pytest.mark.parametrize("guidance", ["pressing spar", "stop only"])
def test_power_over_that_of_straight_rollers(runs, page, guidance):
    skewed = series(runs, guidance, 35.0, "downwind", "power")
    ratio = skewed / series(runs, "straight", 35.0, "downwind", "power")
    assert line(f"power over straight rollers, {guidance}", ratio, ".2f") in page


def test_thrust_by_skew_over_the_axial_load(runs, page):
    thrust = series(runs, "stop only", 35.0, "downwind", "frictional_thrust")
    share = 100.0 * thrust / (350e3 * thrust.index.to_numpy())
    assert line("thrust by skew over axial load, stop only [%]", share, ".1f") in page


def test_no_film_of_the_runs_is_below_one(runs):
    assert runs.thin_share.dropna().eq(0.0).all() and runs.film_ratio.min() > 1.0
