"""Hub loads from an OpenFAST output file, binary (``.outb``) or text (``.out``).

Channels, by the names of ElastoDyn's output list (upper and lower case are the same; documented
aliases are accepted):

=========================  =======================================
shaft speed                RotSpeed
force (x, y, z)            LSShftFxa, LSShftFys, LSShftFzs
moment at the hub centre   LSShftMxa, LSSTipMys, LSSTipMzs
=========================  =======================================

Where a pair in the non-rotating axes is absent, the pair in the rotating axes (LSShftFya,
LSShftFza; LSSTipMya, LSSTipMza) is turned by the channel Azimuth. This supposes ``AzimB1Up = 0`` in
the ElastoDyn file: the rotating axes coincide with the non-rotating ones when blade 1 is up, and
the azimuth written to the file is then AzimB1Up. Turned forces whose mean does not point down are
refused.

OpenFAST turns the sign of a channel that is asked for with -, _ or m before its name; the sign is
turned back. If the distance from the hub to the strain gauge is known, the moments there
(LSSGagMys, LSSGagMzs) serve in place of those at the hub. The units written in the file are used.
Text output holds four significant digits as a rule; prefer the binary one.

The official reader, openfast_io, reads a binary file once it is sure that the file is whole.
"""

from __future__ import annotations

import io
import re
import struct
from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from macroslip.arrays import FloatArray
from macroslip.errors import InputError
from macroslip.loads.source_file import (
    ANGLE,
    FORCE,
    MOMENT,
    SPEED,
    Samples,
    in_si,
    numbers,
    text_lines,
    turn_to_fixed,
)

_TIME = {"s": 1.0, "sec": 1.0}
_THRUST = ("LSShftFxa", "LSShftFxs", "LSSGagFxa", "LSSGagFxs", "RotThrust")
_TORQUE = ("LSShftMxa", "LSShftMxs", "LSSGagMxa", "LSSGagMxs", "RotTorq", "LSShftTq")
_SPEED = ("RotSpeed", "LSSTipVxa", "LSSTipVxs", "LSSTipV")
_AZIMUTH = ("Azimuth", "LSSTipPxa", "LSSTipPxs", "LSSTipP")
# The shear force is constant along the shaft, so the strain gauge's is the hub's. Its bending
# moment is not.
_SHEAR = (("LSShftFys", "LSSGagFys"), ("LSShftFzs", "LSSGagFzs"))
_ROTATING_SHEAR = (("LSShftFya", "LSSGagFya"), ("LSShftFza", "LSSGagFza"))
_BENDING = (("LSSTipMys",), ("LSSTipMzs",))
_ROTATING_BENDING = (("LSSTipMya",), ("LSSTipMza",))
_GAUGE_BENDING = (("LSSGagMys",), ("LSSGagMzs",))
_ROTATING_GAUGE_BENDING = (("LSSGagMya",), ("LSSGagMza",))
#: Names of the channels that give a quantity of a table of hub loads, in axes that do not turn.
FIXED_CHANNELS = {
    "time": ("Time",),
    "rotor_speed": _SPEED,
    "fx": _THRUST,
    "fy": _SHEAR[0],
    "fz": _SHEAR[1],
    "mx": _TORQUE,
    "my": _BENDING[0],
    "mz": _BENDING[1],
}
#: Wind at the hub, as InflowWind has it; without a lateral channel its speed is the one downwind.
_WIND = ("Wind1VelX", "WindHubVelX")
_LATERAL_WIND = ("Wind1VelY", "WindHubVelY")
#: Letters before a name by which OpenFAST is asked for the negative of a channel.
_MINUS = ("-", "_", "m")

_TURNING_CHANNELS = (
    _AZIMUTH,
    *_ROTATING_SHEAR,
    *_ROTATING_BENDING,
    *_GAUGE_BENDING,
    *_ROTATING_GAUGE_BENDING,
)
_LOAD_CHANNELS = {
    name.lower() for names in (*FIXED_CHANNELS.values(), *_TURNING_CHANNELS) for name in names
}

