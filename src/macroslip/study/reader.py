"""All results of a study as one labelled dataset that reads values when they are accessed."""

from __future__ import annotations

import functools
import json
import uuid
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from xarray.backends import BackendArray

# xarray documents these names for arrays of a back end ("How to add a new backend"), in spite of
# the module's name; nothing else gives a variable that is read when it is accessed.
from xarray.core import indexing

from macroslip.storage.files import DATABASE, MANIFEST, reading
from macroslip.study.database import DAMAGED, Outcome, read_runs
from macroslip.study.result_files import read_result
from macroslip.study.store import REMEDY, read_manifest
from macroslip.study.summary import CASE_VARIABLES, ROW_VARIABLES, rows_with_numbers
from macroslip.variables import described

#: Dimensions along which results differ in length; shorter ones end in NaN. Times differ, so
#: samples are counted.
_RAGGED = {"orbit": "orbit", "time": "sample"}


def is_study(path: Path) -> bool:
    """True if a path is the folder of a study."""
    return (path / MANIFEST).is_file()


def open_study(directory: str | PathLike[str]) -> xr.Dataset:
    """Open all results of a study, also while it is being computed.

    Labels and summary are read at once. Everything else is read, and its checksum compared, when
    its values are accessed; select cases first, or `.chunk({"case": 50})` with dask, where all
    together would not fit into memory.

    Parameters
    ----------
    directory : path
        Folder that `macroslip study` or `run_study` has written.

    Returns
    -------
    xarray.Dataset
        Over `case`, one a run of the study in its order, and the dimensions of the results of
        `simulate`. Coordinates over `case`: `run`, `loads`, the fields of the loads, `bearing`,
        `lubricant`, `model`, the parameters that vary under their keys, `outcome`, `reason` and
        `key`. Variables: the summary of `macroslip.study.summary`, over case and row, and the
        variables of `simulate`, all of them as floats. Missing values are NaN: a run that failed or
        is missing, orbits and rollers that others have more of. Traces are over `sample`, with
        `time` over (case, sample).

    Raises
    ------
    InputError
        If the folder holds no study, or a damaged one; and when values are accessed, if a stored
        result is gone or damaged.
    """
    directory = Path(directory).absolute()
    manifest, runs = _read(directory)
    with reading(directory, REMEDY):
        return _dataset(directory, manifest, runs)


def incomplete_runs(study: xr.Dataset) -> xr.Dataset:
    """Runs that failed, were not computed, or have rollers that failed."""
    is_incomplete = study.outcome.values != str(Outcome.COMPLETED)
    return study.isel(case=np.flatnonzero(is_incomplete))


def _dataset(directory: Path, manifest: Mapping[str, Any], runs: pd.DataFrame) -> xr.Dataset:
    labels = {"run": ("1", "name of the run")} | manifest["labels"]
    labels |= {name: ("1", f"{name} of the run") for name in ("outcome", "reason", "key")}
    coordinates = {}
    for name, about in labels.items():
        coordinates[name] = ("case", _column(runs, name), described(*about))
    rows = rows_with_numbers(runs)
    summary = {}
    for name, variable in ROW_VARIABLES.items():
        of_rows = [_column(runs, f"{name}_{row}") for row in rows]
        summary[name] = variable.of(np.stack(of_rows, axis=1))
    for name, variable in CASE_VARIABLES.items():
        summary[name] = variable.of(_column(runs, name))
    variables, more, attributes = _of_results(directory, runs)
    number = ("case", np.arange(len(runs)), described("1", "number of the run in its study"))
    of_study = {
        "title": manifest["title"],
        "source": manifest["source"],
        **attributes,
        "study": json.dumps(manifest["study"], ensure_ascii=False),
    }
    return xr.Dataset(
        summary | variables,
        {"case": number, "row": list(rows)} | coordinates | more,
        of_study,
    )


def stored_results(directory: str | PathLike[str]) -> Iterator[tuple[int, xr.Dataset]]:
    """Yield the stored results of a study one by one, whole and with their attributes.

    Raises InputError if the folder holds no study, or a stored result is gone or damaged. Each
    comes with the number of its run, the `case` of `open_study`; runs without a result are left
    out. `directory` is a folder that `macroslip study` or `run_study` has written.
    """
    directory = Path(directory).absolute()
    _, runs = _read(directory)
    for number, (key, detail) in enumerate(zip(runs["key"], runs["detail"], strict=True)):
        if detail:
            yield number, read_result(directory, key, detail)


def _read(directory: Path) -> tuple[dict[str, Any], pd.DataFrame]:
    with reading(directory, REMEDY):
        manifest, _ = read_manifest(directory)
    with reading(directory / DATABASE, DAMAGED):
        return manifest, read_runs(directory)


def _column(runs: pd.DataFrame, name: str) -> np.ndarray:
    """A column of all runs: numbers as they are, with NaN where there is none.

    Anything else as text, empty for none.
    """
    if name not in runs:
        return np.full(len(runs), "", dtype=object)
    column = runs[name]
    if column.dtype.kind in "iufb":
        return column.to_numpy()
    known = column.where(column.notna(), "")
    codes, texts = pd.factorize(known.astype(str))  # equal texts are one object
    return np.asarray(texts, dtype=object)[codes]


