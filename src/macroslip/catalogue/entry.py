"""One entry of a catalogue file: `{value: 70, unit: mm, tag: E, note: "...", range: [66, 74]}`, or just `70 mm`."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from numbers import Integral, Real
from types import MappingProxyType
from typing import Any

from macroslip.catalogue.problems import shown, unknown_key
from macroslip.catalogue.quantity import parse_quantity
from macroslip.catalogue.source import Source
from macroslip.catalogue.units import NUMBER, Dimension, with_unit
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

ENTRY_KEYS = ("value", "unit", "tag", "note", "range")


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
    range : tuple[float, float] | None
        Values that the quantity may have as well, lowest and highest [unit]: four out of five lie between them. None if
        nothing is known of its scatter.
    """

    value: float
    unit: str
    tag: str = "U"
    note: str = ""
    range: tuple[float, float] | None = None

    def as_entry(self) -> dict[str, Any]:
        """What stands in a catalogue file for a quantity of this origin."""
        entry = {"value": self.value, "unit": self.unit, "tag": self.tag, "note": self.note}
        return entry if self.range is None else entry | {"range": list(self.range)}

    @property
    def written(self) -> str:
        """Value and unit as written."""
        return with_unit(self.value, self.unit)


def is_finite_number(value: object) -> bool:
    """Whether a value is a real, finite number; a truth value is none."""
    if isinstance(value, bool) or not isinstance(value, Real):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:  # an integer beyond the largest float
        return False


def plain_number(value: Any, whole: bool) -> Any:
    """A finite real number as Python's own, so that NumPy scalars are welcome; anything else is left alone."""
    if not is_finite_number(value):
        return value
    number = float(value)
    return int(number) if whole and number.is_integer() else number


def read_entry(key: str, entry: Any, dimension: Dimension, source: Source) -> tuple[float, Provenance]:
    """Check the form of one entry and convert its value to SI; its range is checked later.

    Parameters
    ----------
    key : str
        Key of the entry.
    entry : Any
        Content: text of number and unit, a plain number where the quantity has no unit, or a mapping with
        value, unit and optionally tag, note and range.
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
        If the entry is none of these, has an unknown key, or a wrong value, unit, tag, note or range.
    """
    if isinstance(entry, str):
        value, unit = parse_quantity(entry, dimension, key, source.where(key))
        return dimension.to_si(value, unit), Provenance(value, unit)
    if dimension is NUMBER and is_finite_number(entry):
        value = _plain(entry)
        return dimension.to_si(value, "1"), Provenance(value, "1")
    _check_keys(key, entry, dimension, source)
    value, unit, tag, note = entry["value"], entry["unit"], entry.get("tag", "U"), entry.get("note", "")
    units = dimension.choices
    if not is_finite_number(value):
        raise InputError(
            f"{key} has the value {shown(value)}",
            where=source.where(key, "value"),
            allowed="a finite number, without its unit",
            remedy=f"The unit goes into its own key: {units}.",
        )
    if not isinstance(unit, str) or unit not in dimension.units:
        raise InputError(
            f"{key} has the unit {shown(unit)} (with the value {shown(value)})",
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
    value = _plain(value)
    limits = _read_range(key, entry["range"], value, source) if "range" in entry else None
    return dimension.to_si(value, unit), Provenance(value, unit, tag, note, limits)


def _check_keys(key: str, entry: Any, dimension: Dimension, source: Source) -> None:
    """Refuse what is no mapping with value, unit and known keys."""
    units = dimension.choices
    form = (
        f"{key}: {{value: a number, unit: {units}, tag: {' or '.join(TAGS)}, note: text, range: [lowest, highest]}}; tag, "
        f"note and range are optional. Short form: {key}: {'1' if dimension is NUMBER else f'1 {dimension.si_unit}'}"
    )
    if not isinstance(entry, Mapping):
        raise InputError(
            f"{key} is {shown(entry)}, which does not give its unit"
            if is_finite_number(entry)
            else f"{key} is {shown(entry)}, which is no quantity",
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


def _read_range(key: str, limits: Any, value: float, source: Source) -> tuple[float, float]:
    """Check the range of a value: two numbers in its unit, with the value between them."""
    pair: Any = limits if isinstance(limits, Sequence) and not isinstance(limits, str) and len(limits) == 2 else ()
    if not pair or not all(is_finite_number(limit) for limit in pair) or not pair[0] <= value <= pair[1]:
        raise InputError(
            f"{key} has the range {shown(limits)} (with the value {shown(value)})",
            where=source.where(key, "range"),
            allowed="two numbers in the unit of the value, [lowest, highest], with the value between them",
            remedy="Leave it out if nothing is known of the scatter.",
        )
    return _plain(limits[0]), _plain(limits[1])


def _plain(number: Any) -> float:
    """The number as Python has it, an integer if it is one."""
    return int(number) if isinstance(number, Integral) else float(number)
