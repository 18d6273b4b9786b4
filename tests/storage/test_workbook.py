"""Workbooks: what is written is read again by openpyxl itself, and a sheet is read as it was written by openpyxl."""

import math
import sys

import numpy as np
import openpyxl
import pandas as pd
import pytest

from macroslip.errors import InputError, MacroslipError
from macroslip.storage.workbook import sheet_cells, workbook


def written(tmp_path, tables):
    path = tmp_path / "book.xlsx"
    path.write_bytes(workbook(tables))
    return openpyxl.load_workbook(path)


def test_numbers_are_numbers_and_text_is_text(tmp_path):
    table = pd.DataFrame(
        {
            "name": ["a", "=1+1", "bell \x07"],
            "energy [J]": [0.1, math.nan, math.inf],
            "count": np.array([1, 2, 3], dtype=np.int32),
            "mixed": [1.5, "text", None],
        }
    )
    sheet = written(tmp_path, {"rows [J]/h": table})["rows  J  h"]
    assert sheet.freeze_panes == "A2"
    header, first, second, third = map(list, sheet.iter_rows())
    assert [cell.value for cell in header] == ["name", "energy [J]", "count", "mixed"]
    assert [cell.data_type for cell in first] == ["s", "n", "n", "n"]
    assert [cell.value for cell in first] == ["a", 0.1, 1, 1.5]
    # What looks like a formula is none.
    assert second[0].value == "=1+1" and second[0].data_type != "f"
    assert second[1].value is None and third[1].value == "inf"
    assert third[0].value == "bell  "


def test_a_table_that_no_sheet_holds_is_refused():
    with pytest.raises(InputError, match="has 1048576 rows.*1048575"):
        workbook({"large": pd.DataFrame({"a": np.zeros(2**20)})})


@pytest.fixture
def book(tmp_path):
    made = openpyxl.Workbook()
    made.active.title = "about"
    made.active["A1"] = "nothing but words"
    sheet = made.create_sheet("14 m per s")
    for row in ([], [None, "time_s", "fx_kN"], [None, 0, 1.5], [None, 0.1, None], [None, None]):
        sheet.append(row)
    path = tmp_path / "own.xlsx"
    made.save(path)
    return path


def test_a_sheet_is_found_by_its_name_and_trimmed(book):
    assert sheet_cells(book) == [["nothing but words"]]
    assert sheet_cells(book, "14 m per s") == [["time_s", "fx_kN"], [0, 1.5], [0.1, None]]


def test_a_sheet_that_is_not_there_is_named_with_those_that_are(book):
    with pytest.raises(InputError, match="no sheet 'loads'.*about, 14 m per s"):
        sheet_cells(book, "loads")


def test_a_file_that_is_no_workbook_is_damaged(tmp_path):
    path = tmp_path / "x.xlsx"
    path.write_text("time_s,fx_kN\n")
    with pytest.raises(InputError, match="damaged.*Write the workbook again"):
        sheet_cells(path)


def test_without_the_package_the_line_that_installs_it_is_named(book, monkeypatch):
    monkeypatch.setitem(sys.modules, "openpyxl", None)
    with pytest.raises(MacroslipError, match=r"pip install 'macroslip\[excel\]'"):
        sheet_cells(book)
