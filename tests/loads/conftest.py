"""Paths of the genuine files the load tests read."""

from pathlib import Path

import pytest

DATA = Path(__file__).parents[1] / "data"


@pytest.fixture(scope="session")
def sample_outb() -> Path:
    """OpenFAST binary output, 14 m/s class B, t = 60 to 120 s at 20 Hz."""
    return DATA / "sample14B.outb"


@pytest.fixture(scope="session")
def sample_out() -> Path:
    """The same run as text with four significant digits."""
    return DATA / "sample14B.out"


@pytest.fixture(scope="session")
def clip_50hz() -> Path:
    """The first 60 s of the record that the bundled case 14B was made from, before it was thinned."""
    return DATA / "hub14B_50Hz.parquet"
