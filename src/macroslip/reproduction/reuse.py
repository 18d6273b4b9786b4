"""Results of an earlier run, used again where nothing they depend on has changed.

Each part of a run is stored as netCDF beside the results, with a key made of everything it depends on: its inputs, the
sources of this package and the libraries that compute. A list holds key and SHA-256 of every file; what does not match
its key or its checksum is computed again. The files are data and nothing in them is executed.
"""

from __future__ import annotations

import functools
import hashlib
import importlib.metadata
import json
import platform
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from macroslip.fingerprint import KERNEL_PARTS, RESULT_PARTS, fingerprint

if TYPE_CHECKING:
    import xarray as xr

FOLDER, LIST = "reuse", "reuse.json"
_LIBRARIES = ("numpy", "scipy", "numba", "llvmlite", "xarray")


@functools.cache
def _program_hash() -> str:
    versions = [platform.python_version(), platform.machine(), *map(importlib.metadata.version, _LIBRARIES)]
    return "\0".join([fingerprint(*KERNEL_PARTS, *RESULT_PARTS, "reproduction", "torque"), *versions])


def key_of(inputs: Any) -> str:
    """Key of a part of a run: a hash of its inputs, of this program and of the libraries that compute.

    Parameters
    ----------
    inputs : Any
        Everything else the part depends on, as plain data (what `json` writes).

    Examples
    --------
    >>> key_of({"case": "14B"}) == key_of({"case": "14B"}), key_of({"case": "14B"}) == key_of({"case": "14C"})
    (True, False)
    """
    text = json.dumps(inputs, sort_keys=True, ensure_ascii=False)
    return hashlib.sha256(f"{_program_hash()}\0{text}".encode()).hexdigest()


class Reuse:
    """Parts of a run, read from an earlier one's folder where they are still right, written to a new one.

    Parameters
    ----------
    earlier : Path
        Results of an earlier run, or a folder that does not exist.
    folder : Path
        Where this run writes; the same parts are stored there again.

    Attributes
    ----------
    reused : list of str
        Names of the parts that were read.
    """

    def __init__(self, earlier: Path, folder: Path):
        self._earlier, self._folder = earlier / FOLDER, folder / FOLDER
        self._folder.mkdir()
        self._entries: dict[str, Any] = {}
        self.reused: list[str] = []
        try:
            known = json.loads((self._earlier / LIST).read_text(encoding="utf-8"))
            self._known = known if isinstance(known, dict) else {}
        except (OSError, ValueError):
            self._known = {}

    def part(self, name: str, inputs: Any, compute: Callable[[], Mapping[str, xr.Dataset]]) -> dict[str, xr.Dataset]:
        """Datasets of one part by their names, read if that part is known and unchanged, computed otherwise.

        Parameters
        ----------
        name : str
            Name of the part; letters, digits, `-` and `_`.
        inputs : Any
            See `key_of`.
        compute : callable
            Gives the datasets.
        """
        key = key_of([name, inputs])
        stored = self._read(name, key)
        if stored is not None:
            self.reused.append(name)
        else:
            computed = dict(compute())
            # In memory first: the HDF5 library may bring the whole process down when the disk is full.
            stored = [(title, data.to_netcdf(engine="h5netcdf"), data) for title, data in computed.items()]
        files = []
        for number, (title, content, _) in enumerate(stored):
            file = f"{name}-{number}.nc"
            (self._folder / file).write_bytes(content)
            files.append({"name": title, "file": file, "sha256": hashlib.sha256(content).hexdigest()})
        self._entries[name] = {"key": key, "files": files}
        (self._folder / LIST).write_text(json.dumps(self._entries, indent=1, ensure_ascii=False), encoding="utf-8")
        return {title: data for title, _, data in stored}

    def _read(self, name: str, key: str) -> list[tuple[str, bytes, xr.Dataset]] | None:
        """Name, bytes and content of every file of a part; None if anything is not as it was written."""
        entry = self._known.get(name)
        if not isinstance(entry, dict) or entry.get("key") != key:
            return None
        stored = []
        try:
            for number, one in enumerate(entry["files"]):
                # The name of the file follows from the part: a list that was tampered with leads nowhere else.
                content = (self._earlier / f"{name}-{number}.nc").read_bytes()
                if hashlib.sha256(content).hexdigest() != one["sha256"]:
                    return None
                stored.append((str(one["name"]), content, _open(content)))
        except (OSError, KeyError, TypeError, ValueError):
            return None
        return stored


def _open(content: bytes) -> xr.Dataset:
    import io

    import xarray as xr

    # Units of seconds are units, not times of day.
    return xr.load_dataset(io.BytesIO(content), engine="h5netcdf", decode_times=False)
