"""Checked fields: form of a value in a file and in Python, declared as annotation of a field.

`tilt: Annotated[float, Quantity("shaft tilt", ANGLE, -0.3, 0.3)]`. In a file a quantity is text
with its unit; in Python it is a number in SI units. Range, message and JSON Schema follow from the
same declaration, in sections and records.
"""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

from macroslip.errors import InputError
from macroslip.input.files import Location, Source
from macroslip.input.messages import shown, unknown_name
from macroslip.input.units import (
    ANGLE,
    LENGTH,
    MASS,
    NUMBER,
    TIME,
    Dimension,
    is_finite_number,
    number_advice,
    parse_quantity,
    quantity_pattern,
)
from macroslip.storage.files import check_no_zero_byte

#: Largest whole number of a field.
_MOST = 10**15
#: Characters that a line may have.
_LONGEST = 2000
_REMINDERS = {
    LENGTH: " Lengths are in metres.",
    ANGLE: " Angles are in radians: math.radians(5.0) for 5 degrees.",
    MASS: " The mass is in kilograms.",
    TIME: " Times are in seconds.",
}


@dataclass(frozen=True)
class Context:
    """Context in which a value is read: where it stands, and how it is written."""

    location: Location = field(default_factory=lambda: Location(Source()))
    #: Whether it is written as in a file; otherwise a quantity is a number in SI units.
    in_file: bool = False
    #: Whether ranges are checked, beside the form.
    ranges: bool = True
    #: Values of the fields before it in the same section.
    before: Mapping[str, Any] = field(default_factory=dict)
    #: For a record, whose values are in SI whatever was written: number with unit, and unit, as
    #: written, by key.
    written: Mapping[str, tuple[str, str]] | None = None

    def inside(self, key: str, before: Mapping[str, Any] | None = None) -> Context:
        """The same of a value further in."""
        return Context(
            self.location.inside(key), self.in_file, self.ranges, before or {}, self.written
        )


PYTHON = Context()
IN_FILE = Context(in_file=True)
FORM_ONLY = Context(in_file=True, ranges=False)


@dataclass(frozen=True)
class Form:
    """Form of a value, with its meaning in `about`; it reads a value or raises `InputError`."""

    about: str
    form: ClassVar[str] = ""

    def read(self, value: Any, context: Context) -> Any:
        """The value as the program uses it."""
        raise NotImplementedError

    def json(self) -> dict[str, Any]:
        """JSON Schema of the value in a file."""
        return {"type": "object"}

    def wrong(self, value: Any, remedy: str = "", allowed: str = "") -> InputError:
        """The error for a value of another form."""
        fault = f"it is {shown(value)}"
        return InputError(fault, allowed=allowed or self.form, remedy=remedy)


