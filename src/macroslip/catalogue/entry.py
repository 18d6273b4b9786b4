"""One entry of a catalogue file: `{value: 70, unit: mm, tag: E, note: "..."}`."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from numbers import Integral, Real
from types import MappingProxyType
from typing import Any

from macroslip.catalogue.problems import shown, unknown_key
from macroslip.catalogue.source import Source
from macroslip.catalogue.units import NUMBER, Dimension
from macroslip.errors import InputError

TAGS: Mapping[str, str] = MappingProxyType(
    {
        "P": "paper",
        "V": "catalogue or public model",
        "D": "derived",
        "R": "literature, from memory",
        "E": "engineering estimate",
        "U": "user",
    }
)
"""Provenance tags and their meaning."""

ENTRY_KEYS = ("value", "unit", "tag", "note")


@dataclass(frozen=True)
class Provenance:
    """Where a value comes from, and how it was written.

    Parameters
    ----------
    value : float
        Number as written [unit].
    unit : str
        Unit as written.
    tag : str
        One of `TAGS`.
    note : str
        Free text.
    """

    value: float
    unit: str
    tag: str = "U"
    note: str = ""


def is_finite_number(value: object) -> bool:
    """Whether a value is a real, finite number; a truth value is none."""
    if isinstance(value, bool) or not isinstance(value, Real):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:  # an integer beyond the largest float
        return False


def read_entry(key: str, entry: Any, dimension: Dimension, source: Source) -> tuple[float, Provenance]:
    """Check the form of one entry and convert its value to SI; its range is checked later.

    Parameters
    ----------
    key : str
        Key under which the entry stands.
    entry : Any
        What stands there: a mapping with value, unit and optionally tag and note.
    dimension : Dimension
        Units the quantity may have.
    source : Source
        Where the entry was written, for messages.

    Returns
    -------
    tuple[float, Provenance]
        Value [SI] and provenance.

    Raises
    ------
    InputError
        If the entry is no such mapping, has an unknown key, or a wrong value, unit, tag or note.
    """
    units = dimension.choices
    form = f"{key}: {{value: a number, unit: {units}, tag: {' or '.join(TAGS)}, note: text}}; tag and note are optional"
    if not isinstance(entry, Mapping):
        raise InputError(
            f"{key} is {shown(entry)}, which does not say its unit",
            where=source.where(key),
            allowed=form,
            remedy="Give the value with its unit.",
        )
    for inner in entry:
        if inner not in ENTRY_KEYS:
            raise unknown_key(inner, ENTRY_KEYS, where=source.where(key, inner), inside=key)
    for inner in ("value", "unit"):
        if inner not in entry:
            raise InputError(f"{key} has no {inner}", where=source.where(key), allowed=form, remedy=f"Add the {inner}.")
    value, unit, tag, note = entry["value"], entry["unit"], entry.get("tag", "U"), entry.get("note", "")
    if not is_finite_number(value):
        raise InputError(
            f"{key} has the value {shown(value)}",
            where=source.where(key, "value"),
            allowed="a finite number, without its unit",
            remedy=f"The unit goes into its own key: {units}.",
        )
    if not isinstance(unit, str) or unit not in dimension.units:
        raise InputError(
            f"{key} has the unit {shown(unit)} (with the value {value})",
            where=source.where(key, "unit"),
            allowed=units,
            remedy="Write it with its quotes." if dimension is NUMBER else "Convert the value to one of these units.",
        )
    if not isinstance(tag, str) or tag not in TAGS:
        raise InputError(
            f"{key} has the tag {shown(tag)}",
            where=source.where(key, "tag"),
            allowed=", ".join(f"{name} ({meaning})" for name, meaning in TAGS.items()),
            remedy="Leave the tag out for a value of your own.",
        )
    if not isinstance(note, str):
        raise InputError(
            f"{key} has the note {shown(note)}",
            where=source.where(key, "note"),
            allowed="text",
            remedy="Put it in quotes.",
        )
    value = int(value) if isinstance(value, Integral) else float(value)
    return dimension.to_si(value, unit), Provenance(value, unit, tag, note)
