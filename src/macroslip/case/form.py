"""Kinds of values in a case file, each of which reads one, refuses it in words, and gives its schema.

A kind's `read(value, place)` returns the value in SI units or raises `InputError`; its `schema()` is the JSON Schema of
what it accepts.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any

from macroslip.catalogue.entry import is_finite_number
from macroslip.catalogue.problems import shown
from macroslip.catalogue.source import Source
from macroslip.catalogue.units import Dimension
from macroslip.errors import InputError

_NUMBER = r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?"


@dataclass(frozen=True)
class Place:
    """Where a value stands in a file.

    Parameters
    ----------
    source : Source
        File and line numbers.
    keys : tuple of str
        Keys from the outermost inwards.
    """

    source: Source
    keys: tuple[str, ...] = ()

    def inside(self, *keys: str) -> Place:
        """The place of a value further in."""
        return Place(self.source, self.keys + keys)

    @property
    def key(self) -> str:
        """The keys as messages write them: `loads.hub.force`."""
        return ".".join(self.keys)

    @property
    def where(self) -> str:
        """File, line and key: `case.yaml, line 7, loads.hub.force`."""
        return ", ".join(part for part in (self.source.where(*self.keys), self.key) if part)

    def problem(self, what: str, allowed: str = "", remedy: str = "") -> InputError:
        """An error that stands here."""
        return InputError(what, where=self.where, allowed=allowed, remedy=remedy)

    def blamed(self, problem: InputError) -> InputError:
        """The same error, raised by what read the value, with this place in front."""
        # What was given the value without its file can name the key only.
        inner = "" if problem.where == self.key else problem.where
        what = f"{inner}: {problem.what}" if inner else problem.what
        return self.problem(what, problem.allowed, problem.remedy)


@dataclass(frozen=True)
class Quantity:
    """A number with its unit, as text: `1.26 m`; or one of a few words, which read as None."""

    about: str
    dimension: Dimension
    words: tuple[str, ...] = ()

    @property
    def form(self) -> str:
        """What is accepted, in words."""
        return " or ".join([*self.words, f"a number with its unit, {self.dimension.choices}"])

    def read(self, value: Any, place: Place) -> float | None:
        """Read text to SI."""
        if value in self.words:
            return None
        match = re.fullmatch(rf"\s*(?P<number>{_NUMBER})\s*(?P<unit>[^\d\s.,].*?)?\s*", str(value))
        if match is None or isinstance(value, bool):
            decimal = re.match(r"\s*[+-]?\d+,\d", value) if isinstance(value, str) else None
            remedy = (
                "Use a decimal point, not a comma." if decimal else f"Write 1 {self.dimension.si_unit}, for example."
            )
            raise place.problem(f"{shown(value)} is not a quantity", self.form, remedy)
        number, unit = match["number"], match["unit"]
        if unit is None:
            remedy = f"Write {number} {self.dimension.si_unit}, for example."
            raise place.problem(f"{shown(value)} has no unit", self.form, remedy)
        if unit not in self.dimension.units:
            raise place.problem(f"{shown(value)} has the unit '{unit}'", self.form, "Convert it to one of these units.")
        si_value = self.dimension.to_si(float(number), unit) if math.isfinite(float(number)) else math.inf
        if not math.isfinite(si_value):
            raise place.problem(f"{shown(value)} is too large for a number", self.form)
        return si_value

    def unit(self, value: str) -> str:
        """Unit of a text that `read` has accepted."""
        return re.sub(rf"^\s*{_NUMBER}\s*", "", value).strip()

    def schema(self) -> dict[str, Any]:
        """Text of the form number and unit, or a word."""
        units = "|".join(re.escape(unit).replace("\\ ", " ") for unit in self.dimension.units)
        words = "".join(f"|{word}" for word in self.words)
        return {"type": "string", "pattern": rf"^(\s*{_NUMBER}\s*({units})\s*{words})$", "description": self.about}


@dataclass(frozen=True)
class Vector:
    """Three quantities in a list."""

    about: str
    component: Quantity

    @property
    def form(self) -> str:
        """What is accepted, in words."""
        zero = f"0 {self.component.dimension.si_unit}"
        return f"a list of three quantities, such as [{zero}, {zero}, {zero}]"

    def read(self, value: Any, place: Place) -> list[float]:
        """Read a list of three texts to SI."""
        if not isinstance(value, list) or len(value) != 3:
            raise place.problem(f"it is {shown(value)}", self.form, f"It is the {self.about}.")
        return [self.component.read(item, place) for item in value]

    def schema(self) -> dict[str, Any]:
        """A list of three texts."""
        return {
            "type": "array",
            "items": self.component.schema(),
            "minItems": 3,
            "maxItems": 3,
            "description": self.about,
        }


@dataclass(frozen=True)
class Plain:
    """A number without unit, true or false, or text: whatever `kind` says."""

    about: str
    kind: type

    @property
    def form(self) -> str:
        """What is accepted, in words."""
        return {float: "a number without unit", int: "a whole number", bool: "true or false", str: "text"}[self.kind]

    def read(self, value: Any, place: Place) -> Any:
        """Check the type of a value."""
        if self.kind in (float, int):
            good = is_finite_number(value) and (self.kind is float or isinstance(value, int))
        else:
            good = isinstance(value, self.kind) and value != ""
        if good:
            return value
        quotes = isinstance(value, str) and self.kind in (float, int)
        raise place.problem(f"it is {shown(value)}", self.form, "Write it without quotes and units." if quotes else "")

    def schema(self) -> dict[str, Any]:
        """A plain JSON type."""
        name = {float: "number", int: "integer", bool: "boolean", str: "string"}[self.kind]
        return {"type": name, "description": self.about}


@dataclass(frozen=True)
class Choice:
    """One of several names; they are asked for when they are needed, so that a law costs nothing until then.

    `more` says how a name that does not exist can come to exist.
    """

    about: str
    names: Callable[[], Sequence[str]]
    more: str = ""

    def read(self, value: Any, place: Place) -> str:
        """Check that the name exists."""
        names = self.names()
        if value not in names:
            remedy = " ".join(part for part in (_nearest(value, names), self.more) if part)
            raise place.problem(f"{shown(value)} does not exist", ", ".join(names), remedy)
        return value

    def schema(self) -> dict[str, Any]:
        """The names."""
        return {"enum": list(self.names()), "description": self.about}


@dataclass(frozen=True)
class Numbers:
    """A list of whole numbers, or a word."""

    about: str
    word: str

    def read(self, value: Any, place: Place) -> str | list[int]:
        """Check that each is a whole number; whether it exists is checked with the bearing."""
        whole = isinstance(value, list) and all(type(item) is int for item in value)
        if value != self.word and not whole:
            raise place.problem(f"it is {shown(value)}", f"{self.word}, or a list of whole numbers such as [0, 7]")
        return value

    def schema(self) -> dict[str, Any]:
        """A list of integers, or the word."""
        numbers = {"type": "array", "items": {"type": "integer", "minimum": 0}, "minItems": 1, "uniqueItems": True}
        return {"anyOf": [{"const": self.word}, numbers], "description": self.about}


def _nearest(value: Any, names: Sequence[str]) -> str:
    close = get_close_matches(str(value), names, n=1)
    return f"Did you mean {close[0]}?" if close else "Choose one of these."
