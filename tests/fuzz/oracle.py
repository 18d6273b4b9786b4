"""How every command has to end, whatever its files hold."""

import re
import resource
import time
from contextlib import contextmanager
from pathlib import Path

import typer
from hypothesis import settings
from typer.testing import CliRunner

from macroslip.cli.failure import command

MORE = 40
"""Examples of `make test-deep` for each one of the slice that always runs."""
SECONDS, MEGABYTES, CHARACTERS = 10.0, 400, 20_000
"""What one command may take on a small file: processor time, memory beyond what it had, length of its message."""
_ADDRESSES = 4 * 1024**3  # ends an allocation of any size before it hurts


def examples(number):
    """Settings of a test: so many examples, the same ones always, or many fresh ones in a search."""
    return settings(max_examples=number if settings().derandomize else MORE * number)


@contextmanager
def _limited_memory():
    with open("/proc/self/statm") as file:
        used = int(file.read().split()[0]) * resource.getpagesize()
    old = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (used + _ADDRESSES, old[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, old)


def _files(folder):
    return {str(path.relative_to(folder)) for path in folder.rglob("*")}


def ends_well(folder, file, *arguments, app=None):
    """Run a command on a file that may hold anything; gives its message, which is empty if the file is accepted.

    Either it accepts the file, or it says in one paragraph what is wrong with it and what to do, and leaves nothing.
    """
    if app is None:
        from macroslip.cli.commands import app
    before, peak = _files(folder), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    start = time.process_time()
    with _limited_memory():
        done = CliRunner().invoke(app, [str(argument) for argument in arguments])
    seconds = time.process_time() - start
    grown = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - peak) / 1024
    assert done.exit_code in (0, 2), (
        f"exit code {done.exit_code}: {done.stderr[-3000:]}{done.exception!r}"
    )
    assert seconds < SECONDS, f"{seconds:.1f} s"
    assert grown < MEGABYTES, f"{grown:.0f} MB"
    if done.exit_code == 0:
        assert _files(folder) == before
        return ""
    message = done.stderr
    assert _files(folder) == before
    assert (
        message.startswith("error: ")
        and "Traceback" not in message
        and "not enough memory" not in message
    ), message
    assert file.stem in message, f"the file is not named: {message}"
    assert re.search(r"[.!?)] +[A-Z]", message), f"no remedy: {message}"
    assert len(message) < CHARACTERS, f"{len(message)} characters: {message[:500]}"
    text = message.removesuffix("\n")
    assert all(letter.isprintable() or letter == "\n" for letter in text) and "\n\n" not in text, (
        repr(text)
    )
    return message


def app_of(reader):
    """A command line of one command that reads a file, with the error handling that all commands have."""
    app = typer.Typer(pretty_exceptions_enable=False)

    def read(path: Path) -> None:
        reader(path)

    command(app, read)
    return app
