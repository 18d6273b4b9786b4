"""Records of catalogue files: named sets of quantities, frozen in SI, each with its provenance."""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from importlib import resources
from importlib.resources.abc import Traversable
from os import PathLike, fspath
from pathlib import Path
from types import MappingProxyType
from typing import Any, ClassVar, Self, get_type_hints

from macroslip.errors import InputError
from macroslip.input.fields import Choice, Context, Form, Quantity, Text
from macroslip.input.files import Location, Source, parse, read_text, yaml_text
from macroslip.input.messages import shown, together
from macroslip.input.section import (
    Field,
    Fields,
    Section,
    form_from,
    grouped,
    read_keys,
    read_value,
)
from macroslip.input.units import (
    NUMBER,
    Dimension,
    is_finite_number,
    parse_quantity,
    quantity_pattern,
    with_unit,
)
from macroslip.overview import html_overview

#: Provenance tags and their meaning.
TAGS: Mapping[str, str] = MappingProxyType(
    {
        "P": "paper",
        "V": "catalogue or public model",
        "D": "derived",
        "R": "literature, from memory",
        "E": "engineering estimate",
        "U": "user",
    }
)
_HEADER = (
    "A {} file of macroslip. Every quantity has a value and its unit; where it comes from (tag), a note and the range of "
    f"values it may have are optional. Tags: {', '.join(f'{tag} {meaning}' for tag, meaning in TAGS.items())}. Short "
    "form: width, say, as 272 mm."
)


@dataclass(frozen=True)
class Provenance:
    """Provenance of a value: its source, and its value and unit as written."""

    value: float  #: Number as written [unit]
    unit: str  #: Unit as written
    tag: str = "U"  #: One of `TAGS`
    note: str = ""  #: Free text
    #: Values that the quantity may have as well, lowest and highest [unit]: four out of five lie
    #: between them. None if nothing is known of its scatter.
    range: tuple[float, float] | None = None

    def as_entry(self) -> dict[str, Any]:
        """The entry of a catalogue file for a quantity of this origin."""
        entry = asdict(self)
        del entry["range"]
        if self.range:
            entry["range"] = list(self.range)
        return entry

    @property
    def written(self) -> str:
        """Value and unit as written."""
        return with_unit(self.value, self.unit)


def _as_written(number: Any) -> float:
    """A number as an integer where it was written as one."""
    return int(number) if hasattr(number, "__index__") else float(number)


@dataclass(frozen=True)
class _Number(Form):
    form = "a finite number, without its unit"
    whole: bool = False

    def read(self, value: Any, context: Context) -> float:
        if not is_finite_number(value):
            raise self.wrong(value, "The unit goes into its own key.")
        return _as_written(value)

    def json(self) -> dict[str, Any]:
        return {"type": "integer" if self.whole else "number"}


#: Remedy for a range that is none.
_NO_SCATTER = "Leave it out if nothing is known of the scatter."


@dataclass(frozen=True)
class _Range(Form):
    form = "two numbers in the unit of the value, [lowest, highest], with the value between them"

    def read(self, value: Any, context: Context) -> tuple[float, float]:
        is_list = isinstance(value, Sequence) and not isinstance(value, str)
        if not is_list or len(value) != 2 or not all(map(is_finite_number, value)):
            raise self.wrong(value, _NO_SCATTER)
        lowest, highest = value
        middle = context.before.get("value")
        if middle is not None and not lowest <= middle <= highest:
            raise self.wrong(value, _NO_SCATTER)
        return _as_written(lowest), _as_written(highest)

    def json(self) -> dict[str, Any]:
        return {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2}


@dataclass(frozen=True)
class _Unit(Choice):
    """The unit of an entry; without quotes the unit of a pure number would be a number."""

    def read(self, value: Any, context: Context) -> str:
        if self.names() == ["1"] and value != "1":
            raise InputError(
                f"{shown(value)} does not exist",
                allowed='"1"',
                remedy="Write it with its quotes.",
            )
        return super().read(value, context)


