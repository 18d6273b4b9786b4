"""Forms of values: what a key of an input section accepts, in a file and in Python.

A form annotates a field, `tilt: Annotated[float, Quantity("shaft tilt", ANGLE, -0.3, 0.3)]`. In a file a quantity is
text with its unit; in Python it is a number in SI units. The range is checked in the same place for both.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any, ClassVar, get_args

from pydantic import ValidationInfo
from pydantic_core import core_schema

from macroslip.catalogue.entry import is_finite_number
from macroslip.catalogue.problems import shown
from macroslip.errors import InputError
from macroslip.files import check_no_zero_byte

#: Context of a validation whose values come from a file.
IN_FILE = "file"
#: Context of a validation in which the form of a value is checked and its range is not.
FORM_ONLY = "form"


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
        """Validation by `read`; in Python, None is a value that is left open."""
        optional = type(None) in get_args(source)

        def validate(value: Any, info: ValidationInfo) -> Any:
            return None if value is None and optional and not in_file(info) else self.read(value, info)

        return core_schema.with_info_plain_validator_function(validate)

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        """JSON Schema with what the value is."""
        return self.json() | {"description": self.about}


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
    """One of several names, which are looked up only when needed, so that laws are imported only then.

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
