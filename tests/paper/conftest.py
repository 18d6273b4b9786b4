"""The studies of the paper made small: fewer cases, rollers and points, and short windows."""

import pytest

from macroslip.study.study_file import study_of
from paper.studies import compute, content, paper_study


def _small(stage, model, *, bundled=None, points=None, **case):
    """Content of a study with other loads, its first points only, and other keys of its base case."""
    made = content(stage, model)
    made["case"] |= case
    if bundled is not None:
        made["loads"] = {"bundled": bundled}
    if points is not None:
        made["variations"] = {"list": made["variations"]["list"][:points]}
    return made


@pytest.fixture(scope="session")
def small():
    return _small


@pytest.fixture(scope="session")
def small_paper_study(tmp_path_factory):
    """The table of the paper's study under a model: three cases, two rollers a row, thirty seconds."""

    def made(model, bundled=("12C", "14A", "14B"), **case):
        directory = tmp_path_factory.mktemp(model) / "out"
        case = {"rollers": [0, 14], "window": {"end": "30 s"}} | case
        compute(study_of(_small("study", model, bundled=list(bundled), **case)), directory)
        return paper_study(directory)

    return made


@pytest.fixture(scope="session")
def study(small_paper_study):
    return small_paper_study("paper")


@pytest.fixture(scope="session")
def physical_study(small_paper_study):
    return small_paper_study("physical", ("12C", "14A", "24A"), window={"end": "20 s"})
