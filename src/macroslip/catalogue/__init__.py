# shim
from macroslip.input.record import Provenance as Provenance
from macroslip.input.record import Record as Record
from macroslip.input.record import TAGS as TAGS
