"""Sections of an input file as classes, which check a section of a file and a call in Python.

`@input_section` makes a frozen dataclass whose fields carry a form of `macroslip.input.fields` or
are sections themselves. To add a key to a file is to add such a field: reader, messages and JSON
Schema follow from it.
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
from macroslip.input.fields import IN_FILE, PYTHON, Choice, Context, Form
from macroslip.input.files import Location, Source
from macroslip.input.messages import nearest, parts_of, together, unknown_key
from macroslip.storage.files import check_no_zero_byte

Kind = TypeVar("Kind")
Carried = TypeVar("Carried")
Fields = Mapping[str, "Field"]


class Field(NamedTuple):
    """Key of a section."""

    form: Form
    is_required: bool
    is_optional: bool  #: True if None leaves it open in Python
    default: Any = None
    remedy: str = "Add it."  #: Advice where it is missing


class OrWord(NamedTuple):
    """Annotation of a section that a word in the file switches off; it is None then."""

    word: str


class _Declared(NamedTuple):
    """Arguments of `input_section` for a class."""

    about: str
    fields: Fields  #: Keys in Python
    in_file: Fields  #: Keys in a file, those of a group in a section of their own
    one_of: tuple[str, ...]
    fill: Callable[..., None]  #: Initialiser of the dataclass, without checks


_SECTIONS: dict[type, _Declared] = {}


@dataclass_transform(frozen_default=True, kw_only_default=True)
def input_section(
    noun: str,
    about: str,
    *,
    one_of: tuple[str, ...] = (),
    positional: bool = False,
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
        True if a call in Python may leave out the names of the first arguments.
    groups : mapping
        Sections that only files have: by name the meaning of the section, and the fields in it.

    Returns
    -------
    callable
        Decorator of the class.
    """
    keys = tuple(noun.split(".")) if noun else ()
    context = dataclasses.replace(PYTHON, location=Location(Source(), keys))

    def decorate(kind: type[Kind]) -> type[Kind]:
        made: Any = dataclass(frozen=True, slots=True, kw_only=not positional)(kind)
        fields = _fields(made)
        in_file = grouped(fields, groups or {})
        _SECTIONS[made] = _Declared(about, fields, in_file, one_of, made.__init__)

        @functools.wraps(made.__init__)
        def initialise(self: Any, *first: Any, **values: Any) -> None:
            if len(first) > (len(fields) if positional else 0):
                raise TypeError(f"{made.__name__} takes its values by name")
            _fill(self, dict(zip(fields, first, strict=False)) | values, context)

        made.__init__ = initialise
        return made

    return decorate


def _fields(kind: type) -> Fields:
    hints = annotations_of(kind)
    missing = dataclasses.MISSING
    return {
        member.name: Field(
            form_from(hints[member.name]),
            is_required=member.default is missing and member.default_factory is missing,
            is_optional=type(None) in _kinds(hints[member.name]),
            default=None if member.default is missing else member.default,
        )
        for member in dataclasses.fields(kind)
    }


def annotations_of(kind: type) -> dict[str, Any]:
    """Annotations of a class by the names of its fields, with what they carry beside the type."""
    return get_type_hints(kind, vars(sys.modules[kind.__module__]), include_extras=True)


def carried(annotation: Any, item_type: type[Carried]) -> Carried | None:
    """First item of a type that an annotation carries; None without one."""
    metadata = getattr(annotation, "__metadata__", ())
    return next((item for item in metadata if isinstance(item, item_type)), None)


def _kinds(annotation: Any) -> tuple[Any, ...]:
    kind = get_args(annotation)[0] if get_origin(annotation) is Annotated else annotation
    return get_args(kind) if get_origin(kind) in (Union, types.UnionType) else (kind,)


def form_from(annotation: Any) -> Form:
    """Form in an annotation: the form that it carries, or the section that it is."""
    form = carried(annotation, Form)
    if form is not None:
        return form
    off = carried(annotation, OrWord)
    word = "" if off is None else off.word
    (kind,) = (kind for kind in _kinds(annotation) if kind is not type(None))
    declared = _SECTIONS[kind]
    return Section(declared.about, declared.in_file, kind, word)


def grouped(fields: Fields, groups: Mapping[str, tuple[str, tuple[str, ...]]]) -> Fields:
    """Fields as a file has them: those of a group in a section of their own, read as a mapping.

    Inside a group its name, if a key begins with it, is left out: `second` in `out_of_round` is
    `out_of_round_second`.
    """
    result: dict[str, Field] = {}
    for key, member in fields.items():
        name = next((name for name, (_, keys) in groups.items() if key in keys), "")
        if not name:
            result[key] = member
        elif name not in result:
            about, keys = groups[name]
            inside = {inner.removeprefix(f"{name}_"): fields[inner] for inner in keys}
            result[name] = Field(Section(about, inside), is_required=False, is_optional=False)
    return result


