"""The year of a spherical and a tapered bearing: its results are complete, and the page has their tables."""

import importlib
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

DOCS = Path(__file__).parents[2] / "docs"


@pytest.fixture(scope="module")
def year():
    sys.path.insert(0, str(DOCS))
    try:
        return importlib.import_module("tapered_year")
    finally:
        sys.path.remove(str(DOCS))


def test_every_case_is_there_with_every_number(year):
    assert list(year.cases(set(cases_of(year)))) == []
    assert not year.results().loc[[rib.name for rib in year.RIBS]].isna().any(axis=None)
    for variant in year.VARIANTS:
        known = year.results().loc[variant.name]
        assert {"raceway power", "entry_rate", "reference life", "film below 3"} <= set(known.index)
        assert not known.isna().any(axis=None)


def cases_of(year):
    """Variants and wind speeds of the file of results."""
    table = pd.read_csv(year.RESULTS)
    return zip(table.variant, table.wind, strict=True)


def test_the_page_has_the_tables(year):
    page = (DOCS / "tapered.md").read_text(encoding="utf-8")
    for table in year.page_tables():
        assert year.text_of(table) in page


def test_hours_of_the_classes_are_those_of_a_rayleigh_wind(year):
    wind = np.random.default_rng(1).rayleigh(8.5 / np.sqrt(np.pi / 2.0), 400_000)
    counted = np.histogram(wind, year.EDGES)[0] / wind.size
    assert (year.seconds_of_year() / year.YEAR).to_numpy() == pytest.approx(counted, abs=3e-3)
