"""Values of bearings and lubricants without their provenance, to compare records by."""

from __future__ import annotations

from typing import Any

from macroslip.input.record import Record, fields_of


def values_of(record: Record) -> dict[str, Any]:
    """Values [SI] of a record by key, as its class takes them."""
    return {key: getattr(record, key) for key in fields_of(type(record))}
