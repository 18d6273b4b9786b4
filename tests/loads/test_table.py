"""Tables: the spellings of their columns, and their time axes."""

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pyarrow import csv

from macroslip.errors import InputError
from macroslip.loads import BearingLoads, HubLoads
from macroslip.loads.table import _rebuild_uniform

HUB = {
    "time_s": [0.0, 0.1, 0.2],
    "rotor_speed_rpm": [19.0, 20.0, 21.0],
    "fx_N": [1e5, 2e5, 3e5],
    "fy_N": [1.0, 2.0, 3.0],
    "fz_N": [-1e5, -1e5, -1e5],
    "mx_Nm": [7e5, 7e5, 7e5],
    "my_Nm": [1e5, 0.0, -1e5],
    "mz_Nm": [0.0, 1.0, 2.0],
}
BEARING = {
    "time_s": [0.0, 0.1, 0.2],
    "shaft_speed_rad_s": [2.0, 2.0, -2.0],
    "F_X0_N": [1e3, 2e3, 3e3],
    "F_Y0_N": [-3e5, -3e5, -3e5],
    "F_Z0_N": [1e5, 1e5, 1e5],
}


def _write(path, columns):
    table = pa.table(columns) if isinstance(columns, dict) else columns
    csv.write_csv(table, path) if path.suffix == ".csv" else pq.write_table(table, path)
    return path


def _message(path, *words, reader=HubLoads.read):
    with pytest.raises(InputError) as caught:
        reader(path)
    assert [word for word in (str(path), *words) if word not in str(caught.value)] == []
    return str(caught.value)


@pytest.mark.parametrize("extension", [".csv", ".parquet"])
def test_hub_and_bearing_tables(tmp_path, extension):
    hub = HubLoads.read(_write(tmp_path / f"h{extension}", HUB | {"wind_mps": [9.0, 9.0, 9.0]}))
    assert hub.shaft_speed == pytest.approx(np.array([19, 20, 21]) * np.pi / 30)
    assert hub.force[1].tolist() == [2e5, 2.0, -1e5] and hub.moment[2].tolist() == [7e5, -1e5, 2.0]
    bearing = BearingLoads.read(_write(tmp_path / f"b{extension}", BEARING), start=0.1)
    assert bearing.force.tolist() == [[2e3, -3e5, 1e5], [3e3, -3e5, 1e5]]
    assert bearing.shaft_speed.tolist() == [2.0, -2.0]


@pytest.mark.parametrize(
    ("old", "new", "factor"),
    [
        ("fx_N", "fx_kN", 1e-3),
        ("mz_Nm", "mz_kNm", 1e-3),
        ("rotor_speed_rpm", "shaft_speed_rpm", 1.0),
        ("rotor_speed_rpm", "shaft_speed_radps", np.pi / 30),
        ("rotor_speed_rpm", "rotor_speed_rad_s", np.pi / 30),
    ],
)
def test_every_unit_gives_the_same_loads(tmp_path, old, new, factor):
    columns = {
        new if name == old else name: np.array(values) * (factor if name == old else 1)
        for name, values in HUB.items()
    }
    plain, other = (
        HubLoads.read(_write(tmp_path / f"{i}.csv", c)) for i, c in enumerate((HUB, columns))
    )
    for name in ("time", "shaft_speed", "force", "moment"):
        assert getattr(other, name) == pytest.approx(getattr(plain, name))


def _renamed(old, new):
    return {new if name == old else name: values for name, values in HUB.items()}


