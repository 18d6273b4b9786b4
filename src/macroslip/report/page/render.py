"""From blocks to one HTML file that needs nothing else: no network, no other file."""

from __future__ import annotations

import base64
import hashlib
import itertools
import json
import re
from collections.abc import Sequence
from importlib import resources
from typing import Any

import macroslip
from macroslip.report.page.blocks import Opening, Section, Table

_NUMBER = re.compile(r"[−-]?[\d,]*\.?\d+(e[+-]?\d+)?$")
_SYMBOLS = {"agrees": "✓", "agrees in part": "◐", "differs": "✗", "cannot be judged": "?", "not computed": "–"}


def render(title: str, subtitle: str, opening: Opening, sections: Sequence[Section]) -> str:
    """One HTML page with style, script, pictures and data inside it.

    Parameters
    ----------
    title, subtitle : str
    opening : Opening
        Always shown, under the name "answer".
    sections : sequence of Section
        Folded when the page is opened; links, a search in the page and printing open them.

    Returns
    -------
    str
        HTML. Every text is escaped; a policy in the page lets only its own script run and forbids every request.
    """
    from jinja2 import Environment, PackageLoader, StrictUndefined

    files = resources.files("macroslip.report.page")
    script = "".join((files / name).read_text(encoding="utf-8") for name in ("bearing_view.js", "folds.js"))
    style = (files / "report.css").read_text(encoding="utf-8")
    environment = Environment(
        loader=PackageLoader("macroslip.report", "page"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {"numeric_columns": _numeric_columns, "as_json": _as_json}
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode("ascii")
    return environment.get_template("report.html").render(
        title=title,
        subtitle=subtitle,
        opening=opening,
        groups=[(group, list(found)) for group, found in itertools.groupby(sections, lambda one: one.group)],
        style=style,
        script=script,
        script_hash=digest,
        symbols=_SYMBOLS,
        program=f"macroslip {macroslip.__version__}",
    )


def _numeric_columns(table: Table) -> list[bool]:
    """Whether every cell of a column is a number, or a dash for one."""
    columns = list(zip(*table.rows, strict=True)) or [()] * len(table.headings)
    return [any(cells) and all(_NUMBER.match(cell) or cell == "–" for cell in cells) for cells in columns]


def _as_json(value: Any) -> Any:
    """JSON that cannot end the HTML element around it."""
    from markupsafe import Markup

    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    return Markup(text.replace("&", "\\u0026").replace("<", "\\u003c").replace(">", "\\u003e"))
