"""Forms of values: what a key of an input section accepts, in a file and in Python.

A form annotates a field, `tilt: Annotated[float, Quantity("shaft tilt", ANGLE, -0.3, 0.3)]`. In a file a quantity is
text with its unit; in Python it is a number in SI units. The range is checked in the same place for both.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from difflib import get_close_matches
from typing import Any, ClassVar, get_args

from pydantic import ValidationInfo
from pydantic_core import core_schema

from macroslip.catalogue.entry import is_finite_number
from macroslip.catalogue.problems import shown
from macroslip.catalogue.quantity import parse_quantity, quantity_pattern
from macroslip.catalogue.units import ANGLE, LENGTH, MASS, NUMBER, TIME, Dimension
from macroslip.errors import InputError
from macroslip.files import check_no_zero_byte

#: Context of a validation whose values come from a file.
IN_FILE = "file"
#: Context of a validation of a value that others decide on: its form is checked, its range is not.
FORM_ONLY = "form"
_REMINDERS = {
    LENGTH: "Lengths are in metres.",
    ANGLE: "Angles are in radians: math.radians(5.0) for 5 degrees.",
    MASS: "The mass is in kilograms.",
    TIME: "Times are in seconds.",
}


def in_file(info: ValidationInfo) -> bool:
    """Whether a value comes from a file."""
    return info.context in (IN_FILE, FORM_ONLY)


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
        raise NotImplementedError

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> core_schema.CoreSchema:
        """Validation by `read`; in Python, None stands for a value that is left open."""
        optional = type(None) in get_args(source)

        def validate(value: Any, info: ValidationInfo) -> Any:
            return None if value is None and optional and not in_file(info) else self.read(value, info)

        return core_schema.with_info_plain_validator_function(validate)

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        """JSON Schema with what the value is."""
        return self.json() | {"description": self.about}


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
    above : bool
        Whether the lowest value itself is excluded.
    words : tuple of str
        Words that a file may have instead.
    name : str
        How messages about the range call the value: "the step is 3.0 s"; otherwise they quote it as written.
    note, remedy : str
        What to add to the range, and what to do about a value outside.
    """

    dimension: Dimension = NUMBER
    lowest: float = -math.inf
    highest: float | Callable[[Mapping[str, float]], float] = math.inf
    above: bool = False
    words: tuple[str, ...] = ()
    name: str = ""
    note: str = ""
    remedy: str = ""

    @property
    def form(self) -> str:
        """What is accepted, in words."""
        if self.dimension is NUMBER:
            return "a number without unit"
        return " or ".join([*self.words, f"a number with its unit, {self.dimension.choices}"])

    def read(self, value: Any, info: ValidationInfo) -> float | None:
        """Read text with a unit, or a number, to SI, and check its range."""
        if not in_file(info) or self.dimension is NUMBER:
            return self._number(value, info)
        if isinstance(value, str) and value in self.words:
            return None
        if isinstance(value, bool) or not isinstance(value, (str, int, float)):
            raise InputError(
                f"{shown(value)} is not a quantity", allowed=self.form, remedy=f"Write 1 {self._si}, for example."
            )
        try:
            number, unit = parse_quantity(_Written(value), self.dimension)
        except InputError as problem:
            raise InputError(problem.what, allowed=self.form, remedy=problem.remedy) from None
        si_value = self.dimension.to_si(float(number), unit)
        what = f"the {self.name} is {si_value!r} {self._si}" if self.name else f"it is {value}"
        self._check_range(si_value, info, what, unit, self.remedy or ("" if self.name else "Check value and unit."))
        return si_value

    def _number(self, value: Any, info: ValidationInfo) -> float:
        name = "it" if in_file(info) else info.field_name or "it"
        if not is_finite_number(value):
            if not in_file(info):
                raise InputError(f"{name} is {shown(value)}", allowed="a finite number")
            remedy = "Write it without quotes and units." if isinstance(value, str) else ""
            raise InputError(f"it is {shown(value)}", allowed=self.form, remedy=remedy)
        number = float(value)
        reminder = "" if in_file(info) else _REMINDERS.get(self.dimension, "")
        what = f"the {self.name} is" if self.name else f"{name} is"
        unit = "" if self.dimension is NUMBER else f" {self._si}"
        remedy = " ".join(part for part in (self.remedy, reminder) if part)
        self._check_range(number, info, f"{what} {number!r}{unit if self.name else ''}", self._si, remedy)
        return number

    @property
    def _si(self) -> str:
        return self.dimension.si_unit

    def _check_range(self, value: float, info: ValidationInfo, what: str, unit: str, remedy: str) -> None:
        if info.context == FORM_ONLY:
            return
        try:
            highest = self.highest(info.data) if callable(self.highest) else self.highest
        except KeyError:  # a value that it depends on is wrong itself
            return
        if not ((self.lowest < value if self.above else self.lowest <= value) and value <= highest):
            raise InputError(what, allowed=replace(self, highest=highest).range_text(unit), remedy=remedy)

    def range_text(self, unit: str) -> str:
        """The range in words, in one of the units.

        Examples
        --------
        >>> Quantity("tilt", ANGLE, -0.3, 0.3).range_text("deg"), Quantity("step", TIME, 0.0, above=True).range_text("s")
        ('-17.1887 to 17.1887 deg', 'a number above 0 s')
        """
        ends = [self.dimension.text(end, unit) if math.isfinite(end) else "" for end in (self.lowest, self.highest)]
        low, high = (re.sub(r"e([+-])0*", lambda found: f"e{found[1].strip('+')}", end) for end in ends)
        low, high = (re.sub(r"^0\.(0+)1(?=$| )", lambda found: f"1e-{len(found[1]) + 1}", end) for end in (low, high))
        if not high:
            return f"a number {'above' if self.above else 'from'} {low}"
        low = low.partition(" ")[0]
        return (f"above {low}, up to {high}" if self.above else f"{low} to {high}") + self.note

    def json(self) -> dict[str, Any]:
        """Text of the form number and unit, or a word; a plain number where there is no unit."""
        if self.dimension is NUMBER:
            return {"type": "number"}
        inner = quantity_pattern(self.dimension)[1:-1]
        return {"type": "string", "pattern": f"^({'|'.join([inner, *self.words])})$"}


