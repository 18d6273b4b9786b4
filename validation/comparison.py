"""One line of the table: a quantity as it was measured and as the program computes it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np


class Range(NamedTuple):
    """Lowest and highest value over what is not known, or over what was measured."""

    low: float
    high: float

    @classmethod
    def of(cls, values) -> Range:
        """Ends of an array."""
        return cls(float(np.min(values)), float(np.max(values)))

    def __str__(self) -> str:
        low, high = (f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}" for value in self)
        return low if low == high else f"{low} to {high}"


class Comparison(NamedTuple):
    """A quantity, measured and computed.

    Attributes
    ----------
    quantity : str
        With its unit.
    measured, computed : Range
    ratio : Range
        Computed over measured, each pair under the same conditions.
    decides : str
        Which assumption of the program stands or falls with it.
    """

    quantity: str
    measured: Range
    computed: Range
    ratio: Range
    decides: str


def table(rows: list[Comparison]) -> str:
    """The rows as a table in Markdown."""
    lines = [
        "| quantity | measured | computed | ratio | what it decides |",
        "|---|---|---|---|---|",
    ]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines)
