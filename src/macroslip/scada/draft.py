"""A description of an export to start from, by the names and values of its columns."""

from __future__ import annotations

import itertools
import os
from pathlib import Path

import numpy as np
import pandas as pd

from macroslip.errors import InputError
from macroslip.scada.columns import recognized, unit_of
from macroslip.scada.table_files import column_names, files_of, pieces

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
            remedy="Write the description by hand: docs/scada.md has one.",
        )
    values = _values(file, columns_found, sheet)
    columns = {quantity: _column(quantity, columns_found, values) for quantity in _NAMES}
    rated = {name: _largest(name, columns_found, values) for name in ("rotor_speed", "power")}
    relative = os.path.relpath(file, folder)
    lines = [
        "# Ten-minute means of a turbine: what macroslip scada init has recognized. Check it, and",
        "# complete what is in capitals.",
        f"turbine: {_turbine(values)}",
        f"files: [{_quoted(relative)}]",
        *([f"sheet: {_quoted(sheet)}"] if sheet else []),
        *_rows(columns_found, values),
        *_time(columns_found, values),
        "columns:",
        *(line for column in columns.values() for line in column),
        "# The largest values that occur, as a guess: write those of the turbine's data sheet.",
        f"rated: {{rotor_speed: {rated['rotor_speed']:.4g} r/min, power: {rated['power']:.5g} kW}}",
        "# Oil in the contacts over the sensor: nobody knows it; 5 K change wear by a factor of two.",
        "oil_offset: 0 K",
        "# For heat: what warms with the bearing, and a period in which it was sound.",
        "# capacity: {mass: 6 t, range: [4 t, 8 t]}",
        "# reference: [2024-01-01, 2024-12-31]",
    ]
    notes = [
        f"{_NAMES[quantity]}: {columns_found.get(quantity, 'not recognized')}"
        for quantity in _NAMES
    ]
    return "\n".join(lines) + "\n", notes


def _values(file: Path, columns: dict[str, str], sheet: str | None) -> pd.DataFrame:
    """The first rows of the recognized columns, by quantity; numbers where they are numbers."""
    parts = list(itertools.islice(pieces(file, columns.values(), sheet), 1))
    if not parts:
        raise InputError("the file has no rows", where=str(file))
    table = parts[0].head(_ROWS)
    return pd.DataFrame({quantity: table[name] for quantity, name in columns.items()})


def _column(quantity: str, columns: dict[str, str], values: pd.DataFrame) -> list[str]:
    """Line of a quantity; a comment for one that may be left out and was not recognized."""
    if quantity not in columns:
        unit = "degC" if quantity.endswith("temperature") else "m/s"
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
        return {"rotor_speed": "r/min", "power": "kW"}.get(quantity, "degC")
    if quantity == "rotor_speed":
        return "rad/s" if np.quantile(numbers, 0.99) < 4.0 else "r/min"
    if quantity == "power":
        largest = np.quantile(numbers, 0.99)
        return "MW" if largest < 30.0 else "kW" if largest < 30_000.0 else "W"
    median = np.median(numbers)
    return "K" if median > 200.0 else "degC"


def _numbers(values: pd.DataFrame, quantity: str) -> np.ndarray:
    numbers = np.asarray(pd.to_numeric(values[quantity], errors="coerce"), dtype=float)
    return numbers[np.isfinite(numbers)]


def _largest(quantity: str, columns: dict[str, str], values: pd.DataFrame) -> float:
    """Nearly the largest value [r/min or kW], by the unit in the name or a guess."""
    if quantity not in values:
        return 1.0
    numbers = _numbers(values, quantity)
    unit = unit_of(columns[quantity]) or _guessed(quantity, numbers)
    factor = {"rad/s": 30.0 / np.pi, "MW": 1e3, "W": 1e-3}.get(unit, 1.0)
    return factor * float(np.quantile(numbers, 0.999)) if numbers.size else 1.0


def _turbine(values: pd.DataFrame) -> str:
    if "turbine" not in values:
        return "NAME"
    return _quoted(str(values["turbine"].dropna().iloc[0]))


def _rows(columns: dict[str, str], values: pd.DataFrame) -> list[str]:
    """The section on rows, where a file has several turbines."""
    several = "turbine" in columns and len(set(values["turbine"])) > 1
    if not several:
        return []
    return [f"rows: {{column: {_quoted(columns['turbine'])}, equals: {_turbine(values)}}}"]


def _time(columns: dict[str, str], values: pd.DataFrame) -> list[str]:
    """The section on time, with the step that the rows have, and a zone where texts tell none."""
    if "time" not in columns:
        return [
            "# No column of time was recognized: name it, or assume that rows follow one another.",
            f"time: {{column: {_MISSING}}}",
        ]
    texts = values["time"].astype("string")
    has_offset = bool(texts.str.contains(r"(?:Z|[+-]\d\d:?\d\d)\s*$", regex=True).all())
    dates = pd.to_datetime(texts.head(2000), format="ISO8601", utc=True, errors="coerce")
    form = ""
    if dates.isna().all():
        form = ", format: '%d.%m.%Y %H:%M'"
        dates = pd.to_datetime(texts.head(2000), format="%d.%m.%Y %H:%M", utc=True, errors="coerce")
    steps = np.diff(np.unique(dates.dropna())).astype("timedelta64[s]").astype(float)
    minutes = float(np.median(steps)) / 60.0 if steps.size else 10.0
    zone = "" if has_offset else ", zone: UTC"
    lines = [] if has_offset else ["# The times tell no offset: is the clock in UTC?"]
    section = f"column: {_quoted(columns['time'])}{zone}{form}, stamp: start, step: {minutes:g} min"
    return [*lines, f"time: {{{section}}}"]


def _quoted(text: str | None) -> str:
    """Text as YAML in single quotes."""
    return "'" + str(text).replace("'", "''") + "'"
