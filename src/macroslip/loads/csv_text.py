"""Tables of text (CSV) of different programs: encoding, header, separator, number format.

Encoding: UTF-8, UTF-16 with its mark, or else Latin-1. Above the header may stand comment lines
(``#`` or ``%``), blank lines and the line ``sep=;``; below it a line of units. Columns are
separated by commas, semicolons or tabs. The columns that are asked for have to be numbers, others
need not.
"""

from __future__ import annotations

import codecs
import csv
import io
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from macroslip.arrays import FloatArray
from macroslip.errors import InputError
from macroslip.input.messages import shown

if TYPE_CHECKING:
    import pyarrow as pa

DECIMAL_MARKS = (".", ",")
THOUSANDS_MARKS = (".", ",", "'", " ")
_MARK_NAMES = {".": "point", ",": "comma", "'": "apostrophe", " ": "space"}
#: Other characters that stand for a mark of thousands.
_OTHER_FORMS = {"'": "\u2019", " ": "\u00a0\u2009\u202f"}
_SEPARATORS = ",;\t"
_COMMENT = re.compile(r"^[ \t]*[#%].*\n?", re.MULTILINE)
_SEPARATOR_LINE = re.compile(r'"?sep=(.)"?', re.IGNORECASE)
_EXPONENT = r"([eEdD][+-]?\d+)?"
#: Columns of speeds and angles, whose values stay below a thousand.
_BELOW_A_THOUSAND = re.compile(
    r"(shaft_speed|rotor_speed|RotSpeed|LSSTip[VP]|Azimuth|angle)", re.IGNORECASE
)
_DATE = re.compile(r"\d{4}-\d\d-\d\d|\d\d?[./]\d\d?[./]\d\d|\d\d?:\d\d")


@dataclass(frozen=True)
class NumberFormat:
    """Marks in the numbers of a table of text; an empty one is found out from the numbers."""

    decimal: str = ""  #: Mark before the decimals, one of `DECIMAL_MARKS`
    thousands: str = ""  #: Mark between groups of three digits, one of `THOUSANDS_MARKS`

    def __post_init__(self) -> None:
        allowed = {"decimal": DECIMAL_MARKS, "thousands": THOUSANDS_MARKS}
        for key, marks in allowed.items():
            mark = getattr(self, key)
            if mark and mark not in marks:
                raise InputError(
                    f"{key} is {shown(mark)}",
                    allowed=" or ".join(f'"{character}"' for character in marks),
                )
        if self.thousands and self.thousands == self.decimal:
            raise InputError(
                f'decimal and thousands are both "{self.decimal}"',
                allowed="two different marks",
                remedy="Correct one of them, or leave one out.",
            )

    @property
    def pattern(self) -> str:
        """Pattern of a number with these marks, of which `decimal` must be known."""
        mark = re.escape(self.decimal)
        integer = r"\d+"
        if self.thousands:
            mark_of_thousands = re.escape(self.thousands)
            integer = rf"(\d+|\d{{1,3}}({mark_of_thousands}\d{{3}})+)"
        return rf"[+-]?({integer}({mark}\d*)?|{mark}\d+){_EXPONENT}"


def csv_number_format(path: Path, decimal: str, thousands: str) -> NumberFormat | None:
    """Number format of a CSV file, None if no mark is given; other files have no such marks."""
    if not (decimal or thousands):
        return None
    if path.suffix.lower() != ".csv":
        raise InputError(
            "decimal or thousands is given for a file that is no CSV table",
            where=str(path),
            remedy="Leave it out.",
        )
    return NumberFormat(decimal, thousands)


