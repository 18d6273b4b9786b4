"""Hub loads from HAWC2 output: ``.sel`` with ``.dat`` (text or binary), or the HDF5 format gtsdf.

HAWC2 writes the channels that the user's input file lists. Needed are force and moment at the hub's
end of the shaft in the shaft's own axes, and the bearing's angle and speed:

    mbdy forcevec shaft 4 2 shaft ;
    mbdy momentvec shaft 4 2 shaft ;
    constraint bearing1 shaft_rot 2 ;

with the number of the shaft's last element in place of 4. The speed of the rotor (``aero omega``)
serves instead, or may be given.

A channel is taken by what its name and description say. The bearing is that called shaft_rot, or
else the only one that is not one of pitch or yaw. Of several nodes of the shaft one that is
labelled hub or rotor center is taken, or else that with the highest number, the hub's end. A node
1, or a label of something else, such as a main bearing, is not the hub: such loads are read if the
distance from the hub is given, and the moments are moved there.

The axes of the main body ``shaft`` turn with the rotor. At angle zero x' points to the left
(looking downwind), y' down and z' upwind along the shaft, as in the usual models, so that in the
axes of `HubLoads` (x, y, z) = (−z', x', −y'), and the angle of the bearing turns y and z back. An
internal force has either sign, depending on the side of the cut. The weight of the rotor decides:
it has to give a mean fz below zero. In public output of HAWC2 12.7 for the DTU 10 MW turbine the
moment at the main bearing, turned back so, is that of the overhung rotor and steady: my −7.64 MN m
with a deviation of 0.59 MN m, and 5.5 MN m if turned the other way.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from macroslip.arrays import FloatArray
from macroslip.errors import InputError
from macroslip.loads.source_file import (
    ANGLE,
    FORCE,
    MOMENT,
    MOST_VALUES,
    SPEED,
    Samples,
    announced_binary,
    announced_text,
    fortran_number,
    in_si,
    text_lines,
    turn_to_fixed,
)

_REMEDY = (
    "Add to the output section of the .htc file\n  mbdy forcevec shaft N 2 shaft ;\n"
    "  mbdy momentvec shaft N 2 shaft ;\n  constraint bearing1 shaft_rot 2 ;\n"
    "with the number of the shaft's last element for N, and run HAWC2 again."
)
_AGAIN = "Copy the file again, or run HAWC2 again."
#: Part of the mean force in the bearing's plane that has to point down for the weight to decide
#: sign and angle.
_DOWN = 0.9
#: Channels that are no motion of the shaft, though a word of theirs may say so: controllers,
#: states of bodies, and bearings of blades and nacelle.
_NOT_THE_SHAFT = r"^dll|mbdy|pitch|yaw|blade|teeter|filter|reference|error"
#: How the shaft's bearing is recognised, best first; bearing2 has an angle that is prescribed, as
#: pitch and yaw have.
_SHAFT_BEARING = ("shaft_rot", "shaft|rotor|drive", r"^bea(ring)?[13]\b", "")
#: Labels of the node at the hub's end of the shaft, and of a node that is none.
_THE_HUB = "hub|rotor cent(er|re)"
_NOT_THE_HUB = r"bearing|gear|generator|tower|yaw|nacelle|rear|\bmb\d?\b|\bbrg"


class _Channel(NamedTuple):
    """A channel of an output file."""

    index: int
    name: str
    unit: str
    description: str

    @property
    def text(self) -> str:
        """Name and description."""
        return f"{self.name} ({self.description})"

    def says(self, pattern: str) -> bool:
        """True if name or description have a pattern, in upper or lower case."""
        return any(
            re.search(pattern, text, re.IGNORECASE) for text in (self.name, self.description)
        )


class _Output(NamedTuple):
    """Channels of an output file and their values."""

    channels: list[_Channel]
    samples: Samples
    time: NDArray
    where: str

    def in_si(self, channel: _Channel, factors: Mapping[str, float]) -> FloatArray:
        """Values (n,) of a channel in SI units."""
        values = self.samples.channel(channel.index, channel.name, self.where)
        return in_si(values, channel.unit, factors, channel=channel.name, where=self.where)


class _Section(NamedTuple):
    """Section of the shaft at which its internal force and moment are written."""

    node: int
    label: str
    components: dict[str, _Channel]  #: By Fx … Mz, in the shaft's axes.

    def vector(self, output: _Output, kind: str) -> FloatArray:
        """Force F [N] or moment M [N m] (n, 3) in the shaft's axes."""
        factors = FORCE if kind == "F" else MOMENT
        components = [output.in_si(self.components[kind + axis], factors) for axis in "xyz"]
        return np.column_stack(components)

    @property
    def text(self) -> str:
        """Node and label."""
        text = f"node {self.node}"
        if self.label:
            text += f" ({self.label})"
        return text


