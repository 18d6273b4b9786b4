"""Tolerance and bounds of an integration."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.whole_bearing.tuning import CAGE_REACH, FORCE_SHARE, LONGEST_REST, POWER_SHARE, RINGING, SPEED_SHARE


class BearingLimits(NamedTuple):
    """Tolerance and bounds.

    Attributes
    ----------
    tolerance : float
        Of energies; what a step may do follows from it.
    allowed_speed : float
        Error of speed that a step may make [m/s].
    power : float
        Allowed relative error of power where slopes predict it.
    force : float
        Largest force an iteration may leave unbalanced [N].
    rounding : float
        Rounding of speeds [m/s]; times mass over step it is the force below which no iteration can get.
    longest_step : float
        [s].
    max_steps : int
    rests : bool
        Whether tractions may follow from slopes between evaluations.
    longest_rest : float
        Longest time for which they may [s].
    cage_reach : float
        Relative change of load or slip within which the slopes of a cage's contact serve; what they leave out goes with
        its square.
    interrupt : ndarray of int8, shape (1,)
        Anything but zero ends the integration.
    """

    tolerance: float
    allowed_speed: float
    power: float
    force: float
    rounding: float
    longest_step: float
    max_steps: int
    rests: bool
    longest_rest: float
    cage_reach: float
    interrupt: np.ndarray


def limits_of(tolerance: float, speed_scale: float, longest_step: float, *, dry: bool) -> BearingLimits:
    """Bounds for a relative tolerance and the largest raceway speed of the history [m/s], with dry impacts or without."""
    return BearingLimits(
        tolerance=tolerance,
        allowed_speed=SPEED_SHARE * (RINGING if dry else 1.0) * tolerance * speed_scale,
        power=POWER_SHARE * tolerance,
        force=FORCE_SHARE * tolerance,
        rounding=4.0 * float(np.finfo(float).eps) * speed_scale,
        longest_step=longest_step,
        max_steps=100_000_000,
        rests=True,
        longest_rest=LONGEST_REST,
        cage_reach=min(CAGE_REACH, CAGE_REACH * math.sqrt(tolerance / 2e-4)),
        interrupt=np.zeros(1, dtype=np.int8),
    )
