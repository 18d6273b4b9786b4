"""Sections of an input file as classes: the same class checks a section of a file and a call in Python.

`@input_section` makes a frozen dataclass whose fields carry a form of `macroslip.input.fields` or are sections
themselves. To add a key to a file is to add such a field: reader, messages and JSON Schema follow from it.
"""

from __future__ import annotations

import dataclasses
import functools
import sys
import types
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import (
    Annotated,
    Any,
    NamedTuple,
    TypeVar,
    Union,
    dataclass_transform,
    get_args,
    get_origin,
    get_type_hints,
)

from macroslip.errors import InputError
from macroslip.files import check_no_zero_byte
from macroslip.input.fields import IN_FILE, PYTHON, Choice, Form, Given
from macroslip.input.files import Place, Source
from macroslip.input.messages import nearest, parts_of, together, unknown_key

Kind = TypeVar("Kind")
Fields = Mapping[str, "Field"]


class Field(NamedTuple):
    """A key of a section; where it is optional, None leaves it open in Python."""

    form: Form
    is_required: bool
    is_optional: bool
    default: Any = None
    remedy: str = "Add it."


class _Section(NamedTuple):
    about: str
    fields: Fields
    in_file: Fields
    one_of: tuple[str, ...]
    gone: Mapping[str, str]
    fill: Callable[..., None]


