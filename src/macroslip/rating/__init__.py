"""The usual ratings beside slip.

Static safety, rating lives, pressures, film ratio, minimum load, load spectra.
"""

from macroslip.rating.rate import rate, roller_load_history

__all__ = ["rate", "roller_load_history"]
