"""Checked fields: the form of a value in a file and in Python, declared once as the annotation of a field.

`tilt: Annotated[float, Quantity("shaft tilt", ANGLE, -0.3, 0.3)]`. In a file a quantity is text with its unit; in Python
it is a number in SI units. Range, message and JSON Schema follow from the same declaration, in sections and records.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Annotated, Any, ClassVar, get_args

from pydantic import TypeAdapter, ValidationError, ValidationInfo
from pydantic.fields import FieldInfo
from pydantic_core import PydanticCustomError, core_schema

from macroslip.errors import InputError
from macroslip.files import check_no_zero_byte
from macroslip.input.messages import shown, unknown_name
from macroslip.input.units import (
    ANGLE,
    LENGTH,
    MASS,
    NUMBER,
    TIME,
    Dimension,
    is_finite_number,
    parse_quantity,
    quantity_pattern,
    with_unit,
)

#: Largest whole number of a field.
_MOST = 10**15
_REMINDERS = {
    LENGTH: "Lengths are in metres.",
    ANGLE: "Angles are in radians: math.radians(5.0) for 5 degrees.",
    MASS: "The mass is in kilograms.",
    TIME: "Times are in seconds.",
}


@dataclass(frozen=True)
class Reading:
    """How values are given, the context of a validation.

    Parameters
    ----------
    in_file : bool
        Whether they are written as in a file; otherwise they are numbers in SI units.
    ranges : bool
        Whether their ranges are checked, beside their form.
    written : mapping, optional
        For the fields of a record, which are in SI whatever was written: number with unit, and unit, as written.
    """

    in_file: bool = False
    ranges: bool = True
    written: Mapping[str, tuple[str, str]] | None = None


PYTHON, IN_FILE, FORM_ONLY = Reading(), Reading(in_file=True), Reading(in_file=True, ranges=False)


def in_file(info: ValidationInfo) -> bool:
    """Whether a value comes from a file."""
    return (info.context or PYTHON).in_file


def _subject(info: ValidationInfo) -> str:
    """How messages call the value: those about a section have its key in front."""
    reading = info.context or PYTHON
    return "it" if reading.written is None else info.field_name or "it"


@dataclass(frozen=True)
class Form:
    """What a value has to be; a form reads a value or raises `InputError` without place.

    Parameters
    ----------
    about : str
        What the value is.
    """

    about: str
    form: ClassVar[str] = ""

    def read(self, value: Any, info: ValidationInfo) -> Any:
        """The value as the program uses it."""
        raise NotImplementedError

    def json(self) -> dict[str, Any]:
        """JSON Schema of what a file may have."""
        return {"type": "object"}

    def _wrong(self, value: Any, info: ValidationInfo, remedy: str = "") -> InputError:
        return InputError(f"{_subject(info)} is {shown(value)}", allowed=self.form, remedy=remedy)

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> core_schema.CoreSchema:
        """Validation by `read`; in Python, None is a value that is left open."""
        optional = type(None) in get_args(source)

        def validate(value: Any, info: ValidationInfo) -> Any:
            return None if value is None and optional and not in_file(info) else self.read(value, info)

        return core_schema.with_info_plain_validator_function(validate)


@dataclass(frozen=True)
class Quantity(Form):
    """A number with its unit, within a range; or one of a few words, which read as None.

    Parameters
    ----------
    about : str
        What the value is.
    dimension : Dimension
        Its units; NUMBER: a plain number.
    lowest, highest : float or callable
        Range [SI]; a callable computes an end from the values of the fields before, by their names.
    above, below : bool
        Whether the lowest and the highest value itself are excluded.
    words : tuple of str
        Words that a file may have instead.
    whole : bool
        Whether it is a whole number.
    note, remedy : str
        What to add to the range, and what to do about a value outside.
    """

    dimension: Dimension = NUMBER
    lowest: float = -math.inf
    highest: float | Callable[[Mapping[str, float]], float] = math.inf
    above: bool = False
    below: bool = False
    words: tuple[str, ...] = ()
    whole: bool = False
    note: str = ""
    remedy: str = ""

    @property
    def form(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """What is accepted, in words."""
        if self.dimension is NUMBER:
            return self.range_text() if self.whole else "a number without unit"
        return " or ".join([*self.words, f"a number with its unit, {self.dimension.choices}"])

    def read(self, value: Any, info: ValidationInfo) -> float | None:
        """Read text with a unit, or a number, to SI, and check its range."""
        reading, unit = info.context or PYTHON, self.dimension.si_unit
        if reading.in_file and self.dimension is not NUMBER:
            if isinstance(value, str) and value in self.words:
                return None
            if isinstance(value, bool) or not isinstance(value, str | int | float):
                raise self._wrong(value, info, f"Write 1 {unit}, for example.")
            try:
                number, unit = parse_quantity(value, self.dimension)
            except InputError as problem:
                raise InputError(problem.what, allowed=self.form, remedy=problem.remedy) from None
            si_value, written = self.dimension.to_si(float(number), unit), str(value)
        else:
            si_value = self._number(value, info)
            written, unit = (reading.written or {}).get(info.field_name or "", (f"{si_value!r}", unit))
        if reading.ranges:
            self._check_range(si_value, info, written, unit)
        return si_value

    def _number(self, value: Any, info: ValidationInfo) -> float:
        """A finite number as Python's own, so that NumPy's are welcome."""
        finite = is_finite_number(value)
        if finite and not self.whole:
            return float(value)
        if finite and (hasattr(value, "__index__") or (abs(value) <= _MOST and float(value).is_integer())):
            return int(value)
        quotes = "Write it without quotes and units." if in_file(info) and isinstance(value, str) else ""
        allowed = self.form if self.whole or in_file(info) else "a finite number"
        raise InputError(f"{_subject(info)} is {shown(value)}", allowed=allowed, remedy=quotes)

    def _check_range(self, value: float, info: ValidationInfo, written: str, unit: str) -> None:
        try:
            highest = self.highest(info.data) if callable(self.highest) else self.highest
        except KeyError:  # a value that it depends on is wrong itself
            return
        known = replace(self, highest=highest) if callable(self.highest) else self
        if not known.holds(value):
            check = "" if self.dimension is NUMBER else "; check value and unit"
            reminder = "" if in_file(info) or info.context else _REMINDERS.get(self.dimension, "")
            remedy = f"{self.remedy or f'It is the {self.about}{check}.'} {reminder}".strip()
            raise InputError(f"{_subject(info)} is {written}", allowed=known.range_text(unit), remedy=remedy)

    def holds(self, value: float) -> bool:
        """Whether a value [SI] is in the range, whose ends are numbers."""
        low = self.lowest < value if self.above else self.lowest <= value
        return low and (value < self.highest if self.below else value <= self.highest)  # pyright: ignore[reportOperatorIssue]

    def range_text(self, unit: str = "") -> str:
        """The range in words, in one of the units, SI by default.

        Examples
        --------
        >>> Quantity("tilt", ANGLE, -0.3, 0.3).range_text("deg"), Quantity("step", TIME, 0.0, above=True).range_text("s")
        ('-17.1887 to 17.1887 deg', 'a number above 0 s')
        >>> Quantity("ratio", NUMBER, 0.9, 1.0, above=True, below=True).range_text()
        'above 0.9 and below 1'
        """
        ends, unit = (self.lowest, self.highest), unit or self.dimension.si_unit
        texts = [self.dimension.text(end, unit) if math.isfinite(end) else "" for end in ends]  # pyright: ignore[reportArgumentType]
        low, high = (re.sub(r"e([+-])0*", lambda found: f"e{found[1].strip('+')}", end) for end in texts)
        if not high:
            return f"a number {'above' if self.above else 'from'} {low}"
        low = low.partition(" ")[0]
        if self.below:
            text = f"above {low} and below {high}" if self.above else f"{low} to below {high}"
        else:
            text = f"above {low}, up to {high}" if self.above else f"{low} to {high}"
        return f"{'a whole number, ' if self.whole else ''}{text}{self.note}"

    def json(self) -> dict[str, Any]:
        """Text of the form number and unit, or a word; a plain number where there is no unit."""
        if self.dimension is NUMBER:
            return {"type": "integer" if self.whole else "number"}
        inner = quantity_pattern(self.dimension)[1:-1]
        return {"type": "string", "pattern": f"^({'|'.join([inner, *self.words])})$"}


class Whole(Quantity):
    """A whole number without unit."""

    def __init__(self, about: str, lowest: int = 0, highest: int = _MOST):
        super().__init__(about, NUMBER, lowest, highest, whole=True)


@dataclass(frozen=True)
class Vector(Form):
    """Three quantities in a list."""

    dimension: Dimension = NUMBER

    @property
    def form(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """What is accepted, in words."""
        zero = f"0 {self.dimension.si_unit}"
        return f"a list of three quantities, such as [{zero}, {zero}, {zero}]"

    def read(self, value: Any, info: ValidationInfo) -> list[float | None]:
        """Read three texts to SI."""
        if not isinstance(value, list) or len(value) != 3:
            raise self._wrong(value, info, f"It is the {self.about}.")
        return [Quantity("component", self.dimension).read(item, info) for item in value]

    def json(self) -> dict[str, Any]:
        """A list of three texts."""
        item = Quantity("", self.dimension).json() | {"description": "one component"}
        return {"type": "array", "items": item, "minItems": 3, "maxItems": 3}


@dataclass(frozen=True)
class Flag(Form):
    """True or false; a value that merely counts as true is refused."""

    form: ClassVar[str] = "true or false"

    def read(self, value: Any, info: ValidationInfo) -> bool:
        """Check the type; NumPy's truth values are welcome."""
        if type(value).__name__ not in ("bool", "bool_"):
            raise self._wrong(value, info)
        return bool(value)

    def json(self) -> dict[str, Any]:
        """A truth value."""
        return {"type": "boolean"}


