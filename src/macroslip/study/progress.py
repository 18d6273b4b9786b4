"""Counts of a study under way, and the time that remains."""

from __future__ import annotations

import time
from dataclasses import dataclass, field


@dataclass
class Progress:
    """Counts of a study under way."""

    total: int  #: Runs in all
    computed: int = 0
    unchanged: int = 0  #: Runs whose results were there
    failed: int = 0
    started: float = field(default_factory=time.monotonic)

    @property
    def done(self) -> int:
        """Runs that need nothing more."""
        return self.computed + self.unchanged + self.failed

    @property
    def seconds(self) -> float:
        """Time since the beginning [s], by a clock that only runs forward."""
        return time.monotonic() - self.started

    @property
    def rate(self) -> float:
        """Runs computed a second; those that were there already do not count."""
        done = self.computed + self.failed
        return done / max(self.seconds, 1e-9)

    @property
    def line(self) -> str:
        """Counts, rate and time left, in one line."""
        counts = f"{self.computed} computed, {self.unchanged} unchanged, {self.failed} failed"
        left = "-"
        if self.done == self.total:
            left = "nothing"
        elif self.rate > 0.0:
            runs_left = self.total - self.done
            left = duration(runs_left / self.rate)
        return f"{self.done} of {self.total} done ({counts}), {self.rate:.3g} a second, {left} left"


def duration(seconds: float) -> str:
    """Duration in words, by its two largest units.

    Examples
    --------
    >>> duration(0.4), duration(75), duration(7260), duration(200_000)
    ('1 s', '1 min 15 s', '2 h 1 min', '2 d 7 h')
    """
    remainder = max(1, round(seconds))
    parts = []
    for name, size in (("d", 86400), ("h", 3600), ("min", 60), ("s", 1)):
        count, remainder = divmod(remainder, size)
        if count or parts:
            parts.append(f"{count} {name}")
    largest = [part for part in parts[:2] if not part.startswith("0 ")]
    return " ".join(largest)
