"""The folder of caches: tables and kernels that can be made again.

The name of each file tells all it depends on.

A file holds a checksum of its name and content, so that one that was cut, changed or exchanged is
none. It is written in one durable step, so that processes that write the same file leave a whole
one. Where nothing can be stored, in a read-only container for example, every process makes what it
needs.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

from platformdirs import user_cache_path

from macroslip.storage.files import UNFINISHED, write_durably

#: Bytes that all files may take.
_MOST_BYTES = 500_000_000
#: Bytes of a checksum.
_CHECKSUM = 32
#: End of the names of the files.
_ENDING = ".cache"

#: Bytes that this process has written since it last counted all files.
_written = [float(_MOST_BYTES)]
#: Names of the files that this process uses until it ends.
_in_use: set[str] = set()


def cache_folder() -> Path | None:
    """Folder of the caches, made if it is not there; None where none can be written.

    It is `macroslip` in the folder of the environment variable NUMBA_CACHE_DIR, or else in the
    user's folder for caches, or a folder of the user's own among the temporary files.
    """
    for folder in _candidates():
        with contextlib.suppress(OSError):
            folder.mkdir(parents=True, exist_ok=True)
            if os.access(folder, os.W_OK | os.X_OK):
                return folder
    return None


def _candidates() -> Iterator[Path]:
    override = os.environ.get("NUMBA_CACHE_DIR")
    if override:
        yield Path(override).absolute() / "macroslip"
        return
    user = user_cache_path("macroslip", appauthor=False)
    if user.is_absolute():  # it is not where the user has no home folder
        yield user
    with contextlib.suppress(OSError):
        # Kernels are programs. Among the temporary files, which others may write, only a folder
        # that is the user's own and closed to others will do.
        number = os.getuid() if hasattr(os, "getuid") else None
        name = "macroslip" if number is None else f"macroslip-{number}"
        temporary = Path(tempfile.gettempdir()) / name
        temporary.mkdir(mode=0o700, exist_ok=True)
        status = temporary.lstat()
        if number is None or (status.st_uid == number and status.st_mode & 0o170077 == 0o040000):
            yield temporary


def read_cache(name: str) -> bytes | None:
    """Content of a cached file; None if there is none, or it has been damaged."""
    folder = cache_folder()
    path = folder / f"{name}{_ENDING}" if folder else None
    if path is None or not path.is_file():
        return None
    try:
        content = path.read_bytes()
        os.utime(path)  # the files used last are removed last
    except OSError:
        return None
    if content[:_CHECKSUM] != _checksum(name, content[_CHECKSUM:]):
        return None
    return content[_CHECKSUM:]


def write_cache(name: str, content: bytes) -> None:
    """Write a cached file durably; nothing happens where the system refuses."""
    folder = cache_folder()
    if folder is None:
        return
    with contextlib.suppress(OSError):
        write_durably(folder / f"{name}{_ENDING}", _checksum(name, content) + content)
        # Counting all files takes as long as making a table: once a process, and then now and then.
        _written[0] += len(content)
        if _written[0] > _MOST_BYTES / 50:
            _written[0] = 0.0
            _remove_oldest(folder)


def keep_in_use(name: str) -> None:
    """Protect a cached file from removal while this process makes others.

    It is then not among those that were used longest ago, though it is read only once.
    """
    _in_use.add(name)


def _checksum(name: str, content: bytes) -> bytes:
    return hashlib.sha256(name.encode() + content).digest()


def _remove_oldest(folder: Path) -> None:
    """Remove the files that were used longest ago until the others are few enough."""
    for name in _in_use:
        with contextlib.suppress(OSError):
            os.utime(folder / f"{name}{_ENDING}")
    files = []
    for path in folder.iterdir():
        if path.name.endswith((_ENDING, UNFINISHED)):
            with contextlib.suppress(OSError):
                status = path.stat()
                files.append((status.st_mtime, status.st_size, path))
    total = sum(size for _, size, _ in files)
    for _, size, path in sorted(files):
        if total <= _MOST_BYTES:
            break
        with contextlib.suppress(OSError):
            path.unlink()
            total -= size
