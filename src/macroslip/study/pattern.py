"""Names of load files with fields in them: `runs/{wind_speed:g}mps_seed{seed:d}.outb`."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from macroslip.errors import InputError

_KINDS: dict[str, tuple[str, Callable[[str], object]]] = {
    "d": (r"[+-]?\d+", int),
    "g": (r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?", float),
    "": (r"[^/]+?", str),
}
_FIELD = re.compile(r"\{([A-Za-z_][A-Za-z0-9_]*)(?::([^{}]*))?\}")
_WILDCARDS = {"**/": r"(?:[^/]+/)*", "*": r"[^/]*", "?": r"[^/]"}
_PIECES = re.compile(r"\*\*/|\*|\?|\{[^{}]*\}|[^*?{]+|\{")


@dataclass(frozen=True)
class Pattern:
    """A path with fields and wildcards, to find files by and to read values from their names.

    Parameters
    ----------
    text : str
        Fields are `{name}` (text without slash), `{name:d}` (whole number) and `{name:g}` (number); wildcards are `*`,
        `?` and `**/`. A field that occurs twice must have the same value in both places.

    Raises
    ------
    InputError
        If a field has another form.

    Examples
    --------
    >>> Pattern("{wind_speed:g}mps_seed{seed:d}.outb").fields_of("11.4mps_seed03.outb")
    {'wind_speed': 11.4, 'seed': 3}
    """

    text: str

    def __post_init__(self) -> None:
        object.__setattr__(self, "text", PurePosixPath(self.text).as_posix())
        for piece in _PIECES.findall(self.text):
            match = _FIELD.fullmatch(piece)
            if piece.startswith("{") and (match is None or (match[2] or "") not in _KINDS):
                raise InputError(
                    f"'{piece}' in the pattern '{self.text}' is no field",
                    allowed="{name} for text, {name:d} for a whole number, {name:g} for a number",
                )

    @property
    def names(self) -> list[str]:
        """Names of the fields, in order."""
        return list(dict.fromkeys(match[1] for match in _FIELD.finditer(self.text)))

    def fields_of(self, path: str) -> dict[str, object] | None:
        """Values of the fields in a path with forward slashes; None if it does not fit."""
        expression, kinds = "", {}
        for piece in _PIECES.findall(self.text):
            match = _FIELD.fullmatch(piece)
            if match is None:
                expression += _WILDCARDS[piece] if piece in _WILDCARDS else re.escape(piece)
            elif match[1] in kinds:
                expression += f"(?P={match[1]})"
            else:
                form, kinds[match[1]] = _KINDS[match[2] or ""]
                expression += f"(?P<{match[1]}>{form})"
        found = re.fullmatch(expression, path)
        return None if found is None else {name: kind(found[name]) for name, kind in kinds.items()}

    def files(self, folder: Path) -> tuple[list[tuple[str, dict[str, object]]], list[str]]:
        """Find the files of a folder.

        Parameters
        ----------
        folder : Path
            Where a relative pattern starts.

        Returns
        -------
        list of (path, fields)
            Sorted by path; relative if the pattern is.
        list of str
            Files that the wildcards find but whose fields cannot be read, as `{seed:d}` from a name with `seedA`.

        Raises
        ------
        InputError
            If the pattern names a folder.
        """
        pieces = (piece if piece in _WILDCARDS else piece.replace("[", "[[]") for piece in _PIECES.findall(self.text))
        pure = PurePosixPath(_FIELD.sub("*", "".join(pieces)))
        start = Path(pure.anchor) if pure.is_absolute() else folder
        base = Path(pure.anchor) if pure.is_absolute() else Path()
        parts = [part for part in pure.parts if part != pure.anchor]
        if not parts or (start / pure).is_dir():
            raise InputError(
                f"'{self.text}' is a folder",
                allowed="the path of load files, with fields and wildcards",
                remedy="Name the files in it: runs/*.outb, for example.",
            )
        # The part before the first wildcard is a plain folder, which may lead upwards ("../runs").
        while len(parts) > 1 and not re.search(r"[*?\[]", parts[0]):
            base, start = base / parts[0], start / parts[0]
            parts = parts[1:]
        found = sorted(
            (base / path.relative_to(start)).as_posix() for path in start.glob("/".join(parts)) if path.is_file()
        )
        read = [(name, self.fields_of(name)) for name in found]
        return (
            [(name, fields) for name, fields in read if fields is not None],
            [name for name, fields in read if fields is None],
        )
