"""The database of a study: its runs, and of each result the checksum of its file and a summary.

A result counts once the database has its row. SQLite writes to a log first (WAL) and flushes it at
every commit, so a row is whole or absent whatever ends the process. It does not notice a value that
was changed on the disk; a checksum in each row does.
"""

from __future__ import annotations

import contextlib
import io
import json
import math
import os
import sqlite3
import struct
import zlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from enum import StrEnum
from pathlib import Path
from typing import Any

import pandas as pd

from macroslip.bearing.geometry import AXIAL_SIGNS
from macroslip.errors import InputError, MacroslipError
from macroslip.storage.files import DATABASE, SUMMARY, write_durably
from macroslip.study.store import REMEDY, other_version
from macroslip.study.summary import NUMBERS, ROW_VARIABLES, rows_with_numbers

#: Advice for a damaged database, one that is missing, and one without runs.
DAMAGED = (
    "Put back a copy of it, or remove it and go on with --resume: then all runs are computed again."
)
_GONE = "Put back a copy of it, or go on with --resume: then all runs are computed again."
_NO_RUNS = "Begin it again with macroslip study STUDY.yaml -o DIR --resume."
#: Columns of a run that is not done, and their values then.
TEXTS = {"outcome": "missing", "reason": "", "key": "", "detail": "", "layout": ""}
_TEXT_COLUMNS = ("key", "outcome", "reason", "detail", "layout")
_COLUMNS = [*_TEXT_COLUMNS, *NUMBERS, "crc"]
#: Rows that are read together.
_BATCH = 20_000

_CREATE_RUNS = (
    'CREATE TABLE {} ("case" INTEGER PRIMARY KEY, run TEXT UNIQUE, labels TEXT, crc INTEGER, '
    "key TEXT, outcome TEXT, reason TEXT)"
)
_CREATE_RESULTS = (
    "CREATE TABLE IF NOT EXISTS results (key TEXT PRIMARY KEY, outcome TEXT, reason TEXT, detail TEXT, "
    f"layout TEXT, {', '.join(f'{name} REAL' for name in NUMBERS)}, crc INTEGER)"
)
_INSERT_RESULT = f"INSERT OR REPLACE INTO results VALUES ({', '.join('?' * len(_COLUMNS))})"
_TAKE_OVER = (
    "UPDATE runs SET (key, outcome, reason) = (earlier.key, earlier.outcome, earlier.reason) "
    "FROM earlier WHERE earlier.run = runs.run"
)
_SELECT_RUNS = (
    "SELECT run, labels, runs.crc, runs.key, runs.outcome, runs.reason, results.* FROM runs "
    'LEFT JOIN results ON results.key = runs.key AND runs.outcome IS NULL ORDER BY "case"'
)


class Outcome(StrEnum):
    """State of one run."""

    COMPLETED = "completed"  #: Computed and stored
    #: Computed and stored, but the integration of some rollers failed
    ROLLERS_FAILED = "rollers failed"
    FAILED = "failed"  #: Not computed, for the reason given; tried again by every --resume
    MISSING = "missing"  #: Not computed yet

    @property
    def stored(self) -> bool:
        """True if there is a result."""
        return self in (Outcome.COMPLETED, Outcome.ROLLERS_FAILED)


