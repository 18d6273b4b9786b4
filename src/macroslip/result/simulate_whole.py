"""A coupled simulation of the whole bearing, whose kernel can be interrupted."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.bearing.geometry import ROWS
from macroslip.result.whole_dataset import whole_dataset
from macroslip.roller.contact_force import CurvedContact
from macroslip.whole_bearing.model import RowModels, whole_bearing, with_rollers
from macroslip.whole_bearing.run import Times, pure_rolling, run_whole_bearing

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.case.case import Case
    from macroslip.ring.orbit import Motion
    from macroslip.roller.model import RollerModel


def simulate_whole_bearing(
    case: Case,
    models: dict[str, RollerModel],
    motion: Motion,
    times: Times,
    evaluated: Callable,
    notes: dict[str, Any],
    drag_power: float,
    progress: Callable[[int, int], None] | None,
) -> xr.Dataset:
    """Compute orbit and spin of all rollers, and the cages.

    Parameters
    ----------
    case : Case
    models : dict of RollerModel
        Of both rows.
    motion : Motion
        Of the inner ring.
    times : Times
        With those of traces as outputs, if there are any.
    evaluated : callable
        From rollers by row to those that are integrated, for example by tables, and the result's attributes on that.
    notes : dict
        Attributes of the result on its accuracy, by name.
    drag_power : float
        Mean power of the lubricant's drag on all rollers of both rows in the window [W].
    progress : callable or None
        Called twice a second as progress(0, rollers), since all rollers are done together. What it raises ends the
        simulation.

    Returns
    -------
    xarray.Dataset
        As `macroslip.result.dataset.to_dataset`, with the variables of the cage.
    """
    bearing = whole_bearing(
        case.bearing, case.oil, case.cage, tilt=case.drivetrain.tilt, gravity=case.gravity, drag=case.drag,
        laws=case.laws,
    )  # fmt: skip
    curved = isinstance(bearing.models[0].inner, CurvedContact)
    # The oil of these pockets is as wide as their play.
    models, evaluation = evaluated({row: one._replace(films=bearing.films) for row, one in models.items()})
    bearing, notes = with_rollers(bearing, RowModels(**models)), {**notes, **evaluation}
    if case.traces is None:
        times = times._replace(outputs=np.unique(np.concatenate([motion.time[:1], times.edges, [times.end]])))
    start, interrupt = pure_rolling(bearing, case.cage), np.zeros(1, dtype=np.int8)
    # The kernel runs in a thread of its own, so that an interrupt arrives here. It is compiled here, by a run without a
    # step: an interrupt could not end that in the thread, and it takes minutes.
    run_whole_bearing(bearing, motion, start, times._replace(outputs=times.outputs[:1]), max_steps=0)
    with ThreadPoolExecutor(1) as pool:
        future = pool.submit(
            run_whole_bearing, bearing, motion, start, times,
            tolerance=case.integrator.tolerance, max_steps=case.integrator.max_steps, interrupt=interrupt,
        )  # fmt: skip
        try:
            # On Windows an interrupt is noticed only when a wait ends.
            while not wait([future], timeout=0.5, return_when=FIRST_COMPLETED).done:
                if progress:
                    progress(0, len(ROWS) * case.bearing.rollers_per_row)
            status, record = future.result()
        except BaseException:
            interrupt[0] = 1
            raise
    return whole_dataset(case, bearing, motion, status, record, notes, curved=curved, drag_power=drag_power)
