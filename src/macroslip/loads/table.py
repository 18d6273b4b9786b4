"""Load histories from a table (Parquet, CSV, a sheet of Excel) whose columns name quantity and unit.

A name is quantity, underscore, unit. Of each quantity there is one column; others are ignored.

=============================================  =================================================================
time                                           ``time_s``
shaft speed (``shaft_speed``/``rotor_speed``)  ``…_rpm``, ``…_r_min``, ``…_rad_s``, ``…_radps``
hub force ``fx``, ``fy``, ``fz``               ``…_N``, ``…_kN``
hub moment ``mx``, ``my``, ``mz``              ``…_Nm``, ``…_kNm``
main-bearing force ``F_X0``, ``F_Y0``, ``F_Z0``  ``…_N``, ``…_kN``
=============================================  ===================================================

A table of hub loads holds time, speed and the six hub loads; a table of bearing loads holds time,
speed and the three main-bearing forces. A unit may stand in brackets, ``fx [kN]`` or
``Rotor speed [rpm]``, and channels of
OpenFAST may have their own names, ``LSShftFxa_[kN]``, as tools export them: a table with all of
them is read as OpenFAST's own output is, with rotating axes and aliases.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from macroslip.arrays import FloatArray
from macroslip.constants import RPM
from macroslip.errors import InputError
from macroslip.input.messages import shown
from macroslip.loads.csv_text import NumberFormat, read_csv
from macroslip.loads.openfast import (
    FIXED_CHANNELS,
    Channels,
    is_load_channel,
    loads_from_channels,
)
from macroslip.loads.sheet_table import check_sheet, read_sheet
from macroslip.loads.source_file import FORCE, MOMENT, Samples
from macroslip.storage.workbook import EXTENSION

if TYPE_CHECKING:
    import pyarrow as pa

#: Names of the quantities in time, and the factors of their units.
_BASE = {
    "time": (("time",), {"s": 1.0}),
    "shaft_speed": (
        ("shaft_speed", "rotor_speed"),
        {"rpm": RPM, "r_min": RPM, "rad_s": 1.0, "radps": 1.0},
    ),
}
_UNITS = {"force": FORCE, "moment": MOMENT}
_HUB_VECTORS = {"force": ("fx", "fy", "fz"), "moment": ("mx", "my", "mz")}
_BEARING_VECTORS = {"force": ("F_X0", "F_Y0", "F_Z0")}
#: Quantities of OpenFAST's channels in the fixed axes of the shaft, by their names in lower case.
_OPENFAST = {name.lower(): quantity for quantity, names in FIXED_CHANNELS.items() for name in names}
#: Columns of loads that have this program's names.
_OWN_COMPONENT = re.compile(r"\s*([fm][xyz]|F_[XYZ]0)(?![a-zA-Z])")
_MISSING_COLUMNS = (
    "Add or rename the columns; the unit is part of the name, as in time_s or fx [kN]."
)
_TEXT_REMEDY = "Write the column as numbers: seconds for times, and no text or marks among them."
_IN_BRACKETS = re.compile(r"(?P<name>.*?)[ _]*[\[(](?P<unit>[^\[\]()]*)[\])]")


class Table(Protocol):
    """Table of a file: names of its columns, and their content by index."""

    @property
    def names(self) -> list[str]:
        """Names of the columns."""
        ...

    def texts(self, index: int) -> list[str | None]:
        """Cells of a column as text."""
        ...

    def numbers(self, indices: Sequence[int], *, text_allowed: bool = False) -> list[FloatArray]:
        """Values of columns; NaN where a cell is empty or, if that is allowed, no number."""
        ...


def read_hub_table(
    path: Path,
    *,
    speed_needed: bool = True,
    at_hub: bool = True,
    number_format: NumberFormat | None = None,
    sheet: str = "",
) -> dict:
    """Read a table of hub loads.

    Parameters
    ----------
    path : Path
        Parquet or CSV file, or workbook of Excel.
    speed_needed : bool
        True if the shaft speed is read; a table without a column of it is then refused.
    at_hub : bool
        True if moments that OpenFAST writes must be those at the hub.
    number_format : NumberFormat, optional
        Marks in the numbers of a CSV file.
    sheet : str
        Sheet of a workbook; the first one if it is empty.

    Returns
    -------
    dict
        time (n,) [s], shaft_speed (n,) [rad/s] if it is needed, force (n, 3) [N] and moment (n, 3) [N m] at the
        hub, and `reading`, the names of their columns.

    Raises
    ------
    InputError
        If a column is missing, is there twice, has no known unit, or holds no numbers.
    """
    table = open_table(path, number_format, sheet)
    channels = _openfast_channels(table, str(path))
    if channels is not None:
        return loads_from_channels(channels, speed_needed=speed_needed, at_hub=at_hub)
    remedy = "This table holds main-bearing loads: read it with BearingLoads.read."
    return _read(table, path, _HUB_VECTORS, ("F_X0", remedy), speed_needed=speed_needed)


def _openfast_channels(table: Table, where: str) -> Channels | None:
    """Channels of a table that was exported from OpenFAST's output, None of any other table."""
    columns = [_IN_BRACKETS.fullmatch(name.strip()) for name in table.names]
    channels = {}
    for index, column in enumerate(columns):
        if column is not None and is_load_channel(column["name"]):
            channels[index] = column
    names = [column["name"] for column in channels.values()]
    units = [column["unit"] for column in channels.values()]
    has_time = any(name.lower() == "time" for name in names)
    if not has_time or len(names) == 1 or any(map(_OWN_COMPONENT.match, table.names)):
        return None
    indices = list(channels)
    values = np.column_stack(table.numbers(indices, text_allowed=True))
    values = values[: _filled_rows(values)]
    texts = _texts(table, indices, values)
    samples = Samples(values, texts, _TEXT_REMEDY)
    return Channels(names, units, samples, where)