@pytest.mark.parametrize(
    ("columns", "words"),
    [
        (_renamed("fx_N", "fx_lbf"), ["column fx_lbf has no known unit", "fx_N, fx_kN"]),
        (_renamed("mx_Nm", "mx"), ["column mx has no known unit", "mx_Nm, mx_kNm"]),
        (_renamed("time_s", "time_ms"), ["column time_ms has no known unit", "time_s"]),
        (
            _renamed("my_Nm", "bending_Nm"),
            ["no column for my_Nm or my_kNm", "The columns are: time_s"],
        ),
        (
            _renamed("rotor_speed_rpm", "speed"),
            ["no column for shaft_speed_rpm", "shaft_speed_rad_s", "rotor_speed_rpm"],
        ),
        (HUB | {"fx_kN": HUB["fx_N"]}, ["columns fx_N and fx_kN both give fx"]),
        (
            HUB | {"shaft_speed_rpm": HUB["fx_N"]},
            ["columns rotor_speed_rpm and shaft_speed_rpm both give shaft_speed"],
        ),
        (HUB | {"fz_N": [1.0, None, 2.0]}, ["t = 0.1 s: fz is nan"]),
        (HUB | {"time_s": [0.0, 0.1, 0.1]}, ["time does not increase"]),
        (BEARING, ["BearingLoads.read"]),
    ],
)
@pytest.mark.parametrize("extension", [".csv", ".parquet"])
def test_bad_columns(tmp_path, columns, words, extension):
    _message(_write(tmp_path / f"a{extension}", columns), *words)


@pytest.mark.parametrize(
    ("extension", "words"),
    [
        (".csv", ["column fz_N holds 'a', not a number, in row 1 of the data"]),
        (".parquet", ["column fz_N holds string, not numbers"]),
    ],
)
def test_text_in_place_of_numbers(tmp_path, extension, words):
    _message(_write(tmp_path / f"a{extension}", HUB | {"fz_N": ["a", "b", "c"]}), *words)


def test_hub_table_read_as_bearing_loads(tmp_path):
    _message(
        _write(tmp_path / "a.csv", HUB),
        "HubLoads.read, then main_bearing_load",
        reader=BearingLoads.read,
    )


def test_a_column_that_stands_twice(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("time_s,fx_N,fx_N\n0,1,2\n0.1,1,2\n")
    _message(path, "columns fx_N and fx_N both give fx")
    table = pa.Table.from_arrays(
        [pa.array(v) for v in [*HUB.values(), HUB["fy_N"]]], names=[*HUB, "fy_N"]
    )
    _message(_write(tmp_path / "a.parquet", table), "columns fy_N and fy_N both give fy")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            ";".join(HUB) + "\n" + "0,5;1.5;3;4;5;6;7;8\n" * 2,
            ["column rotor_speed_rpm holds '1.5' with a point", "time_s holds '0,5' with a comma"],
        ),
        (
            "time_s,fx_N\n0,1\n0.1\n",
            [
                "not readable as a CSV table: row 2 of the data has 1 values, '0.1', and the header 2"
            ],
        ),
        (
            "time_s,fx_N\n0,1\n0.1,2,3\n",
            ["row 2 of the data has 3 values, '0.1,2,3', and the header 2 names"],
        ),
        ("\n\n", ["not readable as a CSV table"]),
        (",".join(HUB) + "\n", ["time has shape (0,)", "at least 2 samples"]),
    ],
)
def test_bad_csv(tmp_path, text, words):
    path = tmp_path / "a.csv"
    path.write_text(text)
    _message(path, *words)


def test_a_mark_of_utf_16_before_other_text(tmp_path):
    path = tmp_path / "a.csv"
    path.write_bytes(
        b"\xff\xfe" + (",".join(HUB) + "\n" + "0,1,2,3,4,5,6,7\n1,1,2,3,4,5,6,7\n").encode()
    )
    _message(path, "no column for time_s")


def test_csv_as_people_write_it(tmp_path):
    """A byte-order mark, spaces after the commas, Windows line ends, whole numbers, no final line end."""
    path = tmp_path / "a.csv"
    rows = [", ".join(str(values[i]) for values in BEARING.values()) for i in range(3)]
    path.write_bytes(
        ("\ufeff" + "\r\n".join([", ".join(BEARING), *rows]).replace("100000.0", "100000")).encode()
    )
    assert BearingLoads.read(path).force[2].tolist() == [3e3, -3e5, 1e5]


