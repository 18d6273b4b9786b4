"""`macroslip run` end to end on a genuine OpenFAST file: results, messages, exit codes, what is left on the disk."""

import contextlib
import errno
import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from macroslip import Case, HubLoads, InputError, Laws, open_result, read_case, simulate
from macroslip.case.case_file import case_schema
from macroslip.cli.run import with_motion
from macroslip.imposed.status import Status
from macroslip.result.rating import with_rating
from tests.quick import COARSE

pytestmark = pytest.mark.slow

DATA = Path(__file__).parents[1] / "data"
OUTB = DATA / "sample14B.outb"


def test_the_file_holds_what_simulate_gives(quick, folder, macroslip):
    done = macroslip("run", quick(), "-o", "case.nc", "--threads", 1)
    # The film of the paper is used beyond its range, and told so.
    assert done.code == 0 and done.err.startswith(
        "doubtful: the film's formula is outside its range"
    )
    case = Case(loads=HubLoads.read(OUTB, start=60.0, end=62.0), laws=Laws.paper(), rollers=[0, 14])
    expected = with_rating(simulate(case), case)
    with xr.open_dataset(folder / "case.nc", engine="h5netcdf") as written:
        xr.testing.assert_allclose(written.load(), expected, rtol=0.0)
        assert json.loads(written.attrs["input"])["loads"]["samples"] == 41
    assert sorted(path.name for path in folder.iterdir()) == ["case.nc", "case.yaml"]


def test_the_summary(quick, folder, macroslip):
    done = macroslip("run", quick(rollers="all"), "-o", "case.nc")
    answer, _, rest = done.out.partition("\n\n")
    assert [line.partition(":")[0] for line in answer.splitlines()] == [
        "Downwind row",
        "Upwind row",
    ]
    lines = rest.splitlines()
    assert (
        f"under {OUTB.name}, model paper, vg460-pao at 35 °C, from 60 s to 62 s, 0 complete orbits"
        in lines[0]
    )
    with xr.open_dataset(folder / "case.nc", engine="h5netcdf") as written:
        energy = written.energy.sum("interface").mean("roller")
        for line, row in zip(lines[2:4], ("downwind", "upwind"), strict=True):
            name, mean, peak, spin, *failed = line.split()
            assert (name, failed) == (row, ["0", "of", "28"])
            # Without a complete orbit the peak is that of the window.
            assert float(peak) == pytest.approx(
                float(written.window_peak_power.sel(row=row).max()), rel=1e-3
            )
            assert float(mean) == pytest.approx(float(energy.sel(row=row)), rel=1e-3)
            assert float(spin) == pytest.approx(
                float(written.min_spin_ratio.sel(row=row).min()), rel=1e-3
            )
    assert lines[-1] == "written: case.nc"