def read_hawc2(path: Path, *, speed_needed: bool = True, at_hub: bool = True) -> dict:
    """Loads on the shaft from HAWC2 output.

    Parameters
    ----------
    path : Path
        File ``.sel``, ``.dat`` or ``.hdf5``.
    speed_needed : bool
        Whether the shaft's speed is read; a file without a channel for it is then refused.
    at_hub : bool
        Whether the loads must be those at the hub; otherwise any node of the shaft will do.

    Returns
    -------
    dict
        `time` (n,) [s], `shaft_speed` (n,) [rad/s] if it is needed, `force` (n, 3) [N], `moment`
        (n, 3) [N m] and `reading`, the channels they are from.

    Raises
    ------
    InputError
        If the file is cut off or damaged, a channel is missing or cannot be distinguished from others, the
        loads are not those at the hub, or the forces do not show the rotor's weight.
    """
    if path.suffix.lower() == ".dat":
        remedy = "A .dat file is read as HAWC2 output: copy the list of channels too."
        path = _beside(path, ".sel", remedy)
    is_gtsdf = path.suffix.lower() in (".hdf5", ".h5")
    output = _read_gtsdf(path) if is_gtsdf else _read_sel(path)
    section = _section(output, at_hub)
    angle = _shaft_angle(output)
    force, moment, turned = _to_fixed(
        section.vector(output, "F"),
        section.vector(output, "M"),
        output.in_si(angle, ANGLE),
        output.where,
    )
    reading = [
        f"force and moment: main body shaft, {section.text}, turned back by {turned[0]} "
        f"{angle.text}, sign {turned[1]} by the rotor's weight"
    ]
    result = {"time": output.time, "force": force, "moment": moment}
    if not speed_needed:
        return result | {"reading": tuple(reading)}
    speed = _shaft_speed(output, angle)
    if speed is None:
        raise InputError(
            "there is no speed of the shaft",
            where=output.where,
            allowed="constraint bearing1 of the shaft, or aero omega",
            remedy="Add one of them to the output section, or give the speed: loads.shaft_speed.",
        )
    values = output.in_si(speed, SPEED)
    result["shaft_speed"] = np.abs(values) if np.all(values <= 0.0) else values
    reading.append(f"shaft speed: {speed.text}")
    return result | {"reading": tuple(reading)}


def _section(output: _Output, at_hub: bool) -> _Section:
    """The section at the hub's end of the shaft or, if not `at_hub`, the one nearest to it."""
    sections: dict[int, _Section] = {}
    for channel in output.channels:
        component = re.match(r"([FM][xyz])\s+coo:\s*shaft\b", channel.name, re.IGNORECASE)
        body = re.search(
            r"mbdy:\s*shaft\s+nodenr:\s*(\d+)(?:\s*coo:\s*\S+)?(.*)",
            channel.description,
            re.IGNORECASE,
        )
        if component and body:
            node = int(body[1])
            label = body[2].strip()
            section = sections.setdefault(node, _Section(node, label, {}))
            name = component[1].capitalize()
            section.components[name] = channel
    known = list(sections.values())
    for kind, letter in (("force", "F"), ("moment", "M")):
        at_nodes = ""
        if known:
            at_nodes = f" at {_listed([candidate.text for candidate in known])}"
        names = [letter + axis for axis in "xyz"]
        known = [
            candidate for candidate in known if all(name in candidate.components for name in names)
        ]
        if not known:
            raise InputError(
                f"there is no {kind} of the main body shaft in its own axes{at_nodes} "
                f"({len(output.channels)} channels)",
                where=output.where,
                allowed=f"{letter}x, {letter}y and {letter}z with 'coo: shaft' and 'Mbdy:shaft' "
                "in the description",
                remedy=_REMEDY,
            )
    hubs = [candidate for candidate in known if re.search(_THE_HUB, candidate.label, re.IGNORECASE)]
    if hubs and not at_hub:
        raise InputError(
            f"the file has loads at the hub, {hubs[0].text}, and a distance from hub to output is "
            "given",
            where=output.where,
            remedy="Remove loads.hub_to_output.",
        )
    section = max(hubs or known, key=lambda candidate: candidate.node)
    elsewhere = re.search(_NOT_THE_HUB, section.label, re.IGNORECASE) or section.node == 1
    if at_hub and elsewhere and not hubs:
        raise InputError(
            f"the loads of the main body shaft are those at {section.text}, which is not the hub; "
            f"the file has them at {_listed([candidate.text for candidate in known])}",
            where=output.where,
            allowed="the shaft's last node, at the hub, without a label or with one that says hub",
            remedy=f"{_REMEDY} Or give the distance from the hub to that node, downwind: "
            "loads.hub_to_output.",
        )
    return section


