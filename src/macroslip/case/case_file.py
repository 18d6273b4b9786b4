"""From a case file to a `Case`; whatever is wrong with the file is reported together, each with its line and remedy."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from os import PathLike
from pathlib import Path
from typing import Any

from macroslip.bearing import Bearing
from macroslip.case.case import Case
from macroslip.case.load_source import LoadSource
from macroslip.contact.mechanisms import Laws
from macroslip.errors import InputError
from macroslip.input.files import Place, Source, parse, read_text
from macroslip.input.messages import nearest, parts_of, shown, together
from macroslip.input.record import Record
from macroslip.input.section import fields_of, json_schema, read_fields
from macroslip.loads import BearingLoads, HubLoads
from macroslip.lubricant import Lubricant


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
    return build_case(data, source, path.parent)


def files_named_in(path: Path) -> list[Path]:
    """Files that a case file names: bearing, lubricant and loads. None of a file that cannot be read."""
    try:
        data, _ = parse(read_text(path, "the case file cannot be read"), str(path))
    except InputError:
        return []  # the reader of the case reports its faults
    loads = data.get("loads")
    named = [data.get("bearing"), data.get("lubricant")]
    named += [loads.get("file"), loads.get("bearing_file")] if isinstance(loads, Mapping) else []
    return [path.parent / name for name in named if isinstance(name, str) and "\0" not in name]


def case_schema() -> dict[str, Any]:
    """JSON Schema (2020-12) of the case file, for editors and for programs that write such files."""
    schema = {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": "case of macroslip"}
    return schema | json_schema(Case)


def build_case(
    data: Mapping[str, Any],
    source: Source,
    folder: Path,
    *,
    records: Mapping[str, Record] | None = None,
    series: Callable[[LoadSource], HubLoads | BearingLoads] | None = None,
) -> Case:
    """Make a case of the content of a case file.

    Parameters
    ----------
    data : mapping
        Content of the file.
    source : Source
        Where it was written, for messages.
    folder : Path
        Where relative paths start.
    records : mapping, optional
        `bearing` and `lubricant` that have been read already, in place of those that the file names.
    series : callable, optional
        Makes the loads of their section; by default they are read.

    Raises
    ------
    InputError
        With all that is wrong.
    """
    place, known, parts = Place(source), records or {}, {}
    values, problems = read_fields(Case, data, place)
    for key, value in values.items():
        inner = (key, value.key) if isinstance(value, LoadSource) else (key,)
        try:
            if key in ("bearing", "lubricant"):
                parts[key] = known.get(key) or _record(Bearing if key == "bearing" else Lubricant, value, folder)
            elif isinstance(value, LoadSource):
                parts[key] = series(value) if series else value.series(folder)
            elif key == "forces":  # a section in files only
                parts |= value
            else:
                parts[key] = value
        except InputError as problem:
            problems.append(place.inside(*inner).blamed(problem))
    wrong = {key for key in fields_of(Case).keys() & data.keys() if key != "forces" and key not in parts}
    case = None
    if "loads" in parts and "bearing" not in wrong:
        try:
            case = Case(**parts)
        except InputError as failure:
            found = ((part, part.where.split(".")) for part in parts_of(failure))
            problems += [place.inside(*keys).blamed(part) for part, keys in found if keys[0] not in wrong]
    if problems or case is None:
        raise together(problems)
    if case.laws != Laws.paper():  # which needs nothing that a lubricant may lack
        from macroslip.contact.laws import check_lubricant

        check_lubricant(case.laws, case.lubricant)
    return case


def _record(kind: type[Record], name: str, folder: Path) -> Record:
    """Read a bearing or lubricant by catalogue name or path."""
    names, path = kind.catalogue(), folder / name
    if name in names:
        return kind.read(name)
    if not path.exists():
        close = nearest(name, names)
        raise InputError(
            f"{shown(name)} is neither in the catalogue nor a file",
            where=kind.noun,
            allowed=f"{', '.join(names)}, or the path of a {kind.noun} file",
            remedy=f"Did you mean {close}?" if close else f"Relative paths start at {folder.resolve()}.",
        )
    return kind.read(path)
