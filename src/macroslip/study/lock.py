"""One process at a time in a study's folder, by a lock of the operating system that ends with the process."""

from __future__ import annotations

import json
import os
import platform
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from macroslip.errors import InputError

_NAME = "lock"


@contextmanager
def locked(directory: Path) -> Iterator[None]:
    """Hold the folder for the length of the block.

    The lock belongs to the open file, not to its presence: when the process ends in any way, the system lifts it, and a
    file that is left behind holds nothing. What stands in the file only tells others who it is.

    Parameters
    ----------
    directory : Path
        An existing folder.

    Raises
    ------
    InputError
        If another process holds it; the message says which, on what machine, and since when.
    """
    path = directory / _NAME
    file = path.open("a+", encoding="utf-8")
    try:
        if not _try_lock(file.fileno()):
            raise InputError(
                f"another process is at work in this folder{_holder(path)}",
                where=str(directory),
                remedy="Wait for it or stop it, or choose another folder. open_study may look at it meanwhile.",
            )
        file.truncate(0)
        started = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())
        json.dump({"process": os.getpid(), "machine": platform.node(), "since": started}, file)
        file.flush()
        yield
        file.truncate(0)
    finally:
        file.close()


def _holder(path: Path) -> str:
    """Who holds the lock, as far as the file tells it."""
    try:
        holder = json.loads(path.read_text(encoding="utf-8"))
        return f" (process {int(holder['process'])} on {holder['machine']!s:.80}, since {holder['since']!s:.40})"
    except (OSError, ValueError, KeyError, TypeError):
        return ""


def _try_lock(descriptor: int) -> bool:
    try:
        if os.name == "posix":
            import fcntl

            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        else:
            import msvcrt

            os.lseek(descriptor, 0x7FFFFFFF, os.SEEK_SET)  # beyond the text, which others may read
            msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
    except OSError:
        return False
    return True
