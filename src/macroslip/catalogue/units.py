# shim
from macroslip.input.units import ANGLE as ANGLE
from macroslip.input.units import CONDUCTANCE as CONDUCTANCE
from macroslip.input.units import Dimension as Dimension
from macroslip.input.units import FORCE as FORCE
from macroslip.input.units import INVERSE_PRESSURE as INVERSE_PRESSURE
from macroslip.input.units import INVERSE_SPEED as INVERSE_SPEED
from macroslip.input.units import KINEMATIC_VISCOSITY as KINEMATIC_VISCOSITY
from macroslip.input.units import LENGTH as LENGTH
from macroslip.input.units import MASS as MASS
from macroslip.input.units import MOMENT as MOMENT
from macroslip.input.units import NUMBER as NUMBER
from macroslip.input.units import SPEED as SPEED
from macroslip.input.units import TEMPERATURE as TEMPERATURE
from macroslip.input.units import TIME as TIME
from macroslip.input.units import with_unit as with_unit
