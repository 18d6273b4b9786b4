"""Tables of OpenFAST, binary or text, read by the official reader once it is sure that the file is whole."""

from __future__ import annotations

import contextlib
import io
import struct
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from macroslip.errors import InputError


def read_output(path: Path) -> tuple[list[str], list[str], NDArray]:
    """Names, units and columns of all channels, the time among them.

    Raises
    ------
    InputError
        The file is cut off or damaged.
    """
    return _read_binary(path) if path.suffix.lower() == ".outb" else _read_text(path)


def _read_binary(path: Path) -> tuple[list[str], list[str], NDArray]:
    from openfast_io.FAST_output_reader import load_binary_output

    actual, expected = path.stat().st_size, _binary_size(path)
    # Some versions of OpenFAST write more bytes than their header announces; the official reader leaves them.
    if actual < expected:
        raise InputError(
            f"the file is cut off: its header announces {expected} bytes, it has {actual}",
            where=str(path),
            remedy="Copy the file again, or run OpenFAST again.",
        )
    try:
        # A scale of zero makes values that are not finite; those are reported with their channel and time.
        with np.errstate(all="ignore"):
            data, info, _ = load_binary_output(str(path))
    except Exception as error:  # the reader raises any error of its parsing
        raise InputError(
            f"not readable as OpenFAST binary output ({error})",
            where=str(path),
            remedy="Copy the file again, or run OpenFAST again.",
        ) from error
    return info["attribute_names"], info["attribute_units"], data


def _binary_size(path: Path) -> int:
    """Size [bytes] the file must have by its own header: the official reader trusts the counts in it."""
    damaged = InputError(
        "the header is not that of an OpenFAST binary file",
        where=str(path),
        allowed="file formats 1 to 4 of OpenFAST",
        remedy="Text output must be named .out; otherwise copy the file again or run OpenFAST again.",
    )
    with path.open("rb") as file:

        def take(layout: str) -> tuple:
            return struct.unpack("<" + layout, file.read(struct.calcsize("<" + layout)))

        try:
            (file_format,) = take("h")
            if file_format not in (1, 2, 3, 4):
                raise damaged
            name_length = take("h")[0] if file_format == 4 else 10
            channels, samples, *_ = take("iidd")
            if min(name_length, channels, samples) < 1:
                raise damaged
            packed = file_format != 3
            file.seek(8 * channels if packed else 0, io.SEEK_CUR)
            (description,) = take("i")
        except struct.error:
            raise InputError(
                "the file is cut off within its header",
                where=str(path),
                remedy="Copy the file again, or run OpenFAST again.",
            ) from None
        if description < 0:
            raise damaged
        header = file.tell() + description + 2 * (channels + 1) * name_length
        return header + samples * ((4 if file_format == 1 else 0) + channels * (2 if packed else 8))


def _read_text(path: Path) -> tuple[list[str], list[str], NDArray]:
    from openfast_io.FAST_output_reader import load_ascii_output

    with path.open("rb") as file:
        if b"\0" in file.read(1024):
            raise InputError("not a text file", where=str(path), remedy="Name binary output .outb.")
    try:
        with _plain_text(path) as plain:
            data, info = load_ascii_output(str(plain))
    except Exception as error:  # the reader raises any error of its parsing
        raise InputError(
            f"not readable as OpenFAST text output ({_first_bad_line(path) or error})",
            where=str(path),
            remedy="If the run was stopped or the copy cut off, delete the incomplete last line; otherwise run OpenFAST "
            "again.",
        ) from error
    names, units = info["attribute_names"], info["attribute_units"]
    if not names or data.ndim != 2 or data.shape[1] != len(names) or len(units) != len(names):
        raise InputError(
            f"not an OpenFAST text output: {len(names)} channel names, {len(units)} units, data of shape {data.shape}",
            where=str(path),
            allowed="6 lines of description, a line of names, a line of units, then the data",
            remedy="Copy the file again, or run OpenFAST again.",
        )
    _check_last_line(path)
    return names, units, data


@contextlib.contextmanager
def _plain_text(path: Path) -> Iterator[Path]:
    """The file itself, or a copy in ASCII: the official reader takes the encoding of the system it runs on.

    Older versions write units such as kN·m in Latin-1.
    """
    content = path.read_bytes()
    if content.isascii():
        yield path
        return
    try:
        text = content.decode("utf-8")
    except UnicodeDecodeError:
        text = content.decode("latin-1")
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / path.name
        copy.write_bytes(text.replace("·", "-").encode("ascii", "replace"))
        yield copy


def _check_last_line(path: Path) -> None:
    # A line cut within its last number still parses. OpenFAST ends every line, and all data lines are equally long.
    with path.open("rb") as file:
        lines = file.read().splitlines(keepends=True)[-2:]
    if not lines[-1].endswith((b"\n", b"\r")) and len(lines[-1]) < len(lines[-2].rstrip(b"\r\n")):
        raise InputError(
            "the last line is cut off",
            where=str(path),
            remedy="Copy the file again, run OpenFAST again, or delete that line.",
        )


def _first_bad_line(path: Path) -> str:
    """Which line of a text output is at fault, or an empty string when none is (the file is not text at all)."""
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    width = len(lines[6].split()) if len(lines) > 6 else 0
    for number, line in enumerate(lines[8:], start=9):
        values = line.split()
        if len(values) != width:
            return f"line {number} has {len(values)} values for {width} channels"
        for value in values:
            try:
                float(value)
            except ValueError:
                return f"line {number} holds {value!r} instead of a number"
    return ""
