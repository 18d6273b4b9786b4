"""Output files that are either whole or not there."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from macroslip.errors import InputError


def check_new_file(path: Path, *, force: bool) -> None:
    """Refuse a file that cannot be made, before anything is computed for it.

    Parameters
    ----------
    path : Path
        The file to make.
    force : bool
        Whether it may replace a file.

    Raises
    ------
    InputError
        If the file exists and `force` is not set, or its folder is missing or cannot be written to.
    """
    folder, where = path.parent, str(path)
    if path.is_dir():
        raise InputError("this is a folder", where=where, allowed="a file", remedy="Add the name of a file to it.")
    if path.exists() and not force:
        raise InputError("the file exists", where=where, remedy="Choose another name, or replace it with --force.")
    if not folder.is_dir():
        remedy = "Make that folder first, or choose another one."
        raise InputError(f"there is no folder '{folder}'", where=where, remedy=remedy)
    try:
        temporary = _temporary(path)
        temporary.touch()
        temporary.unlink()
    except OSError as error:
        remedy = "Choose another folder, or ask for the right to write there."
        raise InputError(f"nothing can be written there ({error.strerror})", where=where, remedy=remedy) from None


@contextmanager
def new_file(path: Path) -> Iterator[Path]:
    """Give a temporary path to write to; it takes its proper name when the block is left without an error.

    Parameters
    ----------
    path : Path
        The file to make, or to replace.

    Yields
    ------
    Path
        In the same folder, so that the change of name is one step. What stands there is removed if the block fails.

    Raises
    ------
    InputError
        If the system refuses to write, the disk being full, for example.
    """
    temporary = _temporary(path)
    try:
        yield temporary
        os.replace(temporary, path)
    except OSError as error:
        raise InputError(
            f"the file was not written ({error.strerror or error})",
            where=str(path),
            remedy="Make room there or choose another folder; nothing partial was left behind.",
        ) from error
    finally:
        temporary.unlink(missing_ok=True)


def _temporary(path: Path) -> Path:
    return path.with_name(f".{path.name}.{os.getpid()}.part")
