"""Bars that show how much of the work is done, in a terminal or a notebook."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from macroslip.storage.waiting import COMPILING, TABLES, heard_by

if TYPE_CHECKING:
    from rich.console import Console
    from rich.progress import Progress

PREPARING = "preparing (the first run of all compiles)"


class StageBars:
    """A bar for every stage of some work; those of waiting go when the work goes on.

    Parameters
    ----------
    console : rich.console.Console
    preparing : str
        Name of the bar before anything is reported.
    """

    def __init__(self, console: Console, preparing: str = PREPARING):
        self.bar = _bar_with_time_left(console)
        self._waiting = (preparing, COMPILING, TABLES)
        self._tasks = {preparing: self.bar.add_task(preparing, total=None)}
        self._guard = threading.Lock()

    def report(self, stage: str, done: int, total: int, text: str | None = None) -> None:
        """Show how far a stage is, from any thread.

        Parameters
        ----------
        stage : str
        done, total : int
        text : str, optional
            What stands before the bar; the stage's name without it.
        """
        with self._guard:
            goes_on = done > 0 and stage not in self._waiting
            over = self._waiting if goes_on else self._waiting[:1]
            for waiting in self._tasks.keys() & set(over):
                self.bar.remove_task(self._tasks.pop(waiting))
            if stage not in self._tasks:
                self._tasks[stage] = self.bar.add_task(stage, total=total)
            self.bar.update(
                self._tasks[stage], description=text or stage, completed=done, total=total
            )


@contextmanager
def progress_bar(label: str = "rollers") -> Iterator[Callable[[int, int], None]]:
    """Show a bar while the block runs; a notebook needs `ipywidgets` for it.

    Compiling, which happens once, and tables of the contacts have bars of their own.

    Gives a function for the argument `progress` of `macroslip.simulate`; `label` names the things
    that are counted.

    Examples
    --------
    >>> from macroslip import BearingLoads, Case, Laws, progress_bar, simulate
    >>> loads = BearingLoads.constant([0.0, -300e3, 0.0], 0.0, 1.0)
    >>> case = Case(loads=loads, laws=Laws.paper(), rollers=[0])
    >>> with progress_bar() as progress:
    ...     result = simulate(case, progress=progress)
    >>> result.status.values.tolist()
    [[0], [0]]
    """
    from rich.console import Console

    bars = StageBars(Console(stderr=True))
    with bars.bar, heard_by(bars.report):
        yield lambda done, total: bars.report(label, done, total)


def _bar_with_time_left(console: Console) -> Progress:
    """A bar with counts of done and all, and the time left; it disappears when all is done."""
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeRemainingColumn,
    )

    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(),
        TextColumn("left"),
    )
    return Progress(*columns, console=console, transient=True, speed_estimate_period=600.0)
