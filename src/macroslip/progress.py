"""A bar that shows how much of the work is done, in a terminal or a notebook."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console
    from rich.progress import Progress

PREPARING = "preparing (the first run of all compiles)"


@contextmanager
def progress_bar(label: str = "rollers") -> Iterator[Callable[[int, int], None]]:
    """Show a bar while the block runs; a notebook needs `ipywidgets` for it.

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

    with bar_with_time_left(Console(stderr=True)) as bar:
        task = bar.add_task(PREPARING, total=None)
        yield lambda done, total: bar.update(task, description=label, completed=done, total=total)


def bar_with_time_left(console: Console) -> Progress:
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
