"""Who does the work: this process, or workers of a Dask cluster. Both are handed tasks and give back what was done."""

from __future__ import annotations

from collections import deque
from typing import Any, Protocol

from macroslip.study.work import work_several

Done = tuple[dict[str, Any], dict[str, Any]]
"""A task and what `work` returned for it."""


class Workers(Protocol):
    """Does tasks, of which it takes a bounded number at a time."""

    def free_places(self) -> int:
        """How many more tasks it takes now."""

    def submit(self, tasks: list[dict[str, Any]]) -> None:
        """Hand over tasks, at most as many as there are free places."""

    def wait(self) -> list[Done]:
        """Wait until something is done; nothing when nothing was handed over."""


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
