"""Key of a stored result: a hash of everything it depends on."""

from __future__ import annotations

import hashlib
import json
from typing import TYPE_CHECKING, Any

from macroslip import compiled
from macroslip.fingerprint import KERNEL_PARTS, RESULT_PARTS, fingerprint

if TYPE_CHECKING:
    from macroslip.case.case import Case

#: Modules of this folder whose code is stored in results.
_STORED_PARTS = ("study/cycles", "study/rating_values", "study/summary")


def program() -> str:
    """Hash of the program as far as results depend on it: its sources and those of registered laws of the user's own.

    Returns
    -------
    str
        64 hexadecimal digits.
    """
    laws = compiled.own_laws()
    return hashlib.sha256(
        "\0".join([fingerprint(*KERNEL_PARTS, *RESULT_PARTS, *_STORED_PARTS), *laws]).encode()
    ).hexdigest()


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
