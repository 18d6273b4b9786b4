"""Hub loads from the output of a Bladed run, binary or text.

Bladed writes its results in groups, each as a header ``run.%nn`` and data ``run.$nn``. Any file of the run may be named;
the groups beside it are searched for

====================  ==========================================================================
force, moment         ``Stationary hub Fx`` … ``Fz``, ``Mx`` … ``Mz`` (hub loads, fixed frame)
shaft speed           ``Rotor speed`` (drive train variables), unless it is given
====================  ==========================================================================

The fixed hub frame has x along the shaft, downwind, z up and y = z × x, as `HubLoads` has. The weight of the rotor is in
these loads. Values are in SI units as the header's unit codes state (F, FL, A/T).
"""

from __future__ import annotations

import math
import re
import shlex
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from macroslip.errors import InputError
from macroslip.loads.source_file import MOST_VALUES, announced

_KEYS = (
    "FILE", "ACCESS", "FORM", "RECL", "FORMAT", "CONTENT", "CONFIG", "NDIMENS", "DIMENS", "GENLAB", "VARIAB",
    "VARUNIT", "AXISLAB", "AXIUNIT", "AXIMETH", "AXIVAL", "AXITICK", "MIN", "STEP", "NVARS", "ULOADS", "MAXTIME",
    "MINTIME", "MEAN",
)  # fmt: skip
_NUMBERS = {"R*4": np.dtype("<f4"), "R*8": np.dtype("<f8")}
_LOADS = tuple(f"Stationary hub {kind}{axis}" for kind in "FM" for axis in "xyz")
_SPEED = "Rotor speed"
_UNITS = {_SPEED: "A/T"} | {name: "F" if " F" in name else "FL" for name in _LOADS}
#: Largest difference between the mean of the data and the mean in the header, as part of the largest magnitude.
_SAME_MEAN = 1e-3
_AGAIN = "Copy the file again, or run Bladed again."


class _Group(NamedTuple):
    """A group of results, as its header describes it."""

    header: Path
    names: tuple[str, ...]
    units: tuple[str, ...]
    samples: int
    first: float  # time of the first sample [s]
    step: float  # time between samples [s]
    number: np.dtype | None  # of binary data; None for text
    mean: tuple[float, ...]  # means that the header states, or empty

    @property
    def time(self) -> NDArray[np.float64]:
        """Times of the samples [s]."""
        return self.first + self.step * np.arange(self.samples, dtype=float)


def read_bladed(path: Path, *, speed_needed: bool = True) -> dict:
    """Read time (n,) [s], shaft_speed (n,) [rad/s], force (n, 3) [N], moment (n, 3) [N m] and `reading`, their channels.

    Any file of the run may be named. Without a channel for it, `shaft_speed` is left out unless it is needed. Raises
    InputError if a group is absent, cut off, or does not fit its header.
    """
    groups = _groups(path)
    hub = _group_with(_LOADS, groups, path)
    columns = _columns(hub, _LOADS)
    result = {"time": hub.time, "force": columns[:, :3], "moment": columns[:, 3:]}
    reading = [
        f"force and moment: Stationary hub Fx … Mz of {hub.header.name}, axes as in the file"
    ]
    if speed_needed or any(_SPEED in group.names for group in groups):
        drive = _group_with((_SPEED,), groups, path)
        if drive.samples != hub.samples or not np.allclose(
            drive.time, hub.time, atol=1e-6 * drive.step, rtol=0.0
        ):
            what = f"{drive.header.name} and {hub.header.name} have different time steps"
            remedy = (
                "Write both groups with the same output step, or give the speed: loads.shaft_speed."
            )
            raise InputError(
                what, where=str(path), allowed="the same samples in both groups", remedy=remedy
            )
        result["shaft_speed"] = _columns(drive, (_SPEED,))[:, 0]
        reading.append(f"shaft speed: {_SPEED} of {drive.header.name}")
    return result | {"reading": tuple(reading)}


def _groups(path: Path) -> list[_Group]:
    stem = path.name[: -len(path.suffix)]
    headers = sorted(
        one
        for one in path.parent.iterdir()
        if one.is_file() and one.stem == stem and re.fullmatch(r"\.%\d+", one.suffix)
    )
    if not headers:
        allowed = "the headers (.%nn) and the data (.$nn) of a run in one folder"
        remedy = "Copy the headers too: without them the data cannot be read."
        raise InputError(
            f"there is no header {stem}.%nn beside it",
            where=str(path),
            allowed=allowed,
            remedy=remedy,
        )
    return [group for group in map(_header, headers) if group is not None]


