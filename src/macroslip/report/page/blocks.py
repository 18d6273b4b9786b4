"""What a page is made of: plain data that the template turns into HTML, every text escaped."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from macroslip.report.pictures import Picture


@dataclass(frozen=True, slots=True)
class Paragraph:
    """Text; `strong` for the main sentence."""

    kind: ClassVar[str] = "paragraph"
    text: str
    strong: bool = False


@dataclass(frozen=True, slots=True)
class Points:
    """Texts, one below the other."""

    kind: ClassVar[str] = "points"
    texts: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Table:
    """Rows of text under headings; a column whose cells are numbers is set to the right."""

    kind: ClassVar[str] = "table"
    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    caption: str = ""


@dataclass(frozen=True, slots=True)
class Pictures:
    """Pictures beside each other, as many as fit, under one caption."""

    kind: ClassVar[str] = "pictures"
    pictures: tuple[Picture, ...]
    caption: str = ""


@dataclass(frozen=True, slots=True)
class Beside:
    """What the paper states, and below it what was computed."""

    kind: ClassVar[str] = "beside"
    title: str
    stated: tuple[str, ...]
    pictures: tuple[Picture, ...]
    caption: str = ""


@dataclass(frozen=True, slots=True)
class Statements:
    """The paper's statements, each with verdict, finding and reason under every model.

    Attributes
    ----------
    models : tuple of str
    rows : tuple
        (statement, ((verdict, found, because), one a model)).
    """

    kind: ClassVar[str] = "statements"
    models: tuple[str, ...]
    rows: tuple[tuple[str, tuple[tuple[str, str, str], ...]], ...]


@dataclass(frozen=True, slots=True)
class View:
    """The bearing in motion; `scenes` is what `macroslip.report.bearing_view.scene_data` gives, by title."""

    kind: ClassVar[str] = "view"
    scenes: Mapping[str, Mapping[str, Any]]


@dataclass(frozen=True, slots=True)
class Verbatim:
    """Text to be copied without change."""

    kind: ClassVar[str] = "verbatim"
    text: str
    caption: str = ""


Block = Paragraph | Points | Table | Pictures | Beside | Statements | View | Verbatim


@dataclass(frozen=True, slots=True)
class Opening:
    """The first screen of a page.

    Attributes
    ----------
    sentences : tuple of str
        The answer, at most five sentences, the main one first.
    pictures : tuple of Picture
        At most four.
    """

    sentences: tuple[str, ...]
    pictures: tuple[Picture, ...]

    def __post_init__(self) -> None:
        if len(self.sentences) > 5 or len(self.pictures) > 4:
            raise ValueError("an opening has at most five sentences and four pictures")


@dataclass(frozen=True, slots=True)
class Section:
    """A part of the page that can be folded.

    Attributes
    ----------
    name : str
        For links to it.
    title : str
    blocks : tuple of Block
    gist : str
        What is in it, in a line; shown beside the title of a folded section.
    group : str
        What several sections in a row belong to, such as one of several results.
    """

    name: str
    title: str
    blocks: tuple[Block, ...]
    gist: str = ""
    group: str = ""
