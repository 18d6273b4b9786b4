"""Skew in a case and in its result."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from macroslip.bearing.geometry import AXIAL_SIGNS, ROWS
from macroslip.measures.skew import BY_SECTOR, Skewing
from macroslip.ring.orbit import Motion
from macroslip.roller.skew import raceways, skew_stop
from macroslip.roller.skew_table import guide_of, skew_table
from macroslip.roller.thrust import thrust

if TYPE_CHECKING:
    from macroslip.case.case import Case
    from macroslip.contact.laws import PreparedLaws
    from macroslip.contact.table import Box
    from macroslip.measures.skew import SkewMeasures
    from macroslip.ring.balance import RingGeometry
    from macroslip.roller.model import RollerModel


def skewing(case: Case, laws: PreparedLaws, box: Box) -> dict[str, Skewing]:
    """Skew of the rollers of both rows; empty without skew. `laws` are the downwind row's."""
    if case.laws.skew == "none":
        return {}
    table = skew_table(laws, case.bearing, box)
    cage = case.cage
    stop = skew_stop(case.bearing, cage.guidance, cage.gap, cage.skew_play)
    if cage.alignment == "none":
        stop = stop._replace(effective_radius=0.0)
    skewings = {}
    for row in ROWS:
        sign = AXIAL_SIGNS[row]
        guide = guide_of(stop, sign)
        skewings[row] = Skewing(table, guide, raceways(laws, case.bearing, sign))
    return skewings


def thrust_on_ring(
    case: Case, model: RollerModel, ring: RingGeometry, motion: Motion, box: Box
) -> np.ndarray:
    """Axial force of skewed rollers on the inner ring, as it enters the balance of the ring.

    Parameters
    ----------
    case : Case
    model : RollerModel
        A roller of the downwind row.
    ring : RingGeometry
        Geometry of the inner ring's balance.
    motion : Motion
        Motion of the inner ring, of n samples.
    box : Box
        States that the tables of the contacts hold.

    Returns
    -------
    ndarray, shape (n, 3)
        Force at the samples [N]; 0 after the window.
    """
    down, up = skewing(case, model.laws, box).values()
    count = motion.time.size
    if case.window.end is not None:
        inside = int(np.searchsorted(motion.time, case.window.end))
        count = min(inside + 1, count)
    force = np.zeros((motion.time.size, 3))
    part = Motion(*(samples[:count] for samples in motion))
    guides = (down.guide, up.guide)
    force[:count] = thrust(down.table, guides, ring, model, part)
    return force


def values(
    case: Case, table: list[list[SkewMeasures]], failed: np.ndarray, span: float
) -> dict[str, np.ndarray]:
    """Variables of skew beside its traces.

    Parameters
    ----------
    case : Case
    table : list of list of SkewMeasures
        Measures by row and roller.
    failed : ndarray of bool, shape (rows, rollers)
        Rollers that failed; their values are NaN and left out of means.
    span : float
        Length of the window [s].

    Returns
    -------
    dict
        Arrays by the name of the variable.
    """

    def of_rollers(name: str) -> np.ndarray:
        by_row = [[getattr(roller, name) for roller in row] for row in table]
        gathered = np.array(by_row)
        gathered[failed] = np.nan
        return gathered

    total = np.nansum(of_rollers("by_sector"), axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        means = total[..., 1:] / total[..., :1]
        completed = (~failed).sum(axis=1)
        share = case.bearing.rollers_per_row / completed
    axial_force = 1 + BY_SECTOR.index("axial_force_by_position")
    impulse = total[..., axial_force].sum(axis=1)
    mean_thrust = impulse * share / span * math.cos(case.bearing.contact_angle)
    return {
        "skew_energy": of_rollers("energy"),
        "skew_residual": of_rollers("residual"),
        "stop_energy": of_rollers("stop_energy"),
        "frictional_thrust": np.where(failed.all(axis=1), np.nan, mean_thrust),
        **dict(zip(BY_SECTOR, np.moveaxis(means, -1, 0), strict=True)),
    }
