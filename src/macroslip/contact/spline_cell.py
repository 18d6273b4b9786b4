"""Cubic B-splines on unit knots, one cell at a time, with four coefficients in a vector register of the processor.

A contact with microslip looks some thirty stresses up for every force evaluation, and each is a weighted sum of 64
coefficients. Written as vectors they take a quarter of the time.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import TypingError, types
from numba.extending import intrinsic

from macroslip.contact.vectors import LANES, Vectors

_SIZE = ir.IntType(64)
_WEIGHTS = types.UniTuple(types.float64, LANES)
#: The four weights as a polynomial of the place in the cell, constant term first, and their derivatives.
_CUBIC = [[1 / 6, 4 / 6, 1 / 6, 0.0], [-0.5, 0.0, 0.5, 0.0], [0.5, -1.0, 0.5, 0.0], [-1 / 6, 0.5, -0.5, 1 / 6]]
_QUADRATIC = [[-0.5, 0.0, 0.5, 0.0], [1.0, -2.0, 1.0, 0.0], [-0.5, 1.5, -1.5, 0.5]]


def _parts(builder: ir.IRBuilder, value: Any) -> list[Any]:
    """What a tuple consists of."""
    return [builder.extract_value(value, k) for k in range(len(value.type))]


def _check(coefficients: Any, dimensions: int) -> None:
    array = isinstance(coefficients, types.Array) and coefficients.layout == "C"
    if not array or coefficients.ndim != dimensions or coefficients.dtype != types.float64:
        raise TypingError(f"coefficients of a spline are an array of float64, {dimensions}-dimensional, in C order")


def _address(context: Any, builder: ir.IRBuilder, kind: Any, array: Any, indices: list[Any]) -> tuple[Any, list[Any]]:
    """Address of an array's element, and the array's strides [bytes]."""
    struct = context.make_array(kind)(context, builder, array)
    strides = _parts(builder, struct.strides)
    address = builder.ptrtoint(struct.data, _SIZE)
    for index, stride in zip(indices, strides, strict=True):
        address = builder.add(address, builder.mul(index, stride))
    return address, strides


@intrinsic
def weights_and_slopes(typingctx, place):
    """Weights w of a cell's four coefficients at a place t in it, from 0 to 1, and their derivatives.

    Returns
    -------
    tuple of 4 float, tuple of 4 float
    """

    def generate(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
        write = Vectors(builder)
        t = write.splat(arguments[0])
        lanes = [write.lanes(write.polynomial(terms, t)) for terms in (_CUBIC, _QUADRATIC)]
        fours = [context.make_tuple(builder, _WEIGHTS, four) for four in lanes]
        return context.make_tuple(builder, signature.return_type, fours)

    return types.UniTuple(_WEIGHTS, 2)(types.float64), generate


@intrinsic
def along_line(typingctx, coefficients, cell, place):
    """Value and derivative of a spline Σ_n w_n(t) c[i + n].

    Parameters
    ----------
    coefficients : ndarray, 1 dimension
        c.
    cell : int
        i, with i + 3 within the array.
    place : float
        t in the cell, from 0 to 1.

    Returns
    -------
    tuple of 2 float
    """
    _check(coefficients, 1)

    def generate(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
        write = Vectors(builder)
        address, _ = _address(context, builder, coefficients, arguments[0], arguments[1:2])
        t, values = write.splat(arguments[2]), write.load(address)
        found = [write.dot(write.polynomial(terms, t), values) for terms in (_CUBIC, _QUADRATIC)]
        return context.make_tuple(builder, signature.return_type, found)

    return types.UniTuple(types.float64, 2)(coefficients, types.intp, types.float64), generate


@intrinsic
def in_cell(typingctx, coefficients, cells, first_place, third_place, second_weights):
    """Value of a spline Σ w_m(t) z_q w_n(u) c[i + m, k + q, j + n], and its derivatives by t and u.

    Parameters
    ----------
    coefficients : ndarray, 3 dimensions
        c.
    cells : tuple of 3 int
        i, k, j, with the cell within the array.
    first_place, third_place : float
        t and u in the cell, from 0 to 1.
    second_weights : tuple of 4 float
        z, which many look-ups share.

    Returns
    -------
    tuple of 3 float
    """
    _check(coefficients, 3)

    def generate(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
        write = Vectors(builder)
        indices = _parts(builder, arguments[1])
        corner, strides = _address(context, builder, coefficients, arguments[0], indices)
        t, u = write.splat(arguments[2]), write.splat(arguments[3])
        z = [write.splat(weight) for weight in _parts(builder, arguments[4])]
        planes = []
        for _ in range(LANES):
            lines, line = [], corner
            for _ in range(LANES):
                lines.append(write.load(line))
                line = builder.add(line, strides[1])
            planes.append(write.weighted_sum(z, lines))
            corner = builder.add(corner, strides[0])
        weights, slopes = (
            [write.splat(weight) for weight in write.lanes(write.polynomial(terms, t))]
            for terms in (_CUBIC, _QUADRATIC)
        )
        along_third, by_first = write.weighted_sum(weights, planes), write.weighted_sum(slopes, planes)
        over_third = write.polynomial(_CUBIC, u)
        found = [
            write.dot(over_third, along_third),
            write.dot(over_third, by_first),
            write.dot(write.polynomial(_QUADRATIC, u), along_third),
        ]
        return context.make_tuple(builder, signature.return_type, found)

    given = types.UniTuple(types.intp, 3), types.float64, types.float64, _WEIGHTS
    return types.UniTuple(types.float64, 3)(coefficients, *given), generate


@intrinsic
def channels_in_cell(typingctx, coefficients, cells, places):
    """Four splines on one grid at a place, Σ w_m(t) w_q(s) w_n(u) c[i + m, k + q, j + n], and their derivatives.

    What is not used of them costs nothing: it is not compiled.

    Parameters
    ----------
    coefficients : ndarray, 4 dimensions, the last one of four splines
        c.
    cells : tuple of 3 int
        i, k, j, with the cell within the array.
    places : tuple of 3 float
        t, s and u in the cell, from 0 to 1.

    Returns
    -------
    tuple of 4 float, four times
        The splines, and their derivatives by t, by s and by u.
    """
    _check(coefficients, 4)

    def generate(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
        write = Vectors(builder)
        indices = [*_parts(builder, arguments[1]), ir.Constant(_SIZE, 0)]
        corner, strides = _address(context, builder, coefficients, arguments[0], indices)
        (w, dw), (z, dz), (v, dv) = (
            [write.splat_lanes(write.polynomial(terms, write.splat(place))) for terms in (_CUBIC, _QUADRATIC)]
            for place in _parts(builder, arguments[2])
        )
        lines, by_first, by_second = [], [], []
        for _ in range(LANES):
            plane, sums, slopes = corner, [], []
            for _ in range(LANES):
                line, values = plane, []
                for _ in range(LANES):
                    values.append(write.load(line))
                    line = builder.add(line, strides[1])
                sums.append(write.weighted_sum(z, values))
                slopes.append(write.weighted_sum(dz, values))
                plane = builder.add(plane, strides[0])
            lines.append(write.weighted_sum(w, sums))
            by_first.append(write.weighted_sum(dw, sums))
            by_second.append(write.weighted_sum(w, slopes))
            corner = builder.add(corner, strides[2])
        found = [
            context.make_tuple(builder, _WEIGHTS, write.lanes(write.weighted_sum(weights, given)))
            for weights, given in ((v, lines), (v, by_first), (v, by_second), (dv, lines))
        ]
        return context.make_tuple(builder, signature.return_type, found)

    given = types.UniTuple(types.intp, 3), types.UniTuple(types.float64, 3)
    return types.UniTuple(_WEIGHTS, 4)(coefficients, *given), generate


@intrinsic
def channels_in_square(typingctx, coefficients, cells, places):
    """Four splines on one grid at a place, Σ w_m(t) w_n(u) c[i + m, j + n], and their derivatives by t and u.

    Parameters
    ----------
    coefficients : ndarray, 3 dimensions, the last one of four splines
        c.
    cells : tuple of 2 int
        i, j, with the cell within the array.
    places : tuple of 2 float
        t and u in the cell, from 0 to 1.

    Returns
    -------
    tuple of 4 float, three times
    """
    _check(coefficients, 3)

    def generate(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
        write = Vectors(builder)
        indices = [*_parts(builder, arguments[1]), ir.Constant(_SIZE, 0)]
        corner, strides = _address(context, builder, coefficients, arguments[0], indices)
        first, second = (write.splat(place) for place in _parts(builder, arguments[2]))
        (w, dw), (z, dz) = (
            [write.splat_lanes(write.polynomial(terms, place)) for terms in (_CUBIC, _QUADRATIC)]
            for place in (first, second)
        )
        lines, slopes = [], []
        for _ in range(LANES):
            value, values = corner, []
            for _ in range(LANES):
                values.append(write.load(value))
                value = builder.add(value, strides[1])
            lines.append(write.weighted_sum(z, values))
            slopes.append(write.weighted_sum(dz, values))
            corner = builder.add(corner, strides[0])
        sums = write.weighted_sum(w, lines), write.weighted_sum(dw, lines), write.weighted_sum(w, slopes)
        found = [context.make_tuple(builder, _WEIGHTS, write.lanes(one)) for one in sums]
        return context.make_tuple(builder, signature.return_type, found)

    given = types.UniTuple(types.intp, 2), types.UniTuple(types.float64, 2)
    return types.UniTuple(_WEIGHTS, 3)(coefficients, *given), generate
