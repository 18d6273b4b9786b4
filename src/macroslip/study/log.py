"""The log of a study: a text file that grows, one line an event, to be read during the run and afterwards."""

from __future__ import annotations

import contextlib
import logging
import time
from pathlib import Path

from macroslip.study.safe_text import safe_text


class Log(logging.FileHandler):
    """Appends lines with date and time (UTC) to a file.

    Parameters
    ----------
    path : Path
    """

    def __init__(self, path: Path):
        super().__init__(path, encoding="utf-8")
        self.setFormatter(_Lines("%(asctime)s %(message)s", "%Y-%m-%dT%H:%M:%SZ"))

    def write(self, text: str) -> None:
        """Add a line; further lines of the text are indented below it."""
        self.handle(logging.LogRecord("macroslip", logging.INFO, __file__, 0, text, None, None))

    def handleError(self, record: logging.LogRecord) -> None:  # noqa: N802, the name is logging's
        """Continue: a full disk is reported where results are stored."""

    def close(self) -> None:
        """Close the file."""
        with contextlib.suppress(OSError):
            super().close()


class _Lines(logging.Formatter):
    converter = staticmethod(time.gmtime)

    def format(self, record: logging.LogRecord) -> str:
        first, *others = str(record.msg).splitlines() or [""]
        lines = [safe_text(first), *(f"    {safe_text(other)}" for other in others)]
        return super().format(logging.makeLogRecord(record.__dict__ | {"msg": "\n".join(lines)}))
