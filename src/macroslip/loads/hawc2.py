"""Hub loads from the output of HAWC2: ``.sel`` with ``.dat`` (text or binary), or the HDF5 format gtsdf.

HAWC2 writes the channels that the user's input file lists. Needed are force and moment at the hub's end of the shaft in the shaft's
own axes, and the bearing's angle and speed:

    mbdy forcevec shaft 4 2 shaft ;
    mbdy momentvec shaft 4 2 shaft ;
    constraint bearing1 shaft_rot 2 ;

with the number of the shaft's last element in place of 4. The speed of the rotor (``aero omega``) serves instead,
or may be given. Of several nodes that with the highest number is taken, the hub's end.

The axes of the main body ``shaft`` turn with the rotor. At angle zero x' points to the left (looking downwind), y' down
and z' upwind along the shaft, as in the usual models, so that in the axes of `HubLoads` (x, y, z) = (−z', x', −y'), and
the angle of the bearing turns y and z back. An internal force has either sign, depending on the side of the cut. The
weight of the rotor decides: it has to give a mean fz below zero.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from macroslip.errors import InputError
from macroslip.loads.source_file import (
    ANGLE,
    FORCE,
    MOMENT,
    MOST_VALUES,
    SPEED,
    announced,
    in_si,
    turn_to_fixed,
)

_REMEDY = (
    "Add to the output section of the .htc file\n  mbdy forcevec shaft N 2 shaft ;\n  mbdy momentvec shaft N 2 shaft ;\n"
    "  constraint bearing1 shaft_rot 2 ;\nwith the number of the shaft's last element for N, and run HAWC2 again."
)
_AGAIN = "Copy the file again, or run HAWC2 again."
#: Part of the mean force in the bearing's plane that has to point down for the weight to decide sign and angle.
_DOWN = 0.9


class _Output(NamedTuple):
    """Channels of an output file and their values (n, channels)."""

    names: list[str]
    units: list[str]
    descriptions: list[str]
    values: NDArray
    time: NDArray
    where: str

    def in_si(self, index: int, factors: Mapping[str, float]) -> NDArray[np.float64]:
        """Values (n,) of a channel in SI units."""
        name, unit = self.names[index].strip(), self.units[index].strip()
        return in_si(self.values[:, index], unit, factors, channel=name, where=self.where)


def read_hawc2(path: Path, *, speed_needed: bool = True) -> dict:
    """Read time (n,) [s], shaft_speed (n,) [rad/s], force (n, 3) [N], moment (n, 3) [N m] and `reading`, their channels.

    Without a channel for it, `shaft_speed` is left out unless it is needed. Raises InputError if the file is cut off or
    damaged, lacks a channel, or its forces do not show the rotor's weight.
    """
    if path.suffix.lower() == ".dat":
        path = _beside(
            path, ".sel", "A .dat file is read as HAWC2 output: copy the list of channels too."
        )
    output = _read_gtsdf(path) if path.suffix.lower() in (".hdf5", ".h5") else _read_sel(path)
    force, node = _vector(output, "force", FORCE)
    moment, _ = _vector(output, "moment", MOMENT, node)
    angle = _channel(output, r"angle(?!\s*_?speed)", ANGLE, prefix="bea|bearing|shaft_rot")
    if angle is None:
        raise InputError(
            "there is no angle of the shaft's bearing", where=output.where, remedy=_REMEDY
        )
    force, moment, turned = _to_fixed(force, moment, angle[0], output.where)
    how = f"turned back by {turned[0]} {angle[1]}, sign {turned[1]} by the rotor's weight"
    reading = [f"force and moment: main body shaft, node {node}, {how}"]
    result = {"time": output.time, "force": force, "moment": moment}
    speed = _channel(output, r"omega|rotor speed|angle_?\s*speed", SPEED)
    if speed is None and speed_needed:
        allowed = "constraint bearing1 of the shaft, or aero omega"
        remedy = "Add one of them to the output section, or give the speed: loads.shaft_speed."
        raise InputError(
            "there is no speed of the shaft", where=output.where, allowed=allowed, remedy=remedy
        )
    if speed is not None:
        result["shaft_speed"] = np.abs(speed[0]) if np.all(speed[0] <= 0.0) else speed[0]
        reading.append(f"shaft speed: {speed[1]}")
    return result | {"reading": tuple(reading)}


def _vector(
    output: _Output, kind: str, factors: Mapping[str, float], node: int | None = None
) -> tuple[NDArray[np.float64], int]:
    """Components x', y', z' of the shaft's force or moment (n, 3) at a node, or at the last one there is."""
    letter = kind[0].upper()
    found: dict[int, dict[str, int]] = {}
    for i, (name, text) in enumerate(zip(output.names, output.descriptions, strict=True)):
        axis = re.match(rf"{letter}([xyz])\s+coo:\s*shaft\b", name.strip(), re.IGNORECASE)
        body = re.search(r"mbdy:\s*shaft\s+nodenr:\s*(\d+)", text, re.IGNORECASE)
        if axis and body:
            found.setdefault(int(body[1]), {})[axis[1].lower()] = i
    whole = [number for number, axes in found.items() if len(axes) == 3]
    if not whole or (node is not None and node not in whole):
        at = f" at node {node}, where the force is given" if node is not None and whole else ""
        what = f"there is no {kind} of the main body shaft in its own axes{at} ({len(output.names)} channels)"
        allowed = f"{letter}x, {letter}y and {letter}z with 'coo: shaft' and 'Mbdy:shaft' in the description"
        raise InputError(what, where=output.where, allowed=allowed, remedy=_REMEDY)
    node = max(whole) if node is None else node
    return np.column_stack([output.in_si(found[node][axis], factors) for axis in "xyz"]), node


def _channel(
    output: _Output, pattern: str, factors: Mapping[str, float], prefix: str = ""
) -> tuple[NDArray[np.float64], str] | None:
    for i, (name, text) in enumerate(zip(output.names, output.descriptions, strict=True)):
        both = f"{name} {text}"
        if re.search(pattern, both, re.IGNORECASE) and re.search(prefix, both, re.IGNORECASE):
            return output.in_si(i, factors), f"{name.strip()} ({text.strip()})"
    return None


def _to_fixed(
    force: NDArray, moment: NDArray, angle: NDArray, where: str
) -> tuple[NDArray, NDArray, tuple[str, str]]:
    """Force and moment in axes that do not turn, with the direction of the angle and the sign that the weight gives."""
    best = None
    for direction in (1.0, -1.0):
        turned = [_turned(vector, direction * angle) for vector in (force, moment)]
        mean_y, mean_z = turned[0][:, 1].mean(), turned[0][:, 2].mean()
        size = np.hypot(mean_y, mean_z)
        if best is None or size > best[0]:
            best = size, mean_z, direction, turned
    size, mean_z, direction, turned = best
    if not np.isfinite(size) or size == 0.0 or abs(mean_z) < _DOWN * size:
        raise InputError(
            f"the weight of the rotor cannot be seen: the force across the shaft has a mean of {size:.4g} N, of which "
            f"{mean_z:.4g} N along the vertical",
            where=where,
            allowed="a main body shaft with y' down and z' upwind at angle zero, and gravity",
            remedy="If your model has other axes, write the loads as a table with columns fx_N … mz_Nm instead.",
        )
    sign = -1.0 if mean_z > 0.0 else 1.0
    words = "+" if direction > 0.0 else "−", "+" if sign > 0.0 else "−"
    return sign * turned[0], sign * turned[1], words


def _turned(vector: NDArray, angle: NDArray) -> NDArray:
    y, z = turn_to_fixed(vector[:, 0], -vector[:, 1], angle)
    return np.column_stack([-vector[:, 2], y, z])


def _read_sel(path: Path) -> _Output:
    if path.stat().st_size > 50_000_000:
        raise InputError(
            "the list of channels is larger than 50 MB",
            where=str(path),
            remedy="Check that it is one.",
        )
    lines = path.read_text(encoding="latin-1").splitlines()
    try:
        start = next(i for i, line in enumerate(lines) if line.split()[:2] == ["Scans", "Channels"])
        scans, channels, duration, kind = lines[start + 1].split()
        scans, channels, duration = int(scans), int(channels), float(duration)
        if not (0 < scans * channels <= MOST_VALUES and 0.0 < duration < np.inf) or kind not in (
            "ASCII",
            "BINARY",
        ):
            raise ValueError(f"{scans} scans of {channels} channels in {duration} s, format {kind}")
        rows = [line for line in lines[start + 2 :] if re.match(r"\s*\d+\s+\S", line)][:channels]
        # Name, unit and description of a channel are in fixed columns.
        columns = [
            (line[12:43].strip(), line[43:54].strip(), line[54:].strip())
            for line in map(str.expandtabs, rows)
        ]
        names, units, texts = zip(*columns, strict=True)
        if len(rows) != channels:
            raise ValueError(f"{len(rows)} channels are listed, {channels} are announced")
        numbers = [
            line.split()[0] for line in lines if re.fullmatch(r"\s*[-+]?\d\.\d+E[-+]\d+\s*", line)
        ]
        if kind == "BINARY" and len(numbers) < channels:
            raise ValueError(f"{len(numbers)} scale factors for {channels} channels")
        scale = np.array(numbers[-channels:], dtype=np.float64) if kind == "BINARY" else None
    except (StopIteration, ValueError, IndexError) as error:
        what = f"not readable as a list of channels of HAWC2 ({error or 'no line with Scans and Channels'})"
        raise InputError(what, where=str(path), remedy=_AGAIN) from error
    data = _beside(path, ".dat", "Copy the data file too.")
    count, header = scans * channels, "the list of channels"
    values = announced(data, None if scale is None else "<i2", count, header, _AGAIN)
    values = (
        values.reshape(scans, channels)
        if scale is None
        else values.reshape(channels, scans).T * scale
    )
    if names[0].strip().lower() == "time":
        time = _announced_time(
            values[:, 0], duration, 0.0 if scale is None else abs(float(scale[0])), data
        )
    else:
        time = np.arange(scans) * duration / scans
    return _Output(list(names), list(units), list(texts), values, time, str(path))


def _beside(path: Path, extension: str, remedy: str) -> Path:
    """The file of the same output with another extension, in whatever case it is written."""
    found = (
        one
        for one in path.parent.iterdir()
        if one.stem == path.stem and one.suffix.lower() == extension
    )
    for one in found:
        if one.is_file():
            return one
    raise InputError(
        f"there is no {path.stem}{extension} beside it", where=str(path), remedy=remedy
    )


def _announced_time(
    stamps: NDArray, duration: float, resolution: float, data: Path
) -> NDArray[np.float64]:
    """Times of the samples, which have to last as long as the list of channels announces.

    16 bits resolve the time of a long run to more than a step, so that binary times are taken as equal steps.
    """
    # Some programs announce the time from first to last sample, others one step more.
    near = 2.5 * duration / stamps.size + resolution + 1e-3
    if min(abs(stamps[-1] - stamps[0] - duration), abs(stamps[-1] - duration)) > near:
        what = f"its time goes from {stamps[0]:.6g} s to {stamps[-1]:.6g} s, the list of channels announces {duration:g} s"
        raise InputError(what, where=str(data), remedy=_AGAIN)
    if not resolution:
        return stamps
    even = np.linspace(stamps[0], stamps[-1], stamps.size)
    if np.abs(stamps - even).max() > 2.0 * resolution:
        raise InputError(
            "the samples of its time are not equally spaced", where=str(data), remedy=_AGAIN
        )
    return even


def _read_gtsdf(path: Path) -> _Output:
    import h5py

    from macroslip.hdf5_file import check_hdf5

    check_hdf5([path], _AGAIN)
    try:
        with h5py.File(path, "r") as file:
            if str(_plain(file.attrs.get("type", ""))).lower() != "general time series data format":
                raise ValueError("its type is not 'General time series data format'")
            names, units, texts = (
                [str(_plain(one)) for one in np.asarray(file[f"attribute_{kind}"])]
                for kind in ("names", "units", "descriptions")
            )
            blocks = [file[f"block{i:04d}"] for i in range(int(file.attrs["no_blocks"]))]
            values = np.concatenate([_block_values(block) for block in blocks])
            time = np.concatenate([_block_time(block) for block in blocks])
    except (OSError, KeyError, ValueError, TypeError) as error:
        raise InputError(
            f"not readable as HAWC2 output in the format gtsdf ({error})",
            where=str(path),
            remedy=_AGAIN,
        ) from error
    if values.shape != (time.size, len(names)):
        what = f"data of shape {values.shape} for {time.size} times and {len(names)} channels"
        raise InputError(what, where=str(path), remedy=_AGAIN)
    return _Output(names, units, texts, values, time, str(path))


def _plain(value: object) -> object:
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else value


def _block_values(block) -> NDArray[np.float64]:
    data = block["data"]
    values = data[:].astype(np.float64)
    if "gains" not in block:
        return values
    if data.dtype.kind in "iu":
        # The largest number that fits means that there is no value.
        values[data[:] == np.iinfo(data.dtype).max] = np.nan
    return values * block["gains"][:] + block["offsets"][:]


def _block_time(block) -> NDArray[np.float64]:
    start, step = (
        float(block.attrs.get("time_start", 0.0)),
        float(block.attrs.get("time_step", 1.0)),
    )
    if "time" in block:
        return (
            block["time"][:] * step + start
            if "time_step" in block.attrs
            else block["time"][:] + start
        )
    return start + step * np.arange(block["data"].shape[0])
