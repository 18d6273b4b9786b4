"""Progress of a command: bars with the time left, or a line for each stage."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from macroslip.cli.failure import to_stderr
from macroslip.progress import PREPARING

if TYPE_CHECKING:
    from rich.console import Console

    from macroslip.study.progress import Progress

DELAY = 1.0
"""Work that is done within this time [s] shows no bar."""
LINE_AFTER = 1.0
"""Without a terminal a stage is named, once, if it takes longer than this [s]."""
LINE_EVERY = 60.0
"""Time between lines about the runs of a study where there is no terminal [s]."""
SILENT_FOR = 10.0
"""Without a terminal work that counts nothing is named after this time [s]."""


@contextmanager
def command_progress(
    *, quiet: bool, work: str | None = None
) -> Iterator[Callable[..., None] | None]:
    """Show how far work is while the block runs, on standard error.

    A terminal gets bars if it takes a moment; elsewhere every stage that takes long gets a line.
    Compiling and tables are stages of their own.

    Gives a function to be called as `report(label, done, total)`, each label with a bar of its own;
    None if it is quiet.

    Parameters
    ----------
    quiet : bool
        Whether nothing is shown.
    work : str, optional
        What the command does as long as nothing is counted; preparing a run without it.
    """
    if quiet:
        yield None
        return
    from rich.console import Console

    from macroslip.storage.waiting import heard_by

    console = Console(stderr=True)
    showing = _bars(console, work or PREPARING) if console.is_terminal else _lines(work)
    with showing as report, heard_by(report):
        yield report


@contextmanager
def study_progress(*, quiet: bool) -> Iterator[Callable[[Progress], None] | None]:
    """Show how far a study is while the block runs, on standard error.

    As `command_progress`; without a terminal there is a line about the runs once a minute.

    Gives a function for the argument `progress` of `macroslip.run_study`; None if it is quiet.

    Parameters
    ----------
    quiet : bool
        Whether nothing is shown.
    """
    with command_progress(quiet=quiet) as report:
        yield None if report is None else _of_runs(report)


def _of_runs(report: Callable[..., None]) -> Callable[[Progress], None]:
    """A function that shows the runs of a study: a bar on a terminal, elsewhere a line a minute."""
    from rich.console import Console

    if Console(stderr=True).is_terminal:

        def counts(progress: Progress) -> None:
            text = f"{progress.unchanged} unchanged, {progress.failed} failed"
            # Runs that were there already say nothing about the time of the others.
            done = progress.done - progress.unchanged
            report("runs", done, progress.total - progress.unchanged, text)

        return counts
    due = time.monotonic() + LINE_AFTER

    def line(progress: Progress) -> None:
        nonlocal due
        if time.monotonic() >= due:
            due = time.monotonic() + LINE_EVERY
            to_stderr(progress.line)

    return line


@contextmanager
def _bars(console: Console, preparing: str) -> Iterator[Callable[..., None]]:
    """Bars of stages, after a moment."""
    from macroslip.progress import StageBars

    bars = StageBars(console, preparing)
    start = threading.Timer(DELAY, bars.bar.start)
    start.daemon = True
    start.start()
    try:
        yield bars.report
    finally:
        start.cancel()
        start.join()
        bars.bar.stop()


@contextmanager
def _lines(work: str | None) -> Iterator[Callable[[str, int, int], None]]:
    """A line for every stage that takes long, once, and one for work that counts nothing."""
    began: dict[str, float] = {}
    announced: set[str] = set()
    silent = threading.Timer(SILENT_FOR, to_stderr, [work])
    silent.daemon = True
    if work is not None:
        silent.start()

    def report(label: str, done: int, total: int) -> None:
        now = time.monotonic()
        if done > 0 and label not in announced and now - began.setdefault(label, now) >= LINE_AFTER:
            announced.add(label)
            to_stderr(f"{label}: {done} of {total} done")

    try:
        yield report
    finally:
        silent.cancel()
