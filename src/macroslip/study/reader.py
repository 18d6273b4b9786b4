"""All results of a study as one labelled dataset that reads values when they are accessed."""

from __future__ import annotations

import functools
import json
import uuid
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from xarray.backends import BackendArray
from xarray.core import indexing  # the documented interface for arrays of a backend, in spite of its name

from macroslip.bearing.geometry import ROWS
from macroslip.files import reading
from macroslip.study.recorded import Recorded, recorded, texts
from macroslip.study.store import REMEDY, RUNS, read_manifest, read_result
from macroslip.study.summary import CASE_VARIABLES, ROW_VARIABLES

if TYPE_CHECKING:
    import xarray as xr

#: Dimensions along which results differ in length; shorter ones end in NaN. Times differ, so samples are counted.
_RAGGED = {"orbit": "orbit", "time": "sample"}
_LABELLED = ("roller",)


def open_study(directory: str | PathLike[str]) -> xr.Dataset:
    """Open all results of a study, also while it is being computed.

    Labels and summary are read at once. Everything else is read, and its checksum compared, when its values are
    accessed; select cases first, or `.chunk({"case": 50})` with dask, where all together would not fit into memory.

    Parameters
    ----------
    directory : path
        Folder that `macroslip study` or `run_study` has written.

    Returns
    -------
    xarray.Dataset
        Over `case`, one a run of the study in its order, and the dimensions of the results of `simulate`. Coordinates
        over `case`: `run`, `loads`, the fields of the loads, `bearing`, `lubricant`, `model`, the parameters that vary
        under their keys, `outcome`, `reason` and `key`. Variables: the summary of `macroslip.study.summary`, over
        case and row, and the variables of `simulate`, all of them as floats. What a run does not have is NaN: a run
        that failed or is missing, orbits and rollers that others have more of. Traces are over `sample`, with `time`
        over (case, sample).

    Raises
    ------
    InputError
        If the folder holds no study; and when values are accessed, if a stored result is gone or damaged.
    """
    directory = Path(directory).absolute()
    with reading(directory, REMEDY):
        return _opened(directory)


def _opened(directory: Path) -> xr.Dataset:
    import pyarrow.parquet as pq
    import xarray as xr

    manifest, _ = read_manifest(directory)
    runs = pq.read_table(directory / RUNS, page_checksum_verification=True)
    names = runs["run"].to_pylist()
    found = recorded(directory, names)
    coordinates: dict[str, Any] = {"run": ("case", np.array(names, dtype=object), _about("1", "name of the run"))}
    for name, (units, meaning) in manifest["labels"].items():
        coordinates[name] = ("case", _column(runs[name]), _about(units, meaning))
    for name in ("outcome", "reason", "key"):
        coordinates[name] = ("case", found.texts[name], _about("1", f"{name} of the run"))
    details, more, attributes = _details(directory, found)
    return xr.Dataset(
        _summary(found) | details,
        {"case": ("case", np.arange(len(names)), _about("1", "number of the run in its study")), "row": list(ROWS)}
        | coordinates
        | more,
        {
            "title": manifest["title"],
            "source": manifest["source"],
            **attributes,
            "study": json.dumps(manifest["study"], ensure_ascii=False),
        },
    )


def stored_results(directory: str | PathLike[str]) -> Iterator[tuple[int, xr.Dataset]]:
    """Yield the stored results of a study one by one, whole and with their attributes.

    Parameters
    ----------
    directory : path
        Folder that `macroslip study` or `run_study` has written.

    Yields
    ------
    (int, xarray.Dataset)
        Number of the run, the `case` of `open_study`, and its result; runs without a result are left out.

    Raises
    ------
    InputError
        If the folder holds no study, or a stored result is gone or damaged.
    """
    import pyarrow.parquet as pq

    directory = Path(directory).absolute()
    with reading(directory, REMEDY):
        read_manifest(directory)
        runs = pq.read_table(directory / RUNS, columns=["run"])["run"].to_pylist()
    found = recorded(directory, runs)
    for number in np.flatnonzero(found.stored):
        yield int(number), read_result(directory, found.texts["key"][number], found.texts["detail"][number])


def _about(units: str, long_name: str) -> dict[str, str]:
    return {"units": units, "long_name": long_name}


def _column(column: Any) -> np.ndarray:
    """A label of all runs: text as objects, numbers as they are, with NaN where there is none."""
    import pyarrow as pa

    if pa.types.is_boolean(column.type) and column.null_count:
        return np.array(["" if value is None else str(value) for value in column.to_pylist()], dtype=object)
    return texts(column) if pa.types.is_string(column.type) else column.to_numpy()


def _summary(found: Recorded) -> dict[str, Any]:
    return {
        name: (
            ("case", "row"),
            np.stack([found.numbers[f"{name}_{row}"] for row in ROWS], axis=1),
            _about(*about),
        )
        for name, about in ROW_VARIABLES.items()
    } | {name: ("case", found.numbers[name], _about(*about)) for name, about in CASE_VARIABLES.items()}


