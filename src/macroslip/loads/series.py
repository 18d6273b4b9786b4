"""What every load history must satisfy, checked once, where it enters the program."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from numbers import Real
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from macroslip.catalogue.entry import is_finite_number
from macroslip.errors import InputError
from macroslip.overview import html_overview

GAP_FACTOR = 1.5
"""A step longer than this many median steps is a gap: something between two samples was lost."""

LATEST_TIME = 1e10
"""Largest time stamp [s], about 300 years: seconds since 1970 are allowed, milliseconds are not."""

MAGNITUDE_LIMITS = {"shaft_speed": (100.0, "rad/s"), "force": (1e8, "N"), "moment": (1e9, "N m")}
"""Magnitudes beyond which the unit must be a mistake.

100 rad/s is 955 rpm: rotors on a main bearing stay below some 10 rad/s, generators behind a gearbox turn faster than
the limit. 1e8 N is the weight of 10 000 t, about ten times the heaviest rotor, and 1e9 N m about ten times the
extreme bending moment of a 20 MW rotor. Values below the limits can still carry a wrong unit; only the certain cases
are refused.
"""

#: Samples of a constant load beyond which the duration must be a mistake.
_MOST_SAMPLES = 20_000_000


def validate(record: Any, vectors: Mapping[str, Sequence[str]]) -> None:
    """Turn the arrays of a frozen load history into read-only float64 and check them.

    Parameters
    ----------
    record : dataclass instance
        Has ``time`` (n,) [s], ``shaft_speed`` (n,) [rad/s], ``source`` and the fields named in `vectors`, each (n, 3).
    vectors : mapping
        Field name to the names of its three components, as errors should call them.

    Raises
    ------
    InputError
        Wrong shape, fewer than 2 samples, a value that is not finite, time that does not increase, a gap, or a
        magnitude that only a wrong unit explains.
    """
    source = record.source
    time = _numbers("time", record.time, source)
    if time.ndim != 1 or time.size < 2:
        raise InputError(
            f"time has shape {time.shape}",
            where=source,
            allowed="one dimension with at least 2 samples",
            remedy="Give one time stamp [s] a sample.",
        )
    _check_time(time, source)
    object.__setattr__(record, "time", time)
    for field in ("shaft_speed", *vectors):
        array = _numbers(field, getattr(record, field), source)
        components = vectors.get(field)
        shape = (time.size,) if components is None else (time.size, 3)
        if array.shape != shape:
            raise InputError(
                f"{field} has shape {array.shape}",
                where=source,
                allowed=f"shape {shape}",
                remedy=f"Give one value for each of the {time.size} time stamps"
                + ("." if components is None else f" and component ({', '.join(components)})."),
            )
        for name, values in zip(components or (field,), array.reshape(time.size, -1).T, strict=True):
            _check_finite(name, values, time, source)
            _check_magnitude(name, values, *MAGNITUDE_LIMITS[field], time, source)
        object.__setattr__(record, field, array)


def cut(columns: Mapping[str, NDArray], start: float | None, end: float | None, source: str) -> dict[str, NDArray]:
    """Keep the samples with ``start <= time <= end`` [s]; None is the end of the record on that side.

    Works on arrays that are not validated yet, so that a bad stretch of a file can be cut away on reading.
    """
    columns = {name: np.asarray(values) for name, values in columns.items()}
    for name, value in (("start", start), ("end", end)):
        if value is not None and (isinstance(value, bool) or not isinstance(value, Real)):
            raise InputError(f"{name} is {value!r}", where=source, allowed="a number of seconds, or None")
    if start is None and end is None:
        return columns
    stamps = columns["time"][np.isfinite(columns["time"])]
    if stamps.size < 2:  # nothing to cut; validation reports the fault
        return columns
    first, last = float(stamps.min()), float(stamps.max())
    slack = 1e-6 * (last - first) / (stamps.size - 1)  # a stamp such as 0.30000000000000004 s must not lose its sample
    low, high = first if start is None else start, last if end is None else end
    if not (first - slack <= low < high <= last + slack):
        raise InputError(
            f"the window from {low:.10g} s to {high:.10g} s cannot be cut out",
            where=source,
            allowed=f"start before end, both within {first:.10g} s to {last:.10g} s",
            remedy="Choose a window on the record's own time axis, which need not begin at zero.",
        )
    keep = (columns["time"] >= low - slack) & (columns["time"] <= high + slack)
    if np.count_nonzero(keep) < 2:
        raise InputError(
            f"the window from {low:.10g} s to {high:.10g} s holds {np.count_nonzero(keep)} sample(s)",
            where=source,
            allowed="at least 2 samples",
            remedy="Widen the window.",
        )
    # A stamp that is not a number may lie inside: it is kept, so that validation refuses it.
    inside = np.flatnonzero(keep)
    unknown = np.flatnonzero(~np.isfinite(columns["time"]))
    keep[unknown[(unknown > inside[0]) & (unknown < inside[-1])]] = True
    return {name: values[keep] for name, values in columns.items()}


def summary(kind: str, record: Any, forces: Mapping[str, NDArray]) -> str:
    """One line on a load history, for people."""
    means = ", ".join(f"{name} {values.mean() / 1e3:.4g} kN" for name, values in forces.items())
    rpm = record.shaft_speed.mean() * 30.0 / math.pi
    return (
        f"<{kind} from {record.source}: {record.time.size} samples, {record.time[0]:g} s to {record.time[-1]:g} s; means: "
        f"{means}, shaft {rpm:.4g} rpm>"
    )


def html_summary(kind: str, record: Any, forces: Mapping[str, NDArray]) -> str:
    """The same as a table for a notebook, with the spread of every channel."""
    channels = {"shaft speed [rpm]": record.shaft_speed * 30.0 / math.pi}
    channels |= {f"{name} [kN]": values / 1e3 for name, values in forces.items()}
    rows = [
        [name, *(f"{value:.4g}" for value in (values.mean(), values.std(), values.min(), values.max()))]
        for name, values in channels.items()
    ]
    span = f"{record.time.size} samples, {record.time[0]:g} s to {record.time[-1]:g} s"
    return html_overview(f"{kind} from {record.source}: {span}", ["", "mean", "std", "min", "max"], rows)


def uniform_time(duration: float, step: float) -> NDArray[np.float64]:
    """Time stamps from 0 to exactly `duration` [s], equally spaced by at most `step` [s]."""
    for name, value in (("duration", duration), ("step", step)):
        if not (is_finite_number(value) and value > 0):
            raise InputError(f"the {name} of a constant load is {value} s", allowed="a finite number above 0 s")
    if duration / step > _MOST_SAMPLES:
        raise InputError(
            f"the duration of a constant load is {duration:g} s, {duration / step:.3g} samples",
            allowed=f"up to {_MOST_SAMPLES * step:g} s at a step of {step:g} s",
            remedy="A load that does not change needs no longer time: its energy per orbit stays the same.",
        )
    return np.linspace(0.0, duration, max(2, math.ceil(duration / step * (1 - 1e-12)) + 1))


def constant_value(name: str, value: float, n: int) -> NDArray[np.float64]:
    """One number repeated for `n` samples, shape (n,)."""
    if not is_finite_number(value):
        raise InputError(f"the {name} is {value!r}", where="constant load", allowed="a finite number")
    return np.full(n, float(value))


def constant_vector(name: str, value: ArrayLike, n: int) -> NDArray[np.float64]:
    """Three components repeated for `n` samples, shape (n, 3)."""
    vector = _numbers(name, value, "constant load")
    if vector.shape != (3,):
        raise InputError(f"the {name} has shape {vector.shape}", where="constant load", allowed="three components")
    return np.tile(vector, (n, 1))


def _numbers(name: str, values: ArrayLike, source: str) -> NDArray[np.float64]:
    try:
        given = np.asarray(values)
        if given.dtype.kind not in "iuf":  # text that looks like a number is not one
            raise TypeError(f"it holds {given.dtype}")
        array = np.array(given, dtype=np.float64, order="C")
    except (TypeError, ValueError) as error:
        raise InputError(
            f"{name} does not convert to an array of numbers ({error})", where=source, allowed="real numbers"
        ) from error
    array.setflags(write=False)
    return array


def _check_time(time: NDArray, source: str) -> None:
    bad = np.flatnonzero(~np.isfinite(time))
    if bad.size:
        raise InputError(
            f"time is {time[bad[0]]} at sample {bad[0]} (counted from 0)",
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
            remedy="Remove repeated samples; a restart leaves them, or a time written with too few digits.",
        )
    typical = float(np.median(steps))
    latest = float(np.abs(time).max())
    if latest > LATEST_TIME or np.spacing(latest) > 1e-6 * typical:
        raise InputError(
            f"time reaches {latest:.6g} s, with steps of {typical:.6g} s",
            where=source,
            allowed=f"magnitudes up to {LATEST_TIME:g} s, and steps that numbers of this size resolve",
            remedy="Time is in seconds. Convert stamps of an epoch, such as microseconds, and count from the start.",
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


def _check_finite(name: str, values: NDArray, time: NDArray, source: str) -> None:
    bad = np.flatnonzero(~np.isfinite(values))
    if bad.size:
        raise InputError(
            f"{name} is {values[bad[0]]} ({bad.size} of {values.size} samples are not finite)",
            where=f"{source}, t = {time[bad[0]]:.10g} s",
            allowed="finite numbers",
            remedy="Repair the channel, or read only the part without such samples (start=, end=).",
        )


def _check_magnitude(name: str, values: NDArray, limit: float, unit: str, time: NDArray, source: str) -> None:
    worst = int(np.abs(values).argmax())
    if abs(values[worst]) > limit:
        hint = (
            "Is it in rpm, or the speed of the generator?"
            if unit == "rad/s"
            else "Is a value already in newtons declared as kN?"
        )
        raise InputError(
            f"{name} is {values[worst]:.6g} {unit}, beyond any wind turbine",
            where=f"{source}, t = {time[worst]:.10g} s",
            allowed=f"magnitudes up to {limit:g} {unit}",
            remedy=f"Check the unit. {hint}",
        )
