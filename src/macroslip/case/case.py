"""A case: everything one simulation needs, validated once and frozen.

Its fields are the keys of a case file.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field, replace
from numbers import Integral
from typing import Annotated, Any

import numpy as np

from macroslip.bearing import Bearing
from macroslip.bearing.kinds import BEARING_KINDS, AnyBearing
from macroslip.case.load_source import LoadSource
from macroslip.case.oil_supply import OilSupply, check_supply, inlet_supply, oil_gap
from macroslip.case.parts import (
    DYNAMICS,
    INTEGRATORS,
    BackwardEuler,
    ExplicitEuler,
    Heat,
    Radau,
    Traces,
    Window,
)
from macroslip.constants import BALANCE, IMPOSED_ORBIT, TIME_ROUNDING, WHOLE_BEARING
from macroslip.contact.mechanisms import PRESETS, Laws
from macroslip.errors import InputError
from macroslip.input.fields import Choice, Context, Flag, Form, Quantity, Text
from macroslip.input.files import Location, Source
from macroslip.input.messages import shown, together
from macroslip.input.section import Made, OrWord, Variants, form_from, input_section
from macroslip.input.stored import Stored, stored
from macroslip.input.units import TEMPERATURE, TEMPERATURE_DIFFERENCE
from macroslip.kinds import kind_of
from macroslip.loads import BearingLoads, Drivetrain, HubLoads, RollerLoads, main_bearing_load
from macroslip.loads.moment_bearing import shaft_load
from macroslip.loads.source_file import without_folders
from macroslip.lubricant import Lubricant
from macroslip.overview import html_overview
from macroslip.whole.cage import SKEW_KEYS, Cage

#: Sections that only files have: meaning and fields.
_GROUPS = {"forces": ("forces on the rollers that can be switched off", ("gravity", "drag"))}


@dataclass(frozen=True)
class RollerNumbers(Form):
    """A list of whole numbers, or all; whether a number exists is checked with the bearing."""

    form = "all, or a list of whole numbers such as [0, 7]"

    def read(self, value: Any, context: Context) -> str | tuple[int, ...]:
        """Check that each is a whole number; NumPy's are welcome."""
        if isinstance(value, str) and value == "all":
            return "all"
        is_no_list = isinstance(value, str | bytes | Mapping | Set)
        is_list = isinstance(value, Iterable) and not is_no_list
        numbers = tuple(value) if is_list else ()
        are_whole = all(
            isinstance(item, Integral) and not isinstance(item, bool) for item in numbers
        )
        if not numbers or not are_whole:
            raise self.wrong(value)
        return tuple(int(number) for number in numbers)

    def json(self) -> dict[str, Any]:
        """A list of integers, or the word."""
        numbers = {
            "type": "array",
            "items": {"type": "integer", "minimum": 0},
            "minItems": 1,
            "uniqueItems": True,
        }
        return {"anyOf": [{"const": "all"}, numbers]}


@dataclass(frozen=True)
class InletTemperature(Quantity):
    """A temperature, or the word balance."""

    words: tuple[str, ...] = (BALANCE,)

    def read(self, value: Any, context: Context) -> float | str | None:
        """The word, or the temperature [K]."""
        if isinstance(value, str) and value == BALANCE:
            return BALANCE
        if isinstance(value, str) and not context.in_file:
            allowed = "a temperature [K], 'balance', or None for the lubricant's own"
            raise InputError(f"it is {shown(value)}", allowed=allowed)
        return super().read(value, context)


