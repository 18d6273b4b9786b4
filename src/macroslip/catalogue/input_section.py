# shim
from macroslip.input.section import input_section as input_section
from macroslip.input.section import read_fields as read_fields
from macroslip.input.section import read_value as read_value
