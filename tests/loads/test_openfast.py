"""OpenFAST files: genuine ones against each other, and everything that can be wrong with one."""

import struct

import numpy as np
import pytest

from macroslip.errors import InputError
from macroslip.loads import HubLoads
from macroslip.loads.openfast import gauge_distance, read_channels


def _split_text(path):
    lines = path.read_text().splitlines()
    return lines[:6], lines[6].split(), lines[7].split(), [line.split() for line in lines[8:]]


def _write_text(path, head, names, units, rows, end="\n"):
    body = ["\t".join(names), "\t".join(units), *("\t".join(row) for row in rows)]
    path.write_text("\n".join([*head, *body]) + end)
    return path


def _selection(sample_out, keep, rename=None, units_of=None, rows=None):
    """The genuine text file with only the columns for which keep(name) holds."""
    head, names, units, data = _split_text(sample_out)
    index = [i for i, name in enumerate(names) if keep(name)]
    units = [(units_of or {}).get(names[i], units[i]) for i in index]
    return (
        head,
        [(rename or {}).get(names[i], names[i]) for i in index],
        units,
        [[row[i] for i in index] for row in data[:rows]],
    )


def _message(path, *words):
    with pytest.raises(InputError) as caught:
        HubLoads.read(path)
    assert [word for word in (str(path), *words) if word not in str(caught.value)] == []
    return str(caught.value)


def test_binary_and_text_of_one_run_agree_to_text_rounding(sample_outb, sample_out):
    binary, text = HubLoads.read(sample_outb), HubLoads.read(sample_out)
    assert binary.time == pytest.approx(60 + 0.05 * np.arange(1201), abs=1e-9)
    assert text.time == pytest.approx(binary.time, abs=1e-9)
    for name in ("shaft_speed", "force", "moment"):
        unit = (
            np.pi / 30 if name == "shaft_speed" else 1e3
        )  # the text is rounded in rpm, kN and kN m
        written, exact = getattr(text, name) / unit, getattr(binary, name) / unit
        # Half a unit of the fourth digit, plus half a step of the 16-bit packing of the channel's range.
        packing = 0.51 * np.ptp(exact, axis=0) / 64000
        assert (
            np.abs(written - exact) <= 0.51e-3 * 10 ** np.floor(np.log10(np.abs(exact))) + packing
        ).all()


def test_units_and_signs_of_the_genuine_file(sample_outb):
    loads = HubLoads.read(sample_outb)
    assert loads.source == str(sample_outb)
    assert loads.shaft_speed[0] == pytest.approx(20.117 * np.pi / 30, rel=1e-5)
    assert loads.force[0] == pytest.approx([181.73e3, -2.709e3, -255.18e3], rel=1e-4)
    assert loads.moment[0] == pytest.approx([706.93e3, 236.23e3, -394.44e3], rel=1e-4)


def test_sample_is_the_bundled_case(sample_outb, clip_50hz):
    sample, clip, bundled = (
        HubLoads.read(sample_outb),
        HubLoads.read(clip_50hz),
        HubLoads.bundled("14B").window(0, 60),
    )
    assert sample.time - 60 == pytest.approx(bundled.time, abs=1e-9)
    for name in ("shaft_speed", "force", "moment"):
        recorded, source, thinned = (
            getattr(sample, name),
            getattr(clip, name),
            getattr(bundled, name),
        )
        spread = recorded.std(axis=0)
        assert (
            np.abs(recorded[::2] - source[::5]).max(axis=0) < 2e-4 * spread
        ).all()  # 16-bit packing
        # The thinned record lacks what lay above 8.5 Hz.
        assert (np.sqrt(np.mean((recorded - thinned) ** 2, axis=0)) < 0.02 * spread).all()


def test_rotating_channels_are_turned_by_azimuth(tmp_path, sample_out, sample_outb):
    rotating = _selection(
        sample_out, lambda name: name not in ("LSShftFys", "LSShftFzs", "LSSTipMys", "LSSTipMzs")
    )
    turned, fixed = (
        HubLoads.read(_write_text(tmp_path / "a.out", *rotating)),
        HubLoads.read(sample_outb),
    )
    # Four digits of loads up to 1 MN m, and of an azimuth up to 360 degrees (0.05 degrees of rounding).
    assert turned.force[:, 1:] == pytest.approx(fixed.force[:, 1:], abs=0.4e3)
    assert turned.moment[:, 1:] == pytest.approx(fixed.moment[:, 1:], abs=1.3e3)
    assert fixed.moment[:, 1].std() > 100e3


