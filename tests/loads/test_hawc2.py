"""HAWC2 output in the original layouts: lists of channels with text or binary data, and gtsdf."""

import os

import h5py
import numpy as np
import pytest

from macroslip.errors import InputError
from macroslip.loads import HubLoads

LINE = "_" * 120


@pytest.fixture
def truth(sample_outb):
    return HubLoads.read(sample_outb)


def _channels(truth, sign=1.0, direction=1.0, start=0.7, node="   5", label="hub end"):
    """Names, units, descriptions and values as HAWC2 gives them: main body shaft, axes that turn with the rotor."""
    time = truth.time - truth.time[0]
    angle = start + np.concatenate([[0.0], np.cumsum(truth.shaft_speed[:-1] * np.diff(time))])
    columns = {"Time": ("s", "Time", time)}
    cos, sin = np.cos(angle), np.sin(angle)
    for letter, unit, kind, vector in (
        ("F", "kN", "Force ", truth.force),
        ("M", "kNm", "Moment", truth.moment),
    ):
        x, y, z = sign * vector.T / 1e3
        # Left, up and downwind become x', −y' and −z', in axes that have turned by the angle about the downwind axis.
        left, up = y * cos + z * sin, -y * sin + z * cos
        for axis, values in zip("xyz", (left, -up, -x), strict=True):
            text = f"{kind}{letter}{axis} Mbdy:shaft nodenr:{node} coo: shaft  {label}"
            columns[f"{letter}{axis} coo: shaft"] = (unit, text, values)
    columns["bea1 angle"] = ("deg", "shaft_rot angle", direction * np.degrees(angle))
    columns["bea1 angle_speed"] = ("rpm", "shaft_rot angle speed", truth.shaft_speed * 30 / np.pi)
    return columns


def _write_sel(folder, columns, binary):
    values = np.column_stack([column for _, _, column in columns.values()])
    duration = np.ptp(columns["Time"][2])
    kind = "BINARY" if binary else "ASCII"
    lines = [
        LINE,
        "  Version ID : HAWC2MB 12.8",
        "   Time : 10:02:19",
        "   Date : 24:01.2023",
        LINE,
    ]
    lines += ["  Result file : ./run.dat", LINE, "   Scans    Channels    Time [sec]      Format"]
    lines += [
        f"{values.shape[0]:11d}{values.shape[1]:7d}{duration:15.3f}       {kind}",
        "",
        "  Channel   Variable Description",
        "",
    ]
    for number, (name, (unit, text, _)) in enumerate(columns.items(), start=1):
        lines.append(f"{number:6d}      {name:<31s}{unit:<11s}{text}")
    lines.append(LINE)
    if binary:
        scale = np.maximum(np.abs(values).max(axis=0) / 32000.0, 1e-12)
        lines += ["  Scale factors:", *(f"  {value:.5E}" for value in scale)]
        scale = np.array([float(f"{value:.5E}") for value in scale])
        (folder / "run.dat").write_bytes(np.round(values / scale).astype("<i2").T.tobytes())
    else:
        np.savetxt(folder / "run.dat", values, fmt="%14.6E")
    path = folder / "run.sel"
    path.write_text("\n".join(lines) + "\n")
    return path


def _write_gtsdf(folder, columns, packed, blocks=1):
    """Output in the format gtsdf, whose attributes HAWC2 12.7 writes as arrays of one element."""
    values = np.column_stack([column for name, (_, _, column) in columns.items() if name != "Time"])
    rest = {name: entry for name, entry in columns.items() if name != "Time"}
    path = folder / "run.hdf5"
    with h5py.File(path, "w") as file:
        file.attrs["type"] = "General time series data format"
        file.attrs["name"] = "run"
        file.attrs["no_blocks"] = np.array([blocks], dtype=np.int32)
        for kind, texts in (
            ("names", list(rest)),
            ("units", [unit for unit, _, _ in rest.values()]),
            ("descriptions", [text for _, text, _ in rest.values()]),
        ):
            file.create_dataset(
                f"attribute_{kind}", data=np.array([text.encode() for text in texts])
            )
        start = 0.0
        for number, part in enumerate(np.array_split(values, blocks)):
            block = file.create_group(f"block{number:04d}")
            block.attrs["time_start"] = np.array([start])
            block.attrs["time_step"] = np.array([0.05])
            start += 0.05 * len(part)
            if packed:
                offsets = part.mean(axis=0)
                gains = np.maximum(np.abs(part - offsets).max(axis=0) / 32000.0, 1e-12)
                packed_part = np.round((part - offsets) / gains).astype(np.int16)
                block.create_dataset("data", data=packed_part)
                block.create_dataset("gains", data=gains)
                block.create_dataset("offsets", data=offsets)
            else:
                block.create_dataset("data", data=part)
    return path


