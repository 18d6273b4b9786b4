"""The folder of a study: manifest, database, results, tables, log and lock."""

from __future__ import annotations

import contextlib
import json
import os
import platform
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from filelock import FileLock, Timeout

from macroslip.errors import InputError
from macroslip.storage.files import (
    DATABASE,
    LOCK,
    MANIFEST,
    STUDY_FILES,
    UNFINISHED,
    check_regular,
    write_durably,
)
from macroslip.study.result_files import CASES, checksum

FORMAT = 4
#: Folder of the runs by which the temperature of a study is found; a study of its own.
BALANCE_RUNS = "balance"
_FILES = (*STUDY_FILES, f"{DATABASE}-wal", f"{DATABASE}-shm")
#: Advice for a damaged manifest or a damaged list of runs.
REMEDY = "Write it again with macroslip study STUDY.yaml -o DIR --resume; results are kept."


def write_manifest(directory: Path, manifest: dict[str, Any]) -> str:
    """Write the manifest durably.

    Gives its checksum, by which workers verify that they read the same.
    """
    text = json.dumps({"format": FORMAT, **manifest}, indent=1, ensure_ascii=False)
    content = text.encode()
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
        version = manifest["format"]
    except (FileNotFoundError, NotADirectoryError):
        remedy = "Name a folder that macroslip study has written."
        raise InputError(
            "there is no study in this folder", where=str(directory), remedy=remedy
        ) from None
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise InputError(
            f"the manifest cannot be read ({error})", where=str(path), remedy=REMEDY
        ) from None
    if version != FORMAT:
        raise other_version(directory, version)
    return manifest, checksum(content)


def other_version(directory: Path, version: Any) -> InputError:
    """Error for a study that another version of the program wrote."""
    return InputError(
        f"another version of macroslip wrote this study (format {version!r})",
        where=str(directory),
        allowed=f"format {FORMAT}",
        remedy="Read it with that version, or compute the study again in a new folder.",
    )


def lacks_database(directory: Path) -> bool:
    """True if a study was begun in the folder and its database is gone."""
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
    foreign = []
    for name in sorted(names - ours):
        if not name.endswith(UNFINISHED):
            foreign.append(name)
    if foreign:
        remedy = "Name a folder that is new or empty."
        raise InputError(
            f"the folder holds other things, {foreign[0]!r} first", where=where, remedy=remedy
        )


def remove_unfinished(directory: Path) -> int:
    """Remove files that a process had not finished when it ended; gives their number."""
    in_folder = directory.glob(f".*{UNFINISHED}")
    in_cases = (directory / CASES).glob(f"*/.*{UNFINISHED}")
    unfinished = [*in_folder, *in_cases]
    for path in unfinished:
        path.unlink(missing_ok=True)
    return len(unfinished)


@contextmanager
def locked(directory: Path) -> Iterator[None]:
    """Hold a folder by a lock of the system, which ends with the process.

    Raises InputError if another process holds it; the message names it, its machine, and since
    when.
    """
    path = directory / LOCK
    try:
        lock = FileLock(path, timeout=0).acquire()
    except Timeout:
        text = path.read_text(encoding="utf-8", errors="replace")
        holder = text[:200]
        raise InputError(
            f"another process is at work in this folder ({holder})",
            where=str(directory),
            remedy="Wait for it or stop it, or choose another folder. open_study may look at it "
            "meanwhile.",
        ) from None
    with lock:
        now = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime())
        with contextlib.suppress(OSError):  # where the disk is full, the lock holds without it
            path.write_text(
                f"process {os.getpid()} on {platform.node()}, since {now}", encoding="utf-8"
            )
        yield
