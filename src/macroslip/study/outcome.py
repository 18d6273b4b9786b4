"""How a run of a study can end, each with the sentence that is shown to the user."""

from __future__ import annotations

from enum import StrEnum


class Outcome(StrEnum):
    """State of one run.

    Examples
    --------
    >>> Outcome.COMPLETED.sentence
    'computed and stored'
    """

    COMPLETED = "completed", "computed and stored"
    ROLLERS_FAILED = "rollers failed", "computed and stored, but the integration of some rollers failed"
    FAILED = "failed", "not computed, for the reason given; tried again by every --resume"
    MISSING = "missing", "not computed yet"

    def __new__(cls, value: str, sentence: str):
        """Make a member that carries its sentence."""
        member = str.__new__(cls, value)
        member._value_ = value
        member.sentence = sentence
        return member

    @property
    def stored(self) -> bool:
        """Whether there is a result."""
        return self in (Outcome.COMPLETED, Outcome.ROLLERS_FAILED)