class _Written(str):
    """A value of a file as text that messages show as it was written: a number without quotes."""

    def __new__(cls, value: str | float):
        text = str.__new__(cls, value)
        text.quoted = isinstance(value, str)
        return text

    def __repr__(self) -> str:
        return str.__repr__(self) if self.quoted else str(self)


@dataclass(frozen=True)
class Vector(Form):
    """Three quantities in a list."""

    dimension: Dimension = NUMBER

    @property
    def form(self) -> str:
        """What is accepted, in words."""
        zero = f"0 {self.dimension.si_unit}"
        return f"a list of three quantities, such as [{zero}, {zero}, {zero}]"

    def read(self, value: Any, info: ValidationInfo) -> list[float | None]:
        """Read three texts to SI."""
        if not isinstance(value, list) or len(value) != 3:
            raise InputError(f"it is {shown(value)}", allowed=self.form, remedy=f"It is the {self.about}.")
        return [Quantity("one component", self.dimension).read(item, info) for item in value]

    def json(self) -> dict[str, Any]:
        """A list of three texts."""
        item = Quantity("one component", self.dimension)
        return {"type": "array", "items": item.json() | {"description": item.about}, "minItems": 3, "maxItems": 3}


@dataclass(frozen=True)
class Whole(Form):
    """A whole number."""

    lowest: int = 0
    highest: int = 2**53
    name: str = ""
    form: ClassVar[str] = "a whole number"

    def read(self, value: Any, info: ValidationInfo) -> int:
        """Check type and range; NumPy's integers are welcome."""
        if not is_finite_number(value) or not hasattr(value, "__index__"):
            quotes = in_file(info) and isinstance(value, str)
            remedy = "Write it without quotes and units." if quotes else ""
            subject = "it" if in_file(info) else info.field_name or "it"
            raise InputError(f"{subject} is {shown(value)}", allowed=self.form, remedy=remedy)
        number = int(value)
        if info.context != FORM_ONLY and not self.lowest <= number <= self.highest:
            low = f"a whole number above {self.lowest - 1}" if self.lowest else "a whole number, 0 or above"
            allowed = low if number < self.lowest else f"a whole number up to {self.highest}"
            raise InputError(f"{self.name or info.field_name or 'it'} is {shown(number)}", allowed=allowed)
        return number

    def json(self) -> dict[str, Any]:
        """An integer."""
        return {"type": "integer"}


