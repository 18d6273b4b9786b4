"""Tables in Parquet: the runs of a study, and the summary of their results."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from macroslip.bearing.frames import ROWS
from macroslip.files import flush, flush_folder, unfinished
from macroslip.study.journal import record_at, records
from macroslip.study.outcome import Outcome
from macroslip.study.store import JOURNAL, RUNS, SUMMARY
from macroslip.study.study import TEMPERATURE, Study
from macroslip.study.summary import CASE_VARIABLES, ROW_VARIABLES

if TYPE_CHECKING:
    import pyarrow as pa

_BATCH = 5000


def write_runs(directory: Path, study: Study) -> None:
    """Write `runs.parquet`: one line a run, with its name and labels; a label that a run lacks is empty."""
    names = list(study.labels)
    kinds = _kinds(study)

    def line(run: Any) -> dict[str, Any]:
        labels = run.labels
        return {"run": run.name} | {name: _as(kinds[name], labels.get(name)) for name in names}

    schema = _schema({"run": str} | kinds, {name: units for name, (units, _) in study.labels.items()})
    _write(directory / RUNS, schema, (line(run) for run in study.runs()))


def write_summary(directory: Path, study: Study) -> None:
    """Write `summary.parquet`: `runs.parquet` with how each run ended and its numbers, `_downwind` and `_upwind`."""
    import pyarrow.parquet as pq

    numbers = {f"{name}_{row}": units for name, (units, _) in ROW_VARIABLES.items() for row in ROWS}
    numbers |= {name: units for name, (units, _) in CASE_VARIABLES.items()}
    units = {name: units for name, (units, _) in study.labels.items()} | numbers
    kinds = {"run": str} | _kinds(study) | {"outcome": str, "reason": str, "key": str, "detail": str}
    schema = _schema(kinds | dict.fromkeys(numbers, float), units)
    latest = Latest(directory)

    def lines() -> Iterator[dict[str, Any]]:
        with pq.ParquetFile(directory / RUNS) as runs:
            for batch in runs.iter_batches(_BATCH):
                rows = batch.to_pylist()
                for row, record in zip(rows, latest.of(row["run"] for row in rows), strict=True):
                    yield row | flat(record)

    _write(directory / SUMMARY, schema, lines())


def flat(record: dict[str, Any] | None) -> dict[str, Any]:
    """What the summary has of a record of the journal; None: the run was not done."""
    if record is None:
        return {"outcome": str(Outcome.MISSING), "reason": "", "key": "", "detail": ""}
    values = record.get("values", {})
    return {
        **{name: record.get(name, "") for name in ("outcome", "reason", "key", "detail")},
        **{
            f"{name}_{row}": value
            for name in ROW_VARIABLES
            if name in values
            for row, value in zip(ROWS, values[name], strict=True)
        },
        **{name: values[name] for name in CASE_VARIABLES if name in values},
    }


class Latest:
    """The latest record of every run in a journal, found by positions so that a million need little memory.

    Parameters
    ----------
    directory : Path
        Of the study.

    Attributes
    ----------
    damaged : int
        Lines that do not match their checksum.
    stored : dict of bytes to bytes
        Checksum of the result by key, of all results that are there for good.
    keys : dict of bytes to bytes
        Key by run, of runs whose latest record is a result.
    """

    def __init__(self, directory: Path):
        self._path = directory / JOURNAL
        self.damaged = 0
        self.stored: dict[bytes, bytes] = {}
        self.keys: dict[bytes, bytes] = {}
        self._results: dict[bytes, int] = {}
        self._failures: dict[bytes, int] = {}
        for position, record in records(self._path):
            if record is None:
                self.damaged += 1
            else:
                self._take(position, record)

    def _take(self, position: int, record: dict[str, Any]) -> None:
        run, key = bytes.fromhex(record["run"]), bytes.fromhex(record.get("key", ""))
        if "outcome" in record and not Outcome(record["outcome"]).stored:
            self._failures[run] = position
            self.keys.pop(run, None)
            return
        if "detail" in record:
            self.stored[key], self._results[key] = bytes.fromhex(record["detail"]), position
        # Otherwise the record says that this run has the result of another one.
        self._failures.pop(run, None)
        self.keys[run] = key

    def learn(self, result: dict[str, Any]) -> None:
        """Take note of a result that has just been recorded."""
        if result.get("detail") and result.get("key"):
            key = bytes.fromhex(result["key"])
            self.stored[key] = bytes.fromhex(result["detail"])
            self.keys[bytes.fromhex(result["run"])] = key

    def of(self, runs: Iterable[str]) -> Iterator[dict[str, Any] | None]:
        """The record of each run, by name; None where there is none."""
        for some in _batched(runs, _BATCH):
            places = [self._place(bytes.fromhex(run)) for run in some]
            wanted = sorted(set(places) - {None})
            found = dict(zip(wanted, record_at(self._path, wanted), strict=True)) if wanted else {}
            yield from (found.get(place) for place in places)

    def _place(self, run: bytes) -> int | None:
        return self._failures[run] if run in self._failures else self._results.get(self.keys.get(run, b""))


def _batched(items: Iterable[Any], size: int) -> Iterator[tuple[Any, ...]]:
    iterator = iter(items)
    while batch := tuple(itertools.islice(iterator, size)):
        yield batch


def _kinds(study: Study) -> dict[str, type]:
    """Type of every label: numbers where all its values are numbers, text otherwise."""
    values: dict[str, set[type]] = {name: set() for name in study.labels}
    for load in study.loads.loads:
        for name, value in load.fields.items():
            values[name].add(type(value))
    for settings in [*study.models.values(), *study.variations]:
        for setting in settings:
            values[setting.key].add(float if type(setting.value) is int else type(setting.value))
    if study.temperatures:
        values[TEMPERATURE].add(float)
    return {name: _common(found) for name, found in values.items()}


def _common(found: set[type]) -> type:
    if found in ({bool}, {int}):
        return found.pop()
    return float if found and found <= {int, float} else str


def _as(kind: type, value: Any) -> Any:
    return None if value is None else (value if isinstance(value, kind) and kind is not str else kind(value))


def _schema(kinds: dict[str, type], units: dict[str, str]) -> pa.Schema:
    import pyarrow as pa

    types = {str: pa.string(), bool: pa.bool_(), int: pa.int64(), float: pa.float64()}
    return pa.schema(
        [pa.field(name, types[kind], metadata={"units": units.get(name, "1")}) for name, kind in kinds.items()]
    )


def _write(path: Path, schema: pa.Schema, rows: Iterator[dict[str, Any]]) -> None:
    """Write a table piece by piece; it takes its name when it is whole and on the disk."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    temporary = unfinished(path)
    try:
        with temporary.open("wb") as file:
            with pq.ParquetWriter(file, schema, compression="zstd") as writer:
                for batch in _batched(rows, _BATCH):
                    writer.write_table(pa.Table.from_pylist(list(batch), schema=schema))
            file.flush()
            flush(file.fileno())
        temporary.replace(path)
        flush_folder(path.parent)
    finally:
        temporary.unlink(missing_ok=True)