def _fill(
    made: Any, values: Mapping[str, Any], context: Context, other_keys: tuple[str, ...] = ()
) -> None:
    """Check the values of a section and give them to the object made of it."""
    declared = _SECTIONS[type(made)]
    fields = declared.in_file if context.in_file else declared.fields
    checked, problems = read_keys(fields, values, context, other_keys)
    if problems:
        raise together(problems)
    try:
        chosen = [key for key in declared.one_of if checked.get(key) is not None]
        if declared.one_of and len(chosen) != 1:
            raise InputError(
                f"{' and '.join(chosen)} stand together"
                if chosen
                else "none of the keys it needs is there",
                allowed=f"exactly one of {', '.join(declared.one_of)}",
                remedy="Remove or comment out the others." if chosen else "Add one of them.",
            )
        declared.fill(made, **checked)
    except InputError as problem:
        if not context.location.keys:  # a class without a location names the locations itself
            raise
        raise together(context.location.blamed(part) for part in parts_of(problem)) from None


def read_keys(
    fields: Fields, data: Mapping[str, Any], context: Context, other_keys: tuple[str, ...] = ()
) -> tuple[dict[str, Any], list[InputError]]:
    """Read the values under the keys of a section as far as they are right.

    Parameters
    ----------
    fields : mapping
        Keys of the section.
    data : mapping
        Its content.
    context : Context
        Location of the section, and how its values are given.
    other_keys : tuple of str
        Keys that the section may have as well, for the message about an unknown one.

    Returns
    -------
    tuple
        Values by key, and everything that is wrong.
    """
    location = context.location
    values: dict[str, Any] = {}
    problems: list[InputError] = []
    unknown = [key for key in data if key not in fields]
    for key in unknown:
        where = location.source.where(*location.keys, key)
        problem = unknown_key(key, [*other_keys, *fields], where=where, inside=location.key)
        problem.is_located = True
        problems.append(problem)
    meant = {nearest(key, fields) for key in unknown}  # a misspelled key is not missing as well
    before = {
        key: member.default
        for key, member in fields.items()
        if key not in data and not member.is_required
    }
    for key, member in fields.items():
        if key in data:
            if data[key] is None and member.is_optional and not context.in_file:
                values[key] = None
                continue
            try:
                values[key] = read_value(member, data[key], context.inside(key, before))
                before[key] = values[key]
            except InputError as problem:
                problems += parts_of(problem)
        elif member.is_required and key not in meant:
            fault = f"'{key}' is missing ({member.form.about})"
            problems.append(location.problem(fault, member.form.form, member.remedy))
    return values, problems


def read_value(member: Field, value: Any, context: Context) -> Any:
    """Read the value of a key; all that is wrong inside is raised with its location."""
    try:
        return member.form.read(value, context)
    except InputError as problem:
        raise together(context.location.blamed(part) for part in parts_of(problem)) from None


def read_fields(
    kind: type, data: Mapping[str, Any], location: Location
) -> tuple[dict[str, Any], list[InputError]]:
    """Read a whole file as far as it is right, as `read_keys` does; `kind` is its section class."""
    return read_keys(fields_of(kind), data, dataclasses.replace(IN_FILE, location=location))