_MEANING = {
    "RotSpeed": "(rpm); rotor speed",
    "LSShftFxa": "(kN); shaft thrust force",
    "LSShftFys": "(kN); shaft shear force along ys, non-rotating",
    "LSShftFzs": "(kN); shaft shear force along zs, non-rotating",
    "LSShftMxa": "(kN-m); shaft torque",
    "LSSTipMys": "(kN-m); shaft bending moment at the hub about ys, non-rotating",
    "LSSTipMzs": "(kN-m); shaft bending moment at the hub about zs, non-rotating",
}
_AGAIN = "Copy the file again, or run OpenFAST again."
#: Distance of a strain gauge from the hub [m] that is none: text has four digits.
_SHORT = 0.05
#: Part of the squares of a change of moments that the distance may leave unexplained.
_SAME_CHANGE = 0.01
#: Lines of a text file among which that of the names is searched.
_LONGEST_HEAD = 100
_INVALID = (
    "OpenFAST writes INVALID for a channel that it cannot compute with this model; "
    "check that ElastoDyn is in use."
)


def read_openfast(path: Path, *, speed_needed: bool = True, at_hub: bool = True) -> dict:
    """Hub loads of an OpenFAST output file.

    Parameters
    ----------
    path : Path
        File ``.outb`` or ``.out``.
    speed_needed : bool
        Whether the shaft's speed is read; a file without a channel for it is then refused.
    at_hub : bool
        Whether moments must be those at the hub; otherwise those at the strain gauge will do.

    Returns
    -------
    dict
        `time` (n,) [s], `shaft_speed` (n,) [rad/s] if it is needed, `force` (n, 3) [N], `moment`
        (n, 3) [N m] and `reading`, the channels they are from.

    Raises
    ------
    InputError
        If the file is cut off or damaged, lacks a channel (the error gives the lines to add to the
        output list), declares a unit that is not known, or a channel holds what is no number.
    """
    return loads_from_channels(read_channels(path), speed_needed=speed_needed, at_hub=at_hub)


def read_channels(path: Path) -> Channels:
    """All channels of an output file; InputError if it is cut off or damaged."""
    if path.suffix.lower() == ".outb":
        return _read_binary(path)
    return _read_text(path)


def gauge_distance(channels: Channels) -> float | None:
    """Distance [m] of the shaft's strain gauge behind the hub, None without moments at both.

    Between both the moment changes by d x̂ × F, with which d is fitted by least squares. It is
    OpenFAST's ShftGagL, negative for a rotor downwind of the tower. None as well if the change is
    another one, as with a channel in another unit than it says.
    """
    # What these channels hold must not matter to loads that are read from others.
    others = Channels(channels.names, channels.units, channels.samples, channels.where)
    try:
        fy, fz = others.across(_SHEAR, _ROTATING_SHEAR, FORCE)
        hub_y, hub_z = others.across(_BENDING, _ROTATING_BENDING, MOMENT)
        gauge_y, gauge_z = others.across(_GAUGE_BENDING, _ROTATING_GAUGE_BENDING, MOMENT)
    except InputError:
        return None
    if others.missing:
        return None
    across = np.concatenate([fz, -fy])
    change = np.concatenate([gauge_y - hub_y, gauge_z - hub_z])
    squares = across @ across
    if not squares > 0.0:
        return None
    distance = float(change @ across / squares)
    residual = change - distance * across
    is_alike = residual @ residual < _SAME_CHANGE * (change @ change)
    return distance if is_alike else None


def is_load_channel(name: str) -> bool:
    """True if loads at the hub may be read from a channel of this name, or from its negative."""
    name = name.lower()
    if name in _LOAD_CHANNELS:
        return True
    return name.startswith(_MINUS) and name[1:] in _LOAD_CHANNELS


def mean_wind_speed(channels: Channels) -> float | None:
    """Mean of the horizontal wind speed [m/s] at the hub, None without a channel for it."""
    if not channels.has_all((_WIND,)):
        return None
    downwind = channels.column(_WIND, {"m/s": 1.0})
    lateral = channels.column(_LATERAL_WIND, {"m/s": 1.0})
    speed = np.hypot(downwind, lateral)
    return float(speed.mean())


