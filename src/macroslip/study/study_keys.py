"""The keys of a study file: the one description that reader and messages share."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any

from macroslip.errors import InputError
from macroslip.input.fields import Choice, Flag, Form, Text, Texts
from macroslip.input.files import Place, Source
from macroslip.input.messages import shown, together
from macroslip.input.section import MappingOf, input_section, read_all
from macroslip.result.variables import VARIABLES
from macroslip.study.settings import Setting
from macroslip.study.variation import Sample
from macroslip.study.weights import Weighting

LOAD_SOURCES = ("files", "table", "bundled")
KINDS = ("hub", "main-bearing")


@dataclass(frozen=True)
class BaseCase(Form):
    """The keys of a case file; their values are checked by the reader of case files."""

    form = "the keys of a case file, of loads only start, end and shaft_speed"

    def read(self, value: Any, given: Any) -> dict[str, Any]:
        """Check that the loads are left to the study."""
        if value is None:  # every key of the section is commented out
            return {}
        loads = value.get("loads", {}) if isinstance(value, Mapping) else None
        if not isinstance(loads, Mapping):
            raise InputError(f"it is {shown(value)}", allowed=self.form)
        remedy = "The study's own section loads names where the loads come from."
        allowed = "start, end, shaft_speed"
        problems = [
            given.place.inside("loads", str(key)).problem(f"the key '{key}' cannot stand here", allowed, remedy)
            for key in loads
            if key not in ("start", "end", "shaft_speed")
        ]
        if problems:
            raise together(problems)
        return dict(value)

    def json(self) -> dict[str, Any]:
        """An object; its keys have a schema of their own."""
        return {"type": "object"}


@dataclass(frozen=True)
class Settings(Form):
    """Values in place of the base case's: keys with dots, values as in a case file."""

    form = "a section such as {bearing.diametral_clearance: 0.2 mm, forces.drag: false}"

    def read(self, value: Any, given: Any) -> list[Setting]:
        """Check every key and value; nothing is the base case itself."""
        if value is None or value == {}:
            return []
        return list(MappingOf(self.about, self.form, Any, _written).read(value, given).values())

    def json(self) -> dict[str, Any]:
        """An object with any keys."""
        return {"type": "object"}


@dataclass(frozen=True)
class SettingsList(Form):
    """A list of settings that belong together."""

    form = "a list of sections such as {bearing.diametral_clearance: 0.2 mm, forces.drag: false}"

    def read(self, value: Any, given: Any) -> list[list[Setting]]:
        """Check every item; a key has one unit throughout, so that its values fit in one column."""
        if not isinstance(value, list) or not value:
            raise InputError(f"it is {shown(value)}", allowed=self.form)
        numbered = ((str(number), item) for number, item in enumerate(value))
        items = read_all(numbered, lambda _, item, inner: Settings(self.about).read(item, inner), given)
        units: dict[str, str] = {}
        for setting in (setting for item in items for setting in item):
            if units.setdefault(setting.key, setting.unit) != setting.unit:
                both = f"{setting.unit or 'no unit'} and in {units[setting.key] or 'no unit'}"
                raise InputError(f"{setting.key} is given in {both}", allowed="one unit for all values of a key")
        return items

    def json(self) -> dict[str, Any]:
        """A list of objects."""
        return {"type": "array", "items": {"type": "object"}, "minItems": 1}


@dataclass(frozen=True)
class Values(Form):
    """A list of different values."""

    form = "a list of values"

    def read(self, value: Any, given: Any) -> list[Any]:
        """Check that there are some, and none twice."""
        if not isinstance(value, list) or not value:
            remedy = "For quantities, without their unit."
            raise InputError(f"values is {shown(value)}", allowed=self.form, remedy=remedy)
        if len({repr(item) for item in value}) != len(value):
            raise InputError(f"a value stands twice in {shown(value)}", allowed="different values")
        return value

    def json(self) -> dict[str, Any]:
        """A list of different values."""
        return {"type": "array", "minItems": 1, "uniqueItems": True}


@dataclass(frozen=True)
class Variables(Texts):
    """Names of variables of a result."""

    form = f"a list of variables of a result: {', '.join(VARIABLES)}"

    def read(self, value: Any, given: Any) -> list[str]:
        """Check every name."""
        names = super().read(value, given)
        wrong = [name for name in names if name not in VARIABLES]
        if wrong:
            raise InputError(f"it is {shown(wrong[0])}", allowed=self.form, remedy=f"It is the {self.about}.")
        return names


@input_section("grid", "values of one parameter")
class GridAxis:
    """Values of one parameter."""

    values: Annotated[list[Any], Values("values of the parameter")]
    unit: Annotated[str, Text("unit of the values", may_be_empty=True)] = ""


def _written(key: str, value: Any) -> Setting:
    """A value as a case file has it, checked."""
    setting = Setting.written(key, value)
    setting.check(Place(Source()))
    return setting


def _axis(key: str, axis: GridAxis) -> list[Setting]:
    """The settings of one parameter, checked."""
    settings = [Setting(key, value, axis.unit) for value in axis.values]
    for setting in settings:
        setting.check(Place(Source()))
    return settings


@input_section("loads", "load histories, from exactly one source", one_of=LOAD_SOURCES)
class StudyLoads:
    """Where the load histories come from, and the fields they are labelled with."""

    files: Annotated[
        list[str] | None, Texts("paths of load files, with fields such as {wind_speed:g} and wildcards")
    ] = None
    table: Annotated[str | None, Text("CSV or Parquet table with a column 'file' and one column a field")] = None
    bundled: Annotated[list[str] | None, Texts("load cases that come with the package, or all")] = None
    kind: Annotated[str, Choice("what the files hold", lambda: KINDS)] = "hub"
    units: Annotated[dict[str, str] | None, MappingOf("units of the fields", item=Annotated[str, Text("unit")])] = None


_Grid = Annotated[
    dict[str, GridAxis],
    MappingOf(
        "values of each parameter, of which every combination is run",
        "a section such as {bearing.diametral_clearance: {values: [0, 0.2, 0.4], unit: mm}}",
        GridAxis,
        _axis,
    ),
]
_List = Annotated[list[Any] | None, SettingsList("combinations of values, each of which is run")]


@input_section("variations", "parameters that vary")
class Variations:
    """Parameters that vary; every combination of the three is run."""

    grid: _Grid = None  # pyright: ignore[reportAssignmentType]
    list: _List = None
    sample: Sample | None = None


@input_section("study", "many cases")
class StudyFile:
    """The keys at the top of a study file."""

    title: Annotated[str, Text("what the study is about", may_be_empty=True)] = ""
    case: Annotated[
        dict[str, Any] | None, BaseCase("base case: the keys of a case file; of loads only start, end and shaft_speed")
    ] = None
    loads: StudyLoads
    bearings: Annotated[list[str] | None, Texts("bearings: names of the catalogue, or paths of bearing files")] = None
    lubricants: Annotated[
        list[str] | None, Texts("lubricants: names of the catalogue, or paths of lubricant files")
    ] = None
    models: Annotated[
        dict[str, Any],
        MappingOf(
            "named choices of the model",
            item=Annotated[list[Any], Settings("values in place of the base case's")],
            may_be_empty=True,
        ),
    ] = None  # pyright: ignore[reportAssignmentType]
    variations: Variations = Variations()
    weights: Weighting | None = None
    cycles: Annotated[bool, Flag("whether to count the cycles of the bearing's load")] = False
    keep: Annotated[list[str] | None, Variables("variables of a result to store; all if left out")] = None
