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


def _channels(truth, sign=1.0, direction=1.0, start=0.7):
    """Names, units, descriptions and values as HAWC2 gives them: main body shaft, axes that turn with the rotor."""
    time = truth.time - truth.time[0]
    angle = start + np.concatenate([[0.0], np.cumsum(truth.shaft_speed[:-1] * np.diff(time))])
    columns = {"Time": ("s", "Time", time)}
    cos, sin = np.cos(angle), np.sin(angle)
    for letter, unit, kind, vector in (("F", "kN", "Force ", truth.force), ("M", "kNm", "Moment", truth.moment)):
        x, y, z = sign * vector.T / 1e3
        # Left, up and downwind become x', −y' and −z', in axes that have turned by the angle about the downwind axis.
        left, up = y * cos + z * sin, -y * sin + z * cos
        for axis, values in zip("xyz", (left, -up, -x), strict=True):
            text = f"{kind}{letter}{axis} Mbdy:shaft nodenr:   5 coo: shaft  hub end"
            columns[f"{letter}{axis} coo: shaft"] = (unit, text, values)
    columns["bea1 angle"] = ("deg", "shaft_rot angle", direction * np.degrees(angle))
    columns["bea1 angle_speed"] = ("rpm", "shaft_rot angle speed", truth.shaft_speed * 30 / np.pi)
    return columns


