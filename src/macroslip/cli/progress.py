"""Progress of a command: bars with the time left, or a line for each stage."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from macroslip.cli.failure import to_stderr

if TYPE_CHECKING:
    from rich.console import Console

DELAY = 1.0
"""Work that is done within this time [s] shows no bar."""
LINE_AFTER = 10.0
"""Without a terminal a stage is named only if it takes longer than this [s]."""


@contextmanager
def command_progress(*, quiet: bool) -> Iterator[Callable[[str, int, int], None] | None]:
    """Show how far work is while the block runs, on standard error.

    A terminal gets bars if it takes a moment; elsewhere every stage that takes long gets a line.
    Compiling and tables are stages of their own.

    Gives a function to be called as `report(label, done, total)`, each label with a bar of its own;
    None if it is quiet.
    """
    from rich.console import Console

    from macroslip.storage.waiting import heard_by

    if quiet:
        yield None
        return
    console = Console(stderr=True)
    showing = _bar(console) if console.is_terminal else _lines()
    with showing as report, heard_by(report):
        yield report


@contextmanager
def _bar(console: Console) -> Iterator[Callable[[str, int, int], None]]:
    """A progress bar for every stage, after a moment."""
    from macroslip.progress import PREPARING, bar_with_time_left
    from macroslip.storage.waiting import COMPILING, TABLES

    bar = bar_with_time_left(console)
    tasks = {PREPARING: bar.add_task(PREPARING, total=None)}
    waiting = (PREPARING, COMPILING, TABLES)
    guard = threading.Lock()

    def report(label: str, done: int, total: int) -> None:
        with guard:
            over = waiting if done > 0 and label not in waiting else (PREPARING,)
            for stage in tasks.keys() & set(over):
                bar.remove_task(tasks.pop(stage))
            if label not in tasks:
                tasks[label] = bar.add_task(label, total=total)
            bar.update(tasks[label], completed=done, total=total)

    start = threading.Timer(DELAY, bar.start)
    start.daemon = True
    start.start()
    try:
        yield report
    finally:
        start.cancel()
        start.join()
        bar.stop()


@contextmanager
def _lines() -> Iterator[Callable[[str, int, int], None]]:
    """A line for every stage that takes long, once."""
    began: dict[str, float] = {}
    announced: set[str] = set()

    def report(label: str, done: int, total: int) -> None:
        now = time.monotonic()
        if done > 0 and label not in announced and now - began.setdefault(label, now) >= LINE_AFTER:
            announced.add(label)
            to_stderr(f"{label}: {done} of {total} done")

    yield report
