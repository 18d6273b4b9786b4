"""Hub loads in, load on the main bearing's inner ring out."""

from macroslip.loads.history import BearingLoads, HubLoads, bundled_cases
from macroslip.loads.statics import Drivetrain, main_bearing_load, support_loads

__all__ = ["BearingLoads", "Drivetrain", "HubLoads", "bundled_cases", "main_bearing_load", "support_loads"]
