"""Loads of the rotor on the shaft at the hub centre."""

from __future__ import annotations

import importlib.resources
import os
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from macroslip.errors import InputError
from macroslip.files import reading
from macroslip.loads import series
from macroslip.loads.source_file import DAMAGED, source_file

_FILE_KINDS = {
    ".outb": "OpenFAST binary output",
    ".out": "OpenFAST text output",
    ".%nn": "Bladed output, any file of the run",
    ".$nn": "the same",
    ".sel": "HAWC2 output",
    ".hdf5": "HAWC2 output in the format gtsdf",
    ".parquet": "table",
    ".csv": "table",
}


def bundled_cases() -> list[str]:
    """Names of the load cases that come with the package: mean wind speed [m/s] and IEC turbulence class.

    Examples
    --------
    >>> bundled_cases()[:4], len(bundled_cases())
    (['12A', '12B', '12C', '14A'], 21)
    """
    return [f"{speed}{turbulence}" for speed in range(12, 25, 2) for turbulence in "ABC"]


@dataclass(frozen=True, slots=True, eq=False)
class HubLoads:
    """Force and moment of the rotor **on** the shaft at the hub centre, in the non-rotating shaft axes.

    Axes, right-handed and turning with neither the rotor nor the shaft: x along the shaft, from the hub towards the
    gearbox (downwind); z up, perpendicular to the shaft; y = z × x, horizontal, to the left looking downwind. They
    are OpenFAST's ``s`` axes. The weight of the rotor is part of these loads; that of the shaft is not.

    Parameters
    ----------
    time : (n,) array [s]
        Strictly increasing, without gaps (no step above 1.5 times the median step). It need not begin at zero.
    shaft_speed : (n,) array [rad/s]
        Positive about +x, clockwise looking downwind. Zero and negative speeds are legal. At most 100 rad/s.
    force : (n, 3) array [N]
        fx, fy, fz; at most 1e8 N each.
    moment : (n, 3) array [N m]
        mx (> 0 drives the rotation), my (> 0: more thrust on the upper half of the rotor), mz; at most 1e9 N m each.
    source : str
        Where the loads come from, for errors and reports.
    reading : tuple of str
        Which channels of a file they were read from, and how; empty for loads that were not read.

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
    moment: NDArray[np.float64]
    source: str
    reading: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        series.validate(self, {"force": ("fx", "fy", "fz"), "moment": ("mx", "my", "mz")})

    @property
    def duration(self) -> float:
        """Time from the first to the last sample [s]."""
        return float(self.time[-1] - self.time[0])

    def window(self, start: float | None, end: float | None) -> HubLoads:
        """The samples with ``start <= time <= end`` [s]; None keeps that end. Outside the record: InputError."""
        columns = {name: getattr(self, name) for name in ("time", "shaft_speed", "force", "moment")}
        return HubLoads(**series.cut(columns, start, end, self.source), source=self.source, reading=self.reading)

    def __repr__(self) -> str:
        return series.summary("HubLoads", self, self._forces())

    def _repr_html_(self) -> str:
        return series.html_summary("HubLoads", self, self._forces())

    def _forces(self) -> dict[str, NDArray[np.float64]]:
        return dict(zip(("fx", "fy", "fz"), self.force.T, strict=True))

    @classmethod
    def constant(
        cls, force: ArrayLike, moment: ArrayLike, shaft_speed: float, duration: float, *, step: float = 0.05
    ) -> HubLoads:
        """The same force (3,) [N], moment (3,) [N m] and shaft speed [rad/s] from t = 0 to `duration` [s].

        The samples are equally spaced, by at most `step` [s].

        Examples
        --------
        >>> HubLoads.constant([164e3, 0, -263e3], [726e3, 0, 0], 2.14, 600.0).time.size
        12001
        """
        time = series.uniform_time(duration, step)
        return cls(
            time,
            series.constant_value("shaft_speed", shaft_speed, time.size),
            series.constant_vector("force", force, time.size),
            series.constant_vector("moment", moment, time.size),
            "constant load",
        )

    @classmethod
    def read(
        cls,
        path: str | os.PathLike[str],
        *,
        start: float | None = None,
        end: float | None = None,
        shaft_speed: float | None = None,
    ) -> HubLoads:
        """Read output of OpenFAST, Bladed or HAWC2, or a table with units in its column names (Parquet, CSV).

        Parameters
        ----------
        path : path
            ``.outb`` and ``.out``: see `macroslip.loads.openfast` for the channels; ``.%nn`` or ``.$nn``, any file of a
            run: `macroslip.loads.bladed`; ``.sel`` or ``.hdf5``: `macroslip.loads.hawc2`; ``.parquet`` and ``.csv``:
            `macroslip.loads.table` for the columns.
        start, end : float, optional
            Keep only this part of the file [s], on the file's own time axis. What lies outside is not validated.
        shaft_speed : float, optional
            Constant shaft speed [rad/s] in place of the file's; needed where the file has none.

        Raises
        ------
        InputError
            The file is absent, empty, damaged or cut off, lacks a channel, or holds values that `HubLoads` refuses.
        """
        path, extension = source_file(path, _FILE_KINDS)
        with reading(path, DAMAGED):
            columns = _reader(extension)(path, speed_needed=shaft_speed is None)
        taken = columns.pop("reading")
        if shaft_speed is not None:
            columns["shaft_speed"] = np.full(columns["time"].shape, shaft_speed)
            taken = (*taken, f"shaft speed: given, {shaft_speed:g} rad/s")
        return cls(**series.cut(columns, start, end, str(path)), source=str(path), reading=taken)

    @classmethod
    def bundled(cls, case: str) -> HubLoads:
        """One of the load cases that come with the package, 600 s at 20 Hz; `bundled_cases` lists them.

        Simulated with OpenFAST for the WindPACT 1.5 MW turbine; ``cases/README.md`` beside this module describes how.

        Examples
        --------
        >>> loads = HubLoads.bundled("14B")
        >>> print(f"{loads.shaft_speed.mean():.4f} rad/s, {loads.force[:, 0].mean() / 1e3:.1f} kN")
        2.1431 rad/s, 164.4 kN
        """
        if case not in bundled_cases():
            raise InputError(
                f"there is no bundled case {case!r}",
                allowed=", ".join(bundled_cases()),
                remedy="Use HubLoads.read for a file of your own.",
            )
        from macroslip.loads.table import read_hub_table

        folder = importlib.resources.files("macroslip.loads") / "cases"
        with importlib.resources.as_file(folder / f"{case}.parquet") as path:
            columns = read_hub_table(path)
        del columns["reading"]
        return cls(**columns, source=f"bundled case {case}")


def _reader(extension: str) -> Callable[..., dict]:
    """What reads files with an extension."""
    if extension in (".out", ".outb"):
        from macroslip.loads.openfast import read_openfast

        return read_openfast
    if extension.startswith((".%", ".$")):
        from macroslip.loads.bladed import read_bladed

        return read_bladed
    if extension in (".sel", ".hdf5"):
        from macroslip.loads.hawc2 import read_hawc2

        return read_hawc2
    from macroslip.loads.table import read_hub_table

    return read_hub_table
