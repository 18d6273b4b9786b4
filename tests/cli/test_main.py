"""The command as a whole: version, help, speed of starting, usage errors, the progress bar."""

import io
import json
import os
import subprocess
import sys
import time

import pytest

import macroslip as package
from macroslip.cli import progress
from macroslip.storage import waiting
from macroslip.study.progress import Progress

pytestmark = pytest.mark.slow


def start(*arguments):
    command = [sys.executable, "-c", "from macroslip.cli import main; main()", *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=60)


def test_version(macroslip):
    assert macroslip("--version").out == f"macroslip {package.__version__}\n"


def test_names_that_the_output_cannot_show_are_written_by_numbers(tmp_path):
    """As on Windows, where output that goes to a file lacks most characters."""
    code = "from macroslip.cli import main; main()"
    for command in (["init", "Λ.yaml"], ["show", "Λ.yaml"], ["show", "Λ.yaml", "--json"]):
        done = subprocess.run(
            [sys.executable, "-c", code, "bearing", *command],
            cwd=tmp_path,
            env=os.environ | {"PYTHONIOENCODING": "cp1252"},
            capture_output=True,
            timeout=60,
        )
        assert (done.returncode, done.stderr) == (0, b"") and rb"\u039b" in done.stdout
    assert json.loads(done.stdout)


def test_help_imports_nothing_heavy():
    heavy = "numpy numba pandas xarray ruamel matplotlib scipy pyarrow"
    code = (
        "import sys\nfrom macroslip.cli.commands import app\ntry: app(['--help'])\nexcept SystemExit: pass\n"
        f"print([name for name in '{heavy}'.split() if name in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60
    )
    assert done.stdout.splitlines()[-1] == "[]"


def test_help_names_every_command_and_exit_code(macroslip):
    out = macroslip("--help").out
    for word in (
        "init",
        "run",
        "compare",
        "reproduce",
        "loads",
        "bearing",
        "lubricant",
        "doctor",
        "--install-completion",
        "--version",
        "3 some rollers failed",
    ):
        assert word in " ".join(out.split())


def test_usage_errors():
    done = start("run", "case.yaml")
    assert done.returncode == 2 and "Traceback" not in done.stderr and "--output" in done.stderr
    done = start("run", "case.yaml", "-o", "x.nc", "--threads", "0")
    assert done.returncode == 2 and "--threads" in done.stderr
    assert start("walk").returncode == 2


def test_a_reader_that_closes_early_is_no_error():
    command = (
        f"{sys.executable} -c 'from macroslip.cli import main; main()' bearing schema | head -1"
    )
    done = subprocess.run(command, shell=True, capture_output=True, text=True, timeout=60)
    assert (done.stdout, done.stderr) == ("{\n", "")
    for arguments, code in (
        (["bearing", "schema"], 0),
        (["--help"], 0),
        (["bearing", "show", "nothing"], 2),
    ):
        process = subprocess.Popen(
            [sys.executable, "-c", "from macroslip.cli import main; main()", *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        process.stdout.close()
        assert process.wait(60) == code


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_an_interrupt_while_the_command_is_imported_is_told_in_a_word():
    code = (
        "import signal, sys, builtins\nsignal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "from macroslip.cli import main\nfind = builtins.__import__\n"
        "def slow(name, *rest):\n    if name == 'typer': signal.raise_signal(signal.SIGINT)\n"
        "    return find(name, *rest)\nbuiltins.__import__ = slow\nmain()"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, "--help"], capture_output=True, text=True, timeout=60
    )
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "interrupted\n")


def test_compiling_that_is_switched_off_and_long_names_are_told(tmp_path):
    (tmp_path / "case.yaml").write_text("loads: {bundled: 14B, end: 2 s}\nrollers: [0]\n")
    code = "from macroslip.cli import main; main()"
    for output, words in (
        ("o.nc", "error: NUMBA_DISABLE_JIT: compiling is switched off. Remove this variable"),
        ("n" * 5000, "too long. Choose a shorter name."),
    ):
        done = subprocess.run(
            [sys.executable, "-c", code, "run", "case.yaml", "-o", output],
            cwd=tmp_path,
            env=os.environ | {"NUMBA_DISABLE_JIT": "1"},
            capture_output=True,
            text=True,
            timeout=60,
        )
        assert done.returncode == 2 and words in done.stderr and len(done.stderr) < 600


class Terminal(io.StringIO):
    """A terminal to write to."""

    def isatty(self):
        return True