def _details(directory: Path, found: Recorded) -> tuple[dict[str, Any], dict[str, Any], dict[str, Any]]:
    """Variables, coordinates and attributes of the results, opened as far as is needed to list them."""
    import xarray as xr

    if not found.stored.any():
        return {}, {}, {}
    layouts, kinds = found.layouts()
    keys, checksums = found.texts["key"], found.texts["detail"]
    # The last result of each kind shows what variables there are.
    last = {one["variables"]: np.flatnonzero(kinds == kind)[-1] for kind, one in enumerate(layouts)}
    examples = [read_result(directory, keys[number], checksums[number]) for number in last.values()]
    numbers = [_rollers(one) for one in layouts]
    rollers = tuple(sorted(set().union(*numbers)))
    sizes: dict[str, int] = {}
    for layout in layouts:
        for name, size in layout["sizes"].items():
            sizes[name] = max(size, sizes.get(name, 0))
    sizes["roller"] = len(rollers)
    shared = _Shared(uuid.uuid4().hex, directory, keys, checksums, numbers, kinds, rollers, sizes)
    variables, coordinates = {}, {}
    for name, one in {name: one for example in examples for name, one in example.variables.items()}.items():
        is_coordinate = any(name in example.coords for example in examples)
        if (name,) == one.dims and name not in _RAGGED:  # the same in all results
            if name != "roller":
                coordinates[name] = (name, one.values, one.attrs)
            continue
        if name == "orbit" or one.dtype.kind not in "iufb":
            continue
        lazy = indexing.LazilyIndexedArray(_Stacked(shared, str(name), one.dims))
        dims = ("case", *(_RAGGED.get(str(dim), str(dim)) for dim in one.dims))
        (coordinates if is_coordinate else variables)[name] = xr.Variable(dims, lazy, one.attrs)
    example = examples[0]
    coordinates["roller"] = ("roller", np.array(rollers), example.roller.attrs)
    coordinates["orbit"] = ("orbit", np.arange(sizes["orbit"]), example.orbit.attrs)
    return variables, coordinates, {name: example.attrs[name] for name in ("citations",) if name in example.attrs}


def _rollers(layout: Mapping[str, Any]) -> tuple[int, ...]:
    return tuple(layout["rollers"]) if "rollers" in layout else tuple(range(layout["sizes"]["roller"]))


@dataclass(frozen=True)
class _Shared:
    """What all variables of a study have in common."""

    opened: str
    directory: Path
    keys: np.ndarray
    checksums: np.ndarray
    layouts: list[tuple[int, ...]]  # numbers of the rollers
    kinds: np.ndarray  # which of the layouts a run has, -1 without a result
    rollers: tuple[int, ...]
    sizes: Mapping[str, int]


class _Stacked(BackendArray):
    """One variable of all results, with the cases as first dimension; a result is read when a value of it is accessed."""

    def __init__(self, shared: _Shared, name: str, dims: tuple[str, ...]):
        self._shared, self._name, self._dims = shared, name, dims
        self.shape = (len(shared.keys), *(shared.sizes[dim] for dim in dims))
        self.dtype = np.dtype(float)

    def __getitem__(self, key: indexing.ExplicitIndexer) -> Any:
        return indexing.explicit_indexing_adapter(key, self.shape, indexing.IndexingSupport.OUTER, self._values)

    def _values(self, key: tuple[Any, ...]) -> np.ndarray:
        first, inner = key[0], key[1:]
        chosen = np.arange(self.shape[0])[first]
        if np.ndim(chosen) == 0:
            return self._part(int(chosen), inner)
        parts = [self._part(int(number), inner) for number in chosen]
        return np.stack(parts) if parts else np.empty((0, *self._part_shape(inner)))

    def _part(self, number: int, inner: tuple[Any, ...]) -> np.ndarray:
        whole = np.full(self.shape[1:], np.nan)
        shared = self._shared
        if shared.kinds[number] >= 0:
            rollers = shared.layouts[shared.kinds[number]]
            variables = _read(shared.opened, shared.directory, shared.keys[number], shared.checksums[number]).variables
            if self._name in variables:
                values = variables[self._name].transpose(*self._dims).values
                places = [
                    np.searchsorted(shared.rollers, rollers) if dim in _LABELLED else np.arange(size)
                    for dim, size in zip(self._dims, values.shape, strict=True)
                ]
                whole[np.ix_(*places)] = values
        for axis, one in enumerate(reversed(inner), start=1):  # from the last, as a number takes its axis away
            whole = whole[(slice(None),) * (len(inner) - axis) + (one,)]
        return whole

    def _part_shape(self, inner: tuple[Any, ...]) -> tuple[int, ...]:
        sizes = (np.shape(np.arange(size)[one]) for size, one in zip(self.shape[1:], inner, strict=True))
        return tuple(size for shape in sizes for size in shape)


@functools.lru_cache(maxsize=8)
def _read(opened: str, directory: Path, key: str, checksum: str) -> xr.Dataset:
    """A result; the last few of an opened study are kept: several variables of a case are often read in turn."""
    return read_result(directory, key, checksum)
