"""How physics functions are compiled: lazily, without fast-math, cached on disk, releasing the GIL.

Numba's cache notices a change in the file of the function it compiled, but not in the files of the functions that were
inlined into it. A stale kernel would be a wrong number without a sign, so the cache key here also holds a hash of every
source file of the package and of every law registered by the user.
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


@functools.cache
def _package_hash() -> str:
    digest = hashlib.sha256()
    root = Path(__file__).parent
    for path in sorted(root.rglob("*.py")):
        digest.update(str(path.relative_to(root)).encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()


def add_source(text: str) -> None:
    """Make compiled kernels depend on source text outside the package (a user's own law)."""
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
