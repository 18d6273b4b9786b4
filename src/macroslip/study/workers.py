"""Workers: this process, or those of a Dask cluster. Both take tasks and return their results."""

from __future__ import annotations

from collections import deque
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from threading import Event
from typing import Any, Protocol

from macroslip.study.work import work_several

Done = tuple[dict[str, Any], dict[str, Any]]
"""A task and what `work` returned for it."""


class Workers(Protocol):
    """Does tasks, of which it takes a bounded number at a time."""

    def free_places(self) -> int:
        """How many more tasks it takes now."""
        ...

    def submit(self, tasks: list[dict[str, Any]]) -> None:
        """Hand over tasks, at most as many as there are free places."""

    def wait(self) -> list[Done]:
        """Wait until something is done; nothing when nothing was handed over."""
        ...


class ThisProcess:
    """One run after the other, here; its rollers in threads."""

    def __init__(self) -> None:
        self._tasks: deque[dict[str, Any]] = deque()

    def free_places(self) -> int:
        """One at a time."""
        return 1 - len(self._tasks)

    def submit(self, tasks: list[dict[str, Any]]) -> None:
        """Keep the tasks until `wait`."""
        self._tasks.extend(tasks)

    def wait(self) -> list[Done]:
        """Do the next task."""
        if not self._tasks:
            return []
        task = self._tasks.popleft()
        return [(task, work_several([task])[0])]


class ThreadsHere:
    """Several runs at once in threads of this process, where the rollers of one run do not fill its processors.

    Parameters
    ----------
    runs : int
        Runs at once.
    """

    def __init__(self, runs: int):
        self._pool, self._runs, self._ended = ThreadPoolExecutor(runs), runs, Event()
        self._under_way: dict[Future, dict[str, Any]] = {}

    def close(self) -> None:
        """No more is wanted: runs that have not begun never will, and those under way end within a second."""
        self._ended.set()
        self._pool.shutdown(cancel_futures=True)

    def free_places(self) -> int:
        """As many as run at once."""
        return self._runs - len(self._under_way)

    def submit(self, tasks: list[dict[str, Any]]) -> None:
        """Begin the tasks."""
        self._under_way |= {self._pool.submit(work_several, [task], self._go_on): task for task in tasks}

    def wait(self) -> list[Done]:
        """Wait until one or more are done."""
        done, _ = wait(self._under_way, return_when=FIRST_COMPLETED)
        return [(self._under_way.pop(future), future.result()[0]) for future in done]

    def _go_on(self, done: int, total: int) -> None:
        if self._ended.is_set():
            raise KeyboardInterrupt
