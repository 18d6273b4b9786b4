"""Problems with a record, in the user's words and units."""

from __future__ import annotations

import difflib
import itertools
import reprlib
from collections.abc import Iterable, Sequence

from macroslip.errors import InputError

MOST_PROBLEMS, MOST_LETTERS = 20, 12_000
"""Problems that one message lists, and letters after which it lists no more."""


def shown(value: object) -> str:
    """Write a value for a message, cut to one short line.

    Examples
    --------
    >>> shown("70 mm"), shown([1, 2])
    ("'70 mm'", '[1, 2]')
    """
    return " ".join(reprlib.repr(value).split())


def unknown_key(key: object, allowed: Iterable[str], *, where: str = "", inside: str = "") -> InputError:
    """Build the error for a key that does not exist, with the closest one that does.

    Parameters
    ----------
    key : object
        The key as written.
    allowed : Iterable[str]
        Keys that exist.
    where : str
        File and line.
    inside : str
        Key of the entry that contains it; empty at the top level.

    Examples
    --------
    >>> print(unknown_key("witdh", ["bore", "width"], where="b.yaml, line 3"))
    b.yaml, line 3: the key 'witdh' is unknown. Did you mean 'width'?
    """
    allowed = list(allowed)
    # Comparing takes the square of the length; no key is that long.
    close = difflib.get_close_matches(str(key)[:60], allowed, n=1)
    return InputError(
        f"the key {shown(key)} {f'inside {inside} ' if inside else ''}is unknown",
        where=where,
        allowed="" if close else ", ".join(allowed),
        remedy=f"Did you mean '{close[0]}'?" if close else "Remove it.",
    )


def together(problems: Sequence[InputError]) -> InputError:
    """Join problems into one error, so that a user can correct them all at once.

    Examples
    --------
    >>> print(together([InputError("a is 1", allowed="0"), InputError("b is 2", allowed="0")]))
    2 problems: (1) a is 1. Allowed: 0. (2) b is 2. Allowed: 0.
    """
    problems = [part for problem in problems for part in getattr(problem, "parts", [problem])]
    if len(problems) == 1:
        return problems[0]
    return Problems(problems)


class Problems(InputError):  # noqa: N818, a list of errors as one
    """Several problems as one error.

    Attributes
    ----------
    parts : list of InputError
        The problems one by one.
    """

    longest = 3 * MOST_LETTERS  # each part has its own bound

    def __init__(self, parts: Sequence[InputError]):
        self.parts = list(parts)
        texts = [f"({n}) {part}" for n, part in enumerate(parts[:MOST_PROBLEMS], 1)]
        ends = list(itertools.accumulate(len(text) + 1 for text in texts))
        shown = max(1, sum(end <= MOST_LETTERS for end in ends))
        rest = len(parts) - shown
        super().__init__(
            f"{len(parts)} problems: {' '.join(texts[:shown])}" + (f" And {rest} more." if rest > 0 else "")
        )

    def __reduce__(self) -> tuple[type[Problems], tuple[list[InputError]]]:
        return Problems, (self.parts,)
