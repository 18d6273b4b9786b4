"""The load histories of a study: where each is, and the fields it is labelled with."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from macroslip.errors import InputError
from macroslip.files import check_regular
from macroslip.loads import bundled_cases
from macroslip.study.pattern import Pattern
from macroslip.study.safe_text import safe_text

if TYPE_CHECKING:
    from macroslip.study.study_keys import StudyLoads

#: Names that labels of the user's own would hide.
RESERVED = (
    "case", "row", "roller", "interface", "orbit", "sample", "time", "run", "key", "loads", "file", "bearing",
    "lubricant", "model", "outcome", "reason",
)  # fmt: skip
#: Largest whole number that a float holds exactly; larger ones would change on the way into a result.
_LARGEST = 2**53
_BUNDLED_UNITS = {"wind_speed": "m/s", "turbulence": "1"}


@dataclass(frozen=True)
class Load:
    """One load history.

    Parameters
    ----------
    name : str
        Path as the study has it, or name of a bundled case.
    fields : mapping
        Labels: numbers or text.
    """

    name: str
    fields: Mapping[str, Any]


@dataclass(frozen=True)
class LoadList:
    """The load histories of a study.

    Parameters
    ----------
    source : str
        `file`, `bearing_file` or `bundled`: the key of a case file for such a name.
    loads : sequence of Load
    units : mapping of str to str
        Units of the fields.
    remarks : sequence of str
        Notes for the user: files left out.
    """

    source: str
    loads: Sequence[Load]
    units: Mapping[str, str]
    remarks: Sequence[str] = ()


def load_list(given: StudyLoads, folder: Path) -> LoadList:
    """The load histories that the section `loads` of a study file names.

    Parameters
    ----------
    given : StudyLoads
        The section, as read.
    folder : Path
        Where relative paths start.

    Raises
    ------
    InputError
        If there is none, a table cannot be read, or a field has a name that is taken or a value that cannot be stored.
    """
    source = "bearing_file" if given.kind == "main-bearing" else "file"
    remarks: list[str] = []
    if given.bundled:
        source, loads = "bundled", _bundled(given.bundled)
    elif given.table:
        loads = _from_table(folder / given.table)
    else:
        loads, remarks = _from_patterns([Pattern(text) for text in given.files or ()], folder)
    names = list(dict.fromkeys(name for load in loads for name in load.fields))
    for name in names:
        if name in RESERVED or not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", name):
            raise InputError(
                f"a field is called '{safe_text(name)}'",
                allowed=f"letters, digits and _, and none of {', '.join(RESERVED)}",
                remedy="Give it another name.",
            )
    for load in loads:
        for name, value in load.fields.items():
            if type(value) is int and abs(value) > _LARGEST:
                what = f"the field {name} of {safe_text(load.name)} is {value}"
                raise InputError(
                    what, allowed=f"whole numbers up to {_LARGEST}", remedy=f"Read it as text: {{{name}}}."
                )
    units = given.units or {}
    unknown = [name for name in units if name not in names]
    if unknown:
        what = f"units names {', '.join(unknown)}"
        raise InputError(what, allowed=f"fields: {', '.join(names) or 'there are none'}")
    units = {name: units.get(name, _BUNDLED_UNITS.get(name, "1")) for name in names}
    return LoadList(source, loads, units, remarks)


def _bundled(names: Sequence[str]) -> list[Load]:
    known = bundled_cases()
    wrong = [name for name in names if name not in known and name != "all"]
    if wrong:
        raise InputError(f"there is no bundled case '{safe_text(wrong[0])}'", allowed=f"all, or {', '.join(known)}")
    chosen = known if "all" in names else names
    return [Load(name, {"wind_speed": float(name[:-1]), "turbulence": name[-1]}) for name in chosen]


def _from_patterns(patterns: Sequence[Pattern], folder: Path) -> tuple[list[Load], list[str]]:
    first = patterns[0]
    for pattern in patterns:
        if set(pattern.names) != set(first.names):
            raise InputError(
                f"the patterns '{first.text}' and '{pattern.text}' have different fields",
                allowed="the same fields in all of them",
            )
    loads: dict[str, Load] = {}
    remarks = []
    for pattern in patterns:
        found, unread = pattern.files(folder)
        if not found:
            raise InputError(
                f"no file fits the pattern '{pattern.text}'",
                remedy=f"Relative paths start at {folder.resolve()}."
                + (
                    f" The fields of {len(unread)} files could not be read, {safe_text(unread[0])} first."
                    if unread
                    else ""
                ),
            )
        loads |= {name: Load(name, fields) for name, fields in found}
        if unread:
            remarks.append(
                f"{len(unread)} files fit the pattern '{pattern.text}' but for their fields and are left out, "
                f"{safe_text(unread[0])} first"
            )
    return list(loads.values()), remarks


def _from_table(path: Path) -> list[Load]:
    import pyarrow as pa
    import pyarrow.csv
    import pyarrow.parquet

    where = str(path)
    check_regular(path, "Name a table, .csv or .parquet.")
    try:
        if path.suffix.lower() == ".csv":
            table = pa.csv.read_csv(path)
        elif path.suffix.lower() == ".parquet":
            table = pa.parquet.read_table(path)
        else:
            raise InputError(f"the extension {path.suffix!r} is not known", where=where, allowed=".csv, .parquet")
    except (pa.ArrowException, OSError) as error:
        raise InputError(f"the table of load files cannot be read ({error})", where=where) from None
    rows = table.to_pylist()
    if "file" not in table.column_names or not rows:
        what = "the table has no rows" if "file" in table.column_names else "the table has no column 'file'"
        raise InputError(what, where=where, allowed="a column 'file' with paths, and one column a field")
    for number, row in enumerate(rows, start=1):
        if not isinstance(row["file"], str) or not row["file"]:
            raise InputError(f"row {number} has no file", where=where, remedy="Fill or remove it.")
        empty = [name for name, value in row.items() if value is None]
        if empty:
            raise InputError(
                f"row {number} has no {', '.join(empty)}", where=where, remedy="Fill it, or remove the column."
            )
        odd = [name for name, value in row.items() if not isinstance(value, (str, int, float))]
        if odd:
            what = f"row {number} has {row[odd[0]]!r} in column {odd[0]}"
            raise InputError(what, where=where, allowed="numbers, text, true and false")
    loads = [Load(row["file"], {name: value for name, value in row.items() if name != "file"}) for row in rows]
    name, times = Counter(load.name for load in loads).most_common(1)[0]
    if times > 1:
        raise InputError(
            f"the file {safe_text(name)} is listed {times} times", where=where, remedy="Keep one row of it."
        )
    return loads
