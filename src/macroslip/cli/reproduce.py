"""`macroslip reproduce`: where the paper's study is."""

from __future__ import annotations

from macroslip.errors import MacroslipError


def reproduce() -> None:
    """Say how to reproduce the paper, whose study is in a clone of the sources only."""
    raise MacroslipError(
        "The paper's study is beside the package: run make reproduce in a clone of the sources."
    )
