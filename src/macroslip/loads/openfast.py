"""Hub loads from an OpenFAST output file, binary (``.outb``) or text (``.out``).

Channels, by the names of ElastoDyn's output list (upper and lower case are the same; documented aliases are accepted):

=========================  ================================================================================
shaft speed                RotSpeed
force (x, y, z)            LSShftFxa, LSShftFys, LSShftFzs
moment at the hub centre   LSShftMxa, LSSTipMys, LSSTipMzs
=========================  ================================================================================

Where a pair in the non-rotating axes is absent, the pair in the rotating axes (LSShftFya, LSShftFza; LSSTipMya,
LSSTipMza) is turned by the channel Azimuth. This supposes ``AzimB1Up = 0`` in the ElastoDyn file: the rotating axes
coincide with the non-rotating ones when blade 1 is up, and the azimuth written to the file is then AzimB1Up.
Turned forces whose mean does not point down are refused. The units written in the file are used. Text output holds
four significant digits as a rule; prefer the binary one.

The official reader, openfast_io, reads a binary file once it is sure that the file is whole.
"""

from __future__ import annotations

import io
import struct
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from macroslip.errors import InputError
from macroslip.loads.source_file import ANGLE, FORCE, SPEED, in_si, turn_to_fixed


def _in_brackets(factors: Mapping[str, float]) -> dict[str, float]:
    return {f"({unit})": factor for unit, factor in factors.items()}


_FORCES, _SPEEDS, _ANGLES = _in_brackets(FORCE), _in_brackets(SPEED), _in_brackets(ANGLE)
_MOMENTS, _TIMES = {"(N-m)": 1.0, "(kN-m)": 1e3}, {"(s)": 1.0, "(sec)": 1.0}

_THRUST = ("LSShftFxa", "LSShftFxs", "LSSGagFxa", "LSSGagFxs", "RotThrust")
_TORQUE = ("LSShftMxa", "LSShftMxs", "LSSGagMxa", "LSSGagMxs", "RotTorq", "LSShftTq")
_SPEED = ("RotSpeed", "LSSTipVxa", "LSSTipVxs", "LSSTipV")
_AZIMUTH = ("Azimuth", "LSSTipPxa", "LSSTipPxs", "LSSTipP")
# The shear force is constant along the shaft, so the strain gauge's is the hub's. Its bending moment is not.
_SHEAR = (("LSShftFys", "LSSGagFys"), ("LSShftFzs", "LSSGagFzs"))
_ROTATING_SHEAR = (("LSShftFya", "LSSGagFya"), ("LSShftFza", "LSSGagFza"))
_BENDING = (("LSSTipMys",), ("LSSTipMzs",))
_ROTATING_BENDING = (("LSSTipMya",), ("LSSTipMza",))

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
_INVALID = "OpenFAST writes INVALID for a channel that it cannot compute with this model; check that ElastoDyn is in use."


def read_openfast(path: Path, *, speed_needed: bool = True) -> dict:
    """Read time (n,) [s], shaft_speed (n,) [rad/s], force (n, 3) [N], moment (n, 3) [N m] and `reading`, their channels.

    Without a channel for it, `shaft_speed` is left out unless it is needed. Raises InputError if the file is cut off or
    damaged, lacks a channel (the error gives the lines to add to the output list), or declares a unit that is not
    known.
    """
    channels = _Channels(
        *(_read_binary if path.suffix.lower() == ".outb" else _read_text)(path), str(path)
    )
    found = {"time": channels.column(("Time",), _TIMES)}
    if speed_needed or channels.has_all((_SPEED,)):
        found["shaft_speed"] = channels.column(_SPEED, _SPEEDS)
    thrust = channels.column(_THRUST, _FORCES)
    shear = channels.across(_SHEAR, _ROTATING_SHEAR, _FORCES)
    torque = channels.column(_TORQUE, _MOMENTS)
    bending = channels.across(_BENDING, _ROTATING_BENDING, _MOMENTS)
    channels.raise_if_missing()
    if not channels.has_all(_SHEAR):
        _check_weight(*shear, str(path))
    return found | {
        "force": np.column_stack([thrust, *shear]),
        "moment": np.column_stack([torque, *bending]),
        "reading": tuple(channels.taken),
    }


