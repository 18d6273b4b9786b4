"""A study, and its file: the keys, and from them the runs.

All that is wrong with a file is reported together.
"""

from __future__ import annotations

import contextlib
import hashlib
import itertools
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import partial
from os import PathLike
from pathlib import Path
from typing import Annotated, Any

import numpy as np

from macroslip.case.case import BALANCE, Case
from macroslip.case.load_source import CUT_KEYS
from macroslip.case.parts import Heat
from macroslip.errors import InputError
from macroslip.input.fields import Choice, Flag, Form, Text, Texts
from macroslip.input.files import Location, Source, parse, read_text
from macroslip.input.messages import shown, together
from macroslip.input.record import Record
from macroslip.input.section import MappingOf, input_section, read_all, read_fields
from macroslip.result.heat_balance import at_balance
from macroslip.result.variables import VARIABLES
from macroslip.scada.bins import JointShares
from macroslip.study.loads_list import Load, LoadList, load_list
from macroslip.study.over_temperature import LABEL, check_span, check_varied, kelvin
from macroslip.study.settings import RECORDS, RecordKinds, Sample, Setting, read_loads, template
from macroslip.study.weights import Weighting

LOAD_SOURCES = ("files", "table", "bundled")
KINDS = ("hub", "main-bearing")
#: Key of the temperature of the oil.
TEMPERATURE = "temperature"
_GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0
_REMEDY = "Write a study file that runs with: macroslip init --example study"


@dataclass(frozen=True)
class Run:
    """One run of a study: its loads, names of bearing, lubricant and model, and varied values."""

    load: Load
    bearing: str
    lubricant: str
    model: str
    settings: Sequence[Setting]

    @property
    def is_event(self) -> bool:
        """True if the loads are those of an event: all rollers of it are computed."""
        return bool(self.load.fields.get("event"))

    @property
    def group(self) -> str:
        """Hash of everything but loads and temperature: runs that differ in these have one."""
        return self._hash([self.bearing, self.lubricant, self.model], TEMPERATURE)

    @property
    def name(self) -> str:
        """Hash of what distinguishes this run within its study: 32 hexadecimal digits."""
        return self._hash([self.load.name, self.bearing, self.lubricant, self.model], "")

    def _hash(self, labels: list[str], but: str) -> str:
        parameters = []
        for setting in self.settings:
            if setting.key != but:
                parameters.append((setting.key, setting.text))
        parameters.sort()
        text = json.dumps([labels, parameters])
        digest = hashlib.sha256(text.encode()).hexdigest()
        return digest[:32]

    @property
    def labels(self) -> dict[str, Any]:
        """Loads, fields, bearing, lubricant, model, and the parameters by key."""
        choices = {
            "loads": self.load.name,
            "bearing": self.bearing,
            "lubricant": self.lubricant,
            "model": self.model,
        }
        return (
            choices
            | dict(self.load.fields)
            | {setting.key: setting.value for setting in self.settings}
        )


