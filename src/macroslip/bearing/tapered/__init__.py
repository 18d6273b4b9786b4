"""Tapered roller bearings: their data with provenance, and the geometry that follows from them."""

from macroslip.bearing.tapered.bearing import TaperedBearing
from macroslip.bearing.tapered.geometry import TaperedGeometry, tapered_geometry

__all__ = ["TaperedBearing", "TaperedGeometry", "tapered_geometry"]
