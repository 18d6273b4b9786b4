"""Tables of records, read piece by piece: CSV, gzipped CSV, Parquet and XLSX."""

from __future__ import annotations

import gzip
import importlib.util
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from typing import IO, Any

import pandas as pd

from macroslip.errors import InputError, MacroslipError
from macroslip.storage.files import check_regular, reading

#: Rows of a piece: a file of many turbines is never in memory as a whole.
PIECE = 200_000
#: Lines at the beginning of a file among which the line of names is looked for.
_HEAD = 60
#: Bytes at the beginning of a text from which its encoding is detected.
_SAMPLE = 1 << 20
SUFFIXES = (".csv", ".csv.gz", ".parquet", ".xlsx")
_DAMAGED = "Export it anew."
_DECIMAL_COMMA = re.compile(r"[+-]?\d+,\d+")


def files_of(patterns: Sequence[str], folder: Path) -> list[Path]:
    """Files that the patterns name, in the order of patterns and names; each once.

    Raises InputError for a pattern that no file fits, and for a file of another kind.
    """
    files: dict[Path, None] = {}
    for pattern in patterns:
        path = Path(pattern)
        start = folder
        name = pattern
        if path.is_absolute():
            start = Path(path.anchor)
            name = str(path.relative_to(path.anchor))
        is_pattern = re.search(r"[*?\[]", name)
        paths = [start / name]
        if is_pattern:
            paths = sorted(start.glob(name))
        if not paths or not all(file.is_file() for file in paths):
            raise InputError(
                f"there is no file {pattern!r} in '{folder}'",
                where="files",
                allowed="paths from the folder of this description, with * and ? as wildcards",
            )
        files |= dict.fromkeys(paths)
    for path in files:
        if not path.name.lower().endswith(SUFFIXES):
            raise InputError(
                "the file is of no known kind", where=str(path), allowed=", ".join(SUFFIXES)
            )
    return list(files)


def column_names(path: Path, sheet: str | None = None) -> list[str]:
    """Names of the columns of a table; of a CSV file those of the line with most names."""
    return _opened(path, sheet, ()).names


def sheet_names(path: Path) -> list[str]:
    """Names of the sheets of an XLSX file; none of any other file."""
    if not path.name.lower().endswith(".xlsx"):
        return []
    from openpyxl import load_workbook

    with reading(path, _DAMAGED):
        book = load_workbook(path, read_only=True)
    try:
        return list(book.sheetnames)
    finally:
        book.close()


def pieces(path: Path, columns: Iterable[str], sheet: str | None = None) -> Iterator[pd.DataFrame]:
    """Columns of a table by their names, piece by piece in the order of its rows.

    Numbers of CSV files are numbers where a whole piece of a column is numeric, else text.

    Raises InputError if the file cannot be read or lacks a column, with the nearest names.
    """
    columns = list(dict.fromkeys(columns))
    table = _opened(path, sheet, columns)
    for name in columns:
        if name not in table.names:
            close = get_close_matches(name, table.names, n=5, cutoff=0.4)
            raise InputError(
                f"there is no column '{name}'",
                where=str(path),
                allowed=", ".join(close or table.names[:20]),
                remedy=f"Is it '{close[0]}'?" if close else "Name a column of this file.",
            )
    with reading(path, _DAMAGED):
        yield from table.pieces(columns)


def _opened(path: Path, sheet: str | None, columns: Sequence[str]) -> Any:
    """The table of a file, by the ending of its name."""
    check_regular(path, "Name a table.")
    name = path.name.lower()
    with reading(path, _DAMAGED):
        if name.endswith(".parquet"):
            return _Parquet(path)
        if name.endswith(".xlsx"):
            return _Sheet(path, sheet)
        return _CsvText.of(path, columns)


def clean(name: object) -> str:
    """Name of a column without byte-order mark, spaces around it and a comment sign before it.

    Examples
    --------
    >>> clean("# Date and time "), clean(None)
    ('Date and time', '')
    """
    if name is None:
        return ""
    text = str(name).lstrip("\ufeff").strip()
    return text.removeprefix("#").strip()