def _texts(table: Table, indices: Sequence[int], values: NDArray) -> dict[int, str]:
    """First cell that is no number in each column, by the position of the column in `indices`."""
    texts = {}
    for position, index in enumerate(indices):
        is_empty = np.isnan(values[:, position])
        empty = np.flatnonzero(is_empty)
        cells = []
        if empty.size:
            cells = table.texts(index)
        words = ((row, cells[row]) for row in empty)
        for row, word in words:
            if word and word.lower() != "nan":
                texts[position] = f"{shown(word)} (row {row + 1} of the data)"
                break
    return texts


def read_bearing_table(
    path: Path, number_format: NumberFormat | None = None, sheet: str = ""
) -> dict[str, FloatArray]:
    """Read time (n,) [s], shaft_speed (n,) [rad/s] and force (n, 3) [N] on the inner ring."""
    remedy = "This table holds hub loads: read it with HubLoads.read, then main_bearing_load."
    table = open_table(path, number_format, sheet)
    columns = _read(table, path, _BEARING_VECTORS, ("fx", remedy))
    del columns["reading"]
    return columns


def _read(
    table: Table,
    path: Path,
    vectors: Mapping[str, tuple[str, ...]],
    other_kind: tuple[str, str],
    *,
    speed_needed: bool = True,
) -> dict:
    """Arrays in SI units, and `reading`: the names of the columns they are from.

    `other_kind`: a quantity of the other kind of table, and the advice for such a table.
    """
    names = [_spelled(name) for name in table.names]
    quantities = dict(_BASE)
    if not speed_needed:
        del quantities["shaft_speed"]
    for field, components in vectors.items():
        quantities |= {name: ((name,), _UNITS[field]) for name in components}
    columns = {
        quantity: _find(names, table.names, quantity, _spellings(*choice), str(path))
        for quantity, choice in quantities.items()
    }
    missing = [
        " or ".join(_spellings(*quantities[quantity]))
        for quantity, column in columns.items()
        if column is None
    ]
    if missing:
        other_name, other_remedy = other_kind
        other = any(name.startswith(f"{other_name}_") for name in names)
        raise InputError(
            f"no column for {'; '.join(missing)}. "
            f"The columns are: {', '.join(table.names) or 'none'}",
            where=str(path),
            remedy=other_remedy if other else _MISSING_COLUMNS + _other_sheets(path),
        )
    chosen = {quantity: column for quantity, column in columns.items() if column is not None}
    numbers = table.numbers([index for index, _ in chosen.values()])
    factors = [factor for _, factor in chosen.values()]
    values = np.column_stack(numbers) * factors
    values = values[: _filled_rows(values)]
    series = dict(zip(chosen, values.T, strict=True))
    result: dict = {name: series[name] for name in _BASE if name in series}
    for field, components in vectors.items():
        result[field] = np.column_stack([series[name] for name in components])
    reading = tuple(table.names[index] for index, _ in chosen.values())
    return result | {"reading": reading}


