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
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from macroslip.errors import InputError
from macroslip.loads.openfast_output import read_output
from macroslip.loads.turning import turn_to_fixed

_RPM = math.pi / 30.0
_FORCE_UNITS = {"N": 1.0, "kN": 1e3}
_MOMENT_UNITS = {"N-m": 1.0, "kN-m": 1e3}
_SPEED_UNITS = {"rpm": _RPM, "rad/s": 1.0, "deg/s": math.pi / 180.0}
_ANGLE_UNITS = {"deg": math.pi / 180.0, "rad": 1.0}
_TIME_UNITS = {"s": 1.0, "sec": 1.0}

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


def read_openfast(path: Path, *, speed_needed: bool = True) -> dict:
    """Read time (n,) [s], shaft_speed (n,) [rad/s], force (n, 3) [N] and moment (n, 3) [N m].

    Parameters
    ----------
    path : Path
    speed_needed : bool
        Whether the file has to hold the speed; otherwise `shaft_speed` is left out if it does not.

    Returns
    -------
    dict
        The arrays, and `reading`: the channels they come from.

    Raises
    ------
    InputError
        The file is cut off or damaged, lacks a channel (the error gives the lines to add to the output list), or
        declares a unit that is not known.
    """
    channels = _Channels(*read_output(path), str(path))
    time = channels.column(("Time",), _TIME_UNITS)
    with_speed = speed_needed or channels.has_all((_SPEED,))
    speed = {"shaft_speed": channels.column(_SPEED, _SPEED_UNITS)} if with_speed else {}
    thrust = channels.column(_THRUST, _FORCE_UNITS)
    shear = channels.across(_SHEAR, _ROTATING_SHEAR, _FORCE_UNITS)
    torque = channels.column(_TORQUE, _MOMENT_UNITS)
    bending = channels.across(_BENDING, _ROTATING_BENDING, _MOMENT_UNITS)
    channels.raise_if_missing()
    if not channels.has_all(_SHEAR):
        _check_weight(*shear, str(path))
    return {
        "time": time,
        **speed,
        "force": np.column_stack([thrust, *shear]),
        "moment": np.column_stack([torque, *bending]),
        "reading": tuple(channels.taken),
    }


class _Channels:
    """Columns by name and unit; remembers what was not found, so that one error names it all."""

    def __init__(self, names: list[str], units: list[str], data: NDArray, where: str):
        self.names, self.units, self.data, self.where = names, units, data, where
        self.index = {name.lower(): i for i, name in reversed(list(enumerate(names)))}
        self.missing: list[str] = []
        self.looked_for: list[str] = []
        self.taken: list[str] = []

    def has_all(self, quantities: tuple[tuple[str, ...], ...]) -> bool:
        return all(any(alias.lower() in self.index for alias in aliases) for aliases in quantities)

    def column(self, aliases: tuple[str, ...], factors: dict[str, float]) -> NDArray[np.float64]:
        found = next((alias for alias in aliases if alias.lower() in self.index), None)
        if found is None:
            self.missing.append(aliases[0])
            self.looked_for.append(" or ".join(aliases))
            return np.zeros(len(self.data))
        i = self.index[found.lower()]
        self.taken.append(f"{self.names[i]} ({self.units[i]})")
        unit = self.units[i].replace("·", "-").replace("*", "-").replace(" ", "-")
        if unit not in factors:
            # OpenFAST writes INVALID without the brackets that its reader takes away.
            invalid = unit.upper() in ("INVALID", "NVALI")
            raise InputError(
                f"channel {self.names[i]} has the unit ({'INVALID' if invalid else self.units[i]})",
                where=self.where,
                allowed=", ".join(f"({name})" for name in factors),
                remedy="OpenFAST writes INVALID for a channel that it cannot compute with this model; check that "
                "ElastoDyn is in use."
                if invalid
                else "OpenFAST itself writes kN, kN-m, rpm and deg; convert the channel.",
            )
        return self.data[:, i] * factors[unit]

    def across(
        self, fixed: tuple[tuple[str, ...], ...], rotating: tuple[tuple[str, ...], ...], factors: dict[str, float]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The components along y and z, from the non-rotating pair or else from the rotating pair."""
        if self.has_all(fixed):
            return self.column(fixed[0], factors), self.column(fixed[1], factors)
        if self.has_all((*rotating, _AZIMUTH)):
            y, z = self.column(rotating[0], factors), self.column(rotating[1], factors)
            azimuth = self.column(_AZIMUTH, _ANGLE_UNITS)
            self.taken[-3:] = [f"{self.taken[-3]} and {self.taken[-2]} turned by {self.taken[-1]}"]
            return turn_to_fixed(y, z, azimuth)
        for aliases in fixed:
            if not self.has_all((aliases,)):
                self.missing.append(aliases[0])
                turned = f"{rotating[0][0]}, {rotating[1][0]} and {_AZIMUTH[0]}"
                self.looked_for.append(f"{' or '.join(aliases)} (or {turned})")
        return np.zeros(len(self.data)), np.zeros(len(self.data))

    def raise_if_missing(self) -> None:
        if not self.missing:
            return
        if "time" not in self.index:
            raise InputError(
                "there is no channel Time", where=self.where, remedy="This is not an OpenFAST time series."
            )
        lines = "\n".join(f'"{name}"{" " * (14 - len(name))}- {_MEANING[name]}' for name in self.missing)
        gauge = [name for name in self.names if name.lower() in ("lssgagmys", "lssgagmzs", "lssgagmya", "lssgagmza")]
        note = (
            f" The file's {' and '.join(gauge)} cannot stand in: they belong to the strain gauge, not to the hub."
            if gauge and any(name.startswith("LSSTip") for name in self.missing)
            else ""
        )
        raise InputError(
            f"of the channels needed, {', '.join(self.missing)} {'are' if len(self.missing) > 1 else 'is'} not in the "
            f"file ({len(self.names)} channels)",
            where=self.where,
            allowed=f"{'; '.join(self.looked_for)}, in upper or lower case.{note}",
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
