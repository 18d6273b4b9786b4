"""`macroslip reproduce`: where the paper's study is. The study itself is tested in tests/paper."""

import pytest

pytestmark = pytest.mark.slow


def test_it_says_where_the_study_is_and_writes_nothing(folder, macroslip):
    done = macroslip("reproduce")
    assert (done.code, done.out) == (2, "")
    assert " ".join(done.err.split()) == (
        "error: The paper's study is beside the package: run make reproduce in a clone of the sources."
    )
    assert list(folder.iterdir()) == []


def test_it_takes_no_options(folder, macroslip):
    assert macroslip("reproduce", "-o", "results").code == 2
    assert list(folder.iterdir()) == []
