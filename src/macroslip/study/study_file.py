"""From a study file to a `Study`; whatever is wrong with the file is reported together, each with its line and remedy."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from macroslip.case.case import BALANCE, Case
from macroslip.errors import InputError
from macroslip.input.files import Place, Source, parse, read_text
from macroslip.input.messages import together
from macroslip.input.record import Record
from macroslip.input.section import read_fields
from macroslip.study.build import template
from macroslip.study.loads_list import load_list
from macroslip.study.settings import RECORDS, Setting
from macroslip.study.study import TEMPERATURE, Study
from macroslip.study.study_keys import StudyFile, Variations
from macroslip.study.variation import Sample, grid

if TYPE_CHECKING:
    from macroslip.case.case import Case
    from macroslip.case.parts import Heat
    from macroslip.study.loads_list import Load
    from macroslip.study.weights import Weighting

#: Keys of a case file that a study file does not have at its top.
_OF_A_CASE = Case.__annotations__.keys() - StudyFile.__annotations__.keys()
_REMEDY = "Write a study file that runs with: macroslip init --example study"


def read_study(path: str | PathLike[str]) -> Study:
    """Read a study file.

    Bearings and lubricants are read here and now; load files are listed, but not opened.

    Parameters
    ----------
    path : path
        YAML file; `macroslip init --example study` writes one. Relative paths in it start at its own folder.

    Returns
    -------
    Study

    Raises
    ------
    InputError
        If the file cannot be read, or anything in it is wrong: all problems together, each with file, line and key.
    """
    path = Path(path)
    text = read_text(path, "the study file cannot be read", where=str(path), remedy=_REMEDY)
    data, source = parse(text, str(path), _REMEDY)
    keys = [key for key in data if key in _OF_A_CASE]
    # A single one is a misspelling, for which the closest key of a study is named.
    if len(keys) > 1 and "case" not in data:
        raise InputError(
            f"the keys {', '.join(keys)} are those of a case",
            where=str(path),
            remedy="Run a case file by macroslip run; in a study they belong under the key case.",
        )
    return _study(data, source, path.parent)


def study_of(content: Mapping[str, Any], folder: str | PathLike[str] = ".") -> Study:
    """A study from the content of a study file as plain data.

    Parameters
    ----------
    content : mapping
        As `yaml` would read it.
    folder : path
        Where relative paths start.

    Raises
    ------
    InputError
        As `read_study`, without file and line.

    Examples
    --------
    >>> study = study_of({"loads": {"bundled": ["14A", "14B"]},
    ...                   "variations": {"grid": {"bearing.diametral_clearance": {"values": [0, 0.2], "unit": "mm"}}}})
    >>> len(study), next(study.runs()).labels["bearing.diametral_clearance"]
    (4, 0)
    """
    return _study(content, Source(), Path(folder))


def _study(data: Mapping[str, Any], source: Source, folder: Path) -> Study:
    place = Place(source)
    values, problems = read_fields(StudyFile, data, place)

    def attempt(key: str, build: Any) -> Any:
        try:
            return build()
        except InputError as problem:
            for part in getattr(problem, "parts", [problem]):
                located = part.where.startswith(f"{source.file}, ") if source.file else False
                problems.append(part if located else place.inside(key).blamed(part))
            return None

    mapping = values.get("case", {})
    base, cut = attempt("case", lambda: _base(mapping, source, folder)) or (None, {})
    loads = attempt("loads", lambda: load_list(values["loads"], folder)) if "loads" in values else None
    records = {
        noun: attempt(f"{noun}s", lambda noun=noun: _records(RECORDS[noun], values[f"{noun}s"], folder))
        for noun in RECORDS
        if f"{noun}s" in values
    }
    variations, models = values.get("variations", Variations()), values.get("models") or {"base": []}
    sample = attempt("variations", lambda: _sample(variations, base, records))
    parameters = attempt("variations", lambda: _parameters(variations, sample, models))
    heat = attempt("case", lambda: _heat(base, parameters)) if base is not None else None
    weights = values.get("weights")
    if weights is not None and loads is not None:
        attempt("weights", lambda: _check_weights(weights, heat, loads.loads))
    if problems:
        raise together(problems)
    combinations = [
        [*first, *second, *third]
        for first in grid(variations.grid or {})
        for second in variations.list or [[]]
        for third in (sample.points() if sample else [[]])
    ]
    own = {noun: {_name(mapping, noun, getattr(base, noun)): getattr(base, noun)} for noun in RECORDS}
    return Study(
        title=values.get("title", ""),
        folder=folder.absolute(),
        case={key: value for key, value in mapping.items() if key not in RECORDS},
        cut=cut,
        loads=loads,
        bearings=records.get("bearing", own["bearing"]),
        lubricants=records.get("lubricant", own["lubricant"]),
        models=models,
        variations=combinations,
        parameters=parameters,
        cycles=values.get("cycles", False),
        keep=values.get("keep"),
        content=dict(data),
        heat=heat,
        weights=weights,
    )


def _heat(base: Case, parameters: Mapping[str, str] | None) -> Heat | None:
    """How the bearing loses its heat, where the temperature is to balance."""
    if base.temperature != BALANCE:
        return None
    if TEMPERATURE in (parameters or {}):
        raise InputError(
            "the temperature is to balance, and it is varied",
            where=TEMPERATURE,
            remedy="Vary heat.conductance or heat.ambient, or give the base case a temperature.",
        )
    return base.heat


def _check_weights(weights: Weighting, heat: Heat | None, loads: Sequence[Load]) -> None:
    if heat is None:
        raise InputError(
            "weights are given, and nothing is weighted",
            allowed="temperature: balance in the base case",
            remedy="Remove them; macroslip aggregate weights results.",
        )
    weights.of(loads)


def _sample(variations: Variations, base: Any, records: Mapping[str, Any]) -> Sample | None:
    """The sample, with the ranges of the study's bearing and lubricant where it takes them."""
    sample = variations.sample
    open_nouns = {key.partition(".")[0] for key, one in (sample.ranges if sample else {}).items() if one is None}
    if sample is None or not open_nouns:
        return sample
    if base is None:  # what is wrong with the case comes first
        return None
    found = {}
    for noun in open_nouns:
        known = list((records.get(noun) or {}).values()) or [getattr(base, noun)]
        if len(known) > 1:
            raise InputError(
                f"the sample takes ranges from the {noun}'s file, and the study has {len(known)} of them",
                where="variations.sample.ranges",
                remedy=f"Make a study of each {noun}, or give low, high and unit.",
            )
        found[noun] = known[0]
    return sample.with_ranges_of(found)


