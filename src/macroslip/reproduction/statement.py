"""A statement of the paper beside what was found, and the verdict on it."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

AGREES, PARTLY, DIFFERS, UNKNOWN = "agrees", "agrees in part", "differs", "cannot be judged"
#: Verdict on what was not computed under a model.
NOT_COMPUTED = "not computed"
#: "About" in a statement allows this factor either way.
ABOUT = 2.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Statement:
    """One statement of the paper and what was found.

    Parameters
    ----------
    paper : str
        What the paper states.
    verdict : str
        "agrees", "agrees in part", "differs", "cannot be judged" (a number is NaN) or "not computed".
    found : str
        What a converged solution gives, in words with numbers.
    because : str
        What was measured that explains it, where it does not simply agree; empty if nothing was.
    numbers : dict
        The numbers the verdict rests on.
    """

    paper: str
    verdict: str
    found: str
    because: str = ""
    numbers: dict[str, float | list[float]] = field(default_factory=dict)


def verdict(parts: list[bool], numbers: dict[str, float | list[float]]) -> str:
    """The verdict on a statement of several parts that rests on `numbers`.

    Examples
    --------
    >>> verdict([True, False], {"ratio": 2.0}), verdict([True], {"ratio": float("nan")})
    ('agrees in part', 'cannot be judged')
    """
    values = [one for value in numbers.values() for one in (value if isinstance(value, list) else [value])]
    if not all(math.isfinite(value) for value in values):
        return UNKNOWN
    return AGREES if all(parts) else (PARTLY if any(parts) else DIFFERS)


def about(value: float, stated: float) -> bool:
    """Whether a value is about what is stated.

    Examples
    --------
    >>> about(6.0, 10.0), about(4.0, 10.0)
    (True, False)
    """
    return stated / ABOUT <= value <= stated * ABOUT


def not_computed(paper: str) -> Statement:
    """A statement that nothing was computed for."""
    return Statement(paper=paper, verdict=NOT_COMPUTED, found="not computed under this model")
