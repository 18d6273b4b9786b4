"""The folder of a study: manifest, database, results, tables, log and lock.

Results lie in `cases/`, each in a netCDF file named by the key of its case. A result counts once
the database has its row with the checksum of its file. SQLite writes to a log first (WAL) and
flushes it at every commit, so a row is whole or absent whatever ends the process.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import itertools
import json
import math
import os
import platform
import sqlite3
import struct
import time
import zlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from enum import StrEnum
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from filelock import FileLock, Timeout

from macroslip.errors import InputError, MacroslipError
from macroslip.storage.files import (
    DATABASE,
    LOCK,
    MANIFEST,
    STUDY_FILES,
    SUMMARY,
    UNFINISHED,
    check_regular,
    write_durably,
)
from macroslip.study.summary import NUMBERS

FORMAT = 4
CASES = "cases"
#: Folder of the runs by which the temperature of a study is found; a study of its own.
BALANCE_RUNS = "balance"
_FILES = (*STUDY_FILES, f"{DATABASE}-wal", f"{DATABASE}-shm")
#: Advice for a damaged manifest or a damaged database.
REMEDY = "Write it again with macroslip study STUDY.yaml -o DIR --resume; results are kept."
DAMAGED = (
    "Put back a copy of it, or remove it and go on with --resume: then all runs are computed again."
)
_GONE = "Put back a copy of it, or go on with --resume: then all runs are computed again."
_NO_RUNS = "Begin it again with macroslip study STUDY.yaml -o DIR --resume."
#: Attribute with the description of variables that have no values.
_EMPTY = "variables_without_values"
#: Columns of a run that is not done, and their values then.
TEXTS = {"outcome": "missing", "reason": "", "key": "", "detail": "", "layout": ""}
_TEXT_COLUMNS = ("key", "outcome", "reason", "detail", "layout")
_COLUMNS = [*_TEXT_COLUMNS, *NUMBERS, "crc"]
_BATCH = 20_000


class Outcome(StrEnum):
    """State of one run."""

    COMPLETED = "completed"  #: Computed and stored
    ROLLERS_FAILED = (
        "rollers failed"  #: Computed and stored, but the integration of some rollers failed
    )
    FAILED = "failed"  #: Not computed, for the reason given; tried again by every --resume
    MISSING = "missing"  #: Not computed yet

    @property
    def stored(self) -> bool:
        """Whether there is a result."""
        return self in (Outcome.COMPLETED, Outcome.ROLLERS_FAILED)


class Database:
    """The runs of a study and their results, open for writing by the process that holds the lock.

    Methods raise sqlite3.OperationalError if the system refuses to write, and another
    sqlite3.DatabaseError if the database is damaged, as `damaged_database` reports it.
    """

    def __init__(self, directory: Path):
        self._path = path = directory / DATABASE
        self._db = sqlite3.connect(path, isolation_level=None)
        self._db.text_factory = _text
        try:
            self._db.execute("PRAGMA journal_mode = WAL")
            self._db.execute("PRAGMA synchronous = FULL")
            self._db.execute("PRAGMA cache_size = -65536")
            # Results of a version with other numbers have other keys, so that they are never asked
            # for again.
            columns = [row[1] for row in self._db.execute("PRAGMA table_info(results)")]
            with self._transaction():
                if columns != _COLUMNS:
                    self._db.execute("DROP TABLE IF EXISTS results")
                    numbers = ", ".join(f'"{name}" REAL' for name in NUMBERS)
                    texts = (
                        "key TEXT PRIMARY KEY, outcome TEXT, reason TEXT, detail TEXT, layout TEXT"
                    )
                    self._db.execute(f"CREATE TABLE results ({texts}, {numbers}, crc INTEGER)")
            self._file = path.stat()
        except sqlite3.DatabaseError:
            self.close()
            raise

    @contextmanager
    def _transaction(self) -> Iterator[None]:
        with self._db:
            self._db.execute("BEGIN IMMEDIATE")
            yield

    def check_there(self) -> None:
        """Stop if the file was removed or replaced: what is written now would end with this process.

        Raises MacroslipError.
        """
        try:
            same = os.path.samestat(self._path.stat(), self._file)
        except OSError:
            same = False
        if not same:
            what = "the database was removed or replaced while the study ran"
            raise MacroslipError(f"{self._path}: {what}. {_GONE}")

    def close(self) -> None:
        """Close the file; without a log beside it, it can be read where nothing can be written."""
        with contextlib.suppress(
            sqlite3.Error
        ):  # somebody reads, or the disk is full: the log stays and is read too
            self._db.execute("PRAGMA journal_mode = DELETE")
        with contextlib.suppress(sqlite3.Error):
            self._db.close()

    def begin(self, runs: Iterable[tuple[str, Mapping[str, Any]]]) -> int:
        """Replace the list of runs, each with its name and labels.

        Outcomes of runs that stay are kept.

        Rows of results that were damaged are removed; gives their number.
        """
        texts = ((run, json.dumps(labels, ensure_ascii=False)) for run, labels in runs)
        with self._transaction():
            self._db.execute(
                "CREATE TABLE IF NOT EXISTS runs (run TEXT, key TEXT, outcome TEXT, reason TEXT)"
            )
            self._db.execute("ALTER TABLE runs RENAME TO earlier")
            self._db.execute(
                'CREATE TABLE runs ("case" INTEGER PRIMARY KEY, run TEXT UNIQUE, labels TEXT, crc INTEGER, key TEXT, '
                "outcome TEXT, reason TEXT)"
            )
            rows = ((case, *pair, _crc(pair)) for case, pair in enumerate(texts))
            self._db.executemany(
                'INSERT INTO runs ("case", run, labels, crc) VALUES (?, ?, ?, ?)', rows
            )
            self._db.execute(
                "UPDATE runs SET (key, outcome, reason) = (earlier.key, earlier.outcome, earlier.reason) FROM earlier "
                "WHERE earlier.run = runs.run"
            )
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
        row = self._db.execute("SELECT detail FROM results WHERE key = ?", (key,)).fetchone()
        return row[0] if row else None

    def key(self, run: str) -> str | None:
        """Key of the latest result of a run; None without one."""
        row = self._db.execute(
            "SELECT key FROM runs WHERE run = ? AND outcome IS NULL", (run,)
        ).fetchone()
        return row[0] if row else None

    def record(self, entries: Iterable[Mapping[str, Any]]) -> None:
        """Record what runs ended with, in one transaction: when this returns it is on the disk.

        Entries are as from `macroslip.study.work.work`; without `outcome` a run has the result of
        its key, which is there. If the system refuses, none of them is recorded, and sqlite3.Error
        is raised; MacroslipError if the file is gone.
        """
        self.check_there()
        places = ", ?" * (len(NUMBERS) + 5)
        with self._transaction():
            for entry in entries:
                if "detail" in entry and "outcome" in entry:
                    texts = [str(entry[name]) for name in _TEXT_COLUMNS]
                    # Adding nothing makes a negative zero positive, as the database keeps it.
                    numbers = [float(entry["values"][name]) + 0.0 for name in NUMBERS]
                    row = (
                        *texts,
                        *(None if math.isnan(number) else number for number in numbers),
                        _crc(texts, numbers),
                    )
                    self._db.execute(f"INSERT OR REPLACE INTO results VALUES (?{places})", row)
                ended = entry if entry.get("outcome") == Outcome.FAILED else {}
                changed = (
                    entry.get("key"),
                    ended.get("outcome"),
                    ended.get("reason"),
                    entry["run"],
                )
                self._db.execute(
                    "UPDATE runs SET key = ?, outcome = ?, reason = ? WHERE run = ?", changed
                )


def damaged_database(directory: Path, error: sqlite3.DatabaseError) -> InputError:
    """The problem of a damaged database."""
    return InputError(
        f"the database is damaged ({error})", where=str(directory / DATABASE), remedy=DAMAGED
    )


def _text(content: bytes) -> str:
    """A text of the database; one that was damaged is another text, which its checksum tells."""
    return content.decode(errors="replace")


def _crc(texts: Sequence[str], numbers: Sequence[float] = ()) -> int:
    """Checksum of a row, by which one that was changed on the disk is found."""
    return zlib.crc32("\0".join(texts).encode() + struct.pack(f"<{len(numbers)}d", *numbers))


def _is_sound(row: Sequence[Any]) -> bool:
    """True if a row of results is as it was recorded."""
    texts = row[: len(_TEXT_COLUMNS)]
    numbers = [math.nan if number is None else number for number in row[len(_TEXT_COLUMNS) : -1]]
    try:
        return _crc(texts, numbers) == row[-1]
    except (TypeError, struct.error):  # a text in place of a number, or the other way round
        return False


def read_runs(directory: Path) -> pd.DataFrame:
    """The runs of a study in their order, as far as they are recorded, while others may be recorded.

    The columns are `run`, the labels, the texts of `TEXTS` and the numbers of the summary, NaN
    where there is none. A row that was changed on the disk counts as not done. Raises InputError if
    the list of runs was changed on the disk, or there is no database.
    """
    path = directory / DATABASE
    if not path.exists():
        raise InputError("the database is not there", where=str(path), remedy=_GONE)
    frames = []
    with closing(sqlite3.connect(f"{path.absolute().as_uri()}?mode=ro", uri=True)) as db:
        db.text_factory = _text
        if [row[1] for row in db.execute("PRAGMA table_info(results)")] != _COLUMNS:
            raise _other_version(directory, "with other numbers")
        if not list(db.execute("SELECT 1 FROM sqlite_schema WHERE name = 'runs'")):
            raise InputError("the study has no runs yet", where=str(directory), remedy=_NO_RUNS)
        cursor = db.execute(
            "SELECT run, labels, runs.crc, runs.key, runs.outcome, runs.reason, results.* FROM runs "
            'LEFT JOIN results ON results.key = runs.key AND runs.outcome IS NULL ORDER BY "case"'
        )
        for rows in iter(lambda: cursor.fetchmany(_BATCH), []):
            if any(_crc(row[:2]) != row[2] for row in rows):
                raise InputError("the list of runs is damaged", where=str(path), remedy=REMEDY)
            labels = pd.DataFrame([{"run": row[0], **json.loads(row[1])} for row in rows])
            found = pd.DataFrame(list(map(_line, rows)), columns=[*TEXTS, *NUMBERS])
            frames.append(pd.concat([labels, found.astype(dict.fromkeys(NUMBERS, float))], axis=1))
    if not frames:
        raise InputError("its list of runs is empty", where=str(path), remedy=_NO_RUNS)
    return pd.concat(frames, ignore_index=True)


def _line(row: tuple[Any, ...]) -> tuple[Any, ...]:
    (key, outcome, reason), result = row[3:6], row[6:]
    numbers = result[5:-1]
    if outcome is not None:
        return (outcome, reason, key or "", "", "", *numbers)
    if result[0] is None:
        return (*TEXTS.values(), *numbers)
    if not _is_sound(result):
        return (
            *(TEXTS | {"reason": "its row in the database is damaged"}).values(),
            *[None] * len(numbers),
        )
    return (*result[1:3], key, *result[3:5], *numbers)


def write_summary(directory: Path, units: dict[str, str]) -> None:
    """Write `summary.parquet`: each run with its labels, how it ended and its numbers, with units by column."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    runs = read_runs(directory)
    for name, column in runs.items():
        if column.map(
            lambda value: isinstance(value, str)
        ).any():  # words beside numbers make all of a column text
            runs[name] = column.map(str, na_action="ignore")
    table = pa.Table.from_pandas(runs, preserve_index=False)
    fields = [
        field.with_metadata({"units": (units | NUMBERS).get(field.name, "1")})
        for field in table.schema
    ]
    buffer = io.BytesIO()
    pq.write_table(
        table.cast(pa.schema(fields)), buffer, compression="zstd", write_page_checksum=True
    )
    write_durably(directory / SUMMARY, buffer.getvalue())