def test_quiet_says_nothing(quick, macroslip):
    done = macroslip("run", quick(), "-o", "case.nc", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")


def test_as_a_user_starts_it(quick, folder):
    command = [
        sys.executable,
        "-c",
        "from macroslip.cli import main; main()",
        "run",
        quick(),
        "-o",
        "case.nc",
    ]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    # Where kernels or tables are missing, a line of the stage stands before the doubt.
    told = [line for line in done.stderr.splitlines() if not line.endswith(" done")]
    assert done.returncode == 0 and len(told) == 1
    assert done.stdout.endswith("written: case.nc\n") and "\x1b" not in done.stdout
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert (done.returncode, done.stdout) == (2, "")
    assert (
        done.stderr
        == "error: case.nc: the file exists. Choose another name, or replace it with --force.\n"
    )


@pytest.mark.parametrize("speed", ["0 rpm", "-20 rpm"])
def test_a_shaft_that_stands_or_turns_backwards(quick, macroslip, speed):
    loads = (
        f"{{main_bearing: {{force: [0 N, -300 kN, 100 kN], shaft_speed: {speed}, duration: 1 s}}}}"
    )
    assert macroslip("run", quick(loads=loads), "-o", "case.nc").code == 0


def test_a_shaft_that_reverses(quick, folder, macroslip):
    time = np.arange(41) / 20
    speed = 10.0 * np.cos(np.pi * time)
    rows = (f"{t},{n},10,-300,50\n" for t, n in zip(time, speed, strict=True))
    (folder / "loads.csv").write_text(
        "time_s,shaft_speed_rpm,F_X0_kN,F_Y0_kN,F_Z0_kN\n" + "".join(rows)
    )
    assert macroslip("run", quick(loads="{bearing_file: loads.csv}"), "-o", "case.nc").code == 0
    with xr.open_dataset(folder / "case.nc", engine="h5netcdf") as written:
        assert np.isfinite(written.energy).all()


def test_rollers_that_fail_are_told_and_written(quick, folder, macroslip):
    done = macroslip("run", quick("integrator: {max_steps: 5}\n"), "-o", "case.nc")
    assert done.code == 3
    with xr.open_dataset(folder / "case.nc", engine="h5netcdf") as written:
        assert (written.status == Status.TOO_MANY_STEPS).all() and np.isnan(written.energy).all()
        roller = written.sel(row="upwind", roller=14)
        expected = (
            f"failed: roller 14 of the upwind row at t = {float(roller.end_time):.6g} s with a slip of "
            f"{float(roller.end_slip):.4g} m/s: the step limit was reached; loosen the tolerance or raise "
            "integrator.max_steps."
        )
    assert len(done.err.splitlines()) == 4 and expected in done.err.splitlines()
    assert "written: case.nc" in done.out and "2 of 2" in done.out


def test_an_existing_file_is_kept_unless_forced(quick, folder, macroslip):
    (folder / "case.nc").write_text("precious")
    done = macroslip("run", quick(), "-o", "case.nc")
    assert (done.code, done.out) == (2, "")
    assert (
        done.err
        == "error: case.nc: the file exists. Choose another name, or replace it with --force.\n"
    )
    assert (folder / "case.nc").read_text() == "precious"
    assert macroslip("run", quick(), "-o", "case.nc", "--force").code == 0
    assert (folder / "case.nc").stat().st_size > 1000


@pytest.mark.parametrize(
    ("output", "message"),
    [
        (
            "nope/case.nc",
            "nope/case.nc: there is no folder 'nope'. Make that folder first, or choose another one.",
        ),
        (".", ".: this is a folder. Allowed: a file. Add the name of a file to it."),
        (
            "case.yaml/x.nc",
            "case.yaml/x.nc: there is no folder 'case.yaml'. Make that folder first, or choose another one.",
        ),
    ],
)
def test_an_output_that_cannot_be_made_is_refused_at_once(quick, macroslip, output, message):
    done = macroslip("run", quick(), "-o", output)
    assert (done.code, done.out, done.err) == (2, "", f"error: {message}\n")


def test_a_folder_without_the_right_to_write(quick, macroslip, monkeypatch):
    def refuse(self):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(self))

    monkeypatch.setattr(Path, "touch", refuse)  # the tests may run as a user who may write anywhere
    done = macroslip("run", quick(), "-o", "case.nc")
    assert (done.code, done.err) == (
        2,
        "error: case.nc: nothing can be written there (Permission denied). Choose another folder, or ask for the "
        "right to write there.\n",
    )


