"""Dimension, range and meaning of the fields of a record's class."""

from __future__ import annotations

import operator
from functools import cache
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from macroslip.catalogue.quantity import quantity_pattern
from macroslip.catalogue.units import NUMBER, Dimension

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pydantic import BaseModel
    from pydantic.fields import FieldInfo


@cache
def dimensions(record: type[BaseModel]) -> Mapping[str, Dimension]:
    """Dimensions of the quantities of a record class, by key; fields of plain text have none."""
    found = {
        key: next((item for item in field.metadata if isinstance(item, Dimension)), None)
        for key, field in record.model_fields.items()
    }
    return MappingProxyType({key: dimension for key, dimension in found.items() if dimension})


def allowed_text(field: FieldInfo, dimension: Dimension | None, unit: str = "") -> str:
    """Describe what a field accepts, in one of its units (SI by default).

    Parameters
    ----------
    field : FieldInfo
        The field, whose bounds are in SI.
    dimension : Dimension | None
        Its dimension; None for text.
    unit : str
        Unit in which to write the bounds.

    Returns
    -------
    str
        For example "a number above 0 mm and at most 1000 mm".
    """
    if dimension is None:
        return "non-empty text" if field.is_required() else "text"
    unit = unit or dimension.si_unit
    bounds = [
        f"{words} {dimension.text(getattr(item, name), unit)}"
        for name, words in (("gt", "above"), ("ge", "at least"), ("lt", "below"), ("le", "at most"))
        for item in field.metadata
        if hasattr(item, name)
    ]
    return f"a {'whole ' if field.annotation is int else ''}number {' and '.join(bounds)}"


def is_allowed(field: FieldInfo, si_value: float) -> bool:
    """Whether a value is within the bounds of a field.

    Parameters
    ----------
    field : FieldInfo
        The field, whose bounds are in SI.
    si_value : float
        The value [SI].
    """
    tests = {"gt": operator.gt, "ge": operator.ge, "lt": operator.lt, "le": operator.le}
    return all(
        test(si_value, getattr(item, name))
        for name, test in tests.items()
        for item in field.metadata
        if hasattr(item, name)
    )


def schema(
    record: type[BaseModel], title: str, tags: Mapping[str, str], derivable: frozenset[str] = frozenset()
) -> dict[str, Any]:
    """Build the JSON Schema (2020-12) of the file format of a record class.

    Parameters
    ----------
    record : type[BaseModel]
        The record class.
    title : str
        Title of the schema.
    tags : Mapping[str, str]
        Provenance tags and their meaning.
    derivable : frozenset of str
        Quantities that may follow from others.

    Returns
    -------
    dict
        The schema, ready for `json.dump`.
    """
    properties: dict[str, Any] = {}
    for key, field in record.model_fields.items():
        dimension = dimensions(record).get(key)
        if dimension is None:
            properties[key] = {"type": "string", "description": field.description}
            if field.is_required():
                properties[key]["minLength"] = 1
            continue
        entry = {
            "type": "object",
            "properties": {
                "value": {"type": "integer" if field.annotation is int else "number"},
                "unit": {"enum": list(dimension.units)},
                "tag": {
                    "enum": list(tags),
                    "default": "U",
                    "description": ", ".join(f"{tag}: {meaning}" for tag, meaning in tags.items()),
                },
                "note": {"type": "string"},
                "range": {
                    "type": "array",
                    "items": {"type": "number"},
                    "minItems": 2,
                    "maxItems": 2,
                    "description": "lowest and highest value; four out of five lie between them",
                },
            },
            "required": ["value", "unit"],
            "additionalProperties": False,
        }
        short = {"type": "string", "pattern": quantity_pattern(dimension)}
        number = [{"type": "integer" if field.annotation is int else "number"}] if dimension is NUMBER else []
        properties[key] = {
            "description": f"{field.description}: {allowed_text(field, dimension)}",
            "anyOf": [entry, short, *number],
        }
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": title,
        "type": "object",
        "properties": properties,
        "required": [key for key, field in record.model_fields.items() if field.is_required() and key not in derivable],
        "additionalProperties": False,
    }
