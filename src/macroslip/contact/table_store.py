"""Tables kept on disk by content, for every later run and for all workers of a study.

A table's name is a hash of everything it depends on: the laws' values, the box, and the sources that make it. So a
table is never outdated; it is only no longer used, and then among the first to be removed. A file that was cut or
changed is made again. Where nothing can be stored, for example in a read-only container, tables last as long as the process.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import os
import threading
from collections import OrderedDict
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from filelock import FileLock, Timeout
from platformdirs import user_cache_path

from macroslip.files import UNFINISHED, write_durably
from macroslip.fingerprint import KERNEL_PARTS, fingerprint

#: Bytes that stored tables may take, on disk and in the memory of a process.
_MOST_BYTES, _MOST_IN_MEMORY = 500_000_000, 200_000_000
#: Time for which a process waits for another that makes the same table [s].
_PATIENCE = 60.0
#: End of the names of stored tables.
_ENDING = ".table"

Made = TypeVar("Made")

_in_memory: OrderedDict[str, Any] = OrderedDict()
_locks: dict[str, threading.Lock] = {}
_guard = threading.Lock()
#: Bytes that this process has stored since it last looked at how many there are.
_stored_since = [float(_MOST_BYTES)]


def table_key(*parts: Any) -> str:
    """Name of a table by all it depends on: numbers, arrays and named tuples of them, and the sources of the laws."""
    digest = hashlib.sha256(fingerprint(*KERNEL_PARTS).encode())
    for text in map(_described, parts):
        digest.update(text.encode() + b"\0")
    return digest.hexdigest()


def _described(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return (
            f"{value.dtype}{value.shape}{hashlib.sha256(np.ascontiguousarray(value)).hexdigest()}"
        )
    if isinstance(value, tuple):
        kind = type(value)
        return (
            f"{kind.__module__}.{kind.__qualname__}({','.join(_described(one) for one in value)})"
        )
    return repr(value)


def stored(key: str, make: Callable[[], Sequence[np.ndarray]]) -> list[np.ndarray]:
    """The arrays called `key`, made only if neither this process nor the disk has them; read-only.

    The key is one of `table_key`.
    """
    return remembered(key, lambda: _from_disk_or_made(key, make))


def remembered(key: str, make: Callable[[], Made]) -> Made:
    """The object called `key`, made only if this process has not made it or has forgotten it.

    The key is one of `table_key`; `make` gives arrays, or tuples of them.
    """
    with _guard:
        lock = _locks.setdefault(key, threading.Lock())
    with lock:
        with _guard:
            found = _in_memory.get(key)
            if found is not None:
                _in_memory.move_to_end(key)
        if found is None:
            found = make()
            with _guard:
                _in_memory[key] = found
                while (
                    len(_in_memory) > 1 and sum(map(_size, _in_memory.values())) > _MOST_IN_MEMORY
                ):
                    _in_memory.popitem(last=False)
        return found


def _read_only(values: np.ndarray) -> np.ndarray:
    found = np.ascontiguousarray(values)
    found.flags.writeable = False
    return found


def _size(value: Any) -> int:
    if isinstance(value, np.ndarray):
        return value.nbytes
    return sum(map(_size, value)) if isinstance(value, tuple | list) else 0


def folder() -> Path:
    """Where tables are stored: in `macroslip` in the folder of NUMBA_CACHE_DIR, or else in the user's folder for caches.

    Raises RuntimeError if the user has no home folder.
    """
    given = os.environ.get("NUMBA_CACHE_DIR")
    home = (
        Path(given).absolute() / "macroslip"
        if given
        else user_cache_path("macroslip", appauthor=False)
    )
    if not home.is_absolute():
        raise RuntimeError("there is no home folder")
    return home / "tables"


def _from_disk_or_made(key: str, make: Callable[[], Sequence[np.ndarray]]) -> list[np.ndarray]:
    with contextlib.ExitStack() as held:
        path = None
        # No home folder, a read-only or full disk, a file system without locks; and a process that waited in vain makes the
        # table too: that costs time and nothing else.
        with contextlib.suppress(OSError, RuntimeError, NotImplementedError, Timeout):
            path = folder() / f"{key}{_ENDING}"
            if (found := _read(path)) is not None:
                return found
            path.parent.mkdir(parents=True, exist_ok=True)
            held.enter_context(FileLock(path.parent / f"{key[:2]}.lock", timeout=_PATIENCE))
            if (found := _read(path)) is not None:
                return found
        made = [_read_only(one) for one in make()]
        if path is not None:
            with contextlib.suppress(OSError):
                content = _content(key, made)
                write_durably(path, content)
                # To look at all files takes as long as to make a table: once a process, and then now and then.
                _stored_since[0] += len(content)
                if _stored_since[0] > _MOST_BYTES / 50:
                    _stored_since[0] = 0
                    _remove_oldest(path.parent)
        return made


def _checksum(key: str, content: bytes) -> bytes:
    """Checksum of a file: its name is in it, so that files that were exchanged are found."""
    return hashlib.sha256(key.encode() + content).digest()


def _content(key: str, arrays: Sequence[np.ndarray]) -> bytes:
    part = io.BytesIO()
    for one in arrays:
        np.save(part, one, allow_pickle=False)
    content = part.getvalue()
    return _checksum(key, content) + content


def _read(path: Path) -> list[np.ndarray] | None:
    if not path.is_file():  # a pipe of that name would wait for ever
        return None
    try:
        content = path.read_bytes()
    except OSError:
        return None
    if len(content) <= 32 or _checksum(path.stem, content[32:]) != content[:32]:
        return None
    part, found = io.BytesIO(content[32:]), []
    while part.tell() < len(content) - 32:
        found.append(_read_only(np.load(part, allow_pickle=False)))
    with contextlib.suppress(OSError):
        os.utime(path)  # the files used last are removed last
    return found


def _remove_oldest(place: Path) -> None:
    files = []
    for path in place.iterdir():
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
