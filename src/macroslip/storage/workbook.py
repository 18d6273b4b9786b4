"""Workbooks of Excel (.xlsx): tables written as sheets, and the cells of a sheet read."""

from __future__ import annotations

import io
import math
import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from macroslip.errors import InputError, MacroslipError
from macroslip.storage.files import reading

if TYPE_CHECKING:
    import pandas as pd

#: Extension of a workbook.
EXTENSION = ".xlsx"
#: Rows that a sheet has room for, its header among them.
_MOST_ROWS = 2**20
#: Letters that the name of a sheet has room for, and those it cannot have.
_LONGEST_NAME = 31
_NOT_IN_NAMES = re.compile(r"[\[\]:*?/\\]")
#: Letters that a cell has room for, and those that XML does not have.
_LONGEST_TEXT = 32_767
_NOT_IN_XML = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f]")
#: Widths of columns, in digits.
_NARROWEST = 9
_WIDEST = 60
_AGAIN = "Write the workbook again, as .xlsx and without a password."


def require_openpyxl() -> None:
    """Refuse the use of workbooks where the package that reads and writes them is missing."""
    try:
        import openpyxl  # noqa: F401
    except ImportError:
        raise MacroslipError(
            "not installed, but needed for a workbook of Excel: openpyxl. "
            "Install with: pip install 'macroslip[excel]'"
        ) from None


def workbook(tables: Mapping[str, pd.DataFrame]) -> bytes:
    """Content of a workbook with a sheet a table.

    Parameters
    ----------
    tables : mapping
        Tables by the names of their sheets; names of columns become the header.

    Returns
    -------
    bytes
        An .xlsx file. Numbers are numbers; text is text, also where it begins as a formula does; a
        number that is not known is an empty cell, and an endless one the text inf.

    Raises
    ------
    InputError
        If a table has more rows than a sheet.
    """
    require_openpyxl()
    import pandas as pd

    for name, table in tables.items():
        if len(table) >= _MOST_ROWS:
            raise InputError(
                f"the table {name} has {len(table)} rows",
                where=name,
                allowed=f"up to {_MOST_ROWS - 1}, which a sheet of Excel has room for",
                remedy="Write the tables as Parquet, or compute fewer cases.",
            )
    content = io.BytesIO()
    with pd.ExcelWriter(content, engine="openpyxl") as writer:
        for name, table in tables.items():
            sheet_name = _NOT_IN_NAMES.sub(" ", name)[:_LONGEST_NAME]
            plain = table.map(_cell)
            plain.to_excel(
                writer, sheet_name=sheet_name, index=False, freeze_panes=(1, 0), inf_rep="inf"
            )
            _finish(writer.sheets[sheet_name])
    return content.getvalue()


def _cell(value: Any) -> Any:
    """Value of a cell, within what the format holds."""
    if isinstance(value, str):
        return _NOT_IN_XML.sub(" ", value)[:_LONGEST_TEXT]
    if value is None or isinstance(value, bool | int | float):
        return value
    if hasattr(value, "item"):  # a number of NumPy
        return value.item()
    return str(value)[:_LONGEST_TEXT]


def _finish(sheet: Any) -> None:
    """Text that looks like a formula stays text; columns are as wide as their content."""
    for column in sheet.iter_cols():
        width = _NARROWEST
        for cell in column:
            if cell.data_type == "f":
                cell.data_type = "s"
            if isinstance(cell.value, str):
                width = max(width, len(cell.value) + 2)
        sheet.column_dimensions[column[0].column_letter].width = min(width, _WIDEST)


def sheet_cells(path: Path, sheet: str = "") -> list[list[Any]]:
    """Cells of a sheet by rows, without the empty rows and columns around them.

    Parameters
    ----------
    path : Path
        The workbook.
    sheet : str
        Name of the sheet; the first one if it is empty.

    Returns
    -------
    list of list
        Rows of equal length: numbers, text, dates, True or False, None for an empty cell. A formula
        has the value that was stored with it.

    Raises
    ------
    InputError
        If the file is no workbook, or has no such sheet.
    """
    require_openpyxl()
    import openpyxl

    with reading(path, _AGAIN):
        book = openpyxl.load_workbook(path, read_only=True, data_only=True)
        try:
            names = [sheet_of_book.title for sheet_of_book in book.worksheets]
            if sheet and sheet not in names:
                raise InputError(
                    f"the workbook has no sheet '{sheet}'",
                    where=str(path),
                    allowed=", ".join(names),
                    remedy="Name one of them, or leave the key sheet out for the first one.",
                )
            chosen = book[sheet] if sheet else book.worksheets[0]
            rows = [list(row) for row in chosen.iter_rows(values_only=True)]
        finally:
            book.close()
    return _trimmed(rows)


def _trimmed(rows: list[list[Any]]) -> list[list[Any]]:
    """The rows without empty ones at both ends, and without empty columns at both ends.

    Examples
    --------
    >>> _trimmed([[None, None, None], [None, "time_s", None], [None, 0.5], [None, None]])
    [['time_s'], [0.5]]
    """
    filled = [k for k, row in enumerate(rows) if any(cell is not None for cell in row)]
    if not filled:
        return []
    kept = rows[filled[0] : filled[-1] + 1]
    columns = [k for row in kept for k, cell in enumerate(row) if cell is not None]
    first = min(columns)
    width = max(columns) + 1 - first
    cut = [row[first : first + width] for row in kept]
    return [[*row, *[None] * (width - len(row))] for row in cut]


def number_or_nan(cell: Any) -> float | None:
    """Value of a cell that is a number, NaN of an empty one, None of any other.

    Examples
    --------
    >>> number_or_nan(2), number_or_nan(None), number_or_nan("2"), number_or_nan(True)
    (2.0, nan, None, None)
    """
    if cell is None:
        return math.nan
    is_number = isinstance(cell, int | float) and not isinstance(cell, bool)
    return float(cell) if is_number else None
