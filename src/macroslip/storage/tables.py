"""Tables kept by content, in the memory of the process and on the disk for every later run.

A table's name is a hash of everything it depends on: the laws' values, the box, and the program. So
a table is never outdated; it is only no longer used.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import threading
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

import numpy as np
from cachetools import LRUCache

from macroslip.storage.cache import read_cache, write_cache
from macroslip.storage.fingerprint import fingerprint

#: Bytes that tables may take in the memory of a process.
_MOST_IN_MEMORY = 200_000_000

Made = TypeVar("Made")


def _size(value: Any) -> int:
    if isinstance(value, np.ndarray):
        return value.nbytes
    return sum(map(_size, value)) if isinstance(value, tuple | list) else 0


_in_memory: LRUCache[str, Any] = LRUCache(_MOST_IN_MEMORY, getsizeof=_size)
_guard = threading.Lock()
#: Locks of the tables, so that threads make a table once.
_locks: dict[str, threading.Lock] = {}


def table_key(*parts: Any) -> str:
    """Name of a table by all it depends on, the program included.

    Parts are numbers, arrays and named tuples of them.
    """
    digest = hashlib.sha256(fingerprint().encode())
    for text in map(_described, parts):
        digest.update(text.encode() + b"\0")
    return digest.hexdigest()


def _described(value: Any) -> str:
    if isinstance(value, np.ndarray):
        content = hashlib.sha256(np.ascontiguousarray(value)).hexdigest()
        return f"{value.dtype}{value.shape}{content}"
    if isinstance(value, tuple):
        kind = type(value)
        return f"{kind.__module__}.{kind.__qualname__}({','.join(map(_described, value))})"
    return repr(value)


def stored(key: str, make: Callable[[], Sequence[np.ndarray]]) -> list[np.ndarray]:
    """Arrays of a key from memory or disk, computed only where neither has them; read-only.

    The key is one of `table_key`.
    """
    return remembered(key, lambda: _from_disk_or_made(key, make))


def remembered(key: str, make: Callable[[], Made]) -> Made:
    """Object of a key from memory, computed only where this process does not have it any more.

    The key is one of `table_key`; `make` gives arrays, or tuples of them.
    """
    with _guard:
        lock = _locks.setdefault(key, threading.Lock())
    with lock:
        with _guard:
            known = _in_memory.get(key)
        if known is None:
            known = make()
            # One that is larger than the memory for all is not remembered.
            with _guard, contextlib.suppress(ValueError):
                _in_memory[key] = known
        return known


def _from_disk_or_made(key: str, make: Callable[[], Sequence[np.ndarray]]) -> list[np.ndarray]:
    content = read_cache(key)
    if content is not None:
        return _arrays(content)
    arrays = [_read_only(values) for values in make()]
    buffer = io.BytesIO()
    for values in arrays:
        np.save(buffer, values, allow_pickle=False)
    write_cache(key, buffer.getvalue())
    return arrays


def _arrays(content: bytes) -> list[np.ndarray]:
    buffer = io.BytesIO(content)
    arrays = []
    while buffer.tell() < len(content):
        arrays.append(_read_only(np.load(buffer, allow_pickle=False)))
    return arrays


def _read_only(values: np.ndarray) -> np.ndarray:
    array = np.ascontiguousarray(values)
    array.flags.writeable = False
    return array
