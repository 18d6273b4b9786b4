"""A folder with a quick case on a genuine OpenFAST file, and the command line run in this process."""

import signal
from pathlib import Path
from types import SimpleNamespace

import pytest
from typer.testing import CliRunner

from macroslip.cli import progress

DATA = Path(__file__).parents[1] / "data"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """An empty current folder."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def quick(folder):
    """Write `case.yaml`: two rollers a row for two seconds, of the paper's model and without traces if no line says else."""

    def write(
        further="",
        loads=f"{{file: {DATA / 'sample14B.outb'}, start: 60 s, end: 62 s}}",
        rollers="[0, 14]",
    ):
        defaults = ("laws: {model: paper}\n", "traces: none\n")
        further += "".join(default for default in defaults if default.split(":")[0] not in further)
        (folder / "case.yaml").write_text(
            f"loads: {loads}\nrollers: {rollers}\n{further}", encoding="utf-8"
        )
        return "case.yaml"

    return write


@pytest.fixture
def macroslip(monkeypatch):
    """Run a command; gives exit code, standard output and standard error.

    Whether a stage takes so long that it has a line depends on the machine: none does here.
    """
    for name in ("LINE_AFTER", "SILENT_FOR"):
        monkeypatch.setattr(progress, name, 3600.0)

    def run(*arguments):
        from macroslip.cli.commands import app

        before = signal.getsignal(signal.SIGINT)
        done = CliRunner().invoke(app, [str(argument) for argument in arguments])
        signal.signal(signal.SIGINT, before)  # an interrupted command ignores further ones
        return SimpleNamespace(code=done.exit_code, out=done.stdout, err=done.stderr)

    return run
