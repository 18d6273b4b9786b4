"""Hub loads from the output of a Bladed run, binary or text.

Bladed writes its results in groups, each as a header ``run.%nn`` and data ``run.$nn``. Any file of
the run may be named; the groups beside it are searched for

==============  =============================================================================
force, moment   ``Stationary hub Fx`` … ``Fz``, ``Mx`` … ``Mz`` (hub loads, fixed frame)
shaft speed     ``Rotor speed`` (drive train variables, summary), unless it is given
==============  =============================================================================

The speed may be in several groups; one with the time steps of the hub loads is taken. The fixed
hub frame has x along the shaft, downwind, z up and y = z × x, as `HubLoads` has. The weight of the
rotor is in these loads. Values are in SI units as the header's unit codes state (F, FL, A/T).
"""

from __future__ import annotations

import math
import re
import shlex
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from macroslip.arrays import FloatArray
from macroslip.errors import InputError
from macroslip.loads.source_file import (
    MOST_VALUES,
    Samples,
    announced_binary,
    announced_text,
    fortran_number,
    numbers,
    text_lines,
)

#: Keys of a header, which some versions part from their value by blanks, others by a tab. Before a
#: tab other words in capitals are keys as well.
_KEYS = (
    "FILE", "ACCESS", "FORM", "RECL", "FORMAT", "CONTENT", "CONFIG", "NDIMENS", "DIMENS", "GENLAB",
    "VARIAB", "VARUNIT", "AXISLAB", "AXIUNIT", "AXIMETH", "AXIVAL", "AXITICK", "MIN", "STEP",
    "NVARS", "ULOADS", "MAXTIME", "MINTIME", "MEAN",
)  # fmt: skip
_NUMBERS = {"R*4": np.dtype("<f4"), "R*8": np.dtype("<f8")}
_LOADS = tuple(f"Stationary hub {kind}{axis}" for kind in "FM" for axis in "xyz")
_SPEED = "Rotor speed"
_UNITS = {_SPEED: "A/T"} | {name: "F" if " F" in name else "FL" for name in _LOADS}
#: Largest difference between the mean of the data and the mean in the header, as part of the
#: largest magnitude.
_SAME_MEAN = 1e-3
_AGAIN = "Copy the file again, or run Bladed again."
_SAY_THE_SPEED = "give the speed: loads.shaft_speed, or --shaft-speed of loads inspect."


class _Group(NamedTuple):
    """A group of results, as its header describes it."""

    header: Path
    names: tuple[str, ...]
    units: tuple[str, ...]
    samples: int
    first: float  #: Time of the first sample [s].
    step: float  #: Time between samples [s].
    number: np.dtype | None  #: Type of binary data; None if they can only be text.
    may_be_text: bool
    mean: FloatArray  #: Means that the header states, or empty.

    @property
    def time(self) -> FloatArray:
        """Times (n,) of the samples [s]."""
        return self.first + self.step * np.arange(self.samples, dtype=float)

    def has(self, names: Sequence[str]) -> bool:
        """True if all these variables are in the group."""
        return all(name in self.names for name in names)

    def is_sampled_as(self, other: _Group) -> bool:
        """True if the samples are at the times of another group's."""
        return self.samples == other.samples and np.allclose(
            self.time, other.time, atol=1e-6 * self.step, rtol=0.0
        )