_SECTIONS: dict[type, _Section] = {}


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
        Meaning of the section, for messages and for the JSON Schema.
    one_of : tuple of str
        Keys, exactly one of which has to be given.
    positional : bool
        Whether a call in Python may leave out the names of the first arguments.
    gone : mapping
        Keys that there were, with a sentence on each.
    groups : mapping
        Sections that only files have: by name the meaning of the section, and the fields in it.
    """
    given = dataclasses.replace(
        PYTHON, place=Place(Source(), tuple(noun.split(".")) if noun else ())
    )

    def decorate(kind: type[Kind]) -> type[Kind]:
        made: Any = dataclass(frozen=True, slots=True, kw_only=not positional)(kind)
        fields = _fields(made)
        _SECTIONS[made] = _Section(
            about, fields, grouped(fields, groups or {}), one_of, gone or {}, made.__init__
        )

        @functools.wraps(made.__init__)
        def initialise(self: Any, *first: Any, **values: Any) -> None:
            if len(first) > (len(fields) if positional else 0):
                raise TypeError(f"{made.__name__} takes its values by name")
            _fill(self, dict(zip(fields, first, strict=False)) | values, given)

        made.__init__ = initialise
        return made

    return decorate


def _fields(kind: type) -> Fields:
    hints = get_type_hints(kind, vars(sys.modules[kind.__module__]), include_extras=True)
    return {
        one.name: Field(
            form_from(hints[one.name]),
            one.default is dataclasses.MISSING and one.default_factory is dataclasses.MISSING,
            type(None) in _kinds(hints[one.name]),
            None if one.default is dataclasses.MISSING else one.default,
        )
        for one in dataclasses.fields(kind)
    }


def _kinds(annotation: Any) -> tuple[Any, ...]:
    kind = get_args(annotation)[0] if get_origin(annotation) is Annotated else annotation
    return get_args(kind) if get_origin(kind) in (Union, types.UnionType) else (kind,)


def form_from(annotation: Any) -> Form:
    """The form in an annotation: the form that it carries, or the section that it is."""
    form = next(
        (item for item in getattr(annotation, "__metadata__", ()) if isinstance(item, Form)), None
    )
    if form and not isinstance(form, OrWord):
        return form
    (kind,) = (kind for kind in _kinds(annotation) if kind is not type(None))
    section = Section(_SECTIONS[kind].about, _SECTIONS[kind].in_file, kind)
    return OrWord(form.word, section) if form else section


def grouped(fields: Fields, groups: Mapping[str, tuple[str, tuple[str, ...]]]) -> Fields:
    """The fields as a file has them: those of a group in a section of their own, which is read as a mapping.

    Inside a group its name, if a key begins with it, is left out: `second` in `out_of_round` is `out_of_round_second`.
    """
    found: dict[str, Field] = {}
    for key, one in fields.items():
        name = next((name for name, (_, keys) in groups.items() if key in keys), "")
        if name and name not in found:
            inside = {inner.removeprefix(f"{name}_"): fields[inner] for inner in groups[name][1]}
            found[name] = Field(Group(groups[name][0], inside), False, False)
        elif not name:
            found[key] = one
    return found


def _fill(made: Any, values: Mapping[str, Any], given: Given) -> None:
    known = _SECTIONS[type(made)]
    found, problems = read_keys(
        known.in_file if given.in_file else known.fields, values, given, known.gone
    )
    if problems:
        raise together(problems)
    try:
        chosen = [key for key in known.one_of if found.get(key) is not None]
        if known.one_of and len(chosen) != 1:
            what = (
                f"{' and '.join(chosen)} stand together"
                if chosen
                else "none of the keys it needs is there"
            )
            remedy = "Remove or comment out the others." if chosen else "Add one of them."
            raise InputError(
                what, allowed=f"exactly one of {', '.join(known.one_of)}", remedy=remedy
            )
        known.fill(made, **found)
    except InputError as problem:
        if not given.place.keys:  # a class without a place names the places itself
            raise
        raise together(given.place.blamed(part) for part in parts_of(problem)) from None


def read_keys(
    fields: Fields,
    data: Mapping[str, Any],
    given: Given,
    gone: Mapping[str, str] | None = None,
    more: tuple[str, ...] = (),
) -> tuple[dict[str, Any], list[InputError]]:
    """Read the values under the keys of a section as far as they are right; and everything that is wrong.

    `gone` are keys that there were, with a sentence on each; `more` other keys that the section may have.
    """
    place, gone, found, problems = given.place, gone or {}, {}, []
    unknown = [key for key in data if key not in fields]
    for key in unknown:
        where = place.source.where(*place.keys, key)
        if key in gone:
            problem = InputError(
                f"the key '{key}' inside {place.key} is gone", where=where, remedy=gone[key]
            )
        else:
            problem = unknown_key(key, [*more, *fields], where=where, inside=place.key)
        problem.is_placed = True
        problems.append(problem)
    meant = {nearest(key, fields) for key in unknown}  # a misspelled key is not missing as well
    before = {
        key: one.default for key, one in fields.items() if key not in data and not one.is_required
    }
    for key, one in fields.items():
        if key in data:
            if data[key] is None and one.is_optional and not given.in_file:
                found[key] = None
                continue
            try:
                before[key] = found[key] = read_value(one, data[key], given.inside(key, before))
            except InputError as problem:
                problems += parts_of(problem)
        elif one.is_required and key not in meant:
            what = f"'{key}' is missing ({one.form.about})"
            problems.append(given.place.problem(what, one.form.form, one.remedy))
    return found, problems


def read_value(one: Field, value: Any, given: Given) -> Any:
    """Read the value of a key; all that is wrong inside is raised with its place."""
    try:
        return one.form.read(value, given)
    except InputError as problem:
        raise together(given.place.blamed(part) for part in parts_of(problem)) from None


def read_fields(
    kind: type, data: Mapping[str, Any], place: Place
) -> tuple[dict[str, Any], list[InputError]]:
    """Read a whole file as far as it is right, as `read_keys` does; `kind` is its section class."""
    return read_keys(
        fields_of(kind), data, dataclasses.replace(IN_FILE, place=place), _SECTIONS[kind].gone
    )


@dataclass(frozen=True)
class Group(Form):
    """A section that only files have, read as a mapping."""

    fields: Fields = field(default_factory=dict)

    @property
    def form(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """Accepted values, in words."""
        return f"a section with the keys {', '.join(self.fields)}"

    def read(self, value: Any, given: Given) -> Any:
        """Read every key; none is there if all are commented out."""
        found, problems = read_keys(self.fields, self._keys(value), given)
        if problems:
            raise together(problems)
        return found

    def _keys(self, value: Any) -> Mapping[str, Any]:
        if value is not None and not isinstance(value, Mapping):
            raise self.wrong(value)
        return value or {}

    def json(self) -> dict[str, Any]:
        """An object with the keys."""
        return {
            "type": "object",
            "properties": {
                key: one.form.json() | {"description": one.form.about}
                for key, one in self.fields.items()
            },
            "required": [key for key, one in self.fields.items() if one.is_required],
            "additionalProperties": False,
        }


@dataclass(frozen=True)
class Section(Group):
    """A section of a class; in Python an object of it."""

    kind: type = object

    def read(self, value: Any, given: Given) -> Any:
        """Read every key and make the object."""
        if not given.in_file:
            if not isinstance(value, self.kind):
                raise self.wrong(value, allowed=self.kind.__name__)
            return value
        made = object.__new__(self.kind)
        _fill(made, self._keys(value), given)
        return made

    def json(self) -> dict[str, Any]:
        """An object with the keys, of some exactly one."""
        one_of = _SECTIONS[self.kind].one_of
        return super().json() | (
            {"oneOf": [{"required": [key]} for key in one_of]} if one_of else {}
        )


@dataclass(frozen=True, init=False)
class OrWord(Form):
    """A section that a word in the file switches off."""

    word: str
    section: Form | None

    def __init__(self, word: str, section: Form | None = None):
        super().__init__(section.about if section else "")
        object.__setattr__(self, "word", word)
        object.__setattr__(self, "section", section)

    @property
    def form(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """Accepted values, in words."""
        return f"{self.word} or {self.section.form if self.section else ''}"

    def read(self, value: Any, given: Given) -> Any:
        """None for the word, the section otherwise."""
        if value is None or self.section is None or (isinstance(value, str) and value == self.word):
            return None
        if given.in_file and not isinstance(value, Mapping):
            raise self.wrong(value)
        return self.section.read(value, given)

    def json(self) -> dict[str, Any]:
        """The word, or the section."""
        return {"anyOf": [{"const": self.word}, self.section.json() if self.section else {}]}


@dataclass(frozen=True)
class Variants(Form):
    """One of several sections, which a file chooses by the name under a key.

    Where all names have one class, `presets` are the values that a name gives the keys that the file leaves out.
    """

    key: str = ""
    default: str = ""
    sections: Mapping[str, type] = field(default_factory=dict)
    presets: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)

    @property
    def form(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """Accepted values, in words."""
        keys = fields_of(self.sections[self.default])
        return f"a section with the keys {', '.join([self.key, *keys])}"

    def read(self, value: Any, given: Given) -> Any:
        """The section of that name; in Python, an object of one of them."""
        kinds = dict.fromkeys(self.sections.values())
        if not given.in_file:
            if not isinstance(value, tuple(kinds)):
                raise self.wrong(value, allowed=" or ".join(kind.__name__ for kind in kinds))
            return value
        if value is not None and not isinstance(value, Mapping):
            raise self.wrong(value)
        data = dict(value or {})
        name, problems = data.pop(self.key, self.default), []
        try:
            Choice(self.about, lambda: list(self.sections)).read(name, given)
        except InputError as problem:
            problems.append(given.place.inside(self.key).blamed(problem))
            if len(kinds) > 1:
                raise problems[0] from None
            name = self.default
        kind = self.sections[name]
        data = {**self.presets.get(name, {}), **data}
        found, others = read_keys(fields_of(kind), data, given, _SECTIONS[kind].gone, (self.key,))
        if problems or others:
            raise together(problems + others)
        made = object.__new__(kind)
        _SECTIONS[kind].fill(made, **found)
        return made

    def json(self) -> dict[str, Any]:
        """One object a name."""
        found = []
        for name, kind in self.sections.items():
            schema = form_from(kind).json()
            schema["properties"] = {self.key: {"const": name}, **schema["properties"]}
            schema["required"] += [] if name == self.default else [self.key]
            found.append(schema)
        return {"oneOf": found}


@dataclass(frozen=True, init=False)
class Made(Form):
    """An object of the program in Python; in a file, what a form reads and a builder makes the object of."""

    kinds: tuple[type, ...]
    written: Form

    def __init__(self, kinds: tuple[type, ...], written: Form):
        super().__init__(written.about)
        object.__setattr__(self, "kinds", kinds)
        object.__setattr__(self, "written", written)

    @property
    def form(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """Accepted content of a file, in words."""
        return self.written.form

    def read(self, value: Any, given: Given) -> Any:
        """In a file by the form, in Python by its class."""
        if given.in_file:
            return self.written.read(value, given)
        if not isinstance(value, self.kinds):
            allowed = " or ".join(kind.__name__ for kind in self.kinds)
            raise InputError(f"it is {type(value).__name__}", allowed=allowed)
        return value

    def json(self) -> dict[str, Any]:
        """The schema of the content of a file."""
        return self.written.json()


@dataclass(frozen=True)
class MappingOf(Form):
    """A mapping of names of the user's own to values of one kind, each of which is checked with its name.

    `item` is the annotation of a value, Any leaves it to `each`, which makes what the program uses of name and value.
    """

    form: str = "a section whose keys are names of your own"  # pyright: ignore[reportIncompatibleVariableOverride]
    item: Any = Any
    each: Callable[[str, Any], Any] | None = None
    may_be_empty: bool = False

    def read(self, value: Any, given: Given) -> dict[str, Any]:
        """Read every value; all that is wrong is raised together."""
        names = isinstance(value, Mapping) and all(isinstance(name, str) and name for name in value)
        if not names or not (value or self.may_be_empty):
            raise self.wrong(value)

        def one(key: str, item: Any, given: Given) -> Any:
            check_no_zero_byte(key)
            optional = item is None and type(None) in _kinds(
                self.item
            )  # as a call in Python may leave it open
            checked = (
                item if self.item is Any or optional else form_from(self.item).read(item, given)
            )
            return self.each(key, checked) if self.each else checked

        return dict(zip(value, read_all(value.items(), one, given), strict=True))


def read_all(
    items: Iterable[tuple[str, Any]], read: Callable[[str, Any, Given], Any], given: Given
) -> list[Any]:
    """Read values by their keys; all that is wrong is raised together, each problem with its place."""
    found, problems = [], []
    for key, item in items:
        inner = given.inside(key)
        try:
            found.append(read(key, item, inner))
        except InputError as problem:
            problems += [inner.place.blamed(part) for part in parts_of(problem)]
    if problems:
        raise together(problems)
    return found


def fields_of(kind: type) -> Fields:
    """Keys of a section class in a file."""
    return _SECTIONS[kind].in_file


def form_of(one: Field) -> Form | None:
    """The form of a plain value; None for a section."""
    form = one.form.written if isinstance(one.form, Made) else one.form
    return None if isinstance(form, Group | OrWord | Variants) else form


def word_of(one: Field) -> str:
    """The word that switches a section off; empty if there is none."""
    return one.form.word if isinstance(one.form, OrWord) else ""


def keys_of(kind: type, prefix: str = "") -> Iterator[tuple[str, Field]]:
    """Yield the full name, `loads.hub.force`, and the field of every key of a section and of those inside."""
    yield from _keys_inside(fields_of(kind), prefix)


def _keys_inside(fields: Fields, prefix: str) -> Iterator[tuple[str, Field]]:
    for key, one in fields.items():
        yield prefix + key, one
        form, name = one.form.written if isinstance(one.form, Made) else one.form, f"{prefix}{key}."
        form = form.section if isinstance(form, OrWord) else form
        if isinstance(form, Variants):
            yield (
                name + form.key,
                Field(Choice(form.about, functools.partial(list, form.sections)), False, False),
            )
            for section in dict.fromkeys(form.sections.values()):
                yield from keys_of(section, name)
        elif isinstance(form, Group):
            yield from _keys_inside(form.fields, name)


def json_schema(kind: type) -> dict[str, Any]:
    """JSON Schema (2020-12) of a section class."""
    return form_from(kind).json() | {"description": _SECTIONS[kind].about}
