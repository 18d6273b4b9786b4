"""The files that loads are read from: path, units, and the numbers that a header announces.

Shared by all readers.
"""

from __future__ import annotations

import codecs
import contextlib
import math
import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from macroslip.arrays import FloatArray
from macroslip.constants import RPM
from macroslip.errors import InputError, legible
from macroslip.storage.files import check_regular

#: Advice for a file that no reader understands.
DAMAGED = "Write or copy the file again; macroslip loads inspect shows what it holds."
#: Values that a header may announce; more must be damage.
MOST_VALUES = 500_000_000

#: Units of channels, and the factor that gives SI.
FORCE = {"N": 1.0, "kN": 1e3}
MOMENT = {"Nm": 1.0, "kNm": 1e3}
SPEED = {"rpm": RPM, "r/min": RPM, "rad/s": 1.0, "deg/s": math.pi / 180.0}
ANGLE = {"deg": math.pi / 180.0, "rad": 1.0}


def source_file(
    path: str | os.PathLike[str], kinds: Mapping[str, str], remedy: str = ""
) -> tuple[Path, str]:
    """Path and lower-case extension of a file, which has to be among the `kinds` of content.

    `remedy` is what to do about another extension.
    """
    path = Path(path)
    check_regular(path, "Name a file with loads.")
    if not path.is_file():
        fault = "is a folder, not a file" if path.is_dir() else "no such file"
        raise InputError(
            fault, where=str(path), remedy=f"Check the path; the current folder is {Path.cwd()}."
        )
    extension = path.suffix.lower()
    # Bladed numbers its groups of results: run.%23 and run.$23.
    numbered = re.fullmatch(r"\.[%$](\d{1,4}|pj)", extension)
    is_group_of_bladed = bool(numbered) and ".%nn" in kinds
    if extension not in kinds and not is_group_of_bladed:
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
    r"""Source of loads for what leaves this computer: of an absolute path the file's name only.

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
) -> FloatArray:
    """Values of a channel in SI units.

    Parameters
    ----------
    values : (n,) array
        In the channel's unit.
    unit : str
        The unit that the file declares.
    factors : mapping
        Known units, and the factors to SI.
    channel, where : str
        Name of the channel and of the file, for the error.
    remedy : str
        What to do about another unit.

    Returns
    -------
    ndarray, shape (n,)
        In the SI unit.

    Raises
    ------
    InputError
        If the unit is none of the known ones.
    """
    if unit not in factors:
        fault = f"channel {channel} has the unit {unit or 'none'}"
        raise InputError(fault, where=where, allowed=", ".join(factors), remedy=remedy)
    return np.asarray(values, dtype=np.float64) * factors[unit]


class Samples(NamedTuple):
    """Samples of all channels of a file, of which only those that are needed have to be numbers."""

    values: NDArray  #: Shape (samples, channels); NaN where the text is no number.
    #: First text of a channel that is no number, and where it is, by the channel's index.
    unreadable: Mapping[int, str] = {}
    #: What to do about such a text in a channel that is needed.
    remedy: str = (
        "Fortran writes asterisks where a number has more digits than its format; "
        "choose a wider format for the output and run the simulation again."
    )

    def channel(self, index: int, name: str, where: str) -> FloatArray:
        """Values (samples,) of a channel; InputError naming it if one of them is no number."""
        if index in self.unreadable:
            raise InputError(
                f"channel {name} holds {self.unreadable[index]}, which is no number",
                where=where,
                allowed="numbers in all channels that the loads are read from",
                remedy=self.remedy,
            )
        return np.asarray(self.values[:, index], dtype=np.float64)


def text_lines(content: bytes) -> list[str]:
    r"""Lines of a text file in UTF-8, UTF-16 with its mark, or else Latin-1.

    Lines end with LF, CR or both, as in bytes. In text, Python ends them at ten further characters,
    which a label or a description in another encoding may hold, such as byte 0x85.

    Examples
    --------
    >>> text_lines(b"one \x85 line\r\nnext")
    ['one \x85 line', 'next']
    """
    if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        content = content.decode("utf-16", "replace").encode()
    try:
        content.decode("utf-8")
        encoding = "utf-8"
    except UnicodeDecodeError:
        encoding = "latin-1"
    lines = content.removeprefix(codecs.BOM_UTF8).splitlines()
    return [line.decode(encoding) for line in lines]


def _in_fortran(text: str) -> bool:
    """False for what only Python takes for a number: 1_0 and digits of other scripts."""
    return text.isascii() and "_" not in text


def fortran_number(text: str) -> float:
    """Value of a number as Fortran writes it; ValueError if it is none.

    An exponent of three digits drives out its letter: 1.5-101 is 1.5e-101. D is an E.

    Examples
    --------
    >>> fortran_number("1.5-101"), fortran_number("-2.5D+02"), fortran_number("-.5E1")
    (1.5e-101, -250.0, -5.0)
    """
    if not _in_fortran(text):
        raise ValueError(f"{text!r} is no number of Fortran's")
    without_letter = re.fullmatch(r"([-+]?\d*\.\d*)([-+]\d{3})", text)
    if without_letter:
        return float("E".join(without_letter.groups()))
    return float(re.sub("[dD]", "E", text))


def numbers(words: Sequence[str]) -> tuple[FloatArray, dict[int, str]]:
    """Values of words, NaN for each that is no number, and those words by their index."""
    if _in_fortran("".join(words)):
        with contextlib.suppress(ValueError):
            return np.array(words, dtype=np.float64), {}
    values = np.full(len(words), np.nan)
    unreadable = {}
    for index, word in enumerate(words):
        try:
            values[index] = fortran_number(word)
        except ValueError:
            unreadable[index] = repr(legible(word, 40))
    return values, unreadable


def announced_binary(
    path: Path, number: DTypeLike, shape: tuple[int, int], header: str, again: str
) -> NDArray:
    """Binary numbers of a file that a header announces.

    Parameters
    ----------
    path : Path
        The file, which the numbers must fill.
    number : dtype
        Their type.
    shape : (int, int)
        Their shape.
    header : str
        Words for where the shape is announced.
    again : str
        Advice for a file that does not fit.

    Returns
    -------
    ndarray
        Of the announced shape.

    Raises
    ------
    InputError
        If the file does not hold what the header announces.
    """
    size = path.stat().st_size
    full = math.prod(shape) * np.dtype(number).itemsize
    if size == full:
        return np.fromfile(path, number).reshape(shape)
    state = "cut off" if size < full else "damaged"
    fault = f"the file is {state}: {header} announces {full} bytes, it has {size}"
    raise InputError(fault, where=str(path), remedy=again)


def announced_text(path: Path, shape: tuple[int, int], header: str, again: str) -> Samples:
    """Samples of a text file that a header announces.

    Parameters
    ----------
    path : Path
        The file, which the numbers must fill.
    shape : (int, int)
        Numbers of samples and of channels.
    header, again : str
        As in `announced_binary`.

    Returns
    -------
    Samples

    Raises
    ------
    InputError
        If the file does not hold what the header announces.
    """
    values, words = numbers(path.read_bytes().decode("ascii", "replace").split())
    if values.size != math.prod(shape):
        fault = f"the file holds {values.size} numbers, {header} announces {math.prod(shape)}"
        raise InputError(fault, where=str(path), remedy=again)
    unreadable: dict[int, str] = {}
    for index, word in words.items():
        sample, channel = divmod(index, shape[1])
        unreadable.setdefault(channel, f"{word} (sample {sample + 1})")
    return Samples(values.reshape(shape), unreadable)


def turn_to_fixed(
    along_ya: NDArray | float, along_za: NDArray | float, azimuth: NDArray | float
) -> tuple[NDArray, NDArray]:
    """Components along the non-rotating y and z from those in the rotating shaft axes.

    y = y_a cos ψ − z_a sin ψ, z = y_a sin ψ + z_a cos ψ at the azimuth ψ [rad]; ψ = 0 with blade 1
    up, increasing with rotation about +x.

    Examples
    --------
    A quarter of a turn after blade 1 was up, the rotating z axis points to −y:

    >>> y, z = turn_to_fixed(0.0, 1.0, math.pi / 2)
    >>> round(float(y), 12), round(float(z), 12)
    (-1.0, 0.0)
    """
    cos = np.cos(azimuth)
    sin = np.sin(azimuth)
    along_y = along_ya * cos - along_za * sin
    along_z = along_ya * sin + along_za * cos
    return along_y, along_z


def moment_at_hub(force: NDArray, moment: NDArray, hub_to_output: float) -> FloatArray:
    """Moment about the hub centre from that about a point behind it on the shaft.

    M_hub = M + d x̂ × F, with x̂ the shaft's axis, downwind, and no load on the shaft between.

    Parameters
    ----------
    force, moment : (n, 3) array [N], [N m]
        Force and moment of the rotor on the shaft, the moment about the point of output.
    hub_to_output : float [m]
        Distance d of this point from the hub centre, positive downwind.

    Returns
    -------
    (n, 3) array [N m]
        (mx, my − d fz, mz + d fy).

    Examples
    --------
    A rotor of 300 kN, two metres before the point of output, bends the shaft there by −600 kN m:

    >>> weight = np.array([[0.0, 0.0, -300e3]])
    >>> moment_at_hub(weight, np.array([[0.0, -600e3, 0.0]]), 2.0).tolist()
    [[0.0, 0.0, 0.0]]
    """
    arm = np.array([hub_to_output, 0.0, 0.0])
    return moment + np.cross(arm, force)
