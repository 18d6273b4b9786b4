# shim
from macroslip.input.record import TAGS as TAGS
from macroslip.input.units import is_finite_number as is_finite_number
from macroslip.input.record import read_entry as read_entry
