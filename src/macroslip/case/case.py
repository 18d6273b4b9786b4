"""A case: everything one simulation needs, validated once and frozen."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, field
from numbers import Integral, Real
from typing import Any

from macroslip.bearing import Bearing
from macroslip.case.parts import BackwardEuler, ExplicitEuler, Heat, Radau, Traces, Window
from macroslip.catalogue.problems import shown
from macroslip.errors import InputError
from macroslip.loads import BearingLoads, Drivetrain, HubLoads
from macroslip.loads.source_file import without_folders
from macroslip.lubricant import Lubricant
from macroslip.mechanisms import Laws
from macroslip.overview import html_overview
from macroslip.whole.cage import Cage

#: Whether orbits are imposed, or rollers and cages move together.
IMPOSED_ORBIT, WHOLE_BEARING = DYNAMICS = ("imposed-orbit", "whole-bearing")

#: The word for a temperature that follows from friction and the loss of heat.
BALANCE = "balance"


def _check(good: bool, what: str, where: str, allowed: str, remedy: str = "") -> None:
    if not good:
        raise InputError(what, where=where, allowed=allowed, remedy=remedy)


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """One simulation.

    Parameters
    ----------
    loads : HubLoads or BearingLoads
    bearing : Bearing
    lubricant : Lubricant
    temperature : float or "balance", optional
        Of the oil at the inlets of the contacts [K]; None: that for which the lubricant's values are given. "balance":
        the one at which friction power is what the bearing loses by `heat`.
    heat : Heat, optional
        Goes with "balance".
    drivetrain : Drivetrain
        Turns hub loads into main-bearing load; its tilt also directs the rollers' weight.
    gravity, drag : bool
        Whether weight and drag act on the rollers.
    laws : Laws
        Mechanisms in the contacts; the paper's by default, `Laws.physical()` for all of them.
    dynamics : "imposed-orbit" or "whole-bearing"
        Whether every roller turns on its own on an orbit of pure rolling, or all move together with the cage.
    cage : Cage
        For the whole bearing.
    integrator : Radau, ExplicitEuler or BackwardEuler
    window : Window
    rollers : "all" or sequence of int
        Numbers of the rollers to simulate in each row, from 0.
    traces : Traces, optional
    contact_details : bool
        Whether to record, of contacts with microslip or asperities, where on them energy goes, how hot and how densely
        (`macroslip.result.variables.CONTACT_DETAILS`). It takes up to a third of a simulation and changes nothing else.
    rating : bool
        Whether `macroslip run` and studies rate the bearing beside its slip; `simulate` never does.

    Raises
    ------
    InputError
        For a roller number that does not exist or a wrong choice.

    Examples
    --------
    >>> from macroslip import Case, HubLoads
    >>> case = Case(loads=HubLoads.bundled("14B"))
    >>> case.bearing.rollers_per_row, case.integrator.tolerance
    (28, 0.0002)
    """

    loads: HubLoads | BearingLoads
    bearing: Bearing = field(default_factory=lambda: Bearing.read("skf-240-600-bc"))
    lubricant: Lubricant = field(default_factory=lambda: Lubricant.read("vg460-pao"))
    temperature: float | str | None = None
    heat: Heat | None = None
    drivetrain: Drivetrain = field(default_factory=Drivetrain)
    gravity: bool = True
    drag: bool = True
    laws: Laws = field(default_factory=Laws.paper)
    dynamics: str = IMPOSED_ORBIT
    cage: Cage = field(default_factory=Cage)
    integrator: Radau | ExplicitEuler | BackwardEuler = field(default_factory=Radau)
    window: Window = field(default_factory=Window)
    rollers: str | Sequence[int] = "all"
    traces: Traces | None = None
    contact_details: bool = True
    rating: bool = True

    def __post_init__(self) -> None:
        for name, kinds in (
            ("loads", (HubLoads, BearingLoads)),
            ("bearing", (Bearing,)),
            ("lubricant", (Lubricant,)),
            ("drivetrain", (Drivetrain,)),
            ("gravity", (bool,)),
            ("drag", (bool,)),
            ("laws", (Laws,)),
            ("cage", (Cage,)),
            ("integrator", (Radau, ExplicitEuler, BackwardEuler)),
            ("window", (Window,)),
            ("contact_details", (bool,)),
            ("rating", (bool,)),
        ):
            value = getattr(self, name)
            allowed = " or ".join(kind.__name__ for kind in kinds)
            _check(isinstance(value, kinds), f"it is {type(value).__name__}", name, allowed)
        self._check_temperature()
        _check_dynamics(self)
        object.__setattr__(self, "rollers", _rollers(self.rollers, self.bearing.rollers_per_row))
        first, last = float(self.loads.time[0]), float(self.loads.time[-1])
        start = first if self.window.start is None else self.window.start
        end = last if self.window.end is None else self.window.end
        _check(
            first <= start < end <= last,
            f"the window runs from {start!r} s to {end!r} s",
            "window",
            f"start before end, both within the loads' {first:g} s to {last:g} s",
        )
        if self.traces is not None:
            start = first if self.traces.start is None else self.traces.start
            end = last if self.traces.end is None else self.traces.end
            _check(
                first <= start <= end <= last,
                f"the traces run from {start!r} s to {end!r} s",
                "traces",
                f"times within the loads' {first:g} s to {last:g} s",
            )

    def _check_temperature(self) -> None:
        given = self.temperature
        words = "a temperature [K], 'balance', or None for the lubricant's own"
        if isinstance(given, str):
            _check(given == BALANCE, f"it is {shown(given)}", "temperature", words)
            _check(
                isinstance(self.heat, Heat),
                "temperature is to balance, and the heat that the bearing loses is not given",
                "heat",
                "conductance to the surroundings and their temperature",
                "40 to 80 W/K is an estimate for the main bearing of a 2 MW turbine.",
            )
        elif given is not None:
            _check(
                isinstance(given, Real) and not isinstance(given, bool), f"it is {shown(given)}", "temperature", words
            )
            object.__setattr__(self, "temperature", float(given))
            self.lubricant.at(float(given))

    @property
    def oil(self) -> Lubricant:
        """The lubricant at the temperature of the inlets; every computation uses this one.

        Raises
        ------
        InputError
            If the temperature is still to be found.
        """
        if self.temperature is None:
            return self.lubricant
        _check(
            self.temperature != BALANCE,
            "the temperature is that of a balance of heat, which only a simulation finds",
            "temperature",
            "a temperature",
            "Give the temperature of the oil; inlet_temperature of a result has the one it found.",
        )
        return self.lubricant.at(self.temperature)

    @property
    def roller_numbers(self) -> tuple[int, ...]:
        """Numbers of the rollers to simulate in each row."""
        if isinstance(self.rollers, str):  # "all"
            return tuple(range(self.bearing.rollers_per_row))
        return tuple(self.rollers)

    def as_dict(self) -> dict[str, Any]:
        """The full input as plain data; of the load series its source, extent and a hash of all its numbers."""
        loads = self.loads
        digest = hashlib.sha256()
        for name in ("time", "shaft_speed", "force", "moment"):
            if hasattr(loads, name):
                digest.update(getattr(loads, name).tobytes())
        return {
            "loads": {
                "kind": type(loads).__name__,
                "source": without_folders(loads.source),
                "samples": int(loads.time.size),
                "start": float(loads.time[0]),
                "end": float(loads.time[-1]),
                "sha256": digest.hexdigest(),
            },
            "bearing": self.bearing.as_dict(),
            "lubricant": self.lubricant.as_dict(),
            "temperature": self.temperature,
            "heat": asdict(self.heat) if self.heat else None,
            "drivetrain": asdict(self.drivetrain),
            "forces": {"gravity": self.gravity, "drag": self.drag},
            "laws": {"model": self.laws.name, **asdict(self.laws)},
            **({"dynamics": self.dynamics, "cage": asdict(self.cage)} if self.dynamics == WHOLE_BEARING else {}),
            "integrator": {"method": type(self.integrator).__name__, **asdict(self.integrator)},
            "window": asdict(self.window),
            "rollers": self.rollers if self.rollers == "all" else list(self.rollers),
            "traces": asdict(self.traces) if self.traces else None,
            "contact_details": self.contact_details,
            "rating": self.rating,
        }

    def __repr__(self) -> str:
        return f"<Case: {', '.join(text for _, text in self._overview())}>"

    def _repr_html_(self) -> str:
        return html_overview("Case", ["", ""], self._overview())

    def _overview(self) -> list[tuple[str, str]]:
        """The main data, each in a few words."""
        loads, start, end = self.loads, self.window.start, self.window.end
        count = "all rollers" if self.rollers == "all" else f"{len(self.roller_numbers)} rollers of each row"
        opens = "after the first orbit" if start is None else f"at {start:g} s"
        return [
            ("loads", f"{loads.source}, {loads.time[0]:g} s to {loads.time[-1]:g} s"),
            ("bearing", self.bearing.name),
            ("lubricant", self.lubricant.name),
            ("laws", f"model {self.laws.name}"),
            ("integrator", type(self.integrator).__name__),
            ("window", f"window {opens} to {loads.time[-1] if end is None else end:g} s"),
            ("rollers", count),
            ("dynamics", self.dynamics),
            ("traces", "no traces" if self.traces is None else f"traces every {self.traces.step:g} s"),
        ]


def _check_dynamics(case: Case) -> None:
    """Refuse what the chosen dynamics cannot use."""
    _check(case.dynamics in DYNAMICS, f"'{case.dynamics}' does not exist", "dynamics", " or ".join(DYNAMICS))
    if case.dynamics == IMPOSED_ORBIT:
        _check(
            case.cage == Cage(), "a cage is described, but rollers on imposed orbits do not use it", "cage",
            "with dynamics: whole-bearing", "Set dynamics: whole-bearing, or remove the cage",
        )  # fmt: skip
        return
    integrator = case.integrator
    fixed = f"a fixed step of {getattr(integrator, 'step', 0.0):g} s"
    _check(
        isinstance(integrator, Radau),
        f"{fixed} cannot resolve the impacts of rollers on their cage, which take a tenth of a millisecond and begin at "
        "any time",
        "integrator",
        "an error-controlled integrator for dynamics: whole-bearing",
        "Choose integrator.method: radau; its tolerance serves the whole bearing too",
    )
    case.cage.check_fit(case.bearing)


def _rollers(given: str | Iterable[int], count: int) -> str | tuple[int, ...]:
    """Numbers of the rollers as plain integers: NumPy's are welcome."""
    if isinstance(given, str) and given == "all":
        return "all"
    numbers = () if isinstance(given, str) or not isinstance(given, Iterable) else tuple(given)
    whole = all(isinstance(number, Integral) and not isinstance(number, bool) for number in numbers)
    _check(
        whole and 0 < len(set(numbers)) == len(numbers) and min(numbers) >= 0 and max(numbers) < count,
        f"rollers is {shown(given)}",
        "rollers",
        f"all, or a list of different numbers from 0 to {count - 1}",
    )
    return tuple(int(number) for number in numbers)
