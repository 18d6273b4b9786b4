"""The log of a study: a text file that grows, one line an event, to be read during the run and afterwards."""

from __future__ import annotations

import contextlib
import time
from pathlib import Path

from macroslip.study.safe_text import safe_text


class Log:
    """Appends lines with date and time (UTC) to a file.

    Parameters
    ----------
    path : Path
    """

    def __init__(self, path: Path):
        self._file = path.open("a", encoding="utf-8")

    def write(self, text: str) -> None:
        """Add a line; further lines of the text are indented below it."""
        first, *others = text.splitlines() or [""]
        stamp = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())
        lines = [f"{stamp} {safe_text(first)}", *(f"    {safe_text(other)}" for other in others)]
        # A full disk is found out, and told, where results are stored.
        with contextlib.suppress(OSError):
            self._file.write("\n".join(lines) + "\n")
            self._file.flush()

    def close(self) -> None:
        """Close the file."""
        with contextlib.suppress(OSError):
            self._file.close()
