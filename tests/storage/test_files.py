"""Output files: whole or not there, and never in the place of what a user still needs."""

import os
import threading

import pytest

from macroslip import InputError
from macroslip.storage import files


def test_a_file_that_the_output_is_made_from_is_kept_even_with_force(tmp_path):
    case = tmp_path / "case.yaml"
    case.write_text("precious")
    (tmp_path / "link.yaml").hardlink_to(case)
    for name in ("case.yaml", "./case.yaml", "link.yaml"):
        with pytest.raises(InputError, match="a file that the output is made from"):
            files.check_new_file(tmp_path / name, force=True, inputs=[tmp_path / "absent", case])
    files.check_new_file(tmp_path / "other.nc", force=True, inputs=[case])


@pytest.mark.skipif(os.name != "posix", reason="pipes in folders are POSIX")
def test_a_pipe_is_no_file_to_replace(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(InputError, match="a pipe, a socket or a device"):
        files.check_new_file(tmp_path / "pipe", force=True)
    assert (tmp_path / "pipe").is_fifo()
    with pytest.raises(InputError, match="pipe: it is a pipe, .* Allowed: a file. Name another."):
        files.check_regular(tmp_path / "pipe", "Name another.")
    for name in ("absent", "", "a\0b"):  # their reader has words for these
        files.check_regular(tmp_path / name, "Name another.")


def test_the_files_of_a_study_are_never_replaced(tmp_path):
    (tmp_path / "lock").touch()
    files.check_new_file(tmp_path / "lock", force=True)
    (tmp_path / "study.sqlite").touch()
    for name in ("lock", "study.sqlite", "manifest.json", "summary.parquet"):
        with pytest.raises(
            InputError, match=f"{name} is a file of the study in this folder. Choose another name"
        ):
            files.check_new_file(tmp_path / name, force=True)
    files.check_new_file(tmp_path / "case.nc", force=False)


@pytest.mark.skipif(os.name != "posix", reason="Windows bounds the whole path")
def test_a_name_may_be_as_long_as_the_system_allows(tmp_path):
    longest = os.pathconf(tmp_path, "PC_NAME_MAX")
    with files.new_file(tmp_path / ("n" * longest), force=False) as temporary:
        temporary.touch()
    files.write_durably(tmp_path / ("é" * (longest // 2)), b"")
    assert {len(os.fsencode(path.name)) for path in tmp_path.iterdir()} == {
        longest,
        longest // 2 * 2,
    }


def test_a_zero_byte_in_a_name_is_refused_in_words(tmp_path):
    with pytest.raises(InputError, match="zero byte"):
        files.check_new_file(tmp_path / "a\0b", force=False)


def test_of_two_commands_with_one_new_output_one_succeeds(tmp_path):
    """Both begin before either ends; the file is that of the writer that reported success."""
    path, both = tmp_path / "out.nc", threading.Barrier(2)
    ended = {}

    def command(name):
        try:
            files.check_new_file(path, force=False)
            with files.new_file(path, force=False) as temporary:
                temporary.write_text(name)
                both.wait(timeout=30)
            ended[name] = True
        except InputError as problem:
            ended[name] = "has appeared since" not in str(problem)

    threads = [threading.Thread(target=command, args=(name,)) for name in ("first", "second")]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sorted(ended.values()) == [False, True]
    assert ended[path.read_text()] is True
    assert [path.name for path in tmp_path.iterdir()] == ["out.nc"]


def test_what_fails_leaves_the_old_file_and_nothing_else(tmp_path):
    (tmp_path / "out.nc").write_text("old")
    with (
        pytest.raises(ZeroDivisionError),
        files.new_file(tmp_path / "out.nc", force=True) as temporary,
    ):
        temporary.write_text("half")
        raise ZeroDivisionError
    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [("out.nc", "old")]