def _write_sel(folder, columns, binary):
    values = np.column_stack([column for _, _, column in columns.values()])
    kind = "BINARY" if binary else "ASCII"
    lines = [LINE, "  Version ID : HAWC2MB 12.8", "   Time : 10:02:19", "   Date : 24:01.2023", LINE]
    lines += ["  Result file : ./run.dat", LINE, "   Scans    Channels    Time [sec]      Format"]
    lines += [
        f"{values.shape[0]:11d}{values.shape[1]:7d}{60.0:15.3f}       {kind}",
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


def _write_gtsdf(folder, columns, packed):
    values = np.column_stack([column for name, (_, _, column) in columns.items() if name != "Time"])
    rest = {name: entry for name, entry in columns.items() if name != "Time"}
    path = folder / "run.hdf5"
    with h5py.File(path, "w") as file:
        file.attrs["type"] = "General time series data format"
        file.attrs["name"] = "run"
        file.attrs["no_blocks"] = 1
        for kind, texts in (
            ("names", list(rest)),
            ("units", [unit for unit, _, _ in rest.values()]),
            ("descriptions", [text for _, text, _ in rest.values()]),
        ):
            file.create_dataset(f"attribute_{kind}", data=np.array([text.encode() for text in texts]))
        block = file.create_group("block0000")
        block.attrs["time_start"], block.attrs["time_step"] = 0.0, 0.05
        if packed:
            offsets = values.mean(axis=0)
            gains = np.maximum(np.abs(values - offsets).max(axis=0) / 32000.0, 1e-12)
            block.create_dataset("data", data=np.round((values - offsets) / gains).astype(np.int16))
            block.create_dataset("gains", data=gains)
            block.create_dataset("offsets", data=offsets)
        else:
            block.create_dataset("data", data=values)
    return path


def _message(path, **options):
    with pytest.raises(InputError) as caught:
        HubLoads.read(path, **options)
    return str(caught.value)


def _check(read, truth, tolerance):
    np.testing.assert_allclose(read.force, truth.force, atol=tolerance * np.abs(truth.force).max())
    np.testing.assert_allclose(read.moment, truth.moment, atol=tolerance * np.abs(truth.moment).max())
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


@pytest.mark.parametrize("packed", [False, True])
def test_gtsdf(tmp_path, truth, packed):
    _check(HubLoads.read(_write_gtsdf(tmp_path, _channels(truth), packed)), truth, 3e-3 if packed else 1e-9)


def test_no_loads_of_the_shaft(tmp_path, truth):
    columns = {name: entry for name, entry in _channels(truth).items() if not name.startswith("F")}
    message = _message(_write_sel(tmp_path, columns, binary=False))
    assert "no force of the main body shaft" in message
    assert "mbdy forcevec shaft" in message


def test_the_speed_may_be_given(tmp_path, truth):
    columns = {name: entry for name, entry in _channels(truth).items() if name != "bea1 angle_speed"}
    path = _write_sel(tmp_path, columns, binary=False)
    assert "loads.shaft_speed" in _message(path)
    assert (HubLoads.read(path, shaft_speed=2.0).shaft_speed == 2.0).all()


def test_without_the_angle(tmp_path, truth):
    columns = {name: entry for name, entry in _channels(truth).items() if name != "bea1 angle"}
    assert "no angle of the shaft's bearing" in _message(_write_sel(tmp_path, columns, binary=False))


def test_axes_in_which_the_weight_does_not_point_down(tmp_path, truth):
    path = _write_sel(tmp_path, _channels(truth, start=0.7), binary=False)
    columns = _channels(truth, start=0.7)
    unit, text, angle = columns["bea1 angle"]
    columns["bea1 angle"] = (unit, text, angle + 90.0)
    path = _write_sel(tmp_path, columns, binary=False)
    message = _message(path)
    assert "weight of the rotor cannot be seen" in message
    assert "table" in message


def test_binary_data_that_are_cut_off(tmp_path, truth):
    path = _write_sel(tmp_path, _channels(truth), binary=True)
    data = tmp_path / "run.dat"
    data.write_bytes(data.read_bytes()[:-10])
    message = _message(path)
    assert "cut off" in message
    assert str(data) in message


def test_text_data_that_are_cut_off(tmp_path, truth):
    path = _write_sel(tmp_path, _channels(truth), binary=False)
    data = tmp_path / "run.dat"
    data.write_text(data.read_text()[:-30])
    assert "the list of channels announces" in _message(path)


def test_no_data_beside_the_list(tmp_path, truth):
    path = _write_sel(tmp_path, _channels(truth), binary=True)
    (tmp_path / "run.dat").unlink()
    assert "no run.dat beside it" in _message(path)


def test_a_list_that_is_none(tmp_path):
    path = tmp_path / "run.sel"
    path.write_text("nothing\n")
    assert "not readable as a list of channels of HAWC2" in _message(path)


def test_an_hdf5_file_of_another_kind(tmp_path):
    path = tmp_path / "other.hdf5"
    with h5py.File(path, "w") as file:
        file["x"] = 1.0
    assert "General time series" in _message(path)


def _of_times(folder, truth, change):
    """A binary file whose 16-bit times were changed."""
    path = _write_sel(folder, _channels(truth), binary=True)
    values = np.fromfile(folder / "run.dat", "<i2").reshape(-1, truth.time.size)
    values[0] = change(values[0])
    values.tofile(folder / "run.dat")
    return path


def test_a_flipped_bit_in_the_last_time(tmp_path, truth):
    message = _message(_of_times(tmp_path, truth, lambda time: np.append(time[:-1], time[-1] ^ 0x4000)))
    assert "its time goes from 0 s to 29.28 s, the list of channels announces 60 s" in message


@pytest.mark.parametrize(("duration", "words"), [("20.000", "announces 20 s"), ("nan", "channels in nan s")])
def test_a_damaged_duration(tmp_path, truth, duration, words):
    path = _write_sel(tmp_path, _channels(truth), binary=True)
    path.write_text(path.read_text().replace("60.000", duration))
    assert words in _message(path)


def test_a_flipped_bit_in_a_time_between(tmp_path, truth):
    message = _message(
        _of_times(tmp_path, truth, lambda time: np.where(np.arange(time.size) == 7, time ^ 0x0800, time))
    )
    assert "the samples of its time are not equally spaced" in message


def test_bytes_in_the_wrong_order(tmp_path, truth):
    path = _write_sel(tmp_path, _channels(truth), binary=True)
    np.fromfile(tmp_path / "run.dat", "<i2").byteswap().tofile(tmp_path / "run.dat")
    assert "its time" in _message(path)


@pytest.mark.parametrize("binary", [False, True])
@pytest.mark.parametrize(("start", "announced"), [(0.05, "60.050"), (100.0, "60.000"), (100.0, "160.000")])
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
    file["block0000"].create_dataset("data", (10, 10), "f8", external=[(str(folder / "numbers"), 0, 800)])


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
    assert words in _message(path)
