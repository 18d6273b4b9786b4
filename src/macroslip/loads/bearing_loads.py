"""Load on the inner ring of the main bearing."""

from __future__ import annotations

import os
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from macroslip.loads import series
from macroslip.loads.source_file import reading, source_file

_FILE_KINDS = {".parquet": "table", ".csv": "table"}


@dataclass(frozen=True, slots=True, eq=False)
class BearingLoads:
    """Force on the inner ring of the main bearing, in the bearing frame.

    Bearing frame, right-handed and not rotating: Z0 along the shaft, downwind; Y0 up, in the plane of the shaft tilt;
    X0 = Y0 × Z0, horizontal, to the left looking downwind. In OpenFAST's shaft axes (X0, Y0, Z0) = (y, z, x).
    A spherical bearing carries no moment.

    Parameters
    ----------
    time : (n,) array [s]
        Strictly increasing, without gaps (no step above 1.5 times the median step). It need not begin at zero.
    shaft_speed : (n,) array [rad/s]
        Speed of the inner ring, positive about +Z0. Zero and negative speeds are legal. At most 100 rad/s.
    force : (n, 3) array [N]
        F_X0, F_Y0, F_Z0, the load of the shaft **on** the inner ring: a hanging weight has F_Y0 < 0, thrust on an
        upwind rotor has F_Z0 > 0. At most 1e8 N each.
    source : str
        Where the loads come from, for errors and reports.

    Raises
    ------
    InputError
        Wrong shape, fewer than 2 samples, values that are not finite, time that does not increase, a gap, or a
        magnitude that only a wrong unit explains.

    Notes
    -----
    The arrays are stored as read-only, C-contiguous float64 copies.
    """

    time: NDArray[np.float64]
    shaft_speed: NDArray[np.float64]
    force: NDArray[np.float64]
    source: str

    def __post_init__(self) -> None:
        series.validate(self, {"force": ("F_X0", "F_Y0", "F_Z0")})

    @property
    def duration(self) -> float:
        """Time from the first to the last sample [s]."""
        return float(self.time[-1] - self.time[0])

    def window(self, start: float | None, end: float | None) -> BearingLoads:
        """The samples with ``start <= time <= end`` [s]; None keeps that end. Outside the record: InputError."""
        columns = {name: getattr(self, name) for name in ("time", "shaft_speed", "force")}
        return BearingLoads(**series.cut(columns, start, end, self.source), source=self.source)

    def __repr__(self) -> str:
        return series.summary("BearingLoads", self, self._forces())

    def _repr_html_(self) -> str:
        return series.html_summary("BearingLoads", self, self._forces())

    def _forces(self) -> dict[str, NDArray[np.float64]]:
        return dict(zip(("F_X0", "F_Y0", "F_Z0"), self.force.T, strict=True))

    @classmethod
    def constant(cls, force: ArrayLike, shaft_speed: float, duration: float, *, step: float = 0.05) -> BearingLoads:
        """The same force (3,) [N] and shaft speed [rad/s] from t = 0 to `duration` [s].

        The samples are equally spaced, by at most `step` [s].

        Examples
        --------
        >>> BearingLoads.constant([0.0, -343e3, 0.0], 2.14, 10.0).force[-1]
        array([      0., -343000.,       0.])
        """
        time = series.uniform_time(duration, step)
        return cls(
            time,
            series.constant_value("shaft_speed", shaft_speed, time.size),
            series.constant_vector("force", force, time.size),
            "constant load",
        )

    @classmethod
    def read(
        cls, path: str | os.PathLike[str], *, start: float | None = None, end: float | None = None
    ) -> BearingLoads:
        """Read a table of main-bearing loads (``.parquet``, ``.csv``) with units in its column names.

        Parameters
        ----------
        path : path
            See `macroslip.loads.table` for the columns that are needed.
        start, end : float, optional
            Keep only this part of the file [s], on the file's own time axis. What lies outside is not validated.

        Raises
        ------
        InputError
            The file is absent, empty or damaged, lacks a column, or holds values that `BearingLoads` refuses.
        """
        path, _ = source_file(
            path,
            _FILE_KINDS,
            "Hub loads from OpenFAST become bearing loads by main_bearing_load(HubLoads.read(path), Drivetrain()).",
        )
        from macroslip.loads.table import read_bearing_table

        with reading(path):
            columns = read_bearing_table(path)
        return cls(**series.cut(columns, start, end, str(path)), source=str(path))