def _message(path, *words):
    with pytest.raises(InputError) as caught:
        HubLoads.read(path)
    assert [word for word in words if word not in str(caught.value)] == []
    return str(caught.value)


def _with_others(truth, *others):
    """Channels with others before them: name, unit and description; they hold 0.1 sin t."""
    columns = _channels(truth)
    time = {"Time": columns.pop("Time")}
    others = {name: (unit, text, 0.1 * np.sin(time["Time"][2])) for name, unit, text in others}
    return time | others | columns


def _check(read, truth, tolerance):
    np.testing.assert_allclose(read.force, truth.force, atol=tolerance * np.abs(truth.force).max())
    np.testing.assert_allclose(
        read.moment, truth.moment, atol=tolerance * np.abs(truth.moment).max()
    )
    np.testing.assert_allclose(read.shaft_speed, truth.shaft_speed, rtol=tolerance)
    assert read.time == pytest.approx(truth.time - truth.time[0], abs=1e-6)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("direction", [1.0, -1.0])
@pytest.mark.parametrize("binary", [False, True])
def test_list_of_channels(tmp_path, truth, sign, direction, binary):
    read = HubLoads.read(_write_sel(tmp_path, _channels(truth, sign, direction), binary))
    # The angle of 20 turns in 16 bits is good to 0.1 degrees.
    _check(read, truth, 3e-3 if binary else 1e-5)
    assert any("node 5" in line for line in read.reading)
    _check(HubLoads.read(tmp_path / "run.dat"), truth, 3e-3 if binary else 1e-5)


@pytest.mark.parametrize("packed", [False, True])
@pytest.mark.parametrize("blocks", [1, 3])
def test_gtsdf(tmp_path, truth, packed, blocks):
    path = _write_gtsdf(tmp_path, _channels(truth), packed, blocks)
    _check(HubLoads.read(path), truth, 3e-3 if packed else 1e-9)
    with h5py.File(path, "r+") as file:  # other programs write numbers
        for block in (file[name] for name in file if name.startswith("block")):
            block.attrs["time_start"] = float(block.attrs["time_start"][0])
            block.attrs["time_step"] = float(block.attrs["time_step"][0])
        file.attrs["no_blocks"] = blocks
    _check(HubLoads.read(path), truth, 3e-3 if packed else 1e-9)


@pytest.mark.parametrize(
    ("absent", "words"),
    [
        (["Fx coo: shaft"], ["no force of the main body shaft", "mbdy forcevec shaft"]),
        (["My coo: shaft"], ["no moment of the main body shaft in its own axes"]),
        (["bea1 angle"], ["no angle of the shaft's bearing"]),
        (["bea1 angle_speed"], ["no speed of the shaft", "loads.shaft_speed"]),
    ],
)
def test_channels_that_are_missing(tmp_path, truth, absent, words):
    columns = {name: entry for name, entry in _channels(truth).items() if name not in absent}
    path = _write_sel(tmp_path, columns, binary=False)
    message = _message(path)
    assert [word for word in words if word not in message] == []
    if absent == ["bea1 angle_speed"]:
        assert (HubLoads.read(path, shaft_speed=2.0).shaft_speed == 2.0).all()


