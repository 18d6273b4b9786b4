"""What a study's journal has of every run, column by column.

A journal is read line by line, which takes a minute for a million lines. The summary, which is written when a session
ends, has the same columns; it is read instead where the journal has not changed since.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.bearing.geometry import ROWS
from macroslip.study.journal import records
from macroslip.study.outcome import Outcome
from macroslip.study.store import JOURNAL, SUMMARY
from macroslip.study.summary import CASE_VARIABLES, ROW_VARIABLES

if TYPE_CHECKING:
    import pyarrow as pa

#: Text columns, with what a run has in them that was not done.
TEXTS = {"outcome": str(Outcome.MISSING), "reason": "", "key": "", "detail": "", "layout": ""}
#: Columns of numbers: those of rows end in the row's name.
NUMBERS = [f"{name}_{row}" for name in ROW_VARIABLES for row in ROWS] + list(CASE_VARIABLES)
#: Key of the summary's metadata with the journal it was made of.
STATE = b"journal"
_BLOCK = 5000
#: Length of keys and checksums.
_KEY = 64
#: Bytes at the end of a journal by which it is recognized, beside its length.
_END = 4096


@dataclass(frozen=True)
class Recorded:
    """Columns over the runs of a study.

    Attributes
    ----------
    texts : mapping of str to ndarray of str
        `outcome`, `reason`, `key`, `detail` (checksum of the result, empty without one) and `layout` (JSON).
    numbers : mapping of str to ndarray
        Of the summary, by the name of its column; NaN where there is none.
    """

    texts: Mapping[str, np.ndarray]
    numbers: Mapping[str, np.ndarray]

    @property
    def stored(self) -> np.ndarray:
        """Whether each run has a result."""
        return self.texts["detail"] != ""

    def layouts(self) -> tuple[list[dict[str, Any]], np.ndarray]:
        """The different layouts of results, and which of them each run has, -1 without a result."""
        import pandas as pd

        numbers, different = pd.factorize(np.where(self.stored, self.texts["layout"], np.array(None)))
        return [json.loads(text) for text in different], numbers


def recorded(directory: Path, runs: Sequence[str]) -> Recorded:
    """What is known of runs, from the summary where it is up to date, else from the journal.

    Parameters
    ----------
    directory : Path
        Of the study.
    runs : sequence of str
        Their names.
    """
    return _of_summary(directory, runs) or of_journal(directory / JOURNAL, runs)


def journal_state(path: Path) -> bytes:
    """Identity of a journal, which differs for a longer one and for another: its length, and a hash of its end."""
    try:
        with path.open("rb") as file:
            length = file.seek(0, os.SEEK_END)
            file.seek(max(0, length - _END))
            return f"{length} {hashlib.sha256(file.read()).hexdigest()}".encode()
    except FileNotFoundError:
        return b"none"


def _of_summary(directory: Path, runs: Sequence[str]) -> Recorded | None:
    """The columns of the summary; None if it is missing, damaged, of other runs or of another state of the journal."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    try:
        with pq.ParquetFile(directory / SUMMARY, page_checksum_verification=True) as file:
            metadata = file.schema_arrow.metadata or {}
            if metadata.get(STATE) != journal_state(directory / JOURNAL):
                return None
            table = file.read(["run", *TEXTS, *NUMBERS])
        if not table["run"].equals(pa.chunked_array([pa.array(runs, pa.string())])):
            return None
        return Recorded(
            {name: texts(table[name]) for name in TEXTS}, {name: table[name].to_numpy() for name in NUMBERS}
        )
    except (OSError, ValueError, KeyError, pa.ArrowException):
        return None


def texts(column: pa.ChunkedArray) -> np.ndarray:
    """The texts of a column of a table, empty where there is none; equal ones are one object."""
    return column.fill_null("").to_pandas().to_numpy(dtype=object)


class _Journal:
    """Columns that grow with every record; later records take precedence."""

    def __init__(self) -> None:
        self.results: dict[bytes, int] = {}
        self.keys: dict[bytes, bytes] = {}
        self.failures: dict[bytes, dict[str, Any]] = {}
        self.texts: list[tuple[str, ...]] = []
        self._blocks: list[np.ndarray] = []
        self._lines: list[list[float]] = []
        self._known: dict[str, str] = {}

    def take(self, record: dict[str, Any]) -> None:
        run, key = bytes.fromhex(record["run"]), bytes.fromhex(record.get("key", ""))
        if "outcome" in record and not Outcome(record["outcome"]).stored:
            self.failures[run] = record
            self.keys.pop(run, None)
            return
        if "detail" in record:
            self.results[key] = len(self.texts)
            self._append(record)
        # Otherwise the record gives this run the result of another one.
        self.failures.pop(run, None)
        self.keys[run] = key

    def _append(self, record: dict[str, Any]) -> None:
        known = {**record, "layout": json.dumps(record["layout"])}
        # Outcomes, reasons and layouts are few, and one object each.
        found = (known.get(name, "") for name in TEXTS)
        self.texts.append(tuple(text if len(text) == _KEY else self._known.setdefault(text, text) for text in found))
        values = record["values"]
        nothing = [np.nan] * len(ROWS)
        line = [value for name in ROW_VARIABLES for value in values.get(name, nothing)]
        self._lines.append([*line, *(values.get(name, np.nan) for name in CASE_VARIABLES)])
        if len(self._lines) == _BLOCK:
            self._close_block()

    def _close_block(self) -> None:
        self._blocks.append(np.array(self._lines, dtype=float).reshape(-1, len(NUMBERS)))
        self._lines = []

    def columns(self, runs: Sequence[str]) -> Recorded:
        """The columns over the runs."""
        self._close_block()
        nothing = np.full((1, len(NUMBERS)), np.nan)
        values = np.concatenate([*self._blocks, nothing])  # the last line for runs without a result
        names = [bytes.fromhex(run) for run in runs]
        lines = np.array([self.results.get(self.keys.get(name, b""), -1) for name in names], dtype=int)
        empty = tuple(TEXTS.values())
        found = [self.texts[line] if line >= 0 else empty for line in lines]
        for number, name in enumerate(names):
            if failure := self.failures.get(name):
                found[number] = tuple(str(failure.get(column, "")) for column in TEXTS)
        columns = zip(*found, strict=True) if found else [()] * len(TEXTS)
        words = {name: np.array(column, dtype=object) for name, column in zip(TEXTS, columns, strict=True)}
        return Recorded(words, {name: values[lines, number] for number, name in enumerate(NUMBERS)})


def of_journal(path: Path, runs: Sequence[str]) -> Recorded:
    """What a journal has of runs, in one pass over its lines; damaged ones count as never written."""
    columns = _Journal()
    for record in records(path):
        if record is not None:
            columns.take(record)
    return columns.columns(runs)