class Database:
    """The runs of a study and their results, open for writing by the process that holds the lock.

    Methods raise sqlite3.OperationalError if the system refuses to write, and another
    sqlite3.DatabaseError if the database is damaged, as `damaged_database` reports it. InputError if
    another version of the program wrote it.
    """

    def __init__(self, directory: Path):
        self._path = directory / DATABASE
        self._db = sqlite3.connect(self._path, isolation_level=None)
        self._db.text_factory = _decoded
        try:
            self._db.execute("PRAGMA journal_mode = WAL")
            self._db.execute("PRAGMA synchronous = FULL")
            self._db.execute("PRAGMA cache_size = -65536")
            with self._transaction():
                self._db.execute(_CREATE_RESULTS)
            _check_columns(self._db, directory)
            self._file = self._path.stat()
        except (sqlite3.DatabaseError, InputError):
            self.close()
            raise

    @contextmanager
    def _transaction(self) -> Iterator[None]:
        with self._db:
            self._db.execute("BEGIN IMMEDIATE")
            yield

    def check_there(self) -> None:
        """Stop if the file was removed or replaced, since what is written would be lost.

        Raises MacroslipError.
        """
        try:
            same = os.path.samestat(self._path.stat(), self._file)
        except OSError:
            same = False
        if not same:
            fault = "the database was removed or replaced while the study ran"
            raise MacroslipError(f"{self._path}: {fault}. {_GONE}")

    def close(self) -> None:
        """Close the file; without a log beside it, it can be read where nothing can be written."""
        # If somebody reads, or the disk is full, the log stays and is read too.
        with contextlib.suppress(sqlite3.Error):
            self._db.execute("PRAGMA journal_mode = DELETE")
        with contextlib.suppress(sqlite3.Error):
            self._db.close()

    def begin(self, runs: Iterable[tuple[str, Mapping[str, Any]]]) -> int:
        """Replace the list of runs, each with its name and labels.

        Outcomes of runs that stay are kept. Rows of results that were damaged are removed; gives
        their number.
        """
        texts = ((run, json.dumps(labels, ensure_ascii=False)) for run, labels in runs)
        with self._transaction():
            self._db.execute(_CREATE_RUNS.format("IF NOT EXISTS runs"))
            self._db.execute("ALTER TABLE runs RENAME TO earlier")
            self._db.execute(_CREATE_RUNS.format("runs"))
            rows = ((case, *pair, _crc(pair)) for case, pair in enumerate(texts))
            insert = 'INSERT INTO runs ("case", run, labels, crc) VALUES (?, ?, ?, ?)'
            self._db.executemany(insert, rows)
            self._db.execute(_TAKE_OVER)
            self._db.execute("DROP TABLE earlier")
            rows = self._db.execute("SELECT rowid, * FROM results")
            damaged = [(number,) for number, *row in rows if not _is_sound(row)]
            self._db.executemany("DELETE FROM results WHERE rowid = ?", damaged)
        return len(damaged)

    def results(self) -> int:
        """Number of results."""
        return self._db.execute("SELECT count(*) FROM results").fetchone()[0]

    def checksum(self, key: str) -> str | None:
        """Checksum of a result; None if it is not recorded."""
        return self._text("SELECT detail FROM results WHERE key = ?", key)

    def key(self, run: str) -> str | None:
        """Key of the latest result of a run; None without one."""
        return self._text("SELECT key FROM runs WHERE run = ? AND outcome IS NULL", run)

    def _text(self, query: str, name: str) -> str | None:
        row = self._db.execute(query, (name,)).fetchone()
        return row[0] if row else None

    def record(self, entries: Iterable[Mapping[str, Any]]) -> None:
        """Record the outcomes of runs in one transaction: when this returns they are on the disk.

        Entries are as from `macroslip.study.work.work`; without `outcome` a run has the result of
        its key, which is there. If the system refuses, none of them is recorded, and sqlite3.Error
        is raised; MacroslipError if the file is gone.
        """
        self.check_there()
        update = "UPDATE runs SET key = ?, outcome = ?, reason = ? WHERE run = ?"
        with self._transaction():
            for entry in entries:
                if "detail" in entry and "outcome" in entry:
                    self._db.execute(_INSERT_RESULT, _row(entry))
                outcome = None
                reason = None
                if entry.get("outcome") == Outcome.FAILED:
                    outcome = entry["outcome"]
                    reason = entry.get("reason")
                self._db.execute(update, (entry.get("key"), outcome, reason, entry["run"]))


def damaged_database(directory: Path, error: sqlite3.DatabaseError) -> InputError:
    """Error for a damaged database."""
    return InputError(
        f"the database is damaged ({error})", where=str(directory / DATABASE), remedy=DAMAGED
    )


def _check_columns(db: sqlite3.Connection, directory: Path) -> None:
    """InputError for a table of results with other columns, of a program with other numbers."""
    columns = [row[1] for row in db.execute("PRAGMA table_info(results)")]
    if columns != _COLUMNS:
        raise other_version(directory, "with other numbers")


def _row(entry: Mapping[str, Any]) -> tuple[Any, ...]:
    """Row of the table of results."""
    texts = [str(entry[name]) for name in _TEXT_COLUMNS]
    # Adding nothing makes a negative zero positive, as the database keeps it.
    values = entry["values"]
    numbers = [float(values[name]) + 0.0 for name in NUMBERS]
    written = (None if math.isnan(number) else number for number in numbers)
    return (*texts, *written, _crc(texts, numbers))