def test_one_pair_may_be_rotating_and_the_other_not(tmp_path, sample_out):
    mixed = _selection(sample_out, lambda name: name not in ("LSSTipMys", "LSSTipMzs"), rows=100)
    plain = HubLoads.read(sample_out).window(60, 64.95)
    loads = HubLoads.read(_write_text(tmp_path / "a.out", *mixed))
    assert np.array_equal(loads.force, plain.force)
    assert loads.moment == pytest.approx(plain.moment, abs=1.3e3)


def test_rotating_forces_that_do_not_point_down_are_refused(tmp_path, sample_out):
    head, names, units, rows = _selection(
        sample_out, lambda name: name not in ("LSShftFys", "LSShftFzs")
    )
    i = names.index("Azimuth")
    for row in rows:  # what AzimB1Up = 90 does
        row[i] = f"{(float(row[i]) + 90) % 360:.4f}"
    path = _write_text(tmp_path / "a.out", head, names, units, rows)
    _message(path, "do not point down", "AzimB1Up = 0", "LSShftFys")


def test_aliases_and_letter_case(tmp_path, sample_out):
    needed = {
        "Time": "TIME", "RotSpeed": "LSSTipVxa", "LSShftFxa": "rotthrust", "LSShftFys": "LSSGAGFYS",
        "LSShftFzs": "lsshftfzs", "LSShftMxa": "RotTorq", "LSSTipMys": "lsstipmys", "LSSTipMzs": "LSSTIPMZS",
    }  # fmt: skip
    path = _write_text(
        tmp_path / "a.out", *_selection(sample_out, needed.__contains__, needed, rows=50)
    )
    renamed, plain = HubLoads.read(path), HubLoads.read(sample_out).window(60, 62.45)
    for name in ("time", "shaft_speed", "force", "moment"):
        assert np.array_equal(getattr(renamed, name), getattr(plain, name))


def test_declared_units_are_used(tmp_path, sample_out):
    units = {"LSShftFxa": "(N)", "LSSTipMys": "(N-m)", "LSSTipMzs": "(kN·m)", "RotSpeed": "(rad/s)"}
    units |= {"LSShftMxa": "(kNm)"}
    path = _write_text(
        tmp_path / "a.out", *_selection(sample_out, lambda name: True, units_of=units, rows=50)
    )
    other, plain = HubLoads.read(path), HubLoads.read(sample_out).window(60, 62.45)
    assert other.force == pytest.approx(plain.force * [1e-3, 1, 1])
    assert other.moment == pytest.approx(plain.moment * [1, 1e-3, 1])
    assert other.shaft_speed == pytest.approx(plain.shaft_speed * 30 / np.pi)


@pytest.mark.parametrize(
    ("channel", "unit", "words"),
    [
        ("LSShftFys", "(lbf)", ["channel LSShftFys has the unit lbf", "N, kN"]),
        ("LSSTipMzs", "(kN)", ["channel LSSTipMzs has the unit kN", "Nm, kNm"]),
        ("RotSpeed", "(m/s)", ["channel RotSpeed has the unit m/s", "rpm"]),
        ("LSShftMxa", "(INVALID)", ["channel LSShftMxa has the unit INVALID", "cannot compute"]),
        (
            "LSSTipMys",
            "INVALID",
            ["channel LSSTipMys has the unit INVALID", "check that ElastoDyn is in use"],
        ),
    ],
)
def test_unknown_units(tmp_path, sample_out, channel, unit, words):
    path = _write_text(
        tmp_path / "a.out",
        *_selection(sample_out, lambda name: True, units_of={channel: unit}, rows=5),
    )
    _message(path, *words)