@functools.cache
def _entry(dimension: Dimension, whole: bool = False) -> Section:
    """The section of an entry, `{value: 70, unit: mm, tag: E, note: "...", range: [66, 74]}`."""
    meanings = "; ".join(f"{tag}: {meaning}" for tag, meaning in TAGS.items())
    tags = f"{meanings}. Leave it out for a value of your own."
    forms = {
        "value": _Number("number, without its unit", whole),
        "unit": _Unit("unit of the value", lambda: list(dimension.units)),
        "tag": Choice("where it comes from", lambda: list(TAGS), tags),
        "note": Text("free text", may_be_empty=True, line=True),
        "range": _Range("lowest and highest value; four out of five lie between them"),
    }
    fields = {}
    for key, form in forms.items():
        is_required = key in ("value", "unit")
        fields[key] = Field(form, is_required, False)
    return Section("", fields)


@dataclass(frozen=True)
class _Entry(Form):
    """Quantity in a catalogue file, read as its provenance; its range is checked later.

    It is text of number and unit, a plain number where the quantity has no unit, or a mapping as
    `_entry` has it.
    """

    quantity: Quantity

    def read(self, value: Any, context: Context) -> Provenance:
        dimension = self.quantity.dimension
        key = context.location.keys[-1]
        if isinstance(value, str):
            return Provenance(*parse_quantity(value, dimension))
        if dimension is NUMBER and is_finite_number(value):
            value = {"value": value, "unit": "1"}
        if not isinstance(value, Mapping):
            lacks = "does not give its unit" if is_finite_number(value) else "is no quantity"
            raise InputError(
                f"it is {shown(value)}, which {lacks}",
                allowed=f"{key}: {with_unit(1, dimension.si_unit)}; or {key}: {{value: a number, unit: "
                f"{dimension.choices}, tag: {' or '.join(TAGS)}, note: text, range: [lowest, highest]}}, of which tag, "
                "note and range are optional",
                remedy="Give the value with its unit.",
            )
        return Provenance(**_entry(dimension).read(value, context))

    def json(self) -> dict[str, Any]:
        dimension = self.quantity.dimension
        text = {"type": "string", "pattern": quantity_pattern(dimension)}
        plain = [self.quantity.json()] if dimension is NUMBER else []
        return {"anyOf": [_entry(dimension, self.quantity.whole).json(), text, *plain]}


def read_entry(
    key: str, entry: Any, dimension: Dimension, source: Source
) -> tuple[float, Provenance]:
    """Read one entry of a catalogue file.

    Parameters
    ----------
    key : str
        Key of the entry.
    entry : object
        Its value: text of number and unit, a plain number without unit, or a mapping.
    dimension : Dimension
        Dimension of the quantity.
    source : Source
        Where it was written, for messages.

    Returns
    -------
    value : float
        In SI units.
    origin : Provenance
        Value and unit as written, with tag, note and range.

    Raises
    ------
    InputError
        If the entry is no quantity of this dimension.
    """
    field = Field(_Entry("", Quantity("", dimension)), True, False)
    origin = read_value(field, entry, Context(Location(source, (key,)), in_file=True))
    return dimension.to_si(origin.value, origin.unit), origin


