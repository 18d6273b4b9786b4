"""A description of an export to start from, by the names and values of its columns."""

from __future__ import annotations

import itertools
import os
import textwrap
from pathlib import Path

import numpy as np
import pandas as pd

from macroslip.errors import InputError
from macroslip.scada.columns import recognized, unit_of
from macroslip.scada.table_files import column_names, files_of, pieces, sheet_names

_NEEDED = ("wind_speed", "rotor_speed", "power", "bearing_temperature")
_NAMES = {
    "wind_speed": "wind speed",
    "rotor_speed": "speed of the rotor",
    "power": "electrical power",
    "bearing_temperature": "temperature of the main bearing",
    "nacelle_temperature": "air in the nacelle",
    "ambient_temperature": "air outside",
}
_MISSING = "NAME OF THE COLUMN"
#: Units of a quantity whose values tell nothing; the others are temperatures.
_USUAL = {"wind_speed": "m/s", "rotor_speed": "r/min", "power": "kW"}
#: Forms of times beside ISO 8601, a day before a month where both fit.
_FORMS = tuple(
    f"{day} {clock}"
    for day in ("%d.%m.%Y", "%d/%m/%Y", "%m/%d/%Y", "%d-%m-%Y")
    for clock in ("%H:%M", "%H:%M:%S", "%I:%M:%S %p", "%I:%M %p")
)
#: Width of a comment.
_WIDTH = 100
#: Rows by which values are judged.
_ROWS = 200_000


def draft(file: Path, folder: Path, sheet: str | None = None) -> tuple[str, list[str]]:
    """Description of an export as YAML, and what was recognized, in sentences.

    Parameters
    ----------
    file : Path
        The export.
    folder : Path
        Folder of the description, from which the path of the export starts.
    sheet : str, optional
        Name of the sheet of an xlsx file.

    Returns
    -------
    tuple
        Text of the file, and lines about the columns. What has to be completed by hand is marked.

    Raises
    ------
    InputError
        If the export cannot be read.
    """
    files_of([str(file)], Path())
    names = column_names(file, sheet)
    columns_found = recognized(names)
    if not columns_found:
        raise InputError(
            "no column has a name that is known",
            where=str(file),
            allowed=", ".join(names[:20]),
            remedy=_other_sheets(file, sheet)
            or "Write the description by hand: docs/scada.md has one.",
        )
    values = _values(file, columns_found, sheet)
    columns = {quantity: _column(quantity, columns_found, values) for quantity in _NAMES}
    rated = {
        "rotor_speed": f"{_largest('rotor_speed', columns_found, values)} r/min",
        "power": f"{_largest('power', columns_found, values)} kW",
    }
    relative = os.path.relpath(file, folder)
    lines = [
        "# Ten-minute means of a turbine: what macroslip scada init has recognized. Check it, and",
        "# complete what is in capitals.",
        f"turbine: {_turbine(values)}",
        f"files: [{_quoted(relative)}]",
        *([f"sheet: {_quoted(sheet)}"] if sheet else []),
        *_rows(columns_found, values),
        *_time(columns_found, values),
        *_other_columns(names, columns_found),
        "columns:",
        *(line for column in columns.values() for line in column),
        "# The largest values that occur, as a guess: write those of the turbine's data sheet.",
        f"rated: {{rotor_speed: {rated['rotor_speed']}, power: {rated['power']}}}",
        "# Oil in the contacts over the sensor: nobody knows it; 5 K change wear by a factor of two.",
        "oil_offset: 0 K",
        "# For heat: what warms with the bearing, and a period in which it was sound.",
        "# capacity: {mass: 6 t, range: [4 t, 8 t]}",
        "# reference: [2024-01-01, 2024-12-31]",
    ]
    notes = [
        f"{_NAMES[quantity]}: {columns_found.get(quantity, _unknown(quantity))}"
        for quantity in _NAMES
    ]
    return "\n".join(lines) + "\n", notes


def _values(file: Path, columns: dict[str, str], sheet: str | None) -> pd.DataFrame:
    """The first rows of the recognized columns, by quantity; numbers where they are numbers."""
    parts = list(itertools.islice(pieces(file, columns.values(), sheet), 1))
    if not parts:
        raise InputError("the file has no rows", where=str(file))
    table = parts[0].head(_ROWS)
    by_quantity = {quantity: table[name] for quantity, name in columns.items()}
    return pd.DataFrame(by_quantity)


def _column(quantity: str, columns: dict[str, str], values: pd.DataFrame) -> list[str]:
    """Line of a quantity; a comment for one that may be left out and was not recognized."""
    if quantity not in columns:
        unit = _USUAL.get(quantity, "degC")
        mark = "  " if quantity in _NEEDED else "  # "
        return [f"{mark}{quantity}: {{column: {_MISSING}, unit: {unit}}}"]
    name = columns[quantity]
    unit_in_name = unit_of(name)
    unit = unit_in_name or _guessed(quantity, _numbers(values, quantity))
    comment = "" if unit_in_name else "  # the unit is a guess by the values"
    return [f"  {quantity}: {{column: {_quoted(name)}, unit: {unit}}}{comment}"]