def _other_sheets(path: Path) -> str:
    """Reminder that a workbook has other sheets; nothing for other files."""
    if path.suffix.lower() != EXTENSION:
        return ""
    return " Another sheet of the workbook is read if the key sheet names it."


def _filled_rows(values: FloatArray) -> int:
    """Number of rows before the empty ones at the end, which spreadsheets leave."""
    is_empty = np.isnan(values).all(axis=1)
    filled = np.flatnonzero(~is_empty)
    if not filled.size:
        return 0
    return int(filled[-1]) + 1


def _spelled(name: str) -> str:
    """Name of a column as quantity, underscore, unit.

    Examples
    --------
    >>> _spelled("LSShftMxa_[kN-m]"), _spelled("fx (kN)"), _spelled("Rotor speed [rpm]")
    ('mx_kNm', 'fx_kN', 'rotor_speed_rpm')
    """
    brackets = _IN_BRACKETS.fullmatch(name.strip())
    if brackets is None:
        return name.strip()
    quantity = "_".join(brackets["name"].split())
    if any(quantity.lower() in choices for choices, _ in _BASE.values()):
        quantity = quantity.lower()
    quantity = _OPENFAST.get(brackets["name"].lower(), quantity)
    unit = re.sub("[-·* ]", "", brackets["unit"]).replace("/", "_")
    return f"{quantity}_{unit}"


def _spellings(prefixes: tuple[str, ...], factors: Mapping[str, float]) -> dict[str, float]:
    spellings = {}
    for prefix in prefixes:
        for unit, factor in factors.items():
            spellings[f"{prefix}_{unit}"] = factor
    return spellings


def _find(
    names: list[str],
    original_names: list[str],
    quantity: str,
    spellings: Mapping[str, float],
    where: str,
) -> tuple[int, float] | None:
    """Column of a quantity and the factor that makes it SI; None if there is none."""
    matches = [index for index, name in enumerate(names) if name in spellings]
    if len(matches) > 1:
        raise InputError(
            f"columns {' and '.join(original_names[index] for index in matches)} "
            f"both give {quantity}",
            where=where,
            allowed=f"one of {', '.join(spellings)}",
            remedy="Remove or rename all but one of them.",
        )
    if matches:
        index = matches[0]
        return index, spellings[names[index]]
    prefixes = set()
    for spelling in spellings:
        prefix, _, _ = spelling.rpartition("_")
        prefixes.add(prefix)
    for name, original in zip(names, original_names, strict=True):
        if any(name == prefix or name.startswith(f"{prefix}_") for prefix in prefixes):
            raise InputError(
                f"column {original} has no known unit",
                where=where,
                allowed=", ".join(spellings),
                remedy="Convert the values and rename the column.",
            )
    return None


