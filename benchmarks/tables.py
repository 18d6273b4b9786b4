"""The physical model by tables: one roller's speed over the bundled histories, and in which parts of its way the cost lies.

`python -m benchmarks.tables` prints it; with `--reference 1e-6` the errors too, against the laws at that tolerance.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any

import numpy as np

from benchmarks import own
from benchmarks.histories import History, long_histories
from benchmarks.outcome import errors
from benchmarks.scaling import cpu_seconds
from macroslip.case.parts import Radau
from macroslip.integrate.load_zone import EDGE, FIRM, FREE, classify, empty_classes
from macroslip.mechanisms import Laws

#: Classes of the loads' sample intervals, by what they are called in the output.
CLASSES = {"free": FREE, "edge": EDGE, "firm": FIRM}


def intervals_by_class(history: History) -> np.ndarray:
    """Number of the loads' sample intervals of each of `CLASSES`."""
    classes = empty_classes(history.motion.time.size)
    classify(history.roller, history.motion, history.start_angle, history.limits.firm, classes)
    return np.array([np.count_nonzero(classes == one) for one in CLASSES.values()])


def cost_by_class(intervals: np.ndarray, evaluations: np.ndarray) -> dict[str, float]:
    """Force evaluations in an interval in which a roller is firmly held and in any other, by non-negative least squares.

    Coasts and edges of the load zone come together, so that histories do not distinguish them.

    Parameters
    ----------
    intervals : ndarray, shape (histories, classes)
        As from `intervals_by_class`.
    evaluations : ndarray, shape (histories,)

    Examples
    --------
    >>> cost_by_class(np.array([[1.0, 2.0, 9.0], [8.0, 2.0, 5.0]]), np.array([48.0, 110.0]))
    {'firm': 2.0, 'other': 10.0}
    """
    from scipy.optimize import nnls

    firm = intervals[:, list(CLASSES).index("firm")].astype(float)
    other = intervals.sum(axis=1) - firm
    found, _ = nnls(np.column_stack([firm, other]), evaluations.astype(float))
    return {"firm": round(float(found[0]), 9), "other": round(float(found[1]), 9)}


def speed_by_tables(tolerance: float, *, quick: bool, report: Callable[[int, int], None]) -> dict[str, Any]:
    """One roller of each row by tables.

    Returns
    -------
    dict
        `downwind` and `upwind`, each with `median` and `least` of simulated over CPU time, the same with details of the
        contacts as `median_detailed` and `least_detailed`, and `evaluations_by_class`; `evaluation_us`, all CPU time
        without details over all evaluations; `histories`, each with `factor`, `factor_detailed`, `evaluations` and the
        number of `intervals` of each class.
    """
    histories = long_histories(quick=quick, laws=Laws.physical(), tables=True)
    found: dict[str, Any] = {}
    for number, history in enumerate(histories):
        report(number, len(histories))
        _, record = own.integrate(history, tolerance, np.empty(0))
        plain = history._replace(roller=history.roller._replace(detailed=False))
        seconds, detailed = cpu_seconds([plain], tolerance), cpu_seconds([history], tolerance)
        found[history.name] = {
            "factor": (history.end - history.start) / seconds,
            "factor_detailed": (history.end - history.start) / detailed,
            "evaluations": int(record.count[2]),
            "intervals": dict(zip(CLASSES, intervals_by_class(history).tolist(), strict=True)),
            "cpu_seconds": seconds,
        }
    rows = {row: [one for name, one in found.items() if f" {row}," in name] for row in ("downwind", "upwind")}
    return {
        **{row: _row(entries) for row, entries in rows.items()},
        "evaluation_us": 1e6
        * sum(one["cpu_seconds"] for one in found.values())
        / sum(one["evaluations"] for one in found.values()),
        "histories": found,
    }


def _row(entries: list[dict[str, Any]]) -> dict[str, Any]:
    factors, detailed = ([one[name] for one in entries] for name in ("factor", "factor_detailed"))
    intervals = np.array([list(one["intervals"].values()) for one in entries])
    return {
        "median": float(np.median(factors)),
        "least": min(factors),
        "median_detailed": float(np.median(detailed)),
        "least_detailed": min(detailed),
        "evaluations_by_class": cost_by_class(intervals, np.array([one["evaluations"] for one in entries])),
    }


def errors_by_tables(tolerance: float, reference: float, report: Callable[[str], None]) -> None:
    """Tell the errors of energy and mid-coast spin of every history against the laws at the tolerance `reference`."""
    pairs = (long_histories(quick=False, laws=Laws.physical(), tables=one) for one in (True, False))
    for table, laws in zip(*pairs, strict=True):
        energy, spin = errors(own.solve(table, tolerance), own.reference(laws, reference))
        report(f"{table.name}: energy {energy:.1e}, spin {spin:.1e}")


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tolerance", type=float, default=Radau().tolerance)
    parser.add_argument("--reference", type=float, help="tolerance of the laws to compare with")
    parser.add_argument("--quick", action="store_true", help="one case instead of 21")
    given = parser.parse_args()
    found = speed_by_tables(given.tolerance, quick=given.quick, report=lambda done, total: None)
    for name, one in found["histories"].items():
        share = ", ".join(f"{count} {kind}" for kind, count in one["intervals"].items())
        print(
            f"{name}: {one['factor']:.0f} times real time, {one['factor_detailed']:.0f} with details of contacts, "
            f"{one['evaluations']} evaluations; intervals: {share}"
        )
    for row in ("downwind", "upwind"):
        one = found[row]
        by_class = ", ".join(f"{count:.1f} {kind}" for kind, count in one["evaluations_by_class"].items())
        print(
            f"{row}: median {one['median']:.0f}, least {one['least']:.0f}; with details of contacts "
            f"{one['median_detailed']:.0f} and {one['least_detailed']:.0f}; evaluations in an interval: {by_class}"
        )
    print(f"{found['evaluation_us']:.2f} us of CPU time for an evaluation and all that goes with it")
    if given.reference is not None:
        errors_by_tables(given.tolerance, given.reference, lambda line: print(line, flush=True))


if __name__ == "__main__":
    main()
