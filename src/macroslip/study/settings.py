"""Parameter values by which runs of a study differ from the base case.

They are given one by one, in grids and in samples.
"""

from __future__ import annotations

import functools
import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import Annotated, Any, NamedTuple

import numpy as np

from macroslip.bearing.kinds import (
    BEARING_KINDS,
    bearing_catalogue,
    bearing_from_dict,
    read_bearing,
)
from macroslip.case.case import Case
from macroslip.case.case_file import build_case
from macroslip.case.load_source import FOR_HUB_FILES, LoadSource
from macroslip.errors import InputError
from macroslip.input.fields import FORM_ONLY, Choice, Quantity, Text, Whole
from macroslip.input.files import Source
from macroslip.input.messages import shown, unknown_key
from macroslip.input.record import Record, dimensions, read_entry
from macroslip.input.section import (
    Field,
    MappingOf,
    OrWord,
    form_of,
    input_section,
    keys_of,
    read_value,
    word_of,
)
from macroslip.input.units import NUMBER, NUMBER_PATTERN, Dimension, is_finite_number
from macroslip.loads import BearingLoads, HubLoads
from macroslip.lubricant import Lubricant
from macroslip.result.variables import CONTACT_DETAILS


class RecordKinds(NamedTuple):
    """Classes of a kind of record, and how one is read whatever its class."""

    classes: tuple[type[Record], ...]
    catalogue: Callable[[], Sequence[str]]  #: Names of the shipped ones
    read: Callable[[str | PathLike[str]], Record]  #: From a name or a file
    from_dict: Callable[[Mapping[str, Any]], Record]  #: From the content of a file

    @property
    def dimensions(self) -> dict[str, Dimension]:
        """Quantities of all classes by key."""
        by_key = {}
        for kind in self.classes:
            by_key |= dimensions(kind)
        return by_key


#: Records with values of their own, each of which can be replaced.
RECORDS: dict[str, RecordKinds] = {
    "bearing": RecordKinds(BEARING_KINDS, bearing_catalogue, read_bearing, bearing_from_dict),
    "lubricant": RecordKinds(
        (Lubricant,), Lubricant.catalogue, Lubricant.read, Lubricant.from_dict
    ),
}
#: Keys that change several values of a record together, with the quantity whose units they have.
_TOGETHER = {"lubricant.at": "inlet_temperature"}
#: Keys of a case that have a key of their own in a study.
_ELSEWHERE = {"loads": "loads", "bearing": "bearings", "lubricant": "lubricants"}
_QUANTITY = re.compile(rf"\s*(?P<number>{NUMBER_PATTERN})(?=[^\d.,])\s*(?P<unit>\S.*?)\s*")
#: Used in place of the loads until they are read: so long that any window lies within it.
_ANY_LOADS = BearingLoads(np.array([-1e10, 1e10]), np.zeros(2), np.zeros((2, 3)), "no loads yet")
METHODS = ("latin-hypercube", "sobol")
SCALES = ("linear", "log")
#: Points of a sample beyond which the count must be a mistake.
_MOST_POINTS = 10_000_000


