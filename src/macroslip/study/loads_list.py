"""The load histories of a study: their files, and labels from file names or a table."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import Any

from macroslip.errors import InputError, safe_text
from macroslip.loads.bundled import bundled_cases, bundled_labels, bundled_names
from macroslip.loads.sheet_table import check_sheet
from macroslip.storage.files import check_regular
from macroslip.storage.workbook import EXTENSION, sheet_cells

#: Names that labels of the user's own would hide.
RESERVED = (
    "case", "row", "roller", "interface", "orbit", "sample", "time", "run", "key", "loads", "file", "bearing",
    "lubricant", "model", "outcome", "reason",
)  # fmt: skip
#: Largest whole number that a float holds exactly; larger ones would change on the way into a
#: result.
_LARGEST = 2**53
_BUNDLED_UNITS = {"wind_speed": "m/s"}
_KINDS: dict[str, tuple[str, Callable[[str], Any]]] = {
    "d": (r"[+-]?\d+", int),
    "g": (r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?", float),
    "": (r"[^/]+?", str),
}
_FIELD = re.compile(r"\{([A-Za-z_][A-Za-z0-9_]*)(?::([^{}]*))?\}")
_WILDCARDS = {"**/": r"(?:[^/]+/)*", "*": r"[^/]*", "?": r"[^/]"}
_PIECES = re.compile(r"\*\*/|\*|\?|\{[^{}]*\}|[^*?{]+|\{")


@dataclass(frozen=True)
class Load:
    """One load history: its path in the study or name of a bundled case, and its labels."""

    name: str
    fields: Mapping[str, Any]

    @property
    def event(self) -> str:
        """Name of the event that it is, by its label `event`; empty for wind speeds."""
        return str(self.fields.get("event") or "")


@dataclass(frozen=True)
class LoadList:
    """The load histories of a study."""

    source: str  #: `file`, `bearing_file` or `bundled`: the key of a case file for such a name
    loads: Sequence[Load]
    units: Mapping[str, str]  #: Units of the fields
    remarks: Sequence[str] = ()  #: Notes for the user: files left out


class Pattern:
    """A path with fields and wildcards, to find files by and to read values from their names.

    Raises InputError if a field has another form. Fields are `{name}` (text without slash),
    `{name:d}` (whole number) and `{name:g}` (number); wildcards are `*`, `?` and `**/`. A field
    that occurs twice must have the same value in both places.

    Examples
    --------
    >>> Pattern("{wind_speed:g}mps_seed{seed:d}.outb").fields_of("11.4mps_seed03.outb")
    {'wind_speed': 11.4, 'seed': 3}
    """

    def __init__(self, text: str):
        self.text = PurePosixPath(text).as_posix()
        self.kinds: dict[str, Callable[[str], Any]] = {}
        self._expression = ""
        self._glob = ""
        for piece in _PIECES.findall(self.text):
            match = _FIELD.fullmatch(piece)
            if piece.startswith("{") and (match is None or (match[2] or "") not in _KINDS):
                raise InputError(
                    f"'{piece}' in the pattern '{self.text}' is no field",
                    allowed="{name} for text, {name:d} for a whole number, {name:g} for a number",
                )
            if piece == "**/" and self._glob and not self._glob.endswith("/"):
                raise InputError(
                    f"'**' in the pattern '{self.text}' is not the whole name of a folder",
                    remedy="Write runs/**/*.outb for the folders under runs, or a single *.",
                )
            glob = piece.replace("[", "[[]")
            if match:
                glob = "*"
            elif piece in _WILDCARDS:
                glob = piece
            # Fields beside each other are one wildcard: ** has a meaning of its own.
            if glob != "*" or not self._glob.endswith("*"):
                self._glob += glob
            if match is None:
                self._expression += _WILDCARDS.get(piece) or re.escape(piece)
            elif match[1] in self.kinds:
                self._expression += f"(?P={match[1]})"
            else:
                name = match[1]
                form, self.kinds[name] = _KINDS[match[2] or ""]
                self._expression += f"(?P<{name}>{form})"

    def fields_of(self, path: str) -> dict[str, Any] | None:
        """Values of the fields in a path with forward slashes; None if it does not fit."""
        match = re.fullmatch(self._expression, path)
        return (
            None
            if match is None
            else {name: kind(match[name]) for name, kind in self.kinds.items()}
        )

    def files(self, folder: Path) -> tuple[list[tuple[str, dict[str, Any]]], list[str]]:
        """Find the files that the pattern matches: sorted paths, each with its fields.

        A relative pattern starts in `folder`, and its paths are then relative too.

        Second come files that the wildcards find but whose fields cannot be read, as `{seed:d}`
        from a name with `seedA`. Raises InputError if the pattern names a folder.
        """
        pure = PurePosixPath(self._glob)
        base = Path(pure.anchor)
        start = folder / base
        names = [part for part in pure.parts if part != pure.anchor]
        if not names or (start / pure).is_dir():
            allowed = "the path of load files, with fields and wildcards"
            remedy = "Name the files in it: runs/*.outb, for example."
            raise InputError(f"'{self.text}' is a folder", allowed=allowed, remedy=remedy)
        # The part before the first wildcard is a plain folder, which may lead upwards ("../runs").
        while len(names) > 1 and not re.search(r"[*?\[]", names[0]):
            base = base / names[0]
            start = start / names[0]
            names = names[1:]
        paths = []
        for path in start.glob("/".join(names)):
            if path.is_file():
                paths.append((base / path.relative_to(start)).as_posix())
        fitting = []
        others = []
        for name in sorted(paths):
            fields = self.fields_of(name)
            if fields is None:
                others.append(name)
            else:
                fitting.append((name, fields))
        return fitting, others


def load_list(
    folder: Path, *, kind: str, bundled: Sequence[str] | None = None, table: str | None = None,
    files: Sequence[str] | None = None, units: Mapping[str, str] | None = None,
    sheet: str | None = None,
) -> LoadList:  # fmt: skip
    """The load histories that the section `loads` of a study file names.

    Parameters
    ----------
    folder : path
        Where relative paths start.
    kind : str
        Content of the files, `hub` or `main-bearing`.
    bundled, table, files : optional
        Exactly one of them: names of bundled cases, a table of files, or patterns of paths.
    units : mapping, optional
        Units of the fields, by name.
    sheet : str, optional
        Sheet of the table, if it is a workbook; the first one if not given.

    Raises
    ------
    InputError
        If there is no load history, a table cannot be read, or a field has a name that is taken or
        a value that cannot be stored.
    """
    if sheet and not table:
        raise InputError(
            f"the sheet '{sheet}' is named without a table",
            where="sheet",
            remedy="Name the workbook under table, or remove sheet; sheets of load files are named "
            "under case.loads.sheet.",
        )
    source = "bundled" if bundled else "bearing_file" if kind == "main-bearing" else "file"
    remarks: list[str] = []
    if bundled:
        loads = _bundled(bundled)
    elif table:
        loads = _from_table(folder / table, sheet or "")
    else:
        patterns = [Pattern(text) for text in files or ()]
        loads, remarks = _from_patterns(patterns, folder)
    names_of_loads = [name for load in loads for name in load.fields]
    names = list(dict.fromkeys(names_of_loads))
    for name in names:
        if name in RESERVED or not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", name):
            allowed = f"letters, digits and _, and none of {', '.join(RESERVED)}"
            raise InputError(
                f"a field is called '{safe_text(name)}'",
                allowed=allowed,
                remedy="Give it another name.",
            )
    for load in loads:
        if any("\ud800" <= letter <= "\udfff" for letter in load.name):
            fault = f"the name of the file {safe_text(load.name)} is not UTF-8"
            raise InputError(
                fault, remedy="Rename it; results are kept by the names of their loads."
            )
        for name, value in load.fields.items():
            if type(value) is int and abs(value) > _LARGEST:
                fault = f"the field {name} of {safe_text(load.name)} is {value}"
                remedy = f"Read it as text: {{{name}}}."
                raise InputError(fault, allowed=f"whole numbers up to {_LARGEST}", remedy=remedy)
    units = units or {}
    if unknown := [name for name in units if name not in names]:
        fault = f"units names {', '.join(unknown)}"
        known = ", ".join(names) or "there are none"
        raise InputError(fault, allowed=f"fields: {known}")
    return LoadList(
        source,
        loads,
        {name: units.get(name, _BUNDLED_UNITS.get(name, "1")) for name in names},
        remarks,
    )


def _bundled(names: Sequence[str]) -> list[Load]:
    sets = {
        "all": bundled_cases(),
        "year": bundled_cases("year"),
        "nrel5": bundled_cases("nrel5"),
    }
    known = bundled_names()
    wrong = [name for name in names if name not in known and name not in sets]
    if wrong:
        raise InputError(
            f"there is no bundled case '{safe_text(wrong[0])}'",
            allowed=f"{', '.join(sets)}, or {', '.join(known)}",
        )
    chosen = []
    for name in names:
        chosen += sets.get(name, [name])
    chosen = list(dict.fromkeys(chosen))
    labels_of_cases = bundled_labels(chosen)
    return [Load(name, labels) for name, labels in zip(chosen, labels_of_cases, strict=True)]


def _from_patterns(patterns: Sequence[Pattern], folder: Path) -> tuple[list[Load], list[str]]:
    first = patterns[0]
    loads = {}
    remarks = []
    for pattern in patterns:
        if pattern.kinds.keys() != first.kinds.keys():
            fault = f"the patterns '{first.text}' and '{pattern.text}' have different fields"
            raise InputError(fault, allowed="the same fields in all of them")
        files, unread = pattern.files(folder)
        if not files:
            remedy = f"Relative paths start at {folder.resolve()}."
            if unread:
                first_unread = safe_text(unread[0])
                remedy += (
                    f" The fields of {len(unread)} files could not be read, {first_unread} first."
                )
            raise InputError(f"no file fits the pattern '{pattern.text}'", remedy=remedy)
        loads |= {name: Load(name, fields) for name, fields in files}
        if unread:
            remarks.append(
                f"{len(unread)} files fit the pattern '{pattern.text}' but for their fields "
                "and are left out, "
                f"{safe_text(unread[0])} first"
            )
    return list(loads.values()), remarks


def _from_table(path: Path, sheet: str = "") -> list[Load]:
    where = str(path)
    columns, rows = _rows_of_table(path, sheet)
    if "file" not in columns or not rows:
        fault = "the table has no rows" if "file" in columns else "the table has no column 'file'"
        raise InputError(
            fault, where=where, allowed="a column 'file' with paths, and one column a field"
        )
    names = set()
    for number, row in enumerate(rows, start=1):
        if not isinstance(row["file"], str) or not row["file"]:
            raise InputError(f"row {number} has no file", where=where, remedy="Fill or remove it.")
        if empty := [name for name, value in row.items() if value is None]:
            remedy = "Fill it, or remove the column."
            raise InputError(f"row {number} has no {', '.join(empty)}", where=where, remedy=remedy)
        odd = [name for name, value in row.items() if not isinstance(value, (str, int, float))]
        if odd:
            column = odd[0]
            fault = f"row {number} has {row[column]!r} in column {column}"
            raise InputError(fault, where=where, allowed="numbers, text, true and false")
        if row["file"] in names:
            fault = f"the file {safe_text(row['file'])} is listed twice"
            raise InputError(fault, where=where, remedy="Keep one row of it.")
        names.add(row["file"])
    return [Load(row.pop("file"), row) for row in rows]


def _rows_of_table(path: Path, sheet: str) -> tuple[list[str], list[dict[str, Any]]]:
    """Names of the columns of a table, and its rows by these names."""
    import pyarrow as pa
    import pyarrow.csv
    import pyarrow.parquet

    where = str(path)
    check_regular(path, "Name a table, .csv, .parquet or .xlsx.")
    check_sheet(path, sheet)
    readers = {".csv": pa.csv.read_csv, ".parquet": pa.parquet.read_table}
    extension = path.suffix.lower()
    if extension == EXTENSION:
        return _rows_of_sheet(path, sheet)
    if extension not in readers:
        raise InputError(
            f"the extension {path.suffix!r} is not known",
            where=where,
            allowed=", ".join([*readers, EXTENSION]),
        )
    try:
        table = readers[extension](path)
        return table.column_names, table.to_pylist()
    except (pa.ArrowException, OSError) as error:
        raise InputError(f"the table of load files cannot be read ({error})", where=where) from None


def _rows_of_sheet(path: Path, sheet: str) -> tuple[list[str], list[dict[str, Any]]]:
    """Columns and rows of a sheet of a workbook; a column with a fraction is one of fractions."""
    header, *cells = sheet_cells(path, sheet) or [[]]
    columns = {}
    for name, *column in zip(header, *cells, strict=True):
        if any(isinstance(cell, float) for cell in column):
            column = [float(cell) if type(cell) is int else cell for cell in column]
        if name is not None:
            columns[str(name).strip()] = column
    names = list(columns)
    rows = zip(*columns.values(), strict=True)
    return names, [dict(zip(names, row, strict=True)) for row in rows]