@pytest.mark.parametrize(("separator", "mark"), [(";", ","), (";", "."), ("\t", ","), ("\t", ".")])
def test_csv_with_other_separators_and_decimal_commas(tmp_path, separator, mark):
    """As spreadsheets write it where numbers have a comma."""
    path = tmp_path / "a.csv"
    rows = [
        separator.join(f"{1e-3 * values[i]:.6f}".replace(".", mark) for values in BEARING.values())
        for i in range(3)
    ]
    path.write_text(
        "\n".join(
            [separator.join([*BEARING, "remark"]), *(f"{row}{separator}a,b.c" for row in rows)]
        )
    )
    read = BearingLoads.read(path)
    assert read.force[2] == pytest.approx([3.0, -3e2, 1e2], rel=1e-12)
    assert read.time == pytest.approx(1e-3 * np.array(BEARING["time_s"]), abs=1e-12)


@pytest.mark.parametrize("part", [0.02, 0.5, 0.9, 0.999])
def test_truncated_parquet(tmp_path, clip_50hz, part):
    content = clip_50hz.read_bytes()
    path = tmp_path / "cut.parquet"
    path.write_bytes(content[: int(part * len(content))])
    _message(path, "not readable as a Parquet table")


@pytest.mark.parametrize(
    ("first", "rate", "n"), [(0.0, 50, 30000), (60.0, 20, 12001), (0.02, 30, 18000), (1e4, 7, 3000)]
)
def test_float32_time_is_rebuilt(tmp_path, first, rate, n):
    exact = first + np.arange(n) / rate
    columns = {name: np.zeros(n, dtype=np.float32) for name in HUB} | {
        "time_s": exact.astype(np.float32)
    }
    rebuilt = HubLoads.read(_write(tmp_path / "a.parquet", columns)).time
    assert rebuilt == pytest.approx(exact, rel=0, abs=1e-9)


@given(st.floats(1e-3, 50.0), st.integers(3, 2000), st.floats(0, 1e3))
def test_any_uniform_float32_axis_becomes_uniform(step, n, first):
    exact = first + step * np.arange(n)
    stored = exact.astype(np.float32).astype(float)
    rebuilt = _rebuild_uniform(stored)
    assert np.abs(rebuilt - stored).max() <= np.spacing(np.float32(exact[-1]))
    assert np.ptp(np.diff(rebuilt)) <= 1e-11 * (1 + exact[-1])


def test_an_axis_that_is_not_uniform_is_left_alone():
    time = (np.arange(100) / 50).astype(np.float32).astype(float)
    time[50:] += 0.001
    assert _rebuild_uniform(time) is time


# ---- CSV as other programs write it --------------------------------------------------------------

#: Rows of hub loads in kN and kN m; force and moment in N and N m are a thousandfold.
_NAMES = "time_s;rotor_speed_rpm;fx_kN;fy_kN;fz_kN;mx_kNm;my_kNm;mz_kNm"
_ROWS = ["0;12,5;420;15;-1080;3900;650;280", "0,5;12,5;421,75;14,9;-995;3904;740,7;276,9"]
_FORCE = [[420e3, 15e3, -1080e3], [421.75e3, 14.9e3, -995e3]]


def _comma(text):
    """The same table with commas between columns and decimal points."""
    return text.replace(",", ".").replace(";", ",")


def _read_text(path, text, encoding="utf-8", **options):
    path.write_bytes(text.encode(encoding))
    return HubLoads.read(path, **options)


