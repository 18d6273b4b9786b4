"""Loads of the rollers from elsewhere, such as an FE model of bearing, housing and shaft."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from macroslip.arrays import FloatArray
from macroslip.constants import RPM
from macroslip.errors import InputError
from macroslip.loads.csv_text import csv_number_format
from macroslip.loads.history import BearingLoads, History, cut
from macroslip.loads.source_file import DAMAGED, source_file
from macroslip.loads.table import open_table
from macroslip.storage.files import reading

ROW_NAMES = ("downwind", "upwind")
COLUMNS = ("time_s", "shaft_speed_rpm", "row", "angle_deg", "load_N")


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class RollerLoads(History):
    """Load of a roller by its position over time, in place of a balance of the ring.

    Between positions a roller's approach, which goes with its load to the power 2/3, is linear in
    the angle; between times it is linear in time at a position at rest. A position without load has
    the bearing's clearance as its play. Raises InputError as `HubLoads`, for a negative load, and
    for a position given twice.

    Parameters
    ----------
    time, shaft_speed : (n,) array [s], [rad/s]
        As in `HubLoads`.
    angle : (n, 2, m) array [rad]
        Positions over time, row (downwind, upwind) and number; from the horizontal X0,
        counter-clockwise about Z0.
    load : (n, 2, m) array [N]
        Load along the contact normal that a roller at the position has, 0 or more.
    source : str
        Where the loads come from, for errors and reports.

    Examples
    --------
    >>> angle = np.radians(np.tile(np.arange(0.0, 360.0, 45.0), (2, 2, 1)))
    >>> load = np.full(angle.shape, 1e4)
    >>> even = RollerLoads(np.array([0.0, 1.0]), np.full(2, 2.1), angle, load, "even")
    >>> np.abs(even.resultant(0.2, 28).force).round(6).tolist()
    [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]
    """

    _VECTORS: ClassVar = {}
    event: ClassVar[bool] = False
    time: FloatArray
    shaft_speed: FloatArray
    angle: FloatArray
    load: FloatArray
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
        angle_in_turn = np.mod(self.angle, 2.0 * math.pi)
        turned = np.sort(angle_in_turn, axis=2)
        distance = np.diff(turned, axis=2)
        if (distance <= 1e-9).any():
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
        sheet: str = "",
    ) -> RollerLoads:
        """Read a table (``.csv``, ``.parquet``, ``.xlsx``) of the loads of rollers.

        Columns are time_s, shaft_speed_rpm, row, angle_deg and load_N. There is one line for each
        time, row and position, in any order; row is downwind or upwind.

        Parameters
        ----------
        path : path
            The table.
        start, end, decimal, thousands, sheet : optional
            As in `HubLoads.read`.

        Returns
        -------
        RollerLoads

        Raises
        ------
        InputError
            If the file cannot be read, lacks a column, or has not as many positions in each row at
            each time.
        """
        kinds = {".csv": "table", ".parquet": "table", ".xlsx": "workbook of Excel"}
        path, _ = source_file(path, kinds, "Columns: " + ", ".join(COLUMNS))
        number_format = csv_number_format(path, decimal, thousands)
        with reading(path, DAMAGED):
            table = open_table(path, number_format, sheet)
        missing = [name for name in COLUMNS if name not in table.names]
        if missing:
            raise InputError(
                f"no column {', '.join(missing)}. The columns are: {', '.join(table.names)}",
                where=str(path),
                allowed=", ".join(COLUMNS),
                remedy="Add or rename the columns.",
            )
        rows = [str(row) for row in table.texts(table.names.index("row"))]
        strange = sorted(set(rows) - set(ROW_NAMES))
        if strange:
            raise InputError(
                f"row is {strange[0]}", where=str(path), allowed=" or ".join(ROW_NAMES)
            )
        with reading(path, DAMAGED):
            indices = [table.names.index(name) for name in COLUMNS if name != "row"]
            values = np.array(table.numbers(indices))
        row = np.array([ROW_NAMES.index(name) for name in rows])
        samples = np.stack([values[0], row])
        _, counts = np.unique(samples, axis=1, return_counts=True)
        times = np.unique(values[0]).size
        if counts.size != len(ROW_NAMES) * times or np.ptp(counts):
            raise InputError(
                f"rows have {counts.min()} to {counts.max()} places, "
                f"{counts.size} rows at {times} times",
                where=str(path),
                allowed="as many places in both rows at every time",
                remedy="Give places without load as well, with 0 N.",
            )
        order = np.lexsort((values[2], row, values[0]))
        time, speed, angle, load = values[:, order].reshape(4, times, len(ROW_NAMES), -1)
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

    def _forces(self) -> dict[str, FloatArray]:
        """Mean load of a row's positions (n,) [N] by the row's name."""
        mean = self.load.mean(axis=2)
        return dict(zip(ROW_NAMES, mean.T, strict=True))

    def resultant(self, contact_angle: float, rollers_per_row: int) -> BearingLoads:
        """Load on the inner ring that rollers with these loads carry, at a contact angle [rad].

        Where a row has more or fewer positions than rollers, each stands for its share of them.
        """
        share = rollers_per_row / self.load.shape[2]
        radial = math.cos(contact_angle) * self.load
        x = radial * np.cos(self.angle)
        y = radial * np.sin(self.angle)
        downwind, upwind = self.load.sum(axis=2).T
        thrust = math.sin(contact_angle) * (downwind - upwind)
        over_places = (1, 2)
        force = np.column_stack([x.sum(axis=over_places), y.sum(axis=over_places), thrust])
        return BearingLoads(self.time, self.shaft_speed, share * force, self.source)

    def approach(self, stiffness: float, play: float) -> FloatArray:
        """Approach of the rings [m] at every position, from K [N/m^1.5]; without load −play [m]."""
        pressed = (self.load / stiffness) ** (2.0 / 3.0)
        return np.where(self.load > 0.0, pressed, -play)
