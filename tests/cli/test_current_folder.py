"""Modules that lie in the current folder, beside a case that somebody sent, are never run."""

import os
import subprocess
import sys

import pytest

from macroslip.machine import process_environment, safe_path

#: As the script that an installation makes for the command.
COMMAND = (
    "import sys\nfrom macroslip.cli import main\nif __name__ == '__main__':\n    sys.exit(main())\n"
)
MODULES = (
    "macroslip", "numba", "numpy", "scipy", "h5py", "xarray", "distributed", "dask", "random", "json", "pickle", "socket",
    "multiprocessing", "threading", "sitecustomize", "usercustomize",
)  # fmt: skip
#: Laws and kernels that take the least time to make tables of and to compile.
QUICK = ("laws: {model: paper}", "integrator: {method: backward-euler, step: 10 ms}")
LOADS = "{main_bearing: {force: [0 N, -100 kN, 0 N], shaft_speed: 20 rpm, duration: 2 s}}"


@pytest.fixture
def hostile(tmp_path, monkeypatch):
    """A current folder full of modules that leave their names in `ran`, and beside it the command."""
    (tmp_path / "macroslip-command").write_text(COMMAND)
    folder = tmp_path / "sent"
    folder.mkdir()
    for name in MODULES:
        (folder / f"{name}.py").write_text(
            f"open({str(tmp_path / 'ran')!r}, 'a').write({name!r} + ' ')\n"
        )
    (folder / "case.yaml").write_text("\n".join([f"loads: {LOADS}", "rollers: [0]", *QUICK]))
    (folder / "study.yaml").write_text(
        f"case: {{rollers: [0], loads: {{end: 60 s}}, {', '.join(QUICK)}}}\n"
        "loads: {bundled: [14B]}\n"
    )
    monkeypatch.chdir(folder)
    return tmp_path


def ran(hostile):
    """Names of the modules that ran since this was asked before."""
    file = hostile / "ran"
    names = file.read_text() if file.exists() else ""
    file.unlink(missing_ok=True)
    return names


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="the command of Windows is no script")
def test_a_first_run_and_a_study_with_workers(hostile):
    environment = os.environ | {"NUMBA_CACHE_DIR": str(hostile / "kernels")}
    command = [sys.executable, str(hostile / "macroslip-command")]
    for arguments in (
        ["run", "case.yaml", "-o", "case.nc"],
        ["study", "study.yaml", "-o", "out", "--workers", "1"],
    ):
        done = subprocess.run(
            [*command, *arguments],
            env=environment,
            capture_output=True,
            text=True,
            timeout=900,
            check=False,
        )
        assert (done.returncode, ran(hostile)) == (0, ""), done.stderr
        assert "kernels" not in done.stderr  # one process finds as good what another has stored


@pytest.mark.parametrize("entry", ["", ".", "absolute"])
def test_a_process_does_not_look_in_the_current_folder(hostile, monkeypatch, entry):
    entry = str(hostile / "sent") if entry == "absolute" else entry
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([entry, str(hostile / "other")]))
    monkeypatch.setattr(sys, "path", ["", entry, *sys.path])
    code = "import sys, numba, macroslip; print(sys.path)"
    done = subprocess.run(
        [sys.executable, "-c", code],
        env=process_environment(),
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, ran(hostile)) == (0, ""), done.stderr
    assert str(hostile / "other") in done.stdout and repr(str(hostile / "sent")) not in done.stdout


@pytest.mark.skipif(os.name != "posix", reason="Windows keeps the current folder")
def test_a_current_folder_that_is_gone(hostile):
    (hostile / "gone").mkdir()
    os.chdir(hostile / "gone")
    (hostile / "gone").rmdir()
    assert safe_path(["", str(hostile)]) == [str(hostile)]
