"""From loads, bearing and cage to the record of a coupled simulation."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from macroslip.errors import InputError
from macroslip.ring.orbit import Motion
from macroslip.whole_bearing.cage import Cage
from macroslip.whole_bearing.integrate import integrate_whole
from macroslip.whole_bearing.limits import limits_of
from macroslip.whole_bearing.model import WholeBearing
from macroslip.whole_bearing.record import BearingRecord, new_record
from macroslip.whole_bearing.space import new_space
from macroslip.whole_bearing.tuning import LEAST_SPEED, LONGEST_STEP


class Times(NamedTuple):
    """When a simulation records, and what; it begins at the first sample of the motion.

    Attributes
    ----------
    edges : ndarray, shape (orbits + 1,)
        Start of the window and ends of its orbits [s].
    outputs : ndarray
        Times of traces and books [s], none after the end.
    end : float
        [s].
    detailed : bool
        Whether it is recorded where on the contacts energy goes, and their extremes.
    """

    edges: np.ndarray
    outputs: np.ndarray
    end: float
    detailed: bool = True


class Start(NamedTuple):
    """State at the first sample other than pure rolling on the bearing's axis.

    Attributes
    ----------
    offset : ndarray, shape (n,)
        Places in the pockets [m].
    slip_inner, slip_outer : ndarray, shape (n,)
        [m/s].
    cage_lead : ndarray, shape (c,)
        w, speed of a cage at the pitch radius beyond that of pure rolling [m/s].
    """

    offset: np.ndarray
    slip_inner: np.ndarray
    slip_outer: np.ndarray
    cage_lead: np.ndarray


def pure_rolling(bearing: WholeBearing, cage: Cage) -> Start:
    """All rollers in pure rolling at their initial offsets, cages with them."""
    count = bearing.rollers.row.size
    offset = cage.start_offsets(count // 2).ravel()
    return Start(offset, np.zeros(count), np.zeros(count), np.zeros(bearing.cages))


def run_whole_bearing(
    bearing: WholeBearing,
    motion: Motion,
    start: Start,
    times: Times,
    *,
    tolerance: float = 2e-4,
    max_steps: int = 100_000_000,
    rests: bool = True,
    interrupt: np.ndarray | None = None,
) -> tuple[int, BearingRecord]:
    """Integrate all rollers and cages.

    Parameters
    ----------
    bearing : WholeBearing
    motion : Motion
        Of the inner ring.
    start : Start
    times : Times
    tolerance : float
        Of energies, see `macroslip.whole_bearing.limits`.
    max_steps : int
    rests : bool
        Whether tractions may follow from their slopes between evaluations; without, every iteration evaluates all.
    interrupt : ndarray of int8, shape (1,), optional
        Read in every step; any value but zero ends the integration.

    Returns
    -------
    status : int
    record : BearingRecord

    Raises
    ------
    InputError
        If a start is not finite.
    """
    for name, values in zip(start._fields, start, strict=True):
        if not np.isfinite(values).all():
            raise InputError("it is not finite", where=f"start, {name}", allowed="finite numbers")
    count = bearing.rollers.row.size
    space = new_space(count, bearing.cages)
    space.state.rollers[:] = np.column_stack([start.slip_inner, start.slip_outer, start.offset])
    space.state.cages[:, 0] = start.cage_lead
    scale = max(
        float(np.abs(motion.shaft_speed).max()) * bearing.bodies[0].orbit_ratio * bearing.outer_radius, LEAST_SPEED
    )
    longest = min(LONGEST_STEP, 0.1 * float(times.end - motion.time[0]))
    limits = limits_of(float(tolerance), scale, longest, dry=bearing.pocket.film == 0.0)
    limits = limits._replace(max_steps=max_steps, rests=rests)
    if interrupt is not None:
        limits = limits._replace(interrupt=interrupt)
    record = new_record(times.edges, times.outputs, count, bearing.cages, detailed=times.detailed)
    stops = np.unique(np.concatenate([times.edges, times.outputs, [times.end]]))
    return integrate_whole(bearing, motion, stops, limits, space, record), record