@dataclass(frozen=True)
class Setting:
    """One value that replaces the base case's."""

    #: Key of the case file, as `drivetrain.tilt`, or `bearing.` or `lubricant.` and the key of one
    #: of its values.
    key: str
    value: Any  #: Number, text, truth value or list
    unit: str = ""  #: Unit of a quantity, or empty

    @classmethod
    def written(cls, key: str, value: Any) -> Setting:
        """A setting from text of a case file: `0.2 mm` becomes number and unit."""
        match = None
        if isinstance(value, str):
            match = _QUANTITY.fullmatch(value)
        if match is None:
            return cls(key, value)
        return cls(key, float(match["number"]), match["unit"])

    @property
    def text(self) -> Any:
        """The value as a case file has it."""
        return f"{self.value!r} {self.unit}" if self.unit else self.value

    @property
    def entry(self) -> dict[str, Any]:
        """The value as a catalogue file has it, with the tag of a user's value."""
        return {
            "value": self.value,
            "unit": self.unit or "1",
            "tag": "U",
            "note": "varied in a study",
        }

    def checked(self) -> Setting:
        """The setting, if key, form and unit are right.

        Whether it is in range is checked with the case.

        Raises InputError otherwise.
        """
        head, *parts = self.key.split(".")
        if head in RECORDS and parts:
            self._check_entry(head, ".".join(parts))
            return self
        if head in _ELSEWHERE:
            remedy = f"It has its own key in a study: {_ELSEWHERE[head]}."
            raise InputError(f"the key '{self.key}' cannot be varied here", remedy=remedy)
        fields = _settable().get(self.key, [])
        if not fields:
            keys = [key for key in _settable() if key.partition(".")[0] not in _ELSEWHERE]
            for noun, record in RECORDS.items():
                keys += [f"{noun}.{key}" for key in record.dimensions]
            raise unknown_key(self.key, keys)
        problems = []
        for field in fields:
            try:
                self._check_against(field)
                return self
            except InputError as problem:
                problems.append(problem)
        raise problems[0]

    def _check_against(self, field: Field) -> None:
        form = form_of(field)
        word = word_of(field)
        takes_unit = isinstance(form, Quantity) and form.dimension is not NUMBER
        if self.unit and not takes_unit:
            raise InputError(
                f"it has the unit '{self.unit}'",
                allowed="a value without unit",
                remedy="Remove the unit.",
            )
        if form is None and self.value != word:
            raise InputError(f"it is {shown(self.value)}", allowed=word)
        read_value(field, self.text, FORM_ONLY)

    def _check_entry(self, noun: str, key: str) -> None:
        key = _TOGETHER.get(self.key, _field_key(key))
        known = RECORDS[noun].dimensions
        if key not in known:
            known_keys = (f"{noun}.{name}" for name in known)
            raise unknown_key(self.key, known_keys)
        if not is_finite_number(self.value):
            raise InputError(
                f"it is {shown(self.value)}",
                allowed=f"a number with its unit, {known[key].choices}",
            )
        try:
            read_entry(key, self.entry, known[key], Source())
        except InputError as problem:
            part = ""
            if problem.where:
                _, _, name = problem.where.rpartition(".")
                part = f"{name} "
            raise problem.but(fault=part + problem.fault, where="") from None


def _field_key(key: str) -> str:
    """The field of a record's key.

    Of one inside a section, `out_of_round.second`, `out_of_round_second`.
    """
    return key.replace(".", "_")


def with_settings(mapping: Mapping[str, Any], settings: Sequence[Setting]) -> dict[str, Any]:
    """The mapping of a case file with other values.

    Bearing's and lubricant's values are left to `replaced`.
    """
    result = dict(mapping)
    for setting in settings:
        *sections, last = setting.key.split(".")
        if sections and sections[0] in RECORDS:
            continue
        inner = result
        for name in sections:
            section = inner.get(name)
            # A section that is absent or switched off by a word begins anew.
            inner[name] = dict(section) if isinstance(section, Mapping) else {}
            inner = inner[name]
        inner[last] = setting.text
    return result


def replaced(record: Record, settings: Sequence[Setting]) -> Record:
    """Copy of a bearing or lubricant with other values, checked as any other input.

    Raises InputError if a value is out of its range, or does not go with the others.

    Examples
    --------
    >>> from macroslip import Bearing
    >>> bearing = replaced(Bearing.read("skf-240-600-bc"), [Setting("bearing.diametral_clearance", 0.2, "mm")])
    >>> bearing.diametral_clearance, bearing.provenance["diametral_clearance"].tag
    (0.0002, 'U')
    """
    noun = "lubricant" if isinstance(record, Lubricant) else "bearing"
    head = f"{noun}."
    own = [setting for setting in settings if setting.key.startswith(head)]
    entries = {}
    for setting in own:
        if setting.key not in _TOGETHER:
            key = _field_key(setting.key.removeprefix(head))
            entries[key] = setting.entry
    result = record.with_entries(entries) if entries else record
    for setting in own:
        if setting.key == "lubricant.at":
            dimension = dimensions(type(record))[_TOGETHER[setting.key]]
            temperature, _ = read_entry("at", setting.entry, dimension, Source())
            result = result.at(temperature)
    return result


@functools.cache
def _settable() -> dict[str, list[Field]]:
    """Fields by the full name of a key, `drivetrain.tilt`.

    Several where sections exclude each other.
    """
    fields: dict[str, list[Field]] = {}
    for key, field in keys_of(Case):
        if form_of(field) or word_of(field):
            fields.setdefault(key, []).append(field)
    return fields


