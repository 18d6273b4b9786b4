"""The machine on which numbers were measured, without anything that identifies its owner."""

from __future__ import annotations

import importlib.metadata
import os
import platform
from pathlib import Path

_PACKAGES = ("macroslip", "numba", "llvmlite", "numpy", "scipy", "numbalsoda", "scikit-sundae")


def machine() -> dict[str, str | int | None]:
    """Processor, number of usable cores, system, and versions of Python and of what takes part; None: not installed."""
    return {
        "processor": _processor(),
        "cores": usable_processors(),
        "system": f"{platform.system()} {platform.machine()}",
        "python": platform.python_version(),
        **{name: _version(name) for name in _PACKAGES},
    }


def usable_processors() -> int:
    """Processors this process may use; those of the machine where the system does not report it."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor()
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor()


def _version(name: str) -> str | None:
    try:
        return importlib.metadata.version(name)
    except importlib.metadata.PackageNotFoundError:
        return None
