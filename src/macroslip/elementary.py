"""Exponential, logarithm, sine, cosine and arc tangent for compiled code.

A third of an integration's time would pass in the C library: a call there has all numbers at hand
written to memory and read again. These functions are copied into their callers instead. The
argument is reduced to a small interval, by a table for the exponential and the logarithm, in which
a short power series or a polynomial serves. Errors are one or two units in the last place, of the
logarithm near 1 of the order of 1e-17. Called from Python they are those of the C library.

Muller, Elementary Functions, 3rd ed., Birkhäuser (2016), doi:10.1007/978-1-4899-7983-4, chapter 6.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import intrinsic
from numpy.polynomial import Chebyshev, Polynomial

from macroslip.compiled import jit_as

_DOUBLE = ir.DoubleType()
_INTEGER = ir.IntType(64)
#: Bits of a number's fraction, of its exponent's lowest bit, and of 1.
_FRACTION = 52
_EXPONENT_STEP = 1 << _FRACTION
#: Number that leaves the integer nearest to x in the last bits of x + `_SHIFT`, |x| < 2^51.
_SHIFT = 1.5 * 2.0**52
#: ln 2 and π/2 in parts; products of all but the last with integers of up to 20 bits are exact.
_LN_2 = (float.fromhex("0x1.62e42fefp-1"), float.fromhex("0x1.473de6af278edp-34"))
_HALF_PI = (
    float.fromhex("0x1.921fb544p0"),
    float.fromhex("0x1.0b4611a6p-34"),
    float.fromhex("0x1.3198a2e037073p-69"),
)

#: Cells of the exponential's table between two powers of 2, and the bits of its values 2^(j/cells).
_POWER_BITS = 6
_POWER_COUNT = 1 << _POWER_BITS
_POWERS = (2.0 ** (np.arange(_POWER_COUNT) / _POWER_COUNT)).view(np.int64)
_PER_CELL = (1 << _POWER_BITS) / math.log(2.0)
_CELL = (_LN_2[0] / (1 << _POWER_BITS), _LN_2[1] / (1 << _POWER_BITS))
#: Range of the exponential's argument: the values at its ends are 3e-308 and 8e307.
_LEAST = -708.0
_LARGEST = 709.0

#: Cells of the logarithm's table, in which a number's fraction lies between `_FIRST` and twice that.
_LOG_BITS = 7
_FIRST = 0.6875
_FIRST_BITS = int(np.float64(_FIRST).view(np.int64))


def _middles() -> np.ndarray:
    """Middles of the logarithm's cells: numbers whose bits are evenly spaced."""
    cell = _EXPONENT_STEP >> _LOG_BITS
    bits = _FIRST_BITS + cell * np.arange(1 << _LOG_BITS) + cell // 2
    middles = bits.view(np.float64)
    # A number near 1 is reduced by exactly 1, and keeps all digits of its logarithm.
    return np.where(np.abs(middles - 1.0) < 2.0**-_LOG_BITS, 1.0, middles)


_RECIPROCALS = 1.0 / _middles()
_LOGARITHMS = -np.log(_RECIPROCALS)


def _polynomial(coefficients: list[float], degree: int, last: float) -> np.ndarray:
    """Coefficients of the polynomial through a power series' Chebyshev points from 0 to `last`."""
    points = Chebyshev.interpolate(Polynomial(coefficients), degree, domain=[0.0, last])
    return points.convert(kind=Polynomial, domain=[-1.0, 1.0]).coef


#: (sin r − r)/r³ and (cos r − 1 + r²/2)/r⁴ as functions of r², |r| ≤ π/4.
_SINE_SERIES = [(-1.0) ** (k + 1) / math.factorial(2 * k + 3) for k in range(12)]
_COSINE_SERIES = [(-1.0) ** k / math.factorial(2 * k + 4) for k in range(12)]
#: (atan(r)/r − 1 + r²/3 − r⁴/5 + r⁶/7)/r⁸ as a function of r², |r| ≤ tan π/8.
_ARCTANGENT_SERIES = [(-1.0) ** k / (2 * k + 9) for k in range(24)]
_EIGHTH = math.tan(math.pi / 8.0)
_SINE = _polynomial(_SINE_SERIES, 5, 0.617)
_COSINE = _polynomial(_COSINE_SERIES, 5, 0.617)
_ARCTANGENT = np.concatenate(
    [[1.0, -1.0 / 3.0, 0.2, -1.0 / 7.0], _polynomial(_ARCTANGENT_SERIES, 9, _EIGHTH**2)]
)