def template(
    mapping: Mapping[str, Any],
    settings: Sequence[Setting],
    records: Mapping[str, Record],
    *,
    keep: Sequence[str] | None = None,
    source: Source | None = None,
    folder: Path | None = None,
) -> tuple[Case, dict[str, Any]]:
    """A case with everything but its loads, and how to read them.

    Parameters
    ----------
    mapping : mapping
        Base case: the mapping of a case file, of `loads` only start, end and shaft_speed.
    settings : sequence of Setting
        Values in place of those of the base case.
    records : mapping
        Bearing and lubricant in place of those of the base case.
    keep : sequence of str, optional
        Variables to keep; details of contacts are recorded only where some of them are among these.
    source : Source, optional
        Where the mapping was written.
    folder : path, optional
        Where relative paths start.

    Returns
    -------
    Case, dict
        The case, with loads that stand for any; and the arguments of `read_loads` for its own.

    Raises
    ------
    InputError
        If anything but the loads is wrong.
    """
    cut: dict[str, Any] = {}

    def unread(load_source: LoadSource) -> BearingLoads:
        cut.update(load_source.cut)
        return _ANY_LOADS

    names = {noun: record.name for noun, record in records.items()}
    # The source is named only because a case has to have one; it is not read.
    content = {**with_settings(mapping, settings), **names}
    loads = content.get("loads") or {}
    content["loads"] = loads | {"file": "-"}
    case = build_case(content, source or Source(), folder or Path(), records=records, series=unread)
    changed = {}
    for noun in RECORDS:
        changed[noun] = replaced(getattr(case, noun), settings)
    keeps_details = keep is None or not set(CONTACT_DETAILS).isdisjoint(keep)
    details = case.contact_details and keeps_details
    return replace(case, **changed, contact_details=details), cut


def read_loads(source: str, path: str, cut: Mapping[str, Any]) -> HubLoads | BearingLoads:
    """Read the loads of a run: a `file`, `bearing_file`, or `bundled` case.

    The cut has `start` and `end` [s], if the loads are to be cut, of files with hub loads that lack
    them `shaft_speed` [rad/s] and `hub_to_output` [m], and `decimal` and `thousands` of CSV tables.
    Raises InputError if they cannot be used, or a file cannot be read.
    """
    try:
        for name in FOR_HUB_FILES:
            if name in cut and source != "file":
                fault = f"{name} is given in the base case, but these loads have their own"
                remedy = f"Remove loads.{name}; it serves hub loads from files only."
                raise InputError(fault, where=path, remedy=remedy)
        if source == "bundled":
            start = cut.get("start")
            return HubLoads.bundled(path).window(start, cut.get("end"))
        kind = HubLoads if source == "file" else BearingLoads
        return kind.read(path, **cut)
    except OSError as error:
        raise InputError(
            f"the file cannot be read ({error.strerror or error})", where=path
        ) from None


@input_section("range", "interval of a sampled parameter", positional=True)
class Range:
    """Interval of a sampled parameter: all values, or all logarithms, are equally likely."""

    low: Annotated[float, Quantity("lower end; its unit goes into unit")]
    high: Annotated[float, Quantity("upper end; its unit goes into unit")]
    unit: Annotated[str, Text("unit of both ends", may_be_empty=True)] = ""
    scale: Annotated[str, Choice("scale on which values are equally likely", lambda: SCALES)] = (
        "linear"
    )

    def __post_init__(self) -> None:
        if not self.low < self.high:
            raise InputError(
                f"low is {self.low:g} and high is {self.high:g}", allowed="low below high"
            )
        if self.scale == "log" and self.low <= 0.0:
            raise InputError(
                f"low is {self.low:g} on a logarithmic scale", allowed="a number above 0"
            )

    def at(self, position: float) -> float:
        """The value at a position from 0 to 1."""
        if self.scale == "log":
            low = math.log(self.low)
            high = math.log(self.high)
            return math.exp(low + position * (high - low))
        return self.low + position * (self.high - self.low)


