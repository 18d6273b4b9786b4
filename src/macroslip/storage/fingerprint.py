"""Hash of the program's sources, under which compiled kernels, tables and stored results are filed.

What outlives the sources it came from would be a wrong number without a sign.
"""

from __future__ import annotations

import functools
import hashlib
from pathlib import Path

_ROOT = Path(__file__).parents[1]


@functools.cache
def fingerprint() -> str:
    """Hash of the package's sources and tables by name and content: 64 hexadecimal digits."""
    digest = hashlib.sha256()
    for path in sorted([*_ROOT.rglob("*.py"), *_ROOT.rglob("*.csv")]):
        name = path.relative_to(_ROOT).as_posix().encode()
        digest.update(name + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()