def test_channels_of_the_speed_do_not_matter_where_the_speed_is_given(tmp_path, truth):
    columns = _channels(truth)
    del columns["bea1 angle_speed"]
    unit_and_text = ("rad/s", "Rotor speed")
    for name in ("Omega a", "Omega b"):
        columns[name] = (*unit_and_text, np.ones(truth.time.size))
    columns["Omega b"] = ("rad/s", "Rotor speed, low-speed side", np.ones(truth.time.size))
    path = _write_sel(tmp_path, columns, binary=False)
    _message(path, "2 channels may be the speed of the shaft")
    read = HubLoads.read(path, shaft_speed=2.0)
    assert (read.shaft_speed == 2.0).all()
    assert [line for line in read.reading if line.startswith("shaft speed")] == [
        "shaft speed: given, 2 rad/s"
    ]


def test_axes_in_which_the_weight_does_not_point_down(tmp_path, truth):
    columns = _channels(truth, start=0.7)
    unit, text, angle = columns["bea1 angle"]
    columns["bea1 angle"] = (unit, text, angle + 90.0)
    path = _write_sel(tmp_path, columns, binary=False)
    _message(path, "weight of the rotor cannot be seen", "table")


@pytest.mark.parametrize(
    ("binary", "length", "words"),
    [
        (True, -10, "cut off"),
        (False, -30, "the list of channels announces"),
        (True, None, "no run.dat beside it"),
    ],
)
def test_data_that_are_cut_off_or_absent(tmp_path, truth, binary, length, words):
    path = _write_sel(tmp_path, _channels(truth), binary)
    data = tmp_path / "run.dat"
    content = data.read_bytes()
    data.unlink()
    if length:
        data.write_bytes(content[:length])
    message = _message(path)
    assert words in message and (str(data) in message or not length)
    path.unlink()
    data.write_bytes(content)
    _message(data, "there is no run.sel beside it")


def test_a_list_that_is_none(tmp_path):
    path = tmp_path / "run.sel"
    path.write_text("nothing\n")
    _message(path, "not readable as a list of channels of HAWC2")


def test_an_hdf5_file_of_another_kind(tmp_path):
    path = tmp_path / "other.hdf5"
    with h5py.File(path, "w") as file:
        file["x"] = 1.0
    _message(path, "General time series")


@pytest.mark.parametrize(
    ("duration", "words"), [("20.000", "announces 20 s"), ("nan", "channels in nan s")]
)
def test_a_damaged_duration(tmp_path, truth, duration, words):
    path = _write_sel(tmp_path, _channels(truth), binary=True)
    path.write_text(path.read_text().replace("60.000", duration))
    _message(path, words)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (
            lambda time: np.append(time[:-1], time[-1] ^ 0x4000),
            "from 0 s to 29.28 s, the list of channels announces 60 s",
        ),
        (
            lambda time: np.append(time[0], np.append(time[1] ^ 0x0800, time[2:])),
            "are not equally spaced",
        ),
        (lambda time: time.byteswap(), "its time"),
    ],
)
def test_flipped_bits_and_swapped_bytes_in_the_time(tmp_path, truth, change, words):
    path = _write_sel(tmp_path, _channels(truth), binary=True)
    values = np.fromfile(tmp_path / "run.dat", "<i2").reshape(-1, truth.time.size)
    values[0] = change(values[0])
    values.tofile(tmp_path / "run.dat")
    _message(path, words)


@pytest.mark.parametrize("binary", [False, True])
@pytest.mark.parametrize(
    ("start", "announced"), [(0.05, "60.050"), (100.0, "60.000"), (100.0, "160.000")]
)
def test_ways_to_count_the_duration(tmp_path, truth, binary, start, announced):
    columns = _channels(truth)
    unit, text, time = columns["Time"]
    columns["Time"] = (unit, text, time + start)
    path = _write_sel(tmp_path, columns, binary)
    path.write_text(path.read_text().replace("60.000", announced))
    assert HubLoads.read(path).duration == pytest.approx(60.0, abs=0.02)


def _soft(file, folder):
    file["block0000/gains"] = h5py.SoftLink("/block0000/data")


def _external_link(file, folder):
    file["block0000/gains"] = h5py.ExternalLink(str(folder / "pipe"), "/x")


def _second_name(file, folder):
    file["block0001"] = file["block0000"]
    file.attrs["no_blocks"] = 2


def _external_storage(file, folder):
    del file["block0000/data"]
    os.truncate(os.open(folder / "numbers", os.O_CREAT | os.O_WRONLY), 1000)
    file["block0000"].create_dataset(
        "data", (10, 10), "f8", external=[(str(folder / "numbers"), 0, 800)]
    )