@dataclass(frozen=True)
class Text(Form):
    """Text, which is not empty unless it may be."""

    may_be_empty: bool = False

    @property
    def form(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """What is accepted, in words."""
        return "text" if self.may_be_empty else "non-empty text"

    def read(self, value: Any, info: ValidationInfo) -> str:
        """Check the type."""
        if not isinstance(value, str) or not (value or self.may_be_empty):
            raise self._wrong(value, info)
        check_no_zero_byte(value)
        return value

    def json(self) -> dict[str, Any]:
        """Text."""
        return {"type": "string"} | ({} if self.may_be_empty else {"minLength": 1})


@dataclass(frozen=True)
class Texts(Form):
    """A text, or a list of different texts; a list in any case once it is read."""

    form: ClassVar[str] = "text, or a list of different texts"

    def read(self, value: Any, info: ValidationInfo) -> list[str]:
        """Check every text."""
        texts = value if isinstance(value, list) else [value]
        if not texts or not all(isinstance(text, str) and text for text in texts) or len(set(texts)) != len(texts):
            raise self._wrong(value, info, f"It is the {self.about}.")
        for text in texts:
            check_no_zero_byte(text)
        return texts

    def json(self) -> dict[str, Any]:
        """Text or a list of texts."""
        several = {"type": "array", "items": {"type": "string"}, "minItems": 1, "uniqueItems": True}
        return {"anyOf": [{"type": "string"}, several]}


@dataclass(frozen=True)
class Choice(Form):
    """One of several names, which are looked up only when needed, so that laws are imported only then.

    `more` explains how a name that does not exist can come to exist.
    """

    names: Callable[[], Sequence[str]] = tuple
    more: str = ""

    @property
    def form(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """What is accepted, in words."""
        return ", ".join(self.names())

    def read(self, value: Any, info: ValidationInfo) -> str:
        """Check that the name exists."""
        names = self.names()
        if not isinstance(value, str) or value not in names:
            raise unknown_name(value, names, self.more)
        return value

    def json(self) -> dict[str, Any]:
        """The names."""
        return {"enum": list(self.names())}


@dataclass(frozen=True, eq=False)
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

    form: str = "a section whose keys are names of your own"  # pyright: ignore[reportIncompatibleVariableOverride]
    item: Any = Any
    each: Callable[[str, Any], Any] | None = None
    may_be_empty: bool = False

    def read(self, value: Any, info: ValidationInfo) -> dict[str, Any]:
        """Read every value; all that is wrong is raised together."""
        names = isinstance(value, Mapping) and all(isinstance(name, str) and name for name in value)
        if not names or not (value or self.may_be_empty):
            raise self._wrong(value, info)
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


def detail_of(loc: tuple[str | int, ...], problem: InputError) -> Any:
    """A problem as pydantic keeps it, for a form that reads several values by itself."""
    return {"type": PydanticCustomError("form", "{error}", {"error": problem}), "loc": loc, "input": None}


def details_inside(key: str | int, failure: ValidationError) -> list[Any]:
    """The problems of one value, with its key in front."""
    found = []
    for detail in failure.errors(include_url=False):
        loc, context = (key, *detail["loc"]), detail.get("ctx", {})
        if isinstance(context.get("error"), InputError):
            found.append(detail_of(loc, context["error"]))
        else:
            found.append({"type": detail["type"], "loc": loc, "input": detail["input"], "ctx": context})
    return found


@dataclass(frozen=True)
class OrWord:
    """Annotates a section that a word in the file switches off."""

    word: str

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> core_schema.CoreSchema:
        """None for the word, the section otherwise."""
        (section,) = (kind for kind in get_args(source) if kind is not type(None))

        def validate(value: Any, check: Any, info: ValidationInfo) -> Any:
            return None if value is None or (isinstance(value, str) and value == self.word) else check(value)

        return core_schema.with_info_wrap_validator_function(validate, handler.generate_schema(section))


@dataclass(frozen=True, eq=False)
class Variants:
    """Annotates a union of sections, one of which a file chooses by the name under a key.

    Parameters
    ----------
    about : str
        What it is.
    key, default : str
        The key, and the name that holds without it.
    sections : mapping
        Section class by name.
    presets : mapping
        Values that a name gives the keys that the file leaves out.
    """

    about: str
    key: str
    default: str
    sections: Mapping[str, type]
    presets: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> core_schema.CoreSchema:
        """The section of that name; in Python, an instance of one of them."""
        choices = {
            name: core_schema.no_info_before_validator_function(self._given, handler.generate_schema(kind))
            for name, kind in self.sections.items()
        }
        return core_schema.tagged_union_schema(choices, self._name)

    def _name(self, value: Any) -> Any:
        if not isinstance(value, Mapping):
            return next((name for name, kind in self.sections.items() if isinstance(value, kind)), self.default)
        name = value.get(self.key, self.default)
        name = name if isinstance(name, str) else repr(name)
        return self.default if self.presets and name not in self.sections else name  # then the key itself is wrong

    def _given(self, value: Any) -> Any:
        if not isinstance(value, Mapping):
            return value
        given = {**self.presets.get(self._name(value), {}), **value}
        if isinstance(given.get(self.key), str) and given[self.key] in self.sections:
            del given[self.key]
        return given


@dataclass(frozen=True)
class Made:
    """Annotates an object of the program, which a builder makes from what the file has in its place.

    Parameters
    ----------
    kinds : tuple of type
        Classes of the object.
    written : Form or section class
        What the file has.
    """

    kinds: tuple[type, ...]
    written: Any

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> core_schema.CoreSchema:
        """In a file by the form or the section, in Python by its class."""
        kind = Annotated[Any, self.written] if isinstance(self.written, Form) else self.written

        def validate(value: Any, check: Any, info: ValidationInfo) -> Any:
            if in_file(info):
                return check(value)
            if not isinstance(value, self.kinds):
                allowed = " or ".join(kind.__name__ for kind in self.kinds)
                raise InputError(f"it is {type(value).__name__}", allowed=allowed)
            return value

        return core_schema.with_info_wrap_validator_function(validate, handler.generate_schema(kind))


def annotation_of(field: FieldInfo, kind: type) -> Any:
    """The annotation of a field that is of a kind: its form, its variants, or None."""
    found: Iterator[Any] = (item for item in field.metadata if isinstance(item, kind))
    return next(found, None)


def form_of(field: FieldInfo) -> Form | None:
    """The form of a plain value."""
    made = annotation_of(field, Made)
    written = made.written if made else annotation_of(field, Form)
    return written if isinstance(written, Form) else None


def word_of(field: FieldInfo) -> str:
    """The word that switches a section off; empty if there is none."""
    found = annotation_of(field, OrWord)
    return found.word if found else ""


@cache
def adapter(kind: Any) -> TypeAdapter:
    """The reader of a section or a value, made once."""
    return TypeAdapter(kind)
