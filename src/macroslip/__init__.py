"""macroslip: slip, friction power and frictional energy of every roller of a wind-turbine main bearing.

The public names are imported when they are first used, so that `import macroslip` is quick.
"""

from importlib import import_module
from typing import Any

__version__ = "0.1.0"

_HOMES = {
    "Bearing": "macroslip.bearing",
    "Lubricant": "macroslip.lubricant",
    "HubLoads": "macroslip.loads",
    "BearingLoads": "macroslip.loads",
    "Drivetrain": "macroslip.loads",
    "main_bearing_load": "macroslip.loads",
    "bundled_cases": "macroslip.loads",
    "Laws": "macroslip.laws",
    "load_laws": "macroslip.law_file",
    "Case": "macroslip.study.case",
    "Radau": "macroslip.study.case",
    "ExplicitEuler": "macroslip.study.case",
    "BackwardEuler": "macroslip.study.case",
    "Window": "macroslip.study.case",
    "Traces": "macroslip.study.case",
    "simulate": "macroslip.study.simulate",
    "read_study": "macroslip.campaign.study_file",
    "run_campaign": "macroslip.campaign.run",
    "open_study": "macroslip.campaign.reader",
    "InputError": "macroslip.errors",
    "MacroslipError": "macroslip.errors",
}
_ROOMS = ("film", "traction", "hertz")

__all__ = ["__version__", *_HOMES, *_ROOMS]


def __getattr__(name: str) -> Any:
    if name in _HOMES:
        value = getattr(import_module(_HOMES[name]), name)
    elif name in _ROOMS:
        value = import_module("macroslip.contact.hertz" if name == "hertz" else f"macroslip.{name}")
    else:
        raise AttributeError(f"module 'macroslip' has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