@pytest.mark.parametrize(
    ("absent", "words"),
    [
        (
            ["RotSpeed"],
            [
                "RotSpeed is not in the file (34 channels)",
                '"RotSpeed"      - (rpm)',
                "RotSpeed or LSSTipVxa",
            ],
        ),
        (
            ["LSShftFxa", "RotThrust"],
            ["LSShftFxa is not in the file", '"LSShftFxa"     - (kN)', "or RotThrust"],
        ),
        (
            ["LSSTipMys", "LSSTipMya"],
            [
                "LSSTipMys is not in the file",
                '"LSSTipMys"     - (kN-m)',
                "LSSTipMys (or LSSTipMya, LSSTipMza and Azimuth)",
                "LSSGagMys and LSSGagMzs cannot stand in",
            ],
        ),
        (
            ["LSShftFys", "LSSTipMzs", "Azimuth"],
            [
                "LSShftFys, LSSTipMzs are not in the file (32 channels)",
                '"LSShftFys"     -',
                '\n"LSSTipMzs"     -',
            ],
        ),
        (["Time"], ["no channel Time"]),
    ],
)
def test_missing_channels_name_the_outlist_line(tmp_path, sample_out, absent, words):
    path = _write_text(
        tmp_path / "a.out", *_selection(sample_out, lambda name: name not in absent, rows=5)
    )
    _message(
        path, *words, "" if absent == ["Time"] else "Add to the OutList of the ElastoDyn input file"
    )


def test_window_on_reading_also_skips_a_bad_stretch(tmp_path, sample_out):
    head, names, units, rows = _selection(sample_out, lambda name: True, rows=100)
    rows[10][names.index("LSShftFzs")] = "NaN"
    del rows[20:30]
    path = _write_text(tmp_path / "a.out", head, names, units, rows)
    assert "gap of 0.55 s after t = 60.95 s" in _message(path)
    with pytest.raises(InputError, match=r"t = 60\.5 s: fz is nan"):
        HubLoads.read(path, end=60.9)
    assert HubLoads.read(path, start=61.5).time[[0, -1]].tolist() == [61.5, 64.95]
    with pytest.raises(InputError, match="60 s to 64.95 s"):
        HubLoads.read(path, start=0.0, end=64.0)


RECORD = 34 * 2  # bytes of one packed sample
HEADER = 82890 - 1201 * RECORD


@pytest.mark.parametrize("size", [
    1, 3, 9, 25, 60, 200, 296, 700, HEADER - 1, HEADER, HEADER + 1, HEADER + 600 * RECORD, HEADER + 600 * RECORD + 33,
    82890 - RECORD, 82890 - 2, 82890 - 1,
])  # fmt: skip
def test_truncated_binary(tmp_path, sample_outb, size):
    path = tmp_path / "cut.outb"
    path.write_bytes(sample_outb.read_bytes()[:size])
    _message(path, "cut off", "run OpenFAST again")


def test_binary_with_bytes_to_spare(tmp_path, sample_outb):
    path = tmp_path / "long.outb"
    path.write_bytes(sample_outb.read_bytes() + bytes(RECORD))
    read, whole = HubLoads.read(path), HubLoads.read(sample_outb)
    np.testing.assert_array_equal(read.force, whole.force)
    np.testing.assert_array_equal(read.time, whole.time)


def test_text_with_units_in_latin_1(tmp_path, sample_out):
    content = sample_out.read_bytes()
    assert b"(kN-m)" in content
    for name, encoding in (("latin.out", "latin-1"), ("unicode.out", "utf-8")):
        path = tmp_path / name
        path.write_bytes(content.replace(b"(kN-m)", "(kN·m)".encode(encoding)))
        np.testing.assert_array_equal(HubLoads.read(path).moment, HubLoads.read(sample_out).moment)


def test_what_was_read_is_said(sample_outb):
    reading = HubLoads.read(sample_outb).reading
    assert "RotSpeed (rpm)" in reading
    assert any("LSSTipMys" in line for line in reading)


def _poke(content, offset, layout, value):
    return (
        content[:offset] + struct.pack(layout, value) + content[offset + struct.calcsize(layout) :]
    )