def loads_from_channels(channels: Channels, *, speed_needed: bool, at_hub: bool = True) -> dict:
    """Hub loads from channels with OpenFAST's names, as `read_openfast` returns them."""
    loads = {"time": channels.column(("Time",), _TIME)}
    if speed_needed:
        loads["shaft_speed"] = channels.column(_SPEED, SPEED)
    thrust = channels.column(_THRUST, FORCE)
    shear = channels.across(_SHEAR, _ROTATING_SHEAR, FORCE)
    torque = channels.column(_TORQUE, MOMENT)
    bending_pairs = (_BENDING, _ROTATING_BENDING)
    if not at_hub and not any(map(channels.has_all, bending_pairs)):
        bending_pairs = (_GAUGE_BENDING, _ROTATING_GAUGE_BENDING)
    bending = channels.across(*bending_pairs, MOMENT)
    channels.raise_if_missing()
    if not channels.has_all(_SHEAR):
        _check_weight(*shear, channels.where)
    distance = gauge_distance(channels)
    if distance is not None and distance < -_SHORT:
        raise InputError(
            f"the strain gauge on the shaft is {-distance:.3g} m upwind of the hub by the moments "
            "at both: the rotor is downwind of the tower",
            where=channels.where,
            allowed="rotors upwind of the tower",
            remedy="The statics of the shaft hold for those; give loads on the bearing instead.",
        )
    return loads | {
        "force": np.column_stack([thrust, *shear]),
        "moment": np.column_stack([torque, *bending]),
        "reading": tuple(channels.taken),
    }


class Channels:
    """Columns by name and unit; remembers missing channels, so that one error names them all.

    Parameters
    ----------
    names, units : list of str
        Of all channels, the time among them.
    samples : Samples
        Their values.
    where : str
        The file, for errors.
    """

    def __init__(self, names: list[str], units: list[str], samples: Samples, where: str):
        self.names = names
        self.units = units
        self.samples = samples
        self.where = where
        #: Index and sign of a channel by its name in lower case; of two, the first.
        self.index: dict[str, tuple[int, float]] = {}
        for i, name in enumerate(map(str.lower, names)):
            self.index.setdefault(name, (i, 1.0))
        for i, name in enumerate(map(str.lower, names)):
            if name.startswith(_MINUS):
                self.index.setdefault(name[1:], (i, -1.0))
        #: Channels that are missing, and the names they were looked for by.
        self.missing: dict[str, str] = {}
        self.taken: list[str] = []

    def has_all(self, quantities: tuple[tuple[str, ...], ...]) -> bool:
        """True if each quantity has a channel under one of its names."""
        return all(any(alias.lower() in self.index for alias in aliases) for aliases in quantities)

    def column(self, aliases: tuple[str, ...], factors: Mapping[str, float]) -> FloatArray:
        """Values (n,) of a channel in SI units; zeros, and an entry in `missing`, without it."""
        alias = next((alias for alias in aliases if alias.lower() in self.index), None)
        if alias is None:
            self.missing[aliases[0]] = " or ".join(aliases)
            return np.zeros(len(self.samples.values))
        i, sign = self.index[alias.lower()]
        name = self.names[i]
        unit = re.sub("[-·* ()]", "", self.units[i])
        turned = ", its sign turned back" if sign < 0.0 else ""
        shown_unit = self.units[i].strip("()")
        self.taken.append(f"{name} ({shown_unit}){turned}")
        remedy = "OpenFAST itself writes kN, kN-m, rpm and deg; convert the channel."
        # OpenFAST writes INVALID without the brackets that its reader takes away.
        if unit.upper() in ("INVALID", "NVALI"):
            unit = "INVALID"
            remedy = _INVALID
        values = sign * self.samples.channel(i, name, self.where)
        return in_si(values, unit, factors, channel=name, where=self.where, remedy=remedy)

    def across(
        self,
        fixed: tuple[tuple[str, ...], ...],
        rotating: tuple[tuple[str, ...], ...],
        factors: Mapping[str, float],
    ) -> tuple[FloatArray, FloatArray]:
        """Components along y and z, from the non-rotating pair or else from the rotating pair."""
        if self.has_all(fixed):
            y_name, z_name = fixed
            y = self.column(y_name, factors)
            return y, self.column(z_name, factors)
        if self.has_all((*rotating, _AZIMUTH)):
            y = self.column(rotating[0], factors)
            z = self.column(rotating[1], factors)
            azimuth = self.column(_AZIMUTH, ANGLE)
            first, second, turned_by = self.taken[-3:]
            self.taken[-3:] = [f"{first} and {second} turned by {turned_by}"]
            return turn_to_fixed(y, z, azimuth)
        for aliases in fixed:
            if not self.has_all((aliases,)):
                first = rotating[0][0]
                second = rotating[1][0]
                turned = f"{first}, {second} and {_AZIMUTH[0]}"
                self.missing[aliases[0]] = f"{' or '.join(aliases)} (or {turned})"
        nothing = np.zeros(len(self.samples.values))
        return nothing, nothing

    def raise_if_missing(self) -> None:
        """InputError that names all missing channels, with the lines for OpenFAST's output list."""
        if not self.missing:
            return
        if "time" not in self.index:
            remedy = "This is not an OpenFAST time series."
            raise InputError("there is no channel Time", where=self.where, remedy=remedy)
        meanings = []
        for name in self.missing:
            quoted = f'"{name}"'.ljust(16)
            meanings.append(f"{quoted}- {_MEANING[name]}")
        lines = "\n".join(meanings)
        gauge = []
        for name in self.names:
            lower_name = name.lower()
            if lower_name.startswith("lssgagm") and lower_name[7] in "yz":
                gauge.append(name)
        note = ""
        if gauge and any(name.startswith("LSSTip") for name in self.missing):
            note = (
                f" The file's {' and '.join(gauge)} cannot stand in: they belong to the strain "
                "gauge, not to the hub. They serve if its distance behind the hub, ShftGagL, is "
                "given: loads.hub_to_output."
            )
        are = "are" if len(self.missing) > 1 else "is"
        raise InputError(
            f"of the channels needed, {', '.join(self.missing)} {are} not in the file "
            f"({len(self.names)} channels)",
            where=self.where,
            allowed=f"{'; '.join(self.missing.values())}, in upper or lower case.{note}",
            remedy=f"Add to the OutList of the ElastoDyn input file\n{lines}\n"
            "and run OpenFAST again.",
        )