@dataclass(frozen=True)
class Quantity(Form):
    """A number with its unit, within a range; or one of a few words, which read as None."""

    dimension: Dimension = NUMBER  #: Its units; NUMBER: a plain number
    #: Range [SI]; a callable computes an end from the values of the fields before, by their names.
    lowest: float = -math.inf
    highest: float | Callable[[Mapping[str, float]], float] = math.inf
    #: Whether the lowest and the highest value itself are excluded.
    above: bool = False
    below: bool = False
    words: tuple[str, ...] = ()  #: Words that a file may have instead
    whole: bool = False  #: Whether it is a whole number
    #: Words added to the range, and advice for a value outside.
    note: str = ""
    remedy: str = ""

    @property
    def form(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """Accepted values, in words."""
        if self.dimension is NUMBER:
            return self.range_text() if self.whole else "a number without unit"
        with_unit = f"a number with its unit, {self.dimension.choices}"
        return " or ".join([*self.words, with_unit])

    def read(self, value: Any, context: Context) -> float | None:
        """Read text with a unit, or a number, to SI, and check its range."""
        unit = self.dimension.si_unit
        if context.in_file and self.dimension is not NUMBER:
            if isinstance(value, str) and value in self.words:
                return None
            if isinstance(value, bool) or not isinstance(value, str | int | float):
                raise self.wrong(value, f"Write 1 {unit}, for example.")
            try:
                number, unit = parse_quantity(value, self.dimension)
            except InputError as problem:
                raise problem.but(where="", allowed=self.form) from None
            si_value = self.dimension.to_si(float(number), unit)
            written = str(value)
        else:
            si_value = self._number(value, context)
            written, unit = (context.written or {}).get(
                context.location.key, (f"{si_value!r}", unit)
            )
        if context.ranges:
            self._check_range(si_value, context, written, unit)
        return si_value

    def _number(self, value: Any, context: Context) -> float:
        """A finite number as Python's own, so that NumPy's are welcome."""
        finite = is_finite_number(value)
        if finite and not self.whole:
            return float(value)
        if finite and (
            hasattr(value, "__index__") or (abs(value) <= _MOST and float(value).is_integer())
        ):
            return int(value)
        remedy = ""
        if context.in_file and isinstance(value, str):
            remedy = number_advice(value) or "Write it without quotes and units."
        raise self.wrong(
            value, remedy, self.form if self.whole or context.in_file else "a finite number"
        )

    def _check_range(self, value: float, context: Context, written: str, unit: str) -> None:
        known = self
        if callable(self.highest):
            try:
                known = replace(self, highest=self.highest(context.before))
            except KeyError:  # a value that it depends on is wrong itself
                return
        if not known.holds(value):
            check = "" if self.dimension is NUMBER else "; check value and unit"
            reminder = (
                "" if context.in_file or context.written else _REMINDERS.get(self.dimension, "")
            )
            known_remedy = self.remedy or f"It is the {self.about}{check}."
            remedy = f"{known_remedy}{reminder}"
            raise InputError(f"it is {written}", allowed=known.range_text(unit), remedy=remedy)

    def holds(self, value: float) -> bool:
        """True if a value [SI] is in the range, whose ends are numbers."""
        low = self.lowest < value if self.above else self.lowest <= value
        return low and (value < self.highest if self.below else value <= self.highest)  # pyright: ignore[reportOperatorIssue]

    def range_text(self, unit: str = "") -> str:
        """The range in words, in one of the units, SI by default.

        Examples
        --------
        >>> Quantity("tilt", ANGLE, -0.3, 0.3).range_text("deg")
        '-17.1887 to 17.1887 deg'
        >>> Quantity("step", TIME, 0.0, above=True).range_text("s")
        'a number above 0 s'
        >>> Quantity("ratio", NUMBER, 0.9, 1.0, above=True, below=True).range_text()
        'above 0.9 and below 1'
        """
        unit = unit or self.dimension.si_unit
        low = self._end_text(self.lowest, unit)
        high = self._end_text(self.highest, unit)
        if not high:
            return f"a number {'above' if self.above else 'from'} {low}"
        low = low.partition(" ")[0]
        if self.below:
            text = f"above {low} and below {high}" if self.above else f"{low} to below {high}"
        else:
            text = f"above {low}, up to {high}" if self.above else f"{low} to {high}"
        return f"{'a whole number, ' if self.whole else ''}{text}{self.note}"

    def _end_text(self, end: Any, unit: str) -> str:
        """End of the range [SI] in a unit; empty if it is infinite."""
        if not math.isfinite(end):
            return ""
        text = self.dimension.text(end, unit)
        return re.sub(r"e([+-])0*", lambda match: f"e{match[1].strip('+')}", text)

    def json(self) -> dict[str, Any]:
        """Text of the form number and unit, or a word; a plain number where there is no unit."""
        if self.dimension is NUMBER:
            return {"type": "integer" if self.whole else "number"}
        inner = quantity_pattern(self.dimension)[1:-1]
        forms = "|".join([inner, *self.words])
        return {"type": "string", "pattern": f"^({forms})$"}


class Whole(Quantity):
    """A whole number without unit."""

    def __init__(self, about: str, lowest: int = 0, highest: int = _MOST):
        super().__init__(about, NUMBER, lowest, highest, whole=True)


class Positive(Quantity):
    """A quantity above 0, up to a highest value [SI]."""

    def __init__(self, about: str, dimension: Dimension, highest: float = math.inf):
        super().__init__(about, dimension, 0.0, highest, above=True)


@dataclass(frozen=True)
class Vector(Form):
    """Three quantities in a list."""

    dimension: Dimension = NUMBER

    @property
    def form(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """Accepted values, in words."""
        zero = f"0 {self.dimension.si_unit}"
        return f"a list of three quantities, such as [{zero}, {zero}, {zero}]"

    def read(self, value: Any, context: Context) -> list[float | None]:
        """Read three texts to SI."""
        if not isinstance(value, list) or len(value) != 3:
            raise self.wrong(value, f"It is the {self.about}.")
        form = Quantity("component", self.dimension)
        return [form.read(item, context) for item in value]

    def json(self) -> dict[str, Any]:
        """A list of three texts."""
        item = Quantity("", self.dimension).json() | {"description": "one component"}
        return {"type": "array", "items": item, "minItems": 3, "maxItems": 3}


@dataclass(frozen=True)
class Flag(Form):
    """True or false; a value that merely counts as true is refused."""

    form: ClassVar[str] = "true or false"

    def read(self, value: Any, context: Context) -> bool:
        """Check the type; NumPy's truth values are welcome."""
        if type(value).__name__ not in ("bool", "bool_"):
            raise self.wrong(value)
        return bool(value)

    def json(self) -> dict[str, Any]:
        """A truth value."""
        return {"type": "boolean"}


@dataclass(frozen=True)
class Text(Form):
    """Text, which is not empty unless it may be; a line is one that results can hold."""

    may_be_empty: bool = False
    line: bool = False

    @property
    def form(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """Accepted values, in words."""
        return "text" if self.may_be_empty else "non-empty text"

    def read(self, value: Any, context: Context) -> str:
        """Check the type."""
        if not isinstance(value, str) or not (value or self.may_be_empty):
            raise self.wrong(value)
        # A NUL ends text in a result, and half a surrogate pair has no UTF-8.
        unfit = self.line and _has_categories(value, ("Cc", "Cs"))
        if unfit or (self.line and len(value) > _LONGEST):
            allowed = f"at most {_LONGEST} characters on one line, without control characters"
            raise self.wrong(value, "Write it as one line of plain text.", allowed)
        _check_text(value)
        return value

    def json(self) -> dict[str, Any]:
        """Text."""
        return {"type": "string"} | ({} if self.may_be_empty else {"minLength": 1})


def _has_categories(text: str, categories: tuple[str, ...]) -> bool:
    """True if a letter is of one of these categories of control characters and surrogates."""
    # Letters that can be printed are of none, and nearly all texts have no others.
    if text.isprintable():
        return False
    return any(unicodedata.category(letter) in categories for letter in text)


def _check_text(text: str) -> None:
    """Refuse control characters in text, which a backslash in double quotes may have become."""
    check_no_zero_byte(text)
    if _has_categories(text, ("Cc",)):
        control = next(letter for letter in text if unicodedata.category(letter) == "Cc")
        raise InputError(
            f"it is {shown(text)}, with the control character {control!r}",
            allowed="text without control characters",
            remedy="In double quotes a backslash begins such a character: write a path of Windows "
            "in single quotes, or with slashes.",
        )


@dataclass(frozen=True)
class Texts(Form):
    """A text, or a list of different texts; a list in any case once it is read."""

    form: ClassVar[str] = "text, or a list of different texts"

    def read(self, value: Any, context: Context) -> list[str]:
        """Check every text."""
        texts = value if isinstance(value, list) else [value]
        if (
            not texts
            or not all(isinstance(text, str) and text for text in texts)
            or len(set(texts)) != len(texts)
        ):
            raise self.wrong(value, f"It is the {self.about}.")
        for text in texts:
            _check_text(text)
        return texts

    def json(self) -> dict[str, Any]:
        """Text or a list of texts."""
        several = {"type": "array", "items": {"type": "string"}, "minItems": 1, "uniqueItems": True}
        return {"anyOf": [{"type": "string"}, several]}


@dataclass(frozen=True)
class Choice(Form):
    """One of several names, looked up when needed, so that laws are imported only then.

    `more` explains how a name that does not exist can come to exist.
    """

    names: Callable[[], Sequence[str]] = tuple
    more: str = ""

    @property
    def form(self) -> str:  # pyright: ignore[reportIncompatibleVariableOverride]
        """Accepted values, in words."""
        return ", ".join(self.names())

    def read(self, value: Any, context: Context) -> str:
        """Check that the name exists."""
        names = self.names()
        if not isinstance(value, str) or value not in names:
            raise unknown_name(value, names, self.more)
        return value

    def json(self) -> dict[str, Any]:
        """The names."""
        return {"enum": list(self.names())}