def _guessed(quantity: str, numbers: np.ndarray) -> str:
    """The unit in which the values of a quantity are likely to be."""
    if quantity == "wind_speed":
        return "m/s"
    if not numbers.size:
        return _USUAL.get(quantity, "degC")
    if quantity == "rotor_speed":
        return "rad/s" if np.quantile(numbers, 0.99) < 4.0 else "r/min"
    if quantity == "power":
        largest = np.quantile(numbers, 0.99)
        return "MW" if largest < 30.0 else "kW" if largest < 30_000.0 else "W"
    median = np.median(numbers)
    return "K" if median > 200.0 else "degC"


def _numbers(values: pd.DataFrame, quantity: str) -> np.ndarray:
    numeric = pd.to_numeric(values[quantity], errors="coerce")
    numbers = np.asarray(numeric, dtype=float)
    return numbers[np.isfinite(numbers)]


def _largest(quantity: str, columns: dict[str, str], values: pd.DataFrame) -> str:
    """Nearly the largest value [r/min or kW], by the unit in the name or a guess, as text."""
    numbers = np.empty(0)
    if quantity in values:
        numbers = _numbers(values, quantity)
    if not numbers.size:
        return "NUMBER"
    unit = unit_of(columns[quantity]) or _guessed(quantity, numbers)
    to_usual = {"rad/s": 30.0 / np.pi, "MW": 1e3, "W": 1e-3}
    factor = to_usual.get(unit, 1.0)
    largest = float(np.quantile(numbers, 0.999))
    return f"{factor * largest:.5g}"


def _unknown(quantity: str) -> str:
    """Line of a quantity without a column."""
    is_needed = quantity in _NEEDED
    return f"not recognized{'; it is needed: write its column into the file' if is_needed else ''}"


def _other_columns(names: list[str], columns: dict[str, str]) -> list[str]:
    """The other columns of the file, in a comment, where one that is needed was not recognized."""
    if all(quantity in columns for quantity in (*_NEEDED, "time")):
        return []
    others = [name for name in names if name and name not in columns.values()]
    listed = ", ".join(others) or "none"
    text = f"Columns of the file that were not recognized: {listed}."
    return textwrap.wrap(text, _WIDTH, initial_indent="# ", subsequent_indent="#   ")


def _other_sheets(file: Path, sheet: str | None) -> str:
    """How to name another sheet of an XLSX file that has several; empty for any other file."""
    others = [name for name in sheet_names(file) if name != sheet]
    if not others or (sheet is None and len(others) == 1):
        return ""
    return f"Name a sheet with --sheet: {', '.join(others)}."


def _turbine(values: pd.DataFrame) -> str:
    if "turbine" not in values:
        return "NAME"
    names = values["turbine"].dropna()
    return _quoted(str(names.iloc[0]))


def _rows(columns: dict[str, str], values: pd.DataFrame) -> list[str]:
    """The section on rows, where a file has several turbines."""
    if "turbine" not in columns or len(set(values["turbine"])) < 2:
        return []
    name = _quoted(columns["turbine"])
    return [f"rows: {{column: {name}, equals: {_turbine(values)}}}"]


def _time(columns: dict[str, str], values: pd.DataFrame) -> list[str]:
    """The section on time, with the step that the rows have, and a zone where texts tell none."""
    if "time" not in columns:
        return [
            "# No column of time was recognized: name it, or assume that rows follow one another.",
            f"time: {{column: {_MISSING}}}",
        ]
    texts = values["time"].astype("string")
    is_offset = texts.str.contains(r"(?:Z|[+-]\d\d:?\d\d)\s*$", regex=True)
    has_offset = bool(is_offset.all())
    dates, form = _dates(texts.drop_duplicates())
    different = np.unique(dates.dropna())
    steps = np.diff(different).astype("timedelta64[s]")
    minutes = 10.0
    if steps.size:
        minutes = float(np.median(steps.astype(float))) / 60.0
    zone = ""
    lines = []
    if not has_offset:
        zone = ", zone: UTC"
        lines = ["# The times tell no offset: is the clock in UTC?"]
    name = _quoted(columns["time"])
    section = f"column: {name}{zone}{form}, stamp: start, step: {minutes:g} min"
    return [*lines, f"time: {{{section}}}"]


def _dates(texts: pd.Series) -> tuple[pd.Series, str]:
    """Texts as dates, and the key of the form that reads most of them, if it is not ISO 8601."""
    dates = pd.to_datetime(texts, format="ISO8601", utc=True, errors="coerce")
    if dates.notna().any():
        return dates, ""
    read = {}
    known = {}
    for form in _FORMS:
        read[form] = pd.to_datetime(texts, format=form, utc=True, errors="coerce")
        known[form] = int(read[form].notna().sum())
    best = max(_FORMS, key=lambda form: known[form])
    if not known[best]:
        return dates, ", format: FORM OF THE TIMES"
    return read[best], f", format: '{best}'"


def _quoted(text: str | None) -> str:
    """Text as YAML in single quotes."""
    doubled = str(text).replace("'", "''")
    return f"'{doubled}'"
