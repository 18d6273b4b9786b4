"""Laws of one's own from a Python file.

The user names it on the command line or in a program, never in a data file.
"""

from __future__ import annotations

import hashlib
import importlib.util
import sys
import traceback
from importlib.machinery import SourceFileLoader
from os import PathLike
from pathlib import Path
from types import CodeType
from typing import NamedTuple

from macroslip.errors import InputError, on_one_line
from macroslip.storage.files import check_regular

_ALLOWED = (
    "a Python file that registers film or traction laws, as macroslip init --example laws writes"
)


class OwnLaws(NamedTuple):
    """Names of the laws a file has registered: names for `laws.film` and `laws.traction`."""

    film: tuple[str, ...]
    traction: tuple[str, ...]


_loaded: dict[str, OwnLaws] = {}


def load_laws(path: str | PathLike[str]) -> OwnLaws:
    """Run a Python file that registers film or traction laws, so that their names can be used.

    The file is imported as a module whose name follows from its own name and its content, so that
    tables made of its laws are found again on the disk, by every process and wherever the file
    lies. To load the same file again does nothing.

    Parameters
    ----------
    path : path
        The file. It is a program: load only files you would run.

    Raises
    ------
    InputError
        If the file cannot be read, an error occurs in it (with its line), it registers no law, or
        it registers a name that is taken. Then none of its laws is registered.

    Examples
    --------
    >>> load_laws("my_laws.py")
    Traceback (most recent call last):
        ...
    macroslip.errors.InputError: my_laws.py: the file cannot be read (No such file or directory). \
Allowed: a Python file that registers film or traction laws, as macroslip init --example laws \
writes. Check its path, which starts at the current folder.
    """
    from macroslip.contact.registry import FILM_LAWS, TRACTION_LAWS

    path = Path(path)
    check_regular(path, "Name a Python file.")
    try:
        text = path.read_bytes()
    except OSError as error:
        fault = f"the file cannot be read ({error.strerror})"
        remedy = "Check its path, which starts at the current folder."
        raise InputError(fault, where=str(path), allowed=_ALLOWED, remedy=remedy) from None
    name = f"macroslip_laws_{path.stem}_{hashlib.sha256(text).hexdigest()[:12]}"
    if name in _loaded:
        return _loaded[name]
    kinds = FILM_LAWS, TRACTION_LAWS
    before = [set(kind.names()) for kind in kinds]

    def added() -> OwnLaws:
        names = [set(kind.names()) - old for kind, old in zip(kinds, before, strict=True)]
        films, tractions = (tuple(sorted(of_kind)) for of_kind in names)
        return OwnLaws(films, tractions)

    try:
        _import(path, name)
        if not any(added()):
            remedy = "Call macroslip.register_film or macroslip.register_traction in it."
            raise InputError(
                "the file registers no law", where=str(path), allowed=_ALLOWED, remedy=remedy
            )
    except BaseException:
        sys.modules.pop(name, None)
        for kind, names in zip(kinds, added(), strict=True):
            for registered in names:
                kind.remove(registered)
        raise
    _loaded[name] = added()
    return _loaded[name]


class _SourceOnly(SourceFileLoader):
    """Import without stored bytecode.

    Python takes it for a file's as long as its size and the second of its change agree.
    """

    def get_code(self, fullname: str) -> CodeType:
        return self.source_to_code(self.get_data(self.path), self.path)


def _import(path: Path, name: str) -> None:
    """Run the file as a module; what goes wrong in it is reported with its line."""
    loader = _SourceOnly(name, str(path.resolve()))
    spec = importlib.util.spec_from_file_location(name, path.resolve(), loader=loader)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # where classes in the file look themselves up
    try:
        loader.exec_module(module)
    except InputError as problem:
        where = ", ".join(part for part in (_where(path, problem), problem.where) if part)
        raise problem.but(where=where) from None
    except (Exception, SystemExit) as error:
        reason = error.msg if isinstance(error, SyntaxError) else on_one_line(error)
        fault = f"{type(error).__name__} while its laws were read{f' ({reason})' if reason else ''}"
        remedy = f"Mend it; python {path} shows where the error comes from."
        raise InputError(fault, where=_where(path, error), remedy=remedy) from None


def _where(path: Path, error: BaseException) -> str:
    own = str(path.resolve())
    if isinstance(error, SyntaxError) and error.filename == own:
        return f"{path}, line {error.lineno}"
    lines = [
        frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == own
    ]
    return f"{path}, line {lines[-1]}" if lines else str(path)