def _virtual_layout(file, folder):
    layout = h5py.VirtualLayout(shape=(10, 10), dtype="f8")
    layout[:] = h5py.VirtualSource(str(folder / "pipe"), "x", shape=(10, 10))
    del file["block0000/data"]
    file["block0000"].create_virtual_dataset("data", layout)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="named pipes are a thing of Unix")
@pytest.mark.timeout(30)
@pytest.mark.parametrize(
    ("put", "words"),
    [
        (_soft, "block0000/gains is a link to another place"),
        (_external_link, "block0000/gains is a link to another place"),
        (_second_name, "has a second name"),
        (_external_storage, "the numbers of block0000/data are in another place"),
        (_virtual_layout, "the numbers of block0000/data are in another place"),
    ],
)
def test_numbers_that_are_not_in_the_file(tmp_path, truth, put, words):
    os.mkfifo(tmp_path / "pipe")
    path = _write_gtsdf(tmp_path, _channels(truth), packed=False)
    with h5py.File(path, "r+") as file:
        put(file, tmp_path)
    _message(path, words)


@pytest.mark.parametrize(
    "others",
    [
        [
            ("bea2 angle", "deg", "pitch1 angle"),
            ("bea2 angle_speed", "deg/s", "pitch1 angle speed"),
        ],
        [("bea2 angle", "rad", "yaw_rot angle"), ("bea3 angle", "deg", "teeter angle")],
        [("DLL inp 7", "-", "dtu_we_controller inpvec 7  Filtered rotor speed [rad/s]")],
        [("DLL inp 1", "rad/s", "dtu_we_controller inpvec 1  Rotor speed")],
        [("State_rot omega", "rad/s", "State_rot omega tx Mbdy:tower E-nr:   1 coo: tower  omega")],
        [("Omega", "rad/s", "Rotor speed")],
        [("bea1 angle2", "-", "shaft_rot angle normalised")],
        [("bea2 angle", "deg", "p1 angle")],
    ],
)
def test_other_channels_before_those_of_the_shaft(tmp_path, truth, others):
    path = _write_sel(tmp_path, _with_others(truth, *others), binary=False)
    _check(HubLoads.read(path), truth, 1e-5)


def test_the_rotors_speed_serves_where_the_bearing_has_none(tmp_path, truth):
    columns = _channels(truth)
    _, _, speed = columns.pop("bea1 angle_speed")
    filtered = ("-", "dtu_we_controller inpvec 7  Filtered rotor speed [rad/s]", 0.5 * speed)
    rotor = ("rad/s", "Rotor speed", speed * np.pi / 30)
    columns = {"Time": columns.pop("Time"), "DLL inp 7": filtered, **columns, "Omega": rotor}
    _check(HubLoads.read(_write_sel(tmp_path, columns, False)), truth, 1e-5)


@pytest.mark.parametrize("bearing", ["rotor_bearing", "bearing1"])
def test_a_bearing_with_another_name(tmp_path, truth, bearing):
    columns = _with_others(truth, ("bea2 angle", "deg", "p1 angle"))
    for name in ("bea1 angle", "bea1 angle_speed"):
        unit, text, values = columns[name]
        columns[name] = (unit, text.replace("shaft_rot", bearing), values)
    _check(HubLoads.read(_write_sel(tmp_path, columns, False)), truth, 1e-5)


def test_two_bearings_that_may_be_the_shafts_are_refused(tmp_path, truth):
    columns = _with_others(truth, ("bea3 angle", "deg", "first angle"))
    unit, _, values = columns["bea1 angle"]
    columns["bea1 angle"] = (unit, "second angle", values)
    path = _write_sel(tmp_path, columns, False)
    _message(path, "2 channels may be the angle", "(first angle)", "(second angle)", "shaft_rot")


def test_without_the_shafts_bearing_the_others_are_named(tmp_path, truth):
    columns = _with_others(truth, ("bea2 angle", "deg", "pitch1 angle"))
    del columns["bea1 angle"]
    path = _write_sel(tmp_path, columns, False)
    _message(path, "no angle of the shaft's bearing; there is bea2 angle (pitch1 angle) in deg")


