"""Values that runs of a study have in place of those of its base case: `bearing.diametral_clearance` is `0.2 mm`."""

from __future__ import annotations

import functools
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from macroslip.bearing import Bearing
from macroslip.case.case import Case
from macroslip.errors import InputError
from macroslip.input.fields import FORM_ONLY, Quantity
from macroslip.input.files import Place, Source
from macroslip.input.messages import shown, unknown_key
from macroslip.input.record import Record, dimensions, read_entry
from macroslip.input.section import Field, form_of, keys_of, read_value, word_of
from macroslip.input.units import NUMBER, NUMBER_PATTERN, is_finite_number
from macroslip.lubricant import Lubricant

#: Records with values of their own, each of which can be replaced.
RECORDS: dict[str, type[Record]] = {"bearing": Bearing, "lubricant": Lubricant}
#: Keys that change several values of a record together, with the quantity whose units they have.
_TOGETHER = {"lubricant.at": "inlet_temperature"}
#: Keys of a case that have a key of their own in a study.
_ELSEWHERE = {"loads": "loads", "bearing": "bearings", "lubricant": "lubricants"}
_QUANTITY = re.compile(rf"\s*(?P<number>{NUMBER_PATTERN})(?=[^\d.,])\s*(?P<unit>\S.*?)\s*")


@dataclass(frozen=True)
class Setting:
    """One value in place of the base case's.

    Parameters
    ----------
    key : str
        Key of the case file, as `drivetrain.tilt`, or `bearing.` or `lubricant.` and the key of one of its values.
    value : Any
        Number, text, truth value or list.
    unit : str
        Unit of a quantity, or empty.
    """

    key: str
    value: Any
    unit: str = ""

    @classmethod
    def written(cls, key: str, value: Any) -> Setting:
        """From a value as a case file has it: `0.2 mm` becomes number and unit."""
        match = _QUANTITY.fullmatch(value) if isinstance(value, str) else None
        return cls(key, value) if match is None else cls(key, float(match["number"]), match["unit"])

    @property
    def text(self) -> Any:
        """The value as a case file has it."""
        return f"{self.value!r} {self.unit}" if self.unit else self.value

    @property
    def entry(self) -> dict[str, Any]:
        """The value as a catalogue file has it, with the tag of a user's value."""
        return {"value": self.value, "unit": self.unit or "1", "tag": "U", "note": "varied in a study"}

    def check(self, place: Place) -> None:
        """Check key, form and unit; whether the value is in range depends on the others, and is checked with the case.

        Raises
        ------
        InputError
        """
        head, *rest = self.key.split(".")
        if head in RECORDS and rest:
            self._check_entry(RECORDS[head], ".".join(rest), place)
            return
        if head in _ELSEWHERE:
            remedy = f"It has its own key in a study: {_ELSEWHERE[head]}."
            raise place.problem(f"the key '{self.key}' cannot be varied here", remedy=remedy)
        fields = _settable().get(self.key, [])
        if not fields:
            others = (key for key in _settable() if key.partition(".")[0] not in _ELSEWHERE)
            records = (f"{noun}.{key}" for noun, record in RECORDS.items() for key in dimensions(record))
            raise unknown_key(self.key, [*others, *records], where=place.where)
        problems = []
        for field in fields:
            try:
                self._check_against(field, place)
            except InputError as problem:
                problems.append(problem)
            else:
                return
        raise problems[0]

    def _check_against(self, field: Field, place: Place) -> None:
        form, word = form_of(field), word_of(field)
        if self.unit and not (isinstance(form, Quantity) and form.dimension is not NUMBER):
            raise place.problem(f"it has the unit '{self.unit}'", "a value without unit", "Remove the unit.")
        if form is None and self.value != word:
            raise place.problem(f"it is {shown(self.value)}", word)
        read_value(field, self.text, replace(FORM_ONLY, place=place))

    def _check_entry(self, record: type[Record], key: str, place: Place) -> None:
        key = _TOGETHER.get(self.key, key)
        if key not in dimensions(record):
            raise unknown_key(self.key, (f"{record.noun}.{one}" for one in dimensions(record)), where=place.where)
        if not is_finite_number(self.value):
            units = dimensions(record)[key].choices
            raise place.problem(f"it is {shown(self.value)}", f"a number with its unit, {units}")
        try:
            read_entry(key, self.entry, dimensions(record)[key], Source())
        except InputError as problem:
            raise place.blamed(problem) from None


def with_settings(mapping: Mapping[str, Any], settings: list[Setting]) -> dict[str, Any]:
    """The mapping of a case file with other values; those of bearing and lubricant are left to `replaced`."""
    result = dict(mapping)
    for setting in settings:
        *sections, last = setting.key.split(".")
        if sections and sections[0] in RECORDS:
            continue
        inner = result
        for name in sections:
            # A section that is absent or switched off by a word begins anew.
            inner[name] = dict(inner[name]) if isinstance(inner.get(name), Mapping) else {}
            inner = inner[name]
        inner[last] = setting.text
    return result


def replaced(record: Record, settings: list[Setting]) -> Record:
    """A bearing or lubricant with the values meant for it, checked as any other input.

    Raises
    ------
    InputError
        If a value is out of its range, or does not go with the others.

    Examples
    --------
    >>> bearing = replaced(Bearing.read("skf-240-600-bc"), [Setting("bearing.diametral_clearance", 0.2, "mm")])
    >>> bearing.diametral_clearance, bearing.provenance["diametral_clearance"].tag
    (0.0002, 'U')
    """
    head = f"{record.noun}."
    own = [one for one in settings if one.key.startswith(head)]
    entries = {one.key.removeprefix(head): one.entry for one in own if one.key not in _TOGETHER}
    result = type(record).from_dict(record.as_dict() | entries) if entries else record
    for one in own:
        if one.key == "lubricant.at":
            temperature, _ = read_entry("at", one.entry, dimensions(type(record))[_TOGETHER[one.key]], Source())
            result = result.at(temperature)
    return result


@functools.cache
def _settable() -> dict[str, list[Field]]:
    """Fields by the full name of a key, `drivetrain.tilt`; several where sections exclude each other."""
    found: dict[str, list[Field]] = {}
    for key, field in keys_of(Case):
        if form_of(field) or word_of(field):
            found.setdefault(key, []).append(field)
    return found
