"""The files that loads are read from: path, units, and the numbers that a header announces; shared by all readers."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from macroslip.errors import InputError
from macroslip.files import check_regular

#: Advice for a file that no reader understands.
DAMAGED = "Write or copy the file again; macroslip loads inspect shows what it holds."
#: Values that a header may announce; more must be damage.
MOST_VALUES = 500_000_000

RPM = math.pi / 30.0
#: Units of channels, and the factor that gives SI.
FORCE = {"N": 1.0, "kN": 1e3}
MOMENT = {"Nm": 1.0, "kNm": 1e3}
SPEED = {"rpm": RPM, "rad/s": 1.0, "deg/s": math.pi / 180.0}
ANGLE = {"deg": math.pi / 180.0, "rad": 1.0}


def source_file(
    path: str | os.PathLike[str], kinds: Mapping[str, str], remedy: str = ""
) -> tuple[Path, str]:
    """Return the path and its lower-case extension, which has to be among `kinds`; they name the content of a file.

    `remedy` is what to do about another extension.
    """
    path = Path(path)
    check_regular(path, "Name a file with loads.")
    if not path.is_file():
        what = "is a folder, not a file" if path.is_dir() else "no such file"
        raise InputError(
            what, where=str(path), remedy=f"Check the path; the current folder is {Path.cwd()}."
        )
    extension = path.suffix.lower()
    # Bladed numbers its groups of results: run.%23 and run.$23.
    numbered = re.fullmatch(r"\.[%$](\d{1,4}|pj)", extension)
    if extension not in kinds and not (numbered and ".%nn" in kinds):
        allowed = ", ".join(f"{ext} ({meaning})" for ext, meaning in kinds.items())
        raise InputError(
            f"the extension {path.suffix!r} is not known",
            where=str(path),
            allowed=allowed,
            remedy=remedy,
        )
    if path.stat().st_size == 0:
        raise InputError(
            "the file is empty", where=str(path), remedy="Write or copy the file again."
        )
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


def in_si(
    values: ArrayLike,
    unit: str,
    factors: Mapping[str, float],
    *,
    channel: str,
    where: str,
    remedy: str = "Convert the channel.",
) -> NDArray[np.float64]:
    """Values of a channel in SI units; InputError if its unit is none of those in `factors`."""
    if unit not in factors:
        what = f"channel {channel} has the unit {unit or 'none'}"
        raise InputError(what, where=where, allowed=", ".join(factors), remedy=remedy)
    return np.asarray(values, dtype=np.float64) * factors[unit]


def announced(path: Path, number: DTypeLike | None, count: int, header: str, again: str) -> NDArray:
    """`count` numbers, binary or (None) text, which must fill the file; `header` names where they are announced."""
    if number is not None:
        size, full = path.stat().st_size, count * np.dtype(number).itemsize
        if size == full:
            return np.fromfile(path, number)
        state = "cut off" if size < full else "damaged"
        what = f"the file is {state}: {header} announces {full} bytes, it has {size}"
        raise InputError(what, where=str(path), remedy=again)
    try:
        values = np.array(path.read_text(encoding="ascii").split(), dtype=np.float64)
    except ValueError as error:
        raise InputError(
            f"not readable as numbers ({error})", where=str(path), remedy=again
        ) from error
    if values.size != count:
        what = f"the file holds {values.size} numbers, {header} announces {count}"
        raise InputError(what, where=str(path), remedy=again)
    return values


def turn_to_fixed(
    along_ya: NDArray | float, along_za: NDArray | float, azimuth: NDArray | float
) -> tuple[NDArray, NDArray]:
    """Components along the non-rotating y and z from those in the rotating shaft axes, at the azimuth ψ [rad].

    y = y_a cos ψ − z_a sin ψ, z = y_a sin ψ + z_a cos ψ; ψ = 0 with blade 1 up, increasing with rotation about +x.

    Examples
    --------
    A quarter of a turn after blade 1 was up, the rotating z axis points to −y:

    >>> y, z = turn_to_fixed(0.0, 1.0, math.pi / 2)
    >>> round(float(y), 12), round(float(z), 12)
    (-1.0, 0.0)
    """
    cos, sin = np.cos(azimuth), np.sin(azimuth)
    return along_ya * cos - along_za * sin, along_ya * sin + along_za * cos
