# shim
from macroslip.input.record import dimensions as dimensions