@pytest.mark.parametrize(("node", "label"), [("   1", ""), ("   1", "main bearing"), (4, "MB 2")])
def test_loads_that_are_not_those_at_the_hub(tmp_path, truth, node, label):
    """At a node d = 2.5 m behind the hub the moments are my + d fz and mz − d fy."""
    arm = np.column_stack([0.0 * truth.time, 2.5 * truth.force[:, 2], -2.5 * truth.force[:, 1]])
    there = HubLoads(truth.time, truth.shaft_speed, truth.force, truth.moment + arm, "node 1")
    columns = _channels(there, node=node, label=label)
    path = _write_sel(tmp_path, columns, binary=False)
    _message(path, f"node {int(node)}", label, "is not the hub", "loads.hub_to_output")
    read = HubLoads.read(path, hub_to_output=2.5)
    _check(read, truth, 1e-5)
    assert read.reading[-1] == "moments moved to the hub from 2.5 m behind it"
    assert f"node {int(node)}" in read.reading[0]


@pytest.mark.parametrize(
    "nodes",
    [
        {5: "", 9: "hub end"},
        {9: "hub end", 10: "generator"},
        {4: "shaft main bearing", 5: "shaft rotor center"},
        {1: "main bearing", 5: ""},
        {1: "", 3: "first flexible shaft node", 5: "outer generator rotor", 10: "rotor centre"},
    ],
)
def test_of_several_nodes_the_one_at_the_hub_is_taken(tmp_path, truth, nodes):
    """Channels of one name differ by their description; labels are those of public models."""
    columns = {}
    hub = max(nodes, key=lambda node: ("hub" in nodes[node], node))
    for node, label in nodes.items():
        for name, (unit, text, values) in _channels(truth, node=node, label=label).items():
            of_shaft = "coo: shaft" in name
            factor = 2.0 if of_shaft and node != hub else 1.0
            columns[f"{name} {node}" if of_shaft else name] = (unit, text, factor * values)
    read = HubLoads.read(_write_sel(tmp_path, columns, binary=False))
    _check(read, truth, 1e-5)
    assert f"node {hub}" in read.reading[0]


def test_a_distance_beside_loads_at_the_hub_is_refused(tmp_path, truth):
    path = _write_sel(tmp_path, _channels(truth, label="hub end"), binary=False)
    with pytest.raises(InputError, match=r"node 5 \(hub end\), and a distance .* is given"):
        HubLoads.read(path, hub_to_output=2.5)


def test_a_label_with_a_byte_that_ends_lines_in_text(tmp_path, truth):
    path = _write_sel(tmp_path, _channels(truth, label="hub end, see page"), binary=False)
    path.write_bytes(path.read_bytes().replace(b", see", b"\x85 "))
    _check(HubLoads.read(path), truth, 1e-5)


def test_asterisks_in_text(tmp_path, truth):
    columns = _with_others(truth, ("Ae power", "kW", "Aerodynamic power"))
    path = _write_sel(tmp_path, columns, binary=False)
    data = tmp_path / "run.dat"
    lines = data.read_text().splitlines()

    def write(column):
        words = lines[2].split()
        words[column] = "*" * 12
        data.write_text("\n".join([*lines[:2], " ".join(words), *lines[3:]]))

    write(list(columns).index("Ae power"))
    _check(HubLoads.read(path), truth, 1e-5)
    write(list(columns).index("Fx coo: shaft"))
    _message(path, "channel Fx coo: shaft holds '************' (sample 3)")


def test_a_list_of_channels_of_another_program(tmp_path):
    path = tmp_path / "run.sel"
    path.write_text(
        "Channel reference file (sel):\n+===+\n"
        "  Scans    Channels    Time [sec]      Coordinate convention: Siemens\n"
        "     21        3        002.000\n\n   1  Time         t         [s]\n"
    )
    _message(path, "it is BHawC's", "columns fx_N … mz_Nm")
    path.write_text("  Scans    Channels    Time [sec]      Format\n     21        3    2.0\n")
    _message(path, "has 3 words", "the format ASCII or BINARY")
