"""The page of the reproduction, written by a process of its own while this one draws the figures.

Both take most of a minute, and matplotlib keeps the interpreter's lock.
"""

from __future__ import annotations

import pickle
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from macroslip.machine import process_environment


@contextmanager
def page_written(path: Path, *inputs: Any) -> Iterator[None]:
    """Write the page while the block runs; when the block ends, the page is there.

    Parameters
    ----------
    path : Path
        Of the page.
    inputs
        As for `macroslip.reproduction.reproduction_page.reproduction_page`.

    Raises
    ------
    RuntimeError
        If the page cannot be written, with the traceback of the other process.
    """
    with tempfile.TemporaryFile() as given, tempfile.TemporaryFile("w+") as problems:
        pickle.dump((path, inputs), given)
        given.seek(0)
        process = subprocess.Popen(
            [sys.executable, "-m", __name__],
            stdin=given,
            stdout=problems,
            stderr=problems,
            env=process_environment(),
        )
        try:
            yield
            process.wait()
        finally:
            if process.poll() is None:
                process.kill()
                process.wait()
        if process.returncode != 0:
            problems.seek(0)
            raise RuntimeError(f"{path.name} could not be written\n{problems.read()}")


def _write() -> None:
    from macroslip.reproduction.reproduction_page import reproduction_page

    path, inputs = pickle.load(sys.stdin.buffer)
    path.write_text(reproduction_page(*inputs), encoding="utf-8")


if __name__ == "__main__":
    _write()