@pytest.mark.parametrize(
    ("text", "encoding"),
    [
        ("\n".join(["sep=;", _NAMES, *_ROWS]), "utf-8"),
        ("\r\n".join(["sep=;", _NAMES, *_ROWS]), "utf-8-sig"),
        ("\n".join(["# exported, 12 m/s", "", _NAMES, *_ROWS, "# end"]), "utf-8"),
        ("\n".join([f"# {_comma(_NAMES)}", *map(_comma, _ROWS)]), "utf-8"),
        ("\n".join([_comma(_NAMES), "s,rpm,kN,kN,kN,kNm,kNm,kNm", *map(_comma, _ROWS)]), "utf-8"),
        ("\n".join([_NAMES, *_ROWS, ";" * 7, ";" * 7, ""]), "utf-8"),
        ("\n".join(f"{line};" for line in (_NAMES, *_ROWS)), "utf-8"),
        ("\n".join([_NAMES, *(f"{line};;" for line in _ROWS)]), "utf-8"),
        ("\n".join(f"{line};" for line in (_NAMES, _ROWS[0])) + f"\n{_ROWS[1]};", "utf-8"),
        ("\n".join([_NAMES, *_ROWS]).replace(";", "\t"), "utf-16"),
        ("\n".join([f"{_NAMES};wind_°", *(f"{row};****" for row in _ROWS)]), "latin-1"),
        (
            "\n".join(
                [
                    _comma(_NAMES),
                    *(",".join(f'"{cell}"' for cell in row.split(";")) for row in _ROWS),
                ]
            ),
            "utf-8",
        ),
        (
            "\n".join(
                [
                    "Time_[s],RotSpeed_[rpm],LSShftFxa_[kN],LSShftFys_[kN],LSShftFzs_[kN],"
                    "LSShftMxa_[kN-m],LSSTipMys_[kN-m],LSSTipMzs_[kN-m]",
                    *map(_comma, _ROWS),
                ]
            ),
            "utf-8",
        ),
        (
            "\n".join(
                [
                    "time,rotor_speed,fx,fy,fz,mx,my,mz",
                    "[s],[rpm],[kN],[kN],[kN],[kN m],[kN m],[kN m]",
                    *map(_comma, _ROWS),
                ]
            ),
            "utf-8",
        ),
    ],
)
def test_csv_of_other_programs(tmp_path, text, encoding):
    hub = _read_text(tmp_path / "a.csv", text, encoding)
    assert hub.force == pytest.approx(np.array(_FORCE), rel=1e-12)
    assert hub.moment[1] == pytest.approx([3904e3, 740.7e3, 276.9e3], rel=1e-12)
    assert hub.time.tolist() == [0.0, 0.5]
    assert hub.shaft_speed == pytest.approx(np.full(2, 12.5 * np.pi / 30.0))


def test_names_with_units_in_a_parquet_file(tmp_path):
    other_names = {"fx_N": "LSShftFxa_[N]", "mx_Nm": "LSShftMxa (kN-m)", "fz_N": "fz [N]"}
    columns = {other_names.get(name, name): values for name, values in HUB.items()}
    read = HubLoads.read(_write(tmp_path / "a.parquet", columns))
    assert read.force[0].tolist() == [1e5, 1.0, -1e5]
    assert read.moment[0].tolist() == [7e8, 1e5, 0.0]


@pytest.mark.parametrize("extension", ["csv", "parquet"])
def test_rotating_and_negated_channels_that_a_tool_exported(tmp_path, extension):
    """Blade 1 turns by 90 degrees a sample: fy = ya cos − za sin, fz = ya sin + za cos."""
    columns = {
        "Time_[s]": [0.0, 0.1, 0.2, 0.3],
        "Wind1VelX_[m/s]": [9.0, 9.0, 9.0, 9.0],
        "LSSTipVxa_[rpm]": [12.0, 12.0, 12.0, 12.0],
        "Azimuth_[deg]": [0.0, 90.0, 180.0, 270.0],
        "-RotThrust_[kN]": [-400.0, -400.0, -400.0, -400.0],
        "LSSGagFya_[kN]": [5.0, -900.0, -5.0, 900.0],
        "LSSGagFza_[kN]": [-900.0, -5.0, 900.0, 5.0],
        "RotTorq_[kN-m]": [3900.0, 3900.0, 3900.0, 3900.0],
        "LSSGagMys_[kN-m]": [-1800.0 + 650.0] * 4,
        "LSSGagMzs_[kN-m]": [-10.0 - 240.0] * 4,
    }
    path = tmp_path / f"a.{extension}"
    if extension == "csv":
        rows = zip(*columns.values(), strict=True)
        lines = [",".join(columns), *(",".join(map(str, row)) for row in rows)]
        path.write_text("\n".join(lines) + "\n")
    else:
        _write(path, columns)
    with pytest.raises(InputError, match="LSSTipMys, LSSTipMzs are not in the file"):
        HubLoads.read(path)
    read = HubLoads.read(path, hub_to_output=2.0)
    assert read.force == pytest.approx(np.tile([400e3, 5e3, -900e3], (4, 1)))
    assert read.moment == pytest.approx(np.tile([3900e3, 650e3, -240e3], (4, 1)))
    assert "-RotThrust (kN), its sign turned back" in read.reading


