# shim
from macroslip.input.fields import Quantity as Quantity
from macroslip.input.fields import Vector as Vector