class Record:
    """A named set of quantities that can be read from a catalogue file or built from SI numbers.

    A subclass declares every quantity as `Annotated[float, Quantity(...)]` with its range in SI,
    and keeps its shipped files in the folder `catalogue` of its own package. Raises InputError if a
    value is missing, unknown, no finite number, out of its range, or inconsistent with the others.
    All such problems are reported together.
    """

    noun: ClassVar[str] = "record"
    # Quantities that may be left out of a file because they follow from others, and those others.
    sources: ClassVar[Mapping[str, tuple[str, ...]]] = {}
    # Sections that files have: their meaning; the key `second` inside `out_of_round` is the field
    # `out_of_round_second`.
    sections: ClassVar[Mapping[str, str]] = {}
    name: str
    title: str
    # Pairs instead of a mapping keep the record hashable.
    _provenance: tuple[tuple[str, Provenance], ...]
    _derived: frozenset[str]

    def __init__(self, **values: Any):
        self._fill(values, {}, Source())

    def _fill(
        self,
        values: Mapping[str, Any],
        provenance: Mapping[str, Provenance],
        source: Source,
        derived: frozenset[str] = frozenset(),
    ) -> None:
        fields = fields_of(type(self))
        kinds = dimensions(type(self))
        written = {}
        for key, value in values.items():
            if key in kinds:
                unit = kinds[key].si_unit
                written[key] = (with_unit(value, unit), unit)
        for key, origin in provenance.items():
            written[key] = (origin.written, origin.unit)
        # An entry may have several lines; what is wrong with its value is in the line of the value.
        lines = {}
        for keys, line in source.lines.items():
            if keys[1:] == ("value",):
                lines[keys[:1]] = line
        location = Location(Source(source.file, {**source.lines, **lines}))
        checked, problems = read_keys(fields, values, Context(location, written=written))
        if problems:
            raise together(problems)
        own = {key: checked.get(key, member.default) for key, member in fields.items()}
        origins = []
        for key, dimension in kinds.items():
            if own[key] is not None:
                origin = provenance.get(key) or Provenance(own[key], dimension.si_unit)
                origins.append((key, origin))
        vars(self).update(own, _provenance=tuple(origins), _derived=derived)
        problems = [*self._wide_ranges(source), *self._inconsistencies(source)]
        if problems:
            raise together(problems)

    def _wide_ranges(self, source: Source) -> Iterator[InputError]:
        for key, origin in self._provenance:
            quantity = quantities(type(self))[key]
            for limit in origin.range or ():
                si_limit = quantity.dimension.to_si(limit, origin.unit)
                if not quantity.holds(si_limit):
                    yield Location(source, (key, "range")).problem(
                        f"it goes to {shown(limit)}",
                        quantity.range_text(origin.unit),
                        "Give a range in which every value is possible.",
                    )

    def _inconsistencies(self, source: Source) -> Iterator[InputError]:
        """Yield contradictions between values that are each within their range."""
        yield from ()

    def __setattr__(self, key: str, value: Any) -> None:
        raise InputError(
            f"{key} cannot be set, because a {self.noun} stays as it was checked",
            remedy=f"Make another one: new = old.replace({key}=...).",
        )

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and vars(other) == vars(self)

    def __hash__(self) -> int:
        return hash(tuple(vars(self).values()))

    def written(self, key: str, si_value: float | None = None) -> str:
        """Write a quantity, or another value for it, in the unit in which it was given."""
        value = getattr(self, key) if si_value is None else si_value
        unit = self.provenance[key].unit
        return dimensions(type(self))[key].text(value, unit)

    def __repr__(self) -> str:
        title = f": {self.title}" if self.title else ""
        return f"<{type(self).__name__} {self.name}{title}>"

    __str__ = __repr__

    def _repr_html_(self) -> str:
        rows = [
            [key, origin.written, TAGS[origin.tag], origin.note] for key, origin in self._provenance
        ]
        title = repr(self)[1:-1]
        headings = ["quantity", "value", "where it comes from", "note"]
        return html_overview(title, headings, rows)

    @property
    def provenance(self) -> Mapping[str, Provenance]:
        """Origin of every quantity with a value, by key: value and unit as written, tag, note."""
        return MappingProxyType(dict(self._provenance))

    @classmethod
    def _shipped(cls) -> Traversable:
        return resources.files(cls.__module__.rpartition(".")[0]) / "catalogue"

    @classmethod
    def catalogue(cls) -> list[str]:
        """Names that `read` accepts beside the path of a file."""
        files = (item.name for item in cls._shipped().iterdir())
        return sorted(name.removesuffix(".yaml") for name in files if name.endswith(".yaml"))

    @classmethod
    def read(cls, source: str | PathLike[str]) -> Self:
        """Read a shipped record or a file of the user's, to SI units.

        Raises InputError if there is no such file or name, or the content is wrong; the message
        names file, line and key. `source` is a name from `catalogue()`, which wins over a file of
        the same name, or the path of a YAML file.
        """
        name = fspath(source)
        names = cls.catalogue()
        if name in names:
            return _shipped_record(cls, name)
        text = read_text(
            Path(name),
            f"no {cls.noun} can be read from {shown(name)}",
            allowed=f"the path of a YAML file, or a catalogue name: {', '.join(names)}",
            remedy=f"Relative paths start at {Path.cwd()}.",
        )
        return cls.from_dict(*parse(text, name))

    @classmethod
    def from_dict(cls, entries: Mapping[str, Any], source: Source | None = None) -> Self:
        """Build a record from the content of a catalogue file, which `as_dict` gives.

        Errors are those of `read`. `source` says where it was written, for messages.
        """
        source = source or Source()
        fields = _in_file(cls)
        if entries and not entries.keys() & fields.keys():
            # Another kind of file: its keys may be private and are left out of the message.
            raise InputError(
                f"none of its keys is one of a {cls.noun}",
                where=source.file,
                allowed=", ".join(fields),
                remedy=f"Name a {cls.noun} file.",
            )
        # A missing value is reported later: it may follow from others.
        optional = {key: member._replace(is_required=False) for key, member in fields.items()}
        entries_read, problems = read_keys(
            optional, entries, Context(Location(source), in_file=True)
        )
        for part in problems:
            # In the record's own file; a case file that names it adds its own location.
            part.is_located = False
        if problems:
            raise together(problems)
        for section in cls.sections.keys() & entries_read.keys():
            inside = entries_read.pop(section)
            entries_read |= {f"{section}_{key}": value for key, value in inside.items()}
        lines = {}
        for keys, line in source.lines.items():
            if keys[0] in cls.sections and keys[1:]:
                section, key, *inner = keys
                keys = (f"{section}_{key}", *inner)
            lines[keys] = line
        units = dimensions(cls)
        origins = {}
        values = dict(entries_read)
        for key, entry in entries_read.items():
            if isinstance(entry, Provenance):
                origins[key] = entry
                values[key] = units[key].to_si(entry.value, entry.unit)
        record = cls.__new__(cls)
        record._fill(values, origins, Source(source.file, lines))
        return record

    def require(self, *keys: str, purpose: str) -> None:
        """Refuse a record that lacks quantities which a purpose needs.

        A purpose is text such as "the physical model". The InputError names all that are missing,
        and the form to add them in.

        Examples
        --------
        >>> from macroslip.bearing import Bearing
        >>> bearing = Bearing.read("skf-240-600-bc").replace(name="mine", mass=None)
        >>> bearing.require("mass", purpose="the cage")  # doctest: +ELLIPSIS
        Traceback (most recent call last):
            ...
        macroslip.errors.InputError: bearing mine: it has no mass, which the cage needs. ...
        """
        missing = [key for key in keys if getattr(self, key) is None]
        if missing:
            known = quantities(type(self))
            raise InputError(
                f"it has no {', no '.join(missing)}, which {purpose} needs",
                where=f"{self.noun} {self.name}",
                allowed="; ".join(f"{key}: {known[key].range_text()}" for key in missing),
                remedy="Add to its file: "
                + ", ".join(
                    f"{key}: {{value: ..., unit: {known[key].dimension.choices}}}"
                    for key in missing
                ),
            )

    def as_dict(self) -> dict[str, Any]:
        """Give the record in the form of a catalogue file, with plain numbers and text only.

        Quantities and words without a value, and quantities that follow from others, are left out. `from_dict`
        makes an equal record of it.
        """
        origins = self.provenance
        kinds = dimensions(type(self))
        words = {key for key in fields_of(type(self)) if key not in kinds}
        words = {key for key in words if getattr(self, key) is not None}
        keys = [key for key in fields_of(type(self)) if key in origins or key in words]
        keys = [key for key in keys if key not in self._derived]
        return self._nested(
            {
                key: origins[key].as_entry() if key in origins else getattr(self, key)
                for key in keys
            },
            {},
        )

    def _nested(self, entries: Mapping[str, Any], content: dict[str, Any]) -> dict[str, Any]:
        """Put entries by field into the content of a file, those of a section inside it."""
        for key, entry in entries.items():
            section = next((name for name in self.sections if key.startswith(f"{name}_")), "")
            inside = content.setdefault(section, {}) if section else content
            inside[key.removeprefix(f"{section}_") if section else key] = entry
        return content

    def with_entries(self, entries: Mapping[str, Any]) -> Self:
        """Copy the record with other entries, by field, as a catalogue file has them."""
        return type(self).from_dict(self._nested(entries, self.as_dict()))

    def as_yaml(self) -> str:
        """Text of a catalogue file with every key explained; `read` gives the record back."""
        explained = {key: member.form.about for key, member in fields_of(type(self)).items()}
        explained |= self.sections
        return yaml_text(self.as_dict(), _HEADER.format(self.noun), explained)

    def replace(self, **values: Any) -> Self:
        """Copy the record with other values [SI], which are checked and get the tag U."""
        kept = {key: origin for key, origin in self._provenance if key not in values}
        given = [key for key in fields_of(type(self)) if key not in self._derived]
        own = {key: getattr(self, key) for key in given}
        record = type(self).__new__(type(self))
        record._fill(own | values, kept, Source())
        return record

    @classmethod
    def json_schema(cls) -> dict[str, Any]:
        """JSON Schema (2020-12) of the file format, for editors and programs."""
        about = {
            "$schema": "https://json-schema.org/draft/2020-12/schema",
            "title": f"{cls.noun} of macroslip",
        }
        return about | Section("", _in_file(cls)).json()


