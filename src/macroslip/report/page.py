"""A page: sections from templates, as one HTML file that needs no network and no other file."""

from __future__ import annotations

import base64
import functools
import hashlib
import itertools
import json
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from importlib import resources
from typing import TYPE_CHECKING, Any

import macroslip
from macroslip.printed import number
from macroslip.report.style import Picture, three_digits

if TYPE_CHECKING:
    from jinja2 import Environment
    from markupsafe import Markup

_NUMBER = re.compile(r"([<>] )?[−-]?[\d,]*\.?\d+(e[+-]?\d+)?$|–$")


@dataclass(frozen=True, slots=True)
class Table:
    """Rows of text under headings; a column whose cells are numbers is set to the right."""

    headings: Sequence[str]
    rows: Sequence[Sequence[str]]
    caption: str = ""

    @property
    def numeric(self) -> list[bool]:
        """True for each column whose cells are all numbers, or dashes for these."""
        columns = list(zip(*self.rows, strict=True))
        if not columns:
            return [False] * len(self.headings)
        return [all(map(_NUMBER.match, cells)) for cells in columns]


@dataclass(frozen=True, slots=True)
class Opening:
    """The first screen of a page: at most five paragraphs and four pictures."""

    body: Markup
    pictures: Sequence[Picture]
    table: Table | None = None  #: Above both, as wide as the page
    below: Markup | str = ""  #: A table over the whole width, below the pictures

    def __post_init__(self) -> None:
        if self.body.count("<p") > 5 or len(self.pictures) > 4:
            raise ValueError("an opening has at most five sentences and four pictures")


@dataclass(frozen=True, slots=True)
class Section:
    """A part of the page that can be folded."""

    name: str  #: For links to it
    title: str
    body: Markup  #: From a template; a section without a body is left out
    gist: str = ""  #: Its content in a line; shown beside the title of a folded section
    group: str = (
        ""  #: Name of the group that several sections in a row make, such as one of several results
    )


@functools.cache
def environment() -> Environment:
    """Templates of this package, every text in them escaped."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

    templates = Environment(
        loader=PackageLoader("macroslip.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    templates.filters |= {"three": three_digits, "number": number, "as_json": _as_json}
    return templates


def words(template: str) -> Any:
    """The macros of a template; each gives a part of a page."""
    return environment().get_template(template).module


def sections(
    template: str, bodies: Mapping[str, Any], *, suffix: str = "", group: str = ""
) -> list[Section]:
    """Sections from bodies by name, with the titles and gists of the template.

    Parameters
    ----------
    template : str
        Name of the template; its dictionary `titles` has the titles and gists.
    bodies : mapping
        Body of each section by its name.
    suffix : str, optional
        Added to the names, where a page shows several results.
    group : str, optional
        Name of the group that the sections make, such as one of several results.
    """
    titles = words(template).titles
    return [
        Section(f"{name}{suffix}", titles[name][0], body, titles[name][1], group)
        for name, body in bodies.items()
    ]


def render(title: str, subtitle: str, opening: Opening, parts: Iterable[Section]) -> str:
    """One HTML page with style, script, pictures and data inside it, every text escaped.

    Parameters
    ----------
    title, subtitle : str
        Heading, and what stands below it.
    opening : Opening
        Always shown, under the name "answer".
    parts : iterable of Section
        Folded until links, a search in the page or printing open them.

    Notes
    -----
    A policy in the page lets only its own script run and forbids every request.
    """
    files = resources.files("macroslip.report") / "templates"
    script = "".join(
        (files / name).read_text(encoding="utf-8") for name in ("bearing_view.js", "folds.js")
    )
    shown = [part for part in parts if part.body.strip()]
    return (
        environment()
        .get_template("page.html")
        .render(
            title=title,
            subtitle=subtitle,
            opening=opening,
            groups=[
                (group, list(some))
                for group, some in itertools.groupby(shown, lambda part: part.group)
            ],
            style=(files / "report.css").read_text(encoding="utf-8"),
            script=script,
            script_hash=base64.b64encode(hashlib.sha256(script.encode()).digest()).decode("ascii"),
            program=f"macroslip {macroslip.__version__}",
        )
    )


def _as_json(value: Any) -> Markup:
    from markupsafe import Markup

    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    return Markup(text.replace("&", "\\u0026").replace("<", "\\u003c").replace(">", "\\u003e"))
