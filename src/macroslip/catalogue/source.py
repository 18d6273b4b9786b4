"""Text of a catalogue or case file to plain data, with the line on which every key stands."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.comments import CommentedMap, CommentedSeq
from ruamel.yaml.constructor import DuplicateKeyError
from ruamel.yaml.error import MarkedYAMLError, YAMLError

from macroslip.catalogue.problems import shown
from macroslip.errors import InputError


@dataclass(frozen=True)
class Source:
    """Where data were written: file name and line numbers (from 1) by key and inner keys."""

    file: str = ""
    lines: Mapping[tuple[object, ...], int] = field(default_factory=dict)

    def where(self, *keys: object) -> str:
        """Name file and line of a key, or of the entry around it, as far as they are known."""
        depths = range(len(keys), 0, -1)
        line = next((self.lines[keys[:depth]] for depth in depths if keys[:depth] in self.lines), None)
        return ", ".join([part for part in (self.file, f"line {line}" if line else "") if part])


@dataclass(frozen=True)
class Place:
    """Where a value stands in a file.

    Parameters
    ----------
    source : Source
        File and line numbers.
    keys : tuple of str
        Keys from the outermost inwards.
    """

    source: Source
    keys: tuple[str, ...] = ()

    def inside(self, *keys: str) -> Place:
        """The place of a value further in."""
        return Place(self.source, self.keys + keys)

    @property
    def key(self) -> str:
        """The keys as messages write them: `loads.hub.force`."""
        return ".".join(self.keys)

    @property
    def where(self) -> str:
        """File, line and key: `case.yaml, line 7, loads.hub.force`."""
        return ", ".join(part for part in (self.source.where(*self.keys), self.key) if part)

    def problem(self, what: str, allowed: str = "", remedy: str = "") -> InputError:
        """An error that stands here."""
        return InputError(what, where=self.where, allowed=allowed, remedy=remedy)

    def blamed(self, problem: InputError) -> InputError:
        """The same error, raised by what read the value, with this place in front."""
        # What was given the value without its file can name the key only.
        inner = "" if problem.where == self.key else problem.where
        what = f"{inner}: {problem.what}" if inner else problem.what
        return self.problem(what, problem.allowed, problem.remedy)


def read_text(path: Path, noun: str, remedy: str) -> str:
    """Text of a file of the user's.

    Parameters
    ----------
    path : Path
    noun : str
        What it is, for messages: "case file".
    remedy : str
        What to do about one that cannot be read.

    Raises
    ------
    InputError
        If it is no file, cannot be read, or is not UTF-8.
    """
    try:
        return path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        raise InputError(f"the {noun} is not UTF-8 text", where=str(path), remedy="Save it as UTF-8.") from None
    except (OSError, ValueError) as error:  # a zero byte in a path is a ValueError
        reason = getattr(error, "strerror", None) or error
        raise InputError(f"the {noun} cannot be read ({reason})", where=str(path), remedy=remedy) from None


def parse(
    text: str, file: str, remedy: str = "Start from one of the shipped catalogue files."
) -> tuple[dict[Any, Any], Source]:
    """Parse the text of a catalogue or case file.

    Parameters
    ----------
    text : str
        YAML text: one mapping.
    file : str
        Name of the file, for messages.
    remedy : str
        What to do about a file that is not a mapping.

    Returns
    -------
    tuple[dict, Source]
        Plain Python data and the line of every key.

    Raises
    ------
    InputError
        If the text is not YAML, a key stands twice, or the file is not one mapping.
    """
    try:
        data = YAML(typ="rt", pure=True).load(text)
    except MarkedYAMLError as error:
        line = f", line {error.problem_mark.line + 1}" if error.problem_mark else ""
        if isinstance(error, DuplicateKeyError):
            raise InputError(
                str(error.problem).split(" with value ")[0],
                where=file + line,
                allowed="every key once",
                remedy="Delete one of the two.",
            ) from None
        problem = " ".join(str(part) for part in (error.context, error.problem) if part)
        raise _not_yaml(problem, file + line) from None
    except (YAMLError, ValueError) as error:  # forbidden characters; dates that do not exist
        raise _not_yaml(str(error).split("\n")[0], file) from None
    if not isinstance(data, CommentedMap):
        raise InputError(
            f"the file holds {'nothing' if data is None else shown(data)}",
            where=file,
            allowed="a mapping of keys to entries",
            remedy=remedy,
        )
    return _plain(data), Source(file, dict(_lines(data)))


def _not_yaml(problem: str, where: str) -> InputError:
    return InputError(
        f"this is not valid YAML ({problem})", where=where, remedy="Correct the text at or before this place."
    )


def _lines(mapping: CommentedMap, outer: tuple[object, ...] = ()) -> Iterator[tuple[tuple[object, ...], int]]:
    """Yield keys with their lines; a key merged in from an anchor has none and falls back to the entry around it."""
    for key in mapping.lc.data or {}:
        yield (*outer, key), mapping.lc.key(key)[0] + 1
    for key, entry in mapping.items():
        if isinstance(entry, CommentedMap):
            yield from _lines(entry, (*outer, key))


def _plain(value: Any) -> Any:
    """Strip the parser's own types, which remember how they were written."""
    if isinstance(value, CommentedMap):
        return {key: _plain(entry) for key, entry in value.items()}
    if isinstance(value, CommentedSeq):
        return [_plain(entry) for entry in value]
    for kind in (bool, int, float, str):
        if isinstance(value, kind):
            return kind(value)
    return value
