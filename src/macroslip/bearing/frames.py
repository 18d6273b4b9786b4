# shim
from macroslip.bearing.geometry import AXIAL_SIGNS as AXIAL_SIGNS
from macroslip.bearing.geometry import ROWS as ROWS
from macroslip.bearing.geometry import initial_angles as initial_angles
