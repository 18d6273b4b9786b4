"""Hub loads in, load on the main bearing's inner ring out."""

from macroslip.loads.bearing_loads import BearingLoads
from macroslip.loads.hub_loads import HubLoads, bundled_cases
from macroslip.loads.statics import Drivetrain, main_bearing_load, support_loads

__all__ = ["BearingLoads", "Drivetrain", "HubLoads", "bundled_cases", "main_bearing_load", "support_loads"]
