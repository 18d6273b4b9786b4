"""Four numbers in a vector register of the processor, as LLVM writes operations on them.

LLVM does not put such short sums into vectors by itself. The order of all sums is fixed, so results are the same on
processors with registers of any length.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir

LANES = 4
VECTOR = ir.VectorType(ir.DoubleType(), LANES)
_INDEX = ir.IntType(32)
_EMPTY = ir.Constant(VECTOR, ir.Undefined)


class Vectors:
    """Writes operations on vectors of four float."""

    def __init__(self, builder: ir.IRBuilder):
        self.builder = builder

    def lanes(self, vector: Any) -> list[Any]:
        """The four numbers."""
        return [self.builder.extract_element(vector, ir.Constant(_INDEX, n)) for n in range(LANES)]

    def splat(self, value: Any) -> Any:
        """The same number in all lanes."""
        first = self.builder.insert_element(_EMPTY, value, ir.Constant(_INDEX, 0))
        return self.builder.shuffle_vector(first, _EMPTY, ir.Constant(ir.VectorType(_INDEX, LANES), [0] * LANES))

    def polynomial(self, terms: list[list[float]], place: Any) -> Any:
        """Horner's scheme in every lane."""
        total = ir.Constant(VECTOR, terms[-1])
        for term in terms[-2::-1]:
            total = self.fmuladd(total, place, ir.Constant(VECTOR, term))
        return total

    def fmuladd(self, one: Any, other: Any, added: Any) -> Any:
        """A product and a sum, in one operation where the processor has that."""
        kind = ir.FunctionType(VECTOR, [VECTOR] * 3)
        function = self.builder.module.declare_intrinsic("llvm.fmuladd.v4f64", fnty=kind)
        return self.builder.call(function, [one, other, added])

    def weighted_sum(self, weights: list[Any], vectors: list[Any]) -> Any:
        """Σ w x, in every lane."""
        total = self.builder.fmul(weights[0], vectors[0])
        for weight, vector in zip(weights[1:], vectors[1:], strict=True):
            total = self.fmuladd(weight, vector, total)
        return total

    def splat_lanes(self, vector: Any) -> list[Any]:
        """For each lane a vector with its number in all lanes."""
        return [self.splat(one) for one in self.lanes(vector)]

    def dot(self, one: Any, other: Any) -> Any:
        """The sum over the lanes of the product."""
        a, b, c, d = self.lanes(self.builder.fmul(one, other))
        return self.builder.fadd(self.builder.fadd(a, b), self.builder.fadd(c, d))

    def load(self, address: Any) -> Any:
        """The four numbers at an address."""
        return self.builder.load(self.builder.inttoptr(address, VECTOR.as_pointer()), align=8)

    def gathered(self, values: list[Any]) -> Any:
        """One number in each lane."""
        vector = _EMPTY
        for lane, value in enumerate(values):
            vector = self.builder.insert_element(vector, value, ir.Constant(_INDEX, lane))
        return vector