def _check_weight(fy: NDArray, fz: NDArray, where: str) -> None:
    """InputError if forces that were turned back do not point down on average."""
    # The file does not contain AzimB1Up. Other than zero, it turns the rotor's weight away from -z.
    mean_y = float(fy.mean())
    mean_z = float(fz.mean())
    if np.isfinite(mean_y + mean_z) and mean_z >= -abs(mean_y):
        raise InputError(
            "LSShftFya and LSShftFza turned by Azimuth do not point down: mean fy "
            f"{mean_y:.4g} N, mean fz {mean_z:.4g} N, where the weight of the rotor should give a "
            "negative fz",
            where=where,
            allowed="AzimB1Up = 0 in the ElastoDyn input file, and gravity",
            remedy="Add LSShftFys, LSShftFzs, LSSTipMys and LSSTipMzs to the OutList and run "
            "OpenFAST again.",
        )


def _read_binary(path: Path) -> Channels:
    """All channels of a binary file, the time among them."""
    from openfast_io.FAST_output_reader import load_binary_output

    actual = path.stat().st_size
    expected = _binary_size(path)
    # Some versions of OpenFAST write more bytes than their header announces; the official reader
    # leaves them.
    if actual < expected:
        fault = f"the file is cut off: its header announces {expected} bytes, it has {actual}"
        raise InputError(fault, where=str(path), remedy=_AGAIN)
    try:
        data, info, _ = load_binary_output(str(path))
    except Exception as error:  # the reader raises any error of its parsing
        fault = f"not readable as OpenFAST binary output ({error})"
        raise InputError(fault, where=str(path), remedy=_AGAIN) from error
    channel_names = info["attribute_names"]
    units = info["attribute_units"]
    return Channels(channel_names, units, Samples(data), str(path))


