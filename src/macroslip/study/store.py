"""The folder of a study: `manifest.json`, `runs.parquet`, `journal.jsonl`, `cases/`, `summary.parquet`, `log.txt`.

Results lie in `cases/`, each in a netCDF file named by the key of its case. They are there for good once the journal
has their line. The summary is made from the journal.
"""

from __future__ import annotations

import hashlib
import io
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from macroslip.errors import InputError
from macroslip.files import UNFINISHED, check_regular, write_durably

if TYPE_CHECKING:
    import xarray as xr

FORMAT = 1
MANIFEST, RUNS, JOURNAL, SUMMARY, LOG, CASES = (
    "manifest.json", "runs.parquet", "journal.jsonl", "summary.parquet", "log.txt", "cases",
)  # fmt: skip
#: What to do about a folder whose tables are damaged.
REMEDY = "Write it again with macroslip study STUDY.yaml -o DIR --resume; results are kept."
#: Attribute with the description of variables that have no values.
_EMPTY = "variables_without_values"
#: Folder of the runs by which the temperature of a study is found; a study of its own.
BALANCE_RUNS = "balance"
#: Everything a study's folder may hold; in a folder with other files no study begins.
OURS = {MANIFEST, RUNS, JOURNAL, SUMMARY, LOG, CASES, BALANCE_RUNS, "lock"}


def case_path(directory: Path, key: str) -> Path:
    """Where the result of a case lies: 256 folders keep any one of them small."""
    if len(key) != 64 or not set(key) <= set("0123456789abcdef"):
        raise ValueError(f"{key!r} is not a key")
    return directory / CASES / key[:2] / f"{key}.nc"


def to_bytes(result: xr.Dataset) -> bytes:
    """A dataset as the content of a netCDF file: classic format with 64-bit offsets.

    HDF5 takes 75 ms for a result of this size, this format 2 ms, and it needs no library that may end the
    process. It has no 64-bit integers: those that need them become floats.
    """
    import numpy as np

    large = {
        name: variable.astype(float)
        for name, variable in result.data_vars.items()
        if variable.dtype.kind in "iu" and variable.size and np.abs(variable.values.astype(float)).max() >= 2**31
    }
    result = result.assign(large)
    # A dimension of length zero would be taken for one that can grow: a window without a complete orbit.
    empty = {str(name): one for name, one in result.variables.items() if one.size == 0}
    about = {
        name: [one.dims, one.shape, one.dtype.str, one.attrs, name in result.coords] for name, one in empty.items()
    }
    kept = result.drop_vars(list(empty)).assign_attrs({_EMPTY: json.dumps(about)} if empty else {})
    return bytes(kept.to_netcdf(engine="scipy", format="NETCDF3_64BIT"))


def from_bytes(content: bytes) -> xr.Dataset:
    """The dataset that a netCDF file of the store holds."""
    import numpy as np
    import xarray as xr

    with xr.open_dataset(io.BytesIO(content), engine="scipy") as opened:
        result = opened.load()
    about = json.loads(result.attrs.pop(_EMPTY, "{}"))
    empty = {name: (dims, np.empty(shape, dtype), attrs) for name, (dims, shape, dtype, attrs, _) in about.items()}
    coordinates = [name for name, description in about.items() if description[-1]]
    return result.assign(empty).set_coords(coordinates)


def checksum(content: bytes) -> str:
    """SHA-256 in hexadecimal digits."""
    return hashlib.sha256(content).hexdigest()


def layout(result: xr.Dataset) -> dict[str, Any]:
    """What a reader needs of a result before it opens it.

    Returns
    -------
    dict
        `sizes` by dimension; `rollers`, their numbers, left out where they count from 0; and `variables`, a hash of
        names, dimensions and types.
    """
    variables = sorted((str(name), *map(str, one.dims), one.dtype.str) for name, one in result.variables.items())
    numbers = [int(number) for number in result.roller.values]
    found = {
        "sizes": {str(name): size for name, size in result.sizes.items()},
        "variables": checksum(json.dumps(variables).encode())[:16],
    }
    return found if numbers == list(range(len(numbers))) else found | {"rollers": numbers}


