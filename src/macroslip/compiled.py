"""How physics functions are compiled: lazily, without fast-math, cached on disk, releasing the GIL."""

from __future__ import annotations

import contextlib
import functools
import hashlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numba
import numpy as np
from numba import types
from numba.extending import register_jitable

from macroslip.kernel_cache import entered_in_manifest, kernel_folder

_own_laws: list[str] = []
_stored: list[Any] = []


def depend_on(*functions: Callable) -> None:
    """Make kernels depend on the files that hold these compiled functions, for example a law of the user's own.

    From then on kernels are read from a folder of their own, and written there: what is stored holds the types of all
    kernels of a function, and a process without such a law could not read it.

    A function typed at a prompt has no file; then its bytecode and constants are hashed instead. The module's name counts
    too: kernels are stored with the names of their types, and a process that gave the module another name would not
    find them.
    """
    before = len(_own_laws)
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
        if source not in _own_laws:
            _own_laws.append(source)
    if len(_own_laws) > before:
        with _storing() as folder:
            for dispatcher in _stored if folder else ():
                dispatcher.enable_caching()


def own_laws() -> list[str]:
    """Sources of the laws of the user's own that kernels depend on, sorted."""
    return sorted(_own_laws)


@contextlib.contextmanager
def _storing(own_laws: list[str] = _own_laws) -> Iterator[Path | None]:
    """Let numba store what is decorated in the block in the folder for these sources and laws, if there is one."""
    laws = hashlib.sha256("\0".join(sorted(own_laws)).encode()).hexdigest()[:12] if own_laws else ""
    folder, before = kernel_folder(laws), numba.config.CACHE_DIR
    numba.config.CACHE_DIR = str(folder or before)
    try:
        yield folder
    finally:
        numba.config.CACHE_DIR = before


#: Options of everything that is compiled. Nothing that is compiled so is called from C, and an entry for that would be a
#: twelfth of the work.
_OPTIONS: dict[str, Any] = {"nogil": True, "error_model": "numpy", "no_cfunc_wrapper": True}


def _cached(function: Callable, **options: Any) -> Callable:
    with _storing() as folder:
        dispatcher, stored = _in_folder(folder, function, **options)
    if stored:
        _stored.append(dispatcher)
    return dispatcher


def _in_folder(folder: Path | None, function: Callable, **options: Any) -> tuple[Callable, bool]:
    """Compile a function; also returns whether it is stored in the folder."""
    if folder is not None:
        # Numba refuses to store a function that has no file, and one whose folder in ours cannot be written.
        with contextlib.suppress(RuntimeError):
            dispatcher = numba.njit(cache=True, **_OPTIONS, **options)(function)
            stored = getattr(dispatcher, "stats", None)
            if stored and Path(stored.cache_path).is_relative_to(folder):
                return dispatcher, True
    return numba.njit(**_OPTIONS, **options)(function), False


def jit(function: Callable) -> Callable:
    """Compile a scalar physics function on first call; division by zero gives inf or NaN as in NumPy."""
    return _cached(function)


def jit_lawless(function: Callable) -> Callable:
    """Compile a function of whose arguments none holds a law, nor has one for its type.

    What is stored of it serves whatever laws of the user's own there are.
    """
    with _storing([]) as folder:
        return _in_folder(folder, function)[0]


def jit_inline(function: Callable) -> Callable:
    """Compile into the caller: for functions of every force evaluation, where passing the arguments costs as much."""
    return _cached(function, forceinline=True)


def jit_part(function: Callable) -> Callable:
    """Make a part of kernels: compiled into them, and plain Python when called from there.

    It gets no compiled entry from Python; with a roller's model or record for an argument that takes longer to compile
    than the function itself.
    """
    return register_jitable(**_OPTIONS, forceinline=True)(function)


def jit_called(function: Callable) -> Callable:
    """Compile a part of a kernel that is called in it: with no entry from Python, see `jit_part`."""
    options = {**_OPTIONS, "no_cpython_wrapper": True}
    return numba.njit(**options)(function)


def jit_merged(function: Callable) -> Callable:
    """Make a part of one kernel, into whose source it is copied.

    It is not compiled by itself: every function that is, is compiled once more with each that calls it.
    """
    options = {**_OPTIONS, "inline": "always"}
    return numba.njit(**options)(function)


def entry(function: Callable, *arguments: Any) -> Any:
    """Compile a function for these types of its arguments, to be called by its address; it returns nothing.

    Returns
    -------
    numba.CFunc
        With the `address`, valid as long as it is kept.
    """
    signature = types.void(*arguments)
    with _storing() as folder:
        if folder is not None:
            with contextlib.suppress(RuntimeError), entered_in_manifest(folder, function.__qualname__):
                return numba.cfunc(signature, cache=True, error_model="numpy")(function)
    return numba.cfunc(signature, error_model="numpy")(function)


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