def _group_with(names: tuple[str, ...], groups: list[_Group], path: Path) -> _Group:
    for group in groups:
        if all(name in group.names for name in names):
            return group
    present = {name for group in groups for name in group.names}
    missing = [name for name in names if name not in present]
    raise InputError(
        f"the run has no {', '.join(missing or names)}"
        + ("" if missing else " together in one group"),
        where=str(path),
        allowed=f"a group with {', '.join(names)}, among the headers of the run: "
        f"{', '.join(group.header.name for group in groups) or 'none has a time axis'}",
        remedy="Switch on the output of the drive train variables, or give the speed: loads.shaft_speed, or --shaft-speed of loads inspect."
        if names == (_SPEED,)
        else "Switch on the output of the hub loads in the fixed frame, and run Bladed again.",
    )


def _fields(path: Path) -> list[tuple[str, str]]:
    """Keys and values of a header; further lines belong to the key before."""
    if path.stat().st_size > 10_000_000:
        raise InputError(
            "the header is larger than 10 MB", where=str(path), remedy="Check that it is one."
        )
    fields: list[tuple[str, str]] = []
    for line in path.read_text(encoding="latin-1").splitlines():
        key, _, rest = line.strip().partition("\t" if "\t" in line.strip() else " ")
        if key.strip() in _KEYS:
            fields.append((key.strip(), rest.strip()))
        elif fields:
            fields[-1] = fields[-1][0], f"{fields[-1][1]} {line.strip()}"
    return fields


def _header(path: Path) -> _Group | None:
    """The group of a header; None where it has no plain time axis, as statistics and spectra have none."""
    fields = _fields(path)
    given = dict(reversed(fields))
    try:
        names = tuple(name.strip() for name in shlex.split(given["VARIAB"]))
        variables, *others = [int(word) for word in given["DIMENS"].split()]
        axes = [value.strip("' ") for key, value in fields if key == "AXISLAB"]
        if len(others) != 1 or axes[-1:] != ["Time"] or given["AXIMETH"].strip() != "2":
            return None
        samples = others[0]
        units = tuple(given["VARUNIT"].split())
        form = given["FORM"].strip().upper()
        if form not in ("F", "U"):
            raise ValueError(f"FORM {form}, where F is text and U is binary")
        number = None if form == "F" else _NUMBERS[given["FORMAT"].strip().upper()]
        first, step = float(given["MIN"]), float(given["STEP"])
        if not (step > 0.0 and math.isfinite(first + step * samples)):
            raise ValueError(
                f"MIN {first:g} and STEP {step:g}, where times are finite and the step is above 0"
            )
        mean = tuple(float(word) for word in given.get("MEAN", "").split())
        if not all(map(math.isfinite, mean)):
            raise ValueError("MEAN is not finite")
    except (KeyError, ValueError, IndexError) as error:
        what = f"not readable as a header of Bladed ({error})"
        allowed = "the keys DIMENS, VARIAB, VARUNIT, FORM, FORMAT, AXISLAB, AXIMETH, MIN and STEP"
        raise InputError(what, where=str(path), allowed=allowed, remedy=_AGAIN) from error
    if len(names) != variables or len(units) != variables:
        what = f"the header announces {variables} variables, and names {len(names)} with {len(units)} units"
        raise InputError(what, where=str(path), remedy=_AGAIN)
    if not 0 < variables * samples <= MOST_VALUES:
        what = f"the header announces {variables} variables of {samples} samples"
        raise InputError(what, where=str(path), allowed=f"1 to {MOST_VALUES} values", remedy=_AGAIN)
    return _Group(path, names, units, samples, first, step, number, mean)


def _columns(group: _Group, names: tuple[str, ...]) -> NDArray[np.float64]:
    """Values (n, len(names)) of some variables in SI units, checked against the header."""
    for name in names:
        unit = group.units[group.names.index(name)]
        if unit != _UNITS[name]:
            what = f"{name} has the unit code {unit}"
            allowed = f"{_UNITS[name]}, in SI units"
            raise InputError(
                what, where=str(group.header), allowed=allowed, remedy="Run Bladed with SI output."
            )
    data = group.header.with_suffix(group.header.suffix.replace("%", "$"))
    if not data.is_file():
        what = f"there is no {data.name} beside the header"
        raise InputError(what, where=str(group.header), remedy="Copy the data file too.")
    count = group.samples * len(group.names)
    values = (
        announced(data, group.number, count, "its header", _AGAIN)
        .reshape(group.samples, -1)
        .astype(np.float64)
    )
    mean = values.mean(axis=0)
    if len(group.mean) == len(group.names):
        off = np.abs(mean - np.array(group.mean)) / np.maximum(np.abs(values).max(axis=0), 1e-30)
        worst = int(off.argmax())
        if off[worst] > _SAME_MEAN:
            raise InputError(
                f"the mean of {group.names[worst]} is {mean[worst]:.6g}, and the header states {group.mean[worst]:.6g}",
                where=str(data),
                remedy="Header and data are not of the same run, or the data are damaged: copy both again.",
            )
    return np.ascontiguousarray(values[:, [group.names.index(name) for name in names]])
