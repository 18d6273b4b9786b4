"""Named turbines: a main bearing with its mount, loads and oil, and the assumptions of each."""

from macroslip.turbine.turbine import Turbine

__all__ = ["Turbine"]