def _write_bits_of(typingctx, x):
    """The bits of a number, as an integer."""

    def _generate(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
        return builder.bitcast(arguments[0], _INTEGER)

    return types.int64(types.float64), _generate


def _write_number_of(typingctx, bits):
    """The number that has these bits."""

    def _generate(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
        return builder.bitcast(arguments[0], _DOUBLE)

    return types.float64(types.int64), _generate


def _write_add_product(typingctx, factor, other, added):
    """A product and a sum, in one operation where the processor has it."""

    def _generate(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
        kind = ir.FunctionType(_DOUBLE, [_DOUBLE] * 3)
        function = builder.module.declare_intrinsic("llvm.fmuladd.f64", fnty=kind)
        return builder.call(function, arguments)

    return types.float64(types.float64, types.float64, types.float64), _generate


_bits_of: Any = intrinsic(_write_bits_of)
_number_of: Any = intrinsic(_write_number_of)
_add_product: Any = intrinsic(_write_add_product)


def _exponential(x):
    if x > _LARGEST:
        x = _LARGEST
    if x < _LEAST:
        x = _LEAST
    # x = n cells + r with n = j + 64 k, so that e^x = 2^k 2^(j/64) e^r.
    shifted = _add_product(x, _PER_CELL, _SHIFT)
    n = shifted - _SHIFT
    r = _add_product(n, -_CELL[1], _add_product(n, -_CELL[0], x))
    bits = _bits_of(shifted)
    j = bits & ((1 << _POWER_BITS) - 1)
    scale = _number_of(_POWERS[j] + ((bits - j) << (_FRACTION - _POWER_BITS)))
    square = r * r
    high = _add_product(r, 1.0 / 120.0, 1.0 / 24.0)
    high = _add_product(high, square, _add_product(r, 1.0 / 6.0, 0.5))
    return _add_product(scale, _add_product(square, high, r), scale)


def _logarithm(x):
    bits = _bits_of(x)
    above = bits - _FIRST_BITS
    cell = (above >> (_FRACTION - _LOG_BITS)) & ((1 << _LOG_BITS) - 1)
    # x = 2^k z, and z = c (1 + r) with the middle c of its cell.
    k = above >> _FRACTION
    z = _number_of(bits - (k << _FRACTION))
    r = _add_product(z, _RECIPROCALS[cell], -1.0)
    square = r * r
    high = _add_product(r, 1.0 / 7.0, -1.0 / 6.0)
    high = _add_product(high, square, _add_product(r, 0.2, -0.25))
    high = _add_product(high, square, _add_product(r, 1.0 / 3.0, -0.5))
    value = _add_product(k, _LN_2[0], _LOGARITHMS[cell])
    small = _add_product(k, _LN_2[1], _add_product(square, high, r))
    return value + small if x < math.inf else x


def _cosine_and_sine(angle):
    quarter = math.floor(angle * (2.0 / math.pi) + 0.5)
    r = angle - quarter * _HALF_PI[0] - quarter * _HALF_PI[1] - quarter * _HALF_PI[2]
    z = r * r
    sine = 0.0
    cosine = 0.0
    for k in range(_SINE.size - 1, -1, -1):
        sine = _add_product(sine, z, _SINE[k])
        cosine = _add_product(cosine, z, _COSINE[k])
    sine = _add_product(r * z, sine, r)
    cosine = _add_product(z * z, cosine, _add_product(-0.5, z, 1.0))
    quadrant = int(quarter) & 3
    if quadrant & 1:
        cosine, sine = -sine, cosine
    if quadrant & 2:
        return -cosine, -sine
    return cosine, sine


def _arctangent(x):
    size = abs(x)
    angle = 0.0
    r = size
    # tan(a + b) takes the angle off by π/2 or π/4.
    if size > 1.0 / _EIGHTH:
        angle = 0.5 * math.pi
        r = -1.0 / size
    elif size > _EIGHTH:
        angle = 0.25 * math.pi
        r = (size - 1.0) / (size + 1.0)
    z = r * r
    total = 0.0
    for k in range(_ARCTANGENT.size - 1, 0, -1):
        total = _add_product(total, z, _ARCTANGENT[k])
    return math.copysign(angle + _add_product(total * z, r, r), x)


@jit_as(_exponential)
def exponential(x):
    """e^x [-].

    Parameters
    ----------
    x : float
        In compiled code below −708 and above 709 the value at these ends is returned; NaN stays
        NaN.

    Examples
    --------
    >>> round(exponential(1.0), 12)
    2.718281828459
    """
    return math.exp(x)


@jit_as(_logarithm)
def logarithm(x):
    """Ln x [-].

    Parameters
    ----------
    x : float
        At least 2.3e-308; infinity and NaN stay what they are.

    Examples
    --------
    >>> round(logarithm(10.0), 12)
    2.302585092994
    """
    return math.log(x)


@jit_as(_cosine_and_sine)
def cosine_and_sine(angle):
    """Cosine and sine of an angle [rad].

    Parameters
    ----------
    angle : float
        In compiled code up to 1e6 rad of either sign; beyond, the reduction by multiples of π/2
        loses digits.

    Returns
    -------
    cosine, sine : float
        [-]

    Examples
    --------
    >>> [round(x, 12) for x in cosine_and_sine(1.0)]
    [0.540302305868, 0.841470984808]
    """
    return math.cos(angle), math.sin(angle)


@jit_as(_arctangent)
def arctangent(x):
    """Arc tangent [rad].

    Parameters
    ----------
    x : float
        Any number.

    Examples
    --------
    >>> round(arctangent(1.0), 12)
    0.785398163397
    """
    return math.atan(x)