@dataclass(frozen=True)
class Study:
    """A study: load histories × bearings × lubricants × models × parameters.

    Content of a study file, checked.
    """

    title: str
    #: Where relative paths of load files start.
    folder: Path
    #: Base case: keys of a case file, of `loads` only `CUT_KEYS`.
    case: Mapping[str, Any]
    loads: LoadList
    #: By the names the study has for them.
    bearings: Mapping[str, Record]
    lubricants: Mapping[str, Record]
    models: Mapping[str, Sequence[Setting]]
    #: Settings of every combination of parameters, and units of the parameters by key.
    variations: Sequence[Sequence[Setting]]
    parameters: Mapping[str, str]
    #: Whether to count cycles of the bearing's load, and which variables of a result to store;
    #: None: all.
    cycles: bool = False
    keep: Sequence[str] | None = None
    #: The study file as plain data.
    content: Mapping[str, Any] = field(default_factory=dict)
    #: How the bearing loses its heat, if the temperature is to balance, and what each load history
    #: counts in that.
    heat: Heat | None = None
    weights: Weighting | None = None
    #: Temperature [K] of the oil by `Run.group`, once it is balanced.
    temperatures: Mapping[str, float] = field(default_factory=dict)

    def __repr__(self) -> str:
        counts = {
            "load histories": self.loads.loads,
            "bearings": self.bearings,
            "lubricants": self.lubricants,
            "models": self.models,
            "combinations of parameters": self.variations,
        }
        several = []
        for noun, entries in counts.items():
            if len(entries) > 1:
                several.append(f"{len(entries)} {noun}")
        of = " of " if several else ""
        return f"<study {self.title!r}: {len(self)} runs{of}{', '.join(several)}>"

    def __len__(self) -> int:
        """Number of runs."""
        choices = self._choices(self.loads.loads)
        return math.prod(map(len, choices))

    def _choices(self, loads: Sequence[Load]) -> tuple[Any, ...]:
        return loads, self.bearings, self.lubricants, self.models, self.variations

    def runs(self) -> Iterator[Run]:
        """Yield the runs in the order of the study file, those with the same loads together."""
        return self._runs(self.loads.loads)

    def mixed_runs(self) -> Iterator[Run]:
        """Yield the runs in an order of which any stretch is a sample of the whole.

        Runs with the same loads follow one another.

        Load files come sorted by wind speed, and rough wind takes several times as long as calm
        wind: in their own order the rate so far would not hold for the rest.
        """
        # Multiples of the golden ratio are spread evenly over [0, 1), so that neighbours by them
        # lie far apart.
        loads = self.loads.loads
        order = sorted(range(len(loads)), key=lambda number: number * _GOLDEN % 1.0)
        return self._runs([loads[number] for number in order])

    def _runs(self, loads: Sequence[Load]) -> Iterator[Run]:
        choices = self._choices(loads)
        for load, bearing, lubricant, model, settings in itertools.product(*choices):
            all_settings = [*self.models[model], *settings]
            run = Run(load, bearing, lubricant, model, all_settings)
            if self.temperatures:
                temperature = Setting(TEMPERATURE, self.temperatures[run.group], "K")
                run = replace(run, settings=[*run.settings, temperature])
            yield run

    def case_of(self, run: Run | None = None) -> tuple[Case, dict[str, float]]:
        """The case of a run, by default the base case, without its loads; and how to read these.

        Of an event all rollers are computed: what lasts a short time falls on the few places where
        rollers then are.
        """
        records = {}
        for noun in RECORDS:
            records_by_name = getattr(self, f"{noun}s")
            if run:
                records[noun] = records_by_name[getattr(run, noun)]
            else:
                records[noun] = next(iter(records_by_name.values()))
        settings = run.settings if run else []
        case, cut = template(self.case, settings, records, keep=self.keep, folder=self.folder)
        if run and run.is_event:
            case = replace(case, rollers="all")
        if run and self.temperatures:
            case = at_balance(case, self.temperatures[run.group])
        return case, cut

    def path_of(self, load: Load) -> str:
        """Path of a load history, or its name if it is bundled."""
        return load_path(self.loads, load, self.folder)

    @property
    def labels(self) -> dict[str, tuple[str, str]]:
        """Units and meaning of every label of a run, by name."""
        choices = {name: ("1", f"{name} of the case") for name in ("bearing", "lubricant", "model")}
        fields = {name: (units, "label of the loads") for name, units in self.loads.units.items()}
        about = "value of the case; NaN: that of the base case"
        parameters = {key: (units or "1", about) for key, units in self.parameters.items()}
        if self.temperatures:
            parameters[TEMPERATURE] = (
                "K",
                "temperature of the oil at the inlets, of the balance of heat",
            )
        return {"loads": ("1", "loads of the case"), **choices, **fields, **parameters}


