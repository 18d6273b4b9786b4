# shim
from macroslip.lubricant.temperature import eyring_stress as eyring_stress
