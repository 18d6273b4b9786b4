"""One process at a time in a study's folder, by a lock of the operating system that ends with the process."""

from __future__ import annotations

import contextlib
import json
import os
import platform
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from filelock import FileLock, Timeout

from macroslip.errors import InputError

_NAME = "lock"


@contextmanager
def locked(directory: Path) -> Iterator[None]:
    """Hold the folder for the length of the block.

    The lock belongs to the open file, not to its presence: when the process ends in any way, the system lifts it, and a
    file that is left behind holds nothing. Its content only names the holder to other processes.

    Parameters
    ----------
    directory : Path
        An existing folder.

    Raises
    ------
    InputError
        If another process holds it; the message names it, its machine, and since when.
    """
    path = directory / _NAME
    try:
        lock = FileLock(path, timeout=0).acquire()
    except Timeout:
        raise InputError(
            f"another process is at work in this folder{_holder(path)}",
            where=str(directory),
            remedy="Wait for it or stop it, or choose another folder. open_study may look at it meanwhile.",
        ) from None
    with lock:
        started = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())
        _write(path, json.dumps({"process": os.getpid(), "machine": platform.node(), "since": started}))
        yield
        _write(path, "")


def _write(path: Path, text: str) -> None:
    """Write who holds the lock. The first byte is the lock's: Windows lets no other process read or write what is locked."""
    # Where the system refuses, or the disk is full, the lock holds without it.
    with contextlib.suppress(OSError), path.open("r+", encoding="utf-8") as file:
        file.truncate(1)
        file.seek(1)
        file.write(text)


def _holder(path: Path) -> str:
    """Who holds the lock, as far as the file has it."""
    try:
        with path.open(encoding="utf-8") as file:
            file.seek(1)
            holder = json.load(file)
        return f" (process {int(holder['process'])} on {holder['machine']!s:.80}, since {holder['since']!s:.40})"
    except (OSError, ValueError, KeyError, TypeError):
        return ""
