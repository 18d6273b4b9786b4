"""Progress of what a process does before it computes: compiling, and making tables.

Whoever shows progress listens; nobody has to.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

#: Words for what is made once and kept.
COMPILING = "compiling, which happens once (number estimated)"
TABLES = "tables of the contacts"

#: Called as listener(stage, done, about how many).
Listener = Callable[[str, int, int], None]
_listeners: list[Listener] = []


@contextmanager
def heard_by(listener: Listener) -> Iterator[None]:
    """Register a listener of what this process waits for while the block runs.

    Parameters
    ----------
    listener : callable
        Called as listener(stage, done, total) from the thread that works.

    Examples
    --------
    >>> heard = []
    >>> with heard_by(lambda *told: heard.append(told)):
    ...     tell(TABLES, 1, 12)
    >>> tell(TABLES, 2, 12)
    >>> heard
    [('tables of the contacts', 1, 12)]
    """
    listen(listener)
    try:
        yield
    finally:
        _listeners.remove(listener)


def listen(listener: Listener) -> None:
    """Register a listener until this process ends; `heard_by` is for a block.

    Parameters
    ----------
    listener : callable
        As of `heard_by`.
    """
    _listeners.append(listener)


def tell(stage: str, done: int, total: int) -> None:
    """Tell all listeners how far a stage is."""
    for listener in tuple(_listeners):
        listener(stage, done, total)
