"""Decorators of compiled functions: compiled on first call, without fast-math.

They are cached on disk and release the lock of the interpreter.
"""

from __future__ import annotations

import contextlib
import gc
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
from numba.core import event
from numba.extending import register_jitable

from macroslip.errors import MacroslipError
from macroslip.storage.kernels import kernel_folder
from macroslip.storage.waiting import COMPILING, tell

#: Options of everything that is compiled; division by zero gives inf or NaN as in NumPy. Nothing
#: that is compiled so is called from C, and an entry for that would be a twelfth of the work.
_OPTIONS: dict[str, Any] = {"nogil": True, "error_model": "numpy", "no_cfunc_wrapper": True}

#: Functions that a first case compiles, nearly the same of every model. A whole bearing has its own.
_ABOUT = {"imposed": 150, "whole": 190}


class _Compiling(event.Listener):
    """Counts how many of the program's functions this process has compiled.

    The collector of garbage rests meanwhile: it would go through all of the compiler's objects again
    and again, a twelfth of the work, and hardly find any that are left.
    """

    def __init__(self) -> None:
        self._done = 0
        self._about = _ABOUT["imposed"]
        self._under_way = 0
        self._collects = False

    def on_start(self, event: event.Event) -> None:
        """A function, or a part of the one that is being compiled."""
        if self._under_way == 0:
            self._collects = gc.isenabled()
            gc.disable()
        self._under_way += 1

    def on_end(self, event: event.Event) -> None:
        """Count a function."""
        self._under_way -= 1
        if self._under_way == 0 and self._collects:
            gc.enable()
        # Accessors that numba makes for classes of other packages belong to no module.
        module = event.data["dispatcher"].py_func.__module__ if event.data else None
        if module is not None and module.startswith("macroslip."):
            self._done += 1
            if module.startswith("macroslip.whole."):
                self._about = _ABOUT["whole"]
            tell(COMPILING, self._done, max(self._done, self._about))


event.register("numba:compile", _Compiling())


def jit(function: Callable) -> Callable:
    """Compile a function on first call, and keep it on disk where a folder can be written."""
    if numba.config.DISABLE_JIT:
        raise MacroslipError(
            "NUMBA_DISABLE_JIT: compiling is switched off. Remove this variable of the environment."
        )
    folder = kernel_folder()
    before = numba.config.CACHE_DIR
    if folder is not None:
        numba.config.CACHE_DIR = str(folder)
        try:
            # Numba refuses to store a function that has no file, and one whose folder in ours
            # cannot be written.
            with contextlib.suppress(RuntimeError):
                dispatcher = numba.njit(cache=True, **_OPTIONS)(function)
                if Path(dispatcher.stats.cache_path).is_relative_to(folder):
                    return dispatcher
        finally:
            numba.config.CACHE_DIR = before
    return numba.njit(**_OPTIONS)(function)


def jit_inline(function: Callable) -> Callable:
    """Make a part of compiled functions; called from Python it is a plain function.

    It is not stored, nor can Python call what is compiled of it: both would be work. The compiler
    chooses where it stays a call, because parts copied into all their callers are optimised anew in
    each.
    """
    return register_jitable(**_OPTIONS)(function)


def jit_evaluation(function: Callable) -> Callable:
    """Make a part of a force evaluation, which is always copied into its callers.

    Its results are many numbers: handing them up in memory would cost as much as computing them.
    """
    return register_jitable(**_OPTIONS, forceinline=True)(function)
