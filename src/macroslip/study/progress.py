"""How far a study is: rate, time left, failures."""

from __future__ import annotations

import time
from collections import deque
from dataclasses import dataclass, field

#: Time over which the rate is taken [s].
_SPAN = 600.0


@dataclass
class Progress:
    """Counts of a study under way; times are of a clock that only runs forward.

    Parameters
    ----------
    total : int
        Number of runs.
    computed : int
        Runs computed and stored.
    unchanged : int
        Runs whose results were there already.
    failed : int
        Runs that failed, or whose rollers did.
    """

    total: int
    computed: int = 0
    unchanged: int = 0
    failed: int = 0
    started: float = field(default_factory=time.monotonic)
    _marks: deque[tuple[float, int]] = field(default_factory=deque)

    def __post_init__(self) -> None:
        self._marks.append((self.started, 0))

    @property
    def done(self) -> int:
        """Runs that need nothing more."""
        return self.computed + self.unchanged + self.failed

    @property
    def seconds(self) -> float:
        """Time since the beginning [s]."""
        return time.monotonic() - self.started

    @property
    def rate(self) -> float:
        """Runs computed a second, over the last ten minutes; 0 before the first.

        Runs whose results were there already take hardly any time and come before all others where a study is
        resumed: with them the rate would not hold for the rest.
        """
        now = time.monotonic()
        while len(self._marks) > 1 and now - self._marks[0][0] > _SPAN:
            self._marks.popleft()
        start, count = self._marks[0]
        return (self._worked - count) / (now - start) if now > start else 0.0

    @property
    def time_left(self) -> float | None:
        """Time for the rest at that rate [s], were none of it there already; None before the first run is computed."""
        return (self.total - self.done) / self.rate if self.rate > 0.0 else None

    @property
    def _worked(self) -> int:
        return self.computed + self.failed

    def mark(self) -> None:
        """Remember the present count, at most once a second."""
        now = time.monotonic()
        if now - self._marks[-1][0] >= 1.0:
            self._marks.append((now, self._worked))

    @property
    def short(self) -> str:
        """What fits beside a bar."""
        return f"{self.done} of {self.total}, {self.failed} failed, {self.rate:.3g} a second, {self._rest} left"

    @property
    def line(self) -> str:
        """Everything in one line."""
        return (
            f"{self.done} of {self.total} done "
            f"({self.computed} computed, {self.unchanged} unchanged, {self.failed} failed), "
            f"{self.rate:.3g} a second, {self._rest} left"
        )

    @property
    def _rest(self) -> str:
        if self.done == self.total:
            return "nothing"
        left = self.time_left
        return "-" if left is None else duration(left)


def duration(seconds: float) -> str:
    """Write a time.

    Examples
    --------
    >>> duration(0.4), duration(75), duration(7260), duration(200_000)
    ('1 s', '1 min 15 s', '2 h 1 min', '2 d 7 h')
    """
    whole = max(1, round(seconds))
    units = (("d", 86400), ("h", 3600), ("min", 60), ("s", 1))
    parts = []
    for name, size in units:
        count, whole = divmod(whole, size)
        if count or parts:
            parts.append(f"{count} {name}")
    return " ".join(part for part in parts[:2] if not part.startswith("0 "))
