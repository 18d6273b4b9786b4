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

import re
import shlex
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from macroslip.errors import InputError

_KEYS = frozenset(
    (
        "FILE",
        "ACCESS",
        "FORM",
        "RECL",
        "FORMAT",
        "CONTENT",
        "CONFIG",
        "NDIMENS",
        "DIMENS",
        "GENLAB",
        "VARIAB",
        "VARUNIT",
        "AXISLAB",
        "AXIUNIT",
        "AXIMETH",
        "AXIVAL",
        "AXITICK",
        "MIN",
        "STEP",
        "NVARS",
        "ULOADS",
        "MAXTIME",
        "MINTIME",
        "MEAN",
    )
)
_NUMBERS = {"R*4": np.dtype("<f4"), "R*8": np.dtype("<f8")}
_FORCE = tuple(f"Stationary hub F{axis}" for axis in "xyz")
_MOMENT = tuple(f"Stationary hub M{axis}" for axis in "xyz")
_SPEED = "Rotor speed"
_UNITS = {_SPEED: "A/T"} | dict.fromkeys(_FORCE, "F") | dict.fromkeys(_MOMENT, "FL")
#: Largest difference between the mean of the data and the mean in the header, as part of the largest magnitude.
_SAME_MEAN = 1e-3
_MOST_VALUES = 500_000_000


@dataclass(frozen=True, slots=True)
class Group:
    """A group of results: its header, and where its data are.

    Parameters
    ----------
    header, data : Path
        ``run.%nn`` and ``run.$nn``.
    names, units : tuple of str
        Of the variables.
    samples : int
        Number of time steps.
    first, step : float
        Time of the first sample and time between samples [s].
    number : dtype or None
        Of binary data; None for text.
    mean : tuple of float
        Means that the header states, or empty.
    """

    header: Path
    data: Path
    names: tuple[str, ...]
    units: tuple[str, ...]
    samples: int
    first: float
    step: float
    number: np.dtype | None
    mean: tuple[float, ...]

    @property
    def time(self) -> NDArray[np.float64]:
        """Times of the samples [s]."""
        return self.first + self.step * np.arange(self.samples, dtype=float)


def read_bladed(path: Path, *, speed_needed: bool = True) -> dict:
    """Read time (n,) [s], shaft_speed (n,) [rad/s], force (n, 3) [N] and moment (n, 3) [N m].

    Parameters
    ----------
    path : Path
        Any file of the run.
    speed_needed : bool
        Whether the run has to hold the rotor speed; otherwise `shaft_speed` is left out if it does not.

    Returns
    -------
    dict
        The arrays, and `reading`: what each was read from.

    Raises
    ------
    InputError
        A group is absent, cut off, or does not fit its header.
    """
    groups = _groups(path)
    hub = _group_with((*_FORCE, *_MOMENT), groups, path)
    columns = _columns(hub, (*_FORCE, *_MOMENT))
    result = {"time": hub.time, "force": columns[:, :3], "moment": columns[:, 3:]}
    reading = [f"force and moment: Stationary hub Fx … Mz of {hub.header.name}, axes as in the file"]
    if speed_needed or any(_SPEED in group.names for group in groups):
        drive = _group_with((_SPEED,), groups, path)
        if drive.samples != hub.samples or not np.allclose(drive.time, hub.time, atol=1e-6 * drive.step, rtol=0.0):
            raise InputError(
                f"{drive.header.name} and {hub.header.name} have different time steps",
                where=str(path),
                allowed="the same samples in both groups",
                remedy="Write both groups with the same output step, or give the speed: loads.shaft_speed.",
            )
        result["shaft_speed"] = _columns(drive, (_SPEED,))[:, 0]
        reading.append(f"shaft speed: {_SPEED} of {drive.header.name}")
    return result | {"reading": tuple(reading)}


def _groups(path: Path) -> list[Group]:
    """Groups with a time axis beside `path`."""
    stem = path.name[: -len(path.suffix)]
    headers = sorted(
        one
        for one in path.parent.iterdir()
        if one.is_file() and one.stem == stem and re.fullmatch(r"\.%\d+", one.suffix)
    )
    if not headers:
        raise InputError(
            f"there is no header {stem}.%nn beside it",
            where=str(path),
            allowed="the headers (.%nn) and the data (.$nn) of a run in one folder",
            remedy="Copy the headers too: without them the data cannot be read.",
        )
    found = (_header(one) for one in headers)
    return [group for group in found if group is not None]


def _group_with(names: tuple[str, ...], groups: list[Group], path: Path) -> Group:
    for group in groups:
        if all(name in group.names for name in names):
            return group
    present = {name for group in groups for name in group.names}
    missing = [name for name in names if name not in present]
    speed = names == (_SPEED,)
    raise InputError(
        f"the run has no {', '.join(missing or names)}" + ("" if missing else " together in one group"),
        where=str(path),
        allowed=f"a group with {', '.join(names)}, among the headers of the run: "
        f"{', '.join(group.header.name for group in groups) or 'none has a time axis'}",
        remedy="Switch on the output of the drive train variables, or give the speed: loads.shaft_speed."
        if speed
        else "Switch on the output of the hub loads in the fixed frame, and run Bladed again.",
    )


