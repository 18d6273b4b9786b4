"""Reader of case files: builds a `Case`, and reports all problems together.

Whatever is wrong with the file is reported together, each with its line and remedy.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from os import PathLike
from pathlib import Path
from typing import Any

from macroslip.bearing.kinds import AnyBearing, bearing_catalogue, read_bearing
from macroslip.case.case import BALANCE, Case
from macroslip.case.load_source import LoadSource
from macroslip.contact.mechanisms import check_lubricant
from macroslip.errors import InputError
from macroslip.input.files import Location, Source, parse, read_text
from macroslip.input.messages import nearest, parts_of, shown, together
from macroslip.input.record import Record
from macroslip.input.section import fields_of, json_schema, read_fields
from macroslip.loads import BearingLoads, HubLoads, RollerLoads
from macroslip.loads.statics import BEARINGS
from macroslip.loads.windio import windio_values
from macroslip.lubricant import Lubricant

#: Value of `drivetrain.bearing` that stands for two cases.
BOTH = "both"


def read_case(path: str | PathLike[str], *, bearing: str = "") -> Case:
    """Read a case file.

    `macroslip init` writes one with every key explained. Every quantity carries its unit. Relative
    paths in it start at its own folder. Of a file with `drivetrain.bearing: both`, `bearing` is the
    one that is meant, front or rear. Raises InputError if the file cannot be read, or anything in
    it is wrong: all problems together, each with file, line and key.
    """
    path = Path(path)
    data, source = _content(path)
    if bearing:
        data["drivetrain"]["bearing"] = bearing
    if "case" in data:
        raise InputError(
            "this is a study file, not a case file",
            where=str(path),
            remedy="Run it by macroslip study.",
        )
    case = build_case(data, source, path.parent)
    if (
        case.heat is not None and case.temperature != BALANCE
    ):  # a case of a balance that was found keeps its heat
        raise Location(source, ("heat",)).problem(
            "only a balance of heat uses it",
            allowed="with temperature: balance",
            remedy="Set temperature: balance, or remove heat.",
        )
    return case


def files_named_in(path: Path) -> list[Path]:
    """Files that a case file names: bearing, lubricant and loads.

    None of a file that cannot be read.
    """
    try:
        data, _ = _content(path)
    except InputError:
        return []  # the reader of the case reports its faults
    loads = data.get("loads")
    drivetrain = data.get("drivetrain")
    named = [data.get("bearing"), data.get("lubricant")]
    if isinstance(drivetrain, Mapping):
        named.append(drivetrain.get("windio"))
    if isinstance(loads, Mapping):
        named += [loads.get(key) for key in ("file", "bearing_file", "roller_loads")]
    texts = [name for name in named if isinstance(name, str)]
    return [path.parent / name for name in texts if "\0" not in name]


def names_key(path: Path, key: str) -> bool:
    """True if a readable case file has a key."""
    return key in _content(path)[0]


def bearings_in(path: Path) -> tuple[str, ...]:
    """The main bearings that a case file means by `drivetrain.bearing: both`.

    Otherwise one, without a name.
    """
    drivetrain = _content(path)[0].get("drivetrain")
    return (
        BEARINGS if isinstance(drivetrain, Mapping) and drivetrain.get("bearing") == BOTH else ("",)
    )


def load_source(path: Path) -> LoadSource:
    """The section `loads` of a valid case file."""
    data, source = _content(path)
    content = {"loads": data["loads"]}
    values, _ = read_fields(Case, content, Location(source))
    return values["loads"]


def _content(path: Path) -> tuple[dict[Any, Any], Source]:
    remedy = "Write a case file that runs with: macroslip init"
    return parse(
        read_text(path, "the case file cannot be read", where=str(path), remedy=remedy),
        str(path),
        remedy,
    )


def case_schema() -> dict[str, Any]:
    """JSON Schema (2020-12) of the case file, for editors and programs that write such files."""
    schema = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "case of macroslip",
    } | json_schema(Case)
    drivetrain = schema["properties"]["drivetrain"]["properties"]
    drivetrain["bearing"]["enum"].append(BOTH)
    return schema


def build_case(
    data: Mapping[str, Any],
    source: Source,
    folder: Path,
    *,
    records: Mapping[str, Record] | None = None,
    series: Callable[[LoadSource], HubLoads | BearingLoads | RollerLoads] | None = None,
) -> Case:
    """Build a case from the content of a case file.

    Parameters
    ----------
    data : mapping
        Content of the case file by its keys.
    source : Source
        Where it was written, for messages.
    folder : Path
        Where relative paths start.
    records : mapping, optional
        `bearing` and `lubricant` that have been read already, in place of those that the file
        names.
    series : callable, optional
        Makes the loads of their section; they are read by default.

    Returns
    -------
    Case

    Raises
    ------
    InputError
        If anything is wrong, with all that is.
    """
    location = Location(source)
    known = records or {}
    parts = {}
    data, unread = _with_windio(data, location, folder)
    values, problems = read_fields(Case, data, location)
    problems += unread
    for key, value in values.items():
        inner = (key,)
        if isinstance(value, LoadSource):
            inner = (key, value.key)
        try:
            if key in ("bearing", "lubricant"):
                parts[key] = known.get(key) or _record(key, value, folder)
            elif isinstance(value, LoadSource):
                parts[key] = series(value) if series else value.series(folder)
            elif key == "forces":  # a section in files only
                parts |= value
            else:
                parts[key] = value
        except InputError as problem:
            problems.append(location.inside(*inner).blamed(problem))
    wrong = set()
    for key in fields_of(Case).keys() & data.keys():
        if key != "forces" and key not in parts:
            wrong.add(key)
    case = None
    if "loads" in parts and "bearing" not in wrong:
        try:
            case = Case(**parts)
        except InputError as failure:
            for part in parts_of(failure):
                keys = part.where.split(".")
                if keys[0] not in wrong:
                    problems.append(location.inside(*keys).blamed(part))
    if problems or case is None:
        raise together(problems)
    check_lubricant(case.laws, case.lubricant)
    return case


def _with_windio(
    data: Mapping[str, Any], location: Location, folder: Path
) -> tuple[Mapping[str, Any], list[InputError]]:
    """Content of a case with the values of the windIO file that its drivetrain names.

    A file that cannot be used leaves the drivetrain out, and is reported.
    """
    drivetrain = data.get("drivetrain")
    if not isinstance(drivetrain, Mapping):
        return data, []
    name = drivetrain.get("windio")
    if not isinstance(name, str) or "\0" in name:
        return data, []
    try:
        values = windio_values(folder / name, drivetrain)
    except InputError as problem:
        without = {key: value for key, value in data.items() if key != "drivetrain"}
        own_key = location.inside("drivetrain", "windio")
        return without, [own_key.blamed(problem)]
    written = {}
    for key, value in values.items():
        written[key] = value
        if isinstance(value, float):
            unit = "rad" if key == "tilt" else "m"
            written[key] = f"{value!r} {unit}"
    with_values = {**drivetrain, **written}
    return {**data, "drivetrain": with_values}, []


def _record(noun: str, name: str, folder: Path) -> AnyBearing | Lubricant:
    """Read a bearing or a lubricant of the catalogue, or its file."""
    is_bearing = noun == "bearing"
    names = bearing_catalogue() if is_bearing else Lubricant.catalogue()
    read = read_bearing if is_bearing else Lubricant.read
    path = folder / name
    if name in names:
        return read(name)
    if not path.exists():
        close = nearest(name, names)
        raise InputError(
            f"{shown(name)} is neither in the catalogue nor a file",
            where=noun,
            allowed=f"{', '.join(names)}, or the path of a {noun} file",
            remedy=f"Did you mean {close}?"
            if close
            else f"Relative paths start at {folder.resolve()}.",
        )
    return read(path)