class _Channels:
    """Columns by name and unit; remembers missing channels, so that one error names them all."""

    def __init__(self, names: list[str], units: list[str], data: NDArray, where: str):
        self.names, self.units, self.data, self.where = names, units, data, where
        self.index = {name.lower(): i for i, name in reversed(list(enumerate(names)))}
        #: Channels that were not found, and the names they were looked for by.
        self.missing: dict[str, str] = {}
        self.taken: list[str] = []

    def has_all(self, quantities: tuple[tuple[str, ...], ...]) -> bool:
        return all(any(alias.lower() in self.index for alias in aliases) for aliases in quantities)

    def column(self, aliases: tuple[str, ...], factors: Mapping[str, float]) -> NDArray[np.float64]:
        found = next((alias for alias in aliases if alias.lower() in self.index), None)
        if found is None:
            self.missing[aliases[0]] = " or ".join(aliases)
            return np.zeros(len(self.data))
        i = self.index[found.lower()]
        name, unit = self.names[i], self.units[i]
        self.taken.append(f"{name} ({unit})")
        remedy = "OpenFAST itself writes kN, kN-m, rpm and deg; convert the channel."
        # OpenFAST writes INVALID without the brackets that its reader takes away.
        if unit.upper() in ("INVALID", "NVALI"):
            unit, remedy = "INVALID", _INVALID
        unit = f"({unit.replace('·', '-').replace('*', '-').replace(' ', '-')})"
        return in_si(self.data[:, i], unit, factors, channel=name, where=self.where, remedy=remedy)

    def across(
        self,
        fixed: tuple[tuple[str, ...], ...],
        rotating: tuple[tuple[str, ...], ...],
        factors: Mapping[str, float],
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The components along y and z, from the non-rotating pair or else from the rotating pair."""
        if self.has_all(fixed):
            return self.column(fixed[0], factors), self.column(fixed[1], factors)
        if self.has_all((*rotating, _AZIMUTH)):
            y, z = self.column(rotating[0], factors), self.column(rotating[1], factors)
            azimuth = self.column(_AZIMUTH, _ANGLES)
            self.taken[-3:] = [f"{self.taken[-3]} and {self.taken[-2]} turned by {self.taken[-1]}"]
            return turn_to_fixed(y, z, azimuth)
        for aliases in fixed:
            if not self.has_all((aliases,)):
                turned = f"{rotating[0][0]}, {rotating[1][0]} and {_AZIMUTH[0]}"
                self.missing[aliases[0]] = f"{' or '.join(aliases)} (or {turned})"
        return np.zeros(len(self.data)), np.zeros(len(self.data))

    def raise_if_missing(self) -> None:
        if not self.missing:
            return
        if "time" not in self.index:
            remedy = "This is not an OpenFAST time series."
            raise InputError("there is no channel Time", where=self.where, remedy=remedy)
        lines = "\n".join(
            f'"{name}"{" " * (14 - len(name))}- {_MEANING[name]}' for name in self.missing
        )
        gauge = [
            name
            for name in self.names
            if name.lower() in ("lssgagmys", "lssgagmzs", "lssgagmya", "lssgagmza")
        ]
        note = (
            f" The file's {' and '.join(gauge)} cannot stand in: they belong to the strain gauge, not to the hub."
            if gauge and any(name.startswith("LSSTip") for name in self.missing)
            else ""
        )
        raise InputError(
            f"of the channels needed, {', '.join(self.missing)} {'are' if len(self.missing) > 1 else 'is'} not in the "
            f"file ({len(self.names)} channels)",
            where=self.where,
            allowed=f"{'; '.join(self.missing.values())}, in upper or lower case.{note}",
            remedy=f"Add to the OutList of the ElastoDyn input file\n{lines}\nand run OpenFAST again.",
        )


def _check_weight(fy: NDArray, fz: NDArray, where: str) -> None:
    # The file does not contain AzimB1Up. A value other than zero turns the rotor's weight away from -z.
    mean_y, mean_z = float(fy.mean()), float(fz.mean())
    if np.isfinite(mean_y + mean_z) and mean_z >= -abs(mean_y):
        raise InputError(
            f"LSShftFya and LSShftFza turned by Azimuth do not point down: mean fy {mean_y:.4g} N, "
            f"mean fz {mean_z:.4g} N, where the weight of the rotor should give a negative fz",
            where=where,
            allowed="AzimB1Up = 0 in the ElastoDyn input file, and gravity",
            remedy="Add LSShftFys, LSShftFzs, LSSTipMys and LSSTipMzs to the OutList and run OpenFAST again.",
        )


def _read_binary(path: Path) -> tuple[list[str], list[str], NDArray]:
    """Names, units and columns of all channels, the time among them."""
    from openfast_io.FAST_output_reader import load_binary_output

    actual, expected = path.stat().st_size, _binary_size(path)
    # Some versions of OpenFAST write more bytes than their header announces; the official reader leaves them.
    if actual < expected:
        what = f"the file is cut off: its header announces {expected} bytes, it has {actual}"
        raise InputError(what, where=str(path), remedy=_AGAIN)
    try:
        data, info, _ = load_binary_output(str(path))
    except Exception as error:  # the reader raises any error of its parsing
        what = f"not readable as OpenFAST binary output ({error})"
        raise InputError(what, where=str(path), remedy=_AGAIN) from error
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
                "the file is cut off within its header", where=str(path), remedy=_AGAIN
            ) from None
        if description < 0:
            raise damaged
        header = file.tell() + description + 2 * (channels + 1) * name_length
        return header + samples * ((4 if file_format == 1 else 0) + channels * (2 if packed else 8))


def _read_text(path: Path) -> tuple[list[str], list[str], NDArray]:
    content = path.read_bytes()
    if b"\0" in content[:1024]:
        raise InputError("not a text file", where=str(path), remedy="Name binary output .outb.")
    try:
        text = content.decode("utf-8")
    except UnicodeDecodeError:
        text = content.decode("latin-1")  # older versions write units such as kN·m so
    lines = text.splitlines()
    names, units = (line.split() for line in [*lines, *[""] * 8][6:8])
    data = np.empty((max(0, len(lines) - 8), len(names)))
    if not names or len(units) != len(names) or not len(data):
        raise InputError(
            f"not an OpenFAST text output: {len(names)} channel names, {len(units)} units, {len(data)} lines of data",
            where=str(path),
            allowed="6 lines of description, a line of names, a line of units, then the data",
            remedy=_AGAIN,
        )
    for number, line in enumerate(lines[8:]):
        values, fault = line.split(), ""
        if len(values) != len(names):
            fault = f"has {len(values)} values for {len(names)} channels"
        else:
            try:
                data[number] = values
            except ValueError as error:
                fault = f"holds {str(error).rpartition(': ')[2]} instead of a number"
        if fault:
            what = f"not readable as OpenFAST text output (line {number + 9} {fault})"
            remedy = "If the run was stopped or the copy cut off, delete the incomplete last line"
            raise InputError(
                what, where=str(path), remedy=f"{remedy}; otherwise run OpenFAST again."
            )
    # A line cut within its last number still parses. OpenFAST ends every line, and all data lines are equally long.
    if not content.endswith((b"\n", b"\r")) and len(lines[-1]) < len(lines[-2].rstrip()):
        remedy = "Copy the file again, run OpenFAST again, or delete that line."
        raise InputError("the last line is cut off", where=str(path), remedy=remedy)
    return names, [unit[1:-1] for unit in units], data
