"""The bearing: its data with their provenance, and the geometry, kinematics and inertia that follow from them."""

from macroslip.bearing.bearing import Bearing

__all__ = ["Bearing"]
