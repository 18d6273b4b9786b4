"""Sections of an input file as pydantic classes: the same class checks a section of a file and a call in Python.

`@input_section` makes a frozen dataclass whose fields carry a form of `macroslip.input.fields` or are sections
themselves. To add a key to a file is to add such a field: reader, messages and JSON Schema follow from it.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator, Mapping
from typing import Annotated, Any, TypeVar, dataclass_transform, get_args, get_origin

import pydantic
from pydantic import ConfigDict, ValidationError
from pydantic.fields import FieldInfo

from macroslip.errors import InputError
from macroslip.input.fields import (
    IN_FILE,
    Choice,
    Made,
    OrWord,
    Reading,
    Variants,
    adapter,
    annotation_of,
    form_of,
    word_of,
)
from macroslip.input.files import Place, Source
from macroslip.input.messages import nearest, parts_of, shown, together, unknown_key, unknown_name

Kind = TypeVar("Kind")
_MISSING = ("missing", "missing_keyword_only_argument")
_UNKNOWN = ("unexpected_keyword_argument", "extra_forbidden")


class _About:
    """What there is to know of a section class beside its fields."""

    def __init__(self, about: str, one_of: tuple[str, ...], gone: Mapping[str, str], fields: Mapping[str, FieldInfo]):
        self.about, self.one_of, self.gone, self.fields = about, one_of, gone, fields


_SECTIONS: dict[type, _About] = {}


@dataclass_transform(frozen_default=True, kw_only_default=True)
def input_section(
    noun: str,
    about: str,
    *,
    one_of: tuple[str, ...] = (),
    positional: bool = False,
    gone: Mapping[str, str] | None = None,
    groups: Mapping[str, tuple[str, tuple[str, ...]]] | None = None,
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
    gone : mapping
        Keys that there were, with a sentence on each.
    groups : mapping
        Sections that only files have: by name what the section is, and the fields in it.
    """
    place = Place(Source(), tuple(noun.split(".")) if noun else ())

    def decorate(kind: type[Kind]) -> type[Kind]:
        if one_of:
            kind.__post_init__ = lambda self: _check_one_of(self, one_of)
        config = ConfigDict(extra="forbid", arbitrary_types_allowed=True)
        made: Any = pydantic.dataclasses.dataclass(frozen=True, slots=True, kw_only=not positional, config=config)(kind)
        check = made.__init__

        @functools.wraps(check)
        def initialise(self: Any, *first: Any, **values: Any) -> None:
            try:
                check(self, *first, **values)
            except ValidationError as failure:
                raise together(problems_of(failure, made, place)) from None

        made.__init__ = initialise
        _SECTIONS[made] = _About(about, one_of, gone or {}, _grouped(made.__pydantic_fields__, groups or {}))
        return made

    return decorate


def _check_one_of(section: Any, keys: tuple[str, ...]) -> None:
    """Refuse a section in which not exactly one of several keys is given."""
    chosen = [key for key in keys if getattr(section, key) is not None]
    if len(chosen) != 1:
        what = f"{' and '.join(chosen)} stand together" if chosen else "none of the keys it needs is there"
        remedy = "Remove or comment out the others." if chosen else "Add one of them."
        raise InputError(what, allowed=f"exactly one of {', '.join(keys)}", remedy=remedy)


def _grouped(
    fields: Mapping[str, FieldInfo], groups: Mapping[str, tuple[str, tuple[str, ...]]]
) -> Mapping[str, FieldInfo]:
    """The fields as a file has them: those of a group in a section of their own."""
    found: dict[str, FieldInfo] = {}
    for key, field in fields.items():
        name = next((name for name, (_, keys) in groups.items() if key in keys), key)
        if name == key:
            found[key] = field
        elif name not in found:
            about, keys = groups[name]
            annotations = {one: Annotated[fields[one].annotation, *fields[one].metadata] for one in keys}
            values = {one: fields[one].default for one in keys}
            section = input_section(name, about)(type(name.title(), (), {"__annotations__": annotations, **values}))
            found[name] = FieldInfo.from_annotated_attribute(section, section())
    return found