def _shaft_angle(output: _Output) -> _Channel:
    """The angle of the bearing on the shaft."""
    angles = []
    for channel in output.channels:
        is_angle = channel.says("angle") and not channel.says("speed")
        if is_angle and channel.says("bea|shaft_rot"):
            angles.append(channel)
    possible = [channel for channel in angles if channel.unit in ANGLE]
    angle = _recognised(output, possible, _SHAFT_BEARING, "angle of the shaft's bearing")
    if angle is None:
        texts = [f"{channel.text} in {channel.unit}" for channel in angles]
        others = _listed(texts)
        raise InputError(
            f"there is no angle of the shaft's bearing{'; there is ' if others else ''}{others}",
            where=output.where,
            allowed=f"one in {' or '.join(ANGLE)} of a bearing that is none of pitch or yaw",
            remedy=_REMEDY,
        )
    return angle


def _shaft_speed(output: _Output, angle: _Channel) -> _Channel | None:
    """The speed of the bearing with this angle, or else of the rotor; None without either."""
    speeds = [
        channel
        for channel in output.channels
        if channel.unit in SPEED and channel.says(r"omega|rotor speed|angle_?\s*speed")
    ]
    bearing, *_ = (angle.description or angle.name).split()
    of_bearing = rf"^{re.escape(bearing)}\b"
    patterns = (of_bearing, "shaft_rot", "^omega$", "^rotor speed", "")
    return _recognised(output, speeds, patterns, "speed of the shaft")


def _recognised(
    output: _Output, candidates: Sequence[_Channel], patterns: Sequence[str], quantity: str
) -> _Channel | None:
    """The only candidate with the first pattern that any has; None if none moves with the shaft."""
    candidates = [channel for channel in candidates if not channel.says(_NOT_THE_SHAFT)]
    for pattern in patterns:
        matching = {
            channel.text: channel for channel in reversed(candidates) if channel.says(pattern)
        }
        if len(matching) > 1:
            raise InputError(
                f"{len(matching)} channels may be the {quantity}: "
                f"{_listed(list(reversed(matching)))}",
                where=output.where,
                allowed="one, or one that is called shaft_rot",
                remedy="Call the bearing on the shaft shaft_rot, or leave the others out of the "
                "output section.",
            )
        if matching:
            return next(iter(matching.values()))
    return None


def _listed(texts: Sequence[str]) -> str:
    """Up to eight texts in one line."""
    more = ""
    if len(texts) > 8:
        more = f" and {len(texts) - 8} more"
    return ", ".join(texts[:8]) + more


def _to_fixed(
    force: NDArray, moment: NDArray, angle: NDArray, where: str
) -> tuple[NDArray, NDArray, tuple[str, str]]:
    """Force and moment in axes that do not turn, and the signs of angle and loads.

    Of both directions of the angle that is taken in which the weight of the rotor rests the most.
    """
    directions = {"+": _turned(force, angle), "−": _turned(force, -angle)}
    sizes = {}
    for direction, vector in directions.items():
        mean_across = vector[:, 1:].mean(axis=0)
        sizes[direction] = np.hypot(*mean_across)
    direction = max(sizes, key=sizes.__getitem__)
    size = sizes[direction]
    fixed_force = directions[direction]
    mean_z = fixed_force[:, 2].mean()
    is_unknown = not np.isfinite(size) or size == 0.0
    if is_unknown or abs(mean_z) < _DOWN * size:
        raise InputError(
            f"the weight of the rotor cannot be seen: the force across the shaft has a mean of "
            f"{size:.4g} N, of which {mean_z:.4g} N along the vertical",
            where=where,
            allowed="a main body shaft with y' down and z' upwind at angle zero, and gravity",
            remedy="If your model has other axes, write the loads as a table with columns fx_N … "
            "mz_Nm instead.",
        )
    sign = -1.0 if mean_z > 0.0 else 1.0
    turned_by = angle if direction == "+" else -angle
    turned_moment = _turned(moment, turned_by)
    signs = (direction, "+" if sign > 0.0 else "−")
    return sign * fixed_force, sign * turned_moment, signs