@dataclass(frozen=True)
class Section(Form):
    """Section of keys: an object of a class, or a mapping where it has no class.

    In Python an object of the class stands for it. A word instead of it switches it off.
    """

    fields: Fields = field(default_factory=dict)
    kind: type | None = None
    word: str = ""

    @property
    def form(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """Accepted values, in words."""
        keys = f"a section with the keys {', '.join(self.fields)}"
        return f"{self.word} or {keys}" if self.word else keys

    def read(self, value: Any, context: Context) -> Any:
        """Read every key and make the object, or a mapping; None for the word."""
        is_word = value is None or (isinstance(value, str) and value == self.word)
        if self.word and is_word:
            return None
        if self.kind is not None and not context.in_file:
            if not isinstance(value, self.kind):
                raise self.wrong(value, allowed=self.kind.__name__)
            return value
        if value is not None and not isinstance(value, Mapping):
            raise self.wrong(value)
        content = value or {}  # None: all its keys are commented out
        if self.kind is not None:
            made = object.__new__(self.kind)
            _fill(made, content, context)
            return made
        values, problems = read_keys(self.fields, content, context)
        if problems:
            raise together(problems)
        return values

    def json(self) -> dict[str, Any]:
        """Object with the keys, of some exactly one; or the word."""
        schema: dict[str, Any] = {
            "type": "object",
            "properties": {
                key: member.form.json() | {"description": member.form.about}
                for key, member in self.fields.items()
            },
            "required": [key for key, member in self.fields.items() if member.is_required],
            "additionalProperties": False,
        }
        if self.kind is not None and (one_of := _SECTIONS[self.kind].one_of):
            schema["oneOf"] = [{"required": [key]} for key in one_of]
        return {"anyOf": [{"const": self.word}, schema]} if self.word else schema


@dataclass(frozen=True)
class Variants(Form):
    """One of several sections, which a file chooses by the name under a key.

    Where all names have one class, `presets` are the values that a name gives the keys that the
    file leaves out.
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

    def read(self, value: Any, context: Context) -> Any:
        """Read the section of that name; in Python, an object of one of them."""
        kinds = dict.fromkeys(self.sections.values())
        if not context.in_file:
            if not isinstance(value, tuple(kinds)):
                raise self.wrong(value, allowed=" or ".join(kind.__name__ for kind in kinds))
            return value
        if value is not None and not isinstance(value, Mapping):
            raise self.wrong(value)
        content = dict(value or {})
        name = content.pop(self.key, self.default)
        problems: list[InputError] = []
        try:
            Choice(self.about, lambda: list(self.sections)).read(name, context)
        except InputError as problem:
            problems.append(context.location.inside(self.key).blamed(problem))
            if len(kinds) > 1:
                raise problems[0] from None
            name = self.default
        made = object.__new__(self.sections[name])
        try:
            _fill(made, {**self.presets.get(name, {}), **content}, context, (self.key,))
        except InputError as problem:
            problems += parts_of(problem)
        if problems:
            raise together(problems)
        return made

    def json(self) -> dict[str, Any]:
        """One object a name."""
        schemas = []
        for name, kind in self.sections.items():
            schema = form_from(kind).json()
            schema["properties"] = {self.key: {"const": name}, **schema["properties"]}
            schema["required"] += [] if name == self.default else [self.key]
            schemas.append(schema)
        return {"oneOf": schemas}


@dataclass(frozen=True, init=False)
class Made(Form):
    """Object in Python; in a file, the section or the name it is built from."""

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

    def read(self, value: Any, context: Context) -> Any:
        """Read a file by the form; in Python, check the class."""
        if context.in_file:
            return self.written.read(value, context)
        if not isinstance(value, self.kinds):
            allowed = " or ".join(kind.__name__ for kind in self.kinds)
            raise InputError(f"it is {type(value).__name__}", allowed=allowed)
        return value

    def json(self) -> dict[str, Any]:
        """Schema of the content of a file."""
        return self.written.json()


@dataclass(frozen=True)
class MappingOf(Form):
    """Mapping of names of the user's own to values of one kind, each checked with its name.

    `item` is the annotation of a value, Any leaves it to `each`, which makes what the program uses
    of name and value.
    """

    form: str = "a section whose keys are names of your own"  # pyright: ignore[reportIncompatibleVariableOverride]
    item: Any = Any
    each: Callable[[str, Any], Any] | None = None
    may_be_empty: bool = False

    def read(self, value: Any, context: Context) -> dict[str, Any]:
        """Read every value; all that is wrong is raised together."""
        names = isinstance(value, Mapping) and all(isinstance(name, str) and name for name in value)
        if not names or not (value or self.may_be_empty):
            raise self.wrong(value)
        return dict(zip(value, read_all(value.items(), self._read_item, context), strict=True))

    def _read_item(self, name: str, value: Any, context: Context) -> Any:
        check_no_zero_byte(name)
        # A call in Python may leave an optional value open.
        is_open = value is None and type(None) in _kinds(self.item)
        if self.item is not Any and not is_open:
            value = form_from(self.item).read(value, context)
        return self.each(name, value) if self.each else value


def read_all(
    items: Iterable[tuple[str, Any]], read: Callable[[str, Any, Context], Any], context: Context
) -> list[Any]:
    """Read values by their keys; all that is wrong is raised together, each with its location."""
    values = []
    problems: list[InputError] = []
    for key, item in items:
        inner = context.inside(key)
        try:
            values.append(read(key, item, inner))
        except InputError as problem:
            problems += [inner.location.blamed(part) for part in parts_of(problem)]
    if problems:
        raise together(problems)
    return values


def fields_of(kind: type) -> Fields:
    """Keys of a section class in a file."""
    return _SECTIONS[kind].in_file


def _form_in_file(member: Field) -> Form:
    return member.form.written if isinstance(member.form, Made) else member.form


def form_of(member: Field) -> Form | None:
    """Form of a plain value; None for a section."""
    form = _form_in_file(member)
    return None if isinstance(form, Section | Variants) else form


def word_of(member: Field) -> str:
    """Word that switches a section off; empty if there is none."""
    return member.form.word if isinstance(member.form, Section) else ""


def keys_of(kind: type, prefix: str = "") -> Iterator[tuple[str, Field]]:
    """Yield full name, `loads.hub.force`, and field of every key of a section and those inside."""
    yield from _keys_inside(fields_of(kind), prefix)


def _keys_inside(fields: Fields, prefix: str) -> Iterator[tuple[str, Field]]:
    for key, member in fields.items():
        yield prefix + key, member
        form = _form_in_file(member)
        name = f"{prefix}{key}."
        if isinstance(form, Variants):
            choice = Choice(form.about, functools.partial(list, form.sections))
            yield name + form.key, Field(choice, is_required=False, is_optional=False)
            for section in dict.fromkeys(form.sections.values()):
                yield from keys_of(section, name)
        elif isinstance(form, Section):
            yield from _keys_inside(form.fields, name)


def json_schema(kind: type) -> dict[str, Any]:
    """JSON Schema (2020-12) of a section class."""
    return form_from(kind).json() | {"description": _SECTIONS[kind].about}
