"""The process that writes the page: its failures are those of the reproduction, and it ends with it."""

import pytest

from macroslip.reproduction.page_process import page_written


def test_a_page_that_cannot_be_written_is_an_error_with_its_reason(tmp_path):
    path = tmp_path / "page.html"
    with (
        pytest.raises(RuntimeError, match="page.html could not be written") as error,
        page_written(path, {}, {}, {}, {}),
    ):
        pass
    assert "StopIteration" in str(error.value)
    assert not path.exists()


def test_a_failure_beside_it_ends_the_writing_and_comes_first(tmp_path):
    with pytest.raises(KeyboardInterrupt), page_written(tmp_path / "page.html", {}, {}, {}, {}):
        raise KeyboardInterrupt
    assert list(tmp_path.iterdir()) == []
