"""`macroslip loads inspect` on genuine files."""

from pathlib import Path

import numpy as np
import pytest

from macroslip import Drivetrain, HubLoads, main_bearing_load

DATA = Path(__file__).parents[1] / "data"


def rows(text):
    """The numbers of every line of the tables, by the name in front."""
    found = {}
    for line in text.splitlines():
        name, bracket, numbers = line.partition("]")
        if bracket and len(numbers.split()) == 4:
            found[f"{name.strip()}]"] = [float(number) for number in numbers.split()]
    return found


def test_an_openfast_file(macroslip):
    path = DATA / "sample14B.outb"
    done = macroslip("loads", "inspect", path)
    assert (done.code, done.err) == (0, "")
    lines = done.out.splitlines()
    assert lines[:6] == [
        f"source    {path}",
        "kind      hub loads in non-rotating shaft axes",
        "channels  shaft speed, fx, fy, fz, mx, my, mz",
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
        assert table[name] == pytest.approx([values.mean(), values.std(), values.min(), values.max()], rel=1e-3), name
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


def test_uneven_steps_are_told(folder, macroslip):
    lines = "".join(f"{t},1,1,1,1\n" for t in (0, 1, 2.2, 3.2))
    (folder / "loads.csv").write_text("time_s,shaft_speed_rpm,F_X0_kN,F_Y0_kN,F_Z0_kN\n" + lines)
    assert "step      1 s (median; 1 s to 1.2 s)" in macroslip("loads", "inspect", "loads.csv").out


@pytest.mark.parametrize(
    ("file", "content", "message"),
    [
        ("absent.outb", None, "absent.outb: no such file. Check the path; the current folder is FOLDER."),
        ("notes.txt", b"x", "notes.txt: the extension '.txt' is not known. Allowed: .outb (OpenFAST binary output), "
                            ".out (OpenFAST text output), .parquet (table), .csv (table)."),
        ("empty.csv", b"", "empty.csv: the file is empty. Write or copy the file again."),
        ("cut.outb", b"\x02\x00\x01", "cut.outb: the file is cut off within its header. Copy the file again, or run "
                                      "OpenFAST again."),
    ],
)  # fmt: skip
def test_files_that_cannot_be_read(folder, macroslip, file, content, message):
    if content is not None:
        (folder / file).write_bytes(content)
    done = macroslip("loads", "inspect", file)
    assert (done.code, done.out, done.err) == (2, "", f"error: {message.replace('FOLDER', str(folder))}\n")


def test_a_damaged_parquet_file(folder, macroslip):
    (folder / "loads.parquet").write_bytes((DATA / "hub14B_50Hz.parquet").read_bytes()[:3000])
    done = macroslip("loads", "inspect", "loads.parquet")
    assert done.code == 2 and done.err.startswith("error: loads.parquet: not readable as a Parquet table")
