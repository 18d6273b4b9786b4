"""The command line: one command a file.

Imports of a command wait until it runs, so that help comes at once.
"""

from __future__ import annotations

import gc
import io
import os
import signal
import sys
import warnings

INTERRUPTED = 130  # exit code of a command that Ctrl-C has ended, as shells count it


class _Patient(io.FileIO):
    """A stream whose reader may go, as `head` does; the command ends as it would have."""

    def write(self, data, /) -> int:
        try:
            return super().write(data) or 0
        except BrokenPipeError:
            return len(data)


def main() -> None:
    """Entry point of the command `macroslip`."""
    try:
        for name in ("stdout", "stderr"):
            stream = getattr(sys, name)
            if isinstance(stream, io.TextIOWrapper):
                # Output to a file or a pipe is encoded by Windows in a way that lacks most
                # characters.
                stream.reconfigure(errors="backslashreplace")
                if os.name == "posix" and not stream.isatty():
                    patient = io.TextIOWrapper(
                        io.BufferedWriter(_Patient(stream.fileno(), "w", closefd=False)),
                        stream.encoding,
                        "backslashreplace",
                        line_buffering=stream.line_buffering,
                    )
                    setattr(sys, name, patient)
        # Pictures become files. A notebook hands the name of its own backend to the processes it
        # starts, and Matplotlib does not start where that one is not installed.
        os.environ["MPLBACKEND"] = "agg"
        if not sys.warnoptions:
            # NumPy's warnings are of no use to whoever runs a command: numbers that are not finite
            # are refused by name, or have a status.
            warnings.simplefilter("ignore", RuntimeWarning)
        # Modules and kernels stay until a command ends: the collector of garbage, which would begin
        # after every 700 new objects, would go through them again and again, a twelfth of the time
        # of a short command.
        gc.set_threshold(20_000)
        # Matrices here are small, and cases run side by side in threads and processes of our own.
        # The threads that NumPy and SciPy start for large ones would wait for work in a busy loop,
        # a quarter to two fifths of the CPU time of a short command.
        os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
        from macroslip.machine import safe_path

        # Processes that are started here and get their path from this one do not get the current
        # folder either.
        sys.path[:] = safe_path(sys.path)
        from macroslip.cli.commands import app

        app()
    except SystemExit as end:
        # While the arguments are read, typer makes an exit of an interrupt and says nothing.
        if isinstance(getattr(end.__context__, "__cause__", None), KeyboardInterrupt):
            print("interrupted", file=sys.stderr)
        if end.code == INTERRUPTED:
            ignore_interrupts()
        raise
    except KeyboardInterrupt:  # before a command has begun
        ignore_interrupts()
        print("interrupted", file=sys.stderr)
        sys.exit(INTERRUPTED)


def ignore_interrupts() -> None:
    """Let Ctrl-C have no effect while an interrupted command puts its things away.

    Python takes its own handler away before it ends, and one more Ctrl-C would kill the process:
    the shell would be told of a signal in place of the exit code.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
