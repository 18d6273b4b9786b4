"""The record of what is done: one line a run, appended and flushed to the disk before anything is reported done.

A line is a checksum, a space and a JSON object. What does not match its checksum, such as a line a power cut tore,
counts as never written. Later lines take precedence over earlier ones.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from macroslip.files import flush, flush_folder

_DIGITS = 16


def encode(record: dict[str, Any]) -> bytes:
    """Write a record as a line."""
    text = json.dumps(record, ensure_ascii=False, separators=(",", ":")).encode()
    return _checksum(text) + b" " + text + b"\n"


def decode(line: bytes) -> dict[str, Any] | None:
    """Read a line; None if it is damaged."""
    text = line[_DIGITS + 1 : -1]
    if not line.endswith(b"\n") or line[: _DIGITS + 1] != _checksum(text) + b" ":
        return None
    return json.loads(text)


def records(path: Path) -> Iterator[dict[str, Any] | None]:
    """Yield the record of every line, None where it is damaged; nothing without a file."""
    try:
        file = path.open("rb")
    except FileNotFoundError:
        return
    with file:
        for line in file:
            yield decode(line)


class Journal:
    """A journal open for appending.

    Parameters
    ----------
    path : Path
        Made if it does not exist. A torn last line is cut off.
    """

    def __init__(self, path: Path):
        self._file = path.open("ab", buffering=0)
        flush_folder(path.parent)
        self._cut_torn_line(path)

    def append(self, batch: Iterable[dict[str, Any]]) -> None:
        """Write records; when this returns they are on the disk.

        Raises
        ------
        OSError
            If the system refuses; none of the batch counts then, and what was written of it is cut off.
        """
        content = memoryview(b"".join(encode(record) for record in batch))
        start = os.fstat(self._file.fileno()).st_size
        try:
            while content:  # an unbuffered write may take a part only
                content = content[self._file.write(content) :]
            flush(self._file.fileno())
        except OSError:
            self._file.truncate(start)
            raise

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def _cut_torn_line(self, path: Path) -> None:
        end = 0
        with path.open("rb") as file:
            for line in file:
                end += len(line) if line.endswith(b"\n") else 0
        self._file.truncate(end)


def _checksum(text: bytes) -> bytes:
    return hashlib.sha256(text).hexdigest()[:_DIGITS].encode()
