"""How a command fails: one clean paragraph and an exit code a script can act on."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import typer

from macroslip.cli.interrupt import interrupts_kept
from macroslip.errors import MacroslipError

INTERNAL_ERROR, BAD_INPUT, ROLLERS_FAILED, INTERRUPTED = 1, 2, 3, 130
CASES_FAILED = ROLLERS_FAILED


def to_stderr(text: str) -> None:
    """Write a line to standard error."""
    typer.echo(text, err=True)


def command(app: typer.Typer, function: Callable[..., None]) -> None:
    """Add a function to the commands of `app`, under its own name.

    What it raises becomes a paragraph on standard error and an exit code; only an error in the program itself shows a
    traceback. With the option `quiet` of the command it becomes one line, whatever it is.
    """

    @functools.wraps(function)
    def run(*args: Any, **options: Any) -> None:
        try:
            with interrupts_kept():
                function(*args, **options)
        except (typer.Exit, BrokenPipeError):  # a reader such as `head` that closes the pipe early is not an error
            raise
        except KeyboardInterrupt:
            to_stderr("interrupted")
            raise typer.Exit(INTERRUPTED) from None
        except MacroslipError as error:
            message = str(error)
            to_stderr(f"error: {' '.join(message.split()) if options.get('quiet') else message}")
            raise typer.Exit(BAD_INPUT) from None
        except OSError as error:
            place = f"{error.filename}: " if error.filename else ""
            to_stderr(
                f"error: {place}{error.strerror or error}. Check the path, the rights to it and the free space on the disk."
            )
            raise typer.Exit(BAD_INPUT) from None
        except MemoryError:
            to_stderr(
                "error: the computer has not enough memory for this. Use shorter loads, fewer rollers or no traces."
            )
            raise typer.Exit(BAD_INPUT) from None
        except Exception as error:
            if options.get("quiet"):
                what = " ".join(f"{type(error).__name__}: {error}".split())
                to_stderr(f"internal error: {what}. This is a fault of macroslip; without --quiet it shows where.")
            else:
                import traceback

                traceback.print_exc()
                name = type(error).__name__
                to_stderr(f"internal error: {name}. This is a fault of macroslip; please report what is above.")
            raise typer.Exit(INTERNAL_ERROR) from None

    app.command()(run)
