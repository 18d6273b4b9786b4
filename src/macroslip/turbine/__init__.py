"""Named turbines: a main bearing with its mount, loads and oil, and what is assumed of each."""

from macroslip.turbine.turbine import Turbine

__all__ = ["Turbine"]
