"""Results of a study as files: where each lies, its content, and its checksum.

A result is a netCDF file in `cases/`, named by the key of its case.
"""

from __future__ import annotations

import hashlib
import io
import json
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from macroslip.errors import InputError
from macroslip.storage.files import UNFINISHED, check_regular

#: Folder of the results in that of the study.
CASES = "cases"
#: Attribute with the description of variables that have no values.
_EMPTY = "variables_without_values"
_REMEDY = "Compute it again: macroslip study STUDY.yaml -o DIR --resume"


def case_path(directory: Path, key: str) -> Path:
    """Path of the result of a case: 256 folders keep any one of them small."""
    if len(key) != 64 or not set(key) <= set("0123456789abcdef"):
        raise ValueError(f"{key!r} is not a key")
    return directory / CASES / key[:2] / f"{key}.nc"


def claim_path(path: Path, session: str) -> Path:
    """File by which a run of a session claims the result of this path; it counts as unfinished."""
    return path.with_name(f".{path.stem}.{session}{UNFINISHED}")


def to_bytes(result: xr.Dataset) -> bytes:
    """A dataset as the content of a netCDF file: classic format with 64-bit offsets.

    HDF5 takes 75 ms for a result of this size, this format 2 ms. It has no 64-bit integers: those
    that need them become floats. A dimension of length zero would be taken for one that can grow,
    so such variables are described in an attribute.
    """
    large = {}
    empty = {}
    for name, variable in result.data_vars.items():
        if _is_beyond_32_bits(variable):
            large[name] = variable.astype(float)
    for name, variable in result.variables.items():
        if variable.size == 0:
            kind = variable.dtype.str
            is_coordinate = name in result.coords
            entry = [variable.dims, variable.shape, kind, variable.attrs, is_coordinate]
            empty[str(name)] = entry
    stored = result.assign(large).drop_vars(list(empty))
    if empty:
        stored = stored.assign_attrs({_EMPTY: json.dumps(empty)})
    return bytes(stored.to_netcdf(engine="scipy", format="NETCDF3_64BIT"))


def _is_beyond_32_bits(variable: xr.DataArray) -> bool:
    """True if whole numbers of a variable do not fit 32 bits."""
    if variable.dtype.kind not in "iu" or not variable.size:
        return False
    sizes = np.abs(variable.values.astype(float))
    return bool(sizes.max() >= 2**31)


def from_bytes(content: bytes) -> xr.Dataset:
    """The dataset that a netCDF file of the store holds."""
    with xr.open_dataset(io.BytesIO(content), engine="scipy") as opened:
        result = opened.load()
    empty = json.loads(result.attrs.pop(_EMPTY, "{}"))
    for name, (dims, shape, dtype, attrs, is_coordinate) in empty.items():
        result[name] = (dims, np.empty(shape, dtype), attrs)
        if is_coordinate:
            result = result.set_coords(name)
    return result


def checksum(content: bytes) -> str:
    """SHA-256 in hexadecimal digits."""
    return hashlib.sha256(content).hexdigest()


def layout(result: xr.Dataset) -> str:
    """Layout of a result that a reader needs before it opens the file, as JSON.

    `sizes` by dimension; `rollers`, their numbers, left out where they count from 0; and
    `variables`, a hash of names, dimensions and types.
    """
    variables = []
    for name, variable in result.variables.items():
        dims = map(str, variable.dims)
        variables.append((str(name), *dims, variable.dtype.str))
    variables.sort()
    described: dict[str, Any] = {
        "sizes": {str(name): size for name, size in result.sizes.items()},
        "variables": checksum(json.dumps(variables).encode())[:16],
    }
    numbers = [int(number) for number in result.roller.values]
    if numbers != list(range(len(numbers))):
        described["rollers"] = numbers
    return json.dumps(described)


def read_result(directory: Path, key: str, expected: str) -> xr.Dataset:
    """Read a stored result, if it still has the checksum in the database.

    Raises InputError if the file is missing or damaged.
    """
    path = case_path(directory, key)
    check_regular(path, _REMEDY)
    try:
        content = path.read_bytes()
    except OSError as error:
        fault = f"a stored result cannot be read ({error.strerror})"
        raise InputError(fault, where=str(path), remedy=_REMEDY) from None
    if checksum(content) != expected:
        fault = "a stored result is damaged: its checksum has changed"
        raise InputError(fault, where=str(path), remedy=_REMEDY)
    return from_bytes(content)
