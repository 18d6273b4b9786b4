"""Outcomes of the integration of a roller, each with the sentence that is shown to the user."""

from __future__ import annotations

from enum import IntEnum


class Status(IntEnum):
    """Outcome of one roller's integration.

    Examples
    --------
    >>> Status.COMPLETED.sentence
    'completed'
    """

    COMPLETED = 0, "completed"
    STEP_TOO_SMALL = (
        1,
        "the step became shorter than time resolves; loosen the tolerance or check the load at that time",
    )
    NOT_FINITE = (
        2,
        "forces or slip became NaN or infinite; use an implicit integrator or a smaller step",
    )
    TOO_MANY_STEPS = (
        3,
        "the step limit was reached; loosen the tolerance or raise integrator.max_steps",
    )
    NO_ROOT = (
        4,
        "the implicit equation of a step was not solved to its tolerance; use a smaller step",
    )
    IMPOSSIBLE_SLIP = (
        5,
        "slip left the range that friction allows, so the step is unstable; use a smaller one or radau",
    )
    OUTSIDE_TABLES = (
        6,
        "load or speed left the range of the contacts' tables; check the loads at that time",
    )

    def __new__(cls, value: int, sentence: str):
        """Make a member that carries its sentence."""
        member = int.__new__(cls, value)
        member._value_ = value
        member.sentence = sentence
        return member


#: Plain integers for compiled code.
COMPLETED, STEP_TOO_SMALL, NOT_FINITE, TOO_MANY_STEPS, NO_ROOT, IMPOSSIBLE_SLIP, OUTSIDE_TABLES = (
    range(7)
)
#: Status of an integration whose buffer of steps is full.
UNDER_WAY = -1
