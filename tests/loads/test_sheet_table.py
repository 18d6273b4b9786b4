"""Loads in a workbook of Excel are those of the same table in a CSV file."""

import datetime

import numpy as np
import openpyxl
import pytest

from macroslip.errors import InputError
from macroslip.loads import BearingLoads, HubLoads, RollerLoads

HUB = (
    ["time_s", "rotor_speed_rpm", "fx_kN", "fy_kN", "fz_kN", "mx_kNm", "my_kNm", "mz_kNm"],
    [0.0, 19, 164.4, -2.3, -263, 726, 154.4, 36.6],
    [0.05, 19.5, 165.4, -2.1, -263.5, 727, 150, 30],
    [0.1, 20, 166.4, -2, -264, 728, 151, 31],
)


def save(path, **sheets):
    book = openpyxl.Workbook()
    book.remove(book.active)
    for name, rows in sheets.items():
        sheet = book.create_sheet(name)
        for row in rows:
            sheet.append(list(row))
    book.save(path)
    return path


def as_csv(path, rows):
    path.write_text("\n".join(",".join(map(str, row)) for row in rows) + "\n")
    return path


def same(loads, other):
    for name in ("time", "shaft_speed", "force"):
        np.testing.assert_array_equal(getattr(loads, name), getattr(other, name))


def test_hub_loads_of_a_named_sheet(tmp_path):
    book = save(tmp_path / "loads.xlsx", notes=[["words"]], loads=HUB)
    read = HubLoads.read(book, sheet="loads")
    wanted = HubLoads.read(as_csv(tmp_path / "loads.csv", HUB))
    same(read, wanted)
    np.testing.assert_array_equal(read.moment, wanted.moment)
    assert read.reading == wanted.reading


def test_a_line_of_units_stands_below_the_names(tmp_path):
    names = ["time", "rotor_speed", "fx", "fy", "fz", "mx", "my", "mz"]
    units = ["s", "rpm", *["kN"] * 3, *["kNm"] * 3]
    book = save(tmp_path / "loads.xlsx", loads=[names, units, *HUB[1:]])
    same(HubLoads.read(book), HubLoads.read(as_csv(tmp_path / "loads.csv", HUB)))


def test_names_as_people_write_them_above_a_sheet(tmp_path):
    forces = [f"{name} [kN]" for name in ("fx", "fy", "fz")]
    moments = [f"{name} [kNm]" for name in ("mx", "my", "mz")]
    names = ["Time [s]", "Rotor speed [rpm]", *forces, *moments]
    book = save(tmp_path / "loads.xlsx", loads=[names, *HUB[1:]])
    same(HubLoads.read(book), HubLoads.read(as_csv(tmp_path / "loads.csv", HUB)))


def test_another_sheet_is_thought_of_where_the_first_has_no_loads(tmp_path):
    book = save(tmp_path / "loads.xlsx", notes=[["turbine X"], ["17 m/s"]], loads=HUB)
    with pytest.raises(InputError, match="Another sheet of the workbook is read if the key sheet"):
        HubLoads.read(book)


def test_bearing_and_roller_loads(tmp_path):
    rows = (
        ["time_s", "shaft_speed_rad_s", "F_X0_N", "F_Y0_N", "F_Z0_N"],
        [0, 2, 1e3, -3e5, 1e5],
        [1, 2, 2e3, -3e5, 1e5],
    )
    book = save(tmp_path / "b.xlsx", bearing=rows)
    same(BearingLoads.read(book), BearingLoads.read(as_csv(tmp_path / "b.csv", rows)))
    header = ["time_s", "shaft_speed_rpm", "row", "angle_deg", "load_N"]
    rollers = [
        [time, 20, row, angle, 1e4 + angle]
        for time in (0, 1)
        for row in ("downwind", "upwind")
        for angle in (0, 180)
    ]
    book = save(tmp_path / "r.xlsx", rollers=[header, *rollers])
    wanted = RollerLoads.read(as_csv(tmp_path / "r.csv", [header, *rollers]))
    np.testing.assert_array_equal(RollerLoads.read(book, sheet="rollers").load, wanted.load)


@pytest.mark.parametrize(
    ("cell", "message"),
    [
        ("165,4", "holds '165,4', which is not stored as a number, in row 2.*Text to Columns"),
        (datetime.datetime(2026, 1, 1), "in row 2 below the header.*date or a time of day"),
        (True, "not stored as a number"),
        (None, "fx is nan"),
    ],
)
def test_a_cell_that_is_no_number_is_named(tmp_path, cell, message):
    rows = [list(row) for row in HUB]
    rows[2][2] = cell
    with pytest.raises(InputError, match=message):
        HubLoads.read(save(tmp_path / "x.xlsx", loads=rows))


def test_an_empty_sheet_says_how_to_name_another(tmp_path):
    book = save(tmp_path / "x.xlsx", empty=[], loads=HUB)
    with pytest.raises(InputError, match="first sheet: the sheet is empty.*key sheet"):
        HubLoads.read(book)


def test_a_sheet_of_another_file_is_refused(tmp_path):
    path = as_csv(tmp_path / "x.csv", HUB)
    for reader in (HubLoads, BearingLoads):
        with pytest.raises(InputError, match="sheet 'loads' is named for a file that is no"):
            reader.read(path, sheet="loads")
    with pytest.raises(InputError, match="no CSV table"):
        HubLoads.read(save(tmp_path / "x.xlsx", loads=HUB), decimal=",")
