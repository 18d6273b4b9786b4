"""Load ratings, equivalent loads and minimum load by the kind of a bearing."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from macroslip.arrays import FloatArray
from macroslip.bearing import Bearing, load_ratings
from macroslip.rating import iso
from macroslip.rating.tapered import equivalent_load, static_equivalent_load, tapered_ratings


class LoadRatings(NamedTuple):
    """Load ratings of a bearing."""

    dynamic: float  #: C [N]
    static: float  #: C0 [N]
    fatigue_limit: float  #: C_u [N]
    minimum: float  #: Least equivalent load P that makers require [N]


class EquivalentLoads(NamedTuple):
    """Equivalent radial loads over a history."""

    dynamic: FloatArray  #: P [N]
    static: FloatArray  #: P0 [N]


_AXIAL_FACTORS = ("axial_factor_e", "axial_factor_y1", "axial_factor_y2", "axial_factor_y0")


def ratings_of(bearing: Bearing) -> LoadRatings:
    """Load ratings of a bearing: the file's, or those that the standards give for its inside.

    A spherical roller bearing needs its C and C0, in which makers differ from the standards'
    formulas by up to 37 %; a cylindrical one without them has ISO 281's C for line contacts and ISO
    76's C0, and a tapered one likewise. C_u follows from C0 (ISO 281, annex B) where it is not given. Raises InputError if a
    spherical roller bearing lacks C, C0 or an axial factor.

    Examples
    --------
    >>> ratings = ratings_of(Bearing.read("skf-240-600-bc"))
    >>> round(ratings.dynamic / 1e3), round(ratings.minimum / 1e3)
    (8502, 163)
    """
    if bearing.kind == "tapered":
        known = tapered_ratings(bearing)
        limit = bearing.fatigue_load_limit
        if limit is None:
            limit = load_ratings.fatigue_load_limit(known.static, 2.0 * bearing.pitch_radius)
        minimum = iso.minimum_load_of_rollers(known.dynamic)
        return LoadRatings(float(known.dynamic), float(known.static), float(limit), minimum)
    if bearing.kind == "spherical":
        bearing.require(
            "dynamic_load_rating", "static_load_rating", *_AXIAL_FACTORS, purpose="the rating"
        )
    dynamic = bearing.dynamic_load_rating
    static = bearing.static_load_rating
    if dynamic is None:
        dynamic = load_ratings.dynamic_load_rating_of(bearing)
    if static is None:
        static = load_ratings.static_load_rating_of(bearing)
    limit = bearing.fatigue_load_limit
    if limit is None:
        limit = load_ratings.fatigue_load_limit(static, 2.0 * bearing.pitch_radius)
    if bearing.kind == "spherical":
        minimum = iso.minimum_load(static)
    else:
        minimum = iso.minimum_load_of_rollers(dynamic)
    return LoadRatings(float(dynamic), float(static), float(limit), minimum)


def equivalent_loads(
    bearing: Bearing, radial_load: ArrayLike, axial_load: ArrayLike
) -> EquivalentLoads:
    """Equivalent radial loads of a bearing under radial and axial loads [N].

    Without contact angle rollers carry no axial load: P = P0 = F_r in a cylindrical roller bearing
    (ISO 281:2007, section 7.2; ISO 76:2006, section 6.2.1). Those of a tapered roller bearing know
    neither moments nor preload.

    Examples
    --------
    >>> loads = equivalent_loads(Bearing.read("skf-240-600-bc"), 300e3, 50e3)
    >>> float(loads.dynamic), float(loads.static)
    (415000.0, 410000.0)
    """
    if bearing.kind == "tapered":
        known = tapered_ratings(bearing)
        return EquivalentLoads(
            equivalent_load(known, radial_load, axial_load),
            static_equivalent_load(known, radial_load, axial_load),
        )
    if bearing.kind == "cylindrical":
        radial = np.asarray(radial_load, dtype=float)
        return EquivalentLoads(radial, radial)
    factors = [float(getattr(bearing, key)) for key in _AXIAL_FACTORS]
    e, y1, y2, y0 = factors
    return EquivalentLoads(
        iso.dynamic_equivalent_load(radial_load, axial_load, e, y1, y2),
        iso.static_equivalent_load(radial_load, axial_load, y0),
    )
