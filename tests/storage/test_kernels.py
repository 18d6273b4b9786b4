"""Compiled kernels on the disk: damaged ones are compiled again, killed processes leave nothing, many may store at once."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import numba
import numba.experimental
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
print(kernel(1.0), other(1), other(1.0), *[sum(one.stats.cache_hits.values()) for one in (kernel, other)], flush=True)
"""
FRESH, STORED = "2.0 3.0 3.0 0 0", "2.0 3.0 3.0 1 2"


class Copy:
    """A copy of the package with two small kernels, and a folder for caches of its own."""

    def __init__(self, folder: Path):
        source = Path(macroslip.__file__).parent
        shutil.copytree(source, folder / "src" / "macroslip")
        (folder / "src/macroslip/contact/kernels.py").write_text(KERNELS, encoding="utf-8")
        self.caches = folder / "caches" / "macroslip"
        self._environment = os.environ | {
            "PYTHONPATH": str(folder / "src"),
            "NUMBA_CACHE_DIR": str(folder / "caches"),
        }

    def start(self, script: str = ASK) -> subprocess.Popen:
        command = [sys.executable, "-W", "error", "-c", script]
        return subprocess.Popen(
            command,
            env=self._environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def ask(self) -> str:
        """Numbers of the kernels, and how often each came from the disk."""
        process = self.start()
        out, err = process.communicate(timeout=300)
        assert (process.returncode, err) == (0, "")
        return out.strip()

    @property
    def archive(self) -> Path:
        (path,) = self.caches.glob("kernels-*.cache")
        return path

    @property
    def process_folders(self) -> list[Path]:
        return list(self.caches.glob("process-*"))


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    """The copy, with all kernels stored."""
    copy = Copy(tmp_path_factory.mktemp("copy"))
    assert copy.ask() == FRESH
    return copy


def test_what_is_compiled_is_kept_and_no_folder_stays(stored):
    assert stored.ask() == STORED
    assert stored.process_folders == []


def empty(path):
    path.write_bytes(b"")


def cut(path):
    path.write_bytes(path.read_bytes()[:-100])


def flip_first(path):
    content = path.read_bytes()
    path.write_bytes(bytes([content[0] ^ 4]) + content[1:])


def flip(path):
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 4
    path.write_bytes(content)


def exchange(path):
    path.write_bytes(path.read_bytes()[:32] + b"another file")


@pytest.mark.parametrize("damage", [empty, cut, flip, flip_first, exchange, Path.unlink])
def test_a_damaged_archive_is_compiled_again(stored, damage):
    damage(stored.archive)
    assert stored.ask() == FRESH
    assert stored.ask() == STORED


def test_a_process_that_is_killed_stores_nothing_and_its_folder_is_removed(tmp_path):
    copy = Copy(tmp_path)
    process = copy.start(ASK + "import time; time.sleep(300)")
    assert process.stdout.readline().strip() == FRESH
    process.kill()
    process.communicate()
    (folder,) = copy.process_folders
    assert list(folder.glob("*/*.nbc"))
    assert copy.ask() == FRESH
    assert copy.process_folders == [folder]  # it might belong to a process that begins
    long_ago = time.time() - 3600.0
    os.utime(folder / "lock", (long_ago, long_ago))
    assert copy.ask() == STORED
    assert copy.process_folders == []


def test_the_folder_of_a_process_that_lives_stays(tmp_path):
    copy = Copy(tmp_path)
    process = copy.start(ASK + "import time; time.sleep(300)")
    try:
        assert process.stdout.readline().strip() == FRESH
        (folder,) = copy.process_folders
        long_ago = time.time() - 3600.0
        os.utime(folder / "lock", (long_ago, long_ago))
        assert copy.ask() == FRESH
        assert copy.process_folders == [folder]
    finally:
        process.kill()
        process.communicate()


def test_an_interrupt_while_kernels_are_stored_at_exit_loses_nothing(tmp_path):
    """A user who presses Ctrl-C after the last word of a command."""
    copy = Copy(tmp_path)
    press = (
        "import signal\nfrom macroslip.storage import kernels\nwrite = kernels.write_cache\n"
        "def interrupted(*given):\n    signal.raise_signal(signal.SIGINT)\n    write(*given)\n"
        "kernels.write_cache = interrupted\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
    )
    process = copy.start(ASK + press)
    out, err = process.communicate(timeout=300)
    assert (process.returncode, out.strip(), err) == (0, FRESH, "")
    assert copy.ask() == STORED
    assert copy.process_folders == []


def test_several_processes_store_at_once(tmp_path):
    copy = Copy(tmp_path)
    processes = [copy.start() for _ in range(4)]
    for process in processes:
        out, err = process.communicate(timeout=300)
        assert (process.returncode, out[:12], err) == (0, FRESH[:12], "")
    assert copy.ask() == STORED
    assert copy.process_folders == []


def test_a_simulation_keeps_its_kernels_before_the_process_ends(tmp_path):
    """A process that is killed after a simulation has lost nothing."""
    copy = Copy(tmp_path)
    simulate = (
        "from macroslip import BackwardEuler, BearingLoads, Case, Laws, simulate\n"
        "loads = BearingLoads.constant([0.0, -300e3, 0.0], 0.0, 1.0)\n"
        # Its kernels take half of what those of Radau take.
        "method = BackwardEuler(step=0.01)\n"
        "simulate(Case(loads=loads, laws=Laws.paper(), rollers=[0], integrator=method))\n"
    )
    process = copy.start(
        ASK + simulate + "print('simulated', flush=True)\nimport time; time.sleep(300)"
    )
    assert process.stdout.readline().strip() == FRESH
    assert process.stdout.readline().strip() == "simulated", process.stderr.read()
    process.kill()
    process.communicate()
    assert copy.ask() == STORED


def test_functions_that_belong_to_no_module_are_compiled_beside_ours():
    """Numba makes such accessors where a class of its own is handed to Python."""

    @numba.experimental.jitclass([("value", numba.float64)])
    class Other:
        def __init__(self, value):
            self.value = value

    @numba.njit
    def make(value):
        return Other(value)

    assert make(2.0).value == 2.0