@pytest.mark.parametrize(
    ("failure", "code", "message"),
    [
        (
            OSError(errno.ENOSPC, os.strerror(errno.ENOSPC)),
            2,
            "error: case.nc: the file was not written (No space left on device). Make room there or choose "
            "another folder; nothing partial was left behind.\n",
        ),
        (KeyboardInterrupt(), 130, "interrupted\n"),
        (MemoryError(), 2, "error: the computer has not enough memory for this. Use shorter loads, fewer rollers or no "
                           "traces.\n"),
    ],
)  # fmt: skip
@pytest.mark.parametrize("before", [None, "precious"])
def test_nothing_partial_is_left_behind(
    quick, folder, macroslip, monkeypatch, failure, code, message, before
):
    case = quick()
    if before:
        (folder / "case.nc").write_text(before)

    def fail_half_way(self, content):
        with self.open("wb") as file:
            file.write(content[: len(content) // 2])
        raise failure

    monkeypatch.setattr(Path, "write_bytes", fail_half_way)
    done = macroslip("run", case, "-o", "case.nc", "--force")
    assert (done.code, done.out, done.err) == (code, "", message)
    assert sorted(path.name for path in folder.iterdir()) == (
        ["case.nc", "case.yaml"] if before else ["case.yaml"]
    )
    assert not before or (folder / "case.nc").read_text() == before


@pytest.mark.skipif(os.name == "nt", reason="needs a limit on the size of files")
def test_a_full_disk(quick, folder):
    """The real thing: the system refuses the second half of the file."""
    code = (
        "import resource\nfrom pathlib import Path\nfrom macroslip.cli import main\nwrite = Path.write_bytes\n"
        "def limited(self, content):\n"
        # Kernels are written before: without them the process would compile all of its own.
        "    if 'case.nc' in self.name:\n"
        "        resource.setrlimit(resource.RLIMIT_FSIZE, (len(content) // 2, resource.RLIM_INFINITY))\n"
        "    return write(self, content)\n"
        "Path.write_bytes = limited; main()"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, "run", quick("traces: {step: 1 ms}\n"), "-o", "case.nc"],
        capture_output=True, text=True, timeout=300,
    )  # fmt: skip
    assert (done.returncode, done.stdout) == (2, "")
    # Where it has to compile for more than ten seconds, a line tells of that first.
    *stages, message = done.stderr.splitlines()
    assert all(line.startswith(("compiling", "tables")) for line in stages)
    assert message == (
        "error: case.nc: the file was not written (File too large). Make room there or choose another folder; nothing "
        "partial was left behind."
    )
    assert [path.name for path in folder.iterdir()] == ["case.yaml"]


def test_ctrl_c_ends_a_whole_bearing_within_a_step_and_leaves_nothing(folder):
    """Whether it is compiling or integrating: 600 s at so tight a tolerance take far longer than the test waits."""
    (folder / "case.yaml").write_text(
        "loads: {bundled: 14B}\ndynamics: whole-bearing\nlaws: {model: paper}\n"
        "integrator: {tolerance: 1e-10}\n"
    )
    # Where the tests run in the background, interrupts are ignored unless that is undone.
    main = (
        "from signal import *; signal(SIGINT, default_int_handler); "
        "from macroslip.cli import main; open('began', 'w').close(); main()"
    )
    command = [sys.executable, "-c", main, "run", "case.yaml", "-o", "case.nc", "--quiet"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        # On a busy machine Python alone may take long to start.
        while not (folder / "began").exists():
            time.sleep(0.1)
        with pytest.raises(subprocess.TimeoutExpired):
            process.wait(timeout=4.0)
        # Python drops an interrupt that falls into a destructor; a user presses again.
        for _ in range(30):
            process.send_signal(signal.SIGINT)
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(timeout=10.0)
                break
        out, err = process.communicate(timeout=10.0)
    finally:
        process.kill()
    (folder / "began").unlink()
    assert (process.returncode, out, err) == (130, "", "interrupted\n")
    assert [path.name for path in folder.iterdir()] == ["case.yaml"]


def test_books_that_do_not_close_are_told(quick, macroslip, monkeypatch):
    from macroslip.result import simulate as module

    words, simulate = (
        "the balance of energy has a residual of 7 % of what is dissipated",
        module.simulate,
    )
    monkeypatch.setattr(
        module,
        "simulate",
        lambda *given, **named: simulate(*given, **named).assign_attrs(books_warning=words),
    )
    done = macroslip("run", quick(), "-o", "case.nc", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", f"warning: {words}\n")
    assert json.loads(macroslip("run", quick(), "-o", "other.nc", "--json").out)["warning"] == words
    assert f"warning: {words}>" in repr(open_result("case.nc").macroslip)


def test_a_fault_of_the_program_shows_its_traceback(quick, macroslip, monkeypatch):
    def broken(*arguments, **options):
        raise ZeroDivisionError("a bug")

    monkeypatch.setattr("macroslip.result.simulate.simulate", broken)
    done = macroslip("run", quick(), "-o", "case.nc")
    assert done.code == 1 and "Traceback" in done.err
    assert done.err.endswith(
        "internal error: ZeroDivisionError. This is a fault of macroslip; please report what is above.\n"
    )


@pytest.mark.parametrize(
    ("further", "message"),
    [
        (
            "windwo: {start: auto}\n",
            "error: case.yaml, line 3: the key 'windwo' is unknown. Did you mean 'window'?\n",
        ),
        (
            "window: {start: 50 s}\n",
            "error: case.yaml, line 3, window: the window runs from 50.0 s to 62.0 s. Allowed: start before end, both "
            "within the loads' 60 s to 62 s.\n",
        ),
    ],
)
def test_a_wrong_case_file_is_told_on_standard_error(quick, macroslip, further, message):
    done = macroslip("run", quick(further), "-o", "case.nc")
    assert (done.code, done.out, done.err) == (2, "", message)


def test_a_value_that_is_not_a_number(quick, folder, macroslip):
    rows = "".join(f"{t},20,10,{'nan' if t == 3 else -300},50\n" for t in range(6))
    (folder / "loads.csv").write_text("time_s,shaft_speed_rpm,F_X0_kN,F_Y0_kN,F_Z0_kN\n" + rows)
    done = macroslip("run", quick(loads="{bearing_file: loads.csv}"), "-o", "case.nc")
    assert done.code == 2
    assert done.err == (
        "error: case.yaml, line 1, loads.bearing_file: loads.csv, t = 3 s: F_Y0 is nan (1 of 6 samples are not "
        "finite). Allowed: finite numbers. Repair the channel, or read only the part without such samples "
        "(loads.start, loads.end).\n"
    )


def test_a_load_beyond_the_bearing(quick, macroslip):
    loads = "{main_bearing: {force: [0 N, -9 MN, 0 N], shaft_speed: 20 rpm, duration: 1 s}}"
    assert (
        "has the unit 'MN'. Allowed: a number with its unit, N or kN."
        in macroslip("run", quick(loads=loads), "-o", "x.nc").err
    )
    done = macroslip("run", quick(loads=loads.replace("9 MN", "9000 kN")), "-o", "case.nc")
    assert done.code == 2 and "its contact ellipse would reach beyond the roller's ends" in done.err


BOTH = """loads: {hub: {force: [164 kN, 0 N, -263 kN], moment: [0 N m, 0 N m, 0 N m], shaft_speed: 20 rpm, duration: 1 s}}
drivetrain: {mount: four-point, hub_to_bearing: 1.1 m, front_to_rear: 1.6 m, locating: rear, bearing: both}
laws: {model: paper}
rollers: [0]
rating: false
"""


def test_both_main_bearings_are_two_results_that_carry_the_rotor_together(folder, macroslip):
    (folder / "case.yaml").write_text(BOTH)
    assert macroslip("run", "case.yaml", "-o", "case.nc", "--quiet").code == 0
    assert sorted(path.name for path in folder.iterdir()) == [
        "case-front.nc",
        "case-rear.nc",
        "case.yaml",
    ]
    loads = {}
    for name in ("front", "rear"):
        with xr.open_dataset(folder / f"case-{name}.nc", engine="h5netcdf") as written:
            assert json.loads(written.attrs["input"])["drivetrain"]["bearing"] == name
        case = read_case(folder / "case.yaml", bearing=name)
        expected = simulate(with_motion(case))
        np.testing.assert_allclose(
            open_result(folder / f"case-{name}.nc").energy, expected.energy, rtol=1e-12
        )
        loads[name] = case.bearing_loads.force[0]
    np.testing.assert_allclose(loads["front"] + loads["rear"], [0.0, -263e3, 164e3], rtol=1e-12)
    again = macroslip("run", "case.yaml", "-o", "case.nc")
    assert again.code == 2 and again.err.startswith("error: case-front.nc: the file exists.")
    done = macroslip("run", "case.yaml", "-o", "case.nc", "--force")
    assert done.out.endswith("one page on both: macroslip report case-front.nc case-rear.nc\n")
    told = json.loads(macroslip("run", "case.yaml", "-o", "case.nc", "--force", "--json").out)
    assert [told[name]["written"] for name in ("front", "rear")] == [
        "case-front.nc",
        "case-rear.nc",
    ]


def test_both_main_bearings_are_no_single_case_and_no_study(folder, macroslip):
    (folder / "case.yaml").write_text(BOTH)
    words = "drivetrain.bearing: 'both' does not exist. Allowed: front, rear. Choose one of these. A case file for macroslip run"
    with pytest.raises(InputError, match=words):
        read_case(folder / "case.yaml")
    (folder / "study.yaml").write_text(
        "case:\n  " + BOTH.split("\n")[1] + "\nloads: {bundled: [14B]}\n"
    )
    done = macroslip("study", "study.yaml", "--dry-run")
    assert (
        done.code == 2
        and words in done.err
        and "A study varies drivetrain.bearing: [front, rear]." in done.err
    )
    (folder / "case.yaml").write_text(BOTH.replace("mount: four-point, ", ""))
    done = macroslip("run", "case.yaml", "-o", "case.nc")
    assert (
        done.code == 2 and "line 2, drivetrain: the mount is three-point, which has no" in done.err
    )
    assert "both" in case_schema()["properties"]["drivetrain"]["properties"]["bearing"]["enum"]


def test_a_cylindrical_bearing_runs_from_file_to_page_and_tells_how_its_cage_slips(
    folder, macroslip
):
    bearing = Path(__file__).parents[2] / "validation" / "data" / "cylindrical-160.yaml"
    (folder / "case.yaml").write_text(
        f"bearing: {bearing}\nlubricant: vg320-mineral\ntemperature: 40 degC\noil_supply: flooded\n"
        "loads: {main_bearing: {force: [0 N, -8 kN, 0 N], shaft_speed: 1500 rpm, duration: 0.5 s}}\n"
        "dynamics: whole-bearing\ncage: {gap: 0.3 mm, mass: 4 kg}\n"
        f"integrator: {{tolerance: {COARSE.tolerance}}}\n"
    )
    done = macroslip("run", "case.yaml", "-o", "case.nc")
    assert (
        done.code == 0
        and "mean slip of the cage: 6" in done.out
        and "% behind pure rolling" in done.out
    )
    # One row, whose rollers a cage holds back: the sentence has no name of a row.
    assert re.match(
        r"The rollers: loaded [\d.]+ % of the time; loaded rollers turn [\d.]+ % below rolling speed in "
        r"the mean, between load zones they slow down to [\d.]+ % of it\.\n",
        done.out,
    )
    assert "beside slip: static safety" in done.out and "not rated" not in done.out
    assert "rotors on main bearings" not in done.err
    assert (
        -0.75
        < json.loads(macroslip("run", "case.yaml", "-o", "two.nc", "--json").out)["cage slip [1]"][
            "both"
        ]
        < -0.6
    )
    assert (
        macroslip("report", "case.nc").code == 0
        and "single row" in (folder / "report.html").read_text()
    )