@pytest.fixture
def stderr(monkeypatch):
    """Make standard error a terminal (or a plain file), within the test itself: pytest sets its own before that."""
    monkeypatch.setenv("TERM", "xterm")

    def set_to(kind):
        monkeypatch.setattr(sys, "stderr", kind())
        return sys.stderr

    return set_to


def test_the_bar_shows_label_count_and_time_left(stderr, monkeypatch):
    screen = stderr(Terminal)
    monkeypatch.setattr(progress, "DELAY", 0.0)
    with progress.command_progress(quiet=False) as report:
        for stage in ("study", "figures"):
            for done in range(1, 4):
                report(stage, done, 3)
                time.sleep(0.12)
    shown = screen.getvalue()
    assert "study" in shown and "figures" in shown and "3/3" in shown and "left" in shown


def test_no_bar_for_what_is_quick(stderr):
    screen = stderr(Terminal)
    with progress.command_progress(quiet=False) as report:
        report("rollers", 1, 1)
    assert "rollers" not in screen.getvalue()


def test_nothing_when_quiet(stderr):
    screen = stderr(Terminal)
    with progress.command_progress(quiet=True) as report:
        assert report is None
        waiting.tell(waiting.COMPILING, 1, 150)
    assert screen.getvalue() == ""


def test_without_a_terminal_a_stage_that_takes_long_gets_one_line(stderr, monkeypatch):
    text = stderr(io.StringIO)
    monkeypatch.setattr(progress, "LINE_AFTER", 0.05)
    with progress.command_progress(quiet=False) as report:
        report("quick", 1, 1)
        for done in range(5):
            report("rollers", done, 5)
            time.sleep(0.06)
    assert text.getvalue() == "rollers: 2 of 5 done\n"


def test_compiling_and_tables_are_shown_while_rollers_wait(stderr, monkeypatch):
    screen = stderr(Terminal)
    monkeypatch.setattr(progress, "DELAY", 0.0)
    with progress.command_progress(quiet=False) as report:
        for done in range(1, 4):
            waiting.tell(waiting.COMPILING, done, 150)
            report("rollers", 0, 2)
            time.sleep(0.12)
        shown = screen.getvalue()
        assert "compiling, which happens once" in shown and "3/150" in shown and "0/2" in shown
        report("rollers", 1, 2)
        time.sleep(0.12)
        screen.truncate(0)
        time.sleep(0.12)
        assert "1/2" in screen.getvalue() and "compiling" not in screen.getvalue()


def test_a_study_shows_compiling_and_its_runs(stderr, monkeypatch):
    screen = stderr(Terminal)
    monkeypatch.setattr(progress, "DELAY", 0.0)
    with progress.study_progress(quiet=False) as report:
        waiting.tell(waiting.COMPILING, 3, 150)
        time.sleep(0.15)
        assert "compiling, which happens once" in screen.getvalue()
        assert "3/150" in screen.getvalue()
        report(Progress(total=7, computed=2, unchanged=3, failed=1))
        screen.truncate(0)
        time.sleep(0.15)
    shown = screen.getvalue()
    assert "3 unchanged, 1 failed" in shown and "3/4" in shown and "compiling" not in shown


def test_without_a_terminal_a_study_has_a_line_a_stage_and_its_runs_once_a_minute(
    stderr, monkeypatch
):
    text = stderr(io.StringIO)
    monkeypatch.setattr(progress, "LINE_AFTER", 0.0)
    with progress.study_progress(quiet=False) as report:
        for done in (1, 2, 3):
            waiting.tell(waiting.COMPILING, done, 150)
        for computed in (1, 2):
            report(Progress(total=7, computed=computed))
    compiling, runs = text.getvalue().splitlines()
    assert compiling == f"{waiting.COMPILING}: 1 of 150 done"
    assert runs.startswith("1 of 7 done (1 computed, 0 unchanged, 0 failed)")


def test_a_quiet_study_shows_nothing(stderr):
    screen = stderr(Terminal)
    with progress.study_progress(quiet=True) as report:
        assert report is None
    assert screen.getvalue() == ""


def test_work_that_counts_nothing_is_named_once(stderr, monkeypatch):
    text = stderr(io.StringIO)
    monkeypatch.setattr(progress, "SILENT_FOR", 0.05)
    with progress.command_progress(quiet=False, work="making the page"):
        time.sleep(0.15)
    assert text.getvalue() == "making the page\n"
    monkeypatch.setattr(progress, "SILENT_FOR", 60.0)
    with progress.command_progress(quiet=False, work="comparing"):
        pass
    assert text.getvalue() == "making the page\n"
