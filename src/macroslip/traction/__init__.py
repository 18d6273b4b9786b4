"""Traction, point by point and over the contact patch; the names here take plain floats or arrays."""

from macroslip.compiled import elementwise
from macroslip.traction import crook as _crook
from macroslip.traction import patch_integral as _patch

heating_number = elementwise(_crook.heating_number)
shear_stress = elementwise(_crook.shear_stress)
shear_stress_slope = elementwise(_crook.shear_stress_slope)
crook_patch_integral = elementwise(_patch.patch_integral)

__all__ = ["crook_patch_integral", "heating_number", "shear_stress", "shear_stress_slope"]
