# shim
from macroslip.bearing.geometry import *
from macroslip.bearing.geometry import roller_mass as roller_mass
from macroslip.bearing.geometry import spin_inertia as spin_inertia
