"""Files that are whole or not there, also after a power cut."""

from __future__ import annotations

import contextlib
import os
import uuid
from pathlib import Path

#: End of the names of files under way; what bears it was never finished.
UNFINISHED = ".part"


def write_durably(path: Path, content: bytes) -> None:
    """Write a file in one step: when this returns it is on the disk, and until then what stood there stands.

    The content goes to a temporary file in the same folder, is flushed to the disk (fsync), takes its name, and the
    folder, which holds the name, is flushed as well. The folder is made if need be.

    Parameters
    ----------
    path : Path
    content : bytes

    Raises
    ------
    OSError
        If the system refuses, the disk being full, for example; nothing is left behind then.
    """
    make_folder(path.parent)
    temporary = path.with_name(f".{path.name}.{uuid.uuid4().hex}{UNFINISHED}")
    try:
        with temporary.open("xb") as file:
            file.write(content)
            flush(file.fileno())
        temporary.replace(path)
    except BaseException:
        with contextlib.suppress(OSError):
            temporary.unlink(missing_ok=True)
        raise
    flush_folder(path.parent)


def make_folder(folder: Path) -> None:
    """Make a folder with its parents, so that a power cut does not undo it."""
    if folder.is_dir():
        return
    make_folder(folder.parent)
    with contextlib.suppress(FileExistsError):
        folder.mkdir()
    flush_folder(folder.parent)


def flush(descriptor: int) -> None:
    """Have the system put a file's content on the disk before it goes on."""
    os.fsync(descriptor)


def flush_folder(folder: Path) -> None:
    """The same for the names in a folder; systems without such a thing, as Windows, keep them by themselves."""
    if os.name != "posix":
        return
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
