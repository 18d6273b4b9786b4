"""The file a load history is read from: it has to exist, hold something and be of a known kind."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from pathlib import Path

from macroslip.errors import InputError
from macroslip.files import check_regular

#: What to do about a file that no reader understands.
DAMAGED = "Write or copy the file again; macroslip loads inspect shows what it holds."


def source_file(path: str | os.PathLike[str], kinds: Mapping[str, str], remedy: str = "") -> tuple[Path, str]:
    """Return the path and its lower-case extension, or raise what is wrong with it.

    Parameters
    ----------
    path : path
        File to read.
    kinds : mapping
        Accepted extensions, with the dot, and what they hold.
    remedy : str
        What to do about an extension that is not among `kinds`.
    """
    path = Path(path)
    check_regular(path, "Name a file with loads.")
    if not path.is_file():
        what = "is a folder, not a file" if path.is_dir() else "no such file"
        raise InputError(what, where=str(path), remedy=f"Check the path; the current folder is {Path.cwd()}.")
    extension = path.suffix.lower()
    # Bladed numbers its groups of results: run.%23 and run.$23.
    numbered = re.fullmatch(r"\.[%$](\d{1,4}|pj)", extension)
    if extension not in kinds and not (numbered and ".%nn" in kinds):
        raise InputError(
            f"the extension {path.suffix!r} is not known",
            where=str(path),
            allowed=", ".join(f"{ext} ({meaning})" for ext, meaning in kinds.items()),
            remedy=remedy,
        )
    if path.stat().st_size == 0:
        raise InputError("the file is empty", where=str(path), remedy="Write or copy the file again.")
    return path, extension


def without_folders(source: str) -> str:
    r"""Where loads come from, for what leaves this computer: of an absolute path the file's name only.

    Examples
    --------
    >>> without_folders("/home/me/new turbine/run.outb"), without_folders("runs/run.outb")
    ('run.outb', 'runs/run.outb')
    >>> without_folders("front bearing under C:\\Users\\me\\run.outb")
    'front bearing under run.outb'
    """
    return re.sub(r"(?:(?<=\s)|^)(?:[A-Za-z]:)?[\\/](?:.*[\\/])?", "", source)
