"""Compiled functions that are called by their address."""

from concurrent.futures import ThreadPoolExecutor

import numba
import numpy as np

from macroslip.compiled import address_of, call_at, jit, jit_as, jit_evaluation, jit_inline

POINT = np.dtype([("x", "f8"), ("turns", "i8")])


@jit
def _move(point, count, speed, moved):
    """Move a point by a number of times its speed."""
    moved.x = point.x + count * speed
    moved.turns = point.turns + count


@numba.njit
def _move_at(address, points, count, speed):
    """Move the first point to where the second one is, by the function at an address."""
    call_at(address, (points[0], count, speed, points[1]))


def test_a_function_at_an_address_does_what_it_does_by_its_name():
    points = np.zeros(2, POINT)
    points[0] = (1.5, 4)
    _move_at(address_of(_move, POINT, int, float, POINT), points, 3, 0.25)
    assert points[1].tolist() == (2.25, 7)


def test_a_function_has_one_address():
    assert address_of(_move, POINT, int, float, POINT) == address_of(
        _move, POINT, int, float, POINT
    )


def test_a_function_that_is_not_kept_on_the_disk_has_an_address_too():
    points = np.zeros(2, POINT)
    move = numba.njit(_move.py_func)
    _move_at(address_of(move, POINT, int, float, POINT), points, 1, 2.0)
    assert points[1].tolist() == (2.0, 1)


def test_threads_that_ask_at_once_get_one_address():
    move = numba.njit(_move.py_func)
    with ThreadPoolExecutor(4) as pool:
        addresses = list(pool.map(lambda _: address_of(move, POINT, int, float, POINT), range(8)))
    assert len(set(addresses)) == 1


def test_a_function_at_an_address_is_no_part_of_its_callers():
    address = address_of(_move, POINT, int, float, POINT)
    _move_at(address, np.zeros(2, POINT), 1, 1.0)
    (code,) = _move_at.inspect_llvm().values()
    assert "_move_at" in code
    calls = [line.replace("_move_at", "") for line in code.splitlines() if " call " in line]
    assert not any("_move" in line for line in calls)


@jit_inline
def _times(factor, x):
    """Product, also of what numba does not know."""
    return factor * x


@jit_evaluation
def _doubled(x):
    return _times(2, x)


def _compiled_half(x):
    return _times(0.5, x)


@jit_as(_compiled_half)
def _half(x):
    return x / 2


@numba.njit
def _call_parts(x):
    return _times(3, x) + _times(4, x) + _doubled(x), _half(x)


def test_a_part_is_compiled_once_for_integers_and_once_for_numbers():
    assert _call_parts(1.5) == (13.5, 0.75)
    assert len(_times.dispatcher.signatures) == 2


def test_a_part_called_from_python_is_a_plain_function():
    assert _times(2, "ab") == "abab"
    assert _times.__doc__ == "Product, also of what numba does not know."
    assert _half(3) == 1.5
