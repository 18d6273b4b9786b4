"""A progress bar with the time left."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager

DELAY = 1.0
"""What is done within this time [s] shows no bar."""


@contextmanager
def command_progress(
    *, quiet: bool, stages: Mapping[str, float] | None = None
) -> Iterator[Callable[[str, int, int], None] | None]:
    """Show a bar on standard error while the block runs, if that is a terminal and it takes more than a moment.

    Parameters
    ----------
    quiet : bool
        Whether to show nothing.
    stages : mapping, optional
        Labels of the work in their order, and what each takes of the time, in proportion. The bar and the time left
        are then those of all of it; without, each label has a bar of its own.

    Yields
    ------
    callable or None
        To be called as `report(label, done, total)`; None if nothing is shown.
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
        if stages is not None:
            part, whole = share_done(stages, label, done / total), sum(stages.values())
            bar.update(task, description=label, completed=round(100 * part / whole), total=100)
            return
        if label != bar.tasks[0].description:  # another piece of work: its speed is its own
            bar.reset(task, description=label, total=total)
        bar.update(task, completed=done)

    start = threading.Timer(DELAY, bar.start)
    start.daemon = True
    start.start()
    try:
        yield report
    finally:
        start.cancel()
        start.join()
        bar.stop()


def share_done(stages: Mapping[str, float], label: str, part: float) -> float:
    """What is done of all stages when `part` of the stage `label` is; a label that is not known counts nothing itself.

    Examples
    --------
    >>> share_done({"first": 3.0, "second": 1.0}, "second", 0.5)
    3.5
    """
    known = list(stages)
    before = known.index(label) if label in known else 0
    return sum(stages[name] for name in known[:before]) + stages.get(label, 0.0) * part