@dataclass(frozen=True)
class BaseCase(Form):
    """The keys of a case file; their values are checked by the reader of case files."""

    form = f"the keys of a case file, of loads only {', '.join(CUT_KEYS)}"

    def read(self, value: Any, context: Any) -> dict[str, Any]:
        """Check that the loads are left to the study.

        None: every key of the section is commented out.
        """
        loads = None
        if value is None:
            loads = {}
        elif isinstance(value, Mapping):
            loads = value.get("loads", {})
        if not isinstance(loads, Mapping):
            raise InputError(f"it is {shown(value)}", allowed=self.form)
        remedy = "The study's own section loads names where the loads come from."
        allowed = ", ".join(CUT_KEYS)
        problems = []
        for key in loads:
            if key not in CUT_KEYS:
                location = context.location.inside("loads", str(key))
                fault = f"the key '{key}' cannot stand here"
                problems.append(location.problem(fault, allowed, remedy))
        if problems:
            raise together(problems)
        return dict(value or {})


@dataclass(frozen=True)
class Settings(Form):
    """Values that replace the base case's: keys with dots, values as in a case file."""

    form = "a section such as {bearing.diametral_clearance: 0.2 mm, forces.drag: false}"

    def read(self, value: Any, context: Any) -> list[Setting]:
        """Check every key and value; nothing is the base case itself."""
        if value is None or value == {}:
            return []

        def written(key: str, text: Any) -> Setting:
            return Setting.written(key, text).checked()

        form = MappingOf(self.about, self.form, Any, written)
        return list(form.read(value, context).values())


@dataclass(frozen=True)
class SettingsList(Form):
    """A list of settings that belong together."""

    form = f"a list of sections, each {Settings.form[2:]}"

    def read(self, value: Any, context: Any) -> list[list[Setting]]:
        """Check every item; a key has one unit throughout, so that its values fit in one column."""
        if not isinstance(value, list) or not value:
            raise InputError(f"it is {shown(value)}", allowed=self.form)
        numbered = ((str(number), item) for number, item in enumerate(value))
        form = Settings(self.about)
        items = read_all(numbered, lambda _, item, inner: form.read(item, inner), context)
        units: dict[str, str] = {}
        for setting in itertools.chain(*items):
            unit = units.setdefault(setting.key, setting.unit)
            if unit != setting.unit:
                both = f"{setting.unit or 'no unit'} and in {unit or 'no unit'}"
                raise InputError(
                    f"{setting.key} is given in {both}", allowed="one unit for all values of a key"
                )
        return items


@dataclass(frozen=True)
class Values(Form):
    """A list of different values."""

    form = "a list of values"

    def read(self, value: Any, context: Any) -> list[Any]:
        """Check that there are some, and none twice."""
        if not isinstance(value, list) or not value:
            remedy = "For quantities, without their unit."
            raise InputError(f"values is {shown(value)}", allowed=self.form, remedy=remedy)
        different = {repr(item) for item in value}
        if len(different) != len(value):
            raise InputError(f"a value stands twice in {shown(value)}", allowed="different values")
        return value


@dataclass(frozen=True)
class Variables(Texts):
    """Names of variables of a result."""

    form = f"a list of variables of a result: {', '.join(VARIABLES)}"

    def read(self, value: Any, context: Any) -> list[str]:
        """Check every name."""
        names = super().read(value, context)
        wrong = [name for name in names if name not in VARIABLES]
        if wrong:
            raise InputError(
                f"it is {shown(wrong[0])}", allowed=self.form, remedy=f"It is the {self.about}."
            )
        return names


@input_section("grid", "values of one parameter")
class GridAxis:
    """Values of one parameter."""

    values: Annotated[list[Any], Values("values of the parameter")]
    unit: Annotated[str, Text("unit of the values", may_be_empty=True)] = ""


