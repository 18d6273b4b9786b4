# shim
from macroslip.lubricant.temperature import density_at as density_at
