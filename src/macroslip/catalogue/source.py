"""Text of a catalogue or case file to plain data, with the line on which every key stands."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
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