def test_own_names_beside_the_time_and_speed_of_openfast(tmp_path):
    header = "Time [s],RotSpeed [rpm],fx [kN],fy [kN],fz [kN],mx [kNm],my [kNm],mz [kNm]"
    hub = _read_text(tmp_path / "a.csv", "\n".join([header, *map(_comma, _ROWS)]), "utf-8")
    assert hub.force == pytest.approx(np.array(_FORCE), rel=1e-12)


_THOUSANDS = "\n".join([_NAMES, "0;12;420;6;-1.020;900;650;-240", "1;12;423;6;-975;900;650;-240"])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (_THOUSANDS, ["column fz_kN holds '-1.020' beside '-975'", "-1020", "-1.020"]),
        (_THOUSANDS.replace("-1.020", "-1,020"), ["'-1,020' beside '-975'", "the comma may"]),
        (_THOUSANDS.replace("-1.020;900", "1;2.888.888"), ["'2.888.888'", "its point twice"]),
        (_THOUSANDS.replace(";12;", ";12,5;"), ["'-1.020' with a point", "'12,5' with a comma"]),
        (
            _THOUSANDS.replace("-1.020", "-1'020.5"),
            ["""column fz_kN holds "-1'020.5", not a""", """write loads: {thousands: "'"}"""],
        ),
        (
            _THOUSANDS.replace("-1.020", "-1\u202f020"),
            ["020', not a number", 'write loads: {thousands: " "}'],
        ),
        (_THOUSANDS.replace("-1.020", "0xA0"), ["column fz_kN holds '0xA0', not a number"]),
        (_THOUSANDS.replace("-1.020", "-********"), ["'-********'", "did not fit into its field"]),
        (_THOUSANDS.replace("-1.020", "\u22121020"), ["minus sign U+2212"]),
        (
            _THOUSANDS.replace("-1.020", "-99").replace("\n0;", "\n2025-02-01T08:00:00;"),
            ["column time_s", "is a date"],
        ),
        (_NAMES.replace(";", ",") + "\n0,1,12,1,420,5,15,0,-1080,0,3900,0,650,0,280,0", ["16 val"]),
        (_THOUSANDS.replace("time_s", "").replace("_kN", ""), ["column fx has no known unit"]),
    ],
)
def test_refused_with_its_cause(tmp_path, text, words):
    (tmp_path / "a.csv").write_text(text, encoding="utf-8")
    _message(tmp_path / "a.csv", *words)


@pytest.mark.parametrize(
    ("options", "fz"),
    [({"thousands": "."}, -1020e3), ({"decimal": "."}, -1.02e3), ({"decimal": ","}, None)],
)
def test_marks_that_are_given(tmp_path, options, fz):
    path = tmp_path / "a.csv"
    if fz is None:
        with pytest.raises(InputError, match="column fz_kN holds '-1.020', not a number"):
            _read_text(path, _THOUSANDS, **options)
    else:
        assert _read_text(path, _THOUSANDS, **options).force[0, 2] == pytest.approx(fz)