def _fields(path: Path) -> list[tuple[str, str]]:
    """Keys and values of a header; further lines belong to the key before."""
    if path.stat().st_size > 10_000_000:
        raise InputError("the header is larger than 10 MB", where=str(path), remedy="Check that it is one.")
    fields: list[tuple[str, str]] = []
    for line in path.read_text(encoding="latin-1").splitlines():
        key, _, rest = line.strip().partition("\t") if "\t" in line.strip() else line.strip().partition(" ")
        if key.strip() in _KEYS:
            fields.append((key.strip(), rest.strip()))
        elif fields:
            fields[-1] = fields[-1][0], f"{fields[-1][1]} {line.strip()}"
    return fields


def _header(path: Path) -> Group | None:
    """The group of a header; None where it has no plain time axis, as statistics and spectra have none."""
    fields = _fields(path)
    given = dict(reversed(fields))
    try:
        names = tuple(name.strip() for name in shlex.split(given["VARIAB"]))
        dimensions = [int(word) for word in given["DIMENS"].split()]
        axes = [value.strip("' ") for key, value in fields if key == "AXISLAB"]
        if len(dimensions) != 2 or axes[-1:] != ["Time"] or given["AXIMETH"].strip() != "2":
            return None
        units = tuple(given["VARUNIT"].split())
        text = given["FORM"].strip().upper() == "F"
        number = None if text else _NUMBERS[given["FORMAT"].strip().upper()]
        group = Group(
            header=path,
            data=path.with_suffix(path.suffix.replace("%", "$")),
            names=names,
            units=units,
            samples=dimensions[1],
            first=float(given["MIN"]),
            step=float(given["STEP"]),
            number=number,
            mean=tuple(float(word) for word in given.get("MEAN", "").split()),
        )
    except (KeyError, ValueError, IndexError) as error:
        raise InputError(
            f"not readable as a header of Bladed ({error})",
            where=str(path),
            allowed="the keys DIMENS, VARIAB, VARUNIT, FORM, FORMAT, AXISLAB, AXIMETH, MIN and STEP",
            remedy="Copy the file again, or run Bladed again.",
        ) from error
    if len(names) != dimensions[0] or len(units) != dimensions[0]:
        raise InputError(
            f"the header announces {dimensions[0]} variables, and names {len(names)} with {len(units)} units",
            where=str(path),
            remedy="Copy the file again, or run Bladed again.",
        )
    if not 0 < dimensions[0] * dimensions[1] <= _MOST_VALUES:
        raise InputError(
            f"the header announces {dimensions[0]} variables of {dimensions[1]} samples",
            where=str(path),
            allowed=f"1 to {_MOST_VALUES} values",
            remedy="Copy the file again, or run Bladed again.",
        )
    return group


def _columns(group: Group, names: tuple[str, ...]) -> NDArray[np.float64]:
    """Values (n, len(names)) of some variables in SI units, checked against the header."""
    for name in names:
        unit = group.units[group.names.index(name)]
        if unit != _UNITS[name]:
            raise InputError(
                f"{name} has the unit code {unit}",
                where=str(group.header),
                allowed=f"{_UNITS[name]}, in SI units",
                remedy="Run Bladed with SI output.",
            )
    values = _values(group)
    mean = values.mean(axis=0)
    if len(group.mean) == len(group.names):
        off = np.abs(mean - np.array(group.mean)) / np.maximum(np.abs(values).max(axis=0), 1e-30)
        worst = int(off.argmax())
        if off[worst] > _SAME_MEAN:
            raise InputError(
                f"the mean of {group.names[worst]} is {mean[worst]:.6g}, and the header states {group.mean[worst]:.6g}",
                where=str(group.data),
                remedy="Header and data are not of the same run, or the data are damaged: copy both again.",
            )
    return np.ascontiguousarray(values[:, [group.names.index(name) for name in names]])


def _values(group: Group) -> NDArray[np.float64]:
    shape = (group.samples, len(group.names))
    if not group.data.is_file():
        raise InputError(
            f"there is no {group.data.name} beside the header",
            where=str(group.header),
            remedy="Copy the data file too.",
        )
    expected = shape[0] * shape[1]
    if group.number is not None:
        size, full = group.data.stat().st_size, expected * group.number.itemsize
        if size != full:
            state = "cut off" if size < full else "damaged"
            raise InputError(
                f"the file is {state}: its header announces {full} bytes, it has {size}",
                where=str(group.data),
                remedy="Copy the file again, or run Bladed again.",
            )
        return np.fromfile(group.data, group.number).reshape(shape).astype(np.float64)
    try:
        values = np.array(group.data.read_text(encoding="ascii").split(), dtype=np.float64)
    except ValueError as error:
        raise InputError(
            f"not readable as numbers ({error})",
            where=str(group.data),
            remedy="Copy the file again, or run Bladed again.",
        ) from error
    if values.size != expected:
        raise InputError(
            f"the file holds {values.size} numbers, its header announces {expected}",
            where=str(group.data),
            remedy="Copy the file again, or run Bladed again.",
        )
    return values.reshape(shape)
