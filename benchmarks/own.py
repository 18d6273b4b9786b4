"""The production integrator on a history of the comparison, in the same terms as its rivals."""

from __future__ import annotations

import numpy as np

from benchmarks.histories import History
from benchmarks.outcome import Reference, Solution
from macroslip.integrate.load_zone import empty_classes
from macroslip.integrate.path import Path
from macroslip.integrate.radau import integrate_radau
from macroslip.integrate.record import RollerRecord, new_record
from macroslip.imposed.status import COMPLETED

#: Tolerance of the reference.
REFERENCE_TOLERANCE = 1e-9


def integrate(history: History, tolerance: float, trace_time: np.ndarray) -> tuple[int, RollerRecord]:
    """Status and record of the whole history; a step ends at each trace time [s]."""
    record = new_record(np.array([history.start, history.end]), trace_time, history.limits.speed_scale)
    stops = np.unique(np.concatenate([trace_time, [history.end]]))
    limits = history.limits._replace(tolerance=tolerance)
    path = Path(history.roller, history.motion, history.start_angle, limits)
    classes = empty_classes(history.motion.time.size)
    status = integrate_radau(path, 0.0, stops, classes, record)
    return status, record


def solve(history: History, tolerance: float) -> Solution:
    """The history at a tolerance; energies are NaN if a roller failed."""
    status, record = integrate(history, tolerance, history.marks)
    energy = record.energy if status == COMPLETED else np.full(3, np.nan)
    return Solution(energy, record.trace[:, 0], float(record.count[2]))


def reference(history: History, tolerance: float = REFERENCE_TOLERANCE) -> Reference:
    """The history at a tight tolerance; its energy is NaN if the roller failed."""
    status, record = integrate(history, tolerance, history.marks)
    energy = float(record.energy.sum()) if status == COMPLETED else float("nan")
    return Reference(energy, record.trace[:, 0], record.trace[:, 1])