def _binary_size(path: Path) -> int:
    """Size [bytes] the file must have by its header, whose counts the official reader trusts."""
    damaged = InputError(
        "the header is not that of an OpenFAST binary file",
        where=str(path),
        allowed="file formats 1 to 4 of OpenFAST",
        remedy="Text output must be named .out; otherwise copy the file again or run OpenFAST "
        "again.",
    )
    with path.open("rb") as file:

        def take(layout: str) -> tuple:
            """The next numbers of the file."""
            little_endian = "<" + layout
            size = struct.calcsize(little_endian)
            return struct.unpack(little_endian, file.read(size))

        try:
            (file_format,) = take("h")
            if file_format not in (1, 2, 3, 4):
                raise damaged
            name_length = 10
            if file_format == 4:
                (name_length,) = take("h")
            channels, samples, *_ = take("iidd")
            if min(name_length, channels, samples) < 1:
                raise damaged
            packed = file_format != 3
            scale_bytes = 8 * channels if packed else 0
            file.seek(scale_bytes, io.SEEK_CUR)
            (description,) = take("i")
        except struct.error:
            raise InputError(
                "the file is cut off within its header", where=str(path), remedy=_AGAIN
            ) from None
        if description < 0:
            raise damaged
        names_and_units = 2 * (channels + 1) * name_length
        header = file.tell() + description + names_and_units
        time_bytes = 4 if file_format == 1 else 0
        number_bytes = 2 if packed else 8
        sample_bytes = time_bytes + channels * number_bytes
        return header + samples * sample_bytes


def _read_text(path: Path) -> Channels:
    """All channels of a text file, the time among them."""
    content = path.read_bytes()
    lines = text_lines(content)
    if any("\0" in line for line in lines[:_LONGEST_HEAD]):
        raise InputError("not a text file", where=str(path), remedy="Name binary output .outb.")
    while lines and not lines[-1].strip():
        lines.pop()
    head = _head(lines, path)
    names = lines[head].split()
    units = lines[head + 1].split()
    rows = [number for number in range(head + 2, len(lines)) if lines[number].strip()]
    values = np.empty((len(rows), len(names)))
    unreadable: dict[int, str] = {}
    for row, number in enumerate(rows):
        words = lines[number].split()
        if len(words) != len(names):
            raise InputError(
                f"not readable as OpenFAST text output (line {number + 1} has {len(words)} values "
                f"for {len(names)} channels)",
                where=str(path),
                remedy="If the run was stopped or the copy cut off, delete the incomplete last "
                "line; otherwise choose a wider OutFmt and run OpenFAST again.",
            )
        values[row], strange = numbers(words)
        for channel, word in strange.items():
            unreadable.setdefault(channel, f"{word} (line {number + 1})")
    # A line cut within its last number still parses. OpenFAST ends every line, and all data lines
    # are equally long.
    has_end = content.endswith((b"\n", b"\r"))
    last_line = lines[-1]
    whole_line = lines[-2].rstrip()
    if not has_end and len(last_line) < len(whole_line):
        remedy = "Copy the file again, run OpenFAST again, or delete that line."
        raise InputError("the last line is cut off", where=str(path), remedy=remedy)
    return Channels(names, units, Samples(values, unreadable), str(path))


def _head(lines: list[str], path: Path) -> int:
    """Index of the line of names, which begins with Time, with a line of units and data below.

    OpenFAST writes six lines before it, the first one empty, which editors and archives lose.
    """
    fault = "there is no channel Time that begins a line of names above a line of units"
    words = [line.split() for line in lines[:_LONGEST_HEAD]]
    for index, (names, units) in enumerate(pairwise(words)):
        begins_with_time = bool(names) and names[0].lower() == "time"
        if begins_with_time and units[:1] and units[0].startswith("("):
            has_data = index + 2 < len(lines)
            if len(units) == len(names) and has_data:
                return index
            fault = (
                f"{len(names)} channel names, {len(units)} units, {len(lines) - index - 2} lines "
                "of data"
            )
    raise InputError(
        f"not an OpenFAST text output: {fault}",
        where=str(path),
        allowed="some lines of description, a line of names, a line of units, then the data",
        remedy=_AGAIN,
    )
