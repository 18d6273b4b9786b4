"""Ten-minute means of a turbine: their description, reader, filters and shares over wind and temperature.

The folder imports nothing from `study`: a study weights its runs by what is read here.
"""

from macroslip.scada.bins import histogram
from macroslip.scada.description import ScadaDescription
from macroslip.scada.reader import Scada

__all__ = ["Scada", "ScadaDescription", "histogram"]
