"""Common input of all parts of a rating: the published ratings, and the loads with derived series."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from macroslip.bearing.frames import ROWS
from macroslip.bearing.load_ratings import fatigue_load_limit
from macroslip.errors import InputError
from macroslip.rating.iso281 import dynamic_equivalent_load
from macroslip.rating.spectrum import sample_durations

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from macroslip.bearing import Bearing
    from macroslip.loads import BearingLoads

RACEWAYS = ("inner", "outer")
_HOUR = 3600.0


class Published(NamedTuple):
    """Ratings [N] and factors [-] of a bearing that has them all."""

    dynamic: float
    static: float
    fatigue_limit: float
    e: float
    y1: float
    y2: float
    y0: float


class History(NamedTuple):
    """Loads over n samples.

    Attributes
    ----------
    loads : BearingLoads
    published : Published
    roller_load : ndarray, shape (2, Z, n)
        Q [N].
    duration, revolutions : ndarray, shape (n,)
        Time [s] and turns of the shaft [-] that every sample represents.
    radial, axial, equivalent : ndarray, shape (n,)
        Fr, Fa and P [N].
    """

    loads: BearingLoads
    published: Published
    roller_load: NDArray[np.float64]
    duration: NDArray[np.float64]
    revolutions: NDArray[np.float64]
    radial: NDArray[np.float64]
    axial: NDArray[np.float64]
    equivalent: NDArray[np.float64]

    @property
    def hours_a_revolution(self) -> float:
        """Mean time of a turn of the shaft [h]; NaN for a shaft at rest."""
        turned = self.revolutions.sum()
        return self.duration.sum() / turned / _HOUR if turned > 0.0 else math.nan


def variable(values: object, units: str, long_name: str, *dims: str) -> tuple:
    """A variable of a dataset, with its unit and name."""
    return dims, values, {"units": units, "long_name": long_name}


def published(bearing: Bearing) -> Published:
    """Ratings and factors of a bearing; a fatigue load limit that is not published is that of ISO 281."""
    keys = ("dynamic_load_rating", "static_load_rating", "axial_factor_e", "axial_factor_y1", "axial_factor_y2",
            "axial_factor_y0")  # fmt: skip
    bearing.require(*keys, purpose="the rating")
    dynamic, static, e, y1, y2, y0 = (float(getattr(bearing, key)) for key in keys)
    limit = bearing.fatigue_load_limit
    if limit is None:
        limit = fatigue_load_limit(static, 2.0 * bearing.pitch_radius)
    return Published(dynamic, static, limit, e, y1, y2, y0)


def load_history(bearing: Bearing, loads: BearingLoads, roller_load: NDArray[np.float64]) -> History:
    """Check the loads and prepare what the parts of a rating share.

    Raises
    ------
    InputError
        If the bearing lacks a rating, or the roller loads have another shape or cannot be.
    """
    ratings = published(bearing)
    roller_load = np.asarray(roller_load, float)
    expected = (len(ROWS), bearing.rollers_per_row, loads.time.size)
    if roller_load.shape != expected or not np.all(roller_load >= 0.0) or not np.all(np.isfinite(roller_load)):
        raise InputError(
            f"roller_load has the shape {roller_load.shape}, or loads that are negative or not finite",
            allowed=f"loads from 0 N in the shape {expected}: row, roller, sample",
            remedy="Take them from macroslip.rating.roller_load_history.",
        )
    duration = sample_durations(loads.time)
    radial, axial = np.hypot(loads.force[:, 0], loads.force[:, 1]), loads.force[:, 2]
    return History(
        loads,
        ratings,
        roller_load,
        duration,
        duration * np.abs(loads.shaft_speed) / (2.0 * math.pi),
        radial,
        axial,
        dynamic_equivalent_load(radial, axial, ratings.e, ratings.y1, ratings.y2),
    )
