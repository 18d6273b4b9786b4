"""How physics functions are compiled: lazily, without fast-math, cached on disk, releasing the GIL.

Numba's cache notices a change in the file of the function it compiled, but not in the files of the functions that were
inlined into it. A stale kernel would be a wrong number without a sign, so the cache key here also holds a hash of all
sources a kernel can be made of, and of every law registered by the user.
"""

from __future__ import annotations

import functools
import hashlib
from collections.abc import Callable
from pathlib import Path

import numba
import numpy as np
from numba.core.caching import FunctionCache

_extra_sources: list[str] = []
#: Rooms that use kernels and that no kernel uses; a change there compiles nothing again.
_ROOMS_ABOVE_THE_KERNELS = ("bench", "cli", "report", "study")


@functools.cache
def _package_hash() -> str:
    digest = hashlib.sha256()
    root = Path(__file__).parent
    for path in sorted(root.rglob("*.py")):
        if path.relative_to(root).parts[0] in _ROOMS_ABOVE_THE_KERNELS:
            continue
        digest.update(str(path.relative_to(root)).encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()


def depend_on(*functions: Callable) -> None:
    """Make kernels depend on the files that hold these compiled functions: a law of the user's own, say.

    A function typed at a prompt has no file; then its bytecode and constants stand for it.
    """
    for function in functions:
        plain = getattr(function, "py_func", function)
        path = Path(plain.__code__.co_filename)
        if path.is_relative_to(Path(__file__).parent):
            continue
        text = path.read_text(encoding="utf-8") if path.is_file() else repr((plain.__code__.co_code, plain.__code__.co_consts))
        if text not in _extra_sources:
            _extra_sources.append(text)


class _PackageCache(FunctionCache):
    def __init__(self, function: Callable):
        super().__init__(function)
        # The stamp outdates the whole index, so that kernels of older sources are overwritten and do not pile up.
        self._cache_file._source_stamp = (self._cache_file._source_stamp, _package_hash())

    def _index_key(self, sig, codegen):
        extra = hashlib.sha256("\0".join(_extra_sources).encode()).hexdigest()
        return (*super()._index_key(sig, codegen), extra)


def jit(function: Callable) -> Callable:
    """Compile a scalar physics function on first call; division by zero gives inf or NaN as in NumPy."""
    dispatcher = numba.njit(nogil=True, error_model="numpy")(function)
    dispatcher._cache = _PackageCache(function)
    return dispatcher


def elementwise(function: Callable) -> Callable:
    """Let a compiled scalar function take plain floats or arrays, which broadcast against each other."""
    vectorised = np.vectorize(function)

    @functools.wraps(function)
    def over_arrays(*args, **kwargs):
        result = vectorised(*args, **kwargs)
        if isinstance(result, tuple):
            return tuple(part[()] for part in result)
        return result[()]

    return over_arrays
