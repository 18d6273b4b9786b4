"""What a run leaves alone: the network, programs hidden in data, and where its user keeps files."""

import ast
import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.quick import COARSE

SOURCES = Path(__file__).parents[2] / "src" / "macroslip"
LOADS = "time_s,shaft_speed_rpm,F_X0_kN,F_Y0_kN,F_Z0_kN\n" + "".join(
    f"{n / 20},20,0,-300,80\n" for n in range(41)
)
#: Runs commands with every door to the network shut, whichever library knocks; prints the exit code of each.
SCRIPT = """
import json, sys

def refuse(event, arguments):
    if event.startswith(("socket.connect", "socket.bind", "socket.getaddrinfo", "socket.gethostby", "socket.sendto",
                         "urllib.", "http.", "ftplib.", "smtplib.")):
        raise RuntimeError(f"the network was asked for: {event} {arguments}")

sys.addaudithook(refuse)
if sys.argv[1] == "try":
    import socket
    socket.create_connection(("127.0.0.1", 9))
from macroslip.cli import main
for sys.argv[1:] in json.loads(sys.argv[1]):
    try:
        main()
        code = 0
    except SystemExit as end:
        code = end.code
    print("ended with", code)
"""


def ran(folder, argument):
    """Run commands in a process of their own."""
    command = [sys.executable, "-c", SCRIPT, argument]
    return subprocess.run(
        command, cwd=folder, capture_output=True, text=True, timeout=800, check=False
    )


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A result, its page, a study and its page, all of files that are named with their whole paths."""
    folder = tmp_path_factory.mktemp("somebody")
    (folder / "home").mkdir()
    (folder / "home" / "loads.csv").write_text(LOADS)
    case = folder / "home" / "case.yaml"
    case.write_text(
        f"loads: {{bearing_file: {folder / 'home' / 'loads.csv'}}}\nrollers: [0]\ntraces: {{step: 50 ms}}\n"
        f"integrator: {{tolerance: {COARSE.tolerance}}}\n"
    )
    study = folder / "home" / "study.yaml"
    study.write_text(
        f"case: {{rollers: [0], integrator: {{tolerance: {COARSE.tolerance}}}}}\n"
        'loads: {files: "{what}_{wind_speed:g}.csv", kind: main-bearing}\n'
    )
    (folder / "home" / "loads_12.csv").write_text(LOADS)
    (folder / "home" / "broken_14.csv").write_text(LOADS[:200] + "\n1,2,3,4\n")
    commands = {
        ("run", case, "-o", folder / "case.nc"): "0",
        ("report", folder / "case.nc", "-o", folder / "case.html"): "0",
        ("study", study, "-o", folder / "out", "--quiet"): "3",
        ("report", folder / "out", "-o", folder / "study.html"): "3",
        ("aggregate", folder / "out", "-o", folder / "tables", "--field", "wind_speed"): "0",
    }
    done = ran(folder, json.dumps([[str(word) for word in command] for command in commands]))
    assert "the network was asked for" not in done.stderr
    assert re.findall(r"^ended with (.*)$", done.stdout, re.MULTILINE) == list(commands.values()), (
        done.stderr
    )
    return folder


@pytest.mark.slow
def test_the_network_is_never_asked_for(folder):
    assert "the network was asked for" in ran(folder, "try").stderr  # the door is shut indeed
    assert (folder / "case.html").is_file() and (folder / "study.html").is_file()


@pytest.mark.slow
def test_nothing_that_is_written_says_where_its_user_keeps_files(folder):
    written = [folder / "case.nc", folder / "case.html", folder / "study.html"]
    written += [path for name in ("out", "tables") for path in (folder / name).rglob("*")]
    files = [path for path in written if path.is_file()]
    assert len(files) > 7
    for path in files:
        assert str(folder).encode() not in path.read_bytes(), path


@pytest.mark.slow
def test_results_name_their_loads_all_the_same(folder):
    xr = pytest.importorskip("xarray")
    with xr.open_dataset(folder / "case.nc", engine="h5netcdf") as result:
        assert (
            "under loads.csv, model physical" in result.attrs["title"]
            and '"source": "loads.csv"' in result.attrs["input"]
        )


def _names_used(tree):
    for node in ast.walk(tree):
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            yield from (alias.name for alias in node.names)
            yield getattr(node, "module", None) or ""
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            yield f"{node.func.id}()"
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            yield f"{node.value.id}.{node.attr}"
        elif isinstance(node, ast.keyword) and node.arg in ("allow_pickle", "typ"):
            yield f"{node.arg}={getattr(node.value, 'value', None)}"


def test_nothing_in_data_can_run():
    loading = set()
    for path in SOURCES.rglob("*.py"):
        used = set(_names_used(ast.parse(path.read_text(encoding="utf-8"))))
        assert not used & {"marshal.load", "marshal.loads", "pickle", "shelve", "dill", "joblib", "eval()", "exec()", "compile()", "allow_pickle=True",
                           "typ=unsafe", "yaml", "read_pickle"}, path  # fmt: skip
        if used & {"runpy", "SourceFileLoader", "spec_from_file_location", "exec_module"}:
            loading.add(path.name)
    assert loading == {"plugins.py"}  # files named with --laws are programs