@input_section("", "everything one simulation needs", groups=_GROUPS)
class Case:
    """One simulation.

    Raises InputError for a wrong value, and for values that do not go together.

    Parameters
    ----------
    bearing : Bearing or TaperedBearing
    lubricant : Lubricant
    temperature : float or "balance", optional
        Of the oil at the inlets of the contacts [K]; None: that for which the lubricant's values
        are given. "balance": the temperature at which the bearing loses its friction power by
        `heat`.
    heat : Heat, optional
        Goes with "balance".
    temperature_difference : float
        Inner ring and rollers over outer ring of a tapered roller bearing, against the state for
        which its preload is given [K].
    oil_supply : "flooded", "skf" or float, optional
        How full the inlets of all contacts are: flooded; as SKF's replenishment factor says; or the
        film over the flooded film, 0.3 to 1, at the inner raceway under the mean load and speed.
        Film, rolling resistance, idle contacts and the squeeze films of pockets follow from it.
        None: "skf" where the laws have one of these, see `inlet_supply`.
    loads : HubLoads, BearingLoads or RollerLoads
    drivetrain : Drivetrain
        Turns hub loads into main-bearing load; its tilt also directs the rollers' weight.
    gravity, drag : bool
        Whether weight and drag act on the rollers.
    laws : Laws
        Mechanisms in the contacts: all of them, `Laws.physical()`, by default; `Laws.paper()` is
        the model of Hart et al.
    dynamics : "imposed-orbit" or "whole-bearing"
        Whether every roller turns on its own on an orbit of pure rolling, or all move together with
        the cage.
    cage : Cage
        For the whole bearing.
    integrator : Radau, ExplicitEuler or BackwardEuler
    window : Window
    rollers : "all" or sequence of int
        Numbers of the rollers to simulate in each row, from 0.
    traces : Traces, optional
    contact_details : bool
        Whether to record, of contacts with microslip or asperities, where on them energy goes, how
        hot and how densely (`macroslip.result.variables.CONTACT_DETAILS`). It takes up to a third
        of a simulation and changes nothing else.
    rating : bool
        Whether `macroslip run` and studies rate the bearing beside its slip; `simulate` never does.

    Examples
    --------
    >>> from macroslip import Case, HubLoads
    >>> case = Case(loads=HubLoads.bundled("14B"))
    >>> case.bearing.rollers_per_row, case.integrator.tolerance
    (28, 0.0002)
    """

    bearing: Annotated[
        AnyBearing, Made(BEARING_KINDS, Text("name in the catalogue, or path of a bearing file"))
    ] = field(default_factory=lambda: Bearing.read("skf-240-600-bc"))
    lubricant: Annotated[
        Lubricant, Made((Lubricant,), Text("name in the catalogue, or path of a lubricant file"))
    ] = field(default_factory=lambda: Lubricant.read("vg460-pao"))
    temperature: Annotated[
        float | str | None,
        InletTemperature(
            "oil at the inlets of the contacts; without it that of the lubricant's values",
            TEMPERATURE,
            253.15,
            423.15,
        ),
    ] = None
    heat: Heat | None = None
    temperature_difference: Annotated[
        float,
        Quantity(
            "inner ring and rollers of a tapered roller bearing over its outer ring, against the "
            "state for which the preload is given",
            TEMPERATURE_DIFFERENCE,
            -100.0,
            100.0,
        ),
        Stored(when=lambda case, _: kind_of(case.bearing).is_preloaded_by_heat),
    ] = 0.0
    oil_supply: Annotated[
        str | float | None,
        OilSupply(
            "how full the inlets of all contacts are: flooded, skf (replenishment), or film / "
            "flooded film, 0.3 to 1"
        ),
        Stored(
            when=lambda case, _: case.laws.asks_for_oil,
            value=lambda case: case.inlet_supply,
        ),
    ] = None
    loads: Annotated[
        HubLoads | BearingLoads | RollerLoads,
        Made((HubLoads, BearingLoads, RollerLoads), form_from(LoadSource)),
        Stored(value=lambda case: _about_loads(case.loads)),
    ]
    drivetrain: Drivetrain = field(default_factory=Drivetrain)
    gravity: Annotated[bool, Flag("weight of the rollers")] = True
    drag: Annotated[bool, Flag("drag of the lubricant")] = True
    laws: Annotated[
        Laws,
        Variants(
            "named set of mechanisms", "model", "physical", dict.fromkeys(PRESETS, Laws), PRESETS
        ),
        Stored(value=lambda case: {"model": case.laws.name} | stored(case.laws)),
    ] = field(default_factory=Laws.physical)
    dynamics: Annotated[
        str,
        Choice(
            "rollers on orbits of pure rolling, or all of them together with the cage",
            lambda: DYNAMICS,
        ),
        Stored(when=lambda case, _: case.dynamics == WHOLE_BEARING),
    ] = IMPOSED_ORBIT
    cage: Annotated[
        Cage,
        Stored(when=lambda case, _: case.dynamics == WHOLE_BEARING or case.laws.skew != "none"),
    ] = field(default_factory=Cage)
    integrator: Annotated[
        Radau | BackwardEuler | ExplicitEuler,
        Variants("method of integration in time", "method", "radau", INTEGRATORS),
        Stored(
            value=lambda case: {"method": type(case.integrator).__name__} | stored(case.integrator)
        ),
    ] = field(default_factory=Radau)
    window: Window = field(default_factory=Window)
    rollers: Annotated[
        str | Sequence[int], RollerNumbers("numbers of the rollers to simulate in each row, from 0")
    ] = "all"
    traces: Annotated[Traces | None, OrWord("none")] = None
    contact_details: Annotated[
        bool, Flag("whether to record where on the contacts energy goes, how hot and how densely")
    ] = True
    rating: Annotated[
        bool, Flag("whether to rate the bearing beside its slip: safety, lives, pressure, films")
    ] = True

    def __post_init__(self) -> None:
        problems = [
            *_temperature(self),
            *_raised(check_supply, self.oil_supply, self.bearing, self.laws),
            *_dynamics(self),
            *kind_of(self.bearing).check(self),
            *_times_and_rollers(self),
        ]
        if problems:
            raise together(problems)

    @property
    def oil(self) -> Lubricant:
        """The lubricant at the temperature of the inlets; every computation uses this one.

        Raises InputError if the temperature is still to be found.
        """
        if self.temperature == BALANCE:
            raise InputError(
                "the temperature is that of a balance of heat, which only a simulation finds",
                where="temperature",
                allowed="a temperature",
                remedy="Give the temperature of the oil; inlet_temperature of a result has the one "
                "it found.",
            )
        oil = self.lubricant
        if self.temperature is not None:
            oil = oil.at(self.temperature)
        if not self.laws.asks_for_oil:
            return oil
        return oil.supplied(
            oil_gap(self.inlet_supply, self.bearing, oil, self.bearing_loads, self.laws)
        )

    @property
    def inlet_supply(self) -> str | float:
        """Oil supply in effect: `oil_supply`, or its default where that is None.

        That is "skf" with laws that have a starved film or rolling resistance, and "flooded" with
        others.
        """
        return inlet_supply(self.oil_supply, self.laws)

    @property
    def ring_loads(self) -> BearingLoads | RollerLoads:
        """Load history from which the loads of the rollers follow.

        The load on the inner ring, or loads of the rollers that are given.
        """
        if isinstance(self.loads, HubLoads):
            if kind_of(self.bearing).carries_moments:
                return shaft_load(self.loads, self.drivetrain)[0]
            return main_bearing_load(self.loads, self.drivetrain)
        return self.loads

    @property
    def ring_moments(self) -> np.ndarray:
        """Moments on the inner ring about X0 and Y0 [N m], shape (n, 2), of `ring_loads`.

        None where the force on the bearing is given, or where the bearing carries no moment.
        """
        if isinstance(self.loads, HubLoads) and kind_of(self.bearing).carries_moments:
            _, moment = shaft_load(self.loads, self.drivetrain)
            return moment
        return np.zeros((self.loads.time.size, 2))

    @property
    def bearing_loads(self) -> BearingLoads:
        """The load on the inner ring; of given roller loads their resultant."""
        loads = self.ring_loads
        if isinstance(loads, RollerLoads):
            return loads.resultant(self.bearing.contact_angle, self.bearing.rollers_per_row)
        return loads

    @property
    def roller_numbers(self) -> tuple[int, ...]:
        """Numbers of the rollers to simulate in each row."""
        if isinstance(self.rollers, str):  # "all"
            return tuple(range(self.bearing.rollers_per_row))
        return tuple(self.rollers)

    def as_dict(self) -> dict[str, Any]:
        """The full input as plain data, by the keys of a case file.

        Keys that have no effect are left out. Of the load series there are its source, extent and a
        hash of all its numbers.
        """
        values = stored(self)
        for group, (_, keys) in _GROUPS.items():
            values[group] = {key: values.pop(key) for key in keys}
        return values

    def __repr__(self) -> str:
        texts = [text for _, text in self._overview()]
        return f"<Case: {', '.join(texts)}>"

    def _repr_html_(self) -> str:
        return html_overview("Case", ["", ""], self._overview())

    def _overview(self) -> list[tuple[str, str]]:
        loads = self.loads
        start = self.window.start
        end = self.window.end
        count = "all rollers"
        if self.rollers != "all":
            count = f"{len(self.roller_numbers)} rollers of each row"
        opens = "at the first sample" if loads.event else "after the first orbit"
        if start is not None:
            opens = f"at {start:g} s"
        closes = loads.end if end is None else end
        traces = "no traces"
        if self.traces is not None:
            traces = f"traces every {self.traces.step:g} s"
        return [
            ("loads", f"{loads.source}, {loads.start:g} s to {loads.end:g} s"),
            ("bearing", self.bearing.name),
            ("lubricant", self.lubricant.name),
            ("laws", f"model {self.laws.name}"),
            ("integrator", type(self.integrator).__name__),
            ("window", f"window {opens} to {closes:g} s"),
            ("rollers", count),
            ("dynamics", self.dynamics),
            ("traces", traces),
        ]


