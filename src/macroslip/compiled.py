"""How physics functions are compiled: lazily, without fast-math, cached on disk, releasing the GIL.

Numba's cache notices a change in the file of the function it compiled, but not in the files of the functions that were
inlined into it. A stale kernel would be a wrong number without a sign, so the cache key here also holds a hash of all
sources a kernel can be made of, and of every law registered by the user.
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
from collections.abc import Callable
from pathlib import Path

import numba
import numpy as np
from numba.core.caching import FunctionCache, IndexDataCacheFile
from numba.extending import register_jitable

from macroslip.fingerprint import KERNEL_PARTS, fingerprint

_extra_sources: list[str] = []


def depend_on(*functions: Callable) -> None:
    """Make kernels depend on the files that hold these compiled functions: a law of the user's own, say.

    A function typed at a prompt has no file; then its bytecode and constants stand for it. The module's name counts
    too: kernels are stored with the names of their types, and a process that gave the module another name would not
    find them.
    """
    for function in functions:
        plain = getattr(function, "py_func", function)
        path = Path(plain.__code__.co_filename)
        if path.is_relative_to(Path(__file__).parent):
            continue
        text = (
            path.read_text(encoding="utf-8")
            if path.is_file()
            else repr((plain.__code__.co_code, plain.__code__.co_consts))
        )
        source = f"{plain.__module__}\n{text}"
        if source not in _extra_sources:
            _extra_sources.append(source)


class _IndexFile(IndexDataCacheFile):
    """Index of one function's kernels. One that names classes this version no longer has is as good as none."""

    def _load_index(self):
        try:
            return super()._load_index()
        except (AttributeError, ImportError):
            return {}


class _PackageCache(FunctionCache):
    """Numba's cache of one function, outdated by any change of the sources a kernel can be made of.

    Kernels compiled while laws of the user's own are registered go into an index of their own: an index holds the
    types of all its kernels, and a process that does not know such a law could not read it.
    """

    def __init__(self, function: Callable):
        super().__init__(function)
        # The stamp outdates the whole index, so that kernels of older sources are overwritten and do not pile up.
        self._stamp = (self._cache_file._source_stamp, fingerprint(*KERNEL_PARTS))
        self._files: dict[str, _IndexFile] = {}

    def _use_file(self) -> None:
        laws = hashlib.sha256("\0".join(sorted(_extra_sources)).encode()).hexdigest()[:12] if _extra_sources else ""
        if laws not in self._files:
            base = self._impl.filename_base + (f"-{laws}" if laws else "")
            self._files[laws] = _IndexFile(self._cache_path, base, self._stamp)
        self._cache_file = self._files[laws]

    def load_overload(self, sig, target_context):
        self._use_file()
        return super().load_overload(sig, target_context)

    def save_overload(self, sig, data):
        self._use_file()
        # A kernel that cannot be stored, on a full disk say, is compiled again next time.
        with contextlib.suppress(OSError):
            super().save_overload(sig, data)


#: Options of everything that is compiled. No function is handed to C, so none gets an entry for it.
_OPTIONS = {"nogil": True, "error_model": "numpy", "no_cfunc_wrapper": True}


def _cached(function: Callable, **options) -> Callable:
    dispatcher = numba.njit(**_OPTIONS, **options)(function)
    dispatcher._cache = _PackageCache(function)
    return dispatcher


def jit(function: Callable) -> Callable:
    """Compile a scalar physics function on first call; division by zero gives inf or NaN as in NumPy."""
    return _cached(function)


def jit_inline(function: Callable) -> Callable:
    """Compile into the caller: for functions of every force evaluation, where passing the arguments costs as much."""
    return _cached(function, forceinline=True)


def jit_part(function: Callable) -> Callable:
    """Make a part of kernels: compiled into them, and plain Python when called from there.

    It gets no compiled entry from Python; with a roller's model or record for an argument that takes longer to compile
    than the function itself.
    """
    return register_jitable(**_OPTIONS, no_cpython_wrapper=True, forceinline=True)(function)


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
