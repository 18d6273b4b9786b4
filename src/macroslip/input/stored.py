"""Sections as plain data, for the input that a result keeps."""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass, fields, is_dataclass
from typing import Any

from macroslip.input.section import annotations_of, carried


@dataclass(frozen=True)
class Stored:
    """Annotation of a field that the stored input does not always have, or has otherwise."""

    #: From the section and the field's value: true if its key is stored
    when: Callable[[Any, Any], bool] = lambda section, value: True
    #: From the section: what is stored in place of the field's value
    value: Callable[[Any], Any] | None = None


#: Of a key that is stored where it is given.
IF_GIVEN = Stored(when=lambda section, value: value is not None)


def stored(section: Any) -> dict[str, Any]:
    """The fields of a section as numbers, text, lists and mappings, by their names.

    Parameters
    ----------
    section : dataclass
        Fields may carry `Stored` in their annotation.

    Examples
    --------
    >>> from macroslip import Window
    >>> stored(Window(start=1.0))
    {'start': 1.0, 'end': None}
    """
    values = {}
    for name, declared in _declared(type(section)).items():
        value = getattr(section, name)
        if declared.when(section, value):
            values[name] = _plain(value if declared.value is None else declared.value(section))
    return values


@functools.cache
def _declared(kind: type) -> dict[str, Stored]:
    """How each field of a section is stored."""
    annotations = annotations_of(kind)
    return {
        member.name: carried(annotations[member.name], Stored) or Stored()
        for member in fields(kind)
    }


def _plain(value: Any) -> Any:
    """A value of a field as plain data; a record as its file has it."""
    if hasattr(value, "as_dict"):
        return value.as_dict()
    if is_dataclass(value) and not isinstance(value, type):
        return stored(value)
    if isinstance(value, tuple):
        return list(value)
    return value
