"""Whether the contacts of a case are evaluated by their laws or looked up in tables."""

from __future__ import annotations

from typing import Any

import numpy as np

from macroslip.case.case import Case
from macroslip.case.parts import Radau
from macroslip.ring.orbit import Motion
from macroslip.roller.model import RollerModel
from macroslip.roller.table_box import table_box
from macroslip.roller.tables import needs_tables, tabulated

#: Length of a history [s] from which on tables are made: making them takes as long as the laws of 56 rollers over 30 s, or of
#: two over 500 s. It asks nothing of the rollers chosen, so that a roller's result does not depend on the others.
SHORTEST_TABULATED = 120.0
#: Tolerance of the integrator from which on tables are precise enough: their jumps between cells, and between splines and
#: laws, are below the force that may stay unbalanced.
LEAST_TABULATED_TOLERANCE = 2e-5


def evaluated_models(
    case: Case, models: dict[str, RollerModel], motion: Motion, largest: float, threads: int = 1
) -> tuple[dict[str, RollerModel], dict[str, Any]]:
    """The rollers of both rows as they are integrated, by their laws or by tables, and what a result tells of it.

    Parameters
    ----------
    case : Case
    models : dict of RollerModel
        By row.
    motion : Motion
    largest : float
        Largest elastic load of a roller [N].
    threads : int
        That may be used to make tables.

    Returns
    -------
    dict of RollerModel, dict
        Rollers by row, and the attributes `contact_evaluation` and, of tables, `table_error_typical`,
        `table_error_worst`, `table_share`, `table_size` and `table_build_time`.
    """
    model, laws = models["downwind"], "contact_evaluation"
    if not needs_tables(model):
        return models, {laws: "laws: they need no table"}
    integrator = case.integrator
    if not isinstance(integrator, Radau):
        return models, {laws: "laws, as asked for"}
    if integrator.tolerance < LEAST_TABULATED_TOLERANCE:
        return models, {laws: f"laws: the tolerance is below {LEAST_TABULATED_TOLERANCE:g}"}
    if motion.time[-1] - motion.time[0] < SHORTEST_TABULATED:
        return models, {laws: f"laws: the history is shorter than {SHORTEST_TABULATED:g} s"}
    speeds = motion.shaft_speed * model.orbit_ratio * model.outer_radius
    turning = float(np.max(np.abs(motion.shaft_speed))) * model.orbit_ratio
    body = abs(model.weight_in_plane) + abs(model.weight_along_axis) + model.centrifugal * turning**2
    box = table_box(speeds, largest, body)
    if box is None:
        return models, {laws: "laws: the shaft stands still"}
    found, report = tabulated(models, box, threads)
    return found, {
        laws: "tables",
        "table_error_typical": report.typical_error,
        "table_error_worst": report.worst_error,
        "table_share": report.known,
        "table_size": report.size,
        "table_build_time": report.build_time,
    }
