"""Sheet of a workbook of Excel as a table of loads."""

from __future__ import annotations

import datetime
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from macroslip.arrays import FloatArray
from macroslip.errors import InputError
from macroslip.input.messages import shown
from macroslip.loads.csv_text import name_with_unit
from macroslip.storage.workbook import EXTENSION, number_or_nan, sheet_cells


def check_sheet(path: Path, sheet: str) -> None:
    """Refuse the name of a sheet for a file that is no workbook."""
    if sheet and path.suffix.lower() != EXTENSION:
        raise InputError(
            f"the sheet '{sheet}' is named for a file that is no workbook of Excel",
            where=str(path),
            allowed=f"a sheet of a file {EXTENSION}",
            remedy="Leave it out.",
        )


@dataclass(frozen=True)
class SheetTable:
    """Table of a sheet: a header, perhaps a line of units, and rows of cells."""

    names: list[str]  #: Names of the columns; a unit from the line of units stands behind the name
    rows: list[list[Any]]
    first_row: int  #: Number of the first row of data below the header, for errors
    where: str  #: Path of the file, for errors

    def texts(self, index: int) -> list[str | None]:
        """Cells of a column as text."""
        cells = [row[index] for row in self.rows]
        return [None if cell is None else str(cell).strip() for cell in cells]

    def numbers(self, indices: Sequence[int], *, text_allowed: bool = False) -> list[FloatArray]:
        """Values of columns; NaN where a cell is empty or, if that is allowed, no number."""
        return [self._values(index, text_allowed=text_allowed) for index in indices]

    def _values(self, index: int, *, text_allowed: bool) -> FloatArray:
        values = [number_or_nan(row[index]) for row in self.rows]
        if None in values and not text_allowed:
            number = values.index(None)
            cell = self.rows[number][index]
            raise InputError(
                f"column {self.names[index]} holds {shown(cell)}, which is not stored as a number, "
                f"in row {self.first_row + number} below the header",
                where=self.where,
                allowed="cells that hold numbers",
                remedy=_remedy(cell),
            )
        return np.array(values, dtype=float)


def _remedy(cell: Any) -> str:
    if isinstance(cell, datetime.date | datetime.time | datetime.timedelta):
        return "This is a date or a time of day; write seconds from the start of the record."
    return "Turn text into numbers: in Excel with Data, Text to Columns."


def read_sheet(path: Path, sheet: str = "") -> SheetTable:
    """Read a sheet of a workbook, the first one if none is named, as a table of loads.

    Raises InputError if it is empty, or has no header of names.
    """
    cells = sheet_cells(path, sheet)
    if not cells or not any(isinstance(cell, str) for cell in cells[0]):
        raise InputError(
            "the sheet is empty" if not cells else "the sheet has no line with names of columns",
            where=f"{path}, sheet {sheet}" if sheet else f"{path}, first sheet",
            allowed="a first row with the names of the columns, and numbers below",
            remedy="Name the sheet that holds the loads with the key sheet.",
        )
    header, *rows = cells
    names = []
    for cell in header:
        names.append("" if cell is None else str(cell).strip())
    first_row = 1
    if len(rows) > 1 and _is_line_of_units(rows[0], rows[1]):
        units = rows[0]
        names = [
            name if unit is None else name_with_unit(name, str(unit))
            for name, unit in zip(names, units, strict=True)
        ]
        rows = rows[1:]
        first_row = 2
    return SheetTable(names, rows, first_row, str(path))


def _is_line_of_units(row: Sequence[Any], below: Sequence[Any]) -> bool:
    """True if a row has text and no number, and the row below it has numbers."""
    has_text = any(isinstance(cell, str) for cell in row)
    has_number = any(map(_is_number, row))
    return has_text and not has_number and any(map(_is_number, below))


def _is_number(cell: Any) -> bool:
    value = number_or_nan(cell)
    return value is not None and not math.isnan(value)
