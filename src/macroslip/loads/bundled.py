"""The load cases that come with the package: names, files, and their conditions."""

from __future__ import annotations

import importlib.resources
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from macroslip.errors import InputError

SETS = ("paper", "year", "nrel5")
#: Turbines that the cases were simulated for, by the first letters of their records.
TURBINES = {"windpact1.5": "WindPACT 1.5 MW baseline", "nrel5": "NREL 5 MW reference turbine"}
#: Transients and other states; start-up, stops, idling and the like need a supervisor, which the
#: turbine's model lacks.
EVENTS = (
    "start-8", "start-14", "stop-14", "stop-24", "estop-20", "gridloss-14", "idle-6", "idle-25",
    "parked-12", "eog-14", "ecd-14", "yaw20-14",
)  # fmt: skip
ASSUMED = "its supervisor is assumed"


@dataclass(frozen=True)
class BundledCase:
    """Description of a bundled case."""

    name: str
    wind_speed: float  #: Nominal mean wind speed [m/s]
    turbulence: str  #: IEC turbulence class; "-" where the wind has none
    seed: int = 1  #: 1, or 2 for a second realisation
    event: str = ""  #: Its name if it is an event
    turbine: str = "windpact1.5"  #: Key of `TURBINES`

    @property
    def source(self) -> str:
        """Source of its loads; for an event also that its supervisor is assumed."""
        about = f"bundled case {self.name}"
        if self.event:
            about += f" (event, {ASSUMED})"
        return about

    @property
    def path(self) -> Path:
        """The file."""
        return Path(
            str(importlib.resources.files("macroslip.loads") / "cases" / f"{self.name}.parquet")
        )


def _turbulent(speeds: range, classes: str) -> list[BundledCase]:
    """Cases of production at mean wind speeds [m/s] in classes of turbulence."""
    return [
        BundledCase(f"{speed}{letter}", float(speed), letter)
        for speed in speeds
        for letter in classes
    ]


def _year() -> list[BundledCase]:
    """All cases, those of the paper first."""
    second = [BundledCase(f"{speed}B-2", float(speed), "B", 2) for speed in (8, 10, 12, 16, 24)]
    events = []
    for name in EVENTS:
        _, _, speed = name.rpartition("-")
        turbulence = "-" if name[:3] in ("eog", "ecd") else "B"
        events.append(BundledCase(name, float(speed), turbulence, event=name))
    above_rated = _turbulent(range(12, 25, 2), "ABC")
    below_rated = _turbulent(range(4, 11, 2), "AB")
    production = above_rated + below_rated
    return production + second + events


def _nrel5() -> list[BundledCase]:
    """Cases of the NREL 5 MW turbine: class B at all winds, class A and second seeds at some."""
    production = [*_turbulent(range(4, 25, 2), "B"), *_turbulent(range(12, 19, 6), "A")]
    second = [BundledCase(f"{speed}B-2", float(speed), "B", 2) for speed in (8, 12, 18)]
    cases = []
    for case in production + second:
        cases.append(replace(case, name=f"nrel5-{case.name}", turbine="nrel5"))
    return cases


_CASES = {case.name: case for case in [*_year(), *_nrel5()]}


def bundled_cases(which: str = "paper") -> list[str]:
    """Names of the load cases that come with the package.

    Parameters
    ----------
    which : str
        "paper": the 21 of the paper, by mean wind speed [m/s] and IEC turbulence class. "year": all
        of the WindPACT 1.5 MW turbine, also winds below rated, second seeds ("12B-2") and events
        ("start-8"), whose supervisor is assumed. "nrel5": those of the NREL 5 MW turbine, 4 to
        24 m/s, with second seeds.

    Returns
    -------
    list of str
        Names for `HubLoads.bundled`.

    Raises
    ------
    InputError
        If there is no such set.

    Examples
    --------
    >>> bundled_cases()[:4], [len(bundled_cases(name)) for name in ("paper", "year", "nrel5")]
    (['12A', '12B', '12C', '14A'], [21, 46, 16])
    """
    if which not in SETS:
        raise InputError(f"there is no set of bundled cases {which!r}", allowed=", ".join(SETS))
    if which == "paper":
        return list(_CASES)[:21]
    turbine = "nrel5" if which == "nrel5" else "windpact1.5"
    return [name for name, case in _CASES.items() if case.turbine == turbine]


def bundled_names() -> list[str]:
    """Names of all load cases that come with the package, of both turbines."""
    return list(_CASES)


def bundled_case(name: str) -> BundledCase:
    """The bundled case of a name."""
    if name not in _CASES:
        raise InputError(
            f"there is no bundled case {name!r}",
            allowed=", ".join(_CASES),
            remedy="Use HubLoads.read for a file of your own.",
        )
    return _CASES[name]


def bundled_labels(names: Sequence[str]) -> list[dict[str, float | str]]:
    """Labels of bundled cases in a study: wind speed and turbulence.

    With seed and event where a case is not one of the paper. Raises InputError for cases of two
    turbines: one bearing on one mount has the loads of one turbine.
    """
    cases = [bundled_case(name) for name in names]
    first_of = {case.turbine: case.name for case in reversed(cases)}
    if len(first_of) > 1:
        raise InputError(
            f"the bundled cases {' and '.join(sorted(first_of.values()))} are of two turbines",
            allowed="cases of one turbine, whose bearing and mount a study has",
            remedy="Write a study for each turbine.",
        )
    labels = ["wind_speed", "turbulence"]
    if not set(names).issubset(bundled_cases()):
        labels += ["seed", "event"]
    labels_of_cases = []
    for case in cases:
        labels_of_cases.append({label: getattr(case, label) for label in labels})
    return labels_of_cases