def _of_results(
    directory: Path, runs: pd.DataFrame
) -> tuple[dict[str, Any], dict[str, Any], dict[str, Any]]:
    """Variables, coordinates and attributes of the results, opened as far as listing needs."""
    keys = _column(runs, "key")
    checksums = _column(runs, "detail")
    kinds, texts = pd.factorize(np.where(checksums != "", _column(runs, "layout"), np.array(None)))
    if not len(texts):
        return {}, {}, {}
    layouts = [json.loads(text) for text in texts]
    # The last result of each kind shows what variables there are.
    last = {
        layout["variables"]: np.flatnonzero(kinds == kind)[-1]
        for kind, layout in enumerate(layouts)
    }
    examples = [read_result(directory, keys[number], checksums[number]) for number in last.values()]
    numbers = [tuple(layout.get("rollers", range(layout["sizes"]["roller"]))) for layout in layouts]
    rollers = tuple(sorted(set().union(*numbers)))
    sizes = {
        name: max(layout["sizes"].get(name, 0) for layout in layouts)
        for name in set().union(*(layout["sizes"] for layout in layouts))
    }
    sizes["roller"] = len(rollers)
    shared = _Shared(uuid.uuid4().hex, directory, keys, checksums, numbers, kinds, rollers, sizes)
    variables = {}
    coordinates = {}
    for name, variable in {
        name: variable for example in examples for name, variable in example.variables.items()
    }.items():
        if (name,) == variable.dims and name not in _RAGGED:  # the same in all results
            if name != "roller":
                coordinates[name] = (name, variable.values, variable.attrs)
            continue
        if name == "orbit" or variable.dtype.kind not in "iufb":
            continue
        lazy = indexing.LazilyIndexedArray(_Stacked(shared, str(name), variable.dims))
        dims = ("case", *(_RAGGED.get(str(dim), str(dim)) for dim in variable.dims))
        is_coordinate = any(name in example.coords for example in examples)
        (coordinates if is_coordinate else variables)[name] = xr.Variable(
            dims, lazy, variable.attrs
        )
    example = examples[0]
    coordinates["roller"] = ("roller", np.array(rollers), example.roller.attrs)
    coordinates["orbit"] = ("orbit", np.arange(sizes["orbit"]), example.orbit.attrs)
    attributes = {
        name: example.attrs[name] for name in ("citations", "model") if name in example.attrs
    }
    return variables, coordinates, attributes


@dataclass(frozen=True)
class _Shared:
    opened: str
    directory: Path
    keys: np.ndarray
    checksums: np.ndarray
    layouts: list[tuple[int, ...]]  # numbers of the rollers
    kinds: np.ndarray  # which of the layouts a run has, -1 without a result
    rollers: tuple[int, ...]
    sizes: Mapping[str, int]


class _Stacked(BackendArray):
    """One variable of all results, with the cases as first dimension.

    A result is read when a value of it is accessed.
    """

    def __init__(self, shared: _Shared, name: str, dims: tuple[str, ...]):
        self._shared = shared
        self._name = name
        self._dims = dims
        self.shape = (len(shared.keys), *(shared.sizes[dim] for dim in dims))
        self.dtype = np.dtype(float)

    def __getitem__(self, key: indexing.ExplicitIndexer) -> Any:
        return indexing.explicit_indexing_adapter(
            key, self.shape, indexing.IndexingSupport.OUTER, self._values
        )

    def _values(self, key: tuple[Any, ...]) -> np.ndarray:
        numbers = np.arange(self.shape[0])[key[0]]
        inner = key[1:]
        wholes = (self._whole(int(number)) for number in np.atleast_1d(numbers))
        parts = [_cut(whole, inner) for whole in wholes]
        if not parts:
            nothing = _cut(np.empty(self.shape[1:]), inner)
            return nothing[None][:0]
        return np.stack(parts) if np.ndim(numbers) else parts[0]

    def _whole(self, number: int) -> np.ndarray:
        whole = np.full(self.shape[1:], np.nan)
        shared = self._shared
        if shared.kinds[number] < 0:
            return whole
        kind = shared.kinds[number]
        rollers = shared.layouts[kind]
        key = shared.keys[number]
        result = _result(shared.opened, shared.directory, key, shared.checksums[number])
        variables = result.variables
        if self._name in variables:
            values = variables[self._name].transpose(*self._dims).values
            indices = [np.arange(size) for size in values.shape]
            if "roller" in self._dims:
                axis = self._dims.index("roller")
                indices[axis] = np.searchsorted(shared.rollers, rollers)
            whole[np.ix_(*indices)] = values
        return whole


def _cut(whole: np.ndarray, inner: tuple[Any, ...]) -> np.ndarray:
    # From the last, as a number takes its axis away.
    for axis, index in reversed(list(enumerate(inner))):
        axes_before = (slice(None),) * axis
        whole = whole[(*axes_before, index)]
    return whole


@functools.lru_cache(maxsize=8)
def _result(opened: str, directory: Path, key: str, checksum: str) -> xr.Dataset:
    """A result, the last few of which are kept in memory.

    Several variables of a case are often read in turn.
    """
    return read_result(directory, key, checksum)
