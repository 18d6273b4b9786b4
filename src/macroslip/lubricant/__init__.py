"""The lubricant: its data with their provenance, and laws for its viscosity."""

from macroslip.lubricant.lubricant import Lubricant

__all__ = ["Lubricant"]