def _decoded(content: bytes) -> str:
    """A text of the database, decoded; a damaged one differs, which its checksum shows."""
    return content.decode(errors="replace")


def _crc(texts: Sequence[str], numbers: Sequence[float] = ()) -> int:
    """Checksum of a row, which detects changes on the disk."""
    packed = struct.pack(f"<{len(numbers)}d", *numbers)
    content = "\0".join(texts).encode()
    return zlib.crc32(content + packed)


def _is_sound(row: Sequence[Any]) -> bool:
    """True if a row of results is as it was recorded."""
    *entries, checksum = row
    count = len(_TEXT_COLUMNS)
    texts = entries[:count]
    numbers = [math.nan if number is None else number for number in entries[count:]]
    try:
        return _crc(texts, numbers) == checksum
    except (TypeError, struct.error):  # a text in place of a number, or the other way round
        return False


def read_runs(directory: Path) -> pd.DataFrame:
    """The recorded runs of a study in their order, while others may be recorded.

    The columns are `run`, the labels, the texts of `TEXTS` and the numbers of the summary, NaN
    where there is none. A row that was changed on the disk counts as not done. Raises InputError if
    the list of runs was changed on the disk, or there is no database.
    """
    path = directory / DATABASE
    if not path.exists():
        raise InputError("the database is not there", where=str(path), remedy=_GONE)
    frames = []
    address = f"{path.absolute().as_uri()}?mode=ro"
    with closing(sqlite3.connect(address, uri=True)) as db:
        db.text_factory = _decoded
        _check_columns(db, directory)
        if not list(db.execute("SELECT 1 FROM sqlite_schema WHERE name = 'runs'")):
            raise InputError("the study has no runs yet", where=str(directory), remedy=_NO_RUNS)
        cursor = db.execute(_SELECT_RUNS)
        for rows in iter(lambda: cursor.fetchmany(_BATCH), []):
            if any(_crc(row[:2]) != row[2] for row in rows):
                raise InputError("the list of runs is damaged", where=str(path), remedy=REMEDY)
            records = [{"run": run, **json.loads(texts)} for run, texts, *_ in rows]
            labels = pd.DataFrame(records)
            lines = [_line(row) for row in rows]
            summary = pd.DataFrame(lines, columns=[*TEXTS, *NUMBERS])
            summary = summary.astype(dict.fromkeys(NUMBERS, float))
            together = pd.concat([labels, summary], axis=1)
            frames.append(together)
    if not frames:
        raise InputError("its list of runs is empty", where=str(path), remedy=_NO_RUNS)
    return pd.concat(frames, ignore_index=True)


def _line(row: tuple[Any, ...]) -> tuple[Any, ...]:
    """Texts and numbers of a run, of its row in the list of runs and that of its result."""
    key, outcome, reason, *result = row[3:]
    nothing = [None] * len(NUMBERS)
    if outcome is not None:
        return (outcome, reason, key or "", "", "", *nothing)
    if result[0] is None:
        return (*TEXTS.values(), *nothing)
    if not _is_sound(result):
        texts = TEXTS | {"reason": "its row in the database is damaged"}
        return (*texts.values(), *nothing)
    key, outcome, reason, detail, layout, *numbers, _ = result
    return (outcome, reason, key, detail, layout, *numbers)


def write_summary(directory: Path, units: dict[str, str]) -> None:
    """Write `summary.parquet`: each run with its labels, outcome and numbers, units by column."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    runs = read_runs(directory)
    rows = rows_with_numbers(runs)
    absent = [row for row in AXIAL_SIGNS if row not in rows]
    without_rows = [f"{name}_{row}" for name in ROW_VARIABLES for row in absent]
    runs = runs.drop(columns=without_rows)
    for name, column in runs.items():
        # Words beside numbers make all of a column text.
        is_text = column.map(lambda value: isinstance(value, str))
        if is_text.any():
            runs[name] = column.map(str, na_action="ignore")
    table = pa.Table.from_pandas(runs, preserve_index=False)
    units = units | NUMBERS
    fields = []
    for field in table.schema:
        unit = units.get(field.name, "1")
        fields.append(field.with_metadata({"units": unit}))
    table = table.cast(pa.schema(fields))
    buffer = io.BytesIO()
    pq.write_table(table, buffer, compression="zstd", write_page_checksum=True)
    write_durably(directory / SUMMARY, buffer.getvalue())
