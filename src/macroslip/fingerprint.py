"""Fingerprints of the program: which sources compiled kernels and stored results depend on.

A kernel or a result that outlives the sources it came from would be a wrong number without a sign. What is stored is
therefore filed under a hash of these sources. The lists here are the only ones; every part of the package is in one.
"""

from __future__ import annotations

import functools
import hashlib
from pathlib import Path

#: Parts of the package from which kernels are compiled.
KERNEL_PARTS = (
    "compiled", "constants", "contact", "imposed", "lubricant", "measures", "ring", "roller", "whole",
)  # fmt: skip
#: Parts on which the result of a case depends beside those.
RESULT_PARTS = ("bearing", "case", "input", "loads", "rating", "result")
#: Parts that use results, or only words, and change no result.
OTHER_PARTS = (
    "__init__", "cli", "damage", "errors", "files", "fingerprint", "hdf5_file", "kernel_cache", "machine", "overview", "plugins", "progress",
    "report", "study", "torque",
)  # fmt: skip
_ROOT = Path(__file__).parent


def sources_of(*parts: str) -> list[Path]:
    """Source files of parts of the package, and the tables that go with them, sorted.

    Parts are folders or modules at the top of the package, or single modules of a folder: `study/cycles`. Raises
    FileNotFoundError for a part that does not exist.
    """
    found: list[Path] = []
    for part in parts:
        folder, module = _ROOT / part, _ROOT / f"{part}.py"
        if not folder.is_dir() and not module.is_file():
            raise FileNotFoundError(f"macroslip has no part {part!r}")
        found += [*folder.rglob("*.py"), *folder.rglob("*.csv")] if folder.is_dir() else [module]
    return sorted(found)


@functools.cache
def fingerprint(*parts: str) -> str:
    """Hash of the names and contents of the sources of parts of the package, 64 hexadecimal digits.

    Examples
    --------
    >>> fingerprint("constants") == fingerprint("constants"), fingerprint("constants") == fingerprint("errors")
    (True, False)
    """
    digest = hashlib.sha256()
    for path in sources_of(*parts):
        digest.update(
            path.relative_to(_ROOT).as_posix().encode() + b"\0" + path.read_bytes() + b"\0"
        )
    return digest.hexdigest()
