"""What a result is filed under: a hash of everything it depends on."""

from __future__ import annotations

import functools
import hashlib
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import macroslip
from macroslip import compiled

if TYPE_CHECKING:
    from macroslip.study.case import Case

#: Rooms whose code no result depends on, and the modules of this one whose code is stored in results.
_WITHOUT_INFLUENCE = ("bench", "campaign", "cli", "report")
_WITH_INFLUENCE = ("campaign/cycles.py", "campaign/summary.py")


@functools.cache
def _sources() -> str:
    """Hash of the sources that results depend on."""
    digest = hashlib.sha256()
    root = Path(macroslip.__file__).parent
    for path in sorted(root.rglob("*.py")):
        name = path.relative_to(root).as_posix()
        if name.partition("/")[0] not in _WITHOUT_INFLUENCE or name in _WITH_INFLUENCE:
            digest.update(name.encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()


def program() -> str:
    """Hash of the program as far as results depend on it: its sources and those of registered laws of the user's own.

    Returns
    -------
    str
        64 hexadecimal digits.
    """
    laws = sorted(compiled._extra_sources)
    return hashlib.sha256("\0".join([_sources(), *laws]).encode()).hexdigest()


def case_key(case: Case, options: dict[str, Any]) -> str:
    """Hash of the full input of a case, of the program, and of what is stored beyond the result of `simulate`.

    Where the loads come from does not enter, only their numbers: a file may be moved, renamed or converted.

    Parameters
    ----------
    case : Case
    options : dict
        What is stored beyond the result; plain data.

    Returns
    -------
    str
        64 hexadecimal digits.

    Examples
    --------
    >>> from macroslip import BearingLoads, Case
    >>> loads = BearingLoads.constant([0.0, -300e3, 0.0], 2.0, 10.0)
    >>> key = case_key(Case(loads=loads), {})
    >>> len(key), key == case_key(Case(loads=loads, drag=False), {})
    (64, False)
    """
    given = case.as_dict()
    loads = {name: value for name, value in given["loads"].items() if name != "source"}
    content = {"case": given | {"loads": loads}, "program": program(), "options": options}
    return hashlib.sha256(json.dumps(content, sort_keys=True, ensure_ascii=False).encode()).hexdigest()
