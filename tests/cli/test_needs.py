"""A command whose packages are missing names them and the line that installs them, before it computes anything."""

import importlib.util

import pytest

from macroslip.cli.needs import FIGURES, SCHEDULER, require
from macroslip.errors import MacroslipError


@pytest.fixture
def without(monkeypatch):
    """Make packages look as if they were not installed."""
    find_spec = importlib.util.find_spec

    def hide(*names):
        monkeypatch.setattr(
            importlib.util,
            "find_spec",
            lambda name, *rest: None if name in names else find_spec(name, *rest),
        )

    return hide


def test_all_is_there():
    require(FIGURES, SCHEDULER)


def test_the_message_names_package_and_remedy(without):
    without("jinja2")
    with pytest.raises(
        MacroslipError,
        match=r"for a page or a picture: jinja2\. .*pip install 'macroslip\[figures\]'$",
    ):
        require(FIGURES, SCHEDULER)


def test_a_dry_run_refuses_what_the_run_would_refuse(folder, macroslip, without):
    (folder / "study.yaml").write_text("loads: {bundled: [14B]}\n")
    without("distributed")
    done = macroslip("study", "study.yaml", "--dry-run", "--scheduler", "tcp://127.0.0.1:1")
    assert (done.code, done.out) == (2, "")
    assert "distributed" in done.err and "[cluster]" in done.err


def test_doctor_says_which_command_lacks_what(macroslip, without):
    without("matplotlib")
    lines = macroslip("doctor").out.splitlines()
    assert any(
        line.startswith("macroslip report ") and "lacks matplotlib" in line for line in lines
    )
    assert any(
        line.startswith("macroslip study --scheduler ") and "ready" in line for line in lines
    )