def case_path(directory: Path, key: str) -> Path:
    """Where the result of a case lies: 256 folders keep any one of them small."""
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
    large = {
        name: variable.astype(float)
        for name, variable in result.data_vars.items()
        if variable.dtype.kind in "iu"
        and variable.size
        and np.abs(variable.values.astype(float)).max() >= 2**31
    }
    empty = {str(name): one for name, one in result.variables.items() if one.size == 0}
    about = {
        name: [one.dims, one.shape, one.dtype.str, one.attrs, name in result.coords]
        for name, one in empty.items()
    }
    kept = (
        result.assign(large)
        .drop_vars(list(empty))
        .assign_attrs({_EMPTY: json.dumps(about)} if empty else {})
    )
    return bytes(kept.to_netcdf(engine="scipy", format="NETCDF3_64BIT"))


def from_bytes(content: bytes) -> xr.Dataset:
    """The dataset that a netCDF file of the store holds."""
    with xr.open_dataset(io.BytesIO(content), engine="scipy") as opened:
        result = opened.load()
    about = json.loads(result.attrs.pop(_EMPTY, "{}"))
    empty = {
        name: (dims, np.empty(shape, dtype), attrs)
        for name, (dims, shape, dtype, attrs, _) in about.items()
    }
    return result.assign(empty).set_coords(
        [name for name, described in about.items() if described[-1]]
    )


