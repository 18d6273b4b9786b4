"""The keys of a study file, with what may stand under each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from macroslip.case.form import Choice, Place, Plain
from macroslip.case.section import Section
from macroslip.catalogue.entry import is_finite_number
from macroslip.catalogue.problems import shown, together, unknown_key
from macroslip.errors import InputError
from macroslip.result.dataset import VARIABLES
from macroslip.study.settings import Setting
from macroslip.study.variation import Range, Sample

LOAD_SOURCES = ("files", "table", "bundled")
METHODS = ("latin-hypercube", "sobol")
SCALES = ("linear", "log")
KINDS = ("hub", "main-bearing")


@dataclass(frozen=True)
class Texts:
    """A text, or a list of different texts."""

    about: str

    @property
    def form(self) -> str:
        """What is accepted, in words."""
        return "text, or a list of different texts"

    def read(self, value: Any, place: Place) -> list[str]:
        """A list in any case."""
        texts = value if isinstance(value, list) else [value]
        if not texts or not all(isinstance(text, str) and text for text in texts) or len(set(texts)) != len(texts):
            raise place.problem(f"it is {shown(value)}", self.form, f"It is the {self.about}.")
        return texts


@dataclass(frozen=True)
class Variables:
    """Names of variables of a result."""

    about: str

    @property
    def form(self) -> str:
        """What is accepted, in words."""
        return f"a list of variables of a result: {', '.join(VARIABLES)}"

    def read(self, value: Any, place: Place) -> list[str]:
        """A list in any case."""
        names = value if isinstance(value, list) else [value]
        wrong = [name for name in names if name not in VARIABLES]
        if wrong or not names:
            raise place.problem(f"it is {shown(wrong[0] if wrong else value)}", self.form, f"It is the {self.about}.")
        return names


@dataclass(frozen=True)
class Named:
    """A mapping of names of the user's own to values of one kind."""

    about: str
    kind: Any

    @property
    def form(self) -> str:
        """What is accepted, in words."""
        return "a section whose keys are names of your own"

    def read(self, value: Any, place: Place) -> dict[str, Any]:
        """Read every value; what is wrong is told together."""
        if not isinstance(value, Mapping) or not all(isinstance(name, str) and name for name in value):
            raise place.problem(f"it is {shown(value)}", self.form, f"It is the {self.about}.")
        return _each(value, place, lambda name, item, inner: self.kind.read(item, inner))


@dataclass(frozen=True)
class BaseCase:
    """The keys of a case file; what stands under them is checked by the reader of case files."""

    about: str

    @property
    def form(self) -> str:
        """What is accepted, in words."""
        return "the keys of a case file, of loads only start and end"

    def read(self, value: Any, place: Place) -> dict[str, Any]:
        """Check that the loads are left to the study."""
        if value is None:  # every key of the section is commented out
            return {}
        loads = value.get("loads", {}) if isinstance(value, Mapping) else None
        if not isinstance(loads, Mapping):
            raise place.problem(f"it is {shown(value)}", self.form)
        for key in loads:
            if key not in ("start", "end"):
                remedy = "The study's own section loads says where the loads come from."
                raise place.inside("loads", key).problem(f"the key '{key}' cannot stand here", "start, end", remedy)
        return dict(value)


@dataclass(frozen=True)
class Settings:
    """Values in place of the base case's: keys with dots, values as in a case file."""

    about: str
    form: str = "a section such as {bearing.diametral_clearance: 0.2 mm, forces.drag: false}"

    def read(self, value: Any, place: Place) -> list[Setting]:
        """Check every key and value."""
        if value is None or value == {}:  # the base case itself
            return []
        return list(_each(_mapping(value, place, self.form), place, self._setting).values())

    @staticmethod
    def _setting(key: str, value: Any, place: Place) -> Setting:
        setting = Setting.written(key, value)
        setting.check(place)
        return setting


@dataclass(frozen=True)
class SettingsList:
    """A list of settings that belong together."""

    about: str
    form: str = "a list of sections such as {bearing.diametral_clearance: 0.2 mm, forces.drag: false}"

    def read(self, value: Any, place: Place) -> list[list[Setting]]:
        """Check every item; a key has one unit throughout, so that its values can stand in one column."""
        if not isinstance(value, list) or not value:
            raise place.problem(f"it is {shown(value)}", self.form)
        items = [Settings(self.about).read(item, place) for item in value]
        units: dict[str, str] = {}
        for setting in (setting for item in items for setting in item):
            if units.setdefault(setting.key, setting.unit) != setting.unit:
                both = f"{setting.unit or 'no unit'} and in {units[setting.key] or 'no unit'}"
                what = f"{setting.key} stands there in {both}"
                raise place.problem(what, "one unit for all values of a key")
        return items


