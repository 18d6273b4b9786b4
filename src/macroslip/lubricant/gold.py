# shim
from macroslip.lubricant.temperature import gold as gold
