"""What each mechanism of the physical model costs: CPU time of one roller over 600 s, mechanism by mechanism."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from benchmarks import own
from benchmarks.histories import histories_of
from benchmarks.scaling import cpu_seconds
from macroslip.contact.mechanisms import Laws

_CASE = "14B"


def ladder() -> dict[str, Laws]:
    """From the paper's model to the physical one, a mechanism or two at a time."""
    whole = Laws.physical()
    film = Laws.paper().but(film=whole.film, starvation=True, inlet_heating=True)
    limited = film.but(viscosity=whole.viscosity, rheology=whole.rheology)
    microslip = limited.but(microslip=True)
    return {
        "paper": Laws.paper(),
        "with film for every load, starvation, inlet heating": film,
        "with Roelands and Eyring's law": limited,
        "with microslip": microslip,
        "with asperities: physical": microslip.but(asperities=whole.asperities),
        "physical, without shear heating": whole.but(heating=False),
        "physical, limiting shear": whole.but(rheology="limiting-shear"),
    }


def mechanism_costs(
    tolerance: float, *, quick: bool, report: Callable[[int, int], None]
) -> dict[str, Any]:
    """CPU time under each step of the ladder, of one roller of either row.

    Parameters
    ----------
    tolerance : float
        Of the integrator.
    quick : bool
        60 s instead of 600 s, and the ends of the ladder only.
    report : callable
        Called as report(done, total).

    Returns
    -------
    dict
        By name: `real_time_factor` and `evaluation_us` of a downwind and an upwind roller, and `force_evaluations`.
    """
    steps = ladder()
    if quick:
        steps = {name: steps[name] for name in ("paper", "with asperities: physical")}
    costs: dict[str, Any] = {}
    for number, (name, laws) in enumerate(steps.items()):
        report(number, len(steps))
        rows = {}
        histories = histories_of(_CASE, None, 70.0 if quick else None, [0], laws)
        for row, history in zip(("downwind", "upwind"), histories, strict=True):
            solution = own.solve(history, tolerance)
            seconds = cpu_seconds([history], tolerance)
            rows[row] = {
                "real_time_factor": (history.end - float(history.motion.time[0])) / seconds,
                "force_evaluations": solution.evaluations,
                "evaluation_us": 1e6 * seconds / solution.evaluations,
            }
        costs[name] = rows
    return costs
