"""Four natural logarithms or exponentials at once.

A force evaluation that looks its contacts up needs a dozen logarithms, and each call of the C library's takes as long as
four of these, which stay in vector registers.

x = 2^e m with m from √½ to √2, and ln m = 2 artanh s = 2 (s + s³/3 + s⁵/5 + …), s = (m − 1)/(m + 1): eleven terms leave
an error below that of rounding. exp x = 2^n exp r with |r| ≤ ½ ln 2, of whose series 14 terms do so.
"""

from __future__ import annotations

import math
from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from macroslip.compiled import jit_inline
from macroslip.contact.vectors import LANES, VECTOR, Vectors

#: Of 2 artanh s over s in s², and of the exponential.
_TERMS = [2.0 / (2 * k + 1) for k in range(11)]
_FACTORIALS = [1.0 / math.factorial(k) for k in range(14)]
_BITS = ir.VectorType(ir.IntType(64), LANES)
#: Bits of √½, and those of the fraction of a float.
_LEAST_MANTISSA, _FRACTION = 0x3FE6A09E667F3BCD, 52
#: 3 · 2^51: in the lowest bits of its sum with a small whole number are those of the number.
_WHOLE_BITS, _WHOLE = 0x4338000000000000, 6755399441055744.0
#: ln 2 in two parts, the first of which times an exponent is exact; together they are good to 1e-26.
_LN_2_HIGH = math.ldexp(math.floor(math.ldexp(math.log(2.0), 32)), -32)
_LN_2_LOW = 1.9082149292705877e-10


def _number(value: float) -> Any:
    """A constant in all lanes."""
    return ir.Constant(VECTOR, [value] * LANES)


def _whole(value: int) -> Any:
    """A constant whole number in all lanes."""
    return ir.Constant(_BITS, [value] * LANES)


def write_logarithm(builder: ir.IRBuilder, x: Any) -> Any:
    """Write the natural logarithm of every lane."""
    write = Vectors(builder)
    bits = builder.bitcast(x, _BITS)
    exponent = builder.ashr(builder.sub(bits, _whole(_LEAST_MANTISSA)), _whole(_FRACTION))
    mantissa = builder.bitcast(builder.sub(bits, builder.shl(exponent, _whole(_FRACTION))), VECTOR)
    power = builder.fsub(builder.bitcast(builder.add(exponent, _whole(_WHOLE_BITS)), VECTOR), _number(_WHOLE))
    s = builder.fdiv(builder.fsub(mantissa, _number(1.0)), builder.fadd(mantissa, _number(1.0)))
    square = builder.fmul(s, s)
    fourth = builder.fmul(square, square)
    # Every other term, twice: half as long a chain of operations.
    even, odd = _number(_TERMS[10]), _number(_TERMS[9])
    for k in (8, 6, 4, 2):
        even = write.fmuladd(even, fourth, _number(_TERMS[k]))
    for k in (7, 5, 3, 1):
        odd = write.fmuladd(odd, fourth, _number(_TERMS[k]))
    rest = builder.fmul(write.fmuladd(even, square, odd), square)
    found = write.fmuladd(rest, s, builder.fmul(s, _number(_TERMS[0])))
    found = write.fmuladd(power, _number(_LN_2_LOW), found)
    return write.fmuladd(power, _number(_LN_2_HIGH), found)


def write_exponential(builder: ir.IRBuilder, x: Any) -> Any:
    """Write the exponential of every lane."""
    write = Vectors(builder)
    shifted = write.fmuladd(x, _number(1.0 / math.log(2.0)), _number(_WHOLE))
    power = builder.fsub(shifted, _number(_WHOLE))
    rest = write.fmuladd(power, _number(-_LN_2_HIGH), x)
    rest = write.fmuladd(power, _number(-_LN_2_LOW), rest)
    square = builder.fmul(rest, rest)
    even, odd = _number(_FACTORIALS[12]), _number(_FACTORIALS[13])
    for k in (10, 8, 6, 4, 2, 0):
        even = write.fmuladd(even, square, _number(_FACTORIALS[k]))
    for k in (11, 9, 7, 5, 3, 1):
        odd = write.fmuladd(odd, square, _number(_FACTORIALS[k]))
    found = builder.bitcast(write.fmuladd(odd, rest, even), _BITS)
    exponent = builder.shl(builder.bitcast(shifted, _BITS), _whole(_FRACTION))
    return builder.bitcast(builder.add(found, exponent), VECTOR)


def _of_four(function: Any) -> Any:
    """A function of four numbers from one that writes it for a vector."""

    def generate(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
        write = Vectors(builder)
        found = write.lanes(function(builder, write.gathered(list(arguments))))
        return context.make_tuple(builder, signature.return_type, found)

    return types.UniTuple(types.float64, LANES)(*[types.float64] * LANES), generate


@intrinsic
def _four_logarithms(typingctx, a, b, c, d):
    return _of_four(write_logarithm)


@intrinsic
def _four_exponentials(typingctx, a, b, c, d):
    return _of_four(write_exponential)


@jit_inline
def logarithms(a, b, c, d):
    """Natural logarithms of four numbers above 2e-308, to three units of the last place.

    Of zero and infinity it is some −709 and 710, and of what else has no logarithm some finite number too: beyond the
    ends of any table.

    Examples
    --------
    >>> [round(one, 12) for one in logarithms(1.0, 2.0, 10.0, 1e-3)]
    [0.0, 0.69314718056, 2.302585092994, -6.907755278982]
    """
    return _four_logarithms(a, b, c, d)  # pyright: ignore[reportCallIssue]


@jit_inline
def exponentials(a, b, c, d):
    """Exponentials of four numbers between −700 and 700, to three units of the last place; of others no number of use.

    Examples
    --------
    >>> [round(one, 12) for one in exponentials(0.0, 1.0, -1.0, 0.5)]
    [1.0, 2.718281828459, 0.367879441171, 1.6487212707]
    """
    return _four_exponentials(a, b, c, d)  # pyright: ignore[reportCallIssue]


@jit_inline
def two_logarithms(load, speed):
    """Natural logarithms of a load and of the magnitude of a speed.

    Examples
    --------
    >>> two_logarithms(1.0, -1.0)
    (0.0, 0.0)
    """
    log_load, log_speed, _, _ = logarithms(load, abs(speed), 1.0, 1.0)
    return log_load, log_speed
