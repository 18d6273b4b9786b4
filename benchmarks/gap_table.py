"""Make the table of load, rolling resistance and shear of rigid contacts: `python benchmarks/gap_table.py`.

It writes `src/macroslip/rolling/gap_table.csv` (about ten minutes on one core). Each quantity is divided by its value
without flow along the roller's axis, where every slice is Martin's line contact with its own gap h0 (1 + κ Z²):

    ∫∫ P = 0.40791 atan(√κ)/√κ,   ∫∫ H ∂P/∂X = 1.08448 asinh(√κ)/√κ,   ∫∫ 1/H = 4.02870 asinh(√κ)/√κ.

Two grids, the second twice as fine, are extrapolated to second order; `error` is the largest of the three changes that
the extrapolation makes.
"""

from __future__ import annotations

import math
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np
from gap_solution import solve_gap

from macroslip.contact import gap

TABLE = Path(__file__).parents[1] / "src" / "macroslip" / "contact" / "gap_table.csv"
#: ln(1 + κ), and the square root of the width of the pressure over that of the film, s = λ √(1 + κ).
LOG_CURVATURES = np.linspace(0.0, math.log(1e5), 16)
ROOT_ASPECTS = np.linspace(0.0, 2.0, 17)
COARSE, FINE = (100, 25), (200, 50)


def slices(kappa: float) -> np.ndarray:
    """The three integrals without flow along the axis."""
    root = math.sqrt(kappa)
    narrow, wide = (math.atan(root) / root, math.asinh(root) / root) if kappa > 0.0 else (1.0, 1.0)
    return np.array(
        [
            gap.LOAD / 12.0 * narrow,
            gap.ROLLING_AT_GAP * math.sqrt(2.0) / 6.0 * wide,
            2.0 * gap.SHEAR * wide,
        ]
    )


def entry(node: tuple[float, float]) -> tuple[float, ...]:
    """One line of the table: ln(1 + κ), √s, the three ratios and the grid error."""
    log_curvature, root_aspect = node
    if root_aspect == 0.0:
        return log_curvature, root_aspect, 1.0, 1.0, 1.0, 0.0
    kappa = math.expm1(log_curvature)
    aspect = root_aspect**2 / math.sqrt(1.0 + kappa)
    coarse, fine = (
        np.array(solve_gap(kappa, aspect, cells)[:3]) / slices(kappa) for cells in (COARSE, FINE)
    )
    change = (fine - coarse) / 3.0
    return log_curvature, root_aspect, *(fine + change), float(np.max(np.abs(change / fine)))


def main(workers: int) -> None:
    """Solve for all places and write the table."""
    places = [(float(a), float(b)) for a in LOG_CURVATURES for b in ROOT_ASPECTS]
    with ProcessPoolExecutor(workers) as pool:
        lines = list(pool.map(entry, places))
    with TABLE.open("w", encoding="utf-8") as file:
        file.write("log_curvature,root_aspect,load,rolling,shear,error\n")
        file.writelines(",".join(f"{value:.7g}" for value in line) + "\n" for line in lines)
    print(
        f"{TABLE}: {len(lines)} solutions, largest change by extrapolation {max(line[-1] for line in lines):.2e}"
    )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1)
