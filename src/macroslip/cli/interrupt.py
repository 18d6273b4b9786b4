"""Ctrl-C is never lost.

Where a `KeyboardInterrupt` arises in a finalizer or in a callback from compiled code, of which compiling makes many, Python
cannot raise it: it prints it and goes on.
"""

from __future__ import annotations

import _thread
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

#: Time after which a lost interrupt is raised again [s]: the finalizer or callback has ended by then.
_AGAIN = 0.05


@contextmanager
def interrupts_kept() -> Iterator[None]:
    """Raise a `KeyboardInterrupt` in the main thread again, if Python could not raise it.

    Raises
    ------
    KeyboardInterrupt
    """
    report = sys.unraisablehook

    def hook(unraisable: Any, /) -> None:
        if issubclass(unraisable.exc_type, KeyboardInterrupt):
            threading.Timer(_AGAIN, _thread.interrupt_main).start()
        else:
            report(unraisable)

    sys.unraisablehook = hook
    try:
        yield
    finally:
        sys.unraisablehook = report
