"""Decorators of compiled functions: compiled on first call, without fast-math.

They are cached on disk and release the lock of the interpreter.
"""

from __future__ import annotations

import contextlib
import functools
import gc
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numba
import numpy as np
from llvmlite import ir
from numba.core import cgutils, event
from numba.extending import intrinsic, models, register_model, typeof_impl

from macroslip.errors import MacroslipError
from macroslip.storage.kernels import kernel_folder
from macroslip.storage.waiting import COMPILING, tell

#: Options of everything that is compiled; division by zero gives inf or NaN as in NumPy. Nothing
#: that is compiled so is called from C, and an entry for that would be a twelfth of the work.
OPTIONS: dict[str, Any] = {"nogil": True, "error_model": "numpy", "no_cfunc_wrapper": True}

#: Functions that a first case compiles, nearly the same of every model. A whole bearing has its own.
_ABOUT = {"imposed": 170, "whole": 160}


#: Held while the address of a function is looked up or the function compiled for it.
_ADDRESSES = threading.Lock()


class _Compiling(event.Listener):
    """Counts how many of the program's functions this process has compiled.

    Numba documents its events for applications that register callbacks ("Event API").

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
    if folder is not None:
        # Numba refuses to store a function that has no file, and one whose folder in ours cannot be
        # written.
        with _kept_in(folder), contextlib.suppress(RuntimeError):
            dispatcher = numba.njit(cache=True, **OPTIONS)(function)
            if _is_kept(dispatcher, folder):
                return dispatcher
    return numba.njit(**OPTIONS)(function)


@contextlib.contextmanager
def _kept_in(folder: Path) -> Iterator[None]:
    """Let numba keep what it compiles in a folder."""
    before = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = str(folder)
    try:
        yield
    finally:
        numba.config.CACHE_DIR = before


def _is_kept(dispatcher: Any, folder: Path) -> bool:
    """True if numba keeps a function in a folder of ours: not beside the sources, nor nowhere."""
    path = dispatcher.stats.cache_path
    return path is not None and Path(path).is_relative_to(folder)


def _argument_type(argument: np.dtype | type) -> numba.types.Type:
    """Type that an argument has in compiled functions."""
    if isinstance(argument, np.dtype):
        return numba.from_dtype(argument)
    numbers = {int: numba.types.int64, float: numba.types.float64}
    if argument in numbers:
        return numbers[argument]
    return numba.types.NamedUniTuple(numba.types.float64, len(argument._fields), argument)


@functools.cache
def _c_function(dispatcher: Any, arguments: tuple[np.dtype | type, ...]) -> Any:
    """A compiled function with the calling convention of C, compiled now or read from the disk."""
    signature = numba.types.void(*map(_argument_type, arguments))
    folder = kernel_folder()
    if folder is not None and _is_kept(dispatcher, folder):
        with _kept_in(folder):
            return numba.cfunc(signature, cache=True, error_model="numpy")(dispatcher.py_func)
    return numba.cfunc(signature, error_model="numpy")(dispatcher.py_func)


def address_of(dispatcher: Any, *arguments: np.dtype | type) -> int:
    """Address of a function, for compiled functions that call it by `call_at`.

    What a compiled function calls by its name becomes part of it: numba optimises it and makes
    machine code of it once more in every caller, and in the callers of these. A large function with
    many callers is handed to them by its address instead, and is compiled once.

    Parameters
    ----------
    dispatcher : numba dispatcher
        A function compiled by `jit` that returns nothing.
    *arguments : dtype or type
        Types of its arguments: the dtype of a record, `int`, `float`, or a named tuple of floats.

    Returns
    -------
    int
        Address in this process.
    """
    # Threads that ask at once would compile twice, and the code of the first would be let go while
    # its address is in use.
    with _ADDRESSES:
        return _c_function(dispatcher, arguments).address


@intrinsic
def call_at(typingctx, address, arguments):
    """Call the function at an address of `address_of`.

    Parameters
    ----------
    typingctx : Context
        Numba's; callers leave it out.
    address : int
    arguments : tuple
        Exactly of the types that `address_of` was given: nothing checks them.
    """

    def _generate(context: Any, builder: ir.IRBuilder, signature: Any, values: Any) -> Any:
        given = cgutils.unpack_tuple(builder, values[1])
        kind = ir.FunctionType(ir.VoidType(), [value.type for value in given])
        builder.call(builder.inttoptr(values[0], kind.as_pointer()), given)
        return context.get_dummy_value()

    return numba.types.void(address, arguments), _generate


@intrinsic
def uncounted(typingctx, array):
    """An array whose references are not counted.

    For a call during which the caller keeps it alive.

    Counting takes an eighth of an integration, whose parts hand the motion on at every stage.
    """

    def _generate(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
        view = context.make_array(array)(context, builder, arguments[0])
        view.meminfo = ir.Constant(view.meminfo.type, None)
        return view._getvalue()

    return array(array), _generate


class _Part:
    """A part of compiled functions; called from Python it is a plain function.

    Parameters
    ----------
    function : callable
        What is called from Python.
    compiled : callable
        What is compiled for its callers.
    **options
        Options of numba beside `OPTIONS`.
    """

    def __init__(self, function: Callable, compiled: Callable, **options: Any) -> None:
        functools.update_wrapper(self, function)
        self._function = function
        options = OPTIONS | {"no_cpython_wrapper": True} | options
        self.dispatcher = numba.njit(**options)(compiled)

    def __call__(self, *arguments: Any, **keywords: Any) -> Any:
        return self._function(*arguments, **keywords)


class _PartType(numba.types.Dispatcher):
    """Type of a part, which is compiled once for arguments of equal types.

    Numba would compile it anew for every constant that it is called with, and, of a function that
    it only registers, for every set of options that callers have.
    """

    def get_call_type(self, context, args, kws):
        """Signature of a call, for which the part is compiled where it is the first."""
        args = tuple(numba.types.unliteral(x) for x in args)
        kws = {name: numba.types.unliteral(x) for name, x in kws.items()}
        return super().get_call_type(context, args, kws)


register_model(_PartType)(models.OpaqueModel)


@typeof_impl.register(_Part)
def _type_of_part(part, context):
    return _PartType(part.dispatcher)


def jit_inline(function: Callable) -> Callable:
    """Make a part of compiled functions; called from Python it is a plain function.

    It is not stored, nor can Python call what is compiled of it: both would be work. The compiler
    chooses where it stays a call, because parts copied into all their callers are optimised anew in
    each.
    """
    return _Part(function, function)


def jit_evaluation(function: Callable) -> Callable:
    """Make a part of a force evaluation, which is always copied into its callers.

    Its results are many numbers: handing them up in memory would cost as much as computing them.
    """
    return _Part(function, function, forceinline=True)


def jit_once(function: Callable) -> Callable:
    """Make a part of compiled functions that is called in one place.

    It is copied there before types are found, so that nothing is compiled of it alone.
    """
    return numba.njit(inline="always", **OPTIONS)(function)


def jit_as(compiled: Callable) -> Callable[[Callable], Callable]:
    """Make a part as `jit_evaluation` does, which is another function where it is compiled."""
    return lambda function: _Part(function, compiled, forceinline=True)
