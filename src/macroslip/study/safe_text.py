"""Names from files and folders, made safe to print."""

from __future__ import annotations

_FORMULA = ("=", "+", "-", "@", "\t", "\r")


def safe_text(text: object) -> str:
    r"""Write control characters, such as those that steer a terminal, by their numbers.

    Examples
    --------
    >>> safe_text("run\x1b[2J\n7.outb")
    'run\\x1b[2J\\n7.outb'
    """
    return "".join(
        character if character.isprintable() else character.encode("unicode_escape").decode() for character in str(text)
    )


def cell(text: str) -> str:
    """Text for a CSV file, with an apostrophe in front of what a spreadsheet would take as a formula.

    Examples
    --------
    >>> cell("=cmd()"), cell("12mps_seed1.outb")
    ("'=cmd()", '12mps_seed1.outb')
    """
    return f"'{text}" if text.startswith(_FORMULA) else text
