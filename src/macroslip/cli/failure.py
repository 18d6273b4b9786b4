"""How a command fails: one clean paragraph and an exit code a script can act on."""

from __future__ import annotations

import _thread
import errno
import functools
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import typer

from macroslip.errors import InputError, MacroslipError, legible
from macroslip.files import SHORTER

INTERNAL_ERROR, BAD_INPUT, ROLLERS_FAILED, INTERRUPTED = 1, 2, 3, 130
CASES_FAILED = ROLLERS_FAILED
#: Time after which a lost interrupt is raised again [s]: the finalizer or callback has ended by then.
_AGAIN = 0.05
MEMORY = "Use shorter loads, fewer rollers or no traces."


def to_stderr(text: str) -> None:
    """Write a line to standard error."""
    typer.echo(text, err=True)


def command(app: typer.Typer, function: Callable[..., None], name: str | None = None) -> None:
    """Add a function to the commands of `app`, under its own name if no other is given.

    Its exceptions become a paragraph on standard error and an exit code; only an error in the program itself shows a
    traceback. With the option `quiet` of the command it becomes one line in any case.
    """

    @functools.wraps(function)
    def run(*args: Any, **options: Any) -> None:
        try:
            with interrupts_kept():
                function(*args, **options)
        except (
            typer.Exit,
            BrokenPipeError,
        ):  # a reader such as `head` that closes the pipe early is not an error
            raise
        except BaseException as error:
            code, message = _told(error, quiet=bool(options.get("quiet")))
            to_stderr(message)
            raise typer.Exit(code) from None

    app.command(name)(run)


def _told(error: BaseException, *, quiet: bool) -> tuple[int, str]:
    if isinstance(error, KeyboardInterrupt):
        return INTERRUPTED, "interrupted"
    if isinstance(error, MacroslipError):
        return BAD_INPUT, f"error: {' '.join(str(error).split()) if quiet else error}"
    if isinstance(error, OSError):
        place = legible(f"{error.filename}: ", InputError.longest_place) if error.filename else ""
        remedy = "Check the path, the rights to it and the free space on the disk."
        return (
            BAD_INPUT,
            f"error: {place}{error.strerror or error}. {SHORTER if error.errno == errno.ENAMETOOLONG else remedy}",
        )
    if isinstance(error, MemoryError):
        return BAD_INPUT, f"error: the computer has not enough memory for this. {MEMORY}"
    if not isinstance(error, Exception):
        raise error
    if quiet:
        what = " ".join(f"{type(error).__name__}: {error}".split())
        where = "This is a fault of macroslip; without --quiet it shows where."
        return INTERNAL_ERROR, f"internal error: {what}. {where}"
    import traceback

    traceback.print_exception(error)
    return (
        INTERNAL_ERROR,
        f"internal error: {type(error).__name__}. This is a fault of macroslip; please report what is above.",
    )


@contextmanager
def interrupts_kept() -> Iterator[None]:
    """Raise a `KeyboardInterrupt` in the main thread again, if Python could not raise it.

    Where it arises in a finalizer or in a callback from compiled code, of which compiling makes many, Python cannot
    raise it: it prints it and goes on.
    """
    report = sys.unraisablehook

    def hook(unraisable: Any, /) -> None:
        if issubclass(unraisable.exc_type, KeyboardInterrupt):
            threading.Timer(_AGAIN, _thread.interrupt_main).start()
        else:
            report(unraisable)

    sys.unraisablehook = hook
    try:
        yield
    finally:
        sys.unraisablehook = report
