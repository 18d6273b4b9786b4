"""Results as netCDF files, with a checksum for every block of numbers, checked when read.

HDF5's Fletcher checksum is verified by every reader of the format: a flipped bit in a number is an
error, not a wrong number.
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import xarray as xr

from macroslip.bearing.geometry import AXIAL_SIGNS
from macroslip.errors import InputError
from macroslip.imposed.status import Status
from macroslip.measures.totals import INTERFACES
from macroslip.result.variables import TRACES, VARIABLES

REMEDY = "Name files that macroslip run wrote, whole ones; run the case again if need be."
_TRACES = [name for name, variable in VARIABLES.items() if variable.when == TRACES]
#: Largest block [bytes] with one checksum; larger variables are divided by the library.
_LARGEST_BLOCK = 2**26
#: Angle of a roller [rad] beyond which there is none: a thousand turns.
_LARGEST_ANGLE = 6e3
#: Number beyond which none is of a bearing; its square can still be computed.
_LARGEST = 1e30


def to_netcdf(result: xr.Dataset) -> bytes:
    """The content of a netCDF file with a result, with checksums.

    Numbers without dimension and text have none; the format has none for them.
    """
    encoding: dict[str, dict[str, Any]] = {}
    for name, variable in result.variables.items():
        if variable.ndim and variable.size and variable.dtype.kind in "fiu":
            whole = {}
            if variable.nbytes <= _LARGEST_BLOCK:
                whole = {"chunksizes": variable.shape}
            encoding[str(name)] = {"fletcher32": True, **whole}
    return bytes(result.to_netcdf(engine="h5netcdf", encoding=encoding))


def check_result(result: xr.Dataset, where: str) -> None:
    """Refuse a dataset that is no result, is incomplete, or holds impossible values.

    Raises InputError naming the variable or attribute. The result is as read from the file `where`:
    of a run, or of a study, which has everything over `case` too.
    """
    problem = next(
        filter(None, (look(result) for look in (_names, _kinds, _labels, _values, _input))), None
    )
    if problem:
        allowed = "what macroslip run wrote, or a selection of it"
        raise InputError(problem, where=where, allowed=allowed, remedy=REMEDY)


def _names(result: xr.Dataset) -> str:
    missing = [name for name in ("energy", "status") if name not in result.data_vars]
    missing += [name for name in ("row", "roller", "interface") if name not in result.dims]
    if "time" in result.dims:
        traced = ("time", "start_angle", *_TRACES)
        missing += [name for name in traced if name not in result.variables]
        missing += [name for name in ("window_start", "window_end") if name not in result.attrs]
    if not missing:
        return ""
    return f"the dataset has no {', no '.join(missing)}"


def _kinds(result: xr.Dataset) -> str:
    for name, variable in VARIABLES.items():
        if name not in result:
            continue
        expected = variable.dims
        dims = tuple(dim for dim in result[name].dims if dim != "case")
        # A selection, of one row for example, has lost that dimension everywhere.
        whole = tuple(dim for dim in expected if dim in result.dims)
        if dims != whole:
            listed = ", ".join(map(str, dims))
            return f"{name} is over ({listed}), not ({', '.join(expected)})"
        if result[name].dtype.kind not in "fiu":
            return f"{name} holds no numbers"
    for name in ("window_start", "window_end"):
        time = result.attrs.get(name, 0.0)
        is_number = np.ndim(time) == 0 and isinstance(time, (int, float, np.number))
        if not (is_number and np.isfinite(time)):
            return f"the attribute {name} is no time"
    return ""


def _labels(result: xr.Dataset) -> str:
    for name, known in (("row", tuple(AXIAL_SIGNS)), ("interface", INTERFACES)):
        labels = result[name].values.tolist()
        different = set(labels)
        is_repeated = len(different) != len(labels)
        if not labels or is_repeated or not different <= set(known):
            listed = ", ".join(map(str, labels))[:80] or "empty"
            return f"{name} is {listed}, not of {', '.join(known)}"
    for name in ("roller", "time"):
        if name in result.dims:
            values = result[name].values
            numbers = (
                values.dtype.kind in "fiu"
                and values.size > (name == "time")
                and np.isfinite(values).all()
            )
            if not (numbers and (np.diff(values) > 0).all()):
                return f"the coordinate {name} does not rise from value to value"
    return ""


def _values(result: xr.Dataset) -> str:
    status = result.status.values
    meanings = [int(member) for member in Status]
    if not np.isin(status, meanings).all():
        return "status holds numbers without a meaning"
    is_completed = result.status == Status.COMPLETED
    energy = result.energy.where(is_completed, 0.0).values
    is_energy = np.isfinite(energy) & (energy >= 0.0)
    if not is_energy.all():
        return "energy is negative or not finite for a roller that was completed"
    if "start_angle" in result.variables:
        angles = result.start_angle.values
        if angles.dtype.kind not in "fiu" or not (np.abs(angles) <= _LARGEST_ANGLE).all():
            return "start_angle holds no angles"
    for name, variable in result.variables.items():
        # Where an integration failed its slip may be anything; and lives of the rating may be
        # endless.
        known = (
            (name in VARIABLES or name in result.coords)
            and name != "end_slip"
            and variable.dtype.kind == "f"
        )
        if known and (np.abs(variable.values) > _LARGEST).any():
            return f"{name} holds numbers beyond {_LARGEST:g}"
    return ""


def _input(result: xr.Dataset) -> str:
    try:
        content = json.loads(result.attrs.get("input", "{}"))
        good = isinstance(content, dict)
    except (TypeError, ValueError, RecursionError):
        good = False
    return "" if good else "the attribute input holds no case"