@dataclass(frozen=True)
class CsvTable:
    """Table of a CSV file; its cells stay text until their column is asked for."""

    names: list[str]  #: Names of the columns; a unit from the line of units stands behind the name.
    cells: pa.Table  #: Text of all cells
    separator: str
    where: str  #: Path of the file, for errors.
    number_format: NumberFormat = field(default_factory=NumberFormat)

    def texts(self, index: int) -> list[str | None]:
        """Cells of a column."""
        return self._column(index).to_pylist()

    def numbers(self, indices: Sequence[int], *, text_allowed: bool = False) -> list[FloatArray]:
        """Values of columns; NaN where a cell is empty or, if that is allowed, no number."""
        columns = {index: self._column(index) for index in indices}
        decimal = self._decimal_mark(columns)
        return [
            self._parsed(self.names[index], columns[index], decimal, text_allowed=text_allowed)
            for index in indices
        ]

    def _column(self, index: int) -> pa.ChunkedArray:
        """Text of a column without surrounding blanks, null where a cell is empty."""
        import pyarrow.compute as pc

        column = pc.utf8_trim_whitespace(self.cells.column(index))
        is_empty = pc.equal(column, "")
        return pc.if_else(is_empty, None, column)

    def _decimal_mark(self, columns: dict[int, pa.ChunkedArray]) -> str:
        """Decimal mark of all columns, as given or as they have it; refuses what is ambiguous."""
        known = self.number_format
        if known.decimal:
            return known.decimal
        if known.thousands:
            return "," if known.thousands == "." else "."
        examples = {
            mark: (self.names[index], cell)
            for index, column in columns.items()
            for mark in DECIMAL_MARKS
            if (cell := _first(column, f"{re.escape(mark)}.*")) is not None
        }
        if len(examples) == 2:
            name, cell = examples["."]
            other_name, other_cell = examples[","]
            raise self._ambiguous(
                f"column {name} holds '{cell}' with a point and "
                f"column {other_name} holds '{other_cell}' with a comma",
                self._advice_for_both(list(columns.values())),
            )
        mark = next(iter(examples), ".")
        tells = any(
            self._shows_decimals(self.names[index], column, mark)
            for index, column in columns.items()
        )
        for index, column in columns.items():
            self._refuse_thousands(self.names[index], column, mark, decimals_elsewhere=tells)
        return mark

    def _advice_for_both(self, columns: Sequence[pa.ChunkedArray]) -> str:
        """Which of point and comma separates decimals, where all numbers can be read so."""
        keys = [
            f'loads: {{decimal: "{known.decimal}", thousands: "{known.thousands}"}}'
            for known in (NumberFormat(".", ","), NumberFormat(",", "."))
            if all(_first(column, known.pattern, matches=False) is None for column in columns)
        ]
        if not keys:
            return "Write all numbers with the same mark before the decimals"
        if len(keys) == 1:
            return f"Write {keys[0]}"
        return f"Say which separates decimals and which thousands: {' or '.join(keys)}"

    def _shows_decimals(self, name: str, column: pa.ChunkedArray, mark: str) -> bool:
        """True if a number of the column has the mark where none can separate thousands.

        As 0.050, 12.5 and 1234.567 do, or a shaft speed of 12.345 rpm.
        """
        import pyarrow.compute as pc

        is_marked = pc.match_substring(column, mark)
        marked = column.filter(is_marked)
        if _BELOW_A_THOUSAND.match(name):
            return len(marked) > 0
        return _first(marked, _grouped(mark), matches=False) is not None

    def _refuse_thousands(
        self, name: str, column: pa.ChunkedArray, mark: str, *, decimals_elsewhere: bool
    ) -> None:
        """Refuse a column whose mark may separate thousands.

        That is a mark twice in a number; three digits after each mark beside whole numbers, -1.080
        beside -995; and three digits after each mark where no number of any column shows decimals.
        """
        m = re.escape(mark)
        several = _first(column, rf"[+-]?\d+({m}\d*){{2,}}")
        marked = _first(column, _grouped(mark))
        if several is not None:
            problem = f"column {name} holds '{several}', which has its {_MARK_NAMES[mark]} twice"
        elif marked is None or _BELOW_A_THOUSAND.match(name):
            return
        else:
            whole = _first(column, r"[+-]?\d{1,3}")
            other = _first(column, rf"[+-]?\d{{1,3}}|{_grouped(mark)}", matches=False)
            if other is not None or (whole is None and decimals_elsewhere):
                return
            beside = f" beside '{whole}'" if whole else ""
            tells = "" if whole else ", and no number of another column tells which"
            problem = (
                f"column {name} holds '{marked}'{beside}, "
                f"where the {_MARK_NAMES[mark]} may separate decimals or thousands{tells}"
            )
        cell = several or marked or ""
        as_thousands = cell.replace(mark, "")
        remedy = f'Write loads: {{thousands: "{mark}"}} if it means {as_thousands}'
        if several is None:
            as_decimal = cell.replace(mark, ".")
            remedy += f', and loads: {{decimal: "{mark}"}} if it means {as_decimal}'
        raise self._ambiguous(problem, remedy)

    def _ambiguous(self, problem: str, remedy: str) -> InputError:
        return InputError(
            problem,
            where=self.where,
            allowed="one mark for decimals, and none or another one for thousands",
            remedy=f"{remedy}; in Python decimal=, thousands=; on the command line --decimal, "
            "--thousands.",
        )

    def _parsed(
        self, name: str, column: pa.ChunkedArray, decimal: str, *, text_allowed: bool
    ) -> FloatArray:
        import pyarrow as pa
        import pyarrow.compute as pc

        thousands = self.number_format.thousands
        if thousands in _OTHER_FORMS:
            other_forms = f"[{_OTHER_FORMS[thousands]}]"
            column = pc.replace_substring_regex(column, other_forms, thousands)
        number = NumberFormat(decimal, thousands).pattern
        wrong = _first(column, number, matches=False)
        if wrong is not None and text_allowed:
            is_number = pc.match_substring_regex(column, f"^(?:{number})$")
            column = pc.if_else(is_number, column, None)
        elif wrong is not None:
            row = pc.index(column, wrong).as_py() + 1
            raise InputError(
                f"column {name} holds {shown(wrong)}, not a number, in row {row} of the data",
                where=self.where,
                allowed=f"decimal numbers, all with a {_MARK_NAMES[decimal]} before the decimals",
                remedy=_remedy(wrong),
            )
        if thousands:
            column = pc.replace_substring(column, thousands, "")
        if decimal != ".":
            column = pc.replace_substring(column, decimal, ".")
        column = pc.replace_substring_regex(column, "[dD]", "e")
        return column.cast(pa.float64()).to_numpy()


