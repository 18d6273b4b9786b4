"""Objects in a notebook: a heading and a small table."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape


def html_overview(title: str, headings: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A heading over a table, every text in it escaped.

    Empty headings make no line.

    Examples
    --------
    >>> html_overview("a < b", ["", ""], [["x", 1]])
    '<div><strong>a &lt; b</strong><table><tr><td>x</td><td>1</td></tr></table></div>'
    """
    lines = []
    for row in rows:
        cells = [f"<td>{escape(str(cell))}</td>" for cell in row]
        lines.append("".join(cells))
    if any(headings):
        lines.insert(0, "".join(f"<th>{escape(heading)}</th>" for heading in headings))
    table = "".join(f"<tr>{line}</tr>" for line in lines)
    return f"<div><strong>{escape(title)}</strong><table>{table}</table></div>"
