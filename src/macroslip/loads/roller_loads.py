"""Loads of the rollers from elsewhere, such as a finite-element model of bearing, housing and shaft."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from macroslip.errors import InputError
from macroslip.files import reading
from macroslip.loads.csv_text import csv_number_format
from macroslip.loads.history import BearingLoads, History, cut
from macroslip.loads.source_file import DAMAGED, RPM, source_file
from macroslip.loads.table import open_table

ROW_NAMES = ("downwind", "upwind")
COLUMNS = ("time_s", "shaft_speed_rpm", "row", "angle_deg", "load_N")


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class RollerLoads(History):
    """Load of a roller over its place in the bearing, at times: in place of a balance of the inner ring.

    Between places a roller's approach, which goes with its load to the power 2/3, is linear in the angle; between times it is
    linear in time at a place at rest. A place without load has the bearing's clearance as its play. Raises InputError
    as `HubLoads`, for a negative load, and for a place given twice.

    Parameters
    ----------
    time, shaft_speed : (n,) array [s], [rad/s]
        As in `HubLoads`.
    angle : (n, 2, m) array [rad]
        Places over time, row (downwind, upwind) and number; from the horizontal X0, counter-clockwise about Z0.
    load : (n, 2, m) array [N]
        Load along the contact normal that a roller at the place has, 0 or more.
    source : str
        Where the loads come from, for errors and reports.

    Examples
    --------
    >>> places = np.radians(np.tile(np.arange(0.0, 360.0, 45.0), (2, 2, 1)))
    >>> even = RollerLoads(np.array([0.0, 1.0]), np.full(2, 2.1), places, np.full(places.shape, 1e4), "even")
    >>> np.abs(even.resultant(0.2, 28).force).round(6).tolist()
    [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]
    """

    _VECTORS: ClassVar = {}
    event: ClassVar[bool] = False
    time: NDArray[np.float64]
    shaft_speed: NDArray[np.float64]
    angle: NDArray[np.float64]
    load: NDArray[np.float64]
    source: str

    def __post_init__(self) -> None:
        History.__post_init__(self)
        shape = (self.time.size, len(ROW_NAMES), np.shape(self.load)[-1])
        for name in ("angle", "load"):
            values = np.array(getattr(self, name), dtype=float)
            if values.shape != shape or not np.isfinite(values).all():
                raise InputError(
                    f"{name} has the shape {values.shape}, or values that are not finite",
                    where=self.source,
                    allowed=f"finite numbers of shape {shape}: times, rows, places",
                )
            values.setflags(write=False)
            object.__setattr__(self, name, values)
        if (self.load < 0.0).any():
            raise InputError(
                "a load is negative", where=self.source, allowed="0 N or more; rollers only press"
            )
        turned = np.sort(np.mod(self.angle, 2.0 * math.pi), axis=2)
        if (np.diff(turned, axis=2) <= 1e-9).any():
            raise InputError(
                "a place is given twice",
                where=self.source,
                allowed="different angles in a row at a time",
            )

    @classmethod
    def read(
        cls,
        path: str | os.PathLike[str],
        *,
        start: float | None = None,
        end: float | None = None,
        decimal: str = "",
        thousands: str = "",
    ) -> RollerLoads:
        """Read a table (``.csv``, ``.parquet``) with the columns time_s, shaft_speed_rpm, row, angle_deg and load_N.

        One line for each time, row and place, in any order; row is downwind or upwind. The other
        parameters are those of `HubLoads.read`. Raises InputError if the file cannot be read, lacks a column, or has not as many places in each
        row at each time.
        """
        path, _ = source_file(
            path, {".csv": "table", ".parquet": "table"}, "Columns: " + ", ".join(COLUMNS)
        )
        number_format = csv_number_format(path, decimal, thousands)
        with reading(path, DAMAGED):
            table = open_table(path, number_format)
        missing = [name for name in COLUMNS if name not in table.names]
        if missing:
            what = f"no column {', '.join(missing)}. The columns are: {', '.join(table.names)}"
            raise InputError(
                what,
                where=str(path),
                allowed=", ".join(COLUMNS),
                remedy="Add or rename the columns.",
            )
        rows = table.texts(table.names.index("row"))
        strange = sorted({str(row) for row in rows} - set(ROW_NAMES))
        if strange:
            raise InputError(
                f"row is {strange[0]}", where=str(path), allowed=" or ".join(ROW_NAMES)
            )
        names = [name for name in COLUMNS if name != "row"]
        with reading(path, DAMAGED):
            numbers = table.numbers([table.names.index(name) for name in names])
        import pandas as pd

        places = pd.DataFrame(dict(zip(names, numbers, strict=True)))
        places["row"] = [ROW_NAMES.index(str(row)) for row in rows]
        places = places.sort_values(["time_s", "row", "angle_deg"])
        counts = places.groupby(["time_s", "row"]).size()
        times = places.time_s.nunique()
        if counts.size != 2 * times or counts.nunique() != 1:
            raise InputError(
                f"rows have {counts.min()} to {counts.max()} places, "
                f"{counts.size} rows at {times} times",
                where=str(path),
                allowed="as many places in both rows at every time",
                remedy="Give places without load as well, with 0 N.",
            )
        shape = (-1, len(ROW_NAMES), int(counts.iloc[0]))
        time, speed, angle, load = (places[name].to_numpy().reshape(shape) for name in names)
        if np.ptp(speed, axis=(1, 2)).any():
            raise InputError(
                "the shaft has two speeds at one time",
                where=str(path),
                allowed="one shaft_speed_rpm a time",
            )
        columns = {
            "time": time[:, 0, 0],
            "shaft_speed": speed[:, 0, 0] * RPM,
            "angle": np.radians(angle),
            "load": load,
        }
        return cls(**cut(columns, start, end, str(path)), source=str(path))

    def _forces(self) -> dict[str, NDArray[np.float64]]:
        return dict(zip(ROW_NAMES, self.load.mean(axis=2).T, strict=True))

    def resultant(self, contact_angle: float, rollers_per_row: int) -> BearingLoads:
        """Load on the inner ring that rollers with these loads carry together, at a contact angle [rad].

        Where a row has more or fewer places than rollers, each place stands for its share of them.
        """
        share = rollers_per_row / self.load.shape[2]
        radial, signs = math.cos(contact_angle) * self.load, np.array([1.0, -1.0])
        force = np.column_stack(
            [
                (radial * np.cos(self.angle)).sum(axis=(1, 2)),
                (radial * np.sin(self.angle)).sum(axis=(1, 2)),
                math.sin(contact_angle) * (self.load.sum(axis=2) @ signs),
            ]
        )
        return BearingLoads(self.time, self.shaft_speed, share * force, self.source)

    def approach(self, stiffness: float, play: float) -> NDArray[np.float64]:
        """Approach of inner ring and outer ring at every place [m], from K [N/m^1.5]; minus the play [m] without load."""
        return np.where(self.load > 0.0, (self.load / stiffness) ** (2.0 / 3.0), -play)
