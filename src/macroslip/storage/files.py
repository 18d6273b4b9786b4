"""Output files, each whole or missing, none in place of a file that a user needs.

They are written aside and then renamed.
"""

from __future__ import annotations

import contextlib
import errno
import os
import stat
import uuid
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

from macroslip.errors import InputError, on_one_line

#: End of the names of files that are being written; a file with it was never finished.
UNFINISHED = ".part"
#: Fault of a path that is neither a file nor a folder.
SPECIAL = "it is a pipe, a socket or a device, not a file"
#: Advice where the system refuses a name for its length.
SHORTER = "Choose a shorter name."
#: Files by which the folder of a study is one: manifest, database, results, log and lock.
STUDY_FILES = MANIFEST, DATABASE, SUMMARY, LOG, LOCK = (
    "manifest.json", "study.sqlite", "summary.parquet", "log.txt", "lock",
)  # fmt: skip


def write_durably(path: Path, content: bytes) -> None:
    """Write a file in one step: when this returns it is on the disk.

    Until then, or if the system refuses, the old one is.
    """
    make_folder(path.parent)
    temporary = unfinished(path)
    try:
        with temporary.open("xb") as file:
            file.write(content)
            flush(file.fileno())
        temporary.replace(path)
    finally:
        with contextlib.suppress(OSError):
            temporary.unlink(missing_ok=True)
    flush_folder(path.parent)


def make_folder(folder: Path) -> None:
    """Make a folder with its parents, so that a power cut does not undo it."""
    if not folder.is_dir():
        make_folder(folder.parent)
        folder.mkdir(exist_ok=True)
        flush_folder(folder.parent)


def flush(descriptor: int) -> None:
    """Have the system put a file's content on the disk before it goes on."""
    os.fsync(descriptor)


def flush_folder(folder: Path) -> None:
    """Write the names in a folder to the disk.

    Systems without such a thing, as Windows, keep them by themselves.
    """
    if os.name == "posix":
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


def is_special(path: Path) -> bool:
    """True if a path leads to a pipe, a socket or a device.

    Its reader would wait for ever or find no end.

    Raises OSError or ValueError if there is nothing, or nothing can have this name.
    """
    kind = path.stat().st_mode
    return not (stat.S_ISREG(kind) or stat.S_ISDIR(kind))


def check_regular(path: Path, remedy: str) -> None:
    """Refuse a pipe, a socket or a device instead of a file, before it is opened.

    A missing file and a folder pass: their reader reports them.
    """
    special = False
    with contextlib.suppress(OSError, ValueError):
        special = is_special(path)
    if special:
        raise InputError(SPECIAL, where=str(path), allowed="a file", remedy=remedy)


def check_not_input(path: Path, inputs: Iterable[Path]) -> None:
    """Refuse to replace a file that the output is made from, by whatever name.

    Those that do not exist are passed over.
    """
    if not path.exists():
        return
    existing = (source for source in inputs if source.exists())
    if any(path.samefile(source) for source in existing):
        fault = "this is a file that the output is made from"
        raise InputError(fault, where=str(path), remedy="Choose another name; it would be lost.")


def check_new_file(path: Path, *, force: bool, inputs: Iterable[Path] = ()) -> None:
    """Refuse a file that cannot be made, before anything is computed for it.

    That is an input that it is made from, part of a study, no regular file, a file that exists
    unless `force` is set, and a name in a folder that is missing or cannot be written to.
    """
    folder = path.parent
    where = str(path)
    check_no_zero_byte(where)
    check_not_input(path, inputs)
    is_study_file = path.name in STUDY_FILES
    if is_study_file and any((folder / name).exists() for name in (MANIFEST, DATABASE)):
        fault = f"{path.name} is a file of the study in this folder"
        raise InputError(fault, where=where, remedy="Choose another name; the study would be lost.")
    if path.is_dir():
        raise InputError(
            "this is a folder",
            where=where,
            allowed="a file",
            remedy="Add the name of a file to it.",
        )
    check_regular(path, "Choose another name.")
    if path.exists() and not force:
        raise InputError(
            "the file exists",
            where=where,
            remedy="Choose another name, or replace it with --force.",
        )
    if not folder.is_dir():
        remedy = "Make that folder first, or choose another one."
        raise InputError(f"there is no folder '{folder}'", where=where, remedy=remedy)
    try:
        temporary = unfinished(path)
        temporary.touch()
        temporary.unlink()
    except OSError as error:
        remedy = "Choose another folder, or ask for the right to write there."
        if error.errno == errno.ENAMETOOLONG:
            remedy = SHORTER
        raise InputError(
            f"nothing can be written there ({error.strerror})", where=where, remedy=remedy
        ) from None


@contextmanager
def new_file(path: Path, *, force: bool) -> Iterator[Path]:
    """Give a temporary path to write to.

    It takes its proper name when the block is left without an error.

    The path is in the same folder, so that the change of name is one step; it is removed if the
    block fails. InputError if the system refuses to write, or if a file has appeared meanwhile,
    which is kept without `force`.
    """
    temporary = unfinished(path)
    try:
        yield temporary
        if force:
            temporary.replace(path)
            return
        try:
            os.link(temporary, path)  # in one step, where the file system has hard links
        except OSError:
            if path.exists():
                raise FileExistsError from None
            temporary.replace(path)
    except FileExistsError:
        raise InputError(
            "the file has appeared since this command began, and is kept",
            where=str(path),
            remedy="Another command has the same output. Choose another name and run again.",
        ) from None
    except OSError as error:
        raise InputError(
            f"the file was not written ({error.strerror or error})",
            where=str(path),
            remedy="Make room there or choose another folder; nothing partial was left behind.",
        ) from error
    finally:
        temporary.unlink(missing_ok=True)


def write_new(path: Path, content: str | bytes, *, force: bool) -> None:
    """Write a file whole or not at all, as `new_file` does; text in UTF-8."""
    with new_file(path, force=force) as temporary:
        if isinstance(content, bytes):
            temporary.write_bytes(content)
        else:
            temporary.write_text(content, encoding="utf-8", errors="backslashreplace")


def unfinished(path: Path) -> Path:
    """A name in the same folder for a file that is being written; no other command has it."""
    # Of a long name a part: it may take all the bytes that a name can have.
    return path.with_name(f".{path.name[:40]}.{uuid.uuid4().hex}{UNFINISHED}")


def check_no_zero_byte(name: str) -> None:
    """Refuse a character that no path may contain, before anything is computed for it."""
    if "\0" in name:
        raise InputError(
            f"{name!r} holds a zero byte", allowed="text without it", remedy="Write the name anew."
        )


@contextmanager
def reading(path: Path, remedy: str) -> Iterator[None]:
    """Turn any error of the libraries that read a file or folder into one that names it as damaged.

    Errors of the system and of memory are reported elsewhere.
    """
    try:
        yield
    except (InputError, MemoryError):
        raise
    except Exception as error:
        if (
            isinstance(error, OSError) and error.errno is not None
        ):  # libraries use the class for damage too
            raise
        fault = f"it is damaged ({type(error).__name__}: {on_one_line(error)})"
        raise InputError(fault, where=str(path), remedy=remedy) from error