def read_result(directory: Path, key: str, expected: str) -> xr.Dataset:
    """Read a stored result, if it is what was stored.

    Parameters
    ----------
    directory : Path
        Of the study.
    key : str
        Of the case.
    expected : str
        Checksum from the journal.

    Raises
    ------
    InputError
        If the file is missing or damaged.
    """
    path = case_path(directory, key)
    remedy = "Compute it again: macroslip study STUDY.yaml -o DIR --resume"
    check_regular(path, remedy)
    try:
        content = path.read_bytes()
    except OSError as error:
        raise InputError(f"a stored result cannot be read ({error.strerror})", where=str(path), remedy=remedy) from None
    if checksum(content) != expected:
        raise InputError("a stored result is damaged: its checksum has changed", where=str(path), remedy=remedy)
    return from_bytes(content)


def write_manifest(directory: Path, manifest: dict[str, Any]) -> str:
    """Write the manifest durably; gives its checksum, by which workers verify that they read the same."""
    content = json.dumps({"format": FORMAT, **manifest}, indent=1, ensure_ascii=False).encode()
    write_durably(directory / MANIFEST, content)
    return checksum(content)


def read_manifest(directory: Path) -> tuple[dict[str, Any], str]:
    """The manifest and its checksum.

    Raises
    ------
    InputError
        If the folder holds no study, or one of another format.
    """
    path = directory / MANIFEST
    check_parts(directory)
    try:
        content = path.read_bytes()
        manifest = json.loads(content)
        found = manifest["format"]
    except (FileNotFoundError, NotADirectoryError):
        remedy = "Name a folder that macroslip study has written."
        raise InputError("there is no study in this folder", where=str(directory), remedy=remedy) from None
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise InputError(f"the manifest cannot be read ({error})", where=str(path), remedy=REMEDY) from None
    if found != FORMAT:
        raise InputError(
            f"the study has format {found!r}",
            where=str(path),
            allowed=str(FORMAT),
            remedy="It was written by another version of macroslip; use that one, or another folder.",
        )
    return manifest, checksum(content)


def parts(directory: Path) -> list[Path]:
    """The files at the top of a study's folder, whether they are there or not."""
    return [directory / name for name in sorted(OURS - {CASES, BALANCE_RUNS})]


def check_parts(directory: Path) -> None:
    """Refuse a folder in which a pipe, a socket or a device has the name of a file of the study.

    Raises
    ------
    InputError
    """
    for path in parts(directory):
        check_regular(path, "Remove it.")


def check_folder(directory: Path, *, resume: bool) -> None:
    """Refuse a folder that a study cannot begin in.

    Raises
    ------
    InputError
        If it is a file, holds other things, or holds a study and `resume` is not set.
    """
    where = str(directory)
    if not directory.exists():
        return
    if not directory.is_dir():
        raise InputError("it is not a folder", where=where, remedy="Name a folder, new or empty.")
    check_parts(directory)
    names = {path.name for path in directory.iterdir()}
    if names & {MANIFEST, JOURNAL}:
        if not resume:
            remedy = "Go on with it by --resume, or choose another folder."
            raise InputError("the folder holds a study already", where=where, remedy=remedy)
        return
    foreign = sorted(name for name in names if name not in OURS and not name.endswith(UNFINISHED))
    if foreign:
        raise InputError(
            f"the folder holds other things, {foreign[0]!r} first",
            where=where,
            remedy="Name a folder that is new or empty.",
        )


def remove_unfinished(directory: Path) -> int:
    """Remove what was being written when a process ended; gives how many files there were."""
    found = [*directory.glob(f".*{UNFINISHED}"), *(directory / CASES).glob(f"*/.*{UNFINISHED}")]
    for path in found:
        path.unlink(missing_ok=True)
    return len(found)
