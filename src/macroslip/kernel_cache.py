"""Where compiled kernels are kept between processes: a folder for each state of the sources.

A kernel that outlives the sources it came from would be a wrong number without a sign. Numba notices a change in the
file of the function it compiled, but not in the files of the functions that were inlined into it. The folder is
therefore named by a hash of all sources a kernel can be made of.

Numba trusts what it finds there: an index that is cut ends the process, and a damaged kernel is run. So a manifest in the
folder holds a checksum for each file that was stored, and a process that begins removes what does not agree with it. A
process that was killed after it stored a kernel and before it wrote the line costs another compilation and nothing else.
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
import os
import re
import shutil
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import numba
import platformdirs
from filelock import FileLock, Timeout
from numba.core import event

from macroslip.fingerprint import KERNEL_PARTS, fingerprint

#: Folders of other sources that stay: enough for a few versions.
KEPT = 4
#: A folder that was used within this time may be in use still [s].
_IN_USE = 3600.0
#: Free space below which nothing is stored [bytes]; the kernels of one state of the sources take about 11 MB.
_SPACE = 64 * 2**20
#: Names, in a folder, of the manifest and of the lock that a process holds while it stores kernels or removes them.
_MANIFEST, _LOCK = "manifest", "lock"
#: Longest time until another process has stored a kernel [s]; after it this one goes on without the lock.
_PATIENCE = 10.0
_NAME = re.compile(r"[0-9a-f]{16}")


@functools.cache
def kernel_folder() -> Path | None:
    """Folder for the kernels of the present sources, which is made if it is not there.

    It is in `macroslip` in the folder of the environment variable NUMBA_CACHE_DIR, or else in the cache folder of the
    user, or in a folder of the user's own among the temporary files. Of other states of the sources the newest stay. None
    where no folder can be written, or the disk is full: then every process compiles for itself.
    """
    name = fingerprint(*KERNEL_PARTS)[:16]
    for home in _homes():
        folder = home / name
        with contextlib.suppress(OSError):
            folder.mkdir(parents=True, exist_ok=True)
            os.utime(folder)
            tempfile.TemporaryFile(dir=folder).close()
            if shutil.disk_usage(folder).free >= _SPACE:
                _remove_old(home)
                _remove_damaged(folder)
                _checked.add(folder)
                return folder
    return None


def _homes() -> Iterator[Path]:
    """Folders for all states of the sources, best first."""
    if numba.config.CACHE_DIR:
        yield Path(numba.config.CACHE_DIR).absolute() / "macroslip"
        return
    user = Path(platformdirs.user_cache_path("macroslip", appauthor=False))
    if user.is_absolute():  # it is not where the user has no home folder
        yield user / "kernels"
    with contextlib.suppress(OSError):
        # Kernels are programs. Among the temporary files, which others may write, only a folder that is the user's own
        # and closed to others will do.
        number = os.getuid() if hasattr(os, "getuid") else None
        temporary = Path(tempfile.gettempdir()) / (
            "macroslip" if number is None else f"macroslip-{number}"
        )
        temporary.mkdir(mode=0o700, exist_ok=True)
        status = temporary.lstat()
        if number is None or (status.st_uid == number and status.st_mode & 0o170077 == 0o040000):
            yield temporary


def _remove_old(home: Path) -> None:
    used = {}
    for folder in home.iterdir():
        # Another process may remove it at the same time.
        with contextlib.suppress(OSError):
            if _NAME.fullmatch(folder.name) and folder.is_dir():
                used[folder] = folder.stat().st_mtime
    for folder in sorted(used, key=used.__getitem__, reverse=True)[KEPT:]:
        if used[folder] < time.time() - _IN_USE:
            shutil.rmtree(folder, ignore_errors=True)


#: Folders whose files agreed with the manifest when this process began to use them.
_checked: set[Path] = set()


def _checksum(path: Path) -> str:
    return hashlib.blake2b(path.read_bytes(), digest_size=16).hexdigest()


def _damaged(folder: Path) -> tuple[list[Path], int]:
    """Files of kernels that do not agree with the manifest, and the number of all."""
    known: dict[str, str] = {}
    with contextlib.suppress(FileNotFoundError):
        # The last line about a file counts. A line that is damaged names no file, or no checksum that a file has.
        for line in (folder / _MANIFEST).read_text(encoding="utf-8", errors="replace").splitlines():
            checksum, _, name = line.partition(" ")
            known[name] = checksum
    found = list(folder.glob("*/*.nb[ic]"))
    damaged = []
    for path in found:
        with contextlib.suppress(FileNotFoundError):  # another process has removed it
            if known.get(path.relative_to(folder).as_posix()) != _checksum(path):
                damaged.append(path)
    return damaged, len(found)


def _remove_damaged(folder: Path) -> None:
    if not _damaged(folder)[0]:
        return
    with _locked(folder):  # what another process is about to store is in the manifest now
        damaged, number = _damaged(folder)
        for path in damaged:
            path.unlink(missing_ok=True)
    if damaged:
        what = f"note: {len(damaged)} of {number} files of compiled kernels were damaged or incomplete."
        print(
            f"{what} They are removed; what is needed of them is compiled again.", file=sys.stderr
        )


@contextlib.contextmanager
def _locked(folder: Path) -> Iterator[None]:
    """Keep other processes from storing kernels, where the file system has locks."""
    with contextlib.ExitStack() as held:
        with contextlib.suppress(OSError, RuntimeError, NotImplementedError, Timeout):
            held.enter_context(FileLock(folder / _LOCK, timeout=_PATIENCE))
        yield


@contextlib.contextmanager
def _entered_in_manifest(folder: Path, function: str, part: str) -> Iterator[None]:
    """Enter into the manifest what is stored, in the block, for a function of this qualified name in a part of the folder."""
    pattern = (
        f"{part}/*.{re.sub('[<>]', '', function)}-*.nb[ic]"  # names of files have no angle brackets
    )

    def states() -> dict[Path, tuple[int, int]]:
        found = {}
        for path in folder.glob(pattern):
            with contextlib.suppress(OSError):
                status = path.stat()
                found[path] = status.st_ino, status.st_mtime_ns
        return found

    before = states()
    yield
    with contextlib.suppress(OSError):
        stored = [path for path, state in states().items() if before.get(path) != state]
        lines = "".join(
            f"{_checksum(path)} {path.relative_to(folder).as_posix()}\n" for path in stored
        )
        if lines:
            with (folder / _MANIFEST).open("a", encoding="utf-8", newline="\n") as file:
                file.write("\n" + lines)  # a line before this one may be cut


class _Stored(event.Listener):
    """Enters into the manifest what numba stores between the end of a compilation and the release of its lock."""

    def __init__(self) -> None:
        self._of_thread = threading.local()

    def on_start(self, event: event.Event) -> None:
        pass

    def on_end(self, event: event.Event) -> None:
        if event.data is None:  # the lock was released
            getattr(self._of_thread, "block", contextlib.ExitStack()).close()
            return
        dispatcher = event.data["dispatcher"]
        place = Path(getattr(dispatcher.stats, "cache_path", None) or "")
        if place.parent in _checked:
            self._of_thread.block = block = contextlib.ExitStack()
            # Two processes that store kernels of one function would write each other's index.
            block.enter_context(_locked(place.parent))
            block.enter_context(
                _entered_in_manifest(place.parent, dispatcher.py_func.__qualname__, place.name)
            )


_listener = _Stored()
for _kind in ("numba:compile", "numba:compiler_lock"):
    event.register(_kind, _listener)
