"""`macroslip loads inspect` on genuine files."""

import json
from pathlib import Path

import numpy as np
import pytest

from macroslip import Drivetrain, HubLoads, main_bearing_load

DATA = Path(__file__).parents[1] / "data"


def rows(text):
    """The numbers of every line of the tables, by the name in front."""
    by_channel = {}
    for line in text.splitlines():
        name, bracket, numbers = line.partition("]")
        if bracket and len(numbers.split()) == 4:
            by_channel[f"{name.strip()}]"] = [float(number) for number in numbers.split()]
    return by_channel


def test_an_openfast_file(macroslip):
    path = DATA / "sample14B.outb"
    done = macroslip("loads", "inspect", path)
    assert (done.code, done.err) == (0, "")
    lines = done.out.splitlines()
    assert lines[:13] == [
        f"source    {path}",
        "kind      hub loads in non-rotating shaft axes",
        "taken     Time (s)",
        "          RotSpeed (rpm)",
        "          LSShftFxa (kN)",
        "          LSShftFys (kN)",
        "          LSShftFzs (kN)",
        "          LSShftMxa (kN-m)",
        "          LSSTipMys (kN-m)",
        "          LSSTipMzs (kN-m)",
        "samples   1201",
        "time      60 s to 120 s",
        "step      0.05 s",
    ]
    loads = HubLoads.read(path)
    bearing = main_bearing_load(loads, Drivetrain())
    table = rows(done.out)
    for name, values in {
        "shaft speed [rpm]": loads.shaft_speed * 30 / np.pi,
        "fz [kN]": loads.force[:, 2] / 1e3,
        "my [kN m]": loads.moment[:, 1] / 1e3,
        "F_Y0 [kN]": bearing.force[:, 1] / 1e3,
        "radial [kN]": np.hypot(*bearing.force[:, :2].T) / 1e3,
    }.items():
        assert table[name] == pytest.approx(
            [values.mean(), values.std(), values.min(), values.max()], rel=1e-3
        ), name
    assert (
        "load on the main bearing, with the default drivetrain (1.26 m from hub to bearing, 2.2 m from bearing to "
        "gearbox, no shaft mass)" in lines
    )


@pytest.mark.parametrize("kind", ["csv", "parquet"])
def test_a_table_of_bearing_loads(folder, macroslip, kind):
    import pyarrow as pa
    import pyarrow.csv
    import pyarrow.parquet

    table = pa.table({"time_s": [0.0, 0.1, 0.2], "shaft_speed_rpm": [1.0, 2.0, 3.0], "F_X0_kN": [3.0, 3.0, 3.0],
                      "F_Y0_kN": [-4.0, -4.0, -4.0], "F_Z0_kN": [0.0, 1.0, 2.0]})  # fmt: skip
    write = pa.csv.write_csv if kind == "csv" else pa.parquet.write_table
    write(table, folder / f"loads.{kind}")
    done = macroslip("loads", "inspect", f"loads.{kind}")
    assert (done.code, done.err) == (0, "")
    assert "kind      load on the main bearing" in done.out and "drivetrain" not in done.out
    assert rows(done.out)["radial [kN]"] == [5.0, 0.0, 5.0, 5.0]
    assert rows(done.out)["shaft speed [rpm]"] == pytest.approx([2.0, 0.8165, 1.0, 3.0])


def test_uneven_steps_are_reported(folder, macroslip):
    lines = "".join(f"{t},1,1,1,1\n" for t in (0, 1, 2.2, 3.2))
    (folder / "loads.csv").write_text("time_s,shaft_speed_rpm,F_X0_kN,F_Y0_kN,F_Z0_kN\n" + lines)
    assert "step      1 s (median; 1 s to 1.2 s)" in macroslip("loads", "inspect", "loads.csv").out


def test_semicolons_and_decimal_commas_in_a_table_of_bearing_loads(folder, macroslip):
    lines = "".join(f"{t},5;1;3,25;-4;0\n" for t in range(3))
    (folder / "loads.csv").write_text("time_s;shaft_speed_rpm;F_X0_kN;F_Y0_kN;F_Z0_kN\n" + lines)
    done = macroslip("loads", "inspect", "loads.csv")
    assert "kind      load on the main bearing" in done.out and rows(done.out)["F_X0 [kN]"] == [
        3.25,
        0.0,
        3.25,
        3.25,
    ]