def _grouped(mark: str) -> str:
    """Pattern of whole numbers in groups of three digits, with a mark between the groups."""
    return rf"[+-]?[1-9]\d{{0,2}}({re.escape(mark)}\d{{3}})+"


def _remedy(wrong: str) -> str:
    for mark, forms in _OTHER_FORMS.items():
        if re.match(rf"[+-]?\d{{1,3}}([{mark}{forms}]\d{{3}})+(?!\d)", wrong):
            return f'Its thousands are separated; write loads: {{thousands: "{mark}"}}.'
    if _DATE.match(wrong):
        return "This is a date or a time of day; write seconds from the start of the record."
    if "\u2212" in wrong:
        return "It has the minus sign U+2212; write a hyphen, -, in its place."
    if "*" in wrong:
        return "The number did not fit into its field; write it with a wider format."
    return "Look for text among the values, such as a second header line, and for decimal marks."


def _first(column: pa.ChunkedArray, pattern: str, *, matches: bool = True) -> str | None:
    """First cell that is of the pattern, or with `matches=False` that is not."""
    import pyarrow.compute as pc

    whole = pattern if pattern.endswith(".*") else f"^(?:{pattern})$"
    hits = pc.match_substring_regex(column, whole)
    if not matches:
        hits = pc.invert(hits)
    matching = column.filter(hits)
    if not len(matching):
        return None
    return matching[0].as_py()