def fields_of(kind: Any) -> Mapping[str, FieldInfo]:
    """Fields of a section class by key; nothing for other classes."""
    return _SECTIONS[kind].fields if isinstance(kind, type) and kind in _SECTIONS else {}


def sections_of(field: FieldInfo) -> list[type]:
    """Section classes that a field may hold: none for a plain value, several for variants."""
    made = annotation_of(field, Made)
    return [kind for kind in _inside(made.written if made else field.annotation) if fields_of(kind)]


def _inside(annotation: Any) -> Iterator[Any]:
    """Yield an annotation and all that it is made of, such as the section of `dict[str, Section | None]`."""
    yield annotation
    for part in get_args(annotation):
        yield from _inside(part)


def variants_of(field: FieldInfo) -> Variants | None:
    """The variants among which a file chooses under a field."""
    return annotation_of(field, Variants)


def keys_of(kind: type, prefix: str = "") -> Iterator[tuple[str, FieldInfo]]:
    """Yield the full name, `loads.hub.force`, and the field of every key of a section and of those inside."""
    for key, field in fields_of(kind).items():
        yield prefix + key, field
        variants = variants_of(field)
        if variants:
            names = Annotated[str, Choice(variants.about, functools.partial(list, variants.sections))]
            yield f"{prefix}{key}.{variants.key}", FieldInfo.from_annotation(names)
        if get_origin(field.annotation) is not dict:  # there the names inside are the user's own
            for section in sections_of(field):
                yield from keys_of(section, f"{prefix}{key}.")


def read_value(field: FieldInfo, value: Any, place: Place, context: Reading = IN_FILE) -> Any:
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
    fields, found = fields_of(kind), {}
    unknown = [key for key in data if key not in fields]
    problems = [
        unknown_key(key, fields, where=place.source.where(*place.keys, key), inside=place.key) for key in unknown
    ]
    meant = {nearest(key, fields) for key in unknown}  # a misspelled key is not missing as well
    for key, field in fields.items():
        if key in data:
            try:
                found[key] = read_value(field, data[key], place.inside(key))
            except InputError as problem:
                problems += parts_of(problem)
        elif field.is_required() and key not in meant:
            problems.append(_missing_key(key, field, place))
    return found, problems


def problems_of(failure: ValidationError, kind: Any, place: Place) -> list[InputError]:
    """The problems that pydantic found, in paragraphs: unknown keys first, then the others in the order of the fields."""
    details = failure.errors(include_url=False)
    details.sort(key=lambda detail: detail["type"] not in _UNKNOWN)
    meant = {
        (*detail["loc"][:-1], nearest(detail["loc"][-1], _walk(kind, detail["loc"][:-1])[2]))
        for detail in details
        if detail["type"] in _UNKNOWN
    }
    kept = [detail for detail in details if detail["type"] not in _MISSING or detail["loc"] not in meant]
    return [problem for detail in kept for problem in _problems(detail, kind, place)]


def _walk(kind: Any, loc: tuple[Any, ...]) -> tuple[list[str], FieldInfo | None, list[str], dict[str, str]]:
    """Keys as the file has them, the field at their end if it is one, and the keys that it may have, or had, inside."""
    field = kind if isinstance(kind, FieldInfo) else None
    sections = sections_of(field) if field else [kind]
    keys: list[str] = []
    names: list[str] = []
    for step in loc:
        variants = variants_of(field) if field else None
        if variants and step in variants.sections:
            sections, names, field = [variants.sections[step]], [variants.key], None
            continue
        keys.append(str(step))
        if field and get_origin(field.annotation) is dict:
            field = None
            continue
        field = next((fields_of(section)[step] for section in sections if step in fields_of(section)), None)
        sections, names = sections_of(field) if field else [], []
    inside = [*names, *(key for section in sections for key in fields_of(section))]
    return keys, field, inside, {key: why for section in sections for key, why in _SECTIONS[section].gone.items()}