@pytest.mark.parametrize(
    ("file", "content", "message"),
    [
        ("absent.outb", None, "absent.outb: no such file. Check the path; the current folder is FOLDER."),
        ("notes.txt", b"x", "notes.txt: the extension '.txt' is not known. Allowed: .outb (OpenFAST binary output), "
                            ".out (OpenFAST text output), .%nn (Bladed output, any file of the run), .$nn (the same), "
                            ".sel (HAWC2 output), .dat (HAWC2 output, with its .sel beside it), .hdf5 (HAWC2 output in the format gtsdf), .h5 (the same), .parquet (table), "
                            ".csv (table), .xlsx (workbook of Excel)."),
        ("empty.csv", b"", "empty.csv: the file is empty. Write or copy the file again."),
        ("cut.outb", b"\x02\x00\x01", "cut.outb: the file is cut off within its header. Copy the file again, or run "
                                      "OpenFAST again."),
    ],
)  # fmt: skip
def test_files_that_cannot_be_read(folder, macroslip, file, content, message):
    if content is not None:
        (folder / file).write_bytes(content)
    done = macroslip("loads", "inspect", file)
    assert (done.code, done.out, done.err) == (
        2,
        "",
        f"error: {message.replace('FOLDER', str(folder))}\n",
    )


def test_a_damaged_parquet_file(folder, macroslip):
    (folder / "loads.parquet").write_bytes((DATA / "hub14B_50Hz.parquet").read_bytes()[:3000])
    done = macroslip("loads", "inspect", "loads.parquet")
    assert done.code == 2 and done.err.startswith(
        "error: loads.parquet: not readable as a Parquet table"
    )


def inspected(macroslip, *arguments):
    done = macroslip("loads", "inspect", *arguments, "--json")
    assert (done.code, done.err) == (0, "")
    return json.loads(done.out)


def test_a_drivetrain_of_ones_own_from_options_and_from_a_case_file(folder, macroslip):
    path = DATA / "sample14B.outb"
    (folder / "case.yaml").write_text(
        "loads: {bundled: 14B}\ndrivetrain: {hub_to_bearing: 1.9 m, bearing_to_gearbox: 2.6 m, tilt: 6 deg}\n"
    )
    own = Drivetrain(hub_to_bearing=1.9, bearing_to_gearbox=2.6, tilt=np.radians(6.0))
    options = ["--hub-to-bearing", "1.9 m", "--bearing-to-gearbox", "2600 mm", "--tilt", "6 deg"]
    for arguments in (options, ["--case", "case.yaml"]):
        printed = inspected(macroslip, path, *arguments)
        expected = main_bearing_load(HubLoads.read(path), own).force.mean(axis=0) / 1e3
        means = [
            printed["main bearing"][f"{name} [kN]"]["mean"] for name in ("F_X0", "F_Y0", "F_Z0")
        ]
        assert means == pytest.approx(expected, rel=1e-12)
        assert not printed["drivetrain"]["default"]
    both = inspected(macroslip, path, "--case", "case.yaml", "--bearing-to-gearbox", "2.2 m")
    assert (
        both["drivetrain"]["bearing_to_gearbox [m]"] == 2.2
        and both["drivetrain"]["hub_to_bearing [m]"] == 1.9
    )


def test_a_four_point_mount_from_a_case_file(folder, macroslip):
    path = DATA / "sample14B.outb"
    (folder / "case.yaml").write_text(
        "loads: {bundled: 14B}\ndrivetrain: {mount: four-point, hub_to_bearing: 1.3 m, front_to_rear: 1.8 m, "
        "locating: rear, bearing: front}\n"
    )
    own = Drivetrain(
        mount="four-point", hub_to_bearing=1.3, front_to_rear=1.8, locating="rear", bearing="front"
    )
    expected = main_bearing_load(HubLoads.read(path), own).force.mean(axis=0) / 1e3
    statistics = inspected(macroslip, path, "--case", "case.yaml")["main bearing"]
    means = [statistics[f"{name} [kN]"]["mean"] for name in ("F_X0", "F_Y0", "F_Z0")]
    assert means == pytest.approx(expected, rel=1e-12)
    assert (
        "1.8 m from front to rear bearing, rear locating"
        in macroslip("loads", "inspect", path, "--case", "case.yaml").out
    )


