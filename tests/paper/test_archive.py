"""The archive of the study: complete, with right checksums, and the same bytes of the same files."""

import hashlib
import tarfile

import pytest

from macroslip.errors import InputError
from paper.archive import SUMS, archive


@pytest.fixture
def results(tmp_path):
    folder = tmp_path / "results"
    (folder / "studies").mkdir(parents=True)
    for name in ("summary.json", "report.html", "studies/one.nc"):
        (folder / name).write_text(name)
    return folder


@pytest.mark.slow
def test_it_holds_all_with_checksums_and_is_the_same_again(results, tmp_path):
    first, second = tmp_path / "first.tar.gz", tmp_path / "second.tar.gz"
    archive(results, first)
    (results / "summary.json").touch()
    archive(results, second)
    assert first.read_bytes() == second.read_bytes()
    with tarfile.open(first) as tar:
        held = {member.name: tar.extractfile(member).read() for member in tar}
    lines = [line.split("  ") for line in held.pop(SUMS).decode().splitlines()]
    assert {name: hashlib.sha256(data).hexdigest() for name, data in held.items()} == {
        name: total for total, name in lines
    }
    assert held["results/studies/one.nc"] == b"studies/one.nc"
    assert {
        "program/pyproject.toml",
        "program/src/macroslip/__init__.py",
        "environment.txt",
        "README.md",
    } <= held.keys()
    assert b"\nnumpy==" in held["environment.txt"]
    assert not [name for name in held if "__pycache__" in name or name.startswith("program/.venv")]


def test_a_study_that_did_not_end_is_refused(results, tmp_path):
    (results / "report.html").unlink()
    with pytest.raises(InputError, match="it has no report.html.*Run make reproduce first"):
        archive(results, tmp_path / "archive.tar.gz")
    assert not (tmp_path / "archive.tar.gz").exists()


def test_a_file_that_is_there_is_kept(results, tmp_path):
    there = tmp_path / "archive.tar.gz"
    there.write_text("precious")
    with pytest.raises(InputError, match="the file exists"):
        archive(results, there)
    assert there.read_text() == "precious"