def _turned(vector: NDArray, angle: NDArray) -> NDArray:
    """Vector (n, 3) in the axes of `HubLoads` from that in the shaft's, at an angle (n,) [rad]."""
    across = vector[:, 0]
    down = vector[:, 1]
    y, z = turn_to_fixed(across, -down, angle)
    return np.column_stack([-vector[:, 2], y, z])


def _read_sel(path: Path) -> _Output:
    """Output whose channels are listed in a .sel file."""
    if path.stat().st_size > 50_000_000:
        raise InputError(
            "the list of channels is larger than 50 MB",
            where=str(path),
            remedy="Check that it is one.",
        )
    try:
        lines = text_lines(path.read_bytes())
        shape, duration, channels, scale = _channel_list(lines)
    except (StopIteration, ValueError, IndexError) as error:
        cause = error or "no line with Scans and Channels"
        raise InputError(
            f"not readable as a list of channels of HAWC2 ({cause})",
            where=str(path),
            allowed="a list of channels as HAWC2 writes it, in the format ASCII or BINARY",
            remedy=f"{_AGAIN} Loads of another program: write a table with columns fx_N … mz_Nm.",
        ) from error
    data = _beside(path, ".dat", "Copy the data file too.")
    header = "the list of channels"
    if scale is None:
        samples = announced_text(data, shape, header, _AGAIN)
    else:
        packed = announced_binary(data, "<i2", shape[::-1], header, _AGAIN)
        samples = Samples(packed.T * scale)
    if channels[0].name.lower() == "time":
        resolution = 0.0
        if scale is not None:
            resolution = abs(float(scale[0]))
        stamps = samples.channel(0, channels[0].name, str(data))
        time = _announced_time(stamps, duration, resolution, data)
    else:
        scans = shape[0]
        time = np.arange(scans) * duration / scans
    return _Output(channels, samples, time, str(path))


def _channel_list(
    lines: Sequence[str],
) -> tuple[tuple[int, int], float, list[_Channel], NDArray | None]:
    """Shape (scans, channels), duration [s], channels and scale factors (channels,) of a .sel file.

    Scale factors are None for text. ValueError or StopIteration if it is none.
    """
    headings = ["Scans", "Channels"]
    start = next(i for i, line in enumerate(lines) if line.split()[:2] == headings)
    if "coordinate convention" in lines[start].lower():
        raise ValueError("it is BHawC's: its heading has a Coordinate convention and no Format")
    announcement = lines[start + 1].split()
    if len(announcement) != 4:
        raise ValueError(
            f"the line below Scans, Channels, Time and Format has {len(announcement)} words"
        )
    scans, count = map(int, announcement[:2])
    duration = fortran_number(announcement[2])
    kind = announcement[3]
    is_size = 0 < scans * count <= MOST_VALUES
    is_duration = 0.0 < duration < np.inf
    if not (is_size and is_duration) or kind not in ("ASCII", "BINARY"):
        raise ValueError(f"{scans} scans of {count} channels in {duration} s, format {kind}")
    below = lines[start + 2 :]
    rows = [line for line in below if re.match(r"\s*\d+\s+\S", line)][:count]
    if len(rows) != count:
        raise ValueError(f"{len(rows)} channels are listed, {count} are announced")
    # Name, unit and description of a channel are in fixed columns.
    channels = []
    for index, line in enumerate(map(str.expandtabs, rows)):
        name = line[12:43].strip()
        unit = line[43:54].strip()
        description = line[54:].strip()
        channels.append(_Channel(index, name, unit, description))
    if kind == "ASCII":
        return (scans, count), duration, channels, None
    factors = [
        line.split()[0] for line in lines if re.fullmatch(r"\s*[-+]?\d\.\d+E[-+]\d+\s*", line)
    ]
    if len(factors) < count:
        raise ValueError(f"{len(factors)} scale factors for {count} channels")
    factors_of_channels = np.array(factors[-count:], dtype=np.float64)
    return (scans, count), duration, channels, factors_of_channels


