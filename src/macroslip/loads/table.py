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
main-bearing forces. CSV: comma-separated, decimal point, one header line.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from macroslip.errors import InputError

_SPEED = {"rpm": math.pi / 30.0, "rad_s": 1.0, "radps": 1.0}
_FORCE = {"N": 1.0, "kN": 1e3}
_MOMENT = {"Nm": 1.0, "kNm": 1e3}
_BASE = {"time": (("time",), {"s": 1.0}), "shaft_speed": (("shaft_speed", "rotor_speed"), _SPEED)}
_HUB = (
    _BASE
    | {name: ((name,), _FORCE) for name in ("fx", "fy", "fz")}
    | {name: ((name,), _MOMENT) for name in ("mx", "my", "mz")}
)
_BEARING = _BASE | {name: ((name,), _FORCE) for name in ("F_X0", "F_Y0", "F_Z0")}


def read_hub_table(path: Path, *, speed_needed: bool = True) -> dict:
    """Read time (n,) [s], shaft_speed (n,) [rad/s], force (n, 3) [N] and moment (n, 3) [N m] at the hub.

    Without a column for it, `shaft_speed` is left out unless it is needed; `reading` names the columns.
    """
    columns, taken = _read(
        path,
        _HUB,
        "F_X0",
        "This table holds main-bearing loads: read it with BearingLoads.read.",
        optional=() if speed_needed else ("shaft_speed",),
    )
    speed = {"shaft_speed": columns["shaft_speed"]} if "shaft_speed" in columns else {}
    return {
        "time": columns["time"],
        **speed,
        "force": np.column_stack([columns[name] for name in ("fx", "fy", "fz")]),
        "moment": np.column_stack([columns[name] for name in ("mx", "my", "mz")]),
        "reading": taken,
    }


def read_bearing_table(path: Path) -> dict[str, NDArray[np.float64]]:
    """Read time (n,) [s], shaft_speed (n,) [rad/s] and force (n, 3) [N] on the inner ring."""
    columns, _ = _read(
        path, _BEARING, "fx", "This table holds hub loads: read it with HubLoads.read, then main_bearing_load."
    )
    return {
        "time": columns["time"],
        "shaft_speed": columns["shaft_speed"],
        "force": np.column_stack([columns[name] for name in ("F_X0", "F_Y0", "F_Z0")]),
    }


def _read(
    path: Path, quantities: Mapping, other_kind: str, other_remedy: str, optional: tuple[str, ...] = ()
) -> tuple[dict[str, NDArray[np.float64]], tuple[str, ...]]:
    """Columns by quantity in SI units, and the names of those taken."""
    import pyarrow as pa

    table = _open(path)
    names = [name.strip() for name in table.column_names]
    if len(names) == 1 and (";" in names[0] or "\t" in names[0]):
        raise InputError(
            "the columns are separated by semicolons or tabs",
            where=str(path),
            allowed="commas between columns and points as decimal marks",
            remedy="Write the file again so.",
        )
    chosen: dict[str, tuple[int, float]] = {}
    missing = []
    for quantity, (prefixes, factors) in quantities.items():
        spellings = {f"{prefix}_{unit}": factor for prefix in prefixes for unit, factor in factors.items()}
        found = [i for i, name in enumerate(names) if name in spellings]
        if len(found) > 1:
            raise InputError(
                f"columns {' and '.join(names[i] for i in found)} both give {quantity}",
                where=str(path),
                allowed=f"one of {', '.join(spellings)}",
                remedy="Remove or rename all but one of them.",
            )
        if found:
            chosen[quantity] = found[0], spellings[names[found[0]]]
            continue
        near = [name for name in names if any(name == prefix or name.startswith(f"{prefix}_") for prefix in prefixes)]
        if near:
            raise InputError(
                f"column {near[0]} has no known unit",
                where=str(path),
                allowed=", ".join(spellings),
                remedy="Convert the values and rename the column.",
            )
        if quantity not in optional:
            missing.append(" or ".join(spellings))
    if missing:
        other = any(name.startswith(f"{other_kind}_") for name in names)
        raise InputError(
            f"no column for {'; '.join(missing)}. The columns are: {', '.join(names) or 'none'}",
            where=str(path),
            remedy=other_remedy if other else "Add or rename the columns; the unit is part of the name.",
        )
    result = {}
    for quantity, (i, factor) in chosen.items():
        column = table.column(i)
        kind = column.type
        if not (pa.types.is_floating(kind) or pa.types.is_integer(kind) or pa.types.is_null(kind)):
            raise InputError(
                f"column {names[i]} holds {kind}, not numbers",
                where=str(path),
                allowed="numbers with a decimal point",
                remedy="Look for text among the values, such as a second header line or a unit line.",
            )
        # Empty cells become NaN here and are reported with their time.
        values = column.cast(pa.float64()).to_numpy() * factor
        result[quantity] = _rebuild_uniform(values) if quantity == "time" and kind == pa.float32() else values
    return result, tuple(names[i] for i, _ in chosen.values())


def _open(path: Path):
    import pyarrow as pa

    try:
        if path.suffix.lower() == ".csv":
            from pyarrow import csv

            return csv.read_csv(path)
        import pyarrow.parquet as pq

        with pq.ParquetFile(path) as file:
            return file.read()
    except (pa.ArrowException, OSError, ValueError) as error:
        kind = "CSV" if path.suffix.lower() == ".csv" else "Parquet"
        raise InputError(
            f"not readable as a {kind} table ({error})",
            where=str(path),
            remedy="Write or copy the file again, if it was cut off.",
        ) from error


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
    for axis in (first + index / rate, first + index * float(f"{step:.6g}"), time[0] + index * step):
        if np.abs(axis - time).max() <= tolerance:
            return axis
    return time
