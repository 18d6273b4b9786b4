"""Sections of an input file as pydantic classes: the same class checks a section of a file and a call in Python.

`@input_section` makes a frozen dataclass whose fields carry a form (`forms` and `quantity_forms` here) or are sections
themselves. To add a key to a file is to add such a field: reader, messages and JSON Schema follow from it.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping
from difflib import get_close_matches
from typing import Annotated, Any, TypeVar, dataclass_transform

import pydantic
from pydantic import ConfigDict, ValidationError
from pydantic.fields import FieldInfo

from macroslip.catalogue.forms import IN_FILE
from macroslip.catalogue.problems import together, unknown_key
from macroslip.catalogue.section_forms import ABOUT, adapter, fields_of, sections_of, word_of
from macroslip.catalogue.section_problems import missing_key, problems_of
from macroslip.catalogue.source import Place, Source
from macroslip.errors import InputError

Kind = TypeVar("Kind")


@dataclass_transform(frozen_default=True, kw_only_default=True)
def input_section(
    noun: str, about: str, *, one_of: tuple[str, ...] = (), positional: bool = False
) -> Callable[[type[Kind]], type[Kind]]:
    """Make a class a section of an input file: a frozen dataclass with checked fields.

    Parameters
    ----------
    noun : str
        Name of the section, for messages about a call in Python.
    about : str
        What the section is, for messages and for the JSON Schema.
    one_of : tuple of str
        Keys of which exactly one has to be given.
    positional : bool
        Whether a call in Python may leave out the names of the first arguments.
    """
    schema = {"description": about} | ({"oneOf": [{"required": [key]} for key in one_of]} if one_of else {})
    config = ConfigDict(extra="forbid", json_schema_extra=schema)

    def decorate(kind: type[Kind]) -> type[Kind]:
        if one_of:
            kind.__post_init__ = lambda self: _check_one_of(self, one_of)
        dataclass = pydantic.dataclasses.dataclass(frozen=True, slots=True, kw_only=not positional, config=config)
        made: Any = dataclass(kind)
        check = made.__init__

        @functools.wraps(check)
        def initialise(self: Any, *first: Any, **values: Any) -> None:
            try:
                check(self, *first, **values)
            except ValidationError as failure:
                raise together(problems_of(failure, made, Place(Source()), noun)) from None

        made.__init__ = initialise
        ABOUT[made] = about
        return made

    return decorate


def _check_one_of(section: Any, keys: tuple[str, ...]) -> None:
    """Refuse a section in which not exactly one of several keys is given."""
    chosen = [key for key in keys if getattr(section, key) is not None]
    if len(chosen) != 1:
        what = f"{' and '.join(chosen)} stand together" if chosen else "none of the keys it needs is there"
        remedy = "Remove or comment out the others." if chosen else "Add one of them."
        raise InputError(what, allowed=f"exactly one of {', '.join(keys)}", remedy=remedy)


def read_value(field: FieldInfo, value: Any, place: Place, context: str = IN_FILE) -> Any:
    """Read what a file has under the key of a field; with the context FORM_ONLY without looking at its range.

    Raises
    ------
    InputError
        With all that is wrong inside, each with its place.
    """
    if value is None and sections_of(field) and not word_of(field):  # every key of the section is commented out
        value = {}
    try:
        kind = Annotated[field.annotation, *field.metadata] if field.metadata else field.annotation
        return adapter(kind).validate_python(value, context=context)
    except ValidationError as failure:
        raise together(problems_of(failure, field, place)) from None


def read_fields(kind: type, data: Mapping[str, Any], place: Place) -> tuple[dict[str, Any], list[InputError]]:
    """Read the keys of a file as far as they are right.

    Parameters
    ----------
    kind : type
        Section class of the whole file.
    data : mapping
        Content of the file.
    place : Place

    Returns
    -------
    dict
        Values of the keys that are there and right.
    list of InputError
        Everything that is wrong.
    """
    fields, found, problems = fields_of(kind), {}, []
    for key in data:
        if key not in fields:
            problems.append(unknown_key(key, fields, where=place.source.where(*place.keys, key), inside=place.key))
    for key, field in fields.items():
        if key in data:
            try:
                found[key] = read_value(field, data[key], place.inside(key))
            except InputError as problem:
                problems += getattr(problem, "parts", [problem])
        elif field.is_required() and not _meant(key, data, fields):
            problems.append(missing_key(key, field, place))
    return found, problems


def _meant(key: str, data: Mapping[str, Any], fields: Mapping[str, Any]) -> bool:
    """Whether an unknown key is a misspelling of this one."""
    return any(key in get_close_matches(str(other), fields, n=1) for other in data if other not in fields)
