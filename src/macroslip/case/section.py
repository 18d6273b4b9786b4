"""Sections of a case file: keys that belong together, read as far as they are right, so that all problems are told.

A section's `read(value, place, problems)` appends what is wrong to `problems`, and returns the keys without problems.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any

from macroslip.case.form import Choice, Place
from macroslip.catalogue.problems import shown, unknown_key
from macroslip.errors import InputError


@dataclass(frozen=True)
class Section:
    """A mapping with known keys; or a word, which reads as None.

    `one_of` are keys of which exactly one has to be there.
    """

    about: str
    keys: Mapping[str, Any]
    required: tuple[str, ...] = ()
    one_of: tuple[str, ...] = ()
    word: str = ""

    @property
    def form(self) -> str:
        """What is accepted, in words."""
        return f"a section with the keys {', '.join(self.keys)}"

    def read(self, value: Any, place: Place, problems: list[InputError]) -> dict[str, Any] | None:
        """Read every key to SI units; one with a problem anywhere inside is left out."""
        if self.word and value == self.word:
            return None
        if value is None and not self.word:  # every key of the section is commented out
            value = {}
        if not isinstance(value, Mapping):
            allowed = f"{self.word} or {self.form}" if self.word else self.form
            problems.append(place.problem(f"it is {shown(value)}", allowed))
            return {}
        found: dict[str, Any] = {}
        for key, item in value.items():
            if key not in self.keys:
                where = place.source.where(*place.keys, key)
                problems.append(unknown_key(key, self.keys, where=where, inside=place.key))
                continue
            kind, before = self.keys[key], len(problems)
            try:
                nested = (problems,) if isinstance(kind, (Section, Variants)) else ()
                result = kind.read(item, place.inside(key), *nested)
            except InputError as problem:
                problems.append(problem)
            if len(problems) == before:
                found[key] = result
        problems += self._missing_or_excluded(value, place)
        return found

    def _missing_or_excluded(self, value: Mapping[str, Any], place: Place) -> list[InputError]:
        """Required keys that are absent, and keys that exclude each other."""
        # A misspelled key has been told already, with the key that was meant.
        unknown = [str(key) for key in value if key not in self.keys]
        meant = [*value, *(close for key in unknown for close in get_close_matches(key, self.keys, n=1))]
        wrong = [
            place.problem(f"'{key}' is missing ({self.keys[key].about})", self.keys[key].form, "Add it.")
            for key in self.required
            if key not in meant
        ]
        chosen = [key for key in self.one_of if key in meant]
        if self.one_of and len(chosen) != 1:
            what = f"{' and '.join(chosen)} stand together" if chosen else "none of the keys it needs is there"
            remedy = "Remove or comment out the others." if chosen else "Add one of them."
            wrong.append(place.problem(what, f"exactly one of {', '.join(self.one_of)}", remedy))
        return wrong

    def schema(self) -> dict[str, Any]:
        """An object without other keys, or the word."""
        properties = {key: kind.schema() for key, kind in self.keys.items()}
        result: dict[str, Any] = {"type": "object", "properties": properties, "additionalProperties": False}
        if self.required:
            result["required"] = list(self.required)
        if self.one_of:
            result["oneOf"] = [{"required": [key]} for key in self.one_of]
        if self.word:
            return {"anyOf": [{"const": self.word}, result], "description": self.about}
        return result | {"description": self.about}


@dataclass(frozen=True)
class Variants:
    """A section whose keys depend on the name that stands under one of them."""

    about: str
    key: str
    default: str
    sections: Mapping[str, Section]

    def read(self, value: Any, place: Place, problems: list[InputError]) -> dict[str, Any] | None:
        """Read the section that the name asks for; the name itself comes back under `key`."""
        name = value.get(self.key, self.default) if isinstance(value, Mapping) else self.default
        names = list(self.sections)
        try:
            Choice(self.about, lambda: names).read(name, place.inside(self.key))
        except InputError as problem:
            problems.append(problem)
            return None
        found = self.sections[name].read(value, place, problems)
        return found if found is None else found | {self.key: name}

    def schema(self) -> dict[str, Any]:
        """One object a name."""
        variants = []
        for name, section in self.sections.items():
            variant = section.schema()
            variant["properties"] = {**variant["properties"], self.key: {"const": name}}
            if name != self.default:
                variant["required"] = [self.key, *variant.get("required", [])]
            variants.append(variant)
        return {"oneOf": variants, "description": self.about}