def test_a_shaft_speed_of_ones_own(macroslip):
    printed = inspected(macroslip, DATA / "sample14B.outb", "--shaft-speed", "12 rpm")
    assert printed["statistics"]["shaft speed [rpm]"] == pytest.approx(
        {"mean": 12, "std": 0, "min": 12, "max": 12}
    )
    assert printed["reading"][-1].startswith("shaft speed: given, ")


def test_a_point_of_output_of_ones_own(macroslip):
    """From 2 m behind the hub, my is less by 2 m times fz."""
    path = DATA / "sample14B.outb"
    plain, moved = inspected(macroslip, path), inspected(macroslip, path, "--hub-to-output", "2 m")
    fz, before, after = (
        read["statistics"][name]["mean"]
        for read, name in ((plain, "fz [kN]"), (plain, "my [kN m]"), (moved, "my [kN m]"))
    )
    assert after == pytest.approx(before - 2.0 * fz, rel=1e-9)
    assert moved["reading"][-1] == "moments moved to the hub from 2 m behind it"


def test_keys_of_the_case_for_its_own_file(folder, macroslip):
    (folder / "own.outb").write_bytes((DATA / "sample14B.outb").read_bytes())
    (folder / "case.yaml").write_text(
        "loads: {file: own.outb, start: 70 s, hub_to_output: 2 m, shaft_speed: 12 rpm}\n"
    )
    own = inspected(macroslip, folder / "own.outb", "--case", "case.yaml")
    moved = inspected(macroslip, folder / "own.outb", "--hub-to-output", "2 m")
    assert own["statistics"]["my [kN m]"] == moved["statistics"]["my [kN m]"]
    assert own["samples"] == 1201 and own["statistics"]["shaft speed [rpm]"]["std"] == 0.0
    speed = inspected(
        macroslip, folder / "own.outb", "--case", "case.yaml", "--shaft-speed", "13 rpm"
    )
    assert speed["statistics"]["shaft speed [rpm]"]["mean"] == pytest.approx(13.0)
    other = inspected(macroslip, DATA / "sample14B.outb", "--case", "case.yaml")
    assert not any("moved to the hub" in line for line in other["reading"])


def test_an_option_without_a_unit_is_refused(macroslip):
    done = macroslip("loads", "inspect", DATA / "sample14B.outb", "--hub-to-bearing", "1.9")
    assert done.code == 2 and done.err.startswith(
        "error: --hub-to-bearing is '1.9', which does not give its unit"
    )


@pytest.mark.slow
def test_a_picture(folder, macroslip):
    done = macroslip("loads", "inspect", DATA / "sample14B.outb", "-o", "loads.png")
    assert (done.code, done.err) == (0, "") and done.out.endswith("written: loads.png\n")
    assert (folder / "loads.png").read_bytes().startswith(b"\x89PNG")
    assert macroslip("loads", "inspect", DATA / "sample14B.outb", "-o", "loads.png").code == 2
    assert (
        "Allowed: .png, .svg, .pdf"
        in macroslip("loads", "inspect", DATA / "sample14B.outb", "-o", "loads.txt").err
    )


def test_both_main_bearings_carry_the_hub_force_together(folder, macroslip):
    (folder / "both.yaml").write_text(
        "loads: {bundled: 14B}\ndrivetrain: {mount: four-point, hub_to_bearing: 1.1 m, front_to_rear: 1.6 m, "
        "locating: rear, bearing: both}\n"
    )
    arguments = ("loads", "inspect", DATA / "sample14B.outb", "--case", "both.yaml")
    printed = json.loads(macroslip(*arguments, "--json").out)
    for hub, ring in (("fx", "F_Z0"), ("fy", "F_X0"), ("fz", "F_Y0")):
        carried = sum(
            printed[name][f"{ring} [kN]"]["mean"] for name in ("main bearing", "rear main bearing")
        )
        assert carried == pytest.approx(printed["statistics"][f"{hub} [kN]"]["mean"], rel=1e-9)
    out = macroslip(*arguments).out
    assert ": the front bearing" in out and "load on the rear main bearing" in out
