"""The machine on which numbers were measured, and its processes of Python.

Nothing identifies its owner.
"""

from __future__ import annotations

import importlib.metadata
import os
import platform
import sys
from collections.abc import Iterable
from pathlib import Path

_PACKAGES = ("macroslip", "numba", "llvmlite", "numpy", "scipy", "numbalsoda", "scikit-sundae")


def machine() -> dict[str, str | int | None]:
    """Processor, usable cores, system, and versions of Python and of the libraries.

    None stands for a package that is not installed.
    """
    return {
        "processor": _processor(),
        "cores": usable_processors(),
        "system": f"{platform.system()} {platform.machine()}",
        "python": platform.python_version(),
        **{name: version_of(name) for name in _PACKAGES},
    }


def usable_processors() -> int:
    """Processors this process may use; all of the machine where the system does not report it."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def safe_path(entries: Iterable[str]) -> list[str]:
    """Entries of a path of modules without the current folder, under whatever name.

    Whoever sent a case file may have sent a `numba.py` beside it.
    """

    def is_here(entry: str) -> bool:
        try:
            return not entry or os.path.samefile(entry, os.curdir)
        except OSError:  # one of the two does not exist
            return False

    return [path for path in entries if not is_here(path)]


def process_environment() -> dict[str, str]:
    """Environment for a process of Python that is started.

    It finds the modules of this one, none in the current folder.
    """
    entries = os.environ.get("PYTHONPATH", "").split(os.pathsep)
    modules = dict.fromkeys(safe_path([*entries, *sys.path]))
    return os.environ | {"PYTHONSAFEPATH": "1", "PYTHONPATH": os.pathsep.join(modules)}


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor()
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor()


def version_of(name: str) -> str | None:
    """Installed version of a package; None where it is not."""
    try:
        return importlib.metadata.version(name)
    except importlib.metadata.PackageNotFoundError:
        return None