@dataclass(frozen=True)
class Flag(Form):
    """True or false."""

    form: ClassVar[str] = "true or false"

    def read(self, value: Any, info: ValidationInfo) -> bool:
        """Check the type; what is merely true in some sense is not."""
        if not isinstance(value, bool) and type(value).__name__ not in ("bool", "bool_"):
            subject = "it" if in_file(info) else info.field_name or "it"
            raise InputError(f"{subject} is {shown(value)}", allowed=self.form)
        return bool(value)

    def json(self) -> dict[str, Any]:
        """A truth value."""
        return {"type": "boolean"}


@dataclass(frozen=True)
class Text(Form):
    """Text, which is not empty unless it may be."""

    may_be_empty: bool = False
    form: ClassVar[str] = "text"

    def read(self, value: Any, info: ValidationInfo) -> str:
        """Check the type."""
        if not isinstance(value, str) or not (value or self.may_be_empty):
            raise InputError(f"it is {shown(value)}", allowed=self.form)
        check_no_zero_byte(value)
        return value

    def json(self) -> dict[str, Any]:
        """Text."""
        return {"type": "string"}


@dataclass(frozen=True)
class Texts(Form):
    """A text, or a list of different texts; a list in any case once it is read."""

    form: ClassVar[str] = "text, or a list of different texts"

    def read(self, value: Any, info: ValidationInfo) -> list[str]:
        """Check every text."""
        texts = value if isinstance(value, list) else [value]
        if not texts or not all(isinstance(text, str) and text for text in texts) or len(set(texts)) != len(texts):
            raise InputError(f"it is {shown(value)}", allowed=self.form, remedy=f"It is the {self.about}.")
        for text in texts:
            check_no_zero_byte(text)
        return texts

    def json(self) -> dict[str, Any]:
        """Text or a list of texts."""
        several = {"type": "array", "items": {"type": "string"}, "minItems": 1, "uniqueItems": True}
        return {"anyOf": [{"type": "string"}, several]}


@dataclass(frozen=True)
class Choice(Form):
    """One of several names, which are asked for only when needed, so that laws are imported only then.

    `more` explains how a name that does not exist can come to exist.
    """

    names: Callable[[], Sequence[str]] = tuple
    more: str = ""

    @property
    def form(self) -> str:
        """What is accepted, in words."""
        return ", ".join(self.names())

    def read(self, value: Any, info: ValidationInfo) -> str:
        """Check that the name exists."""
        names = self.names()
        if not isinstance(value, str) or value not in names:
            remedy = " ".join(part for part in (nearest(value, names), self.more) if part)
            raise InputError(f"{shown(value)} does not exist", allowed=", ".join(names), remedy=remedy)
        return value

    def json(self) -> dict[str, Any]:
        """The names."""
        return {"enum": list(self.names())}


def nearest(value: Any, names: Sequence[str]) -> str:
    """Advice for a name that does not exist.

    Examples
    --------
    >>> nearest("14D", ["14C", "22A"]), nearest(3, ["14C"])
    ('Did you mean 14C?', 'Choose one of these.')
    """
    close = get_close_matches(str(value), names, n=1)
    return f"Did you mean {close[0]}?" if close else "Choose one of these."
