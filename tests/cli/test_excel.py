"""`--xlsx`: the tables of a command as a workbook, its numbers those of the other outputs."""

import json

import openpyxl
import pandas as pd
import pytest
import xarray as xr

pytestmark = pytest.mark.slow

LAST = "input and origin"


def test_run_damage_and_compare(quick, folder, macroslip):
    case = quick()
    done = macroslip("run", case, "-o", "cold.nc", "--xlsx", "cold.xlsx")
    assert done.code == 0 and "written: cold.xlsx" in done.out
    book = openpyxl.load_workbook("cold.xlsx")
    assert book.sheetnames[0] == "answer" and book.sheetnames[-1] == LAST
    energies = pd.read_excel("cold.xlsx", "row roller interface").set_index(
        ["row", "roller", "interface"]
    )
    with xr.open_dataset("cold.nc", engine="h5netcdf") as result:
        wanted = result.energy.to_series()
        named = json.loads(result.attrs["input"])["bearing"]["name"]
    pd.testing.assert_series_equal(
        energies["energy [J]"].sort_index(), wanted.sort_index(), check_names=False, rtol=1e-12
    )
    origin = pd.read_excel("cold.xlsx", LAST).set_index("key")
    assert origin.loc["bearing.name", "value"] == named
    # A number of the input is a number, beside its unit and its origin.
    clearance = origin.loc["bearing.diametral_clearance"]
    assert isinstance(clearance["value"], int | float) and clearance["unit"] == "mm"
    # What exists stays, unless it is to be replaced.
    again = macroslip("run", case, "-o", "other.nc", "--xlsx", "cold.xlsx")
    assert again.code == 2 and "the file exists" in again.err and not (folder / "other.nc").exists()
    wrong = macroslip("run", case, "-o", "other.nc", "--xlsx", "cold.xls")
    assert wrong.code == 2 and "Name the file cold.xlsx" in wrong.err

    assert macroslip("run", quick("temperature: 60 degC\n"), "-o", "warm.nc").code == 0
    done = macroslip("compare", "cold.nc", "warm.nc", "--xlsx", "both.xlsx")
    assert done.code == 0 and "written: both.xlsx" in done.out
    printed = json.loads(macroslip("compare", "cold.nc", "warm.nc", "--json", "--force").out)
    designs = pd.read_excel("both.xlsx", "designs").set_index("design")
    for number in printed["numbers"]:
        heading = f"{number['quantity']} [{number['units']}]"
        assert designs.loc[number["design"], heading] == pytest.approx(number["value"], rel=1e-12)
    assert set(pd.read_excel("both.xlsx", LAST)["of"].dropna()) == {"cold", "warm"}


def test_damage_of_contacts_with_details(quick, macroslip):
    further = "laws: {model: physical}\n"
    assert macroslip("run", quick(further), "-o", "a.nc", "--quiet").code == 0
    done = macroslip("damage", "a.nc", "--xlsx", "damage.xlsx")
    assert done.code == 0 and "written: damage.xlsx" in done.out
    lines = json.loads(macroslip("damage", "a.nc", "--json").out)["criteria"]
    criteria = pd.read_excel("damage.xlsx", "criteria")
    assert criteria["value"].tolist() == pytest.approx([line["value"] for line in lines])
    assert openpyxl.load_workbook("damage.xlsx").sheetnames[-1] == LAST
    assert macroslip("damage", "a.nc", "--xlsx", "damage.xlsx").code == 2
    assert macroslip("damage", "a.nc", "--xlsx", "damage.xlsx", "--force").code == 0


def test_aggregate_of_a_study_whose_loads_stand_in_a_sheet(folder, macroslip):
    from macroslip.loads import HubLoads

    loads = HubLoads.bundled("14B").window(60.0, 68.0)
    names = ["time_s", "shaft_speed_rad_s", "fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm"]
    rows = pd.DataFrame(
        [
            [time, speed, *force, *moment]
            for time, speed, force, moment in zip(
                loads.time, loads.shaft_speed, loads.force, loads.moment, strict=True
            )
        ],
        columns=names,
    )
    with pd.ExcelWriter("loads.xlsx") as writer:
        pd.DataFrame({"about": ["own loads"]}).to_excel(writer, sheet_name="about", index=False)
        rows.to_excel(writer, sheet_name="loads", index=False)
    listed = pd.DataFrame({"file": ["loads.xlsx"], "wind_speed": [14]})
    listed.to_excel("list.xlsx", sheet_name="runs", index=False)
    (folder / "study.yaml").write_text(
        "case: {rollers: [0], laws: {model: paper}, loads: {sheet: loads}}\n"
        "loads: {table: list.xlsx, sheet: runs}\nweights: {wind: {weibull: IEC II}}\n",
        encoding="utf-8",
    )
    done = macroslip("study", "study.yaml", "-o", "out", "--quiet")
    assert done.code == 0, done.err
    done = macroslip("aggregate", "out", "-o", "tables", "--xlsx", "tables/all.xlsx")
    assert done.code == 0, done.err
    for name in openpyxl.load_workbook("tables/all.xlsx").sheetnames[:-1]:
        sheet = pd.read_excel("tables/all.xlsx", name)
        table = pd.read_csv(folder / "tables" / f"{name}.csv")
        pd.testing.assert_frame_equal(sheet, table, check_dtype=False, rtol=1e-12)
    shown = macroslip("loads", "inspect", "loads.xlsx", "--sheet", "loads", "--json")
    assert json.loads(shown.out)["samples"] == loads.time.size
