"""Files of compiled kernels that are damaged: found when a process begins, removed, compiled again, and said once."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import macroslip

pytestmark = pytest.mark.slow

KERNELS = """
from macroslip.compiled import jit

@jit
def kernel(x):
    return 2.0 * x

@jit
def other(x):
    return 3.0 * x
"""

ASK = """
from macroslip.contact.kernels import kernel, other
print(kernel(1.0), other(1), other(1.0), *[sum(one.stats.cache_hits.values()) for one in (kernel, other)])
"""
FRESH, STORED = "2.0 3.0 3.0 0 0", "2.0 3.0 3.0 1 2"


class Copy:
    """A copy of the package with two small kernels, and a folder for kernels of its own."""

    def __init__(self, folder: Path):
        source = Path(macroslip.__file__).parent
        shutil.copytree(
            source, folder / "src" / "macroslip", ignore=shutil.ignore_patterns("__pycache__")
        )
        (folder / "src/macroslip/contact/kernels.py").write_text(KERNELS, encoding="utf-8")
        self._kernels = folder / "kernels"
        self._environment = os.environ | {
            "PYTHONPATH": str(folder / "src"),
            "NUMBA_CACHE_DIR": str(self._kernels),
        }

    def start(self) -> subprocess.Popen:
        command = [sys.executable, "-W", "error", "-c", ASK]
        return subprocess.Popen(
            command,
            env=self._environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def ask(self) -> tuple[str, str]:
        """Numbers of the kernels, how often each came from the disk, and what was said."""
        process = self.start()
        out, err = process.communicate(timeout=300)
        assert process.returncode == 0, err
        return out.strip(), err

    def file(self, name: str) -> Path:
        (found,) = self._kernels.glob(f"macroslip/*/*/kernels.{name}")
        return found

    @property
    def manifest(self) -> Path:
        (found,) = self._kernels.glob("macroslip/*/manifest")
        return found


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    """The copy, with all kernels stored."""
    copy = Copy(tmp_path_factory.mktemp("copy"))
    assert copy.ask() == (FRESH, "")
    return copy


def empty(path):
    path.write_bytes(b"")


def cut(path):
    path.write_bytes(path.read_bytes()[:-100])


def flip(path):
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 4
    path.write_bytes(content)


@pytest.mark.parametrize("damage", [empty, cut, flip])
@pytest.mark.parametrize("name", ["kernel-*.nbi", "kernel-*.nbc"])
def test_a_damaged_file_is_compiled_again(stored, name, damage):
    damage(stored.file(name))
    numbers, said = stored.ask()
    assert numbers == STORED.replace(" 1 2", " 0 2")
    assert said.startswith("note: 1 of ") and said.count("\n") == 1
    assert stored.ask() == (STORED, "")


@pytest.mark.parametrize(
    ("one", "other"), [("kernel-*.nbc", "other-*.1.nbc"), ("other-*.1.nbc", "other-*.2.nbc")]
)
def test_files_exchanged(stored, one, other):
    one, other = stored.file(one), stored.file(other)
    content = one.read_bytes()
    one.write_bytes(other.read_bytes())
    other.write_bytes(content)
    numbers, said = stored.ask()
    assert (
        numbers.startswith("2.0 3.0 3.0 ") and numbers != STORED and said.startswith("note: 2 of ")
    )
    assert stored.ask() == (STORED, "")


def flip_last(path):
    content = path.read_bytes()
    path.write_bytes(content[:-9] + bytes([content[-9] ^ 4]) + content[-8:])


@pytest.mark.parametrize("damage", [empty, cut, flip_last, Path.unlink])
def test_a_damaged_manifest(stored, damage):
    damage(stored.manifest)
    numbers, said = stored.ask()
    assert numbers.startswith("2.0 3.0 3.0 ") and said.startswith("note: ")
    assert stored.ask() == (STORED, "")


def test_a_process_that_was_killed_before_it_wrote_the_manifest(stored):
    lines = stored.manifest.read_text().splitlines(keepends=True)
    stored.manifest.write_text("".join(line for line in lines if "kernels.kernel-" not in line))
    assert stored.ask()[1].startswith("note: 2 of ")
    assert stored.ask() == (STORED, "")


def test_several_processes_store_at_once(tmp_path):
    copy = Copy(tmp_path)
    processes = [copy.start() for _ in range(4)]
    for process in processes:
        out, err = process.communicate(timeout=300)
        assert (process.returncode, out[:12]) == (0, FRESH[:12]), err
    assert copy.ask() == (STORED, "")