def _checked_range(key: str, interval: Range | None) -> Range | None:
    """Check both ends as values of the parameter; a file's are checked with the file."""
    if interval is None:
        if key.partition(".")[0] not in RECORDS:
            fault = f"the range of {key} is to come from a file, "
            fault += "but it is no value of a bearing or lubricant"
            raise InputError(
                fault,
                allowed="keys such as bearing.roller_length",
                remedy="Give low, high and unit.",
            )
        noun, _, name = key.partition(".")
        known = RECORDS[noun].dimensions
        if _field_key(name) not in known:
            known_keys = (f"{noun}.{entry}" for entry in known)
            raise unknown_key(key, known_keys)
        return None
    for end in (interval.low, interval.high):
        Setting(key, end, interval.unit).checked()
    return interval


@input_section("sample", "seeded sample of a box of parameters")
class Sample:
    """Seeded sample of a box of parameters, of `scipy.stats.qmc`.

    A range that is None is the range in the record's file.
    """

    method: Annotated[str, Choice("how to sample", lambda: METHODS)] = "latin-hypercube"
    count: Annotated[int, Whole("number of points; a power of 2 for sobol", 1, _MOST_POINTS)]
    seed: Annotated[int, Whole("seed: the same one gives the same points")]
    ranges: Annotated[
        dict[str, Range | None],
        MappingOf(
            "interval of each parameter",
            "a section such as {bearing.diametral_clearance: {low: 0, high: 0.4, unit: mm}, "
            "bearing.roller_length: range}",
            Annotated[Range | None, OrWord("range")],
            _checked_range,
        ),
    ]

    def __post_init__(self) -> None:
        is_power_of_2 = self.count & (self.count - 1) == 0
        if self.method == "sobol" and not is_power_of_2:
            below = 1 << (self.count.bit_length() - 1)
            allowed = "a power of 2, at which a Sobol sequence is balanced"
            remedy = f"Take {below} or {2 * below}, or latin-hypercube."
            raise InputError(f"count is {self.count}", allowed=allowed, remedy=remedy)

    def with_ranges_of(self, records: Mapping[str, Record]) -> Sample:
        """The sample with the ranges of the bearing's and lubricant's files in place of the word.

        Raises InputError if a value has no range there, or is a count.
        """
        ranges = dict(self.ranges)
        for key, interval in self.ranges.items():
            if interval is not None:
                continue
            field = _field_key(key.replace(".", "/", 1))
            noun, _, name = field.partition("/")
            entry = records[noun].provenance.get(name)
            where = f"variations.sample.ranges.{key}"
            if entry is None or entry.range is None:
                remedy = "Give low, high and unit, or a range in the file."
                raise InputError(
                    f"{records[noun].name} has no range for {name}", where=where, remedy=remedy
                )
            if isinstance(getattr(records[noun], name), int):
                remedy = f"List its values in variations.grid: {{{key}: {{values: [...]}}}}."
                raise InputError(
                    f"{name} is a count, which an interval cannot sample",
                    where=where,
                    remedy=remedy,
                )
            low, high = entry.range
            unit = "" if entry.unit == "1" else entry.unit
            ranges[key] = Range(low=low, high=high, unit=unit)
        return Sample(method=self.method, count=self.count, seed=self.seed, ranges=ranges)

    def points(self) -> list[list[Setting]]:
        """The points, each as the settings of all parameters.

        Examples
        --------
        >>> sample = Sample(method="sobol", count=4, seed=1, ranges={"drivetrain.tilt": Range(0.0, 8.0, "deg")})
        >>> sorted(int(point[0].value // 2) for point in sample.points())  # one in each quarter
        [0, 1, 2, 3]
        """
        from scipy.stats import qmc

        kinds = {"latin-hypercube": qmc.LatinHypercube, "sobol": qmc.Sobol}
        # `with_ranges_of` has filled in those that were left open.
        intervals: dict[str, Any] = dict(self.ranges)
        random = np.random.default_rng(self.seed)
        generator = kinds[self.method](len(self.ranges), rng=random)
        points = []
        for positions in generator.random(self.count):
            settings = []
            for (key, interval), position in zip(intervals.items(), positions, strict=True):
                # Twelve digits are more than the accuracy of any parameter, and the same on every
                # machine.
                value = float(f"{interval.at(float(position)):.12g}")
                settings.append(Setting(key, value, interval.unit))
            points.append(settings)
        return points
