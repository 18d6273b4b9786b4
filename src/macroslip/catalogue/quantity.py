# shim
from macroslip.input.units import NUMBER_PATTERN as NUMBER_PATTERN
from macroslip.input.units import parse_quantity as parse_quantity
