"""Errors written for the user: the fault, its location, allowed values, a remedy."""

from __future__ import annotations

from typing import ClassVar


def safe_text(text: object, but: str = "") -> str:
    r"""Text from a file or folder with its control characters as numbers, all `but` some.

    They could steer a terminal.

    Examples
    --------
    >>> safe_text("run\x1b[2J\n7.outb")
    'run\\x1b[2J\\n7.outb'
    """
    text = str(text)
    if text.isprintable():
        return text
    return "".join(
        letter
        if letter.isprintable() or letter in but
        else letter.encode("unicode_escape").decode()
        for letter in text
    )


def legible(text: str, longest: int) -> str:
    r"""Text from anywhere for a message.

    It has no letters that a terminal would act on; its middle is cut out if it is long.

    Examples
    --------
    >>> legible("a\x1b[31mb", 100), legible("k" * 1000 + "end", 20)
    ('a\\x1b[31mb', 'kkkkkkkkkkkkk … kend')
    """
    if len(text) > longest:
        tail = longest // 4
        text = f"{text[: longest - tail - 2]} … {text[-tail + 1 :]}"
    return safe_text(text, "\n")


def on_one_line(error: object) -> str:
    """Text of an error without its line breaks.

    Examples
    --------
    >>> on_one_line("no number   in line 3")
    'no number in line 3'
    """
    return " ".join(str(error).split())


class MacroslipError(Exception):
    """Base of every error this package raises on purpose."""


class InputError(MacroslipError, ValueError):
    """Input that cannot be used, explained in one paragraph.

    Parameters
    ----------
    fault : str
        The fault, with the offending value.
    where : str
        File, key, line or time stamp of the fault.
    allowed : str
        Values that are accepted.
    remedy : str
        A way to mend it.

    Examples
    --------
    >>> print(InputError("the shaft speed is NaN", where="run.csv, t = 3.2 s",
    ...                  allowed="finite numbers", remedy="Fill or cut the gap."))
    run.csv, t = 3.2 s: the shaft speed is NaN. Allowed: finite numbers. Fill or cut the gap.
    """

    #: Letters of each part; content of a file or a name may be of any length.
    longest: ClassVar[int] = 1500
    #: The same of the location.
    longest_where: ClassVar[int] = 400
    #: Whether `where` is the location in the user's input, and not a reader's name for it without the
    #: file.
    is_located: bool = False

    def __init__(self, fault: str, *, where: str = "", allowed: str = "", remedy: str = ""):
        fault = legible(fault, self.longest)
        allowed = legible(allowed, self.longest)
        remedy = legible(remedy, self.longest)
        where = legible(where, self.longest_where)
        self.fault = fault
        self.where = where
        self.allowed = allowed
        self.remedy = remedy
        parts = [f"{where}: {fault}" if where else fault]
        if allowed:
            parts.append(f"Allowed: {allowed}")
        if remedy:
            parts.append(remedy)
        super().__init__(
            " ".join(part if part.endswith((".", "!", "?")) else part + "." for part in parts)
        )

    def but(self, **parts: str) -> InputError:
        """The same error with other parts: fault, where, allowed or remedy.

        Examples
        --------
        >>> print(InputError("the speed is NaN", remedy="Fill the gap.").but(where="run.csv"))
        run.csv: the speed is NaN. Fill the gap.
        """
        own = {"where": self.where, "allowed": self.allowed, "remedy": self.remedy}
        return InputError(**{"fault": self.fault, **own, **parts})
