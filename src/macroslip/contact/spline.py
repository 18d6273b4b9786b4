"""Cubic splines on even grids: axes, coefficients, and look-ups for compiled code.

A spline of n nodes along an axis has n + 2 coefficients there. Tables of a contact hold four
splines on one grid, their coefficients next to each other in one flat array, so that a look-up sums
four numbers at a time in a vector register. Beside `macroslip.elementary` this is the only file
that writes instructions for the compiler: its vectors take a third of the time of plain loops. The
order of all sums is fixed, so results are the same on processors with registers of any length.

de Boor, A Practical Guide to Splines, Springer (1978), doi:10.1007/978-1-4612-6333-3.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import intrinsic

#: Splines that share a grid.
CHANNELS = 4
_VECTOR = ir.VectorType(ir.DoubleType(), CHANNELS)
_INDEX = ir.IntType(32)
_SIZE = ir.IntType(64)
_EMPTY = ir.Constant(_VECTOR, ir.Undefined)
_FOUR = types.UniTuple(types.float64, CHANNELS)
#: First coefficient, stride and position of a look-up in a plane.
_IN_PLANE = (types.intp, types.intp, types.float64, types.float64)
#: The four weights as a polynomial of the position in the cell, constant term first, and their
#: derivatives.
_CUBIC = [
    [1 / 6, 4 / 6, 1 / 6, 0.0],
    [-0.5, 0.0, 0.5, 0.0],
    [0.5, -1.0, 0.5, 0.0],
    [-1 / 6, 0.5, -0.5, 1 / 6],
]
_QUADRATIC = [[-0.5, 0.0, 0.5, 0.0], [1.0, -2.0, 1.0, 0.0], [-0.5, 1.5, -1.5, 0.5]]


class Axis(NamedTuple):
    """Evenly spaced nodes of one coordinate."""

    first: float  #: Coordinate of the first node
    per_spacing: float  #: Reciprocal of the distance between nodes
    cells: int  #: Number of cells between the nodes

    @property
    def nodes(self) -> np.ndarray:
        """Coordinates of the nodes."""
        return self.first + np.arange(self.cells + 1) / self.per_spacing

    @property
    def middles(self) -> np.ndarray:
        """Coordinates of the middles of the cells."""
        return self.first + (np.arange(self.cells) + 0.5) / self.per_spacing


def axis(first: float, last: float, spacing: float) -> Axis:
    """Nodes from `first` to `last`, at most `spacing` apart and at least five.

    Examples
    --------
    >>> axis(0.0, 1.0, 0.1)
    Axis(first=0.0, per_spacing=10.0, cells=10)
    """
    length = last - first
    cells = math.ceil(length / spacing * (1.0 - 1e-12))
    cells = max(cells, 4)
    return Axis(float(first), cells / length, cells)


def spline_coefficients(values: np.ndarray, dimensions: int) -> np.ndarray:
    """Coefficients of the tensor-product spline through given values.

    At the ends of the first `dimensions` axes it is not-a-knot.

    Examples
    --------
    >>> spline_coefficients(np.arange(6.0), 1).round(12)
    array([-1.,  0.,  1.,  2.,  3.,  4.,  5.,  6.])
    """
    for dimension in range(dimensions):
        size = list(values.shape)
        size[dimension] += 2
        coefficients = np.empty(size)
        _write_coefficients(
            np.moveaxis(values, dimension, 0), np.moveaxis(coefficients, dimension, 0)
        )
        values = coefficients
    return values


def _write_coefficients(nodes: np.ndarray, coefficients: np.ndarray) -> None:
    """Write the coefficients of splines along the first axis, two more than it has nodes.

    A value at a node is (c₋ + 4 c + c₊)/6 of three neighbouring coefficients. The equations are
    solved by elimination, whose pivots 4 − 1/(4 − …) are the same for all splines: whole layers of
    the array are subtracted from one another where they lie, and nothing is copied for a solver.
    """
    inner = coefficients[1:-1]  # those of the nodes, in their order
    inner[2:-2] = 6.0 * nodes[2:-2]
    # Not a knot: the fourth difference of the first five coefficients vanishes, which gives the
    # second node's.
    for side in (slice(None), slice(None, None, -1)):
        first, second, third = nodes[side][:3]
        inner[side][1] = (8.0 * second - first - third) / 6.0
        inner[side][2] -= inner[side][1]
    last = len(nodes) - 3
    per_pivot = [0.25]
    for index in range(3, last + 1):
        inner[index] -= per_pivot[-1] * inner[index - 1]
        per_pivot.append(1.0 / (4.0 - per_pivot[-1]))
    inner[last] *= per_pivot[-1]
    for index in range(last - 1, 1, -1):
        inner[index] -= inner[index + 1]
        inner[index] *= per_pivot[index - 2]
    for side in (slice(None), slice(None, None, -1)):
        for index in (1, 0):
            coefficients[side][index] = (
                6.0 * nodes[side][index]
                - 4.0 * coefficients[side][index + 1]
                - coefficients[side][index + 2]
            )


class _Vectors:
    """Writes operations on vectors of four numbers."""

    def __init__(self, builder: ir.IRBuilder):
        self.builder = builder

    def splat(self, value: Any) -> Any:
        """A vector with one number in all lanes."""
        first = self.builder.insert_element(_EMPTY, value, ir.Constant(_INDEX, 0))
        return self.builder.shuffle_vector(
            first, _EMPTY, ir.Constant(ir.VectorType(_INDEX, CHANNELS), [0] * CHANNELS)
        )

    def lanes(self, vector: Any) -> list[Any]:
        """The four numbers."""
        return [
            self.builder.extract_element(vector, ir.Constant(_INDEX, n)) for n in range(CHANNELS)
        ]

    def fours(self, context: Any, signature: Any, vectors: list[Any]) -> Any:
        """A tuple of tuples of the four numbers of each vector."""
        numbers = [
            context.make_tuple(self.builder, _FOUR, self.lanes(vector)) for vector in vectors
        ]
        return context.make_tuple(self.builder, signature.return_type, numbers)

    def add_product(self, factor: Any, other: Any, added: Any) -> Any:
        """A product and a sum, in one operation where the processor has it."""
        kind = ir.FunctionType(_VECTOR, [_VECTOR] * 3)
        function = self.builder.module.declare_intrinsic("llvm.fmuladd.v4f64", fnty=kind)
        return self.builder.call(function, [factor, other, added])

    def polynomial(self, terms: list[list[float]], position: Any) -> Any:
        """The four weights of a cell at a position in it."""
        at = self.splat(position)
        total = ir.Constant(_VECTOR, terms[-1])
        for term in terms[-2::-1]:
            total = self.add_product(total, at, ir.Constant(_VECTOR, term))
        return total

    def weights(self, terms: list[list[float]], position: Any) -> list[Any]:
        """The four weights of a cell at a position in it, each in all lanes."""
        return [self.splat(lane) for lane in self.lanes(self.polynomial(terms, position))]

    def sum(self, weights: list[Any], vectors: list[Any]) -> Any:
        """Σ w x in every lane."""
        total = self.builder.fmul(weights[0], vectors[0])
        for weight, vector in zip(weights[1:], vectors[1:], strict=True):
            total = self.add_product(weight, vector, total)
        return total

    def lines(self, address: Any, stride: Any) -> list[list[Any]]:
        """Lines of four neighbouring nodes along another axis."""
        lines_read = []
        for _ in range(4):
            lines_read.append(self.line(address))
            address = self.builder.add(address, stride)
        return lines_read

    def line(self, address: Any) -> list[Any]:
        """Four neighbouring nodes along the last axis, each with its four splines."""
        step = ir.Constant(_SIZE, 8 * CHANNELS)
        nodes = []
        for _ in range(4):
            nodes.append(
                self.builder.load(self.builder.inttoptr(address, _VECTOR.as_pointer()), align=8)
            )
            address = self.builder.add(address, step)
        return nodes


def _address(context: Any, builder: ir.IRBuilder, kind: Any, array: Any, start: Any) -> Any:
    """Address of the number `start` of a flat array, which is given itself or by its address."""
    if isinstance(kind, types.Integer):
        data = array
    else:
        data = builder.ptrtoint(context.make_array(kind)(context, builder, array).data, _SIZE)
    return builder.add(data, builder.mul(start, ir.Constant(_SIZE, 8)))


def _is_flat(table: Any) -> bool:
    """True for the type of a flat array or its address: an address counts no references."""
    flat = types.Array(types.float64, 1, "C", readonly=True), types.Array(types.float64, 1, "C")
    return table in flat or isinstance(table, types.Integer)


@intrinsic
def spline_value(typingctx, table, start, strides, positions):
    """Value of one cubic spline over three axes.

    It is Σ w_m(t) w_q(s) w_n(u) c[start + m strides_0 + q strides_1 + n].

    Parameters
    ----------
    typingctx : Context
        Of numba, which leaves it out of a call.
    table : int or ndarray, shape (n,)
        The flat coefficients, or their address.
    start : int
        Number of the cell's first coefficient.
    strides : tuple of two ints
        Numbers from one node to the next along the first and the second axis; 1 along the third.
    positions : tuple of three floats
        t, s and u in the cell [-], 0 to 1.

    Returns
    -------
    float
        Value of the spline.
    """

    def _generate(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
        write = _Vectors(builder)
        corner = _address(context, builder, table, arguments[0], arguments[1])
        first, second = (
            builder.mul(builder.extract_value(arguments[2], k), ir.Constant(_SIZE, 8))
            for k in range(2)
        )
        t, s, u = (builder.extract_value(arguments[3], k) for k in range(3))
        w = write.weights(_CUBIC, t)
        z = write.weights(_CUBIC, s)
        planes = []
        for _ in range(4):
            address = corner
            lines = []
            for _ in range(4):
                lines.append(builder.load(builder.inttoptr(address, _VECTOR.as_pointer()), align=8))
                address = builder.add(address, second)
            planes.append(write.sum(z, lines))
            corner = builder.add(corner, first)
        along = write.polynomial(_CUBIC, u)
        a, b, c, d = write.lanes(builder.fmul(write.sum(w, planes), along))
        return builder.fadd(builder.fadd(a, b), builder.fadd(c, d))

    arguments_taken = (types.intp, types.UniTuple(types.intp, 2), types.UniTuple(types.float64, 3))
    return (types.float64(table, *arguments_taken), _generate) if _is_flat(table) else None


@intrinsic
def splines_in_square(typingctx, table, start, stride, t, u):
    """Four cubic splines over two axes and their derivatives.

    They are Σ w_m(t) w_n(u) c[start + m stride + 4 n + channel].

    Parameters
    ----------
    typingctx : Context
        Of numba, which leaves it out of a call.
    table : int or ndarray, shape (n,)
        The flat coefficients, or their address.
    start : int
        Number of the cell's first coefficient.
    stride : int
        Numbers from one node of the first axis to the next; 4 along the second.
    t, u : float
        Positions in the cell [-], 0 to 1.

    Returns
    -------
    value, by_t, by_u : tuple of four floats
        Values of the splines, and their derivatives by t and by u.
    """

    def _generate(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
        write = _Vectors(builder)
        address = _address(context, builder, table, arguments[0], arguments[1])
        step = builder.mul(arguments[2], ir.Constant(_SIZE, 8))
        (w, dw), (z, dz) = (
            [write.weights(terms, position) for terms in (_CUBIC, _QUADRATIC)]
            for position in arguments[3:]
        )
        # Along the first axis first: without its derivative half of the sums are left.
        nodes = list(zip(*write.lines(address, step), strict=True))
        sums = [write.sum(w, values) for values in nodes]
        slopes = [write.sum(dw, values) for values in nodes]
        derivatives = [write.sum(z, sums), write.sum(z, slopes), write.sum(dz, sums)]
        return write.fours(context, signature, derivatives)

    return (types.UniTuple(_FOUR, 3)(table, *_IN_PLANE), _generate) if _is_flat(table) else None


@intrinsic
def splines_along_first(typingctx, table, start, stride, t, u):
    """Four cubic splines over two axes and their derivatives along the first.

    As `splines_in_square`, in little more than half of its sums: along the second axis first.

    Parameters
    ----------
    typingctx : Context
        Of numba, which leaves it out of a call.
    table : int or ndarray, shape (n,)
        The flat coefficients, or their address.
    start : int
        Number of the cell's first coefficient.
    stride : int
        Numbers from one node of the first axis to the next; 4 along the second.
    t, u : float
        Positions in the cell [-], 0 to 1.

    Returns
    -------
    value, by_t : tuple of four floats
        Values of the splines, and their derivatives by t.
    """

    def _generate(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
        write = _Vectors(builder)
        address = _address(context, builder, table, arguments[0], arguments[1])
        step = builder.mul(arguments[2], ir.Constant(_SIZE, 8))
        z = write.weights(_CUBIC, arguments[4])
        sums = [write.sum(z, nodes) for nodes in write.lines(address, step)]
        value, by_t = (
            write.sum(write.weights(terms, arguments[3]), sums) for terms in (_CUBIC, _QUADRATIC)
        )
        return write.fours(context, signature, [value, by_t])

    return (types.UniTuple(_FOUR, 2)(table, *_IN_PLANE), _generate) if _is_flat(table) else None


@intrinsic
def splines_in_cube(typingctx, table, start, strides, positions):
    """Four cubic splines over three axes and their derivatives.

    They are Σ w_m(t) w_q(s) w_n(u) c[start + m strides_0 + q strides_1 + 4 n + channel]. Values
    that are not used cost nothing: they are not compiled.

    Parameters
    ----------
    typingctx : Context
        Of numba, which leaves it out of a call.
    table : int or ndarray, shape (n,)
        The flat coefficients, or their address.
    start : int
        Number of the cell's first coefficient.
    strides : tuple of two ints
        Numbers from one node to the next along the first and the second axis; 4 along the third.
    positions : tuple of three floats
        t, s and u in the cell [-], 0 to 1.

    Returns
    -------
    value, by_t, by_s, by_u : tuple of four floats
        Values of the splines, and their derivatives by t, s and u.
    """

    def _generate(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
        write = _Vectors(builder)
        corner = _address(context, builder, table, arguments[0], arguments[1])
        first, second = (
            builder.mul(builder.extract_value(arguments[2], k), ir.Constant(_SIZE, 8))
            for k in range(2)
        )
        (w, dw), (z, dz), (v, dv) = (
            [
                write.weights(terms, builder.extract_value(arguments[3], k))
                for terms in (_CUBIC, _QUADRATIC)
            ]
            for k in range(3)
        )
        # Along the first axis first: without its derivative little more than half of the sums are
        # left.
        values = []
        by_first = []
        by_third = []
        for _ in range(4):
            nodes = list(zip(*write.lines(corner, first), strict=True))
            corner = builder.add(corner, second)
            sums = [write.sum(w, four) for four in nodes]
            values.append(write.sum(v, sums))
            by_third.append(write.sum(dv, sums))
            slopes = [write.sum(dw, four) for four in nodes]
            by_first.append(write.sum(v, slopes))
        derivatives = [
            write.sum(z, values),
            write.sum(z, by_first),
            write.sum(dz, values),
            write.sum(z, by_third),
        ]
        return write.fours(context, signature, derivatives)

    arguments_taken = (types.intp, types.UniTuple(types.intp, 2), types.UniTuple(types.float64, 3))
    return (
        (types.UniTuple(_FOUR, 4)(table, *arguments_taken), _generate) if _is_flat(table) else None
    )
