# shim
from macroslip.lubricant.viscosity import dowson_higginson as dowson_higginson
