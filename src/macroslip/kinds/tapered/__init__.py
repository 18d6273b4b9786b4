"""Double-row tapered roller bearings, and two single-row ones on one shaft."""

from macroslip.kinds.tapered.kind import Tapered

__all__ = ["Tapered"]