@pytest.mark.parametrize(("offset", "layout", "value"), [
    (0, "<h", 7), (2, "<h", 0), (4, "<i", -1), (4, "<i", 35), (8, "<i", 0), (8, "<i", 2_000_000_000),
    (28 + 34 * 8, "<i", -5),
])  # fmt: skip
def test_damaged_binary_header(tmp_path, sample_outb, offset, layout, value):
    path = tmp_path / "bad.outb"
    path.write_bytes(_poke(sample_outb.read_bytes(), offset, layout, value))
    message = _message(path)
    assert any(
        word in message for word in ("cut off", "damaged", "not that of an OpenFAST binary file")
    )


def test_a_scale_of_zero_is_reported_by_channel_and_time(tmp_path, sample_outb, sample_out):
    path = tmp_path / "bad.outb"
    _, names, _, _ = _split_text(sample_out)
    path.write_bytes(
        _poke(sample_outb.read_bytes(), 28 + 4 * (names.index("LSShftFzs") - 1), "<f", 0.0)
    )
    assert "t = 60 s: fz is" in _message(path)


def test_text_under_a_binary_name_and_the_reverse(tmp_path, sample_outb, sample_out):
    path = tmp_path / "a.outb"
    path.write_bytes(sample_out.read_bytes())
    assert "Text output must be named .out" in _message(path)
    path = tmp_path / "b.out"
    path.write_bytes(sample_outb.read_bytes())
    assert "not a text file. Name binary output .outb" in _message(path)


@pytest.mark.parametrize(("file_format", "name_length"), [(1, 10), (2, 10), (3, 10), (4, 15)])
def test_all_four_binary_formats(tmp_path, sample_out, file_format, name_length):
    """A file of each format, written by its published layout, gives the values put in; short of a sample, an error."""
    _head, names, units, rows = _selection(sample_out, lambda name: True, rows=40)
    values = np.array(rows, dtype=float)
    time, values = values[:, 0], values[:, 1:]
    low, high = values.min(axis=0), values.max(axis=0)
    scale = (60000 / np.maximum(high - low, 1e-9)).astype(np.float32)
    offset = (-30000 - low * scale).astype(np.float32)
    text = b"made for a test"
    content = struct.pack("<h", file_format) + (
        struct.pack("<h", name_length) if file_format == 4 else b""
    )
    content += struct.pack("<ii", values.shape[1], len(time))
    content += struct.pack("<dd", *((1e4, 0.0) if file_format == 1 else (time[0], 0.05)))
    content += b"" if file_format == 3 else scale.tobytes() + offset.tobytes()
    content += struct.pack("<i", len(text)) + text
    content += b"".join(word.ljust(name_length).encode() for word in [*names, *units])
    content += (time * 1e4).round().astype("<i4").tobytes() if file_format == 1 else b""
    packed = values if file_format == 3 else np.round(values * scale + offset).astype("<i2")
    content += packed.tobytes()
    path = tmp_path / "a.outb"
    path.write_bytes(content)
    loads, plain = HubLoads.read(path), HubLoads.read(sample_out).window(60, 61.95)
    assert loads.time == pytest.approx(plain.time, abs=1e-9)
    assert loads.force == pytest.approx(plain.force, abs=5.0)
    assert loads.moment == pytest.approx(plain.moment, abs=30.0)
    path.write_bytes(content[: -packed[0].nbytes])
    assert "cut off" in _message(path)


@pytest.mark.parametrize(
    ("cut", "words"),
    [
        (-200, ["line 1209 has", "values for 35 channels", "incomplete last line"]),
        (-3, ["the last line is cut off"]),
        # What is left, 8.143, is a number: the exponent is lost without a sign.
        (-5, ["the last line is cut off"]),
        (-2, ["the last line is cut off"]),
    ],
)
def test_text_cut_within_its_last_line(tmp_path, sample_out, cut, words):
    path = tmp_path / "cut.out"
    path.write_bytes(sample_out.read_bytes()[:cut])
    _message(path, *words)


def test_text_without_the_final_line_end_is_complete(tmp_path, sample_out):
    path = tmp_path / "whole.out"
    path.write_bytes(sample_out.read_bytes()[:-1])
    assert HubLoads.read(path).time[-1] == 120.0


