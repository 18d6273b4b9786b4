"""Kinds of bearings: what cases, results, pages and commands ask of one, in a module of the kind."""

from __future__ import annotations

from typing import TYPE_CHECKING

from macroslip.kinds.cylindrical import Cylindrical
from macroslip.kinds.kind import Kind
from macroslip.kinds.spherical import Spherical
from macroslip.kinds.tapered import Tapered

if TYPE_CHECKING:
    from macroslip.bearing.kinds import AnyBearing

#: All kinds by the name that `Bearing.kind` gives.
KINDS: dict[str, Kind] = {kind.name: kind for kind in (Spherical(), Cylindrical(), Tapered())}


def kind_of(bearing: AnyBearing) -> Kind:
    """The kind of a bearing.

    Examples
    --------
    >>> from macroslip import Bearing
    >>> kind_of(Bearing.read("skf-240-600-bc")).aligns_itself
    True
    """
    return KINDS[bearing.kind]