def _problems(detail: Mapping[str, Any], kind: Any, place: Place) -> list[InputError]:
    """One problem that pydantic found, or those of an error that a class raised, in a paragraph each."""
    loc, problem = detail["loc"], detail.get("ctx", {}).get("error")
    keys, field, inside, _ = _walk(kind, loc)
    here = place.inside(*keys)
    if isinstance(problem, InputError):  # a class without a place names the places itself
        return [here.blamed(part) for part in parts_of(problem)] if here.keys else parts_of(problem)
    if detail["type"] in _UNKNOWN:
        (*_, siblings, gone), around = _walk(kind, loc[:-1]), place.inside(*keys[:-1]).key
        where = here.source.where(*here.keys)
        if loc[-1] in gone:
            return [InputError(f"the key '{loc[-1]}' inside {around} is gone", where=where, remedy=gone[loc[-1]])]
        chosen = variants_of(parent) if (parent := _walk(kind, loc[:-2])[1]) else None
        if chosen and loc[-1] == chosen.key:
            return [here.blamed(unknown_name(detail["input"], list(chosen.sections)))]
        return [unknown_key(loc[-1], siblings, where=where, inside=around)]
    if detail["type"] in _MISSING:
        return [_missing_key(str(loc[-1]), field, place.inside(*keys[:-1]) if keys[-1:] == [loc[-1]] else here)]
    variants = variants_of(field) if field else None
    if variants and detail["type"].startswith("union_tag"):
        name = detail["input"].get(variants.key) if isinstance(detail["input"], Mapping) else detail["input"]
        return [here.inside(variants.key).blamed(unknown_name(name, list(variants.sections)))]
    return [here.problem(f"it is {shown(detail['input'])}", _form_text(field, inside))]


def _form_text(field: FieldInfo | None, inside: list[str]) -> str:
    form = form_of(field) if field else None
    if form is not None:
        return form.form
    word = word_of(field) if field else ""
    return f"{f'{word} or ' if word else ''}a section with the keys {', '.join(inside)}"


def _missing_key(key: str, field: FieldInfo | None, place: Place) -> InputError:
    """The error of a key that is needed and not there."""
    sections, form = (sections_of(field), form_of(field)) if field else ([], None)
    about = form.about if form else next((_SECTIONS[section].about for section in sections), "")
    allowed = _form_text(field, [inner for section in sections for inner in fields_of(section)])
    return place.problem(f"'{key}' is missing" + (f" ({about})" if about else ""), allowed, "Add it.")


def json_schema(kind: type) -> dict[str, Any]:
    """JSON Schema (2020-12) of a section class."""
    known = _SECTIONS[kind]
    schema: dict[str, Any] = {
        "type": "object",
        "properties": {key: _field_schema(field) for key, field in known.fields.items()},
        "required": [key for key, field in known.fields.items() if field.is_required()],
        "additionalProperties": False,
        "description": known.about,
    }
    return schema | ({"oneOf": [{"required": [key]} for key in known.one_of]} if known.one_of else {})


def _field_schema(field: FieldInfo) -> dict[str, Any]:
    form, variants, word = form_of(field), variants_of(field), annotation_of(field, OrWord)
    if form:
        return form.json() | {"description": form.about}
    schemas = [json_schema(kind) for kind in (variants.sections.values() if variants else sections_of(field))]
    if variants:
        for name, schema in zip(variants.sections, schemas, strict=True):
            schema["properties"] = {variants.key: {"const": name}, **schema["properties"]}
            schema["required"] += [] if name == variants.default else [variants.key]
        return {"oneOf": schemas, "description": variants.about}
    (schema,) = schemas
    return {"anyOf": [{"const": word.word}, schema], "description": schema["description"]} if word else schema
