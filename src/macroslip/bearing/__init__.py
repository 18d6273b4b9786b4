"""The bearing: its data with their provenance, and what follows from them.

That is geometry, kinematics and inertia.
"""

from macroslip.bearing.bearing import Bearing

__all__ = ["Bearing"]
