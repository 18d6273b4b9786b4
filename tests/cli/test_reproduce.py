"""`macroslip reproduce`: what it refuses before it computes. What it computes is tested with the reproduction."""

import pytest

pytestmark = pytest.mark.slow


def test_a_file_in_the_way_is_one_paragraph_and_nothing_is_written(folder, macroslip):
    (folder / "results").write_text("mine")
    done = macroslip("reproduce", "-o", "results")
    assert (done.code, done.out) == (2, "")
    assert "results: it is not a folder" in done.err
    assert [path.name for path in folder.iterdir()] == ["results"]
    assert (folder / "results").read_text() == "mine"


@pytest.mark.parametrize("arguments", [(), ("-o", "results", "--threads", 0)])
def test_wrong_arguments_are_refused(folder, macroslip, arguments):
    assert macroslip("reproduce", *arguments).code == 2
    assert list(folder.iterdir()) == []
