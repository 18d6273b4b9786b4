"""A pipe in place of any file that a command is given: refused at once, never waited for."""

import os

import pytest
from typer.testing import CliRunner

from macroslip.cli.commands import app

COMMANDS = {
    "case": ("run", "pipe", "-o", "out.nc"),
    "loads of a case": ("run", "case.yaml", "-o", "out.nc"),
    "laws": ("run", "fine.yaml", "-o", "out.nc", "--laws", "pipe"),
    "result": ("report", "pipe", "-o", "page.html"),
    "study": ("study", "pipe", "-o", "out"),
    "table of a study": ("study", "study.yaml", "-o", "out"),
    "bearing": ("bearing", "show", "pipe"),
    "lubricant": ("lubricant", "show", "pipe"),
}


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="named pipes are a thing of Unix")
@pytest.mark.timeout(60)
@pytest.mark.parametrize("name", COMMANDS)
def test_refused(tmp_path, monkeypatch, name):
    for pipe in ("pipe", "pipe.csv"):
        os.mkfifo(tmp_path / pipe)
    (tmp_path / "fine.yaml").write_text("loads: {bundled: 14B}\n", encoding="utf-8")
    (tmp_path / "case.yaml").write_text("loads: {file: pipe.csv}\n", encoding="utf-8")
    (tmp_path / "study.yaml").write_text("loads: {table: pipe.csv}\n", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    done = CliRunner().invoke(app, COMMANDS[name])
    assert done.exit_code == 2
    assert "it is a pipe, a socket or a device, not a file" in " ".join(done.stderr.split())
    assert len(list(tmp_path.iterdir())) == 5