@pytest.mark.parametrize("word", ["**********", "-", "1.0E+", "1,5", "1_0"])
def test_what_is_no_number_matters_in_channels_that_are_taken(tmp_path, sample_out, word):
    head, names, units, rows = _selection(sample_out, lambda name: True, rows=20)
    plain = HubLoads.read(_write_text(tmp_path / "a.out", head, names, units, rows))
    rows[4][names.index("Wind1VelX")] = word
    other = HubLoads.read(_write_text(tmp_path / "a.out", head, names, units, rows))
    assert np.array_equal(other.force, plain.force)
    rows[4][names.index("LSSTipMys")] = word
    path = _write_text(tmp_path / "a.out", head, names, units, rows)
    _message(path, f"channel LSSTipMys holds '{word}' (line 13)", "wider format")


def test_a_channel_of_the_speed_does_not_matter_where_the_speed_is_given(tmp_path, sample_out):
    head, names, units, rows = _selection(sample_out, lambda name: True, rows=20)
    rows[4][names.index("RotSpeed")] = "**********"
    path = _write_text(tmp_path / "a.out", head, names, units, rows)
    _message(path, "channel RotSpeed holds '**********'")
    read = HubLoads.read(path, shaft_speed=1.25)
    assert (read.shaft_speed == 1.25).all()
    assert [line for line in read.reading if "speed" in line.lower()] == [
        "shaft speed: given, 1.25 rad/s"
    ]


def test_a_description_in_an_encoding_of_east_asia(tmp_path, sample_out):
    """Bytes of GBK, Shift-JIS and Big5 hold 0x85 and the like, at which text may seem to end a line."""
    plain = HubLoads.read(sample_out)
    lines = sample_out.read_bytes().split(b"\n")
    for encoding, words in (("gbk", "\u5426\u5426"), ("shift-jis", "\u8868"), ("big5", "\u529f")):
        text = f"Description: {words}".encode(encoding)
        lines[4] = text + b" \x85\x0b\x1c\x85 end"
        path = tmp_path / f"{encoding}.out"
        path.write_bytes(b"\n".join(lines))
        assert np.array_equal(HubLoads.read(path).force, plain.force)


@pytest.mark.parametrize(
    ("word", "value"), [("1.250-101", 1.25e-101), ("-1.25D+02", -125.0), ("1.25+002", 125.0)]
)
def test_numbers_as_fortran_writes_them(tmp_path, sample_out, word, value):
    head, names, units, rows = _selection(sample_out, lambda name: True, rows=20)
    rows[4][names.index("LSShftFxa")] = word
    read = HubLoads.read(_write_text(tmp_path / "a.out", head, names, units, rows))
    assert read.force[4, 0] == pytest.approx(1e3 * value, rel=1e-12, abs=0.0)


@pytest.mark.parametrize(
    "change",
    [
        lambda content: content + b"\n\n  \n",
        lambda content: content.replace(b"\n", b"\r\n") + b"\r\n\r\n",
        lambda content: content.removeprefix(b"\n"),
        lambda content: b"a second line of description\n" + content,
        lambda content: content.replace(b"WindPACT", b"WindPACT\x85 \xa0\x0b\x1c"),
        lambda content: content.replace(b"WindPACT", "风机".encode("gbk")),
        lambda content: "\N{BYTE ORDER MARK}".encode() + content,
        lambda content: content.decode().encode("utf-16"),
    ],
)
def test_text_that_other_programs_saved(tmp_path, sample_out, change):
    """Blank lines at the end, line ends, a lost or added line, and encodings of the description."""
    path = tmp_path / "a.out"
    path.write_bytes(change(sample_out.read_bytes()))
    read, plain = HubLoads.read(path), HubLoads.read(sample_out)
    for name in ("time", "shaft_speed", "force", "moment"):
        assert np.array_equal(getattr(read, name), getattr(plain, name))


@pytest.mark.parametrize("prefix", ["-", "_", "m", "M"])
def test_channels_of_which_the_negative_was_asked_for(tmp_path, sample_out, prefix):
    needed = ("LSShftFzs", "LSSTipMys")
    head, names, units, rows = _selection(sample_out, lambda name: True, rows=50)
    for row in rows:
        for i in map(names.index, needed):
            row[i] = row[i][1:] if row[i].startswith("-") else f"-{row[i]}"
    names = [prefix + name if name in needed else name for name in names]
    read = HubLoads.read(_write_text(tmp_path / "a.out", head, names, units, rows))
    plain = HubLoads.read(sample_out).window(60, 62.45)
    assert np.array_equal(read.force, plain.force) and np.array_equal(read.moment, plain.moment)
    assert f"{prefix}LSShftFzs (kN), its sign turned back" in read.reading


