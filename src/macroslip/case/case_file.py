"""From a case file to a `Case`; whatever is wrong with the file is reported together, each with its line and remedy."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict
from difflib import get_close_matches
from os import PathLike
from pathlib import Path
from typing import Any

from macroslip.bearing import Bearing
from macroslip.case.case import Case
from macroslip.case.keys import LOAD_SOURCES, CaseFile, LawsKeys, LoadsKeys
from macroslip.catalogue import Record
from macroslip.catalogue.input_section import read_fields
from macroslip.catalogue.problems import shown, together
from macroslip.catalogue.section_forms import json_schema
from macroslip.catalogue.source import Place, Source, parse, read_text
from macroslip.errors import InputError
from macroslip.loads import BearingLoads, HubLoads
from macroslip.lubricant import Lubricant
from macroslip.mechanisms import Laws

# Advice for programs, in the words of a case file.
_ADVICE = {
    "read it with BearingLoads.read": "name it under bearing_file",
    "read it with HubLoads.read, then main_bearing_load": "name it under file",
    "become bearing loads by main_bearing_load(HubLoads.read(path), Drivetrain())": "belong under file",
    "(start=, end=)": "(loads.start, loads.end)",
}


def read_case(path: str | PathLike[str]) -> Case:
    """Read a case file.

    Parameters
    ----------
    path : path
        YAML file; `macroslip init` writes one with every key explained. Every quantity carries its unit. Relative paths
        in it start at its own folder.

    Returns
    -------
    Case
        In SI units.

    Raises
    ------
    InputError
        If the file cannot be read, or anything in it is wrong: all problems together, each with file, line and key.
    """
    path = Path(path)
    remedy = "Write a case file that runs with: macroslip init"
    text = read_text(path, "the case file cannot be read", where=str(path), remedy=remedy)
    data, source = parse(text, str(path), remedy)
    if "case" in data:
        raise InputError("this is a study file, not a case file", where=str(path), remedy="Run it by macroslip study.")
    return CaseBuilder(data, source, path.parent).case()


def files_named_in(path: Path) -> list[Path]:
    """Files that a case file names: bearing, lubricant and loads. None of a file that cannot be read."""
    try:
        data, _ = parse(read_text(path, "the case file cannot be read"), str(path))
    except InputError:
        return []  # the reader of the case reports what is wrong with it
    loads = data.get("loads")
    named = [data.get("bearing"), data.get("lubricant")]
    named += [loads.get("file"), loads.get("bearing_file")] if isinstance(loads, Mapping) else []
    return [path.parent / name for name in named if isinstance(name, str) and "\0" not in name]


def case_schema() -> dict[str, Any]:
    """JSON Schema (2020-12) of the case file, for editors and for programs that write such files."""
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "case of macroslip",
        **json_schema(CaseFile),
    }


class CaseBuilder:
    """Turns the content of a case file into the parts of a case, and remembers every problem on the way."""

    def __init__(self, data: Mapping[str, Any], source: Source, folder: Path):
        self.place, self.folder = Place(source), folder
        self.values, self.problems = read_fields(CaseFile, data, self.place)
        self.is_bearing_wrong = "bearing" in data and "bearing" not in self.values

    def case(self) -> Case:
        """Build the case, or raise all problems."""
        parts: dict[str, Any] = {}
        for key, build in _PARTS.items():
            if self.values.get(key) is not None:  # left out, wrong, or switched off by a word
                try:
                    parts |= {key: self.values[key]} if build is None else build(self, self.values[key])
                except InputError as problem:
                    self.problems.append(self.located(problem, key))
        self.check_against_loads(parts)
        if self.problems:
            raise together(self.problems)
        case = Case(**parts)
        self.check_lubricant(case)
        return case

    def laws(self, given: LawsKeys) -> dict[str, Any]:
        """The named set with what differs from it."""
        differs = {key: value for key, value in asdict(given).items() if key != "model" and value is not None}
        return {"laws": Laws.named(given.model).but(**differs)}

    def check_lubricant(self, case: Case) -> None:
        """Check before the loads are computed that the lubricant has what the mechanisms need."""
        if case.laws == Laws.paper():  # it needs nothing that a lubricant may lack
            return
        from macroslip.contact.laws import check_lubricant

        check_lubricant(case.laws, case.lubricant)

    def located(self, problem: InputError, key: str) -> InputError:
        """The problem with file and line in front, unless it has them."""
        if problem.where.startswith(f"{self.place.where}, "):
            return problem
        keys = problem.where.split(".")
        return self.place.inside(*keys if keys[0] == key else [key]).blamed(problem)

    def check_against_loads(self, parts: Mapping[str, Any]) -> None:
        """Check one by one what depends on bearing and loads: a case by itself stops at its first problem."""
        if "loads" not in parts or self.is_bearing_wrong or (self.values.get("bearing") and "bearing" not in parts):
            return
        common = {key: parts[key] for key in ("loads", "bearing") if key in parts}
        for keys in (("rollers",), ("window",), ("traces",), ("dynamics", "integrator", "cage")):
            given = {key: parts[key] for key in keys if key in parts}
            if given:
                try:
                    Case(**common, **given)
                except InputError as problem:
                    blamed = problem.where.partition(".")[0]
                    self.problems.append(self.located(problem, blamed if blamed in keys else keys[0]))

    def record(self, kind: type[Record], name: str) -> Record:
        """Read a bearing or lubricant by catalogue name or path."""
        names, path = kind.catalogue(), self.folder / name
        if name in names:
            return kind.read(name)
        if not path.exists():
            close = get_close_matches(name, names, n=1)
            raise InputError(
                f"{shown(name)} is neither in the catalogue nor a file",
                where=kind.noun,
                allowed=f"{', '.join(names)}, or the path of a {kind.noun} file",
                remedy=f"Did you mean {close[0]}?" if close else self.start_of_paths,
            )
        return kind.read(path)

    @property
    def start_of_paths(self) -> str:
        """Where relative paths start, in words."""
        return f"Relative paths start at {self.folder.resolve()}."

    def loads(self, given: LoadsKeys) -> HubLoads | BearingLoads:
        """Read or make the loads."""
        (source,) = (key for key in LOAD_SOURCES if getattr(given, key) is not None)
        cut = {key: getattr(given, key) for key in ("start", "end") if getattr(given, key) is not None}
        value, place = getattr(given, source), self.place.inside("loads", source)
        try:
            if given.shaft_speed is not None:
                if source != "file":
                    raise InputError(
                        f"shaft_speed is given, but {source} has its own",
                        remedy="Remove loads.shaft_speed; it serves hub loads from a file only.",
                    )
                cut["shaft_speed"] = given.shaft_speed
            if source in ("hub", "main_bearing"):
                if cut:
                    raise InputError(
                        f"{' and '.join(cut)} would cut a series, but these loads are constant",
                        remedy=f"Remove them; loads.{source}.duration says how long.",
                    )
                return (HubLoads if source == "hub" else BearingLoads).constant(**asdict(value))
            if source == "bundled":
                return HubLoads.bundled(value).window(cut.get("start"), cut.get("end"))
            path = self.folder / value
            if not path.exists():
                raise InputError(f"there is no file '{value}'", remedy=self.start_of_paths)
            return (HubLoads if source == "file" else BearingLoads).read(path, **cut)
        except InputError as problem:
            for programs_words, words in _ADVICE.items():
                problem.remedy = problem.remedy.replace(programs_words, words)
            raise place.blamed(problem) from None


#: How each key of a case file becomes parts of a case; None: its value is the part.
_PARTS: dict[str, Callable[[CaseBuilder, Any], dict[str, Any]] | None] = {
    "bearing": lambda builder, name: {"bearing": builder.record(Bearing, name)},
    "lubricant": lambda builder, name: {"lubricant": builder.record(Lubricant, name)},
    "temperature": None,
    "heat": None,
    "loads": lambda builder, given: {"loads": builder.loads(given)},
    "drivetrain": None,
    "forces": lambda builder, given: asdict(given),
    "laws": CaseBuilder.laws,
    "dynamics": None,
    "cage": None,
    "integrator": None,
    "window": None,
    "rollers": None,
    "traces": None,
    "contact_details": None,
    "rating": None,
}
