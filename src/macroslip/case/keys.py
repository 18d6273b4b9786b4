"""The keys of a case file: the one description that reader, messages and JSON Schema share.

To add a key, add a field to its section: `name: Annotated[type, Quantity("what it is", LENGTH, 0.0, 1.0)] = default`.
Keys of `Radau`, `Window`, `Traces`, `Cage` and `Drivetrain` are the fields of these classes themselves; a new section is a class
with `@input_section` here and a line in `CaseFile` and in `case_file._PARTS`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any

from macroslip.case.case import BALANCE, DYNAMICS, IMPOSED_ORBIT
from macroslip.case.parts import BackwardEuler, ExplicitEuler, Heat, Radau, Traces, Window
from macroslip.catalogue.forms import Choice, Flag, Form, Text
from macroslip.catalogue.input_section import input_section
from macroslip.catalogue.problems import shown
from macroslip.catalogue.quantity_forms import Quantity, Vector
from macroslip.catalogue.section_forms import OrWord, Variants
from macroslip.catalogue.units import FORCE, MOMENT, SPEED, TEMPERATURE, TIME
from macroslip.constants import MECHANISMS
from macroslip.errors import InputError
from macroslip.loads import Drivetrain, bundled_cases
from macroslip.mechanisms import NAMED_SETS, asperity_laws, rheologies, rolling_laws, viscosity_laws
from macroslip.whole.cage import Cage

LOAD_SOURCES = ("bundled", "file", "bearing_file", "hub", "main_bearing")
INTEGRATORS = {"radau": Radau, "backward-euler": BackwardEuler, "explicit-euler": ExplicitEuler}
_OWN_LAW = "A law of your own needs its file: macroslip run CASE --laws FILE."

_Force = Annotated[list[float], Vector("three components of the force", FORCE)]
_Moment = Annotated[list[float], Vector("three components of the moment", MOMENT)]
_Speed = Annotated[float, Quantity("shaft speed", SPEED)]
_Duration = Annotated[float, Quantity("time for which the loads act", TIME)]


def _film_laws() -> list[str]:
    from macroslip.contact.registry import FILM_LAWS

    return FILM_LAWS.names()


def _traction_laws() -> list[str]:
    from macroslip.contact.registry import TRACTION_LAWS

    return [MECHANISMS, *TRACTION_LAWS.names()]


@input_section("loads.hub", "constant hub loads")
class ConstantHubLoads:
    """Arguments of `HubLoads.constant`."""

    force: _Force
    shaft_speed: _Speed
    duration: _Duration
    moment: _Moment


@input_section("loads.main_bearing", "constant main-bearing load")
class ConstantBearingLoads:
    """Arguments of `BearingLoads.constant`."""

    force: _Force
    shaft_speed: _Speed
    duration: _Duration


@input_section("loads", "loads, from exactly one source", one_of=LOAD_SOURCES)
class LoadsKeys:
    """Where the loads come from, and what to read of them."""

    bundled: Annotated[str | None, Choice("load case that comes with the package", bundled_cases)] = None
    file: Annotated[str | None, Text("hub loads: output of OpenFAST, Bladed or HAWC2, or a table")] = None
    bearing_file: Annotated[str | None, Text("main-bearing loads: a table (.parquet, .csv)")] = None
    hub: ConstantHubLoads | None = None
    main_bearing: ConstantBearingLoads | None = None
    start: Annotated[float | None, Quantity("first time to read", TIME)] = None
    end: Annotated[float | None, Quantity("last time to read", TIME)] = None
    shaft_speed: Annotated[
        float | None, Quantity("constant shaft speed in place of the one in the file", SPEED, -100.0, 100.0)
    ] = None


@input_section("forces", "forces on the rollers that can be switched off")
class Forces:
    """Forces on the rollers."""

    gravity: Annotated[bool, Flag("weight of the rollers")] = True
    drag: Annotated[bool, Flag("drag of the lubricant")] = True


@input_section("laws", "physics in the contacts: a named set, and mechanisms that differ from it")
class LawsKeys:
    """Choices of `Laws`; None leaves one as the named set has it."""

    model: Annotated[str, Choice("named set of mechanisms", lambda: NAMED_SETS)] = "paper"
    film: Annotated[str | None, Choice("film thickness", _film_laws, _OWN_LAW)] = None
    starvation: Annotated[bool | None, Flag("film thinned by the lubricant's starvation factor")] = None
    inlet_heating: Annotated[bool | None, Flag("film thinned by shear heating in the inlet")] = None
    viscosity: Annotated[str | None, Choice("how viscosity rises with pressure", viscosity_laws)] = None
    rheology: Annotated[str | None, Choice("how the film's stress falls behind the Newtonian one", rheologies)] = None
    heating: Annotated[bool | None, Flag("shear heating of the film")] = None
    microslip: Annotated[bool | None, Flag("slip that varies along the roller")] = None
    asperities: Annotated[str | None, Choice("share of the load that asperities carry", asperity_laws)] = None
    rolling: Annotated[str | None, Choice("rolling resistance, and films of rollers with play", rolling_laws)] = None
    traction: Annotated[
        str | None,
        Choice("mechanisms, or a traction law of your own in their place", _traction_laws, _OWN_LAW),
    ] = None


@dataclass(frozen=True)
class RollerNumbers(Form):
    """A list of whole numbers, or all; whether a number exists is checked with the bearing."""

    form = "all, or a list of whole numbers such as [0, 7]"

    def read(self, value: Any, info: Any) -> str | list[int]:
        """Check that each is a whole number."""
        if value != "all" and not (isinstance(value, list) and all(type(item) is int for item in value)):
            raise InputError(f"it is {shown(value)}", allowed=self.form)
        return value

    def json(self) -> dict[str, Any]:
        """A list of integers, or the word."""
        numbers = {"type": "array", "items": {"type": "integer", "minimum": 0}, "minItems": 1, "uniqueItems": True}
        return {"anyOf": [{"const": "all"}, numbers]}


@dataclass(frozen=True)
class InletTemperature(Quantity):
    """A temperature, or the word balance."""

    words: tuple[str, ...] = (BALANCE,)

    def read(self, value: Any, info: Any) -> float | str | None:
        """The word, or the temperature [K]."""
        return BALANCE if isinstance(value, str) and value == BALANCE else super().read(value, info)


@input_section("case", "everything one simulation needs")
class CaseFile:
    """The keys at the top of a case file."""

    bearing: Annotated[str | None, Text("bearing: a name of the catalogue, or the path of a bearing file")] = None
    lubricant: Annotated[str | None, Text("lubricant: a name of the catalogue, or the path of a lubricant file")] = None
    temperature: Annotated[
        float | str | None,
        InletTemperature(
            "oil at the inlets of the contacts; without it that of the lubricant's values", TEMPERATURE, 253.15, 423.15
        ),
    ] = None
    heat: Heat | None = None
    loads: LoadsKeys
    drivetrain: Drivetrain = Drivetrain()
    forces: Forces = Forces()
    laws: LawsKeys = LawsKeys()
    dynamics: Annotated[
        str, Choice("rollers on orbits of pure rolling, or all of them together with the cage", lambda: DYNAMICS)
    ] = IMPOSED_ORBIT
    cage: Cage = Cage()
    integrator: Annotated[
        Radau | BackwardEuler | ExplicitEuler,
        Variants("method of integration in time", "method", "radau", INTEGRATORS),
    ] = Radau()
    window: Window = Window()
    rollers: Annotated[str | list[int], RollerNumbers("numbers of the rollers to simulate in each row, from 0")] = "all"
    traces: Annotated[Traces | None, OrWord("none")] = None
    contact_details: Annotated[
        bool, Flag("whether to record where on the contacts energy goes, how hot and how densely")
    ] = True
    rating: Annotated[bool, Flag("whether to rate the bearing beside its slip: safety, lives, pressure, films")] = True
