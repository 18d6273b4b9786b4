"""Catalogue files: every quantity with its value, unit, provenance tag and note, checked once on reading."""

from macroslip.catalogue.entry import TAGS, Provenance
from macroslip.catalogue.record import Record

__all__ = ["TAGS", "Provenance", "Record"]
