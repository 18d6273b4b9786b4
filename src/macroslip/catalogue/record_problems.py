"""What can be wrong with the values of a record, each as an error with its place, what is allowed, and the remedy."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from pydantic import ValidationError

from macroslip.catalogue.entry import Provenance, is_finite_number
from macroslip.catalogue.fields import allowed_text, dimensions, is_allowed
from macroslip.catalogue.problems import shown, unknown_key
from macroslip.catalogue.source import Source
from macroslip.errors import InputError

if TYPE_CHECKING:
    from macroslip.catalogue.record import Record

LONGEST_TEXT = 2000
"""Characters that a name, a title or a note may have."""


def missing_keys(kind: type[Record], keys: Sequence[str], source: Source) -> InputError:
    """Keys without which there is no record of this class."""
    first, dimension = keys[0], dimensions(kind).get(keys[0])
    if dimension is None:
        form = f"{first}: ..." if source.file else f"{first}=..."
    else:
        form = (
            f"{first}: {{value: ..., unit: {dimension.choices}}}"
            if source.file
            else f"{first}=... [{dimension.si_unit}]"
        )
    return InputError(
        f"the {kind.noun} has no {', no '.join(keys)}",
        where=source.file,
        remedy=f"Add what is missing, in the form {form}",
    )


def _unusable_value(
    kind: type[Record], key: str, detail: Mapping[str, Any], provenance: Mapping[str, Provenance], source: Source
) -> InputError:
    """A key that does not exist, or a value that is out of range or of the wrong type; `detail` is pydantic's."""
    if detail["type"] == "extra_forbidden":
        return unknown_key(key, kind.model_fields, where=source.where(key))
    field, dimension = kind.model_fields[key], dimensions(kind).get(key)
    if key in provenance and is_finite_number(provenance[key].value):
        unit, written = provenance[key].unit, provenance[key].written
    else:
        unit, written = "", shown(detail["input"])
    return InputError(
        f"{key} is {written}",
        where=source.where(key, "value"),
        allowed=allowed_text(field, dimension, unit),
        remedy=f"It is the {field.description}" + ("; check value and unit." if dimension else "."),
    )


def unusable_values(
    kind: type[Record], failure: ValidationError, provenance: Mapping[str, Provenance], source: Source
) -> tuple[list[str], list[InputError]]:
    """Keys that pydantic has found missing, and an error for each of the others that it has found wrong."""
    details = {str(detail["loc"][0]): detail for detail in failure.errors(include_url=False)}
    missing = [key for key, detail in details.items() if detail["type"] == "missing"]
    unusable = (item for item in details.items() if item[0] not in missing)
    return missing, [_unusable_value(kind, key, detail, provenance, source) for key, detail in unusable]


def unwritable_texts(record: Record, source: Source) -> Iterator[InputError]:
    """Yield text that results could not hold: a NUL ends it there, half a surrogate pair has no UTF-8."""
    names = type(record).model_fields
    texts = {(key,): getattr(record, key) for key in names if isinstance(getattr(record, key), str)}
    notes = {(key, "note"): origin.note for key, origin in record.provenance.items()}
    for keys, text in (texts | notes).items():
        if len(text) > LONGEST_TEXT or any(unicodedata.category(letter) in ("Cc", "Cs") for letter in text):
            yield InputError(
                f"{' of '.join(reversed(keys))} is {shown(text)}",
                where=source.where(*keys),
                allowed=f"at most {LONGEST_TEXT} characters on one line, without control characters",
                remedy="Write it as one line of plain text.",
            )


def wide_ranges(record: Record, source: Source) -> Iterator[InputError]:
    """Yield ranges of values that go beyond what the quantity may be."""
    for key, origin in record.provenance.items():
        field, dimension = type(record).model_fields[key], dimensions(type(record))[key]
        for limit in origin.range or ():
            if not is_allowed(field, dimension.to_si(limit, origin.unit)):
                yield InputError(
                    f"the range of {key} goes to {shown(limit)}",
                    where=source.where(key, "range"),
                    allowed=allowed_text(field, dimension, origin.unit),
                    remedy="Give a range in which every value is possible.",
                )


def lacking_values(record: Record, keys: Sequence[str], purpose: str) -> InputError:
    """Optional quantities without a value that something needs."""
    kinds, fields = dimensions(type(record)), type(record).model_fields
    return InputError(
        f"it has no {', no '.join(keys)}, which {purpose} needs",
        where=f"{record.noun} {record.name}",
        allowed="; ".join(f"{key}: {allowed_text(fields[key], kinds[key])}" for key in keys),
        remedy="Add to its file: " + ", ".join(f"{key}: {{value: ..., unit: {kinds[key].choices}}}" for key in keys),
    )
