"""Sections of an input file as pydantic classes: the same class checks a section of a file and a call in Python.

`@input_section` makes a frozen dataclass whose fields carry a form (`macroslip.catalogue.forms`) or are sections
themselves. To add a key to a file is to add such a field: reader, messages and JSON Schema follow from it.
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Iterator, Mapping
from difflib import get_close_matches
from typing import Annotated, Any, TypeVar, dataclass_transform, get_args, get_origin

import pydantic
from pydantic import ConfigDict, TypeAdapter, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import PydanticCustomError, core_schema

from macroslip.catalogue.forms import IN_FILE, Choice, Form
from macroslip.catalogue.problems import shown, together, unknown_key
from macroslip.catalogue.source import Place, Source
from macroslip.errors import InputError
from macroslip.files import check_no_zero_byte

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
                raise together(_problems(failure, made, Place(Source()), noun)) from None

        made.__init__ = initialise
        _ABOUT[made] = about
        return made

    return decorate


_ABOUT: dict[type, str] = {}


def _check_one_of(section: Any, keys: tuple[str, ...]) -> None:
    """Refuse a section in which not exactly one of several keys is given."""
    chosen = [key for key in keys if getattr(section, key) is not None]
    if len(chosen) != 1:
        what = f"{' and '.join(chosen)} stand together" if chosen else "none of the keys it needs is there"
        remedy = "Remove or comment out the others." if chosen else "Add one of them."
        raise InputError(what, allowed=f"exactly one of {', '.join(keys)}", remedy=remedy)


@dataclasses.dataclass(frozen=True)
class OrWord:
    """Annotates a section that a word in the file switches off."""

    word: str

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> core_schema.CoreSchema:
        """None for the word, the section otherwise."""
        (section,) = (kind for kind in get_args(source) if kind is not type(None))
        inner = handler.generate_schema(section)

        def validate(value: Any, check: Any, info: pydantic.ValidationInfo) -> Any:
            return None if value is None or (isinstance(value, str) and value == self.word) else check(value)

        return core_schema.with_info_wrap_validator_function(validate, inner)

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        """The word, or the section."""
        inner = handler(schema)
        about = handler.resolve_ref_schema(inner).get("description", "")
        return {"anyOf": [{"const": self.word}, inner], "description": about}


@dataclasses.dataclass(frozen=True, eq=False)
class MappingOf(Form):
    """A mapping of names of the user's own to values of one kind, each of which is checked with its name.

    Parameters
    ----------
    about : str
        What it is.
    form : str
        What is accepted, in words.
    item : type
        Section or type of a value; Any leaves it to `each`.
    each : callable, optional
        Makes what the program uses of a name and its value, or raises `InputError`.
    """

    form: str = "a section whose keys are names of your own"
    item: Any = Any
    each: Callable[[str, Any], Any] | None = None
    may_be_empty: bool = False

    def read(self, value: Any, info: pydantic.ValidationInfo) -> dict[str, Any]:
        """Read every value; all that is wrong is raised together."""
        names = isinstance(value, Mapping) and all(isinstance(name, str) and name for name in value)
        if not names or not (value or self.may_be_empty):
            raise InputError(f"it is {shown(value)}", allowed=self.form)
        found, problems = {}, []
        for key, item in value.items():
            try:
                check_no_zero_byte(key)
                checked = _adapter(self.item).validate_python(item, context=info.context)
                found[key] = self.each(key, checked) if self.each else checked
            except InputError as problem:
                problems.append(detail_of((key,), problem))
            except ValidationError as failure:
                problems += details_inside(key, failure)
        if problems:
            raise ValidationError.from_exception_data("section", problems)
        return found

    def json(self) -> dict[str, Any]:
        """An object with any keys."""
        inner = {} if self.item is Any else json_schema(self.item)
        return {"type": "object", "additionalProperties": inner or True}


def detail_of(loc: tuple[str | int, ...], problem: InputError) -> Any:
    """A problem as pydantic keeps it, for a form that reads several values by itself."""
    return {"type": PydanticCustomError("form", "{error}", {"error": problem}), "loc": loc, "input": None}


def details_inside(key: str | int, failure: ValidationError) -> list[Any]:
    """What is wrong with one value, with its key in front."""
    found = []
    for detail in failure.errors(include_url=False):
        known: dict[str, Any] = {"ctx": detail.get("ctx")} if detail.get("ctx") else {}
        kind = detail["type"]
        if isinstance(known.get("ctx", {}).get("error"), InputError):
            found.append(detail_of((key, *detail["loc"]), known["ctx"]["error"]))
        else:
            found.append({"type": kind, "loc": (key, *detail["loc"]), "input": detail["input"], **known})
    return found


@dataclasses.dataclass(frozen=True, eq=False)
class Variants:
    """Annotates a union of sections of which a file chooses one by the name under a key."""

    about: str
    key: str
    default: str
    sections: Mapping[str, type]

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> core_schema.CoreSchema:
        """The section that the name asks for; in Python, an instance of one of them."""
        choices = {
            name: core_schema.no_info_before_validator_function(self._without_key, handler.generate_schema(kind))
            for name, kind in self.sections.items()
        }
        return core_schema.tagged_union_schema(choices, self._name)

    def _name(self, value: Any) -> Any:
        if not isinstance(value, Mapping):
            return next((name for name, kind in self.sections.items() if isinstance(value, kind)), self.default)
        name = value.get(self.key, self.default)
        return name if isinstance(name, str) else repr(name)

    def _without_key(self, value: Any) -> Any:
        return {key: item for key, item in value.items() if key != self.key} if isinstance(value, Mapping) else value

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        """One object a name."""
        variants = []
        for name, kind in self.sections.items():
            variant = json_schema(kind)
            variant["properties"] = {self.key: {"const": name}, **variant["properties"]}
            if name != self.default:
                variant["required"] = [self.key, *variant.get("required", [])]
            variants.append(variant)
        return {"oneOf": variants, "description": self.about}


def fields_of(kind: Any) -> Mapping[str, FieldInfo]:
    """Fields of a section class by key; nothing for other classes."""
    return getattr(kind, "__pydantic_fields__", {}) if isinstance(kind, type) else {}


def sections_of(field: FieldInfo) -> list[type]:
    """Section classes that a field may hold: none for a plain value, several for variants."""
    return [kind for kind in _inside(field.annotation) if fields_of(kind)]


def _inside(annotation: Any) -> Iterator[Any]:
    """Yield an annotation and all that it is made of, as the section of `dict[str, Section | None]`."""
    yield annotation
    for part in get_args(annotation):
        yield from _inside(part)


def variants_of(field: FieldInfo) -> Variants | None:
    """The variants among which a file chooses under a field."""
    return next((item for item in field.metadata if isinstance(item, Variants)), None)


def form_of(field: FieldInfo) -> Form | None:
    """The form of a plain value."""
    return next((item for item in field.metadata if isinstance(item, Form)), None)


def keys_of(kind: type, prefix: str = "") -> Iterator[tuple[str, FieldInfo]]:
    """Yield the full name, `loads.hub.force`, and the field of every key of a section and of those inside."""
    for key, field in fields_of(kind).items():
        yield prefix + key, field
        variants = variants_of(field)
        if variants:
            yield f"{prefix}{key}.{variants.key}", _name_field(variants)
        of_the_user = get_origin(field.annotation) is dict  # names inside are the user's own
        for section in () if of_the_user else sections_of(field):
            yield from keys_of(section, f"{prefix}{key}.")


def _name_field(variants: Variants) -> FieldInfo:
    about = f"one of {', '.join(variants.sections)}"
    return FieldInfo.from_annotation(Annotated[str, Choice(about, lambda: list(variants.sections))])


@functools.cache
def _adapter(kind: Any) -> TypeAdapter:
    return TypeAdapter(kind)


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
        return _adapter(kind).validate_python(value, context=context)
    except ValidationError as failure:
        raise together(_problems(failure, field, place)) from None


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
            problems.append(_missing(key, field, place))
    return found, problems


def json_schema(kind: Any) -> dict[str, Any]:
    """JSON Schema (2020-12) of a section class, without references, titles and defaults."""
    schema = _adapter(kind).json_schema()
    definitions = schema.pop("$defs", {})

    def plain(part: Any, names: bool = False) -> Any:
        if isinstance(part, list):
            return [plain(item) for item in part]
        if not isinstance(part, dict):
            return part
        if "$ref" in part and not names:
            return plain(definitions[part["$ref"].rpartition("/")[2]] | {k: v for k, v in part.items() if k != "$ref"})
        some = [item for item in part.get("anyOf", []) if item != {"type": "null"}]
        if len(some) == 1 and not names:  # None in Python is a key left out of the file
            return plain({key: item for key, item in part.items() if key != "anyOf"} | some[0])
        dropped = () if names else ("title", "default")
        return {key: plain(item, key == "properties") for key, item in part.items() if key not in dropped}

    return plain(schema)


def _problems(failure: ValidationError, kind: Any, place: Place, noun: str = "") -> list[InputError]:
    """What pydantic found, in paragraphs: unknown keys first, then the others in the order of the fields."""
    details = failure.errors(include_url=False)
    details.sort(key=lambda detail: detail["type"] != "unexpected_keyword_argument")
    unknown = {
        (*detail["loc"][:-1], close)
        for detail in details
        if detail["type"] == "unexpected_keyword_argument"
        for close in get_close_matches(str(detail["loc"][-1]), _siblings(kind, detail["loc"]), n=1)
    }
    found = []
    for detail in details:
        if detail["type"] != "missing" or detail["loc"] not in unknown:  # a misspelled key is not missing as well
            found.append(_problem(detail, kind, place, noun))
    return found


def _siblings(kind: Any, loc: tuple[Any, ...]) -> list[str]:
    return _walk(kind, loc[:-1])[2]


def _walk(kind: Any, loc: tuple[Any, ...]) -> tuple[list[str], FieldInfo | None, list[str]]:
    """Keys as the file has them, the field at their end if it is one, and the keys that it may have inside."""
    field = kind if isinstance(kind, FieldInfo) else None
    sections = sections_of(field) if field else [kind]
    keys: list[str] = []
    names: list[str] = []
    for step in loc:
        if field and get_origin(field.annotation) is dict:
            keys.append(str(step))
            field = None
            continue
        variants = variants_of(field) if field else None
        if variants and step in variants.sections:
            sections, names = [variants.sections[step]], [variants.key]
            field = None
            continue
        inner = next((fields_of(section)[step] for section in sections if step in fields_of(section)), None)
        keys.append(str(step))
        field, names = inner, []
        sections = sections_of(inner) if inner else []
    return keys, field, [*names, *(key for section in sections for key in fields_of(section))]


def _problem(detail: Mapping[str, Any], kind: Any, place: Place, noun: str) -> InputError:
    """One thing that pydantic found, in one paragraph."""
    loc, problem = detail["loc"], detail.get("ctx", {}).get("error")
    keys, field, inside = _walk(kind, loc)
    here = place.inside(*keys)
    if isinstance(problem, InputError):
        if noun:
            return InputError(problem.what, where=noun, allowed=problem.allowed, remedy=problem.remedy)
        return here.blamed(problem)
    if detail["type"] in ("unexpected_keyword_argument", "extra_forbidden"):
        around = place.inside(*keys[:-1])
        return unknown_key(
            loc[-1], _siblings(kind, loc), where=noun or here.source.where(*here.keys), inside=around.key
        )
    if detail["type"] in ("missing", "missing_keyword_only_argument"):
        key = str(loc[-1])
        section_place = place.inside(*keys[:-1]) if keys and keys[-1] == key else here
        return _missing(key, field, section_place, noun)
    variants = variants_of(field) if detail["type"].startswith("union_tag") and field is not None else None
    if variants is not None:
        name = detail["input"].get(variants.key) if isinstance(detail["input"], Mapping) else detail["input"]
        try:
            Choice(variants.about, lambda: list(variants.sections)).read(name, None)
        except InputError as wrong:
            return here.inside(variants.key).blamed(wrong)
    allowed = _form_text(field, inside)
    what = f"{'it' if not noun or not loc else loc[-1]} is {shown(detail['input'])}"
    return InputError(what, where=noun, allowed=allowed) if noun else here.problem(what, allowed)


def word_of(field: FieldInfo) -> str:
    """The word that switches a section off; empty if there is none."""
    return next((item.word for item in field.metadata if isinstance(item, OrWord)), "")


def _form_text(field: FieldInfo | None, inside: list[str]) -> str:
    form = form_of(field) if field else None
    if form is not None:
        return form.form
    keys = f"a section with the keys {', '.join(inside)}"
    return f"{word_of(field)} or {keys}" if field and word_of(field) else keys


def _missing(key: str, field: FieldInfo | None, place: Place, noun: str = "") -> InputError:
    sections = sections_of(field) if field else []
    form = form_of(field) if field else None
    about = form.about if form else next((_ABOUT[section] for section in sections), "")
    inside = [inner for section in sections for inner in fields_of(section)]
    what = f"'{key}' is missing" + (f" ({about})" if about else "")
    return InputError(what, where=noun or place.where, allowed=_form_text(field, inside), remedy="Add it.")


def _meant(key: str, data: Mapping[str, Any], fields: Mapping[str, Any]) -> bool:
    """Whether an unknown key is a misspelling of this one."""
    return any(key in get_close_matches(str(other), fields, n=1) for other in data if other not in fields)
