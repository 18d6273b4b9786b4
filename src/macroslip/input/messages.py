"""Messages about input: values as text, unknown keys, and several problems as one error."""

from __future__ import annotations

import itertools
import reprlib
from collections.abc import Iterable, Sequence
from difflib import get_close_matches
from typing import Any

from macroslip.errors import InputError

#: Problems that one message lists.
MOST_PROBLEMS = 20
#: Letters after which it lists no more.
MOST_LETTERS = 12_000


def shown(value: object) -> str:
    """Write a value for a message, cut to one short line.

    Examples
    --------
    >>> shown("70 mm"), shown([1, 2])
    ("'70 mm'", '[1, 2]')
    """
    return " ".join(reprlib.repr(value).split())


def nearest(value: Any, names: Iterable[str]) -> str:
    """The name most like a value; empty if none is like it.

    Examples
    --------
    >>> nearest("14D", ["14C", "22A"]), nearest(3, ["14C"])
    ('14C', '')
    """
    # Comparing takes the square of the length; no name is that long.
    matches = get_close_matches(str(value)[:60], list(names), n=1)
    return matches[0] if matches else ""


def unknown_name(value: Any, names: Sequence[str], more: str = "") -> InputError:
    """The error for a name that does not exist, with the closest name that does.

    Examples
    --------
    >>> print(unknown_name("14D", ["14C", "22A"]))
    '14D' does not exist. Allowed: 14C, 22A. Did you mean 14C?
    """
    close = nearest(value, names)
    remedy = f"Did you mean {close}?" if close else "Choose one of these."
    return InputError(
        f"{shown(value)} does not exist",
        allowed=", ".join(names),
        remedy=f"{remedy} {more}".strip(),
    )


def unknown_key(
    key: object, allowed: Iterable[str], *, where: str = "", inside: str = ""
) -> InputError:
    """Error for a key that does not exist, with the closest key that does.

    Parameters
    ----------
    key : object
        The key that was written.
    allowed : iterable of str
        Keys that exist.
    where : str, optional
        File and line.
    inside : str, optional
        Key of the section that contains it; empty at the top level.

    Returns
    -------
    InputError

    Examples
    --------
    >>> print(unknown_key("witdh", ["bore", "width"], where="b.yaml, line 3"))
    b.yaml, line 3: the key 'witdh' is unknown. Did you mean 'width'?
    """
    allowed = list(allowed)
    close = nearest(key, allowed)
    return InputError(
        f"the key {shown(key)} {f'inside {inside} ' if inside else ''}is unknown",
        where=where,
        allowed="" if close else ", ".join(allowed),
        remedy=f"Did you mean '{close}'?" if close else "Remove it.",
    )


class Problems(InputError):  # noqa: N818, a list of errors as one
    """Several problems, `parts`, as one error."""

    longest = 3 * MOST_LETTERS  # each part has its own bound

    def __init__(self, parts: Sequence[InputError]):
        self.parts = list(parts)
        told = parts[:MOST_PROBLEMS]
        texts = [f"({n}) {part}" for n, part in enumerate(told, 1)]
        ends = itertools.accumulate(len(text) + 1 for text in texts)
        listed = max(1, sum(end <= MOST_LETTERS for end in ends))
        rest = f" And {len(parts) - listed} more." if len(parts) > listed else ""
        super().__init__(f"{len(parts)} problems: {' '.join(texts[:listed])}{rest}")

    def __reduce__(self) -> tuple[type[Problems], tuple[list[InputError]]]:
        return Problems, (self.parts,)


def parts_of(problem: InputError) -> list[InputError]:
    """The problems that an error consists of."""
    return problem.parts if isinstance(problem, Problems) else [problem]


def together(problems: Iterable[InputError]) -> InputError:
    """Join problems into one error, so that a user can correct them all at once.

    Examples
    --------
    >>> print(together([InputError("a is 1", allowed="0"), InputError("b is 2", allowed="0")]))
    2 problems: (1) a is 1. Allowed: 0. (2) b is 2. Allowed: 0.
    """
    parts = [part for problem in problems for part in parts_of(problem)]
    return parts[0] if len(parts) == 1 else Problems(parts)
