"""Errors a user meets, written for the user: what is wrong, where, what is allowed, what to do."""

from __future__ import annotations


class MacroslipError(Exception):
    """Base of every error this package raises on purpose."""


class InputError(MacroslipError, ValueError):
    """Input that cannot be used, told in one paragraph.

    Parameters
    ----------
    what : str
        What is wrong, with the offending value.
    where : str
        File, key, line or time stamp at which it stands.
    allowed : str
        What would be accepted.
    remedy : str
        What to do about it.

    Examples
    --------
    >>> print(InputError("the shaft speed is NaN", where="run.csv, t = 3.2 s",
    ...                  allowed="finite numbers", remedy="Fill or cut the gap."))
    run.csv, t = 3.2 s: the shaft speed is NaN. Allowed: finite numbers. Fill or cut the gap.
    """

    def __init__(self, what: str, *, where: str = "", allowed: str = "", remedy: str = ""):
        self.what, self.where, self.allowed, self.remedy = what, where, allowed, remedy
        parts = [f"{where}: {what}" if where else what]
        if allowed:
            parts.append(f"Allowed: {allowed}")
        if remedy:
            parts.append(remedy)
        super().__init__(" ".join(part if part.endswith((".", "!", "?")) else part + "." for part in parts))
