"""The studies of the reproduction made small: fewer cases, rollers and points, and short windows."""

import json

import pytest

from macroslip.reproduction.paper_study import paper_study
from macroslip.reproduction.studies import computed, reproduction_study
from macroslip.study.study_file import study_of


def _small(name, *, bundled=None, points=None, **case):
    """A study of the reproduction with other loads, its first points only, and other keys of its base case."""
    content = json.loads(json.dumps(reproduction_study(name).content))
    content["case"] |= case
    if bundled is not None:
        content["loads"]["bundled"] = bundled
    if points is not None:
        content["variations"]["list"] = content["variations"]["list"][:points]
    return study_of(content)


@pytest.fixture(scope="session")
def small():
    return _small


@pytest.fixture(scope="session")
def small_paper_study(tmp_path_factory):
    """The table of the paper's study under a model: three cases, two rollers a row, thirty seconds."""

    def made(name, bundled=("12C", "14A", "14B"), **case):
        directory = tmp_path_factory.mktemp(name) / "out"
        case = {"rollers": [0, 14], "window": {"end": "30 s"}} | case
        computed(_small(name, bundled=list(bundled), **case), directory)
        return paper_study(directory)

    return made


@pytest.fixture(scope="session")
def study(small_paper_study):
    return small_paper_study("study_paper")
