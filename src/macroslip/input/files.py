"""Input files: text to plain data with the line of every key, and records back to text."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from io import StringIO
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.comments import CommentedMap, CommentedSeq
from ruamel.yaml.constructor import DuplicateKeyError
from ruamel.yaml.error import MarkedYAMLError, YAMLError
from ruamel.yaml.events import AliasEvent, CollectionEndEvent, CollectionStartEvent, ScalarEvent
from ruamel.yaml.scalarstring import DoubleQuotedScalarString

from macroslip.errors import InputError
from macroslip.input.messages import shown
from macroslip.storage.files import SPECIAL, is_special

# A bearing file has 6 kB, 250 nodes and 2 levels. Some thousand nodes parse in a second; YAML
# without bounds can describe a file of any size in a few lines.
MOST_BYTES = 200_000
MOST_NODES = 10_000
MOST_LEVELS = 20
_KINDS = {type(None): "nothing", CommentedSeq: "a list"}
_WIDTH = 118
#: Numbers that YAML has beside decimal ones, such as 0xA0 and 1_000.
_OTHER_NUMBER = re.compile(r"[+-]?(0[xob][\da-fA-F_]+|\d[\d.]*_[\d_.]*([eE][+-]?\d+)?)")


@dataclass(frozen=True)
class Source:
    """Source of data: file name and line numbers (from 1) by key and inner keys."""

    file: str = ""
    lines: Mapping[tuple[object, ...], int] = field(default_factory=dict)

    def where(self, *keys: object) -> str:
        """Name file and line of a key, or of the entry around it, as far as they are known."""
        depths = range(len(keys), 0, -1)
        line = next(
            (self.lines[keys[:depth]] for depth in depths if keys[:depth] in self.lines), None
        )
        line_text = f"line {line}" if line else ""
        return ", ".join(filter(None, (self.file, line_text)))


@dataclass(frozen=True)
class Location:
    """The location of a value in a file: its source, and its keys from the outermost inwards."""

    source: Source
    keys: tuple[str, ...] = ()

    def inside(self, *keys: str) -> Location:
        """The location of a value further in."""
        return Location(self.source, self.keys + keys)

    @property
    def key(self) -> str:
        """The keys as messages write them: `loads.hub.force`."""
        return ".".join(self.keys)

    @property
    def where(self) -> str:
        """File, line and key: `case.yaml, line 7, loads.hub.force`."""
        parts = (self.source.where(*self.keys), self.key)
        return ", ".join(filter(None, parts))

    def problem(self, fault: str, allowed: str = "", remedy: str = "") -> InputError:
        """An error at this location."""
        error = InputError(fault, where=self.where, allowed=allowed, remedy=remedy)
        error.is_located = bool(error.where)
        return error

    def blamed(self, problem: InputError) -> InputError:
        """The same error with this location in front, unless it has one already."""
        if problem.is_located:
            return problem
        # A reader that was given the value without its file can name the key only.
        if self.key and problem.where.startswith(f"{self.key}."):
            return self.inside(problem.where[len(self.key) + 1 :]).problem(
                problem.fault, problem.allowed, problem.remedy
            )
        inner = "" if problem.where == self.key else problem.where
        fault = f"{inner}: {problem.fault}" if inner else problem.fault
        return self.problem(fault, problem.allowed, problem.remedy)


def read_text(
    path: Path, fault: str, *, where: str = "", allowed: str = "", remedy: str = ""
) -> str:
    """Read a text file that a user has named.

    Parameters
    ----------
    path : Path
    what : str
        Words for a failure, such as "the case file cannot be read".
    where, allowed, remedy : str, optional
        Parts of the message if the file cannot be read.

    Returns
    -------
    str
        Content of the file.

    Raises
    ------
    InputError
        If the file cannot be read; if it is no regular file, such as a pipe or a device, which
        never ends; if it is longer than `MOST_BYTES`, or is not UTF-8.
    """

    def unreadable(reason: str) -> InputError:
        return InputError(f"{fault} ({reason})", where=where, allowed=allowed, remedy=remedy)

    try:
        if is_special(path):
            raise unreadable(SPECIAL)
        with path.open("rb") as file:  # the system has its own words for a folder
            content = file.read(MOST_BYTES + 1)
    except OSError as error:
        raise unreadable(error.strerror or str(error)) from None
    except InputError:  # a ValueError itself
        raise
    except ValueError:  # a NUL, or what UTF-8 cannot write
        raise unreadable("no file can have this name") from None
    if len(content) > MOST_BYTES:
        raise InputError(
            "the file is too long",
            where=str(path),
            allowed=f"at most {MOST_BYTES} bytes",
            remedy="Is it the file you meant? Data of that size belong into files of their own.",
        )
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError:
        raise InputError(
            "the file is not UTF-8 text", where=str(path), remedy="Save it as UTF-8."
        ) from None


def parse(
    text: str, file: str, remedy: str = "Start from one of the shipped catalogue files."
) -> tuple[dict[Any, Any], Source]:
    """Parse the text of an input file.

    Gives plain Python data and the line of every key. Raises InputError if the text is not YAML, a
    key is given twice, the file is not one mapping, for which `remedy` is the advice, or it is too
    long or too deep.
    """

    def not_yaml(problem: str, where: str) -> InputError:
        remedy = "Correct the text at or before this place."
        if "escape" in problem:
            remedy = "Write text with backslashes, such as a path of Windows, in single quotes."
        return InputError(f"this is not valid YAML ({problem})", where=where, remedy=remedy)

    try:
        _check_size(text, file)
        data = YAML(typ="rt", pure=True).load(text)
    except InputError:
        raise
    except MarkedYAMLError as error:
        where = f"{file}, line {error.problem_mark.line + 1}" if error.problem_mark else file
        if isinstance(error, DuplicateKeyError):
            raise InputError(
                str(error.problem).split(" with value ")[0],
                where=where,
                allowed="every key once",
                remedy="Delete one of the two.",
            ) from None
        raise not_yaml(
            " ".join(str(part) for part in (error.context, error.problem) if part), where
        ) from None
    except (YAMLError, ValueError) as error:  # forbidden characters; dates that do not exist
        raise not_yaml(str(error).split("\n")[0], file) from None
    except TypeError:  # a key cannot be looked up
        raise not_yaml("a key is a mapping of mappings", file) from None
    if not isinstance(data, CommentedMap):
        # Not its content: the file may be another one than was meant, and nothing for others to
        # see.
        fault = f"the file holds {_KINDS.get(type(data), 'text or a number')}"
        raise InputError(fault, where=file, allowed="a mapping of keys to entries", remedy=remedy)
    return _plain(data), Source(file, dict(_lines(data)))


def _check_size(text: str, file: str) -> None:
    """Refuse text that is deep, large with its aliases written out, or has types of YAML."""
    largest: dict[str, int] = {}  # nodes behind each anchor
    open_nodes: list[tuple[str | None, int]] = []  # anchor, and nodes before it
    nodes = 0

    def problem(fault: str, allowed: str, remedy: str) -> InputError:
        where = f"{file}, line {event.start_mark.line + 1}"
        return InputError(fault, where=where, allowed=allowed, remedy=remedy)

    def too_large(fault: str) -> InputError:
        allowed = f"{MOST_NODES} keys and values in {MOST_LEVELS} levels"
        return problem(f"the file has {fault}", allowed, "Is it the file you meant?")

    for event in YAML(typ="rt", pure=True).parse(text):
        tag = str(getattr(event, "tag", None) or "")
        if tag:
            raise problem(
                f"the value has the type {shown(tag)}",
                "numbers, text, true, false, null, lists and mappings",
                "Remove the type and write a plain value; [0, 1] is a list.",
            )
        is_plain = isinstance(event, ScalarEvent) and event.style is None
        if is_plain and _OTHER_NUMBER.fullmatch(event.value):
            raise problem(
                f"{shown(event.value)} is not a decimal number",
                "decimal digits",
                "Write it as a decimal number, or in quotes if it is text.",
            )
        if isinstance(event, CollectionStartEvent):
            open_nodes.append((event.anchor, nodes))
            nodes += 1
        elif isinstance(event, CollectionEndEvent):
            anchor, before = open_nodes.pop()
            if anchor:
                largest[anchor] = nodes - before
        elif isinstance(event, AliasEvent):
            if any(anchor == event.anchor for anchor, _ in open_nodes):
                raise too_large("an alias that contains itself")
            nodes += largest.get(event.anchor, 1)
        elif isinstance(event, ScalarEvent):
            nodes += 1
            if event.anchor:
                largest[event.anchor] = 1
        if nodes > MOST_NODES:
            raise too_large(
                f"more than {MOST_NODES} keys and values, those behind its aliases counted"
            )
        if len(open_nodes) > MOST_LEVELS:
            raise too_large(f"more than {MOST_LEVELS} levels of brackets or indentation")


def _lines(
    mapping: CommentedMap, outer: tuple[object, ...] = ()
) -> Iterator[tuple[tuple[object, ...], int]]:
    """Yield keys with their lines; a key merged from an anchor has the line of its entry."""
    for key in mapping.lc.data or {}:
        yield (*outer, key), mapping.lc.key(key)[0] + 1
    for key, entry in mapping.items():
        if isinstance(entry, CommentedMap):
            yield from _lines(entry, (*outer, key))


def _plain(value: Any) -> Any:
    if isinstance(value, CommentedMap):
        return {key: _plain(entry) for key, entry in value.items()}
    if isinstance(value, CommentedSeq):
        return [_plain(entry) for entry in value]
    return next((kind(value) for kind in (bool, int, float, str) if isinstance(value, kind)), value)


def yaml_text(entries: Mapping[str, Any], header: str, explained: Mapping[str, str]) -> str:
    """Write YAML 1.2 of one line an entry, with the meaning of every key in the line above it."""
    lines = [*_comment(header), ""]
    for key, entry in entries.items():
        meaning = explained[key]
        lines += _comment(f"{meaning[0].upper()}{meaning[1:]}.")
        if isinstance(entry, Mapping):
            entry = CommentedMap({name: _quoted(name, value) for name, value in entry.items()})
            entry.fa.set_flow_style()
        writer = YAML(typ="rt", pure=True)
        out = StringIO()
        writer.width = 2**30  # never wrap
        writer.default_flow_style = False
        writer.dump(CommentedMap({key: _quoted(key, entry)}), out)
        lines.append(out.getvalue().rstrip("\n"))
    return "\n".join(lines) + "\n"


def _comment(text: str) -> list[str]:
    return [f"# {line}" for line in textwrap.wrap(text, _WIDTH)]


def _quoted(name: str, value: Any) -> Any:
    """Free text, and the unit of a pure number, get quotes, as the shipped files have them."""
    return DoubleQuotedScalarString(value) if name == "note" or value == "1" else value
