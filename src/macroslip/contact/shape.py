"""Shape of a roller's contact along the roller's axis, and how it makes slip vary there."""

from __future__ import annotations

import math
from typing import NamedTuple


class ContactShape(NamedTuple):
    """What makes slip differ from station to station, prepared for one interface of one row.

    Attributes
    ----------
    microslip : bool
        Whether slip varies over the contact; if not, the rest but `half_length` is not used.
    contour_radius : float
        Common contour radius R_d = 2 R_roller R_raceway/(R_roller + R_raceway) [m]: a pressed contact follows the middle
        between the two contours.
    roller_radius : float
        r [m].
    half_length : float
        Half the roller's length [m]; the contact ends there.
    curvature_ratio : float
        κ/u2 in pure rolling [1/m]: 1/r + cos α/r~_in at the inner, 1/r − cos α/r~_out at the outer raceway.
    spin_ratio : float
        s/u2 [1/m]: sin α/r~_in or sin α/r~_out, with the row's axial sign.
    """

    microslip: bool
    contour_radius: float
    roller_radius: float
    half_length: float
    curvature_ratio: float
    spin_ratio: float


def common_contour_radius(roller: float, raceway: float) -> float:
    """R_d = 2 R_roller R_raceway/(R_roller + R_raceway) [m].

    Examples
    --------
    >>> round(common_contour_radius(0.406602, 0.4149), 6)
    0.410709
    """
    return 2.0 * roller * raceway / (roller + raceway)


def slipless(half_length: float) -> ContactShape:
    """The shape of a contact over which slip is taken as the same everywhere."""
    return ContactShape(False, math.inf, math.inf, half_length, 0.0, 0.0)
