"""Bundles handed on by address: what is read is what was given, nothing is counted, and types are checked."""

from __future__ import annotations

import os
import subprocess
import sys
from typing import NamedTuple

import numba
import numpy as np
import pytest
from macroslip.reference import Reference, by_reference, calling, packed, tuple_type, write
from numba import TypingError

from macroslip.compiled import entry, jit


class _Inner(NamedTuple):
    factor: float
    flag: bool
    values: np.ndarray


class _Outer(NamedTuple):
    values: np.ndarray
    pair: tuple
    inner: _Inner
    count: int


class _Given(NamedTuple):
    x: float
    y: float


class _Found(NamedTuple):
    total: float


def _outer():
    return _Outer(np.arange(3.0), (np.ones((2, 2)), 10.0), _Inner(0.5, True, np.full(4, 2.0)), 7)


@jit
def _read(outer, others):
    outer, others = by_reference(outer), by_reference(others)
    outer.values[0] += 1.0
    inner = outer.inner
    part = inner.factor if inner.flag else -1.0
    return (
        outer.values.sum()
        + outer.pair[0].sum() * outer.pair[1]
        + part * inner.values.sum()
        + outer.count
        + others.sum()
    )


def test_fields_are_read_and_written_through_a_reference_and_arrays_are_not_counted():
    outer, others = _outer(), np.ones(4)
    counts = [sys.getrefcount(one) for one in (outer.values, outer.pair[0], outer.inner.values, others)]
    for number in range(1000):
        assert _read(outer, others) == 3.0 + (number + 1) + 40.0 + 0.5 * 8.0 + 7.0 + 4.0
    assert [sys.getrefcount(one) for one in (outer.values, outer.pair[0], outer.inner.values, others)] == counts
    assert outer.values[0] == 1000.0


def test_a_reference_is_named_shortly_and_knows_its_tuple():
    kind = numba.typeof(_outer())
    reference = Reference(kind)
    assert reference == Reference(kind) and reference.instance_class is _Outer and tuple_type(reference) is kind
    assert reference != Reference(numba.typeof(_outer().inner))
    assert len(reference.name) < 60


def test_a_field_that_does_not_exist_is_refused():
    @numba.njit
    def wrong(outer):
        return by_reference(outer).missing

    with pytest.raises(TypingError, match="missing"):
        wrong(_outer())


def _weighted(data, given, result):
    write(result, _Found(data.inner.factor * given.x + data.count * given.y + data.values[1]))


@jit
def _pack(outer, buffer):
    return packed(outer, buffer)


_GIVEN, _FOUND = numba.typeof(_Given(0.0, 0.0)), numba.typeof(_Found(0.0))
_call = calling(_GIVEN, _FOUND)


@jit
def _ask(address, data, x, y):
    return _call(address, data.ctypes.data, _Given(x, y)).total


def test_a_function_called_by_address_reads_packed_data_and_returns_its_result():
    outer = _outer()
    compiled = entry(_weighted, *(Reference(kind) for kind in (numba.typeof(outer), _GIVEN, _FOUND)))
    size = _pack(outer, np.empty(0, dtype=np.uint8))
    data = np.empty(size, dtype=np.uint8)
    assert _pack(outer, data) == size
    assert _ask(compiled.address, data, 4.0, 100.0) == 0.5 * 4.0 + 7 * 100.0 + 1.0
    other = outer._replace(inner=outer.inner._replace(factor=-1.0))
    _pack(other, data)
    assert _ask(compiled.address, data, 4.0, 100.0) == -4.0 + 700.0 + 1.0


def test_too_short_a_buffer_is_left_as_it_is():
    outer = _outer()
    size = _pack(outer, np.empty(0, dtype=np.uint8))
    short = np.full(size - 1, 171, dtype=np.uint8)
    assert _pack(outer, short) == size and (short == 171).all()


def test_what_is_not_of_the_expected_type_is_refused():
    @numba.njit
    def other_argument(address, data):
        return _call(address, data, _Found(1.0)).total

    with pytest.raises(TypingError, match="expected"):
        other_argument(1, 1)
    with pytest.raises(TypingError, match="cannot be written"):
        entry(
            lambda data, given, result: write(result, given.x),
            *(Reference(kind) for kind in (_FOUND, _GIVEN, _FOUND)),
        )


#: Runs these tests where numba keeps to itself what `infer_getattr` asks for.
WITHOUT_TEMPLATE = """
import sys
import numba.core.typing.templates as templates
hidden = templates.AttributeTemplate
del templates.AttributeTemplate
import macroslip.reference
assert macroslip.reference.AttributeTemplate is None
templates.AttributeTemplate = hidden
import pytest
sys.exit(pytest.main([sys.argv[1], "-q", "-k", "not interface", "-p", "no:cacheprovider"]))
"""


@pytest.mark.slow
def test_the_public_interface_alone_will_do(tmp_path):
    environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-c", WITHOUT_TEMPLATE, __file__], env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout
