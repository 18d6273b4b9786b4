"""Runs Python as a user does, and scripts in processes that have the package imported already."""

import json
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

#: Forks a process for every script it is told of, in a folder and with what it prints in files there. What all scripts import
#: is imported once; all else, names and the main guard included, is as where Python runs the script itself.
FORKING = """
import json, os, runpy, sys, warnings
import macroslip.result.simulate, matplotlib.pyplot, pandas, xarray

def run(script, arguments, folder):
    os.chdir(folder)
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    for number, name in ((1, "stdout.txt"), (2, "stderr.txt")):
        os.dup2(os.open(name, os.O_WRONLY | os.O_CREAT, 0o600), number)
    sys.argv[:] = [script, *arguments]
    sys.path[0] = os.path.dirname(script)
    runpy.run_path(script, run_name="__main__")

for line in sys.stdin:
    with warnings.catch_warnings(action="ignore"):
        child = os.fork()
    if child == 0:
        run(*json.loads(line))
        break
    print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), flush=True)
"""


def environment():
    return os.environ | {"MPLBACKEND": "agg", "PYTHONIOENCODING": "utf-8"}


@pytest.fixture(scope="session")
def python():
    """Run Python in a process of its own, with warnings as errors."""

    def run(*arguments, folder):
        return subprocess.run(
            [sys.executable, "-W", "error", *arguments],
            cwd=folder,
            env=environment(),
            text=True,
            encoding="utf-8",
            capture_output=True,
            timeout=850,
            check=False,
        )

    return run


@pytest.fixture(scope="module")
def script(python):
    """Run a script in a process of its own, with warnings as errors, where Linux forks it from one that has imported the package."""
    if sys.platform != "linux":
        yield python
        return
    command = [sys.executable, "-W", "error", "-c", FORKING]
    started = []

    def run(path, *arguments, folder):
        if not started:
            pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
            started.append(subprocess.Popen(command, env=environment(), text=True, **pipes))
        print(json.dumps([path, arguments, str(folder)]), file=started[0].stdin, flush=True)
        code = int(started[0].stdout.readline())
        out, err = (
            Path(folder, name).read_text(encoding="utf-8") for name in ("stdout.txt", "stderr.txt")
        )
        return SimpleNamespace(returncode=code, stdout=out, stderr=err)

    yield run
    for process in started:
        process.communicate(timeout=60)