def test_moments_at_the_strain_gauge_are_moved_to_the_hub(tmp_path, sample_out):
    """At the gauge, d = 2 m behind the hub, the moments are my + d fz and mz − d fy."""
    head, names, units, rows = _selection(sample_out, lambda name: name[:6] != "LSSTip", rows=50)
    plain = HubLoads.read(sample_out).window(60, 62.45)
    for row, force, moment in zip(rows, plain.force, plain.moment, strict=True):
        row[names.index("LSSGagMys")] = f"{(moment[1] + 2.0 * force[2]) / 1e3:.9E}"
        row[names.index("LSSGagMzs")] = f"{(moment[2] - 2.0 * force[1]) / 1e3:.9E}"
    path = _write_text(tmp_path / "a.out", head, names, units, rows)
    _message(path, "LSSTipMys, LSSTipMzs are not in the file", "loads.hub_to_output")
    read = HubLoads.read(path, hub_to_output=2.0)
    assert read.moment == pytest.approx(plain.moment, abs=1.0)
    assert read.reading[-1] == "moments moved to the hub from 2 m behind it"


@pytest.mark.parametrize("lines", [1, 7, 8, 9])
def test_text_with_hardly_any_lines(tmp_path, sample_out, lines):
    path = tmp_path / "short.out"
    path.write_text("".join(sample_out.read_text().splitlines(keepends=True)[:lines]))
    message = _message(path)
    assert (
        "not an OpenFAST text output" in message if lines < 9 else "at least 2 samples" in message
    )


def test_genuine_moments_at_the_strain_gauge_are_those_at_the_hub_when_moved(tmp_path, sample_out):
    """The model has ShftGagL = 0.99 m; OpenFAST computes both moments."""
    gauge = _selection(sample_out, lambda name: name[:6] != "LSSTip")
    read = HubLoads.read(_write_text(tmp_path / "a.out", *gauge), hub_to_output=0.99)
    plain = HubLoads.read(sample_out)
    # Four digits of moments up to 1 MN m.
    assert np.abs(read.moment - plain.moment).max() <= 1.1e3
    assert gauge_distance(read_channels(sample_out)) == pytest.approx(0.99, abs=1e-5)


def test_a_rotor_downwind_of_the_tower_shows_in_its_strain_gauge(tmp_path, sample_out):
    """There the gauge is upwind of the hub, so that its moment is my − d fz, mz + d fy."""
    head, names, units, rows = _selection(sample_out, lambda name: True, rows=50)
    plain = HubLoads.read(sample_out).window(60, 62.45)
    for row, force, moment in zip(rows, plain.force, plain.moment, strict=True):
        row[names.index("LSSGagMys")] = f"{(moment[1] - 0.99 * force[2]) / 1e3:.4E}"
        row[names.index("LSSGagMzs")] = f"{(moment[2] + 0.99 * force[1]) / 1e3:.4E}"
    path = _write_text(tmp_path / "a.out", head, names, units, rows)
    _message(path, "0.99 m upwind of the hub", "the rotor is downwind of the tower")
    # A moment in another unit than it says is no distance.
    wrong = [
        {"LSSGagMys": "(N-m)"}.get(name, unit) for name, unit in zip(names, units, strict=True)
    ]
    assert gauge_distance(read_channels(_write_text(path, head, names, wrong, rows))) is None
    # What nobody takes may hold anything.
    rows[0][names.index("LSSGagMys")] = "**********"
    read = HubLoads.read(_write_text(tmp_path / "a.out", head, names, units, rows))
    assert np.array_equal(read.moment, plain.moment)


@pytest.mark.parametrize("distance", [-2.0, 20.1, np.nan, np.inf])
def test_a_distance_that_no_shaft_has(sample_outb, distance):
    with pytest.raises(InputError, match=r"hub_to_output is .* 0 to 20 m\. It counts downwind"):
        HubLoads.read(sample_outb, hub_to_output=distance)
