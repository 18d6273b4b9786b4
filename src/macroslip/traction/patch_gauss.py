"""Crook's patch integral for small pressure exponents, by a Gauss rule whose nodes are computed at the same time.

The rule of 8 nodes for Φ = ∫₀¹ s e^{Ps} g(B0 e^{Ps}) ds, g(B) = asinh √B/√(B(1 + B)), has the weight s. The integrand's
singularities, B = −1, lie π/P or more from the interval of s, so that the error of n nodes is of order (4π/P)^(−2n).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from macroslip.compiled import jit
from macroslip.contact.logarithms import write_exponential, write_logarithm
from macroslip.contact.vectors import LANES, VECTOR, Vectors

#: Power series of g, (−4)^n (n!)²/(2n + 1)!.
G_SERIES = [(-4.0) ** n * math.factorial(n) ** 2 / math.factorial(2 * n + 1) for n in range(9)]
#: That of its logarithmic slope B g'(B).
_STEEP_SERIES = [n * term for n, term in enumerate(G_SERIES)]
_NODES = 2 * LANES


def _gauss_rule(nodes: int) -> tuple[list[float], list[float]]:
    """Nodes and weights of ∫₀¹ s f(s) ds, exact for polynomials f of degree 2·nodes − 1."""
    from scipy.special import roots_jacobi

    x, weights = roots_jacobi(nodes, 0.0, 1.0)
    return ((1.0 + x) / 2.0).tolist(), (weights / 4.0).tolist()


_PLACES, _WEIGHTS = _gauss_rule(_NODES)


def _same(value: float) -> Any:
    return ir.Constant(VECTOR, [value] * LANES)


def _cool(write: Vectors, heating: Any) -> tuple[Any, Any]:
    """G and its logarithmic slope by their power series."""
    return tuple(write.polynomial([[term] * LANES for term in terms], heating) for terms in (G_SERIES, _STEEP_SERIES))


def _hot(write: Vectors, heating: Any) -> tuple[Any, Any]:
    """G and its logarithmic slope in closed form, B g' = [1 − (1 + 2B) g]/(2 (1 + B))."""
    builder = write.builder
    kind = ir.FunctionType(VECTOR, [VECTOR])
    root_of = builder.module.declare_intrinsic("llvm.sqrt.v4f64", fnty=kind)
    hotter = builder.fadd(heating, _same(1.0))
    root, hotter_root = builder.call(root_of, [heating]), builder.call(root_of, [hotter])
    angle = write_logarithm(builder, builder.fadd(root, hotter_root))
    g = builder.fdiv(angle, builder.fmul(root, hotter_root))
    rest = builder.fsub(_same(1.0), builder.fmul(builder.fadd(heating, hotter), g))
    return g, builder.fdiv(builder.fmul(_same(0.5), rest), hotter)


def _sums(function: Callable) -> Any:
    """An intrinsic of P and B0: Φ, its derivative by ln q0 and that by P, from what `function` writes."""

    def generate(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> Any:
        write = Vectors(builder)
        exponent, cold = (write.splat(one) for one in arguments)
        totals = [_same(0.0)] * 3
        for first in range(0, _NODES, LANES):
            places = ir.Constant(VECTOR, _PLACES[first : first + LANES])
            growth = write_exponential(builder, builder.fmul(exponent, places))
            g, steep = function(write, builder.fmul(cold, growth))
            share = builder.fmul(growth, ir.Constant(VECTOR, _WEIGHTS[first : first + LANES]))
            parts = g, builder.fadd(steep, steep), builder.fmul(builder.fadd(g, steep), places)
            totals = [write.fmuladd(share, part, total) for part, total in zip(parts, totals, strict=True)]
        found = [write.dot(total, _same(1.0)) for total in totals]
        return context.make_tuple(builder, signature.return_type, found)

    def typed(typingctx: Any, pressure_exponent: Any, heating: Any) -> Any:
        return types.UniTuple(types.float64, 3)(types.float64, types.float64), generate

    return intrinsic(typed)


_cool_sums, _hot_sums = _sums(_cool), _sums(_hot)


@jit
def cool_patch(pressure_exponent, heating):
    """Φ, ∂Φ/∂ ln q0 and ∂Φ/∂P of `macroslip.traction.patch_integral` at P up to 1.2 and B0 e^P below 0.02.

    Examples
    --------
    >>> [round(one, 12) for one in cool_patch(0.0, 0.0)]
    [0.5, 0.0, 0.333333333333]
    """
    return _cool_sums(pressure_exponent, heating)


@jit
def hot_patch(pressure_exponent, heating):
    """The same at larger B0.

    Examples
    --------
    >>> round(2.0 * hot_patch(0.0, 1.0)[0], 12)
    0.62322524014
    """
    return _hot_sums(pressure_exponent, heating)
