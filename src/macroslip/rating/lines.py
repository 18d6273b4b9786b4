"""Rating of cylindrical rollers that touch along a line, by strips (ISO/TS 16281)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from macroslip.bearing import Bearing
from macroslip.contact.interface import Interface, interfaces
from macroslip.contact.line import PALMGREN_EXPONENT, line_pressure, strip_places
from macroslip.contact.strips import (
    REFERENCE_LOAD_PER_LENGTH,
    Strips,
    ellipse_load,
    equivalent_ellipse,
    middle_load,
    strip_approach,
    strips_of,
)
from macroslip.lubricant import Lubricant
from macroslip.rating.iso import LAMINAE, ring_ratings
from macroslip.rating.tapered import StripRating, strip_damage

#: Samples whose strips are held together.
_TOGETHER = 500


def loads_of_strips(strips: Strips, load: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    """Loads of equal strips of an aligned roller [N], shape (..., count), which add up to its own.

    Parameters
    ----------
    strips : Strips
    load : ndarray
        Q of rollers [N], not negative.
    count : int
        Number of strips.

    References
    ----------
    ISO/TS 16281:2008, section 5.4.

    Examples
    --------
    >>> line = Strips(0.1, 2e-5, 6e10, 34.8, 230.8e9, 0.031, 0.0)
    >>> loads_of_strips(line, np.array(1e5), 4).round().tolist()
    [20985.0, 29015.0, 29015.0, 20985.0]
    """
    load = np.asarray(load, dtype=float)
    pressed = strip_approach(strips, load)
    stations = strip_places(strips.length, count)
    drop = strips.profile(stations)
    approach = np.maximum(pressed[..., None] - drop, 0.0)
    parts = approach**PALMGREN_EXPONENT
    # Strips that are few carry a little less or more than the line that they stand for.
    total = parts.sum(axis=-1)
    scale = np.zeros(load.shape)
    np.divide(load, total, out=scale, where=total > 0.0)
    return parts * scale[..., None]


def line_rating(
    bearing: Bearing, dynamic_load_rating: float, roller_load: NDArray[np.float64]
) -> StripRating:
    """Damage of both raceways at every sample, and their largest pressure.

    Parameters
    ----------
    bearing : Bearing
        With a `roller_profile`.
    dynamic_load_rating : float
        C [N].
    roller_load : ndarray, shape (1, Z, n)
        Elastic loads of the rollers [N].

    Returns
    -------
    StripRating

    References
    ----------
    ISO/TS 16281:2008, section 6.3.
    """
    gamma = bearing.roller_diameter / (2.0 * bearing.pitch_radius)
    rings = ring_ratings(dynamic_load_rating, 1, bearing.rollers_per_row, 0.0, gamma)
    lines = strips_of(bearing)
    samples = roller_load.shape[-1]
    damage = np.zeros((1, 2, samples))
    for first in range(0, samples, _TOGETHER):
        piece = slice(first, first + _TOGETHER)
        load = roller_load[0, :, piece].T
        strips = loads_of_strips(lines[0], load, LAMINAE)
        damage[0, 0, piece] = strip_damage(strips, rings.inner, stationary=False)
        damage[0, 1, piece] = strip_damage(strips, rings.outer, stationary=True)
    largest = float(roller_load.max())
    pressure = np.zeros((1, 2))
    if largest > 0.0:
        for k, line in enumerate(lines):
            load = middle_load(line, largest)
            pressure[0, k] = line_pressure(load, line.curvature, line.modulus)
    return StripRating(damage, pressure)


def line_interfaces(bearing: Bearing, lubricant: Lubricant) -> tuple[Interface, Interface]:
    """Raceways with ellipses that have the load per length of line contacts, for film laws.

    The load of the ellipse is that of `ellipse_load_for_film`.
    """
    load = REFERENCE_LOAD_PER_LENGTH * bearing.roller_length
    inner, outer = (
        raceway._replace(hertz=equivalent_ellipse(strips, load))
        for raceway, strips in zip(
            interfaces(bearing, lubricant)[:2], strips_of(bearing), strict=True
        )
    )
    return inner, outer


def ellipse_load_for_film(interface: Interface, strips: Strips, load) -> NDArray[np.float64]:
    """Load of the ellipse whose load per length is that of a line's middle strip [N].

    At loads Q > 0 [N] of the roller.
    """
    return ellipse_load(interface.hertz, middle_load(strips, load))