def read_bladed(path: Path, *, speed_needed: bool = True) -> dict:
    """Hub loads of a Bladed run, any file of which may be named.

    Returns time (n,) [s], shaft_speed (n,) [rad/s], force (n, 3) [N], moment (n, 3) [N m] and
    `reading`, their channels. `shaft_speed` is left out unless it is needed. Raises InputError if
    a group is absent, cut off, or does not fit its header.
    """
    wanted = (*_LOADS, _SPEED) if speed_needed else _LOADS
    groups = _groups(path, wanted)
    loads = [group for group in groups if group.has(_LOADS)]
    if not loads:
        remedy = "Switch on the output of the hub loads in the fixed frame, and run Bladed again."
        raise _missing(_LOADS, groups, path, remedy)
    hub = loads[0]
    columns = _columns(hub, _LOADS)
    result = {"time": hub.time, "force": columns[:, :3], "moment": columns[:, 3:]}
    reading = [
        f"force and moment: Stationary hub Fx … Mz of {hub.header.name}, axes as in the file"
    ]
    if not speed_needed:
        return result | {"reading": tuple(reading)}
    drives = [group for group in groups if group.has((_SPEED,))]
    if not drives:
        remedy = f"Switch on the output of the drive train variables, or {_SAY_THE_SPEED}"
        raise _missing((_SPEED,), groups, path, remedy)
    sampled = [group for group in drives if group.is_sampled_as(hub)]
    if sampled:
        with_speed = sampled[0]
        result["shaft_speed"] = _columns(with_speed, (_SPEED,))[:, 0]
        reading.append(f"shaft speed: {_SPEED} of {with_speed.header.name}")
    else:
        names = ", ".join(group.header.name for group in drives)
        raise InputError(
            f"{hub.header.name} and the groups with the rotor's speed, {names}, have different "
            "time steps",
            where=str(path),
            allowed="the same samples in both groups",
            remedy=f"Write both groups with the same output step, or {_SAY_THE_SPEED}",
        )
    return result | {"reading": tuple(reading)}


def _missing(names: Sequence[str], groups: Sequence[_Group], path: Path, remedy: str) -> InputError:
    """The error that no group has all these variables."""
    present = {name for group in groups for name in group.names}
    missing = [name for name in names if name not in present]
    together = "" if missing else " together in one group"
    headers = ", ".join(group.header.name for group in groups) or "none has a time axis"
    return InputError(
        f"the run has no {', '.join(missing or names)}{together}",
        where=str(path),
        allowed=f"a group with {', '.join(names)}, among the headers of the run: {headers}",
        remedy=remedy,
    )


def _groups(path: Path, wanted: Sequence[str]) -> list[_Group]:
    """Groups of the run over time that have a variable that is wanted."""
    stem = path.name[: -len(path.suffix)]
    headers = []
    for neighbour in path.parent.iterdir():
        is_header = re.fullmatch(r"\.%\d+", neighbour.suffix) and neighbour.stem == stem
        if is_header and neighbour.is_file():
            headers.append(neighbour)
    headers.sort()
    if not headers:
        raise InputError(
            f"there is no header {stem}.%nn beside it",
            where=str(path),
            allowed="the headers (.%nn) and the data (.$nn) of a run in one folder",
            remedy="Copy the headers too: without them the data cannot be read.",
        )
    fields = {header: _fields(header) for header in headers}
    groups = []
    for header, of_header in fields.items():
        if any(name in value for _, value in of_header for name in wanted):
            group = _group(header, of_header)
            if group is not None:
                groups.append(group)
    return groups


def _fields(path: Path) -> list[tuple[str, str]]:
    """Keys and values of a header; further lines belong to the key before."""
    if path.stat().st_size > 10_000_000:
        raise InputError(
            "the header is larger than 10 MB", where=str(path), remedy="Check that it is one."
        )
    fields: list[tuple[str, str]] = []
    for line in text_lines(path.read_bytes()):
        tabbed = re.fullmatch(r"\s*([A-Z]+) *\t(.*)", line)
        key, _, value = line.strip().partition(" ")
        if tabbed:
            fields.append((tabbed[1], tabbed[2].strip()))
        elif key in _KEYS:
            fields.append((key, value.strip()))
        elif fields:
            last_key, last_value = fields[-1]
            fields[-1] = (last_key, f"{last_value} {line.strip()}")
    return fields


