"""A number type of kernels: four numbers in a vector register, on which formulas work as they do on one.

A compiled function of floats is one of `Lanes` too if it has sums, products, quotients, `math.log`, `math.exp`, `abs` and
`math.copysign` only; `chosen` stands for an `if`. So the forces at the stages of a step are computed at the same time,
from the source of those at one.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic, lower_builtin, models, overload, register_model, type_callable

from macroslip.contact.logarithms import write_exponential, write_logarithm
from macroslip.contact.vectors import LANES, VECTOR, Vectors

_FLAGS = ir.VectorType(ir.IntType(1), LANES)


class _Vector(types.Type):
    """Type of four values in a register."""


class _VectorModel(models.PrimitiveModel):
    vector: Any

    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, self.vector)


class _NumbersModel(_VectorModel):
    vector = VECTOR


class _FlagsModel(_VectorModel):
    vector = _FLAGS


class _Numbers(_Vector):
    pass


class _Truths(_Vector):
    pass


register_model(_Numbers)(_NumbersModel)
register_model(_Truths)(_FlagsModel)
#: Four floats, and what comparing them gives.
NUMBERS, TRUTHS = _Numbers("Lanes"), _Truths("LaneFlags")


def is_lanes(kind: Any) -> bool:
    """Whether a numba type is that of four numbers."""
    return kind == NUMBERS


def _is_operand(kind: Any) -> bool:
    return kind == NUMBERS or kind == types.float64


def _lower(function: Callable, kinds: list[Any], write: Callable) -> None:
    """Lower `function` for arguments of these types; floats are put into all lanes first."""

    def generate(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
        vectors = [
            value if kind == NUMBERS else Vectors(builder).splat(value)
            for kind, value in zip(signature.args, arguments, strict=True)
        ]
        return write(builder, *vectors)

    lower_builtin(function, *kinds)(generate)


def _register(function: Callable, arity: int, result: Any, write: Callable) -> None:
    """Let kernels apply a function to lanes, or to lanes and floats."""

    def typer(context: Any) -> Callable:
        def of_one(a: Any) -> Any:
            return result if a == NUMBERS else None

        def of_two(a: Any, b: Any) -> Any:
            return result if NUMBERS in (a, b) and _is_operand(a) and _is_operand(b) else None

        return of_one if arity == 1 else of_two

    type_callable(function)(typer)
    pairs = [[NUMBERS, NUMBERS], [NUMBERS, types.float64], [types.float64, NUMBERS]]
    for kinds in [[NUMBERS]] if arity == 1 else pairs:
        _lower(function, kinds, write)


def _vector_intrinsic(name: str, arity: int) -> Callable:
    """What writes a call of one of LLVM's functions for every lane."""

    def write(builder: ir.IRBuilder, *vectors: Any) -> Any:
        kind = ir.FunctionType(VECTOR, [VECTOR] * arity)
        return builder.call(builder.module.declare_intrinsic(f"llvm.{name}.v{LANES}f64", fnty=kind), vectors)

    return write


def _comparison(sign: str) -> Callable:
    return lambda builder, a, b: builder.fcmp_ordered(sign, a, b)


_ADD, _SUBTRACT, _MULTIPLY, _DIVIDE = (
    lambda builder, a, b: builder.fadd(a, b),
    lambda builder, a, b: builder.fsub(a, b),
    lambda builder, a, b: builder.fmul(a, b),
    lambda builder, a, b: builder.fdiv(a, b),
)
for _function, _write in (
    (operator.add, _ADD),
    (operator.iadd, _ADD),
    (operator.sub, _SUBTRACT),
    (operator.isub, _SUBTRACT),
    (operator.mul, _MULTIPLY),
    (operator.imul, _MULTIPLY),
    (operator.truediv, _DIVIDE),
    (operator.itruediv, _DIVIDE),
    (math.copysign, _vector_intrinsic("copysign", 2)),
):
    _register(_function, 2, NUMBERS, _write)
for _function, _write in (
    (operator.neg, lambda builder, a: builder.fneg(a)),
    (abs, _vector_intrinsic("fabs", 1)),
    (math.log, write_logarithm),
    (math.exp, write_exponential),
):
    _register(_function, 1, NUMBERS, _write)
for _function, _sign in ((operator.lt, "<"), (operator.le, "<="), (operator.gt, ">"), (operator.ge, ">=")):
    _register(_function, 2, TRUTHS, _comparison(_sign))


def _gathered(typingctx, a, b, c):
    """Three numbers in lanes; the fourth lane holds the third one again, so that all of them are numbers."""

    def generate(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
        return Vectors(builder).gathered([*arguments, arguments[2]])

    return NUMBERS(*[types.float64] * 3), generate


def _scattered(typingctx, value):
    def generate(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
        return context.make_tuple(builder, signature.return_type, Vectors(builder).lanes(arguments[0])[:3])

    return types.UniTuple(types.float64, 3)(NUMBERS), generate


def scattered(value):
    """The numbers in the first three lanes; three times the value itself if it is none of lanes."""
    return value, value, value


@overload(scattered)
def _scattered_of(value):
    if is_lanes(value):
        return lambda value: _three(value)
    return lambda value: (value, value, value)


def _chosen(typingctx, flags, one, other):
    """In every lane `one` where the flag is set, else `other`: floats, or lanes."""

    def generate(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
        vectors = [
            value if kind == NUMBERS else Vectors(builder).splat(value)
            for kind, value in zip(signature.args[1:], arguments[1:], strict=True)
        ]
        return builder.select(arguments[0], *vectors)

    return NUMBERS(TRUTHS, one, other), generate


def _every(typingctx, flags):
    """Whether the flag is set in all lanes."""

    def generate(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
        bits = builder.bitcast(arguments[0], ir.IntType(LANES))
        return builder.icmp_unsigned("==", bits, ir.Constant(ir.IntType(LANES), 2**LANES - 1))

    return types.boolean(TRUTHS), generate


#: Functions for kernels.
gathered: Any = intrinsic(_gathered)
chosen: Any = intrinsic(_chosen)
every: Any = intrinsic(_every)
_three: Any = intrinsic(_scattered)