@pytest.mark.parametrize(
    ("numbers", "advice"),
    [
        # 280.000 and 1,020 mean 280 and 1020: with the other marks 12.5 would be no number.
        (
            {"-1.020": "-1,020", ";12;": ";12.5;", "650": "280.000"},
            ('decimal: ".", thousands: ","',),
        ),
        ({"-1.020": "-1.020", ";12;": ";12,5;"}, ('decimal: ",", thousands: "."',)),
        (
            {"-1.020": "-1,020", "650": "280.000"},
            ('decimal: ".", thousands: ","', 'decimal: ",", thousands: "."'),
        ),
        ({"-1.020": "-1,02", ";12;": ";12.5;"}, ("the same mark before the decimals",)),
    ],
)
def test_only_marks_with_which_every_number_can_be_read_are_advised(tmp_path, numbers, advice):
    text = _THOUSANDS
    for plain, marked in numbers.items():
        text = text.replace(plain, marked)
    (tmp_path / "a.csv").write_text(text)
    message = _message(tmp_path / "a.csv", "with a point and", "with a comma", *advice)
    assert message.count("{decimal: ") == sum("decimal: " in words for words in advice)


def test_every_mark_of_thousands(tmp_path):
    for mark in (".", ",", "'", "\u2019", " ", "\u00a0", "\u202f"):
        decimal = "," if mark == "." else "."
        text = _THOUSANDS.replace("-1.020", f"-1{mark}020{decimal}5")
        plain = {"\u2019": "'", "\u00a0": " ", "\u202f": " "}
        given = "thousands", plain.get(mark, mark)
        hub = _read_text(tmp_path / "a.csv", text, decimal=decimal, **dict([given]))
        assert hub.force[:, 2].tolist() == [-1020.5e3, -975e3]


def _grouped(*, time=("0", "1"), speed="12", fx="420", separator=";"):
    """Two rows whose forces fz are -1.020 and -1.075, at given times, speed and fx."""
    header = _NAMES.replace(";", separator)
    rows = [
        separator.join([time[0], speed, fx, "6", "-1.020", "900", "650", "-240"]),
        separator.join([time[1], speed, fx, "6", "-1.075", "900", "650", "-240"]),
    ]
    return "\n".join([header, *rows])


@pytest.mark.parametrize(
    "text",
    [
        _grouped(),
        _grouped(separator=","),
        _grouped(fx="20.125"),
        # Nothing but thousands: 1,000 s and 1,001 s at a shaft speed of 12 rpm.
        _grouped(time=("1.000", "1.001")),
        # A whole number of four digits stands without marks, in another column.
        _grouped(fx="1420"),
        _grouped().replace(".", ","),
    ],
)
def test_a_table_in_which_every_mark_may_separate_thousands_is_refused(tmp_path, text):
    path = tmp_path / "a.csv"
    path.write_text(text)
    _message(path, "may separate decimals or thousands, and no number of another column tells")
    mark = "," if "," in text.partition("\n")[2] and ";" in text else "."
    assert HubLoads.read(path, thousands=mark).force[0, 2] == -1020e3
    assert HubLoads.read(path, decimal=mark).force[0, 2] == pytest.approx(-1.02e3)


@pytest.mark.parametrize(
    "text",
    [
        # As programs export three decimals: a time of 0.000 s, a shaft speed of 12.345 rpm.
        _grouped(time=("0.000", "1.000")),
        _grouped(time=("0.05", "0.10")),
        _grouped(speed="12.345"),
        _grouped(speed="12.345", separator=","),
        _grouped(fx="1420.123"),
        _grouped(fx="420.5"),
        _grouped(fx="-0.420"),
        _grouped(fx="4.2e2"),
        _grouped(time=("0.000", "1.000")).replace(".", ","),
    ],
)
def test_one_number_that_cannot_be_in_groups_shows_that_a_table_has_decimals(tmp_path, text):
    assert _read_text(tmp_path / "a.csv", text).force[:, 2] == pytest.approx([-1.02e3, -1.075e3])


