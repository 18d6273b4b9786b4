"""Load histories from a table, Parquet or CSV, whose column names carry the unit: quantity, underscore, unit.

Of each quantity one column, spelled exactly so; other columns are ignored.

====================================================  =========================================================
time                                                  ``time_s``
shaft speed (``shaft_speed`` or ``rotor_speed``)      ``…_rpm``, ``…_rad_s``, ``…_radps``
hub force ``fx``, ``fy``, ``fz``                      ``…_N``, ``…_kN``
hub moment ``mx``, ``my``, ``mz``                     ``…_Nm``, ``…_kNm``
main-bearing force ``F_X0``, ``F_Y0``, ``F_Z0``       ``…_N``, ``…_kN``
====================================================  =========================================================

A hub-load table holds time, speed and the six hub loads; a bearing-load table holds time, speed and the three
main-bearing forces. CSV: one header line; commas between columns and decimal points, or semicolons or tabs between columns and
either decimal mark.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from macroslip.errors import InputError
from macroslip.loads.source_file import FORCE, MOMENT, RPM

#: Names of a quantity, and the factors of its units.
_Choice = tuple[tuple[str, ...], Mapping[str, float]]
_BASE: dict[str, _Choice] = {
    "time": (("time",), {"s": 1.0}),
    "shaft_speed": (("shaft_speed", "rotor_speed"), {"rpm": RPM, "rad_s": 1.0, "radps": 1.0}),
}
_HUB_VECTORS = {"force": ("fx", "fy", "fz"), "moment": ("mx", "my", "mz")}
_BEARING_VECTORS = {"force": ("F_X0", "F_Y0", "F_Z0")}


def read_hub_table(path: Path, *, speed_needed: bool = True) -> dict:
    """Read time (n,) [s], shaft_speed (n,) [rad/s], force (n, 3) [N] and moment (n, 3) [N m] at the hub.

    Without a column for it, `shaft_speed` is left out unless it is needed; `reading` names the columns.
    """
    remedy = "This table holds main-bearing loads: read it with BearingLoads.read."
    return _read(path, _HUB_VECTORS, "F_X0", remedy, () if speed_needed else ("shaft_speed",))


def read_bearing_table(path: Path) -> dict[str, NDArray[np.float64]]:
    """Read time (n,) [s], shaft_speed (n,) [rad/s] and force (n, 3) [N] on the inner ring."""
    remedy = "This table holds hub loads: read it with HubLoads.read, then main_bearing_load."
    columns = _read(path, _BEARING_VECTORS, "fx", remedy)
    del columns["reading"]
    return columns


def _read(
    path: Path,
    vectors: Mapping[str, tuple[str, ...]],
    other_kind: str,
    other_remedy: str,
    optional: tuple[str, ...] = (),
) -> dict:
    """Arrays in SI units, and `reading`: the names of the columns they are from."""
    table = open_table(path)
    names = [name.strip() for name in table.column_names]
    units = {"force": FORCE, "moment": MOMENT}
    quantities = dict(_BASE)
    for field, components in vectors.items():
        quantities |= {name: ((name,), units[field]) for name in components}
    found = {
        quantity: _find(names, quantity, *choice, str(path))
        for quantity, choice in quantities.items()
    }
    missing = [
        " or ".join(_spellings(*quantities[quantity]))
        for quantity, place in found.items()
        if place is None and quantity not in optional
    ]
    if missing:
        other = any(name.startswith(f"{other_kind}_") for name in names)
        raise InputError(
            f"no column for {'; '.join(missing)}. The columns are: {', '.join(names) or 'none'}",
            where=str(path),
            remedy=other_remedy
            if other
            else "Add or rename the columns; the unit is part of the name.",
        )
    chosen = {quantity: place for quantity, place in found.items() if place is not None}
    columns = {
        name: _values(table, *place, name == "time", str(path)) for name, place in chosen.items()
    }
    result: dict = {name: columns[name] for name in _BASE if name in columns}
    result |= {
        field: np.column_stack([columns[name] for name in vectors[field]]) for field in vectors
    }
    return result | {"reading": tuple(names[i] for i, _ in chosen.values())}


def _spellings(prefixes: tuple[str, ...], factors: Mapping[str, float]) -> dict[str, float]:
    return {f"{prefix}_{unit}": factor for prefix in prefixes for unit, factor in factors.items()}


def _find(
    names: list[str],
    quantity: str,
    prefixes: tuple[str, ...],
    factors: Mapping[str, float],
    where: str,
) -> tuple[int, float] | None:
    """Column of a quantity and the factor that makes it SI; None if there is none."""
    spellings = _spellings(prefixes, factors)
    found = [i for i, name in enumerate(names) if name in spellings]
    if len(found) > 1:
        raise InputError(
            f"columns {' and '.join(names[i] for i in found)} both give {quantity}",
            where=where,
            allowed=f"one of {', '.join(spellings)}",
            remedy="Remove or rename all but one of them.",
        )
    if found:
        return found[0], spellings[names[found[0]]]
    near = [
        name
        for name in names
        if any(name == prefix or name.startswith(f"{prefix}_") for prefix in prefixes)
    ]
    if near:
        raise InputError(
            f"column {near[0]} has no known unit",
            where=where,
            allowed=", ".join(spellings),
            remedy="Convert the values and rename the column.",
        )
    return None


def _values(table, index: int, factor: float, is_time: bool, where: str) -> NDArray[np.float64]:
    import pyarrow as pa

    column = table.column(index)
    kind = column.type
    if not (pa.types.is_floating(kind) or pa.types.is_integer(kind) or pa.types.is_null(kind)):
        raise InputError(
            f"column {table.column_names[index].strip()} holds {kind}, not numbers",
            where=where,
            allowed="numbers, all with the same decimal mark",
            remedy="Look for text among the values, such as a second header line or a unit line.",
        )
    # Empty cells become NaN here and are reported with their time.
    values = column.cast(pa.float64()).to_numpy() * factor
    return _rebuild_uniform(values) if is_time and kind == pa.float32() else values


def open_table(path: Path):
    """The table of a Parquet or CSV file, of pyarrow; refuses what is none."""
    import pyarrow as pa

    try:
        if path.suffix.lower() == ".csv":
            table = _csv(path)
        else:
            import pyarrow.parquet as pq

            with pq.ParquetFile(path) as file:
                table = file.read()
        table.column_names  # noqa: B018  # names that are no UTF-8 fail here
        return table
    except (pa.ArrowException, OSError, ValueError) as error:
        kind = "CSV" if path.suffix.lower() == ".csv" else "Parquet"
        what = f"not readable as a {kind} table ({error})"
        remedy = "Write or copy the file again, if it was cut off, and text as UTF-8."
        raise InputError(what, where=str(path), remedy=remedy) from error


def _csv(path: Path):
    """A table of text. The header tells what separates columns; where that is no comma, decimals may have one."""
    import pyarrow as pa
    from pyarrow import csv

    with path.open("rb") as file:
        header = file.readline(100_000)
    separator = max(",;\t", key=lambda one: header.count(one.encode()))
    table, *others = (
        csv.read_csv(
            path, parse_options=csv.ParseOptions(delimiter=separator),
            convert_options=csv.ConvertOptions(decimal_point=mark),
        )
        for mark in (".," if separator != "," else ".")
    )  # fmt: skip
    return min((table, *others), key=lambda one: sum(map(pa.types.is_string, one.schema.types)))


def _rebuild_uniform(time: NDArray[np.float64]) -> NDArray[np.float64]:
    """The uniform axis that a float32 time column was rounded from, or the column itself if it is not uniform.

    At 600 s neighbouring float32 numbers are 6e-5 s apart, which would give a 50 Hz record steps that vary by 0.3 %.

    Examples
    --------
    >>> exact = np.arange(30000) / 50
    >>> rounded = exact.astype(np.float32).astype(float)
    >>> print(f"{abs(np.diff(rounded) - 0.02).max():.0e} {abs(_rebuild_uniform(rounded) - exact).max():.0e}")
    4e-05 0e+00
    """
    if time.size < 3 or not np.isfinite(time).all():
        return time
    step = (time[-1] - time[0]) / (time.size - 1)
    if step <= 0:
        return time
    # First stamp, rate and step are round numbers as a rule: prefer those, where the stamps allow it.
    first = float(str(np.float32(time[0])))  # the shortest decimal that rounds to the stored number
    rate = max(1, round(1.0 / step))
    index = np.arange(time.size, dtype=float)
    tolerance = float(np.spacing(np.float32(np.abs(time).max())))
    for axis in (
        first + index / rate,
        first + index * float(f"{step:.6g}"),
        time[0] + index * step,
    ):
        if np.abs(axis - time).max() <= tolerance:
            return axis
    return time