def _group(path: Path, fields: list[tuple[str, str]]) -> _Group | None:
    """The group of a header; None where it has no plain time axis, as statistics and spectra."""
    first_of = dict(reversed(fields))
    try:
        names = tuple(name.strip() for name in shlex.split(first_of["VARIAB"]))
        variables, *others = map(int, first_of["DIMENS"].split())
        axes = [value.strip("' ") for key, value in fields if key == "AXISLAB"]
        if len(others) != 1 or axes[-1:] != ["Time"] or first_of["AXIMETH"].strip() != "2":
            return None
        samples = others[0]
        units = tuple(first_of["VARUNIT"].split())
        form = first_of["FORM"].strip().upper()
        if form not in ("F", "U"):
            raise ValueError(f"FORM {form}, where F is text and U is binary")
        # Some versions declare binary data as F, with direct access. Sequential data are text.
        access = first_of.get("ACCESS", "S").strip().upper()
        sequential = form == "F" and access == "S"
        number = None
        if not sequential:
            number = _NUMBERS[first_of["FORMAT"].strip().upper()]
        first = fortran_number(first_of["MIN"].strip())
        step = fortran_number(first_of["STEP"].strip())
        end = first + step * samples
        if not (step > 0.0 and math.isfinite(end)):
            raise ValueError(
                f"MIN {first:g} and STEP {step:g}, where times are finite and the step is above 0"
            )
        mean, _ = numbers(first_of.get("MEAN", "").split())
        if mean.size not in (0, variables):
            raise ValueError(f"MEAN has {mean.size} numbers for {variables} variables")
    except (KeyError, ValueError, IndexError) as error:
        fault = f"not readable as a header of Bladed ({error})"
        allowed = "the keys DIMENS, VARIAB, VARUNIT, FORM, FORMAT, AXISLAB, AXIMETH, MIN and STEP"
        raise InputError(fault, where=str(path), allowed=allowed, remedy=_AGAIN) from error
    if len(names) != variables or len(units) != variables:
        raise InputError(
            f"the header announces {variables} variables, and names {len(names)} with "
            f"{len(units)} units",
            where=str(path),
            remedy=_AGAIN,
        )
    if not 0 < variables * samples <= MOST_VALUES:
        fault = f"the header announces {variables} variables of {samples} samples"
        raise InputError(
            fault, where=str(path), allowed=f"1 to {MOST_VALUES} values", remedy=_AGAIN
        )
    return _Group(path, names, units, samples, first, step, number, form == "F", mean)


def _columns(group: _Group, names: Sequence[str]) -> FloatArray:
    """Values (n, len(names)) of some variables in SI units, checked against the header."""
    for name in names:
        column = group.names.index(name)
        unit = group.units[column]
        if unit != _UNITS[name]:
            raise InputError(
                f"{name} has the unit code {unit}",
                where=str(group.header),
                allowed=f"{_UNITS[name]}, in SI units",
                remedy="Run Bladed with SI output.",
            )
    suffix = group.header.suffix.replace("%", "$")
    data = group.header.with_suffix(suffix)
    if not data.is_file():
        fault = f"there is no {data.name} beside the header"
        raise InputError(fault, where=str(group.header), remedy="Copy the data file too.")
    shape = (group.samples, len(group.names))
    number = group.number
    if number is not None and group.may_be_text:
        size_of_binary = math.prod(shape) * number.itemsize
        is_binary = data.stat().st_size == size_of_binary
        number = number if is_binary else None
    if number is None:
        samples = announced_text(data, shape, "its header", _AGAIN)
    else:
        samples = Samples(announced_binary(data, number, shape, "its header", _AGAIN))
    columns = []
    for name in names:
        column = group.names.index(name)
        columns.append(samples.channel(column, name, str(data)))
    if group.mean.size:
        _check_means(group, samples, data)
    return np.column_stack(columns)


def _check_means(group: _Group, samples: Samples, data: Path) -> None:
    """InputError if a channel's mean is not the one that the header states."""
    mean = samples.values.mean(axis=0, dtype=np.float64)
    size = np.abs(samples.values).max(axis=0)
    largest = np.maximum(size, 1e-30)
    # Values that are not finite matter in the channels that are used, and in no others.
    relative = np.abs(mean - group.mean) / largest
    difference = np.nan_to_num(relative, posinf=0.0)
    worst = int(difference.argmax())
    if difference[worst] > _SAME_MEAN:
        raise InputError(
            f"the mean of {group.names[worst]} is {mean[worst]:.6g}, and the header states "
            f"{group.mean[worst]:.6g}",
            where=str(data),
            remedy="Header and data are not of the same run, or the data are damaged: copy both "
            "again.",
        )