def checksum(content: bytes) -> str:
    """SHA-256 in hexadecimal digits."""
    return hashlib.sha256(content).hexdigest()


def layout(result: xr.Dataset) -> str:
    """Layout of a result that a reader needs before it opens the file, as JSON.

    `sizes` by dimension; `rollers`, their numbers, left out where they count from 0; and
    `variables`, a hash of names, dimensions and types.
    """
    variables = sorted(
        (str(name), *map(str, one.dims), one.dtype.str) for name, one in result.variables.items()
    )
    found: dict[str, Any] = {
        "sizes": {str(name): size for name, size in result.sizes.items()},
        "variables": checksum(json.dumps(variables).encode())[:16],
    }
    numbers = [int(number) for number in result.roller.values]
    return json.dumps(
        found if numbers == list(range(len(numbers))) else found | {"rollers": numbers}
    )


def read_result(directory: Path, key: str, expected: str) -> xr.Dataset:
    """Read a stored result, if it still has the checksum in the database.

    Raises InputError if the file is missing or damaged.
    """
    path = case_path(directory, key)
    remedy = "Compute it again: macroslip study STUDY.yaml -o DIR --resume"
    check_regular(path, remedy)
    try:
        content = path.read_bytes()
    except OSError as error:
        raise InputError(
            f"a stored result cannot be read ({error.strerror})", where=str(path), remedy=remedy
        ) from None
    if checksum(content) != expected:
        raise InputError(
            "a stored result is damaged: its checksum has changed", where=str(path), remedy=remedy
        )
    return from_bytes(content)


