"""Failures of commands: one clean paragraph and an exit code a script can act on."""

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

from macroslip.cli import INTERRUPTED, ignore_interrupts
from macroslip.cli.printing import print_json
from macroslip.errors import InputError, MacroslipError, legible, on_one_line
from macroslip.storage.files import SHORTER

INTERNAL_ERROR = 1
BAD_INPUT = 2
ROLLERS_FAILED = 3
CASES_FAILED = ROLLERS_FAILED
#: Beginning of the message of dask about a file of settings that it cannot read.
_OF_DASK = "A dask config file at "
#: Module of Numba that reads its settings, and the file that it looks for in the current folder.
_SETTINGS_OF_NUMBA = "numba.core.config"
_FILE_OF_NUMBA = ".numba_config.yaml"
#: Time after which a lost interrupt is raised again [s]: the finalizer or callback has ended by
#: then.
_AGAIN = 0.05
MEMORY = "Use shorter loads, fewer rollers or no traces."


def to_stderr(text: str) -> None:
    """Write a line to standard error."""
    typer.echo(text, err=True)


def command(app: typer.Typer, function: Callable[..., None], name: str | None = None) -> None:
    """Add a function to the commands of `app`, under its own name if no other is given.

    Its exceptions become a paragraph on standard error and an exit code; only an error in the
    program itself shows a traceback. With the option `quiet` of the command it becomes one line in
    any case; with `as_json` standard output has it too, as {"error": ...}.
    """

    @functools.wraps(function)
    def run(*args: Any, **options: Any) -> None:
        try:
            with interrupts_kept():
                function(*args, **options)
        except (typer.Exit, BrokenPipeError):  # a reader such as `head` closes the pipe early
            raise
        except BaseException as error:
            if isinstance(error, KeyboardInterrupt):
                ignore_interrupts()
            quiet = bool(options.get("quiet"))
            code, message = _code_and_message(error, quiet=quiet)
            if options.get("as_json"):
                print_json({"error": message.removeprefix("error: ")})
            to_stderr(message)
            raise typer.Exit(code) from None

    app.command(name)(run)


def _code_and_message(error: BaseException, *, quiet: bool) -> tuple[int, str]:
    """Exit code and paragraph of an exception; prints the traceback of an internal error."""
    if isinstance(error, KeyboardInterrupt):
        return INTERRUPTED, "interrupted"
    if isinstance(error, MacroslipError):
        return BAD_INPUT, f"error: {on_one_line(error) if quiet else error}"
    if isinstance(error, OSError):
        return BAD_INPUT, _of_the_system(error)
    if isinstance(error, MemoryError):
        return BAD_INPUT, f"error: the computer has not enough memory for this. {MEMORY}"
    if isinstance(error, ValueError) and str(error).startswith(_OF_DASK):
        # xarray imports dask, which reads the user's settings whether it is used or not.
        fault = on_one_line(error)
        return BAD_INPUT, f"error: {fault}. Correct this file of settings of dask, or remove it."
    if _is_raised_in(_SETTINGS_OF_NUMBA, error):
        fault = on_one_line(error)
        return BAD_INPUT, (
            f"error: Numba, which compiles the program, cannot read its settings: {fault}. Correct "
            f"the file '{_FILE_OF_NUMBA}' of the current folder, or remove it."
        )
    if not isinstance(error, Exception):
        raise error
    if quiet:
        fault = " ".join(f"{type(error).__name__}: {error}".split())
        where = "This is a fault of macroslip; without --quiet it shows where."
        return INTERNAL_ERROR, f"internal error: {fault}. {where}"
    import traceback

    traceback.print_exception(error)
    return (
        INTERNAL_ERROR,
        f"internal error: {type(error).__name__}. "
        "This is a fault of macroslip; please report what is above.",
    )


def _is_raised_in(module: str, error: BaseException) -> bool:
    """True if a function of the module raised the error, or called what did."""
    step = error.__traceback__
    while step is not None:
        if step.tb_frame.f_globals.get("__name__") == module:
            return True
        step = step.tb_next
    return False


def _of_the_system(error: OSError) -> str:
    """Paragraph on an error of the operating system."""
    where = ""
    if error.filename:
        where = legible(f"{error.filename}: ", InputError.longest_where)
    remedy = "Check the path, the rights to it and the free space on the disk."
    if error.errno == errno.ENAMETOOLONG:
        remedy = SHORTER
    why = error.strerror or error
    return f"error: {where}{why}. {remedy}"


@contextmanager
def interrupts_kept() -> Iterator[None]:
    """Raise a `KeyboardInterrupt` in the main thread again, if Python could not raise it.

    Where it arises in a finalizer or in a callback from compiled code, of which compiling makes
    many, Python cannot raise it: it prints it and goes on.
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
