# shim
from macroslip.lubricant.temperature import ROELANDS_PRESSURE as ROELANDS_PRESSURE
from macroslip.lubricant.temperature import roelands_index as roelands_index
