"""Files that appear together or not at all."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from macroslip.errors import InputError


@contextmanager
def published_together(directory: Path, last: str) -> Iterator[Path]:
    """A folder beside `directory` to write into; its content moves into `directory` when the block ends well.

    Files that `directory` already holds under other names stay. The file named `last` marks the set as complete: an old
    one is taken away before the first file moves, the new one moves after all others. If the block raises, `directory`
    is as it was.

    Parameters
    ----------
    directory : Path
        Made if it does not exist, with its parents.
    last : str
        Name of the file that marks the set as complete.

    Raises
    ------
    InputError
        If `directory` is a file.
    """
    if directory.exists() and not directory.is_dir():
        raise InputError(
            "it is not a folder", where=str(directory), remedy="Name a folder, new or existing."
        )
    directory = directory.absolute()
    directory.parent.mkdir(parents=True, exist_ok=True)
    aside = directory.parent / f".{directory.name}.unfinished-{os.getpid()}"
    shutil.rmtree(aside, ignore_errors=True)
    aside.mkdir()
    try:
        yield aside
        if not directory.exists():
            aside.rename(directory)
            return
        (directory / last).unlink(missing_ok=True)
        files = sorted(path.relative_to(aside) for path in aside.rglob("*") if path.is_file())
        for path in sorted(files, key=lambda path: path == Path(last)):
            (directory / path).parent.mkdir(exist_ok=True)
            (aside / path).replace(directory / path)
    finally:
        shutil.rmtree(aside, ignore_errors=True)
