"""Film thickness, one correlation a file; the names here take plain floats or arrays."""

from macroslip.compiled import elementwise
from macroslip.film import masjedi_khonsari as _masjedi_khonsari
from macroslip.film import masjedi_khonsari_moes as _masjedi_khonsari_moes
from macroslip.film import moes as _moes

#: Modules of the film laws of the package, which register themselves when they are imported.
LAWS = (_masjedi_khonsari, _masjedi_khonsari_moes, _moes)

masjedi_khonsari_thickness = elementwise(_masjedi_khonsari.masjedi_khonsari)
moes_thickness = elementwise(_moes.moes)

__all__ = ["masjedi_khonsari_thickness", "moes_thickness"]