def _beside(path: Path, extension: str, remedy: str) -> Path:
    """The file of the same output with another extension, in whatever case it is written."""
    for neighbour in path.parent.iterdir():
        has_extension = neighbour.suffix.lower() == extension
        same_output = neighbour.stem == path.stem and has_extension
        if same_output and neighbour.is_file():
            return neighbour
    raise InputError(
        f"there is no {path.stem}{extension} beside it", where=str(path), remedy=remedy
    )


def _announced_time(stamps: NDArray, duration: float, resolution: float, data: Path) -> FloatArray:
    """Times of the samples, which have to last as long as the list of channels announces.

    16 bits resolve the time of a long run to more than a step, so that binary times are taken as
    equal steps.
    """
    # Some programs announce the time from first to last sample, others one step more.
    near = 2.5 * duration / stamps.size + resolution + 1e-3
    first = stamps[0]
    last = stamps[-1]
    span = last - first
    off = min(abs(span - duration), abs(last - duration))
    if off > near:
        fault = (
            f"its time goes from {stamps[0]:.6g} s to {stamps[-1]:.6g} s, the list of channels "
            f"announces {duration:g} s"
        )
        raise InputError(fault, where=str(data), remedy=_AGAIN)
    if not resolution:
        return stamps
    even = np.linspace(first, last, stamps.size)
    deviation = np.abs(stamps - even).max()
    if deviation > 2.0 * resolution:
        raise InputError(
            "the samples of its time are not equally spaced", where=str(data), remedy=_AGAIN
        )
    return even


def _read_gtsdf(path: Path) -> _Output:
    """Output in the format gtsdf, whose time is no channel."""
    import h5py

    from macroslip.storage.hdf5 import check_hdf5

    check_hdf5([path], _AGAIN)
    try:
        with h5py.File(path, "r") as file:
            kind = str(_plain(file.attrs.get("type", ""))).lower()
            if kind != "general time series data format":
                raise ValueError("its type is not 'General time series data format'")
            columns = []
            for kind_of_text in ("names", "units", "descriptions"):
                texts = np.asarray(file[f"attribute_{kind_of_text}"])
                columns.append([str(_plain(text)).strip() for text in texts])
            channels = [
                _Channel(index, *texts) for index, texts in enumerate(zip(*columns, strict=True))
            ]
            block_count = _plain(file.attrs["no_blocks"])
            blocks = [file[f"block{i:04d}"] for i in range(block_count)]
            values_of_blocks = [_block_values(block) for block in blocks]
            values = np.concatenate(values_of_blocks)
            time_of_blocks = [_block_time(block) for block in blocks]
            time = np.concatenate(time_of_blocks)
    except (OSError, KeyError, ValueError, TypeError) as error:
        raise InputError(
            f"not readable as HAWC2 output in the format gtsdf ({error})",
            where=str(path),
            remedy=_AGAIN,
        ) from error
    if values.shape != (time.size, len(channels)):
        fault = f"data of shape {values.shape} for {time.size} times and {len(channels)} channels"
        raise InputError(fault, where=str(path), remedy=_AGAIN)
    return _Output(channels, Samples(values), time, str(path))


def _plain(value: Any) -> Any:
    """Number or text of an attribute, which HAWC2 writes as an array with one element."""
    value = np.asarray(value).item()
    if isinstance(value, bytes):
        return value.decode("utf-8", "replace")
    return value


def _block_values(block) -> FloatArray:
    """Values (n, channels) of a block, unpacked."""
    data = block["data"]
    values = data[:].astype(np.float64)
    if "gains" not in block:
        return values
    if data.dtype.kind in "iu":
        # The largest number that fits means that there is no value.
        no_value = np.iinfo(data.dtype).max
        values[data[:] == no_value] = np.nan
    gains = block["gains"][:]
    return values * gains + block["offsets"][:]


def _block_time(block) -> FloatArray:
    """Times (n,) [s] of a block: in steps, counted in steps, or as such."""
    start = _plain(block.attrs.get("time_start", 0.0))
    step = _plain(block.attrs.get("time_step", 1.0))
    count = block["time"][:] if "time" in block else np.arange(block["data"].shape[0])
    return start + step * count
