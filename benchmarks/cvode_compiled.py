"""The same SUNDIALS library with compiled callbacks, driven through its C interface: CVODE without Python in the loop.

The shared libraries are those that come inside the scikit-sundae wheel.
"""

from __future__ import annotations

import ctypes
import functools
import importlib
import importlib.metadata

import numba
import numpy as np

from benchmarks.histories import History
from benchmarks.outcome import Reference, Solution
from benchmarks.right_hand_side import evaluations, jacobian, pack, rates

_BDF, _NORMAL, _MOST_STEPS = 2, 1, 10_000_000
_POINTER, _DOUBLE, _INT, _LONG = ctypes.c_void_p, ctypes.c_double, ctypes.c_int, ctypes.c_long
_NUMBERS = ctypes.POINTER(ctypes.c_double)


@functools.cache
def _library() -> ctypes.CDLL | None:
    """All of CVODE's functions that are used, as attributes of one object; None if the wheel does not hold them."""
    try:
        importlib.import_module("sksundae.cvode")  # loads the libraries
        files = [
            file
            for file in importlib.metadata.files("scikit-sundae") or []
            if "libsundials" in file.name
        ]
        wanted = ("core", "nvecserial", "sunmatrixdense", "sunlinsoldense", "cvode")
        libraries = {
            part: ctypes.CDLL(str(file.locate()))
            for part in wanted
            for file in files
            if f"_{part}" in file.name
        }
    except (ImportError, OSError):
        return None
    if set(libraries) != set(wanted):
        return None
    functions = type("Functions", (), {})()
    for part, name, result, arguments in (
        ("core", "SUNContext_Create", _INT, (_INT, _POINTER)),
        ("core", "SUNContext_Free", _INT, (_POINTER,)),
        ("core", "SUNContext_ClearErrHandlers", _INT, (_POINTER,)),
        ("core", "N_VGetArrayPointer", _NUMBERS, (_POINTER,)),
        ("core", "N_VDestroy", None, (_POINTER,)),
        ("core", "SUNMatDestroy", None, (_POINTER,)),
        ("core", "SUNLinSolFree", _INT, (_POINTER,)),
        # The wheel's index type is the C int.
        ("nvecserial", "N_VMake_Serial", _POINTER, (_INT, _POINTER, _POINTER)),
        ("sunmatrixdense", "SUNDenseMatrix", _POINTER, (_INT, _INT, _POINTER)),
        ("sunmatrixdense", "SUNDenseMatrix_Data", _NUMBERS, (_POINTER,)),
        ("sunlinsoldense", "SUNLinSol_Dense", _POINTER, (_POINTER, _POINTER, _POINTER)),
        ("cvode", "CVodeCreate", _POINTER, (_INT, _POINTER)),
        ("cvode", "CVodeInit", _INT, (_POINTER, _POINTER, _DOUBLE, _POINTER)),
        ("cvode", "CVodeReInit", _INT, (_POINTER, _DOUBLE, _POINTER)),
        ("cvode", "CVodeSVtolerances", _INT, (_POINTER, _DOUBLE, _POINTER)),
        ("cvode", "CVodeSetLinearSolver", _INT, (_POINTER, _POINTER, _POINTER)),
        ("cvode", "CVodeSetJacFn", _INT, (_POINTER, _POINTER)),
        ("cvode", "CVodeSetUserData", _INT, (_POINTER, _POINTER)),
        ("cvode", "CVodeSetMaxNumSteps", _INT, (_POINTER, _LONG)),
        ("cvode", "CVodeSetMaxStep", _INT, (_POINTER, _DOUBLE)),
        ("cvode", "CVodeSetMaxErrTestFails", _INT, (_POINTER, _INT)),
        ("cvode", "CVodeSetMaxConvFails", _INT, (_POINTER, _INT)),
        ("cvode", "CVodeSetStopTime", _INT, (_POINTER, _DOUBLE)),
        ("cvode", "CVode", _INT, (_POINTER, _DOUBLE, _POINTER, _POINTER, _INT)),
        ("cvode", "CVodeFree", None, (_POINTER,)),
    ):
        function = getattr(libraries[part], name)
        function.restype, function.argtypes = result, arguments
        setattr(functions, name, function)
    return functions


