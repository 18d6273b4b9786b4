"""Tables in Parquet: the runs of a study, and the summary of their results."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from macroslip.bearing.geometry import ROWS
from macroslip.files import flush, flush_folder, unfinished
from macroslip.study.journal import records
from macroslip.study.outcome import Outcome
from macroslip.study.recorded import STATE, TEXTS, journal_state, of_journal
from macroslip.study.store import JOURNAL, RUNS, SUMMARY
from macroslip.study.study import TEMPERATURE, Study
from macroslip.study.summary import CASE_VARIABLES, ROW_VARIABLES

if TYPE_CHECKING:
    import pyarrow as pa

_BATCH = 5000
#: Runs that lie together in a table; 50 numbers of each make some 40 MB.
_ROW_GROUP = 100_000


def write_runs(directory: Path, study: Study) -> None:
    """Write `runs.parquet`: one line a run, with its name and labels; a label that a run lacks is empty."""
    import pyarrow as pa

    names = list(study.labels)
    kinds = _kinds(study)

    def line(run: Any) -> dict[str, Any]:
        labels = run.labels
        return {"run": run.name} | {name: _as(kinds[name], labels.get(name)) for name in names}

    schema = _schema({"run": str} | kinds, {name: units for name, (units, _) in study.labels.items()})
    batches = _batched((line(run) for run in study.runs()), _BATCH)
    _write(directory / RUNS, schema, (pa.Table.from_pylist(list(batch), schema=schema) for batch in batches))


def write_summary(directory: Path, study: Study) -> None:
    """Write `summary.parquet`: `runs.parquet` with how each run ended and its numbers, `_downwind` and `_upwind`."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    state = journal_state(directory / JOURNAL)
    runs = pq.read_table(directory / RUNS)
    found = of_journal(directory / JOURNAL, runs["run"].to_pylist())
    numbers = {f"{name}_{row}": units for name, (units, _) in ROW_VARIABLES.items() for row in ROWS}
    numbers |= {name: units for name, (units, _) in CASE_VARIABLES.items()}
    schema = _schema(dict.fromkeys(TEXTS, str) | dict.fromkeys(numbers, float), numbers)
    # What a run does not have is empty in the table, NaN in a dataset.
    columns = {**found.texts, **found.numbers}
    arrays = [pa.array(columns[field.name], field.type, from_pandas=True) for field in schema]
    schema = pa.schema([*runs.schema, *schema], metadata={STATE: state})
    _write(directory / SUMMARY, schema, [pa.table([*runs.columns, *arrays], schema=schema)])


class Latest:
    """The latest result of every run in a journal.

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
        self.damaged = 0
        self.stored: dict[bytes, bytes] = {}
        self.keys: dict[bytes, bytes] = {}
        for record in records(directory / JOURNAL):
            if record is None:
                self.damaged += 1
            else:
                self.learn(record)

    def learn(self, record: dict[str, Any]) -> None:
        """Add a record."""
        run, key = bytes.fromhex(record["run"]), bytes.fromhex(record.get("key", ""))
        if "outcome" in record and not Outcome(record["outcome"]).stored:
            self.keys.pop(run, None)
            return
        if "detail" in record:
            self.stored[key] = bytes.fromhex(record["detail"])
        # Otherwise the record gives this run the result of another one.
        self.keys[run] = key


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


def _write(path: Path, schema: pa.Schema, tables: Iterable[pa.Table]) -> None:
    """Write a table piece by piece; it takes its name when it is whole and on the disk."""
    import pyarrow.parquet as pq

    temporary = unfinished(path)
    try:
        with temporary.open("wb") as file:
            with pq.ParquetWriter(file, schema, compression="zstd", write_page_checksum=True) as writer:
                for table in tables:
                    writer.write_table(table, row_group_size=_ROW_GROUP)
            file.flush()
            flush(file.fileno())
        temporary.replace(path)
        flush_folder(path.parent)
    finally:
        temporary.unlink(missing_ok=True)
