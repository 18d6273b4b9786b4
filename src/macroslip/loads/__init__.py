"""Hub loads in, load on the main bearing's inner ring out."""

from macroslip.loads.bundled import bundled_cases
from macroslip.loads.history import BearingLoads, HubLoads
from macroslip.loads.roller_loads import RollerLoads
from macroslip.loads.statics import Drivetrain, front_moment, main_bearing_load, support_loads

__all__ = [
    "BearingLoads",
    "Drivetrain",
    "HubLoads",
    "RollerLoads",
    "bundled_cases",
    "front_moment",
    "main_bearing_load",
    "support_loads",
]
