"""A progress bar with the time left."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

DELAY = 1.0
"""Work that is done within this time [s] shows no bar."""


@contextmanager
def command_progress(*, quiet: bool) -> Iterator[Callable[[str, int, int], None] | None]:
    """Show a bar while the block runs, if standard error is a terminal and it takes a moment.

    Gives a function to be called as `report(label, done, total)`, each label with a bar of its own;
    None if it is quiet or nothing is shown.
    """
    from rich.console import Console

    from macroslip.progress import PREPARING, bar_with_time_left

    console = Console(stderr=True)
    if quiet or not console.is_terminal:
        yield None
        return
    bar = bar_with_time_left(console)
    task = bar.add_task(PREPARING, total=None)

    def report(label: str, done: int, total: int) -> None:
        if label != bar.tasks[0].description:  # another piece of work: its speed is its own
            bar.reset(task)
        bar.update(task, description=label, completed=done, total=total)

    start = threading.Timer(DELAY, bar.start)
    start.daemon = True
    start.start()
    try:
        yield report
    finally:
        start.cancel()
        start.join()
        bar.stop()
