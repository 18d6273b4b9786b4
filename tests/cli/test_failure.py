"""How commands fail: one paragraph on standard error, and JSON for scripts that ask for it."""

import json
import os
import subprocess
import sys

import pytest

from macroslip import Bearing

COMMAND = [sys.executable, "-c", "from macroslip.cli import main; main()"]


def start(*arguments, cwd, **environment):
    return subprocess.run(
        [*COMMAND, *map(str, arguments)],
        cwd=cwd,
        env=os.environ | environment,
        capture_output=True,
        text=True,
        timeout=300,
    )


@pytest.mark.parametrize(
    "arguments",
    [
        ("run", "none.yaml", "-o", "x.nc"),
        ("damage", "none.nc"),
        ("loads", "inspect", "none.outb"),
        ("bearing", "show", "none"),
        ("lubricant", "show", "none"),
        ("study", "none.yaml", "-o", "out"),
        ("aggregate", "none", "-o", "out"),
        ("compare", "none.nc", "none.nc", "-o", "page.html"),
    ],
)
def test_a_failure_in_json(macroslip, folder, arguments):
    plain = macroslip(*arguments)
    done = macroslip(*arguments, "--json")
    assert (plain.code, plain.out, done.code) == (2, "", 2)
    assert done.err == plain.err and done.err.startswith("error: ")
    assert json.loads(done.out) == {"error": done.err.removeprefix("error: ").rstrip("\n")}


@pytest.mark.slow
def test_doubts_about_loads_stand_in_the_paragraph_of_an_error(macroslip, quick):
    """Waves of 1 mm take ten times the clearance away, and the thrust acts against the wind."""
    waves = "out_of_round: {second: 1 mm, third: 1 mm}\n"
    text = Bearing.read("skf-240-600-bc").as_yaml() + waves
    case = quick(
        "bearing: b.yaml\n",
        loads="{hub: {force: [-160 kN, 0 kN, -300 kN], moment: [0 N m, 0 N m, 0 N m], "
        "shaft_speed: 20 rpm, duration: 5 s}}",
    )
    with open("b.yaml", "w", encoding="utf-8") as file:
        file.write(text)
    done = macroslip("run", case, "-o", "x.nc")
    assert (done.code, done.out, done.err.count("\n")) == (2, "", 1)
    assert done.err.startswith("error: case.yaml")
    assert "Check out_of_round, whose waves reach 2000 um" in done.err
    assert "Doubtful: the mean thrust is -160 kN, against the wind" in done.err


@pytest.mark.slow
def test_settings_of_other_programs(quick, tmp_path):
    """A damaged file of dask, which xarray imports."""
    case = quick()
    (tmp_path / "dask").mkdir()
    (tmp_path / "dask" / "dask.yaml").write_text("a: [1\nb: {")
    done = start("run", case, "-o", "x.nc", cwd=tmp_path, DASK_CONFIG=str(tmp_path / "dask"))
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 1)
    assert "dask.yaml' is malformed" in done.stderr and "settings of dask" in done.stderr


@pytest.mark.slow
@pytest.mark.parametrize("threads", ["abc", "0", "-3", "1.5", ""])
def test_a_number_of_threads_that_is_none(tmp_path, threads):
    done = start("bearing", "show", "skf-240-600-bc", cwd=tmp_path, NUMBA_NUM_THREADS=threads)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("content", [b"a: [1\nb: {", b"[1, 2]\n", b"\xff\xfe\x00"])
def test_settings_of_numba_in_the_current_folder(quick, tmp_path, content):
    """Numba reads them when it is imported, whoever left them there."""
    case = quick()
    (tmp_path / ".numba_config.yaml").write_bytes(content)
    done = start("run", case, "-o", "x.nc", cwd=tmp_path)
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 1)
    assert done.stderr.startswith("error: Numba, which compiles the program, cannot read")
    assert done.stderr.endswith("file '.numba_config.yaml' of the current folder, or remove it.\n")
