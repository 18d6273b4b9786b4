"""Compiled kernels, kept between processes in one archive for each state of the sources.

Numba notices a change in the file of the function it compiled, but not in the files of the
functions that were inlined into it; so the archive is named by a hash of all sources. And Numba
trusts its folder: an index that is cut ends the process, a damaged kernel is run, and two processes
that store kernels of one function exchange them. So every process has a folder of its own. It is
filled from the archive when the process begins, and what was compiled since is put into the archive
after a simulation and at exit; the exit alone would lose what workers of a study have compiled,
which are killed when the study ends. A process that is killed before loses what it has compiled, and
nothing else.
"""

from __future__ import annotations

import atexit
import contextlib
import functools
import io
import os
import re
import shutil
import signal
import tempfile
import time
import zipfile
from dataclasses import dataclass
from pathlib import Path

from filelock import FileLock, Timeout

from macroslip.storage.cache import cache_folder, keep_in_use, read_cache, write_cache
from macroslip.storage.fingerprint import fingerprint

#: Beginning of the names of the folders of processes, and the lock that a process holds in its own.
_PREFIX = "process-"
_LOCK = "lock"
#: Time [s] after which a folder whose lock is free is that of a process that was killed.
_BEGINNING = 60.0
#: Free space [bytes] below which nothing is stored; kernels of one state of the sources take 5 MB.
_SPACE = 64 * 2**20
#: End of the name of a file of kernels; what is before it is the function.
_END_OF_NAME = re.compile(r"(\.\d+\.nbc|\.nbi)$")


@dataclass
class _ProcessFolder:
    """Folder of this process for its kernels."""

    path: Path
    lock: FileLock
    process: int  #: Number of the process, which a forked one does not have
    archived: dict[str, int]  #: Files that are in the archive, as `states` gives them

    def states(self) -> dict[str, int]:
        """Files of kernels by name, with the time at which each was written [ns]."""
        return {
            path.relative_to(self.path).as_posix(): path.stat().st_mtime_ns
            for path in self.path.glob("*/*.nb[ic]")
        }

    def remove(self) -> None:
        """Add the compiled kernels to the archive, and remove the folder."""
        if os.getpid() == self.process:
            # At exit a Ctrl-C would only lose the kernels and leave the folder behind.
            with contextlib.suppress(ValueError):  # not in the main thread
                signal.signal(signal.SIGINT, signal.SIG_IGN)
            keep_kernels()
            self.lock.release()
            shutil.rmtree(self.path, ignore_errors=True)


def kernel_folder() -> Path | None:
    """Folder of this process for its kernels, with those of the archive.

    None where no folder can be written, or the disk is full: then the process compiles for itself.
    """
    folder = _process_folder()
    return folder.path if folder else None


@functools.cache
def _process_folder() -> _ProcessFolder | None:
    home = cache_folder()
    if home is None or shutil.disk_usage(home).free < _SPACE:
        return None
    # A study that makes many tables would push the kernels out, and its next process compile.
    keep_in_use(_archive())
    _remove_abandoned(home)
    with contextlib.suppress(OSError):
        path = Path(tempfile.mkdtemp(prefix=_PREFIX, dir=home))
        folder = _ProcessFolder(path, FileLock(path / _LOCK), os.getpid(), {})
        with contextlib.suppress(NotImplementedError):  # a file system without locks
            folder.lock.acquire()
        for name, content in _archived().items():
            (path / name).parent.mkdir(exist_ok=True)
            (path / name).write_bytes(content)
        folder.archived = folder.states()
        atexit.register(folder.remove)
        return folder
    return None


def keep_kernels() -> None:
    """Add the kernels that this process has compiled to the archive."""
    folder = _process_folder()
    if folder is None:
        return
    with contextlib.suppress(OSError):
        states = folder.states()
        if states == folder.archived:
            return
        own = {name: (folder.path / name).read_bytes() for name in states}
        functions = {_END_OF_NAME.sub("", name) for name in own}
        # The index and the kernels of a function belong together: those of another process stay
        # only where this one has none of the function.
        others = {
            name: content
            for name, content in _archived().items()
            if _END_OF_NAME.sub("", name) not in functions
        }
        buffer = io.BytesIO()
        with zipfile.ZipFile(buffer, "w") as archive:
            for name, content in {**others, **own}.items():
                archive.writestr(name, content)
        write_cache(_archive(), buffer.getvalue())
        folder.archived = states


def _archive() -> str:
    """Name of the archive of the present sources among the caches."""
    return f"kernels-{fingerprint()}"


def _archived() -> dict[str, bytes]:
    """Files of kernels in the archive, by name."""
    content = read_cache(_archive())
    if content is None:
        return {}
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def _remove_abandoned(home: Path) -> None:
    """Remove the folders of processes that were killed, whose locks are free."""
    for lock in home.glob(f"{_PREFIX}*/{_LOCK}"):
        with contextlib.suppress(OSError, Timeout, NotImplementedError):
            if lock.stat().st_mtime < time.time() - _BEGINNING:
                with FileLock(lock, timeout=0):
                    shutil.rmtree(lock.parent, ignore_errors=True)