@dataclass(frozen=True)
class _CsvText:
    """A table of text: how it is written, and where its names stand."""

    path: Path
    names: list[str]
    separator: str
    header: int  #: Lines before that of the names
    encoding: str
    decimal: str

    @classmethod
    def of(cls, path: Path, columns: Sequence[str]) -> _CsvText:
        """Find separator, encoding, line of the names and decimal mark of a file.

        The line of names is the one with most of the columns, or with most cells.
        """
        encoding = _encoding(path)
        with _text(path, encoding) as file:
            lines = [line.rstrip("\r\n") for line, _ in zip(file, range(_HEAD), strict=False)]
        if not lines:
            raise InputError("the file is empty", where=str(path))
        wanted = set(columns)
        best = (-1, -1)
        for number, line in enumerate(lines):
            for separator in (",", ";", "\t"):
                cells = _cells(line, separator)
                score = (len(wanted & set(cells)), len(cells))
                if score > best:
                    best = score
                    chosen = (separator, number, cells)
        separator, header, names = chosen
        following = [_cells(line, separator) for line in lines[header + 1 :]]
        is_comma = any(_DECIMAL_COMMA.fullmatch(cell) for cells in following for cell in cells)
        decimal = "," if separator != "," and is_comma else "."
        return cls(path, names, separator, header, encoding, decimal)

    def pieces(self, columns: Sequence[str]) -> Iterator[pd.DataFrame]:
        """Columns by name, piece by piece."""
        order = [self.names.index(name) for name in columns]
        with pd.read_csv(
            self.path,
            sep=self.separator,
            skiprows=self.header + 1,
            header=None,
            names=range(len(self.names)),
            usecols=order,
            decimal=self.decimal,
            encoding=self.encoding,
            chunksize=PIECE,
            low_memory=False,
            skipinitialspace=True,
        ) as reader:
            for piece in reader:
                in_order = piece[order]
                yield in_order.set_axis(list(columns), axis=1)


def _cells(line: str, separator: str) -> list[str]:
    return [clean(cell.strip().strip('"')) for cell in line.split(separator)]


def _text(path: Path, encoding: str) -> IO[str]:
    opened = gzip.open if path.name.lower().endswith(".gz") else open
    return opened(path, "rt", encoding=encoding, newline="")


def _encoding(path: Path) -> str:
    """UTF-8, or the code page of Western Windows where the file is not UTF-8."""
    opened = gzip.open if path.name.lower().endswith(".gz") else open
    with opened(path, "rb") as file:
        sample = file.read(_SAMPLE)
    try:
        sample.decode("utf-8")
    except UnicodeDecodeError as error:
        # The sample may end within a character.
        if error.start < len(sample) - 3:
            return "cp1252"
    return "utf-8"


class _Parquet:
    """A table in a Parquet file."""

    def __init__(self, path: Path):
        from pyarrow.parquet import ParquetFile

        self._file = ParquetFile(path)
        names = self._file.schema_arrow.names
        self._own_names = {clean(name): name for name in names}
        self.names = list(self._own_names)

    def pieces(self, columns: Sequence[str]) -> Iterator[pd.DataFrame]:
        """Columns by name, piece by piece."""
        own = [self._own_names[name] for name in columns]
        for batch in self._file.iter_batches(batch_size=PIECE, columns=own):
            piece = batch.to_pandas().reset_index()
            in_order = piece[own]
            yield in_order.set_axis(list(columns), axis=1)


class _Sheet:
    """A sheet of an XLSX file; the line of names is the one with most texts."""

    def __init__(self, path: Path, sheet: str | None):
        if importlib.util.find_spec("openpyxl") is None:
            raise MacroslipError(
                "not installed, but needed for XLSX files: openpyxl. "
                "Install with: pip install 'macroslip[excel]'"
            )
        self._path = path
        self._sheet = sheet
        head = list(self._rows(1, _HEAD))
        if not head:
            raise InputError("the sheet is empty", where=str(path))
        texts = [sum(isinstance(cell, str) for cell in row) for row in head]
        self._header = texts.index(max(texts))
        headings = head[self._header]
        self.names = [clean(cell) for cell in headings]

    def _rows(self, first: int, last: int | None = None) -> Iterator[tuple[Any, ...]]:
        """Cells of the rows, numbered from 1."""
        from openpyxl import load_workbook

        book = load_workbook(self._path, read_only=True, data_only=True)
        try:
            if self._sheet is not None and self._sheet not in book.sheetnames:
                raise InputError(
                    f"there is no sheet '{self._sheet}'",
                    where=str(self._path),
                    allowed=", ".join(book.sheetnames),
                )
            name = self._sheet or book.sheetnames[0]
            sheet = book[name]
            yield from sheet.iter_rows(min_row=first, max_row=last, values_only=True)
        finally:
            book.close()

    def pieces(self, columns: Sequence[str]) -> Iterator[pd.DataFrame]:
        """Columns by name, piece by piece."""
        order = [self.names.index(name) for name in columns]
        rows: list[list[object]] = []
        for row in self._rows(self._header + 2):
            if all(cell is None for cell in row):
                continue
            rows.append([row[number] if number < len(row) else None for number in order])
            if len(rows) == PIECE:
                yield pd.DataFrame(rows, columns=list(columns))
                rows = []
        if rows:
            yield pd.DataFrame(rows, columns=list(columns))