def read_csv(path: Path, number_format: NumberFormat | None = None) -> CsvTable:
    """Read a CSV file as text; InputError if it has no header, or rows of another length."""
    text = _decoded(path.read_bytes())
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    comments: list[str] = []
    if "#" in text or "%" in text:
        comments = _COMMENT.findall(text)
        text = _COMMENT.sub("", text)
    body = text.lstrip("\n")
    first_line, _, below = body.partition("\n")
    separator_line = _SEPARATOR_LINE.fullmatch(first_line.strip(" "))
    if separator_line:
        body = below.lstrip("\n")
    header, _, rows = body.partition("\n")
    separator = max(_SEPARATORS, key=header.count)
    if separator_line:
        separator = separator_line[1]
    names = _cells(header, separator)
    if comments and any(map(_is_number, names)):  # the names stand in a comment, as NumPy has it
        last_comment = comments[-1].strip().lstrip("#% ")
        names = _cells(last_comment, separator)
        rows = body
    if not any(names):
        raise InputError(
            "not readable as a CSV table: it has no line with names of columns",
            where=str(path),
            remedy="Write the names of the columns into the first line.",
        )
    first_row, _, below_units = rows.lstrip("\n").partition("\n")
    cells = _cells(first_row, separator)
    are_words = any(cells) and not any(map(_is_number, cells))
    if are_words and below_units.strip():
        second_line, _, _ = below_units.lstrip("\n").partition("\n")
        second_row = _cells(second_line, separator)
        if len(cells) <= len(names) and any(map(_is_number, second_row)):
            names = [*map(name_with_unit, names, cells), *names[len(cells) :]]
            rows = below_units
            cells = second_row
    if cells:
        names = _fitted(names, cells)
    return CsvTable(
        names,
        _text_columns(rows, len(names), separator, path),
        separator,
        str(path),
        number_format or NumberFormat(),
    )


def _decoded(content: bytes) -> str:
    if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return content.decode("utf-16")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("latin-1")


def _cells(line: str, separator: str) -> list[str]:
    row = next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])
    return [cell.strip() for cell in row]


def _is_number(cell: str) -> bool:
    return re.fullmatch(rf"[+-]?[\d.,']*\d[\d.,']*{_EXPONENT}", cell) is not None


def name_with_unit(name: str, unit: str) -> str:
    """Name of a column with the unit below it, unless the name has this unit already."""
    unit = unit.strip("[]() ")
    plain_unit = re.sub(r"[\W_]", "", unit)
    plain_name = re.sub(r"[\W_]", "", name)
    if plain_name.endswith(plain_unit):
        return name
    return f"{name} [{unit}]"


def _fitted(names: list[str], row: list[str]) -> list[str]:
    """Names for the cells of a row, where one of the two lines ends with separators."""
    while len(names) > len(row) and not names[-1]:
        names = names[:-1]
    surplus = row[len(names) :]
    return names if any(surplus) else [*names, *surplus]


def _text_columns(rows: str, width: int, separator: str, path: Path) -> pa.Table:
    import pyarrow as pa
    from pyarrow import csv as arrow_csv

    names = [str(index) for index in range(width)]
    if not rows.strip():
        nothing = pa.array([], pa.string())
        return pa.table(dict.fromkeys(names, nothing))
    refused: list[arrow_csv.InvalidRow] = []

    def refuse(row: arrow_csv.InvalidRow) -> str:
        refused.append(row)
        return "error"

    try:
        read_options = arrow_csv.ReadOptions(column_names=names, use_threads=False)
        parse_options = arrow_csv.ParseOptions(delimiter=separator, invalid_row_handler=refuse)
        text_columns = dict.fromkeys(names, pa.string())
        convert_options = arrow_csv.ConvertOptions(
            column_types=text_columns, strings_can_be_null=True
        )
        return arrow_csv.read_csv(
            io.BytesIO(rows.encode()),
            read_options=read_options,
            parse_options=parse_options,
            convert_options=convert_options,
        )
    except pa.ArrowInvalid:
        if not refused:
            raise
        row = refused[0]
        raise InputError(
            f"not readable as a CSV table: row {row.number} of the data has {row.actual_columns} "
            f"values, {shown(row.text)}, and the header {width} names",
            where=str(path),
            allowed="as many values in every row as the header has names",
            remedy="Write the file again if it was cut off, delete text above the header, and "
            "separate columns by semicolons where numbers have decimal commas.",
        ) from None