@dataclass(frozen=True)
class GridAxes:
    """Values of each of several parameters."""

    about: str
    form: str = "a section such as {bearing.diametral_clearance: {values: [0, 0.2, 0.4], unit: mm}}"

    def read(self, value: Any, place: Place) -> dict[str, list[Setting]]:
        """Check every value."""
        return _each(_mapping(value, place, self.form), place, self._axis)

    def _axis(self, key: str, value: Any, place: Place) -> list[Setting]:
        given = _inner(value, ("values", "unit"), ("values",), place, self.form)
        values = given["values"]
        if not isinstance(values, list) or not values:
            raise place.problem(f"values is {shown(values)}", "a list of values", "For quantities, without their unit.")
        settings = [Setting(key, item, given.get("unit", "")) for item in values]
        for setting in settings:
            setting.check(place)
        if len({repr(item) for item in values}) != len(values):
            raise place.problem(f"a value stands twice in {shown(values)}", "different values")
        return settings


@dataclass(frozen=True)
class SampleRanges:
    """Ranges of the sampled parameters."""

    about: str
    form: str = "a section such as {bearing.diametral_clearance: {low: 0, high: 0.4, unit: mm}}"

    def read(self, value: Any, place: Place) -> dict[str, Range]:
        """Check both ends of every range."""
        return _each(_mapping(value, place, self.form), place, self._range)

    def _range(self, key: str, value: Any, place: Place) -> Range:
        given = _inner(value, ("low", "high", "unit", "scale"), ("low", "high"), place, self.form)
        for end in ("low", "high"):
            if not is_finite_number(given[end]):
                raise place.problem(f"{end} is {shown(given[end])}", "a finite number", "Its unit goes into unit.")
            Setting(key, float(given[end]), given.get("unit", "")).check(place)
        scale = Choice("scale", lambda: SCALES).read(given.get("scale", "linear"), place.inside("scale"))
        try:
            return Range(float(given["low"]), float(given["high"]), given.get("unit", ""), scale)
        except InputError as problem:
            raise place.blamed(problem) from None


STUDY = Section(
    "study",
    {
        "title": Plain("what the study is about", str),
        "case": BaseCase("base case: the keys of a case file; of loads only start and end"),
        "loads": Section(
            "load histories, from exactly one source",
            {
                "files": Texts("paths of load files, with fields such as {wind_speed:g} and wildcards"),
                "table": Plain("CSV or Parquet table with a column 'file' and one column a field", str),
                "bundled": Texts("load cases that come with the package, or all"),
                "kind": Choice("what the files hold", lambda: KINDS),
                "units": Named("units of the fields", Plain("unit", str)),
            },
            one_of=LOAD_SOURCES,
        ),
        "bearings": Texts("bearings: names of the catalogue, or paths of bearing files"),
        "lubricants": Texts("lubricants: names of the catalogue, or paths of lubricant files"),
        "models": Named("named choices of the model", Settings("values in place of the base case's")),
        "variations": Section(
            "parameters that vary",
            {
                "grid": GridAxes("values of each parameter, of which every combination is run"),
                "list": SettingsList("combinations of values, each of which is run"),
                "sample": Section(
                    "seeded sample of a box of parameters",
                    {
                        "method": Choice("how to sample", lambda: METHODS),
                        "count": Plain("number of points; a power of 2 for sobol", int),
                        "seed": Plain("seed: the same one gives the same points", int),
                        "ranges": SampleRanges("interval of each parameter"),
                    },
                    required=("count", "seed", "ranges"),
                ),
            },
        ),
        "cycles": Plain("whether to count the cycles of the bearing's load", bool),
        "keep": Variables("variables of a result to store; all if left out"),
    },
    required=("loads",),
)


def sample_of(given: Mapping[str, Any] | None, place: Place) -> Sample | None:
    """The sample that a study file describes."""
    if given is None:
        return None
    try:
        return Sample(given.get("method", METHODS[0]), given["count"], given["seed"], given["ranges"])
    except InputError as problem:
        raise place.blamed(problem) from None


def _each(value: Mapping[str, Any], place: Place, read: Any) -> dict[str, Any]:
    """Read every entry of a mapping, and tell the problems of all together."""
    found, problems = {}, []
    for key, item in value.items():
        try:
            found[key] = read(key, item, place.inside(key))
        except InputError as problem:
            problems.append(problem)
    if problems:
        raise together(problems)
    return found


def _mapping(value: Any, place: Place, form: str) -> Mapping[str, Any]:
    if not isinstance(value, Mapping) or not value or not all(isinstance(key, str) for key in value):
        raise place.problem(f"it is {shown(value)}", form)
    return value


def _inner(value: Any, keys: tuple[str, ...], required: tuple[str, ...], place: Place, form: str) -> Mapping[str, Any]:
    for key in _mapping(value, place, form):
        if key not in keys:
            raise unknown_key(key, keys, where=place.where, inside=place.key)
    missing = [key for key in required if key not in value]
    if missing:
        raise place.problem(f"{' and '.join(missing)} is missing", form)
    if not isinstance(value.get("unit", ""), str):
        raise place.problem(f"unit is {shown(value['unit'])}", 'text, such as mm or "1"')
    return value