@input_section("loads", "load histories, from exactly one source", one_of=LOAD_SOURCES)
class StudyLoads:
    """Source of the load histories, and the fields that label them."""

    files: Annotated[
        list[str] | None,
        Texts("paths of load files, with fields such as {wind_speed:g} and wildcards"),
    ] = None
    table: Annotated[
        str | None, Text("CSV, Parquet or Excel table with a column 'file' and one column a field")
    ] = None
    sheet: Annotated[
        str | None, Text("sheet of the table, if that is a workbook; without it the first one")
    ] = None
    bundled: Annotated[
        list[str] | None,
        Texts("load cases that come with the package; all for the 21, year for every one"),
    ] = None
    kind: Annotated[str, Choice("what the files hold", lambda: KINDS)] = "hub"
    units: Annotated[
        dict[str, str] | None, MappingOf("units of the fields", item=Annotated[str, Text("unit")])
    ] = None


_Grid = Annotated[
    dict[str, GridAxis],
    MappingOf(
        "values of each parameter, of which every combination is run",
        "a section such as {bearing.diametral_clearance: {values: [0, 0.2, 0.4], unit: mm}}",
        GridAxis,
        lambda key, axis: [Setting(key, value, axis.unit).checked() for value in axis.values],
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
    case: Annotated[dict[str, Any] | None, BaseCase(f"base case: {BaseCase.form}")] = None
    loads: StudyLoads
    bearings: Annotated[
        list[str] | None, Texts("bearings: names of the catalogue, or paths of bearing files")
    ] = None
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
    keep: Annotated[
        list[str] | None, Variables("variables of a result to store; all if left out")
    ] = None


#: Keys of a case file that a study file does not have at its top.
_OF_A_CASE = Case.__annotations__.keys() - StudyFile.__annotations__.keys()


def read_study(path: str | PathLike[str]) -> Study:
    """Read a study file.

    Bearings and lubricants are read here and now; load files are listed, and opened only if they
    are events that `weights` count by number: such an event takes the length of its record.

    Parameters
    ----------
    path : path
        YAML file; `macroslip init --example study` writes one. Relative paths in it start at its
        own folder.

    Raises
    ------
    InputError
        If the file cannot be read, or anything in it is wrong: all problems together, each with
        file, line and key.
    """
    path = Path(path)
    text = read_text(path, "the study file cannot be read", where=str(path), remedy=_REMEDY)
    data, source = parse(text, str(path), _REMEDY)
    keys = [key for key in data if key in _OF_A_CASE]
    # A single one is a misspelling, for which the closest key of a study is named.
    if len(keys) > 1 and "case" not in data:
        remedy = "Run a case file by macroslip run; in a study they belong under the key case."
        raise InputError(
            f"the keys {', '.join(keys)} are those of a case", where=str(path), remedy=remedy
        )
    return _study(data, source, path.parent)


def study_of(content: Mapping[str, Any], folder: str | PathLike[str] = ".") -> Study:
    """A study from the content of a study file as plain data.

    Raises InputError as `read_study`, without file and line. The content is as `yaml` would read
    it; relative paths start at `folder`.

    Examples
    --------
    >>> study = study_of({"loads": {"bundled": ["14A", "14B"]},
    ...                   "variations": {"grid": {"bearing.diametral_clearance": {"values": [0, 0.2], "unit": "mm"}}}})
    >>> len(study), next(study.runs()).labels["bearing.diametral_clearance"]
    (4, 0)
    """
    return _study(content, Source(), Path(folder))


def _study(data: Mapping[str, Any], source: Source, folder: Path) -> Study:
    location = Location(source)
    values, problems = read_fields(StudyFile, data, location)

    def attempt(key: str, build: Any) -> Any:
        try:
            return build()
        except InputError as problem:
            for part in getattr(problem, "parts", [problem]):
                located = part.where.startswith(f"{source.file}, ") if source.file else False
                problems.append(part if located else location.inside(key).blamed(part))
            return None

    mapping = values.get("case", {})
    base = attempt("case", lambda: _base(mapping, source, folder))
    loads = (
        attempt("loads", lambda: load_list(folder, **asdict(values["loads"])))
        if "loads" in values
        else None
    )
    records = {
        noun: attempt(
            f"{noun}s", lambda noun=noun: _records(RECORDS[noun], values[f"{noun}s"], folder)
        )
        for noun in RECORDS
        if f"{noun}s" in values
    }
    bearings = (records.get("bearing") or {}).values()
    if len({bearing.rows for bearing in bearings}) > 1:
        kinds = sorted({bearing.kind for bearing in bearings})
        problems.append(
            location.inside("bearings").problem(
                f"there are {' and '.join(kinds)} roller bearings, whose rows of rollers differ",
                "bearings with as many rows as each other",
                "Make a study of each number of rows.",
            )
        )
    variations = values.get("variations", Variations())
    models = values.get("models") or {"base": []}
    sample = attempt("variations", lambda: _sample(variations.sample, base, records))
    parameters = attempt("variations", lambda: _parameters(variations, sample, models))
    heat = attempt("case", lambda: _heat(base, parameters)) if base is not None else None
    weights = values.get("weights")
    if weights is not None and loads is not None:
        weights = attempt("weights", partial(weights.with_measured_year, loads.loads, folder))
    if weights is not None and loads is not None:
        attempt("weights", lambda: _check_temperatures(weights, variations))
        lengths = _event_lengths(weights, loads, base, mapping, folder)
        attempt("weights", lambda: weights.check(loads.loads, lengths))
    if problems:
        raise together(problems)
    combinations = itertools.product(
        itertools.product(*(variations.grid or {}).values()),
        variations.list or [[]],
        sample.points() if sample else [[]],
    )
    # The study names the base case's bearing or lubricant as the file does.
    own = {
        noun: {mapping.get(noun) or getattr(base, noun).name: getattr(base, noun)}
        for noun in RECORDS
    }
    return Study(
        title=values.get("title", ""),
        folder=folder.absolute(),
        case={key: value for key, value in mapping.items() if key not in RECORDS},
        loads=loads,
        bearings=records.get("bearing", own["bearing"]),
        lubricants=records.get("lubricant", own["lubricant"]),
        models=models,
        variations=[list(itertools.chain(*combination)) for combination in combinations],
        parameters=parameters,
        cycles=values.get("cycles", False),
        keep=values.get("keep"),
        content=_content(data, weights),
        heat=heat,
        weights=weights,
    )


def _content(data: Mapping[str, Any], weights: Weighting | None) -> dict[str, Any]:
    """The study file as plain data, with a measured year as what was read of it."""
    if weights is None or not isinstance(weights.scada, JointShares):
        return dict(data)
    of_weights = {**data["weights"], "scada": weights.scada.content()}
    return {**data, "weights": of_weights}


def _check_temperatures(weights: Weighting, variations: Variations) -> None:
    """Check that the runs span the temperatures of the weights."""
    if weights.temperatures is None and weights.balance is None:
        return
    grid = variations.grid or {}
    settings: list[Setting] = grid.get(LABEL, [])  # pyright: ignore[reportAssignmentType]
    at = [float(kelvin(np.array(setting.value), setting.unit)) for setting in settings]
    check_varied(len(at))
    if weights.temperatures is not None:
        check_span(weights.temperatures, np.sort(at))


def _base(mapping: Mapping[str, Any], source: Source, folder: Path) -> Case:
    """The base case, so that a mistake in it is found at once, in its own words and lines."""
    inner = {}
    for keys, line in source.lines.items():
        if keys[:1] == ("case",) and len(keys) > 1:
            inner[keys[1:]] = line
    source_of_case = Source(source.file, inner)
    case, _ = template(mapping, [], {}, source=source_of_case, folder=folder)
    return case


def _event_lengths(
    weights: Weighting, loads: LoadList, base: Case | None, mapping: Mapping[str, Any], folder: Path
) -> dict[str, float]:
    """Mean length [s] of the records of each event that the weights count by number.

    Records that cannot be read are left out: their runs fail for themselves.
    """
    if base is None:
        return {}
    _, cut = template(mapping, [], {}, folder=folder)
    lengths: dict[str, list[float]] = {}
    for load in loads.loads:
        rate = weights.year.events.get(load.event)
        if rate is None or rate.in_hours:
            continue
        with contextlib.suppress(InputError):
            path = load_path(loads, load, folder)
            record = read_loads(loads.source, path, cut)
            start = base.window.start
            if start is None:
                start = record.start
            end = record.end
            if base.window.end is not None:
                end = min(base.window.end, end)
            lengths.setdefault(load.event, []).append(end - start)
    return {event: sum(known) / len(known) for event, known in lengths.items()}


def load_path(loads: LoadList, load: Load, folder: Path) -> str:
    """Path of a load history, or its name if it is bundled; relative paths start at the folder."""
    return load.name if loads.source == "bundled" else str(folder / load.name)


def _heat(base: Case, parameters: Mapping[str, str] | None) -> Heat | None:
    if base.temperature != BALANCE:
        return None
    if TEMPERATURE in (parameters or {}):
        remedy = "Vary heat.conductance or heat.ambient, or give the base case a temperature."
        raise InputError(
            "the temperature is to balance, and it is varied", where=TEMPERATURE, remedy=remedy
        )
    return base.heat


def _sample(sample: Sample | None, base: Case | None, records: Mapping[str, Any]) -> Sample | None:
    """The sample, with the ranges of the study's bearing and lubricant where it takes them."""
    ranges = sample.ranges if sample else {}
    open_nouns = set()
    for key, interval in ranges.items():
        if interval is None:
            noun, _, _ = key.partition(".")
            open_nouns.add(noun)
    if sample is None or not open_nouns:
        return sample
    if base is None:  # faults of the case come first
        return None
    owners = {}
    for noun in open_nouns:
        records_by_name = records.get(noun) or {}
        known = list(records_by_name.values()) or [getattr(base, noun)]
        if len(known) > 1:
            fault = f"the sample takes ranges from the {noun}'s file, "
            fault += f"and the study has {len(known)} of them"
            remedy = f"Make a study of each {noun}, or give low, high and unit."
            raise InputError(fault, where="variations.sample.ranges", remedy=remedy)
        owners[noun] = known[0]
    return sample.with_ranges_of(owners)


def _records(kind: RecordKinds, names: list[str], folder: Path) -> dict[str, Record]:
    catalogue = kind.catalogue()
    records = {}
    for name in names:
        path_or_name = name if name in catalogue else folder / name
        records[name] = kind.read(path_or_name)
    return records


def _parameters(
    variations: Variations, sample: Sample | None, models: Mapping[str, list[Setting]]
) -> dict[str, str]:
    """Units of all parameters.

    Each is varied in one place only, or it would not be clear which value holds.
    """
    axes: dict[str, Any] = dict(
        variations.grid or {}
    )  # lists of settings, which the reader has made of the axes
    units_by_section: dict[str, dict[str, str]] = {
        "grid": {key: settings[0].unit for key, settings in axes.items()},
        "list": {
            setting.key: setting.unit for setting in itertools.chain(*(variations.list or []))
        },
        "sample": {
            key: interval.unit
            for key, interval in (sample.ranges if sample else {}).items()
            if interval is not None
        },
        "models": {setting.key: setting.unit for setting in itertools.chain(*models.values())},
    }
    units_by_key: dict[str, str] = {}
    for name, units in units_by_section.items():
        for key, unit in units.items():
            if key in units_by_key:
                raise InputError(
                    f"{key} is varied in {name} and in another place",
                    allowed="one place for each key",
                )
            units_by_key[key] = unit
    return units_by_key