def available() -> bool:
    """Whether the installed scikit-sundae brings shared libraries that can be called."""
    return _library() is not None


@functools.cache
def _callbacks(length: int) -> tuple[int, int, tuple]:
    """Addresses of right-hand side and Jacobian for arrays of `length` numbers, and what keeps them alive."""
    library = _library()
    values, entries = library.N_VGetArrayPointer, library.SUNDenseMatrix_Data
    pointer, number = numba.types.voidptr, numba.types.double

    @numba.cfunc(numba.types.int32(number, pointer, pointer, pointer))
    def rate(time, state, derivative, data):
        d = numba.carray(data, (length,), np.float64)
        rates(time, numba.carray(values(state), (4,)), numba.carray(values(derivative), (4,)), d)
        return 0

    @numba.cfunc(numba.types.int32(number, *([pointer] * 7)))
    def slopes(time, state, derivative, matrix, data, first, second, third):
        d = numba.carray(data, (length,), np.float64)
        # SUNDIALS stores columns.
        columns = numba.carray(entries(matrix), (4, 4))
        jacobian(time, numba.carray(values(state), (4,)), columns.T, d)
        return 0

    return rate.address, slopes.address, (rate, slopes)


def solve(
    history: History,
    reference: Reference,
    stops: str,
    rtol: float,
    atol: float,
    longest_step: float = 0.0,
) -> Solution:
    """The history by CVODE's BDF; parameters are those of `benchmarks.cvode.solve`."""
    library = _library()
    data = pack(history)
    rate, slopes, _ = _callbacks(data.size)
    enough = rtol * reference.energy
    state, tolerances = np.zeros(4), np.array([atol, enough, enough, enough])
    context, reached = _POINTER(), _DOUBLE()
    library.SUNContext_Create(0, ctypes.byref(context))
    library.SUNContext_ClearErrHandlers(context)
    y = library.N_VMake_Serial(4, state.ctypes.data, context)
    allowed = library.N_VMake_Serial(4, tolerances.ctypes.data, context)
    matrix = library.SUNDenseMatrix(4, 4, context)
    linear = library.SUNLinSol_Dense(y, matrix, context)
    memory = _POINTER(library.CVodeCreate(_BDF, context))
    library.CVodeInit(memory, rate, history.start, y)
    library.CVodeSVtolerances(memory, rtol, allowed)
    library.CVodeSetLinearSolver(memory, linear, matrix)
    library.CVodeSetJacFn(memory, slopes)
    library.CVodeSetUserData(memory, data.ctypes.data)
    library.CVodeSetMaxNumSteps(memory, _MOST_STEPS)
    library.CVodeSetMaxStep(memory, longest_step)
    library.CVodeSetMaxErrTestFails(memory, 100)
    library.CVodeSetMaxConvFails(memory, 100)
    slip = np.full(history.marks.size, np.nan)
    edges = history.edges if stops != "none" else []
    marked, failed = 0, False
    for end in (*edges, history.end):
        library.CVodeSetStopTime(memory, end)
        inside = history.marks[marked:][history.marks[marked:] < end]
        for time in (*inside, end):
            failed = failed or library.CVode(memory, time, y, ctypes.byref(reached), _NORMAL) < 0
            if time != end and not failed:
                slip[marked] = state[0]
                marked += 1
        if stops == "restart" and end != history.end:
            library.CVodeReInit(memory, end, y)
    library.CVodeFree(ctypes.byref(memory))
    library.SUNLinSolFree(linear)
    library.SUNMatDestroy(matrix)
    library.N_VDestroy(allowed)
    library.N_VDestroy(y)
    library.SUNContext_Free(ctypes.byref(context))
    return Solution(np.full(3, np.nan) if failed else state[1:].copy(), slip, evaluations(data))
