"""Film thickness, one correlation a file; the names here take plain floats or arrays."""

from macroslip.compiled import elementwise
from macroslip.film import masjedi_khonsari as _masjedi_khonsari

masjedi_khonsari_thickness = elementwise(_masjedi_khonsari.masjedi_khonsari)

__all__ = ["masjedi_khonsari_thickness"]