def _about_loads(loads: HubLoads | BearingLoads | RollerLoads) -> dict[str, Any]:
    """Kind, source and extent of a load series, and a hash of all its numbers."""
    digest = hashlib.sha256()
    for name in ("time", "shaft_speed", "force", "moment", "angle", "load"):
        if hasattr(loads, name):
            values = getattr(loads, name)
            digest.update(values.tobytes())
    about = {
        "kind": type(loads).__name__,
        "source": without_folders(loads.source),
        "samples": int(loads.time.size),
        "start": loads.start,
        "end": loads.end,
        "sha256": digest.hexdigest(),
    }
    if loads.event:
        about["event"] = True
    return about


def _temperature(case: Case) -> Iterator[InputError]:
    if case.temperature == BALANCE and case.heat is None:
        yield InputError(
            "temperature is to balance, and the heat that the bearing loses is not given",
            where="heat",
            allowed="conductance to the surroundings and their temperature",
            remedy="40 to 80 W/K is an estimate for the main bearing of a 2 MW turbine.",
        )
    if isinstance(case.temperature, float):
        for problem in _raised(case.lubricant.at, case.temperature):
            yield Location(Source(), ("temperature",)).blamed(problem)


def _raised(check: Callable[..., Any], *values: Any) -> Iterator[InputError]:
    try:
        check(*values)
    except InputError as problem:
        yield problem