def _name(case: Mapping[str, Any], noun: str, record: Record) -> str:
    """The study's name for the base case's bearing or lubricant."""
    return case.get(noun) or record.name


def _base(mapping: Mapping[str, Any], source: Source, folder: Path) -> Any:
    """The base case, so that a mistake in it is found at once, in its own words and lines."""
    inner = {keys[1:]: line for keys, line in source.lines.items() if keys[:1] == ("case",) and len(keys) > 1}
    return template(mapping, [], {}, source=Source(source.file, inner), folder=folder)


def _records(kind: type[Record], names: list[str], folder: Path) -> dict[str, Record]:
    catalogue = kind.catalogue()
    return {name: kind.read(name if name in catalogue else folder / name) for name in names}


def _parameters(variations: Variations, sample: Sample | None, models: Mapping[str, list[Setting]]) -> dict[str, str]:
    """Units of all parameters; each is varied in one place only, or it would not be clear which value holds."""
    ranges = sample.ranges if sample else {}
    grid: dict[str, Any] = dict(variations.grid or {})  # lists of settings, which the reader has made of the axes
    places: dict[str, dict[str, str]] = {
        "grid": {key: settings[0].unit for key, settings in grid.items()},
        "list": {one.key: one.unit for item in variations.list or [] for one in item},
        "sample": {key: one.unit for key, one in ranges.items() if one is not None},
        "models": {one.key: one.unit for settings in models.values() for one in settings},
    }
    found: dict[str, str] = {}
    for name, units in places.items():
        for key, unit in units.items():
            if key in found:
                raise InputError(f"{key} is varied in {name} and in another place", allowed="one place for each key")
            found[key] = unit
    return found
