"""Load ratings, equivalent loads and minimum load by the kind of a bearing."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from macroslip.arrays import FloatArray
from macroslip.bearing import load_ratings
from macroslip.rating import iso
from macroslip.rating.tapered import equivalent_load, static_equivalent_load, tapered_ratings

if TYPE_CHECKING:
    from macroslip.bearing import Bearing
    from macroslip.bearing.kinds import AnyBearing
    from macroslip.bearing.tapered import TaperedBearing


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


class _Rating(ABC):
    """How the standards rate a kind of bearing."""

    #: Keys of the bearing's file without which it is not rated.
    needed: ClassVar[tuple[str, ...]] = ()

    @abstractmethod
    def minimum(self, dynamic: float, static: float) -> float:
        """Least equivalent load that makers require [N], from C and C0 [N]."""

    @abstractmethod
    def equivalent(
        self, bearing: Any, radial_load: ArrayLike, axial_load: ArrayLike
    ) -> EquivalentLoads:
        """Equivalent loads of a bearing of the kind under radial and axial loads [N]."""


class _Spherical(_Rating):
    """Spherical roller bearings, by the axial factors of the maker."""

    axial_factors = ("axial_factor_e", "axial_factor_y1", "axial_factor_y2", "axial_factor_y0")
    needed = ("dynamic_load_rating", "static_load_rating", *axial_factors)

    def minimum(self, dynamic: float, static: float) -> float:
        return iso.minimum_load(static)

    def equivalent(
        self, bearing: Bearing, radial_load: ArrayLike, axial_load: ArrayLike
    ) -> EquivalentLoads:
        e, y1, y2, y0 = [float(getattr(bearing, key)) for key in self.axial_factors]
        return EquivalentLoads(
            iso.dynamic_equivalent_load(radial_load, axial_load, e, y1, y2),
            iso.static_equivalent_load(radial_load, axial_load, y0),
        )


class _Cylindrical(_Rating):
    """Cylindrical roller bearings: without contact angle rollers carry no axial load."""

    def minimum(self, dynamic: float, static: float) -> float:
        return iso.minimum_load_of_rollers(dynamic)

    def equivalent(
        self, bearing: Bearing, radial_load: ArrayLike, axial_load: ArrayLike
    ) -> EquivalentLoads:
        radial = np.asarray(radial_load, dtype=float)
        return EquivalentLoads(radial, radial)


class _Tapered(_Rating):
    """Tapered roller bearings, by the axial factors of the nominal contact angle."""

    def minimum(self, dynamic: float, static: float) -> float:
        return iso.minimum_load_of_rollers(dynamic)

    def equivalent(
        self, bearing: TaperedBearing, radial_load: ArrayLike, axial_load: ArrayLike
    ) -> EquivalentLoads:
        known = tapered_ratings(bearing)
        return EquivalentLoads(
            equivalent_load(known, radial_load, axial_load),
            static_equivalent_load(known, radial_load, axial_load),
        )


#: Ratings by the name of the kind.
_RATINGS: dict[str, _Rating] = {
    "spherical": _Spherical(),
    "cylindrical": _Cylindrical(),
    "tapered": _Tapered(),
}


def ratings_of(bearing: AnyBearing) -> LoadRatings:
    """Load ratings of a bearing: the file's, or those that the standards give for its inside.

    A spherical roller bearing needs its C and C0, in which makers differ from the standards'
    formulas by up to 37 %; a cylindrical or a tapered one without them has ISO 281's C for line
    contacts and ISO 76's C0. C_u follows from C0 (ISO 281, annex B) where it is not given. Raises
    InputError if a spherical roller bearing lacks C, C0 or an axial factor.

    Examples
    --------
    >>> from macroslip import Bearing
    >>> ratings = ratings_of(Bearing.read("skf-240-600-bc"))
    >>> round(ratings.dynamic / 1e3), round(ratings.minimum / 1e3)
    (8502, 163)
    """
    rating = _RATINGS[bearing.kind]
    if rating.needed:
        bearing.require(*rating.needed, purpose="the rating")
    dynamic = bearing.dynamic_load_rating
    if dynamic is None:
        dynamic = load_ratings.dynamic_load_rating_of(bearing)
    static = bearing.static_load_rating
    if static is None:
        static = load_ratings.static_load_rating_of(bearing)
    limit = bearing.fatigue_load_limit
    if limit is None:
        limit = load_ratings.fatigue_load_limit(static, 2.0 * bearing.pitch_radius)
    minimum = rating.minimum(dynamic, static)
    return LoadRatings(float(dynamic), float(static), float(limit), minimum)


def equivalent_loads(
    bearing: AnyBearing, radial_load: ArrayLike, axial_load: ArrayLike
) -> EquivalentLoads:
    """Equivalent radial loads of a bearing under radial and axial loads [N].

    Without contact angle rollers carry no axial load: P = P0 = F_r in a cylindrical roller bearing
    (ISO 281:2007, section 7.2; ISO 76:2006, section 6.2.1). Those of a tapered roller bearing know
    neither moments nor preload.

    Examples
    --------
    >>> from macroslip import Bearing
    >>> loads = equivalent_loads(Bearing.read("skf-240-600-bc"), 300e3, 50e3)
    >>> float(loads.dynamic), float(loads.static)
    (415000.0, 410000.0)
    """
    return _RATINGS[bearing.kind].equivalent(bearing, radial_load, axial_load)