def write_manifest(directory: Path, manifest: dict[str, Any]) -> str:
    """Write the manifest durably.

    Gives its checksum, by which workers verify that they read the same.
    """
    content = json.dumps({"format": FORMAT, **manifest}, indent=1, ensure_ascii=False).encode()
    write_durably(directory / MANIFEST, content)
    return checksum(content)


def read_manifest(directory: Path) -> tuple[dict[str, Any], str]:
    """The manifest and its checksum.

    Raises InputError if the folder holds no study, one of another format, or no whole manifest.
    """
    path = directory / MANIFEST
    check_parts(directory)
    try:
        content = path.read_bytes()
        manifest = json.loads(content)
        found = manifest["format"]
    except (FileNotFoundError, NotADirectoryError):
        remedy = "Name a folder that macroslip study has written."
        raise InputError(
            "there is no study in this folder", where=str(directory), remedy=remedy
        ) from None
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise InputError(
            f"the manifest cannot be read ({error})", where=str(path), remedy=REMEDY
        ) from None
    if found != FORMAT:
        raise _other_version(directory, found)
    return manifest, checksum(content)


def _other_version(directory: Path, found: Any) -> InputError:
    return InputError(
        f"another version of macroslip wrote this study (format {found!r})",
        where=str(directory),
        allowed=f"format {FORMAT}",
        remedy="Read it with that version, or compute the study again in a new folder.",
    )


def lacks_database(directory: Path) -> bool:
    """True if a study was begun in the folder and its database is gone, so that its results count no longer."""
    return (directory / CASES).is_dir() and not (directory / DATABASE).exists()


def parts(directory: Path) -> list[Path]:
    """The files at the top of a study's folder, whether they are there or not."""
    return [directory / name for name in sorted(_FILES)]


def check_parts(directory: Path) -> None:
    """Refuse a folder in which a pipe, a socket or a device has the name of a file of the study."""
    for path in parts(directory):
        check_regular(path, "Remove it.")


def check_folder(directory: Path, *, resume: bool) -> None:
    """Refuse a folder that a study cannot begin in.

    Raises InputError if it is a file, holds other things or a study of another version, or holds a
    study and `resume` is not set.
    """
    where = str(directory)
    if not directory.exists():
        return
    if not directory.is_dir():
        raise InputError("it is not a folder", where=where, remedy="Name a folder, new or empty.")
    check_parts(directory)
    names = {path.name for path in directory.iterdir()}
    if names & {MANIFEST, DATABASE}:
        if not resume:
            remedy = "Go on with it by --resume, or choose another folder."
            raise InputError("the folder holds a study already", where=where, remedy=remedy)
        return
    ours = {*_FILES, CASES, BALANCE_RUNS}
    foreign = sorted(name for name in names if name not in ours and not name.endswith(UNFINISHED))
    if foreign:
        remedy = "Name a folder that is new or empty."
        raise InputError(
            f"the folder holds other things, {foreign[0]!r} first", where=where, remedy=remedy
        )


def remove_unfinished(directory: Path) -> int:
    """Remove files that a process had not finished when it ended; gives their number."""
    found = itertools.chain(
        directory.glob(f".*{UNFINISHED}"), (directory / CASES).glob(f"*/.*{UNFINISHED}")
    )
    return sum(path.unlink(missing_ok=True) is None for path in list(found))


@contextmanager
def locked(directory: Path) -> Iterator[None]:
    """Hold a folder for the length of the block, by a lock of the system that ends with the process.

    Raises InputError if another process holds it; the message names it, its machine, and since
    when.
    """
    path = directory / LOCK
    try:
        lock = FileLock(path, timeout=0).acquire()
    except Timeout:
        holder = path.read_text(encoding="utf-8", errors="replace")[:200]
        raise InputError(
            f"another process is at work in this folder ({holder})",
            where=str(directory),
            remedy="Wait for it or stop it, or choose another folder. open_study may look at it meanwhile.",
        ) from None
    with lock:
        now = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())
        with contextlib.suppress(OSError):  # where the disk is full, the lock holds without it
            path.write_text(
                f"process {os.getpid()} on {platform.node()}, since {now}", encoding="utf-8"
            )
        yield
