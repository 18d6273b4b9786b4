"""Every command with odd arguments: it ends with 0 or 2, in words, and leaves the files that are there."""

import click
import pytest
import typer
from hypothesis import given
from hypothesis import strategies as st
from typer.testing import CliRunner

from macroslip.cli.commands import app
from tests.fuzz.oracle import CHARACTERS, examples

ODD = [
    "", " ", "-", "--", ".", "..", "/", "/dev/null", "~", "nothing.yaml", "nothing/at/all.nc", "a\0b", "n" * 300, "n/" * 2500,
    "é.yaml", "\udcff.yaml", "\x1b[31m", "%s", "$(id)", "0", "-1", "1e999", "nan", "99999999999999999999", "1e300 mm2/s",
    "0 mm2/s", "320 mm2/s", "1 parsec", "pao", "skf-240-600-bc", "vg460-pao", "14B", "all", "case.yaml", "loads.csv", "text.txt",
]  # fmt: skip
#: What may take long with arguments that are right.
LONG = {"--workers", "--dask", "--dry-run"}


def _commands(group, *names):
    for name, command in group.commands.items():
        if isinstance(command, click.Group):
            yield from _commands(command, *names, name)
        else:
            yield (*names, name), command


COMMANDS = dict(_commands(typer.main.get_command(app)))


@st.composite
def lines(draw):
    """A command with some of its arguments and options, most of them odd."""
    names = draw(st.sampled_from(sorted(COMMANDS)))
    line = list(names)
    for parameter in COMMANDS[names].params:
        if (not parameter.required and draw(st.integers(0, 3))) or set(parameter.opts) & LONG:
            continue
        values = [] if getattr(parameter, "is_flag", False) else [draw(st.sampled_from(ODD))]
        line += (
            values
            if isinstance(parameter, click.Argument)
            else [draw(st.sampled_from(parameter.opts)), *values]
        )
    return line


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("commands")
    (folder / "case.yaml").write_text(
        "loads: {bearing_file: loads.csv}\nrollers: [0]\nwindow: {start: 9 s}\n"
    )
    (folder / "loads.csv").write_text(
        "time_s,shaft_speed_rpm,F_X0_kN,F_Y0_kN,F_Z0_kN\n0,20,0,-300,80\n1,20,0,-300,80\n"
    )
    (folder / "text.txt").write_text("text")
    return folder


@pytest.mark.slow
@examples(60)
@given(line=lines())
def test_odd_arguments(folder, line):
    before = {name: (folder / name).read_bytes() for name in ("case.yaml", "loads.csv", "text.txt")}
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        done = CliRunner().invoke(app, line)
    message = done.stderr
    assert done.exit_code in (0, 2), f"{line}: {done.exit_code}: {message[-3000:]}"
    assert "Traceback" not in message and len(message) < CHARACTERS
    # `--force` may name them as an output.
    if "--force" not in line:
        assert before == {name: (folder / name).read_bytes() for name in before}
    else:
        for name, content in before.items():
            (folder / name).write_bytes(content)
