"""Base of the records that come from catalogue files: frozen SI values, checked once, each with its provenance."""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping
from importlib import resources
from importlib.resources.abc import Traversable
from os import PathLike, fspath
from pathlib import Path
from types import MappingProxyType
from typing import Any, ClassVar, Self

from pydantic import BaseModel, ConfigDict, PrivateAttr, ValidationError

from macroslip.catalogue.entry import TAGS, Provenance, plain_number, read_entry
from macroslip.catalogue.fields import dimensions, schema
from macroslip.catalogue.problems import shown, together, unknown_key
from macroslip.catalogue.record_problems import (
    lacking_values,
    missing_keys,
    unusable_values,
    unwritable_texts,
    wide_ranges,
)
from macroslip.catalogue.source import Source, parse, read_text
from macroslip.catalogue.yaml_text import yaml_text
from macroslip.errors import InputError
from macroslip.overview import html_overview


class Record(BaseModel):
    """A named set of quantities that can be read from a catalogue file or built from SI numbers.

    A subclass declares every quantity as `Annotated[float, DIMENSION, Field(gt=..., le=..., description=...)]` with its
    bounds in SI, and keeps its shipped files in the folder `catalogue` of its own package.

    Raises
    ------
    InputError
        If a value is missing, unknown, no finite number, out of its range, or inconsistent with the others. All such
        problems are reported together.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)
    noun: ClassVar[str] = "record"
    # Quantities that may be left out of a file because they follow from others that it gives.
    derivable: ClassVar[frozenset[str]] = frozenset()
    # Pairs instead of a mapping keep the record hashable and picklable.
    _provenance: tuple[tuple[str, Provenance], ...] = PrivateAttr(default=())
    _derived: frozenset[str] = PrivateAttr(default=frozenset())

    def __init__(self, **values: Any):
        self._fill(values, {}, Source())

    def _fill(
        self,
        values: Mapping[str, Any],
        provenance: Mapping[str, Provenance],
        source: Source,
        derived: frozenset[str] = frozenset(),
    ) -> None:
        """Check SI values and fill the record; a quantity without provenance is the user's, in SI."""
        kinds = dimensions(type(self))
        fields = type(self).model_fields
        values = {
            key: plain_number(value, whole=fields[key].annotation is int) if key in kinds else value
            for key, value in values.items()
        }
        provenance = {
            key: provenance.get(key) or Provenance(values[key], kind.si_unit)
            for key, kind in kinds.items()
            if values.get(key) is not None
        }
        try:
            super().__init__(**values)
        except ValidationError as failure:
            missing, unusable = unusable_values(type(self), failure, provenance, source)
            raise together([*([self._missing(missing, source)] if missing else []), *unusable]) from None
        self._provenance, self._derived = tuple(provenance.items()), derived
        problems = [*unwritable_texts(self, source), *wide_ranges(self, source), *self._inconsistencies(source)]
        if problems:
            raise together(problems)

    @classmethod
    def _missing(cls, keys: list[str], source: Source) -> InputError:
        """The error for missing keys; a subclass adds other ways to give them."""
        return missing_keys(cls, keys, source)

    def __setattr__(self, key: str, value: Any) -> None:
        if not key.startswith("_"):
            raise InputError(
                f"{key} cannot be set, because a {self.noun} stays as it was checked",
                remedy=f"Make another one: new = old.replace({key}=...).",
            )
        super().__setattr__(key, value)

    def _inconsistencies(self, source: Source) -> Iterator[InputError]:
        """Yield what is wrong with values that are each within their range."""
        yield from ()

    def written(self, key: str, si_value: float | None = None) -> str:
        """Write a quantity, or another value for it, in the unit in which the quantity was given."""
        value = getattr(self, key) if si_value is None else si_value
        return dimensions(type(self))[key].text(value, self.provenance[key].unit)

    def __repr__(self) -> str:
        title = f": {self.title}" if self.title else ""
        return f"<{type(self).__name__} {self.name}{title}>"

    __str__ = __repr__

    def _repr_html_(self) -> str:
        origins = self.provenance.items()
        rows = [[key, origin.written, TAGS[origin.tag], origin.note] for key, origin in origins]
        return html_overview(repr(self)[1:-1], ["quantity", "value", "where it comes from", "note"], rows)

    @property
    def provenance(self) -> Mapping[str, Provenance]:
        """Origin of every quantity that has a value, by key: value and unit as written, tag and note."""
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
        """Read a shipped record or a file of the user's.

        Parameters
        ----------
        source : str | PathLike
            A name from `catalogue()`, or the path of a YAML file. A name wins over a file of the same name.

        Returns
        -------
        Self
            The record in SI units.

        Raises
        ------
        InputError
            If there is no such file or name, or the content is wrong; the message names file, line and key.
        """
        name, names = fspath(source), cls.catalogue()
        if name in names:
            return _shipped_record(cls, name)
        text = read_text(
            Path(name),
            f"no {cls.noun} can be read from {shown(name)}",
            allowed=f"the path of a YAML file, or a catalogue name: {', '.join(names)}",
            remedy=f"Relative paths start at {Path.cwd()}.",
        )
        return cls._from_entries(*parse(text, name))

    @classmethod
    def from_dict(cls, entries: Mapping[str, Any]) -> Self:
        """Build a record from the content of a catalogue file, as `as_dict` gives it.

        Parameters
        ----------
        entries : Mapping[str, Any]
            Text fields as text, quantities as mappings with value, unit and optionally tag and note.

        Raises
        ------
        InputError
            As `read`, without file and line.
        """
        return cls._from_entries(entries, Source())

    @classmethod
    def _from_entries(cls, entries: Mapping[str, Any], source: Source) -> Self:
        values: dict[str, Any] = {}
        provenance: dict[str, Provenance] = {}
        problems: list[InputError] = []
        if entries and not entries.keys() & cls.model_fields.keys():
            # Another kind of file: its keys may be private and are left out of the message.
            raise InputError(
                f"none of its keys is one of a {cls.noun}",
                where=source.file,
                allowed=", ".join(cls.model_fields),
                remedy=f"Name a {cls.noun} file.",
            )
        for key, entry in entries.items():
            try:
                if key not in cls.model_fields:
                    raise unknown_key(key, cls.model_fields, where=source.where(key))
                if key in dimensions(cls):
                    values[key], provenance[key] = read_entry(key, entry, dimensions(cls)[key], source)
                else:
                    values[key] = entry
            except InputError as problem:
                problems.append(problem)
        if problems:
            raise together(problems)
        record = cls.__new__(cls)
        record._fill(values, provenance, source)
        return record

    def require(self, *keys: str, purpose: str) -> None:
        """Refuse a record that lacks optional quantities something needs.

        Parameters
        ----------
        *keys : str
            Names of the quantities.
        purpose : str
            What needs them, for the message, for example "the physical model".

        Raises
        ------
        InputError
            If a quantity has no value; the message names all that are missing, and the form to add them in.

        Examples
        --------
        >>> from macroslip.bearing import Bearing
        >>> bearing = Bearing.read("skf-240-600-bc").replace(name="mine", mass=None)
        >>> bearing.require("mass", purpose="the cage")  # doctest: +ELLIPSIS
        Traceback (most recent call last):
            ...
        macroslip.errors.InputError: bearing mine: it has no mass, which the cage needs. Allowed: ...
        """
        missing = [key for key in keys if getattr(self, key) is None]
        if missing:
            raise lacking_values(self, missing, purpose)

    def as_dict(self) -> dict[str, Any]:
        """Give the record in the form of a catalogue file, with plain numbers and text only.

        Returns
        -------
        dict
            Text fields as text, quantities as value and unit as written, tag, note and, where it is known, range.
            Quantities without a value, and those that follow from others, are left out. `from_dict` makes an equal
            record of it.
        """
        entries: dict[str, Any] = {}
        for key in type(self).model_fields:
            if key in self._derived:
                continue
            if key in self.provenance:
                entries[key] = self.provenance[key].as_entry()
            elif key not in dimensions(type(self)):
                entries[key] = getattr(self, key)
        return entries

    def as_yaml(self) -> str:
        """Give the record as the text of a catalogue file, every key explained; `read` gives it back as it is."""
        return yaml_text(self.as_dict(), self.noun, type(self).model_fields)

    def replace(self, **values: Any) -> Self:
        """Copy the record with other values, checked as any other input.

        Parameters
        ----------
        **values : Any
            New values [SI] by key. They get the tag U; the others keep their provenance.

        Raises
        ------
        InputError
            As the constructor.
        """
        kept = {key: origin for key, origin in self.provenance.items() if key not in values}
        given = {key: getattr(self, key) for key in type(self).model_fields if key not in self._derived}
        record = type(self).__new__(type(self))
        record._fill(given | values, kept, Source())
        return record

    def model_copy(self, *, update: Mapping[str, Any] | None = None, deep: bool = False) -> Self:
        """Copy the record; with `update` as `replace`, which checks the new values.

        Raises
        ------
        InputError
            As the constructor.
        """
        return self.replace(**update) if update else super().model_copy(deep=deep)

    @classmethod
    def json_schema(cls) -> dict[str, Any]:
        """JSON Schema (2020-12) of the file format, for editors and for programs that write such files."""
        return schema(cls, f"{cls.noun} of macroslip", TAGS, cls.derivable)


@functools.cache
def _shipped_record(kind: type[Record], name: str) -> Any:
    """Read a shipped record. No record ever changes, so all users of one share it."""
    file = f"{name}.yaml"
    return kind._from_entries(*parse((kind._shipped() / file).read_text(encoding="utf-8"), file))
