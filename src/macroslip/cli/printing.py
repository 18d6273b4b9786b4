"""Tables and JSON on standard output."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import typer

if TYPE_CHECKING:
    from rich.console import Console

PIPE_WIDTH = 160
"""Characters a line may have where there is no terminal."""


def counted(count: int, noun: str) -> str:
    """A number with its noun, which has an s behind any number but one.

    Examples
    --------
    >>> counted(1, "run"), counted(3, "load file")
    ('1 run', '3 load files')
    """
    ending = "" if count == 1 else "s"
    return f"{count} {noun}{ending}"


def print_table(
    title: str,
    headings: Sequence[str],
    rows: Iterable[Iterable[str]],
    columns: Sequence[str] = "",
) -> None:
    """Print a table.

    Parameters
    ----------
    title : str
    headings : sequence of str
        No line of headings is printed if all are empty.
    rows : iterable of iterables of str
    columns : sequence of {"l", "r"}, optional
        Alignment of each column, left or right; all left if not given.
    """
    from rich.table import Table

    table = Table(box=None, padding=(0, 2, 0, 0), show_header=any(headings))
    sides = columns or "l" * len(headings)
    for heading, side in zip(headings, sides, strict=True):
        justify = "right" if side == "r" else "left"
        table.add_column(heading, justify=justify)
    for row in rows:
        table.add_row(*row)
    out = plain_console()
    out.print(title, style="bold", soft_wrap=True)
    out.print(table)


def print_notes(notes: Iterable[str]) -> None:
    """Print a line for each note."""
    for note in notes:
        typer.echo(f"note: {note}")


def plain_console(*, stderr: bool = False) -> Console:
    """Console without markup and colours, `PIPE_WIDTH` wide where there is no terminal."""
    from rich.console import Console

    width = None if Console(stderr=stderr).is_terminal else PIPE_WIDTH
    return Console(stderr=stderr, markup=False, highlight=False, width=width)


def number(value: float) -> str:
    """Write a number with four digits, or a dash if there is none.

    Examples
    --------
    >>> number(1234.56), number(2.14), number(0.0), number(float("nan"))
    ('1235', '2.14', '0', '-')
    """
    if math.isnan(value):
        return "-"
    return f"{value:.0f}" if 1000 <= abs(value) < 1e6 else f"{value:.4g}"


def print_json(data: Mapping[str, Any] | list[Any]) -> None:
    """Print data as JSON, with numbers in full, and null for a number that is not finite."""
    text = json.dumps(_plain(data), indent=2, allow_nan=False)
    typer.echo(text)


def _plain(data: Any) -> Any:
    """A value in types that JSON has.

    Examples
    --------
    >>> _plain({"a": (1, float("nan"))})
    {'a': [1, None]}
    """
    if isinstance(data, Mapping):
        return {str(key): _plain(value) for key, value in data.items()}
    if isinstance(data, list | tuple):
        return [_plain(value) for value in data]
    if hasattr(data, "item"):  # a number of numpy
        data = data.item()
    if isinstance(data, float):
        return data if math.isfinite(data) else None
    if data is None or isinstance(data, bool | int | str):
        return data
    return str(data)