def test_a_number_with_a_zero_before_its_point_excludes_thousands(tmp_path):
    text = _THOUSANDS + "\n2;12;423;6;0.975;900;650;-240"
    assert _read_text(tmp_path / "a.csv", text).force[0, 2] == pytest.approx(-1.02e3)


def test_marks_for_a_file_without_text(tmp_path):
    path = _write(tmp_path / "a.parquet", HUB)
    with pytest.raises(InputError, match="for a file that is no CSV table"):
        HubLoads.read(path, decimal=",")
    with pytest.raises(InputError, match="decimal is ';'. Allowed"):
        HubLoads.read(_write(tmp_path / "a.csv", HUB), decimal=";")
    with pytest.raises(InputError, match="both"):
        HubLoads.read(tmp_path / "a.csv", decimal=",", thousands=",")


@pytest.mark.parametrize("separator", [";", "\t", "|"])
def test_the_separator_that_the_first_line_says(tmp_path, separator):
    text = f"sep={separator}\n" + _grouped(fx="420.5", separator=separator)
    assert _read_text(tmp_path / "a.csv", text).force[0, :2].tolist() == [420.5e3, 6e3]


@pytest.mark.parametrize("name", ["rotor_speed_rpm", "rotor_speed_hz", "RotSpeed_[rpm]"])
def test_a_column_of_the_speed_does_not_matter_where_the_speed_is_given(tmp_path, name):
    path = tmp_path / "a.csv"
    text = _grouped(fx="420.5", speed="****").replace("rotor_speed_rpm", name)
    if name.startswith("Rot"):
        components = [f"LSShft{axes}" for axes in ("Fxa", "Fys", "Fzs", "Mxa")]
        components += ["LSSTipMys", "LSSTipMzs"]
        units = ["kN", "kN", "kN", "kN-m", "kN-m", "kN-m"]
        channels = [f"{channel}_[{unit}]" for channel, unit in zip(components, units, strict=True)]
        text = "\n".join([";".join(["Time_[s]", name, *channels]), *text.split("\n")[1:]])
    path.write_text(text)
    _message(path, name.partition("_[")[0], "rotor_speed" if name.endswith("hz") else "'****'")
    read = HubLoads.read(path, shaft_speed=1.25)
    assert read.shaft_speed.tolist() == [1.25, 1.25]
    assert read.force[0, 0] == 420.5e3
    assert [line for line in read.reading if "speed" in line.lower()] == [
        "shaft speed: given, 1.25 rad/s"
    ]


def _export(frame, path):
    writers = {".csv": frame.to_csv, ".parquet": frame.to_parquet, ".xlsx": frame.to_excel}
    writers[path.suffix](path, index=False)


@pytest.mark.parametrize("extension", ["csv", "parquet", "xlsx"])
def test_text_matters_in_the_channels_of_openfast_that_are_taken(tmp_path, extension):
    names = ["Time", "RotSpeed", "LSShftFxa", "LSShftFys", "LSShftFzs", "LSShftMxa"]
    names = [*names, "LSSTipMys", "LSSTipMzs", "LSSGagMys"]
    units = ["s", "rpm", "kN", "kN", "kN", "kN-m", "kN-m", "kN-m", "kN-m"]
    frame = pd.DataFrame(
        [[0.0, 12.0, 420.0, 6.0, -1020.0, 900.0, 650.0, -240.0, "****"]] * 2,
        columns=[f"{name}_[{unit}]" for name, unit in zip(names, units, strict=True)],
    )
    frame.loc[1, "Time_[s]"] = 1.0
    path = tmp_path / f"a.{extension}"
    _export(frame, path)
    read = HubLoads.read(path)
    assert read.force[0].tolist() == [420e3, 6e3, -1020e3]
    frame = frame.rename(columns={"LSSTipMys_[kN-m]": "a", "LSSGagMys_[kN-m]": "LSSTipMys_[kN-m]"})
    _export(frame, path)
    _message(path, "channel LSSTipMys holds '****' (row 1 of the data)", "as numbers")
