"""macroslip: slip and frictional energy of every roller of a wind-turbine main bearing.

The public names are imported when they are first used, so that `import macroslip` is quick.
"""

import os
from importlib import import_module
from typing import Any

__version__ = "0.2.0"

_HOMES = {
    "Bearing": "macroslip.bearing",
    "Lubricant": "macroslip.lubricant",
    "Turbine": "macroslip.turbine",
    "HubLoads": "macroslip.loads",
    "BearingLoads": "macroslip.loads",
    "RollerLoads": "macroslip.loads",
    "Drivetrain": "macroslip.loads",
    "main_bearing_load": "macroslip.loads",
    "support_loads": "macroslip.loads",
    "bundled_cases": "macroslip.loads",
    "Laws": "macroslip.contact.mechanisms",
    "load_laws": "macroslip.plugins",
    "register_film": "macroslip.contact.registry",
    "register_traction": "macroslip.contact.registry",
    "Case": "macroslip.case.case",
    "Cage": "macroslip.whole.cage",
    "Radau": "macroslip.case.parts",
    "ExplicitEuler": "macroslip.case.parts",
    "BackwardEuler": "macroslip.case.parts",
    "Heat": "macroslip.case.parts",
    "Window": "macroslip.case.parts",
    "Traces": "macroslip.case.parts",
    "read_case": "macroslip.case.case_file",
    "simulate": "macroslip.result.simulate",
    "progress_bar": "macroslip.progress",
    "open_result": "macroslip.report.accessor",
    "compare": "macroslip.report.comparison",
    "rate_case": "macroslip.result.rating",
    "read_study": "macroslip.study.study_file",
    "run_study": "macroslip.study.run",
    "open_study": "macroslip.study.reader",
    "Scada": "macroslip.scada",
    "histogram": "macroslip.scada",
    "real_year": "macroslip.study.real_year",
    "heat_fit": "macroslip.study.heat",
    "InputError": "macroslip.errors",
    "MacroslipError": "macroslip.errors",
}
_FOLDERS = ("film", "traction", "hertz")

# With what is no number of threads above 0, as some containers set it, numba cannot be imported or
# warns with a traceback; its threads are not used here.
_threads = os.environ.get("NUMBA_NUM_THREADS", "1").strip()
if not _threads.isdecimal() or int(_threads) < 1:
    del os.environ["NUMBA_NUM_THREADS"]

__all__ = ["__version__", *_HOMES, *_FOLDERS]  # pyright: ignore[reportUnsupportedDunderAll]


def __getattr__(name: str) -> Any:
    if name == "simulate":
        import_module("macroslip.report.accessor")  # gives results their `result.macroslip.plot`
    if name in _HOMES:
        value = getattr(import_module(_HOMES[name]), name)
    elif name in _FOLDERS:
        value = import_module(f"macroslip.contact.{name}")
    else:
        raise AttributeError(f"module 'macroslip' has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
