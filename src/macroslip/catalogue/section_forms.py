"""Forms of whole sections: variants, mappings, words in a section's place; and which keys a section has."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Iterator, Mapping
from typing import Annotated, Any, get_args, get_origin

import pydantic
from pydantic import TypeAdapter, ValidationError
from pydantic.fields import FieldInfo
from pydantic_core import PydanticCustomError, core_schema

from macroslip.catalogue.forms import Choice, Form
from macroslip.catalogue.problems import shown
from macroslip.errors import InputError
from macroslip.files import check_no_zero_byte

#: What each section is, for messages.
ABOUT: dict[type, str] = {}


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
                checked = adapter(self.item).validate_python(item, context=info.context)
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
        """The section of that name; in Python, an instance of one of them."""
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
    """Yield an annotation and all that it is made of, such as the section of `dict[str, Section | None]`."""
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


def word_of(field: FieldInfo) -> str:
    """The word that switches a section off; empty if there is none."""
    return next((item.word for item in field.metadata if isinstance(item, OrWord)), "")


@functools.cache
def adapter(kind: Any) -> TypeAdapter:
    """What pydantic reads a section or a value with, made once."""
    return TypeAdapter(kind)


def json_schema(kind: Any) -> dict[str, Any]:
    """JSON Schema (2020-12) of a section class, without references, titles and defaults."""
    schema = adapter(kind).json_schema()
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
