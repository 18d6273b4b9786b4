"""The folder of a study with random damage, read as `aggregate` and `report` read it."""

import os

import pytest
from hypothesis import given
from hypothesis import strategies as st

from benchmarks.large_study import study, write_study
from macroslip import InputError
from macroslip.storage.files import DATABASE, MANIFEST, SUMMARY
from macroslip.study.aggregation import Aggregation
from macroslip.study.export import tables
from macroslip.study.reader import open_study, stored_results
from macroslip.study.weights import Weibull
from tests.fuzz.mutations import damaged
from tests.fuzz.oracle import app_of, ends_well, examples


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("folder")
    write_study(folder / "study", study(14))
    return folder


@pytest.fixture(scope="module")
def contents(folder):
    (result,) = (folder / "study" / "cases").rglob("*.nc")
    names = [MANIFEST, DATABASE, SUMMARY, str(result.relative_to(folder / "study"))]
    return {name: (folder / "study" / name).read_bytes() for name in names}


def _tables(path):
    """All tables, and the first stored result."""
    study = open_study(path)
    assert set(tables(study, Aggregation(Weibull(9.5, 2.0)))) >= {"cases", "lifetime"}
    next(stored_results(path), None)


def _ends_well(folder):
    return ends_well(folder, folder / "study", folder / "study", app=app_of(_tables))


def _with(folder, contents, **changed):
    for name, content in (contents | changed).items():
        (folder / "study" / name).write_bytes(content)


def test_undamaged_is_accepted(folder, contents):
    _with(folder, contents)
    (result,) = (folder / "study" / "cases").rglob("*.nc")
    assert "a stored result cannot be read" in _ends_well(folder)  # one result of fourteen is there
    assert result.is_file()


@pytest.mark.slow
@examples(40)
@given(data=st.data())
def test_damaged(folder, contents, data):
    name = data.draw(st.sampled_from(sorted(contents)))
    content = data.draw(damaged(contents[name], binary=name != MANIFEST))
    _with(folder, contents, **{name: content})
    _ends_well(folder)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="named pipes are a thing of Unix")
@pytest.mark.timeout(60)
def test_a_pipe_in_place_of_any_file(folder, contents):
    for name in [*contents, "lock"]:
        _with(folder, contents)
        (folder / "study" / name).unlink(missing_ok=True)
        os.mkfifo(folder / "study" / name)
        try:
            with pytest.raises(InputError, match="it is a pipe, a socket or a device"):
                open_study(folder / "study")
        finally:
            (folder / "study" / name).unlink()
