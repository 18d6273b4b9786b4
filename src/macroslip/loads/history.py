"""Histories of loads at the hub and on the main bearing, checked where they enter the program."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace
from numbers import Real
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from macroslip.arrays import FloatArray
from macroslip.constants import RPM
from macroslip.errors import InputError
from macroslip.input.units import is_finite_number
from macroslip.loads.bladed import read_bladed
from macroslip.loads.bundled import bundled_case
from macroslip.loads.csv_text import csv_number_format
from macroslip.loads.hawc2 import read_hawc2
from macroslip.loads.openfast import read_openfast
from macroslip.loads.sheet_table import check_sheet
from macroslip.loads.source_file import DAMAGED, moment_at_hub, source_file
from macroslip.loads.table import read_bearing_table, read_hub_table
from macroslip.overview import html_overview
from macroslip.storage.files import reading

GAP_FACTOR = 1.5
"""A step longer than this many median steps is a gap: something between two samples was lost."""

LATEST_TIME = 1e10
"""Largest time stamp [s], about 300 years: seconds since 1970 are allowed, milliseconds are not."""

MAGNITUDE_LIMITS = {"force": (1e8, "N"), "moment": (1e9, "N m")}
"""Magnitudes beyond which the unit must be a mistake.

Rotors on a main bearing stay below 10 rad/s, generators behind a gearbox turn faster than 100. 1e8
N is about ten times the weight of the heaviest rotor, 1e9 N m about ten times the extreme bending
moment of a 20 MW rotor.
"""

#: Largest distance from the hub to the point on the shaft at which a file has its loads [m].
_FARTHEST_OUTPUT = 20.0
#: Samples of a constant load beyond which the duration must be a mistake.
_MOST_SAMPLES = 20_000_000

_TABLES = {".parquet": "table", ".csv": "table", ".xlsx": "workbook of Excel"}
_HUB_FILES = {
    ".outb": "OpenFAST binary output",
    ".out": "OpenFAST text output",
    ".%nn": "Bladed output, any file of the run",
    ".$nn": "the same",
    ".sel": "HAWC2 output",
    ".dat": "HAWC2 output, with its .sel beside it",
    ".hdf5": "HAWC2 output in the format gtsdf",
    ".h5": "the same",
} | _TABLES
#: Readers by extension; all others are Bladed's.
_READERS: dict[str, Callable[..., dict[str, Any]]]
_READERS = dict.fromkeys((".out", ".outb"), read_openfast)
_READERS |= dict.fromkeys((".sel", ".dat", ".hdf5", ".h5"), read_hawc2)
_READERS |= dict.fromkeys(_TABLES, read_hub_table)
#: Readers of files that may also hold loads at another point of the shaft than the hub.
_READERS_OF_OTHER_POINTS = (read_openfast, read_hawc2, read_hub_table)


_Components = Mapping[str, tuple[str, str, str]]


class History:
    """Checks, windows and printed form that both kinds of loads share."""

    __slots__ = ()

    #: Fields of shape (n, 3), and the names of their components.
    _VECTORS: ClassVar[_Components]
    #: Highest shaft speed [rad/s].
    _FASTEST: ClassVar[float] = 100.0
    time: FloatArray
    shaft_speed: FloatArray
    force: FloatArray
    source: str

    def __post_init__(self) -> None:
        """Check the arrays and replace them by read-only copies."""
        source = self.source
        time = _numbers("time", self.time, source)
        if time.ndim != 1 or time.size < 2:
            raise InputError(
                f"time has shape {time.shape}",
                where=source,
                allowed="one dimension with at least 2 samples",
                remedy="Give one time stamp [s] a sample.",
            )
        _check_time(time, source)
        object.__setattr__(self, "time", time)
        for field in ("shaft_speed", *self._VECTORS):
            array = _numbers(field, getattr(self, field), source)
            components = self._VECTORS.get(field)
            shape = (time.size,) if components is None else (time.size, 3)
            if array.shape != shape:
                raise InputError(
                    f"{field} has shape {array.shape}",
                    where=source,
                    allowed=f"shape {shape}",
                    remedy=f"Give one value for each of the {time.size} time stamps"
                    + ("." if components is None else f" and component ({', '.join(components)})."),
                )
            for name, values in zip(
                components or (field,), array.reshape(time.size, -1).T, strict=True
            ):
                limits = {"shaft_speed": (self._FASTEST, "rad/s"), **MAGNITUDE_LIMITS}
                _check_values(name, values, *limits[field], time, source)
            object.__setattr__(self, field, array)

    @property
    def start(self) -> float:
        """Time of the first sample [s]."""
        return float(self.time[0])

    @property
    def end(self) -> float:
        """Time of the last sample [s]."""
        return float(self.time[-1])

    @property
    def duration(self) -> float:
        """Time from the first to the last sample [s]."""
        return self.end - self.start

    def window(self, start: float | None, end: float | None) -> Self:
        """The samples with ``start <= time <= end`` [s]; None keeps that end of the record.

        InputError if the window is not within the record, as `cut` has it.
        """
        record: Any = self
        columns = {}
        for field in fields(record):
            values = getattr(self, field.name)
            if isinstance(values, np.ndarray):
                columns[field.name] = values
        cut_columns = cut(columns, start, end, self.source)
        return replace(record, **cut_columns)

    def __repr__(self) -> str:
        means = ", ".join(
            f"{name} {values.mean() / 1e3:.4g} kN" for name, values in self._forces().items()
        )
        rpm = self.shaft_speed.mean() / RPM
        kind = type(self).__name__
        return f"<{kind} from {self.source}: {self._span()}; means: {means}, shaft {rpm:.4g} rpm>"

    def _repr_html_(self) -> str:
        channels = {"shaft speed [rpm]": self.shaft_speed / RPM}
        channels |= {f"{name} [kN]": values / 1e3 for name, values in self._forces().items()}
        rows = []
        for name, values in channels.items():
            statistics = (values.mean(), values.std(), values.min(), values.max())
            cells = [f"{value:.4g}" for value in statistics]
            rows.append([name, *cells])
        title = f"{type(self).__name__} from {self.source}: {self._span()}"
        return html_overview(title, ["", "mean", "std", "min", "max"], rows)

    def _span(self) -> str:
        """Number of samples and their time."""
        return f"{self.time.size} samples, {self.start:g} s to {self.end:g} s"

    def _forces(self) -> dict[str, FloatArray]:
        """Forces (n,) [N] by their names."""
        names = self._VECTORS["force"]
        return dict(zip(names, self.force.T, strict=True))


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class HubLoads(History):
    """Force and moment of the rotor **on** the shaft at the hub centre, in non-rotating shaft axes.

    Axes, right-handed and turning with neither the rotor nor the shaft: x along the shaft, from the
    hub towards the gearbox (downwind); z up, perpendicular to the shaft; y = z × x, horizontal, to
    the left looking downwind. They are OpenFAST's ``s`` axes. The rotor is upwind of the tower. Its
    weight is part of these loads, the shaft's is not. The arrays are stored as read-only,
    C-contiguous float64 copies. Raises InputError for a wrong shape, fewer than 2 samples, values
    that are not finite, time that does not increase, a gap, or a magnitude that only a wrong unit
    explains.

    Parameters
    ----------
    time : (n,) array [s]
        Strictly increasing, without gaps (no step above 1.5 times the median step). It need not
        begin at zero.
    shaft_speed : (n,) array [rad/s]
        Positive about +x, clockwise looking downwind. Zero and negative speeds are legal. At most
        100 rad/s.
    force : (n, 3) array [N]
        fx, fy, fz; at most 1e8 N each.
    moment : (n, 3) array [N m]
        mx (> 0 drives the rotation), my (> 0: more thrust on the upper half of the rotor), mz; at
        most 1e9 N m each.
    source : str
        Where the loads come from, for errors and reports.
    reading : tuple of str
        Which channels of a file they were read from, and how; empty for loads that were not read.
    event : bool
        Whether they are of a start, a stop, idling or the like: the window then opens at the first
        sample.
    """

    _VECTORS: ClassVar[_Components] = {
        "force": ("fx", "fy", "fz"),
        "moment": ("mx", "my", "mz"),
    }
    time: FloatArray
    shaft_speed: FloatArray
    force: FloatArray
    moment: FloatArray
    source: str
    reading: tuple[str, ...] = ()
    event: bool = False

    @classmethod
    def constant(
        cls,
        force: ArrayLike,
        moment: ArrayLike,
        shaft_speed: float,
        duration: float,
        *,
        step: float = 0.05,
    ) -> HubLoads:
        """Loads that do not change, from t = 0 on.

        Parameters
        ----------
        force, moment : (3,) array [N], [N m]
            At the hub.
        shaft_speed : float [rad/s]
            Positive about +x.
        duration, step : float [s]
            Time that they last, in equal steps of at most `step`.

        Returns
        -------
        HubLoads

        Examples
        --------
        >>> HubLoads.constant([164e3, 0, -263e3], [726e3, 0, 0], 2.14, 600.0).time.size
        12001
        """
        fields_of_loads = _constant(duration, step, shaft_speed, force=force, moment=moment)
        return cls(**fields_of_loads)

    @classmethod
    def read(
        cls,
        path: str | os.PathLike[str],
        *,
        start: float | None = None,
        end: float | None = None,
        shaft_speed: float | None = None,
        decimal: str = "",
        thousands: str = "",
        hub_to_output: float | None = None,
        sheet: str = "",
    ) -> HubLoads:
        """Read output of OpenFAST, Bladed or HAWC2, or a table with units in its column names.

        Parameters
        ----------
        path : path
            ``.outb`` and ``.out``: see `macroslip.loads.openfast` for the channels; ``.%nn`` or
            ``.$nn``, any file of a run: `macroslip.loads.bladed`; ``.sel``, ``.dat``, ``.hdf5`` or
            ``.h5``: `macroslip.loads.hawc2`; ``.parquet``, ``.csv`` and ``.xlsx``:
            `macroslip.loads.table` for the columns.
        start, end : float, optional
            Keep only this part of the file [s], on the file's own time axis, as `cut` does. What
            lies outside is not validated.
        shaft_speed : float, optional
            Constant shaft speed [rad/s] in place of the file's; needed where the file has none.
        decimal, thousands : str, optional
            Marks in the numbers of a CSV table, found out by default: before the decimals "." or
            ",", between groups of three digits ".", ",", "'" or a space.
        hub_to_output : float, optional
            Distance, 0 to 20 m, of the point that the file's loads are given at behind the hub
            centre, where it is not the hub: a node of HAWC2's shaft, or OpenFAST's strain gauge.
            The moments are moved to the hub; the shaft between has no weight.
        sheet : str, optional
            Sheet of a workbook of Excel; the first one if not given.

        Returns
        -------
        HubLoads

        Raises
        ------
        InputError
            If the file is absent, empty, damaged or cut off, lacks a channel, or holds values that
            `HubLoads` refuses.
        """
        path, extension = source_file(path, _HUB_FILES)
        if hub_to_output is not None and not (
            is_finite_number(hub_to_output) and 0.0 <= hub_to_output <= _FARTHEST_OUTPUT
        ):
            raise InputError(
                f"hub_to_output is {hub_to_output} m",
                where=str(path),
                allowed=f"0 to {_FARTHEST_OUTPUT:g} m",
                remedy="It counts downwind, from the hub of a rotor that is upwind of the tower.",
            )
        reader = _READERS.get(extension, read_bladed)
        options: dict[str, Any] = {"speed_needed": shaft_speed is None}
        number_format = csv_number_format(path, decimal, thousands)
        check_sheet(path, sheet)
        if number_format is not None:
            options["number_format"] = number_format
        if sheet:
            options["sheet"] = sheet
        if hub_to_output is not None and reader in _READERS_OF_OTHER_POINTS:
            options["at_hub"] = False
        # Numbers that are not finite are reported with their channel and time, without NumPy's
        # warnings before.
        with reading(path, DAMAGED), np.errstate(all="ignore"):
            columns = reader(path, **options)
            if hub_to_output is not None:
                columns["moment"] = moment_at_hub(
                    columns["force"], columns["moment"], hub_to_output
                )
        taken = columns.pop("reading")
        if hub_to_output is not None:
            taken = (*taken, f"moments moved to the hub from {hub_to_output:g} m behind it")
        if shaft_speed is not None:
            columns["shaft_speed"] = np.full(columns["time"].shape, shaft_speed)
            taken = (*taken, f"shaft speed: given, {shaft_speed:g} rad/s")
        window = cut(columns, start, end, str(path))
        return cls(**window, source=str(path), reading=taken)

    @classmethod
    def bundled(cls, case: str) -> HubLoads:
        """One of the load cases that come with the package; `bundled_cases` lists them.

        They have 20 Hz and most of them 600 s, and were simulated with OpenFAST for the WindPACT
        1.5 MW turbine or, where the name begins with ``nrel5``, the NREL 5 MW turbine;
        ``cases/README.md`` beside this module describes how.

        Examples
        --------
        >>> loads = HubLoads.bundled("14B")
        >>> print(f"{loads.shaft_speed.mean():.4f} rad/s, {loads.force[:, 0].mean() / 1e3:.1f} kN")
        2.1431 rad/s, 164.4 kN
        """
        known = bundled_case(case)
        columns = read_hub_table(known.path)
        del columns["reading"]
        return cls(**columns, source=known.source, event=bool(known.event))


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class BearingLoads(History):
    """Force on the inner ring of the main bearing, in the bearing frame.

    Bearing frame, right-handed and not rotating: Z0 along the shaft, downwind; Y0 up, in the plane
    of the shaft tilt; X0 = Y0 × Z0, horizontal, to the left looking downwind. In OpenFAST's shaft
    axes (X0, Y0, Z0) = (y, z, x). A spherical bearing carries no moment. The arrays are stored as
    read-only, C-contiguous float64 copies. Raises InputError as `HubLoads`.

    Parameters
    ----------
    time, shaft_speed : (n,) array [s], [rad/s]
        As in `HubLoads`; speed of the inner ring, positive about +Z0.
    force : (n, 3) array [N]
        F_X0, F_Y0, F_Z0, the load of the shaft **on** the inner ring: a hanging weight has
        F_Y0 < 0, thrust on an upwind rotor has F_Z0 > 0. At most 1e8 N each.
    source : str
        Where the loads come from, for errors and reports.
    event : bool
        As in `HubLoads`.
    """

    _VECTORS: ClassVar[_Components] = {"force": ("F_X0", "F_Y0", "F_Z0")}
    #: Shafts of gearboxes and generators turn faster than rotors.
    _FASTEST: ClassVar[float] = 400.0
    time: FloatArray
    shaft_speed: FloatArray
    force: FloatArray
    source: str
    event: bool = False

    @property
    def radial_load(self) -> FloatArray:
        """√(F_X0² + F_Y0²), shape (n,) [N]."""
        across = self.force[:, 0]
        vertical = self.force[:, 1]
        return np.hypot(across, vertical)

    @property
    def axial_load(self) -> FloatArray:
        """F_Z0, shape (n,) [N]."""
        return self.force[:, 2]

    def resampled(self, time: FloatArray, shaft_speed: FloatArray) -> BearingLoads:
        """The same loads at other times [s], interpolated linearly, with the speed there [rad/s]."""
        components = [np.interp(time, self.time, component) for component in self.force.T]
        force = np.column_stack(components)
        return BearingLoads(time, shaft_speed, force, self.source)

    @classmethod
    def constant(
        cls, force: ArrayLike, shaft_speed: float, duration: float, *, step: float = 0.05
    ) -> BearingLoads:
        """A load that does not change, from t = 0 on.

        Parameters
        ----------
        force : (3,) array [N]
            Load of the shaft on the inner ring.
        shaft_speed : float [rad/s]
            Positive about +Z0.
        duration, step : float [s]
            Time that it lasts, in equal steps of at most `step`.

        Returns
        -------
        BearingLoads

        Examples
        --------
        >>> BearingLoads.constant([0.0, -343e3, 0.0], 2.14, 10.0).force[-1]
        array([      0., -343000.,       0.])
        """
        fields_of_loads = _constant(duration, step, shaft_speed, force=force)
        return cls(**fields_of_loads)

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
    ) -> BearingLoads:
        """Read a table of main-bearing loads with units in its column names.

        `macroslip.loads.table` says which columns are needed.

        Parameters
        ----------
        path : path
            ``.parquet``, ``.csv`` or ``.xlsx``.
        start, end : float, optional
            Keep only this part of the file [s], on the file's own time axis, as `cut` does.
        decimal, thousands, sheet : str, optional
            Marks of numbers in text and sheet of a workbook, as in `HubLoads.read`.

        Returns
        -------
        BearingLoads

        Raises
        ------
        InputError
            As `HubLoads.read`.
        """
        remedy = (
            "Hub loads from OpenFAST become bearing loads by "
            "main_bearing_load(HubLoads.read(path), Drivetrain())."
        )
        path, _ = source_file(path, _TABLES, remedy)
        number_format = csv_number_format(path, decimal, thousands)
        with reading(path, DAMAGED), np.errstate(all="ignore"):
            columns = read_bearing_table(path, number_format, sheet)
        window = cut(columns, start, end, str(path))
        return cls(**window, source=str(path))


def cut(
    columns: Mapping[str, NDArray], start: float | None, end: float | None, source: str
) -> dict[str, Any]:
    """Keep the samples with ``start <= time <= end``.

    Works on arrays that are not validated yet, so that a bad stretch of a file can be cut away on
    reading.

    Parameters
    ----------
    columns : mapping
        Arrays whose first axis is time, among them `time` (n,) [s].
    start, end : float or None
        Window [s]; None is the end of the record on that side. Either may be up to one step outside
        of the record: 600 s of samples end at 599.95 s.
    source : str
        Where they come from, for errors.

    Returns
    -------
    dict
        The same arrays, cut to the window.

    Raises
    ------
    InputError
        If the window is not within the record or holds fewer than two samples.
    """
    columns = {name: np.asarray(values) for name, values in columns.items()}
    for name, value in (("start", start), ("end", end)):
        is_number = isinstance(value, Real) and not isinstance(value, bool)
        if value is not None and not is_number:
            raise InputError(
                f"{name} is {value!r}", where=source, allowed="a number of seconds, or None"
            )
    if start is None and end is None:
        return columns
    stamps = columns["time"]
    stamps = stamps[np.isfinite(stamps)]
    if stamps.size < 2:  # nothing to cut; validation reports the fault
        return columns
    first = float(stamps.min())
    last = float(stamps.max())
    step = (last - first) / (stamps.size - 1)
    slack = 1e-6 * step  # a stamp such as 0.30000000000000004 s must not lose its sample
    low = first if start is None else start
    high = last if end is None else end
    window = f"the window from {low:.10g} s to {high:.10g} s"
    earliest = first - step - slack
    latest = last + step + slack
    if not (earliest <= low < high <= latest):
        raise InputError(
            f"{window} cannot be cut out",
            where=source,
            allowed=f"start before end, both within {first:.10g} s to {last:.10g} s",
            remedy="Choose a window on the record's own time axis, which need not begin at zero.",
        )
    time = columns["time"]
    is_inside = (time >= low - slack) & (time <= high + slack)
    inside = np.flatnonzero(is_inside)
    if inside.size < 2:
        fault = f"{window} holds {inside.size} sample(s)"
        raise InputError(
            fault, where=source, allowed="at least 2 samples", remedy="Widen the window."
        )
    # A stamp that is not a number may lie inside: it is kept, so that validation refuses it.
    is_unknown = ~np.isfinite(time)
    unknown = np.flatnonzero(is_unknown)
    is_between = (unknown > inside[0]) & (unknown < inside[-1])
    unknown = unknown[is_between]
    keep = np.sort(np.concatenate([inside, unknown]))
    return {name: values[keep] for name, values in columns.items()}


def _constant(
    duration: float, step: float, shaft_speed: float, **vectors: ArrayLike
) -> dict[str, Any]:
    """Fields of a load that does not change, at times equally spaced by at most `step` [s]."""
    for name, value in (("duration", duration), ("step", step)):
        if not (is_finite_number(value) and value > 0):
            raise InputError(
                f"the {name} of a constant load is {value} s", allowed="a finite number above 0 s"
            )
    if duration / step > _MOST_SAMPLES:
        raise InputError(
            f"the duration of a constant load is {duration:g} s, {duration / step:.3g} samples",
            allowed=f"up to {_MOST_SAMPLES * step:g} s at a step of {step:g} s",
            remedy="A load that does not change needs no longer time: its energy per orbit stays "
            "the same.",
        )
    source = "constant load"
    if not is_finite_number(shaft_speed):
        raise InputError(
            f"the shaft_speed is {shaft_speed!r}", where=source, allowed="a finite number"
        )
    intervals = duration / step * (1 - 1e-12)
    steps = math.ceil(intervals)
    count = max(2, steps + 1)
    fields = {
        "time": np.linspace(0.0, duration, count),
        "shaft_speed": np.full(count, float(shaft_speed)),
    }
    for name, value in vectors.items():
        vector = _numbers(name, value, source)
        if vector.shape != (3,):
            raise InputError(
                f"the {name} has shape {vector.shape}", where=source, allowed="three components"
            )
        fields[name] = np.tile(vector, (count, 1))
    return fields | {"source": source}


def _numbers(name: str, values: ArrayLike, source: str) -> FloatArray:
    """A read-only copy; text that looks like a number is not one."""
    try:
        original = np.asarray(values)
        if original.dtype.kind not in "iuf":
            raise TypeError(f"it holds {original.dtype}")
        array = np.array(original, dtype=np.float64, order="C")
    except (TypeError, ValueError) as error:
        fault = f"{name} does not convert to an array of numbers ({error})"
        raise InputError(fault, where=source, allowed="real numbers") from error
    array.setflags(write=False)
    return array


def _check_time(time: NDArray, source: str) -> None:
    """InputError if times (n,) [s] do not increase, have a gap, or are no seconds."""
    bad = np.flatnonzero(~np.isfinite(time))
    if bad.size:
        first = bad[0]
        fault = f"time is {time[first]} at sample {first} (counted from 0)"
        raise InputError(
            fault,
            where=source,
            allowed="finite numbers [s]",
            remedy="Remove or repair that sample.",
        )
    steps = np.diff(time)
    bad = np.flatnonzero(steps <= 0)
    if bad.size:
        i = bad[0]
        raise InputError(
            f"time does not increase: sample {i} (counted from 0) is at {time[i]:.10g} s, "
            f"sample {i + 1} at {time[i + 1]:.10g} s",
            where=source,
            allowed="strictly increasing time",
            remedy="Remove repeated samples; a restart leaves them, or a time written with too few "
            "digits.",
        )
    typical = float(np.median(steps))
    latest = float(np.abs(time).max())
    is_too_late = latest > LATEST_TIME
    if is_too_late or np.spacing(latest) > 1e-6 * typical:
        raise InputError(
            f"time reaches {latest:.6g} s, with steps of {typical:.6g} s",
            where=source,
            allowed=f"magnitudes up to {LATEST_TIME:g} s, and steps that numbers of this size "
            "resolve",
            remedy="Time is in seconds. Convert stamps of an epoch, such as microseconds, and "
            "count from the start.",
        )
    bad = np.flatnonzero(steps > GAP_FACTOR * typical)
    if bad.size:
        i = bad[0]
        raise InputError(
            f"gap of {steps[i]:.6g} s after t = {time[i]:.10g} s (median step {typical:.6g} s)",
            where=source,
            allowed=f"steps up to {GAP_FACTOR:g} times the median step",
            remedy="Read the part before or after the gap (start=, end=), or resample the record.",
        )


def _check_values(
    name: str, values: NDArray, limit: float, unit: str, time: NDArray, source: str
) -> None:
    """InputError if values (n,) of a channel are not finite or beyond a limit [unit]."""
    bad = np.flatnonzero(~np.isfinite(values))
    if bad.size:
        raise InputError(
            f"{name} is {values[bad[0]]} ({bad.size} of {values.size} samples are not finite)",
            where=f"{source}, t = {time[bad[0]]:.10g} s",
            allowed="finite numbers",
            remedy="Repair the channel, or read only the part without such samples (start=, end=).",
        )
    worst = int(np.abs(values).argmax())
    if abs(values[worst]) > limit:
        question = (
            "Is it in rpm, or the speed of the generator?"
            if unit == "rad/s"
            else "Is a value already in newtons declared as kN?"
        )
        raise InputError(
            f"{name} is {values[worst]:.6g} {unit}, beyond any wind turbine",
            where=f"{source}, t = {time[worst]:.10g} s",
            allowed=f"magnitudes up to {limit:g} {unit}",
            remedy=f"Check the unit. {question}",
        )