def _dynamics(case: Case) -> Iterator[InputError]:
    """Yield values that the chosen dynamics cannot use."""
    default = Cage()
    skews = case.laws.skew != "none"
    skew_keys = [name for name in SKEW_KEYS if getattr(case.cage, name) != getattr(default, name)]
    if skew_keys and not skews:
        yield InputError(
            f"{' and '.join(skew_keys)} tell how the cage holds rollers that skew, and here they are "
            "held straight",
            where="cage",
            allowed="with laws: {skew: quasi-static}",
            remedy=f"Set laws.skew: quasi-static, or remove {' and '.join(skew_keys)}.",
        )
    if case.dynamics == IMPOSED_ORBIT:
        used = (*SKEW_KEYS, "gap") if skews else SKEW_KEYS
        without = {name: getattr(default, name) for name in used}
        if replace(case.cage, **without) != default:
            never = f", which {case.bearing.kind} roller bearings do not have"
            remedy = "Remove"
            if kind_of(case.bearing).has_free_orbits:
                never = ""
                remedy = "Set dynamics: whole-bearing, or remove"
            yield InputError(
                "a cage is described, but rollers on imposed orbits do not use it",
                where="cage",
                allowed=f"with dynamics: whole-bearing{never}",
                remedy=f"{remedy} the cage.",
            )
        if skews:
            yield from _raised(case.cage.check_fit, case.bearing)
        return
    if isinstance(case.loads, RollerLoads):
        yield InputError(
            "loads of the rollers are given over their places, but in a whole bearing the rollers' "
            "places, and with them their loads, follow from the simulation",
            where="loads.roller_loads",
            allowed="loads at the hub or on the main bearing, for dynamics: whole-bearing",
            remedy="Set dynamics: imposed-orbit, or give the load on the bearing.",
        )
    if not isinstance(case.integrator, Radau):
        yield InputError(
            f"a fixed step of {case.integrator.step:g} s cannot resolve the impacts of rollers on "
            "their cage, which take a tenth of a millisecond and begin at any time",
            where="integrator",
            allowed="an error-controlled integrator for dynamics: whole-bearing",
            remedy="Choose integrator.method: radau; its tolerance serves the whole bearing too.",
        )
    yield from _raised(case.cage.check_fit, case.bearing)


def _times_and_rollers(case: Case) -> Iterator[InputError]:
    """Yield rollers that the bearing does not have, and times at which there are no loads."""
    count = case.bearing.rollers_per_row
    numbers = case.roller_numbers
    is_repeated = len(set(numbers)) < len(numbers)
    is_outside = min(numbers) < 0 or max(numbers) >= count
    if is_repeated or is_outside:
        allowed = f"all, or a list of different numbers from 0 to {count - 1}"
        yield InputError(f"rollers is {shown(list(numbers))}", where="rollers", allowed=allowed)
    first = case.loads.start
    last = case.loads.end
    rounding = TIME_ROUNDING * max(abs(first), abs(last))
    # A record of 600 s often ends one sample before 600 s.
    mean_step = (last - first) / (case.loads.time.size - 1)
    latest = last + (1.0 + 1e-6) * mean_step
    for name, part, allowed in (
        ("window", case.window, "start before end, both within the loads'"),
        ("traces", case.traces, "times within the loads'"),
    ):
        start = first if part is None or part.start is None else part.start
        end = last if part is None or part.end is None else part.end
        is_ordered = first - rounding <= start <= end <= latest
        within = is_ordered and start <= last + rounding
        is_empty = name == "window" and min(end, last) - start <= rounding
        if not within or is_empty:
            verb = "runs" if name == "window" else "run"
            fault = f"the {name} {verb} from {start!r} s to {end!r} s"
            yield InputError(fault, where=name, allowed=f"{allowed} {first:g} s to {last:g} s")