@functools.cache
def fields_of(record: type[Record]) -> Fields:
    """Fields of a record class by key."""
    fields = {}
    for key, hint in get_type_hints(record, include_extras=True).items():
        if hasattr(hint, "__metadata__"):
            required = not hasattr(record, key)
            others = " and ".join(record.sources.get(key, ()))
            remedy = (
                f"Add it, or the figures of a data sheet from which it follows: {others}."
                if others
                else "Add it."
            )
            fields[key] = Field(
                form_from(hint), required, not required, getattr(record, key, None), remedy
            )
    return fields


@functools.cache
def _in_file(record: type[Record]) -> Fields:
    """Fields as a file has them: quantities as entries, and sections; derived may be missing."""
    fields = {}
    for key, member in fields_of(record).items():
        form = member.form
        if isinstance(form, Quantity):
            form = _Entry(f"{form.about}: {form.range_text()}", form)
        fields[key] = member._replace(
            form=form, is_required=member.is_required and key not in record.sources
        )
    keys = {
        name: tuple(key for key in fields if key.startswith(f"{name}_")) for name in record.sections
    }
    groups = {name: (about, keys[name]) for name, about in record.sections.items()}
    return grouped(fields, groups)


@functools.cache
def quantities(record: type[Record]) -> Mapping[str, Quantity]:
    """Quantities of a record class by key; fields of plain text have none."""
    forms = {key: member.form for key, member in fields_of(record).items()}
    return {key: form for key, form in forms.items() if isinstance(form, Quantity)}


def dimensions(record: type[Record]) -> Mapping[str, Dimension]:
    """Dimensions of the quantities of a record class, by key."""
    return {key: quantity.dimension for key, quantity in quantities(record).items()}


@functools.cache
def _shipped_record(kind: type[Record], name: str) -> Any:
    """Read a shipped record. No record ever changes, so all users of one share it."""
    file = f"{name}.yaml"
    return kind.from_dict(*parse((kind._shipped() / file).read_text(encoding="utf-8"), file))
