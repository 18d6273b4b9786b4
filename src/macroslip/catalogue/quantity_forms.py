"""Forms of quantities: a number with its unit in a file, a number in SI units in Python; and three of them."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from pydantic import ValidationInfo

from macroslip.catalogue.entry import is_finite_number
from macroslip.catalogue.forms import FORM_ONLY, Form, in_file
from macroslip.catalogue.problems import shown
from macroslip.catalogue.quantity import parse_quantity, quantity_pattern
from macroslip.catalogue.units import ANGLE, LENGTH, MASS, NUMBER, TIME, Dimension
from macroslip.errors import InputError

_REMINDERS = {
    LENGTH: "Lengths are in metres.",
    ANGLE: "Angles are in radians: math.radians(5.0) for 5 degrees.",
    MASS: "The mass is in kilograms.",
    TIME: "Times are in seconds.",
}


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
