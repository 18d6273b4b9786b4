"""Kernels for a first run that another process compiles, while this one compiles the rest.

Compiling is numba's own Python for the most part, which threads of one process cannot share. What the other process has
compiled is read from the folder where kernels are stored; if it fails, or nothing can be stored, this process compiles all.
"""

from __future__ import annotations

import atexit
import contextlib
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

from macroslip.compiled import own_laws
from macroslip.kernel_cache import kernel_folder
from macroslip.machine import process_environment, usable_processors

#: A kernel that is compiled ahead by its name, and one that only the physical model needs.
_INTEGRATOR, _PHYSICAL = "integrate_radau", "raceway_values"
#: Time between two looks at whether a kernel is stored [s].
_PAUSE = 0.05

_running: subprocess.Popen | None = None


def compile_ahead(*, physical: bool) -> None:
    """Start to compile in another process what is not stored of the integrator, and of the physical model.

    For programs that have this process to themselves, as the commands have.

    Parameters
    ----------
    physical : bool
        Whether contacts with microslip will be needed.
    """
    global _running
    folder = kernel_folder()
    physical = physical and not own_laws()
    if folder is None or _running is not None or usable_processors() < 2:
        return
    if _is_stored(folder, _INTEGRATOR) and (_is_stored(folder, _PHYSICAL) or not physical):
        return
    with contextlib.suppress(OSError):
        _running = subprocess.Popen(
            [sys.executable, "-m", __name__, *(["physical"] if physical else [])],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            env=process_environment(),
        )
        atexit.register(_stop)


def wait_for_integrator() -> None:
    """Wait until the integrator is compiled, if another process is at it."""
    folder = kernel_folder()
    while _running is not None and _running.poll() is None and folder and not _is_stored(folder, _INTEGRATOR):
        time.sleep(_PAUSE)


def wait_for_all() -> None:
    """Wait until the other process, if there is one, has compiled all it was asked for."""
    global _running
    if _running is not None:
        _running.wait()
        _running = None


def _is_stored(folder: Path, name: str) -> bool:
    return any(folder.rglob(f"*.{name}-*.nbi"))


def _stop() -> None:
    if _running is not None and _running.poll() is None:
        _running.kill()
        _running.wait()


def integrator_arguments() -> tuple[Any, ...]:
    """Arguments of `integrate_radau` of the types it always has, of no other meaning."""
    import numpy as np

    from macroslip.integrate.load_zone import empty_classes
    from macroslip.integrate.path import Limits, Path
    from macroslip.integrate.record import new_record
    from macroslip.integrate.sealed import Entries, SealedModel
    from macroslip.ring.orbit import Motion
    from macroslip.roller.friction_power import PowerRule

    nothing = np.zeros(2)
    numbers = dict.fromkeys(SealedModel._fields, 0.0) | dict.fromkeys(
        ("microslip", "curved", "detailed", "lanes"), False
    )
    rule = PowerRule(False, 0.0, 0.0)
    roller = SealedModel(
        **numbers
        | {
            "inner_power": rule,
            "outer_power": rule,
            "data": np.zeros(1, dtype=np.uint8),
            "entries": Entries(*[0] * len(Entries._fields)),
        }
    )
    motion = Motion(nothing, nothing, nothing, np.zeros((2, 3)))
    limits = Limits(0.0, 0, 0.0, 0.0, 0.0, 0.0, 0.0, np.zeros(1, dtype=np.int8))
    return Path(roller, motion, 0.0, limits), 0.0, nothing, empty_classes(2), new_record(nothing, nothing, 0.0)


def _compile(*, physical: bool) -> None:
    from numba import typeof

    from macroslip.integrate.radau import integrate_radau

    integrate_radau.compile(tuple(map(typeof, integrator_arguments())))
    if physical:
        from macroslip.bearing import Bearing
        from macroslip.integrate.entries import AHEAD, compiled_entry
        from macroslip.lubricant import Lubricant
        from macroslip.mechanisms import Laws
        from macroslip.roller.model import roller_model

        model = roller_model(
            Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao"), 1, tilt=0.0, laws=Laws.physical()
        )
        for name in AHEAD:
            compiled_entry(typeof(model), name)


if __name__ == "__main__":
    _compile(physical="physical" in sys.argv)