@dataclass(frozen=True)
class _ParquetTable:
    """Table of a Parquet file."""

    columns: pa.Table
    where: str

    @property
    def names(self) -> list[str]:
        return [name.strip() for name in self.columns.column_names]

    def texts(self, index: int) -> list[str | None]:
        cells = self.columns[index].to_pylist()
        return [None if cell is None else str(cell) for cell in cells]

    def numbers(self, indices: Sequence[int], *, text_allowed: bool = False) -> list[FloatArray]:
        return [self._values(index, text_allowed=text_allowed) for index in indices]

    def _values(self, index: int, *, text_allowed: bool) -> FloatArray:
        import pyarrow as pa

        column = self.columns.column(index)
        kind = column.type
        is_number = pa.types.is_floating(kind) or pa.types.is_integer(kind)
        if not is_number and not pa.types.is_null(kind):
            if text_allowed:
                return np.full(len(column), np.nan)
            raise InputError(
                f"column {self.names[index]} holds {kind}, not numbers",
                where=self.where,
                allowed="numbers",
                remedy="Convert the column: times to seconds, text to numbers.",
            )
        # Empty cells become NaN here and are reported with their time.
        values = column.cast(pa.float64()).to_numpy()
        is_time = _spelled(self.names[index]) == "time_s"
        if is_time and kind == pa.float32():
            return _rebuild_uniform(values)
        return values


def open_table(path: Path, number_format: NumberFormat | None = None, sheet: str = "") -> Table:
    """Table of a Parquet or CSV file or a sheet of a workbook; InputError if it is none.

    `number_format` are the marks in the numbers of a CSV file, which by default are found out;
    `sheet` is the one of a workbook, the first if it is empty.
    """
    check_sheet(path, sheet)
    if path.suffix.lower() == EXTENSION:
        return read_sheet(path, sheet)
    import pyarrow as pa
    import pyarrow.parquet as pq

    is_csv = path.suffix.lower() == ".csv"
    try:
        if is_csv:
            return read_csv(path, number_format)
        with pq.ParquetFile(path) as file:
            table = _ParquetTable(file.read(), str(path))
        table.names  # noqa: B018  # names that are no UTF-8 fail here
        return table
    except InputError:
        raise
    except (pa.ArrowException, OSError, ValueError) as error:
        kind = "CSV" if is_csv else "Parquet"
        raise InputError(
            f"not readable as a {kind} table ({error})",
            where=str(path),
            remedy="Write or copy the file again, if it was cut off, and text as UTF-8.",
        ) from error


def _rebuild_uniform(time: FloatArray) -> FloatArray:
    """Uniform axis that a float32 time column was rounded from; another column as it is.

    At 600 s neighbouring float32 numbers are 6e-5 s apart, which would give a record of 50 Hz steps
    that vary by 0.3 %.

    Examples
    --------
    >>> exact = np.arange(30000) / 50
    >>> rounded = exact.astype(np.float32).astype(float)
    >>> rebuilt = _rebuild_uniform(rounded)
    >>> print(f"{abs(np.diff(rounded) - 0.02).max():.0e} {abs(rebuilt - exact).max():.0e}")
    4e-05 0e+00
    """
    if time.size < 3 or not np.isfinite(time).all():
        return time
    first_stamp = time[0]
    step = (time[-1] - first_stamp) / (time.size - 1)
    if step <= 0:
        return time
    # First stamp, rate and step are round numbers as a rule: prefer those, where stamps allow it.
    # The shortest decimal that rounds to the stored number:
    first = float(str(np.float32(first_stamp)))
    rate = max(1, round(1.0 / step))
    index = np.arange(time.size, dtype=float)
    largest = np.float32(np.abs(time).max())
    tolerance = float(np.spacing(largest))
    for axis in (
        first + index / rate,
        first + index * float(f"{step:.6g}"),
        first_stamp + index * step,
    ):
        deviation = np.abs(axis - time).max()
        if deviation <= tolerance:
            return axis
    return time
